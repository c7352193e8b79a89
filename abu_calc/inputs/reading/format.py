"""Format of the files that people write: its number, and the keys that changed from one number to the next.

A file may say `format = 1` above its tables. The number goes up when a key changes, and with nothing else. A file
without the number is read as one of the newest format; one of a newer format than this version knows is refused, for
its keys may mean something else.
"""

from collections.abc import Iterator, Mapping
from typing import Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass

FORMAT: Final = 1
"""Newest format of files, that of this version."""
KEY: Final = "format"


@dataclass(frozen=True)
class KeyChange:
    """A key that has another name from a format on: its path without places in lists, the new name, and why.

    Values never change with a key: a key in another unit is another key, and both stay known.
    """

    format: int
    path: tuple[str, ...]
    name: str
    why: str


CHANGES: Final[tuple[KeyChange, ...]] = ()
"""All changes, in the order of formats. None yet: keys of format 1 are those of the first version."""


def format_of(content: Mapping[str, object], place: Place) -> int | None:
    """The format that a file says it has; None if it says none. Raises InputError for a newer or an impossible one.

    >>> format_of({"format": 1}, Place("a.toml")), format_of({}, Place("a.toml"))
    (1, None)
    """
    if KEY not in content:
        return None
    given = content[KEY]
    if isinstance(given, bool) or not isinstance(given, int) or given < 1:
        from abu_calc.inputs.reading.text import shown_short

        raise InputError(
            "not the number of a format", place=place, found=shown_short(given), allowed=f"1 … {FORMAT}",
            remedy=f"write format = {FORMAT}, or leave the key out",
        )  # fmt: skip
    if given > FORMAT:
        raise InputError(
            "the file has a newer format than this version of abu-calc knows", place=place, found=str(given),
            allowed=f"1 … {FORMAT}", remedy="install a newer abu-calc: pip install --upgrade abu-calc",
        )  # fmt: skip
    return given


def renamed(path: tuple[str, ...], changes: tuple[KeyChange, ...] = CHANGES) -> KeyChange | None:
    """The change of a key, by its path without places in lists."""
    return next((change for change in changes if change.path == path), None)


def since(given: int | None, changes: tuple[KeyChange, ...] = CHANGES) -> Iterator[KeyChange]:
    """Changes after a format; all of them for a file that says none."""
    return (change for change in changes if change.format > (given or 0))
