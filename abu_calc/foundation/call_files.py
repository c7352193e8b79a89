"""Files of one call: it writes none twice, and none that it reads.

`one_call` opens the list of files, `will_write` and `will_read` enter one. Outside of a call, as in Python, there is no
list.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Final, NamedTuple

from abu_calc.foundation.errors import OutputError, Place


class CallFiles(NamedTuple):
    """Files that a call reads, and those that it writes."""

    read: list[Path]
    written: list[Path]


_CALL: Final[ContextVar[CallFiles | None]] = ContextVar("files of the call", default=None)


@contextmanager
def one_call() -> Iterator[None]:
    """Context of one call."""
    token = _CALL.set(CallFiles([], []))
    try:
        yield
    finally:
        _CALL.reset(token)


def will_read(path: Path) -> None:
    """Enter a file that is read; raises OutputError if the call writes it."""
    if (call := _CALL.get()) is not None:
        for other in call.written:
            _refuse(other, path, "the command reads the file that it would write")
        call.read.append(path)


def will_write(path: Path) -> None:
    """Enter a file that will be written; raises OutputError if the call reads it, or writes it already."""
    if (call := _CALL.get()) is not None:
        for other in call.written:
            _refuse(path, other, "two outputs name the same file")
        for other in call.read:
            _refuse(path, other, "the command reads the file that it would write")
        call.written.append(path)


def _refuse(output: Path, other: Path, message: str) -> None:
    if same_file(output, other):
        found = None if output == other else str(other)
        raise OutputError(message, place=Place(str(output)), found=found, remedy="Give the output another name.")


def same_file(path: Path, other: Path) -> bool:
    """Tell whether both paths lead to the same file, through links and other spellings, whether or not it exists."""
    try:
        return path.samefile(other)
    except OSError:  # one of them does not exist
        ends = Path(os.path.realpath(path)), Path(os.path.realpath(other))
    return ends[0] == ends[1] or (str(ends[0]).casefold() == str(ends[1]).casefold() and _ignores_case(ends[0].parent))


def _ignores_case(folder: Path) -> bool:
    """True if the file system takes capitals and small letters for the same."""
    swapped = Path(str(folder).swapcase())
    try:
        return swapped != folder and folder.samefile(swapped)
    except OSError:
        return False
