"""Files of one call: it writes none twice, and none that it reads.

`one_call` opens the list of files, and `enter` adds one. Outside of a call, as in Python, there is no list.
"""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Final

from abu_calc.foundation.errors import OutputError, Place

_CALL: Final[ContextVar[list[tuple[Path, bool]] | None]] = ContextVar("files of the call", default=None)
"""Each file of the call, and whether it is written."""
READ: Final[set[Path]] = set()
"""Every file that this process has read, whatever the call."""
_SAME, _READ = "two outputs name the same file", "the command reads the file that it would write"


@contextmanager
def one_call() -> Iterator[None]:
    """Context of one call."""
    token = _CALL.set([])
    try:
        yield
    finally:
        _CALL.reset(token)


def enter(path: Path, *, written: bool) -> None:
    """Enter a file; raises OutputError if the call reads it and writes it, or writes it twice."""
    if not written:
        READ.add(path)
    call = _CALL.get()
    for other, others in call or ():
        if (written or others) and same_file(path, other):
            place = Place(str(path if written else other))
            raise OutputError(_SAME if written and others else _READ, place=place, remedy="Give it another name.")
    if call is not None:
        call.append((path, written))


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
