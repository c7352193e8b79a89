"""Entry point of the command `abu`, before anything large is imported."""

import gc
import os
import sys

from abu_calc.foundation.parallel import EndedBySignal, heed_signals, leave_signals, status_of

OBJECTS = 300_000
"""Kept objects between two searches for garbage: the largest start makes half as many, and to search takes a tenth of
its time."""


def main() -> None:
    """Run `abu` without what only a long process gains from: that saves a short one a fifth of its time.

    Garbage is seldom searched for, and not at the end, when the system takes back all; installed distributions are not
    searched for plugins of pydantic; matrices are too small for threads, which only wait for each other.
    """
    gc.set_threshold(OBJECTS)
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    try:
        heed_signals()
        from abu_calc.cli.app import main as run

        run()
    except (KeyboardInterrupt, EndedBySignal) as ended:  # before the command has begun, or after it has ended
        print("Interrupted.", file=sys.stderr)
        sys.exit(status_of(ended))
    finally:
        leave_signals()
        gc.freeze()
