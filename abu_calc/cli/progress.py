"""Progress of long work on one line of standard error: the current stage, the share done and the time left.

The line appears on a terminal only, and not with --quiet.
"""

import os
import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from itertools import cycle
from time import monotonic
from typing import Final, TextIO

from abu_calc.foundation.escaping import escaped, shortened
from abu_calc.foundation.progress import Progress, Stage, silent

SOON = 0.7
"""Seconds that pass in silence: most commands are done by then."""

EACH: Final = 0.2
"""Seconds between two looks."""

KNOWN_SHARE: Final = 0.02
KNOWN_S: Final = 0.5
"""Share and seconds of a stage that must be done before its remaining time is shown."""

SIGNS: Final = "-\\|/"


@contextmanager
def progress(*, quiet: bool) -> Iterator[Progress]:
    """Takes texts and shows the last one with the time since the start; the line goes at the end."""
    if quiet or not sys.stderr.isatty() or os.environ.get("TERM") == "dumb":
        yield silent
        return
    line = _Line(sys.stderr)
    line.start()
    try:
        yield line.tell
    finally:
        line.end()


class _Line(threading.Thread):
    """The line, written again and again until the work ends."""

    def __init__(self, terminal: TextIO) -> None:
        super().__init__(daemon=True)
        self._terminal = terminal
        self._over = threading.Event()
        self._begun = monotonic()
        self._stage = _Stage("", self._begun, 0.0)
        self._shown = 0

    def tell(self, text: str) -> None:
        """Set the text of the current task."""
        self._stage = self._stage.then(text)

    def run(self) -> None:
        """Look after look."""
        self._over.wait(SOON)
        with suppress(OSError, ValueError):  # a terminal that is gone
            for sign in cycle(SIGNS):
                if self._over.wait(EACH):
                    break
                room = max(shutil.get_terminal_size().columns - 1, 1)
                if self._stage.text:
                    self._write(f"{sign} {self._text(room - 2)}"[:room])
            if self._shown:
                self._write("")

    def end(self) -> None:
        """No more of it."""
        self._over.set()
        self.join()

    def _text(self, room: int) -> str:
        """The numbers whole, of the words as many as there is room for."""
        stage, now = self._stage, monotonic()
        share, left = stage.share, stage.left(now)
        done = f", {100 * share:.0f} %" if share is not None else ""
        numbers = f"{done}, {clock(now - self._begun)}" + (f", {clock(left)} left" if left is not None else "")
        return shortened(escaped(stage.text), max(room - len(numbers), 1)) + numbers

    def _write(self, text: str) -> None:
        """Overwrite the previous text; blanks wipe it, which every terminal supports."""
        encoding = self._terminal.encoding or "utf-8"
        shown = text.encode(encoding, "replace").decode(encoding)
        self._terminal.write("\r" + shown.ljust(self._shown) + ("" if text else "\r"))
        self._terminal.flush()
        self._shown = len(shown)


class _Stage:
    """A text with the share that is done, and since when it goes on."""

    def __init__(self, text: str, begun: float, first: float) -> None:
        self.text, self.begun, self.first = str(text), begun, first
        self.share = text.share if isinstance(text, Stage) else None
        self.told = monotonic()

    def then(self, text: str) -> "_Stage":
        """The next text: of the same stage where its share has grown."""
        share = text.share if isinstance(text, Stage) else None
        same = share is not None and self.share is not None and share >= self.share
        return _Stage(text, *((self.begun, self.first) if same else (monotonic(), share or 0.0)))

    def left(self, now: float) -> float | None:
        """Seconds that the rest of the stage takes at its pace so far; None where that is not known."""
        if self.share is None or self.share - self.first < KNOWN_SHARE or now - self.begun < KNOWN_S:
            return None
        pace = (self.told - self.begun) / (self.share - self.first)
        return max(pace * (1 - self.share) - (now - self.told), 0.0)


def clock(seconds: float) -> str:
    """A time as people read it.

    >>> clock(7.4), clock(80), clock(4000)
    ('7 s', '1:20 min', '1:06 h')
    """
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    minutes = whole // 60
    return f"{minutes}:{whole % 60:02d} min" if minutes < 60 else f"{minutes // 60}:{minutes % 60:02d} h"
