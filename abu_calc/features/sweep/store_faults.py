"""Errors of a store in words: each names the store, the fault, and how to go on."""

import sqlite3
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from abu_calc.foundation.errors import InputError, OutputError, Place, escaped, shortened

PLACE: Final = Place(key="store")

GO_ON: Final = "go on with --resume"
WORDS: Final = {
    "SQLITE_FULL": ("the disk is full", f"Make room, then {GO_ON}."),
    "SQLITE_BUSY": ("another program keeps it locked", f"Close that program, then {GO_ON}."),
    "SQLITE_LOCKED": ("another program keeps it locked", f"Close that program, then {GO_ON}."),
    "SQLITE_NOTADB": ("this is no store of a sweep", "Name another file."),
    "SQLITE_READONLY": ("it cannot be written", f"Make it and its folder writable, then {GO_ON}."),
    "SQLITE_CANTOPEN": ("it cannot be opened", "Make it and its folder readable and writable, or name another file."),
    "SQLITE_IOERR": (
        "the system refuses to read or write it (a full disk, a limit on the size of files, a disk that fails)",
        f"Make room or lift the limit, then {GO_ON}.",
    ),
}
"""Words for the errors of SQLite, by their primary code."""
MEANT: Final = ("members", "runs", "study")
"""Tables that make a file a store."""


def fault(path: Path, text: str, remedy: str) -> OutputError:
    """The error about a store."""
    return OutputError(f"{escaped(str(path))}: {text}", place=PLACE, remedy=remedy)


def damaged(path: Path, how: object) -> OutputError:
    """The error about a store whose content is not what abu-calc wrote."""
    return fault(
        path, f"it is damaged: {shortened(escaped(str(how)))}", "Put a copy in its place, or delete it and begin anew."
    )


@contextmanager
def faults_of(path: Path) -> Iterator[None]:
    """Turn what SQLite, JSON and values of wrong types raise into the error about this store."""
    try:
        yield
    except sqlite3.Error as error:
        code = "_".join(str(getattr(error, "sqlite_errorname", "")).split("_")[:2])
        if code not in WORDS:
            raise damaged(path, error) from None
        text, remedy = WORDS[code]
        raise fault(path, text, remedy) from None
    except OSError as error:
        raise fault(path, f"the system refuses it: {error.strerror or error}", "Name another file.") from None
    except RecursionError:
        raise damaged(path, "its study is nested without end") from None
    except (ValueError, TypeError, LookupError, AttributeError, OverflowError) as error:
        raise damaged(path, f"{type(error).__name__}: {error}") from None


def checked_path(given: str | Path) -> Path:
    """A path where a store can be, whether or not it is there; raises OutputError."""
    text, path = str(given), Path(given)
    if not text.strip() or text == ":memory:":
        raise fault(path, "nothing kept in memory outlives the sweep", "Name a file, as members.sqlite.")
    if "\0" in text or not text.isprintable() or not _encodable(text):
        raise fault(path, "not the name of a file", "Name a file, as members.sqlite.")
    with faults_of(path):
        try:
            kind = path.stat().st_mode
        except FileNotFoundError:
            kind = stat.S_IFREG
        if stat.S_ISDIR(kind):
            raise fault(path, "this is a folder", "Name a file in it.")
        if not stat.S_ISREG(kind):
            raise fault(path, "this is no regular file", "Name another file.")
        if not path.absolute().parent.is_dir():
            raise fault(path, "the folder does not exist", "Make it first.")
    return path


def refuse_foreign(path: Path, tables: set[str]) -> None:
    """Raise InputError for a file of SQLite that some other program made."""
    if not set(MEANT) <= tables:
        raise InputError(
            f"{escaped(str(path))}: this is no store of a sweep, it holds other tables",
            place=PLACE,
            found=", ".join(sorted(tables)),
            allowed=", ".join(MEANT),
            remedy="Name another file.",
        )


def _encodable(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True
