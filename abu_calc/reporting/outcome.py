"""Return value of a command, and the one JSON document it becomes.

Writing of files: whole or not at all, and never over another's file that appeared meanwhile.
"""

import contextlib
import math
import os
import stat
import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from abu_calc.foundation.call_files import enter
from abu_calc.foundation.checks import Check, Status
from abu_calc.foundation.errors import AbuError, InputError, OutputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block

if TYPE_CHECKING:
    from abu_calc.reporting.charts.chart import MakesExtras
    from abu_calc.reporting.drawings.shapes import Drawing
    from abu_calc.reporting.solids.assembly import SolidAssembly
    from abu_calc.simulation.result import Provenance, Result


SCHEMA = 1
EXIT_STATUS: dict[Status, int] = {"pass": 0, "fail": 1, "not-done": 1}


@dataclass(frozen=True)
class Outcome:
    """The frozen result of a command: numbers in user units, checks, and how they are shown."""

    command: str
    content: "Result | dict[str, Any]"
    """The typed result of a study, or what a command without a study answers."""
    view: tuple[Block, ...] | Callable[[], tuple[Block, ...]]
    """Blocks, or what makes them where text is wanted."""
    notes: tuple[str, ...] = ()
    """Warnings of a command without a study."""
    short: Callable[[], tuple[Block, ...]] | None = None
    """The one screen that stands in a terminal for blocks that take more."""
    drawings: "Callable[[], tuple[Drawing, ...]] | None" = None
    """Function that makes the sheets of a drawing; None if the command has none."""
    solids: "Callable[[], SolidAssembly] | None" = None
    """Function that makes the parts as solids; None if the command has none."""
    extras: "MakesExtras | None" = None
    """Function that makes the figures and the calculation note of a page; None if the command has none."""
    settings: tuple[tuple[str, str], ...] = ()
    """The command with its arguments and options, each with its value; files that it writes are left out."""
    plain: str | None = None
    """Text that stands for itself (a file, a schema): printed and written as it is, instead of the blocks."""
    plain_suffix: str = ".json"
    """The ending of files that hold such a text."""
    further: tuple["Target", ...] = ()
    """Files that were asked for beside the result's own."""

    @cached_property
    def result(self) -> Any:
        """The result as the JSON document has it."""
        return self.content if isinstance(self.content, dict) else self.content.to_dict()

    @cached_property
    def provenance(self) -> "Provenance":
        """Provenance of the result; of this day if it stands on no file."""
        return _today() if isinstance(self.content, dict) else self.content.provenance

    @property
    def checks(self) -> tuple[Check, ...]:
        """Checks of the result."""
        return () if isinstance(self.content, dict) else self.content.checks

    @property
    def model(self) -> dict[str, Any]:
        """SI numbers behind the result."""
        return {} if isinstance(self.content, dict) else self.content.model.to_dict()

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of the result."""
        return self.notes if isinstance(self.content, dict) else self.content.warnings

    @property
    def status(self) -> Status:
        """The worst of the checks; a command without a study passes."""
        return "pass" if isinstance(self.content, dict) else self.content.status

    @property
    def blocks(self) -> tuple[Block, ...]:
        """The whole report."""
        return self.view() if callable(self.view) else self.view

    @property
    def screen(self) -> tuple[Block, ...]:
        """The report on one screen; the whole one where that is short anyway."""
        return self.short() if self.short else self.blocks

    @property
    def exit_status(self) -> int:
        """0 when every check passed, else 1."""
        return EXIT_STATUS[self.status]


def document(outcome: Outcome) -> dict[str, Any]:
    """The envelope of a result."""
    return {
        "abu": _head(outcome.command, outcome.provenance),
        "input": outcome.provenance.input,
        "status": outcome.status,
        "checks": [asdict(check) | {"change": _change(check.overrides)} for check in outcome.checks],
        "result": outcome.result,
        "model": outcome.model,
        "warnings": list(outcome.warnings),
    }


def _change(entries: tuple[str, ...]) -> dict[str, object] | None:
    """Everything that an action replaces, by key path; None where it replaces nothing."""
    from abu_calc.inputs.reading.overrides import parse_override

    return {override.key: override.value for override in map(parse_override, entries)} if entries else None


def error_document(command: str, error: BaseException) -> dict[str, Any]:
    """The envelope of an error."""
    facts: dict[str, Any] = {"kind": error.kind if isinstance(error, AbuError) else "bug", "message": str(error)}
    if isinstance(error, InputError):
        facts |= {
            "message": error.message,
            "file": error.place.file,
            "line": error.place.line,
            "key": error.place.key,
            "found": error.found,
            "allowed": error.allowed,
            "remedy": error.remedy,
        }
    return {"abu": _head(command, _today()), "input": None, "status": "not-done", "checks": [],
            "result": None, "model": {}, "warnings": [], "error": facts}  # fmt: skip


def _today() -> "Provenance":
    from abu_calc.simulation.result import Provenance

    return Provenance.today()


def _head(command: str, provenance: "Provenance") -> dict[str, Any]:
    return {"version": provenance.version, "command": command, "schema": SCHEMA, "date": provenance.date}


def to_json(content: dict[str, Any]) -> str:
    """One JSON document; refuses NaN and infinities, which no result may hold; ASCII, so every console can take it."""
    import json

    return json.dumps(content, allow_nan=False, indent=2)


def finite(value: float | None) -> float | None:
    """A number for JSON: null where it is not finite."""
    return value if value is not None and math.isfinite(value) else None


class Target(NamedTuple):
    """A file to be written, and its text, which may come in pieces, or its bytes."""

    path: Path
    text: str | bytes | Iterable[str | bytes]


def check_target(path: Path, *, force: bool, suffixes: tuple[str, ...] = (), option: str | None = None) -> None:
    """Refuse early what could not be written later: unknown suffix, missing folder, existing file without --force, a
    file that the same call reads or writes already.

    `option`: that names the file, for errors about names that no file can have.
    """
    place = Place(str(path))
    if "\0" in str(path):
        raise OutputError("not a file name", place=place)
    if suffixes and path.suffix.lower() not in suffixes:
        picture = path.suffix.lower() in (".png", ".jpg", ".jpeg") and option == "--output"
        remedy = "Figures alone are pictures: --figure NAME=FILE.png." if picture else None
        raise OutputError(
            "unknown format", found=str(path), allowed="a name ending in " + " ".join(suffixes), remedy=remedy
        )
    try:
        if path.is_dir():
            raise OutputError("this is a folder", place=place, remedy="Give a file's name.")
        if not path.absolute().parent.is_dir():
            raise OutputError("the folder does not exist", place=place, remedy="Make it first.")
        if not os.access(_final(path).parent, os.W_OK):
            raise OutputError("the folder cannot be written", place=place, remedy="Name a file in another folder.")
        _check_kind(path)
        if os.path.lexists(path) and not force:
            raise _exists(path)
        enter(path, written=True)
    except OSError as error:
        named = Place(str(path), key=option)
        raise OutputError(f"cannot be written: {error.strerror or error}", place=named) from None


def write(targets: Iterable[Target], *, force: bool) -> None:
    """Write files, all of them beside their places first, then put into these; what can be written is.

    Without `force` none takes the place of a file, even one that has come since `check_target` looked. Symbolic links
    stay, the file they point to is replaced. Raises an error that names the files that were not written, and those that
    were.
    """
    ready: list[tuple[Path, Path]] = []
    faults, written = list[InputError](), list[str]()
    try:
        for path, text in targets:
            with _noted(faults, path):
                ready.append((_beside(path, [text] if isinstance(text, (str, bytes)) else text), path))
        for temporary, path in ready:
            with _noted(faults, path):
                _place(temporary, path, force=force)
                written.append(str(path))
    finally:
        for temporary, _ in ready:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
    if faults:
        error = faults[0] if len(faults) == 1 else OutputError("\n".join(map(str, faults)))
        named = f"Written is: {', '.join(written)}." if written else None
        error.remedy = " ".join(part for part in (error.remedy, named) if part) or None
        raise error


@contextlib.contextmanager
def _noted(faults: list[InputError], path: Path) -> Iterator[None]:
    """Note the error about one file, so that the others are written."""
    try:
        yield
    except InputError as error:
        faults.append(error)
    except OSError as error:
        faults.append(OutputError(f"cannot be written: {error.strerror or error}", place=Place(str(path))))


def _exists(path: Path) -> OutputError:
    remedy = "Choose another name, or overwrite it with --force."
    return OutputError("exists already", place=Place(str(path)), remedy=remedy)


def _check_kind(path: Path) -> None:
    """Refuse pipes, devices and sockets: nothing can be put into their place."""
    with contextlib.suppress(FileNotFoundError):
        if not stat.S_ISREG(path.stat().st_mode):
            raise OutputError("this is not a regular file", place=Place(str(path)), remedy="Give a file's name.")


def _beside(path: Path, pieces: Iterable[str | bytes]) -> Path:
    """A file with the text in UTF-8, in the folder where it will stand."""
    final = _final(path)
    handle, name = tempfile.mkstemp(prefix=".abu-", suffix=final.suffix, dir=final.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.writelines(piece.encode("utf-8", "replace") if isinstance(piece, str) else piece for piece in pieces)
        Path(name).chmod(stat.S_IMODE(final.stat().st_mode) if final.exists() else 0o666 & ~_umask())
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise
    return Path(name)


def _final(path: Path) -> Path:
    """Target of a path, through symbolic links."""
    return Path(os.path.realpath(path)) if path.is_symlink() else path.absolute()


def _place(temporary: Path, path: Path, *, force: bool) -> None:
    """Put a file into its place, in one step."""
    _check_kind(path)
    if force:
        temporary.replace(_final(path))
        return
    try:
        _put_alone(temporary, path)
    except FileExistsError:
        raise _exists(path) from None


def _put_alone(temporary: Path, path: Path) -> None:
    """The same where nothing stands yet; raises FileExistsError where something does."""
    if os.name == "nt":
        temporary.rename(path)  # which there replaces nothing
        return
    try:
        path.hardlink_to(temporary)
    except FileExistsError:
        raise
    except OSError:  # a system of files without links: take the name first
        os.close(os.open(path, os.O_CREAT | os.O_EXCL | os.O_WRONLY))
        temporary.replace(path)


def _umask() -> int:
    current = os.umask(0)
    os.umask(current)
    return current
