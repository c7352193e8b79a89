"""Where the command `abu` begins: before anything large is imported."""

import gc
import os


def main() -> None:
    """Run `abu`; a short process that imports much gains a tenth by collecting garbage less often, and as much by
    not searching every installed distribution for plugins of pydantic."""
    gc.set_threshold(50_000)
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    from abu_calc.cli.app import main as run

    run()
