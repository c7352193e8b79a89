"""Signals that ask a command to end: it ends in good order, with a line and 128 plus the signal's number.

A signal is never lost. One that arrives during an import waits for its end: extension modules turn whatever is raised
then into ImportError, and are broken for good. One that a library swallows is raised again until the command heeds it.
"""

import _thread
import signal
import sys
import time
from collections.abc import Callable
from functools import partial
from types import FrameType
from typing import Any

INTERRUPTED = 130
"""The exit status after Ctrl-C."""
ENDING = ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
"""Signals that end a command, Ctrl-C first; no system has all of them."""
AGAIN_S = 0.05
"""Seconds between two tries to raise a signal that has not been heeded."""
SAME_S = 1.0
"""Signals that follow the first within this time ask for the same: clean-up goes on."""
IMPORTER = "<frozen importlib"
"""Start of the file names of Python's own import system."""


class EndedBySignal(BaseException):
    """A signal asked the command to end."""

    comes_again = True
    """Mark of an error that is raised again if Python drops it where nothing can be raised."""

    def __init__(self, number: int) -> None:
        super().__init__(number)
        self.exit_status = 128 + number


class _Pending:
    """The signal not yet heeded, when it arrived, whether `_remind` sent it; and the thread that takes signals."""

    number: int | None = None
    since = 0.0
    reminded = False
    thread = 0


def heed_signals() -> None:
    """Make signals raise EndedBySignal from now on; those that are ignored, as under nohup, stay so.

    Ctrl-C, too: a KeyboardInterrupt within code made from text, as dataclasses are made, Python remembers to the end,
    where it kills the process by the signal, whatever its exit status was to be.
    """
    _Pending.thread, sys.unraisablehook = _thread.get_ident(), partial(_silence, sys.unraisablehook)
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) in (signal.SIG_DFL, signal.default_int_handler):
            signal.signal(number, _end)


def leave_signals() -> int | None:
    """Leave signals to the system, which ends the process without a word: the command is over.

    Return the number of a signal that arrived last and was not heeded; None if there was none.
    """
    for name in ENDING:
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is _end:
            signal.signal(number, signal.SIG_DFL)
    last, _Pending.number = _Pending.number, None
    return last


def raise_pending() -> None:
    """Raise EndedBySignal if a signal has arrived that something swallowed: an error then says nothing."""
    if _Pending.number is not None:
        raise EndedBySignal(_Pending.number)


def status_of(ended: BaseException) -> int:
    """The exit status of a command that was interrupted. The signal counts as heeded and is not raised again."""
    _Pending.number = None
    return ended.exit_status if isinstance(ended, EndedBySignal) else INTERRUPTED


def importing(frame: FrameType | None) -> bool:
    """Tell whether this frame or a frame that called it is an import."""
    while frame is not None:
        if frame.f_code.co_filename.startswith(IMPORTER):
            return True
        frame = frame.f_back
    return False


def _end(number: int, frame: FrameType | None) -> None:
    reminded, _Pending.reminded = _Pending.reminded, False
    now = time.monotonic()
    if _Pending.number is None:
        if reminded:  # heeded since it was sent
            return
        _Pending.number, _Pending.since = number, now
        _thread.start_new_thread(_remind, ())  # which takes no lock that this thread may hold
    if importing(frame) or (_cleaning_up() and (reminded or now - _Pending.since < SAME_S)):
        return
    raise EndedBySignal(_Pending.number)


def _cleaning_up() -> bool:
    """Tell whether an EndedBySignal is on its way: `finally` and `except` run for it."""
    error = sys.exc_info()[1]
    while error is not None:
        if isinstance(error, EndedBySignal):
            return True
        error = error.__context__
    return False


def _remind() -> None:
    """Send the signal again and again to the thread that takes signals, until it is heeded."""
    while True:
        time.sleep(AGAIN_S)
        number = _Pending.number
        if number is None:
            return
        _Pending.reminded = True
        if hasattr(signal, "pthread_kill"):
            signal.pthread_kill(_Pending.thread, number)
        else:  # Windows: no call of the system is interrupted, the next line of Python is
            _thread.interrupt_main(signal.Signals(number))


def _silence(otherwise: Callable[[Any], Any], unraisable: Any) -> None:
    """A signal that is raised where nothing can be is raised again: the user need not know."""
    if not getattr(unraisable.exc_value, "comes_again", False):
        otherwise(unraisable)
