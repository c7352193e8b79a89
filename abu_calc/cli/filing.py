"""The files that a command was asked for, written when all is computed."""

from collections.abc import Iterable, Iterator, Sized

from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from abu_calc.errors import OutputError
from abu_calc.progress import Progress, Stage
from abu_calc.report.outcome import Outcome


def write_files(outcome: Outcome, how: Delivery) -> bool:
    """Write all of them; False: there are none. Where one cannot be written, what was computed is told all the same."""
    if how.output is None and not outcome.further:
        return False
    from abu_calc.report.files import as_file
    from abu_calc.report.write import Target, write

    own = () if how.output is None else (Target(how.output, as_file(outcome, how.output.suffix.lower())),)
    try:
        with progress(how) as tell:
            targets = (Target(path, _told(text, f"writing {path}", tell)) for path, text in (*outcome.further, *own))
            write(targets, force=how.force)
    except OutputError as error:
        computed = f"What was computed: {outcome.status}, exit status {outcome.exit_status} without the file."
        error.remedy = " ".join(part for part in (error.remedy, computed) if part)
        raise
    return True


def _told(text: str | Iterable[str], what: str, tell: Progress) -> Iterator[str]:
    """The pieces of a text, each told before it is written."""
    pieces = [text] if isinstance(text, str) else text
    total = len(pieces) if isinstance(pieces, Sized) else 0
    for done, piece in enumerate(pieces):
        tell(Stage(what, done / total) if total else what)
        yield piece
