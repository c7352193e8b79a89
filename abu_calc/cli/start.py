"""Where the command `abu` begins: before anything large is imported."""

import gc


def main() -> None:
    """Run `abu`; a short process that imports much gains a tenth by collecting garbage less often."""
    gc.set_threshold(50_000)
    from abu_calc.cli.app import main as run

    run()
