"""Time limit on the simulations of a command: a wall-clock limit in seconds if one is asked for.

Without it limits are counts of evaluations, equal on every computer. With it counts do not bound a run. A
run that is not done when the time is up has no answer, and its check is NOT EVALUATED. Threads share the
limit.
"""

import math
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from abu_calc.foundation.validity import Range

SECONDS: Final = Range("patience", 0.0, 1e6, "s", open_low=True, key="patience")

UNBOUNDED: Final = 2**60
"""Evaluations that no run takes."""


class _Wall:
    """The time at which patience ends, by the clock of `time.monotonic`; None without one."""

    end: float | None = None
    aside: int = 0
    """Number of threads that have put it aside."""


_LOCK: Final = threading.Lock()

STATE_SECONDS: Final = 2e-8
"""Time [s] of a compiled evaluation for each state of a scene."""


def would_do(evaluations: float, states: int) -> str:
    """The option that would let so many evaluations of a scene be done, in round numbers of seconds.

    >>> would_do(4e7, 16)
    '--patience 20'
    """
    return f"--patience {max(10 * math.ceil(evaluations * states * STATE_SECONDS / 10), 10)}"


@contextmanager
def limited(seconds: float | None) -> Iterator[None]:
    """Limit all simulations within the context to so many seconds; None: counts bound them.

    Raises RangeError.
    """
    if seconds is None:
        yield
        return
    before = _Wall.end
    _Wall.end = time.monotonic() + SECONDS.check(seconds)
    try:
        yield
    finally:
        _Wall.end = before


@contextmanager
def aside() -> Iterator[None]:
    """Context in which counts alone bound what is simulated; its user holds it to the time by other means."""
    with _LOCK:
        _Wall.aside += 1
    try:
        yield
    finally:
        with _LOCK:
            _Wall.aside -= 1


def left() -> float:
    """Seconds until the time is up; infinite without a wall."""
    return math.inf if _Wall.end is None else _Wall.end - time.monotonic()


def given() -> bool:
    """True if there is a wall-clock limit."""
    return _Wall.end is not None and not _Wall.aside


def over() -> bool:
    """True if the time is up; never without a wall-clock limit."""
    return given() and left() < 0
