"""Time limit of a sample: work that takes too long is given up, in any thread and on any system."""

import ctypes
import faulthandler
import os
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from abu_calc.foundation.interruption import importing

GRACE: Final = 5.0
"""Seconds after which a process whose work does not give up is ended, where it may be."""
AGAIN_S: Final = 0.5
"""Seconds after which it is raised again: what runs for the garbage collector swallows whatever is raised in it."""
IMPORTS_S: Final = 0.05
"""Seconds between two looks at a thread that imports: a module whose import is broken off is broken for good."""


class Overtime(BaseException):
    """The time is over."""

    comes_again = True


@contextmanager
def limited(seconds: float, *, may_end_process: bool = False) -> Iterator[None]:
    """Raise Overtime inside once the time is over, as soon as Python code runs there that is no import.

    `may_end_process`: what never returns to Python takes the process with it; only for processes that were made to
    compute, whose owner notices.
    """
    thread, lock, inside = threading.get_ident(), threading.Lock(), True

    def stop() -> None:
        """Raise Overtime in the thread until it leaves, but in no import."""
        while True:
            with lock:
                if not inside:
                    return
                raised = not importing(sys._current_frames().get(thread))
                if raised:
                    _raise_in(thread, Overtime)
            time.sleep(AGAIN_S if raised else IMPORTS_S)

    timer = threading.Timer(seconds, stop)
    timer.daemon = True
    try:
        timer.start()
    except RuntimeError as error:  # no room for another thread
        raise OSError(str(error)) from None
    if may_end_process:
        _end_at(thread, time.monotonic() + seconds + GRACE)
    try:
        yield
    finally:
        timer.cancel()
        with lock:
            inside = False
        _raise_in(thread, None)  # one that was raised, but did not arrive in time
        if may_end_process:
            _end_at(thread, None)


_ends: dict[int, float] = {}
_ending: Final = threading.Lock()


def _end_at(thread: int, when: float | None) -> None:
    """The process ends at the first of what its threads ask for: faulthandler has one clock for all of them."""
    with _ending:
        if when is None:
            _ends.pop(thread, None)
        else:
            _ends[thread] = when
        if _ends:
            left = max(min(_ends.values()) - time.monotonic(), 1e-3)
            faulthandler.dump_traceback_later(left, exit=True, file=_nowhere())
        else:
            faulthandler.cancel_dump_traceback_later()


def _raise_in(thread: int, kind: type[BaseException] | None) -> None:
    raised = ctypes.py_object(kind) if kind else None
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), raised)


_open: list[int] = []


def _nowhere() -> int:
    """A file that swallows what is written."""
    if not _open:
        _open.append(os.open(os.devnull, os.O_WRONLY))
    return _open[0]
