"""Number of the format of the files that people write.

A file may say `format = 1` above its tables. The number goes up when a key changes, and with nothing else. A file
without the number is read as one of the newest format; one of a newer format than this version knows is refused, for
its keys may mean something else.
"""

from typing import Final

from abu_calc.foundation.errors import InputError, Place

FORMAT: Final = 1
"""Newest format of files, that of this version."""
KEY: Final = "format"


def check_format(given: object, place: Place) -> None:
    """Refuse a newer format, and what is no number of a format."""
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
