"""Delivery of a command's outcome to people and programs.

`--figure NAME=FILE` asks for figures as files of their own. Names and places that cannot work are refused before
anything is computed.

Progress of long work on one line of standard error: the current stage, the share done and the time left.

The line appears on a terminal only, and not with --quiet.
"""

import os
import shutil
import sys
import threading
from collections.abc import Callable, Iterable, Iterator, Sized
from contextlib import contextmanager, suppress
from functools import cache
from itertools import cycle
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, Final, NamedTuple, TextIO

from abu_calc.foundation.errors import InputError, Place, escaped, shortened
from abu_calc.foundation.parallel import EndedBySignal, status_of
from abu_calc.foundation.progress import Progress, Stage, silent
from abu_calc.registry import known, named

if TYPE_CHECKING:
    from abu_calc.reporting.charts.chart import Figure
    from abu_calc.reporting.outcome import Outcome


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


OPTION: Final = "--figure"
PLACE: Final = Place(key=OPTION)


def asked_figures(given: Iterable[str]) -> tuple[tuple[str, Path], ...]:
    """Names and files."""
    return tuple(_pair(argument) for argument in given)


def _pair(text: str) -> tuple[str, Path]:
    name, sign, file = text.partition("=")
    if not (name.strip() and sign and file.strip()):
        raise InputError(
            "not a figure and its file", place=PLACE, found=text, allowed="NAME=FILE, such as levels=levels.svg"
        )
    return name.strip(), Path(file.strip())


def check_figures(command: str, figures: Iterable[tuple[str, Path]], *, force: bool) -> None:
    """Refuse unknown names, files that could not be written, and what is not installed."""
    from abu_calc.reporting.charts.matplotlib_draw import SUFFIXES, check_matplotlib
    from abu_calc.reporting.outcome import check_target

    for name, path in figures:
        figure = known(command, name)
        check_target(path, force=force, suffixes=SUFFIXES, option=OPTION)
        if not (figure.drawn and path.suffix.lower() == ".svg"):
            check_matplotlib(f"{path.suffix.lower()} files of {name}")


class Delivery(NamedTuple):
    """Requested delivery of an outcome: the options that all commands share."""

    json: bool = False
    outputs: tuple[Path, ...] = ()
    force: bool = False
    quiet: bool = False
    color: bool = True
    full: bool = False
    figures: tuple[tuple[str, Path], ...] = ()

    def check(self, command: str, drawn: tuple[str, ...] = ()) -> None:
        """Refuse before computing what could not be written after; `drawn`: formats of the command's drawing."""
        if self.figures:
            check_figures(command, self.figures, force=self.force)
        if not self.outputs:
            return
        from abu_calc.reporting.files import FORMATS, check_extra
        from abu_calc.reporting.outcome import check_target

        for path in self.outputs:
            check_target(path, force=self.force, suffixes=(*FORMATS, *drawn), option="--output")
            check_extra(path.suffix.lower())


def write_files(outcome: "Outcome", how: Delivery) -> bool:
    """Write all that can be written; False: there are none. For a file that cannot, the computed result is told."""
    if not how.outputs and not outcome.further and not how.figures:
        return False
    from abu_calc.reporting.files import as_file, further_sheets
    from abu_calc.reporting.outcome import Target, write

    sheets = [sheet for path in how.outputs for sheet in further_sheets(outcome, path)]
    figures = cache(lambda: outcome.extras().figures if outcome.extras else ())
    files = (
        *outcome.further,
        *(Target(path, _made(as_file, outcome, path.suffix.lower())) for path in how.outputs),
        *(Target(path, _made(_sheet, path, text, how.force)) for path, text in sheets),
        *(Target(path, _made(_drawn, outcome.command, figures, name, path)) for name, path in how.figures),
    )
    try:
        with progress(quiet=how.quiet) as tell:
            write((Target(path, _told(text, f"writing {path}", tell)) for path, text in files), force=how.force)
    except InputError as error:
        computed = (
            f"The computed result is {outcome.status}; without the file, the exit status is {outcome.exit_status}."
        )
        error.remedy = " ".join(part for part in (error.remedy, computed) if part)
        raise
    return True


def _made(make: Callable[..., str | bytes], *arguments: Any) -> Iterator[str | bytes]:
    """The text of a file, made when it is written."""
    yield make(*arguments)


def _sheet(path: Path, text: str, force: bool) -> str:
    """The text of a further sheet, whose file was not asked for by name."""
    from abu_calc.reporting.outcome import check_target

    check_target(path, force=force)
    return text


def _drawn(command: str, figures: "Callable[[], tuple[Figure, ...]]", name: str, path: Path) -> bytes | str:
    """File of a figure; raises InputError for one that the result does not have."""
    from abu_calc.reporting.charts.matplotlib_draw import figure_file

    return figure_file(named(command, figures(), name), path.suffix.lower())


def _told(text: str | bytes | Iterable[str | bytes], what: str, tell: Progress) -> Iterator[str | bytes]:
    """The pieces of a text, each told before it is written."""
    pieces = [text] if isinstance(text, (str, bytes)) else text
    total = len(pieces) if isinstance(pieces, Sized) else 0
    for done, piece in enumerate(pieces):
        tell(Stage(what, done / total) if total else what)
        yield piece


def deliver(outcome: "Outcome", how: Delivery, *, wrote: bool = False) -> int:
    """Print the result, return the exit status; `wrote`: files were written, as who interrupts is told."""
    try:
        _print(outcome, how)
    except (KeyboardInterrupt, EndedBySignal) as ended:
        if not wrote:
            raise
        print("Interrupted; the files were written.", file=sys.stderr)
        sys.exit(status_of(ended))
    return outcome.exit_status


def _print(outcome: "Outcome", how: Delivery) -> None:
    """Print an outcome on standard output; if that is for programs, warnings go to standard error."""
    if how.json:
        from abu_calc.reporting.outcome import document, to_json

        print(to_json(document(outcome)))
        for warning in () if how.quiet else outcome.warnings:
            print(f"warning: {escaped(warning)}", file=sys.stderr)
    elif how.quiet:
        pass
    elif outcome.plain is not None:
        print(outcome.plain, end="")
    else:
        from abu_calc.reporting.screen import show

        shown = outcome.blocks if how.full else outcome.screen
        show(shown, color=how.color and not os.environ.get("NO_COLOR"))
