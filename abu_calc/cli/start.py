"""Where the command `abu` begins: before anything large is imported."""

import gc
import os


def main() -> None:
    """Run `abu` without what only a long process gains from: that saves a short one a fifth of its time.

    Garbage is seldom searched for, and not at the end, when the system takes back all; installed distributions are not
    searched for plugins of pydantic.
    """
    gc.set_threshold(100_000)
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    from abu_calc.cli.app import main as run

    try:
        run()
    finally:
        gc.freeze()
