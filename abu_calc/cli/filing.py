"""The files that a command was asked for, written when all is computed."""

from collections.abc import Iterable, Iterator, Sized
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.errors import InputError, OutputError
from abu_calc.progress import Progress, Stage
from abu_calc.report.outcome import Outcome

if TYPE_CHECKING:
    from abu_calc.report.figures.figure import Figure


def write_files(outcome: Outcome, how: Delivery) -> bool:
    """Write all of them; False: there are none. Where one cannot be written, what was computed is told all the same."""
    if how.output is None and not outcome.further and not how.figures:
        return False
    from abu_calc.report.files import as_file
    from abu_calc.report.write import Target, write

    own = () if how.output is None else (Target(how.output, as_file(outcome, how.output.suffix.lower())),)
    try:
        with progress(how) as tell:
            named = _figures(outcome, how)
            files = chain(outcome.further, own, (Target(path, _drawn(figure, path)) for figure, path in named))
            targets = (Target(path, _told(text, f"writing {path}", tell)) for path, text in files)
            write(targets, force=how.force)
    except (InputError, OutputError) as error:
        computed = f"What was computed: {outcome.status}, exit status {outcome.exit_status} without the file."
        error.remedy = " ".join(part for part in (error.remedy, computed) if part)
        raise
    return True


def _figures(outcome: Outcome, how: Delivery) -> "list[tuple[Figure, Path]]":
    """Requested figures; raises InputError for one that this result does not have."""
    if not how.figures:
        return []
    from abu_calc.report.figures.of_result import named

    there = outcome.extras().figures if outcome.extras else ()
    return [(named(outcome.command, there, name), path) for name, path in how.figures]


def _drawn(figure: "Figure", path: Path) -> Iterator[str | bytes]:
    from abu_calc.report.plotting.draw import figure_file

    yield figure_file(figure, path.suffix.lower())


def _told(text: str | bytes | Iterable[str | bytes], what: str, tell: Progress) -> Iterator[str | bytes]:
    """The pieces of a text, each told before it is written."""
    pieces = [text] if isinstance(text, (str, bytes)) else text
    total = len(pieces) if isinstance(pieces, Sized) else 0
    for done, piece in enumerate(pieces):
        tell(Stage(what, done / total) if total else what)
        yield piece
