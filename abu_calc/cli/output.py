"""Delivery of a command's outcome to people and programs.

`--figure NAME=FILE` asks for figures as files of their own. Names and places that cannot work are refused before
anything is computed.
"""

import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sized
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from abu_calc.cli.progress import progress
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.escaping import escaped
from abu_calc.foundation.interruption import EndedBySignal, status_of
from abu_calc.foundation.progress import Progress, Stage
from abu_calc.registry import known, named

if TYPE_CHECKING:
    from abu_calc.reporting.charts.figure import Figure
    from abu_calc.reporting.outcome import Outcome

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
    from abu_calc.reporting.write import check_target

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
        from abu_calc.reporting.write import check_target

        for path in self.outputs:
            check_target(path, force=self.force, suffixes=(*FORMATS, *drawn), option="--output")
            check_extra(path.suffix.lower())


def write_files(outcome: "Outcome", how: Delivery) -> bool:
    """Write all that can be written; False: there are none. For a file that cannot, the computed result is told."""
    if not how.outputs and not outcome.further and not how.figures:
        return False
    from abu_calc.reporting.files import as_file, further_sheets
    from abu_calc.reporting.write import Target, write

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
    from abu_calc.reporting.write import check_target

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
        from abu_calc.reporting.text import show

        shown = outcome.blocks if how.full else outcome.screen
        show(shown, color=how.color and not os.environ.get("NO_COLOR"))
