"""Signals that ask a command to end: it ends in good order, with a line and 128 and the number of the signal."""

import signal
from typing import Final

INTERRUPTED: Final = 130
"""The exit status after Ctrl-C."""
ENDING: Final = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
"""Those that end a command, Ctrl-C first; no system has all of them."""


class EndedBySignal(BaseException):
    """A signal asked the command to end."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_status = 128 + number


def heed_signals() -> None:
    """From now on they raise EndedBySignal; those that are ignored, as under nohup, stay so.

    Ctrl-C, too: a KeyboardInterrupt within code made from text, as dataclasses are made, Python remembers to the end,
    where it kills the process by the signal, whatever its exit status was to be.
    """
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            signal.signal(number, _end)


def _end(number: int, _: object) -> None:
    raise EndedBySignal(number)


def status_of(ended: BaseException) -> int:
    """The exit status of a command that was interrupted."""
    return ended.exit_status if isinstance(ended, EndedBySignal) else INTERRUPTED
