"""Where the command `abu` begins: before anything large is imported."""

import gc
import os
import signal
import sys
from typing import Final

INTERRUPTED: Final = 130
ENDING: Final = ("SIGTERM", "SIGHUP", "SIGBREAK")
"""Signals that end a command as Ctrl-C does; no system has all of them."""


class EndedBySignal(BaseException):
    """A signal asked the command to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_status = 128 + number


def main() -> None:
    """Run `abu` without what only a long process gains from: that saves a short one a fifth of its time.

    Garbage is seldom searched for, and not at the end, when the system takes back all; installed distributions are not
    searched for plugins of pydantic.
    """
    gc.set_threshold(100_000)
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    try:
        heed_signals()
        from abu_calc.cli.app import main as run

        run()
    except (KeyboardInterrupt, EndedBySignal) as ended:  # before the command has begun, or after it has ended
        print("Interrupted.", file=sys.stderr)
        sys.exit(status_of(ended))
    finally:
        gc.freeze()


def heed_signals() -> None:
    """From now on signals end the command in good order; those that are ignored, as under nohup, stay so."""
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)


def _end(number: int, _: object) -> None:
    raise EndedBySignal(number)


def status_of(ended: BaseException) -> int:
    """128 and the number of the signal."""
    return ended.exit_status if isinstance(ended, EndedBySignal) else INTERRUPTED
