"""Documents and the bytes that a name stands for: a regular file, standard input as "-", or a preset of the package."""

import os
import stat
import sys
from pathlib import Path
from typing import Final, NamedTuple

from abu_calc.foundation.call_files import enter
from abu_calc.foundation.errors import InputError, Place

SUFFIX: Final = ".toml"


class Document(NamedTuple):
    """A file whose TOML is right; its tables are not looked at yet."""

    file: str
    """Name as it was given: a path, or a preset; empty if there is none."""
    text: str
    sha256: str
    content: dict[str, object]


def folder() -> Path:
    """Folder of the presets: inside the installed package, or beside it in a checkout."""
    package = Path(__file__).resolve().parents[2]
    inside = package / "presets"
    return inside if inside.is_dir() else package.parent / "presets"


def names() -> tuple[str, ...]:
    """The names of all presets, in alphabetical order: their files without suffix."""
    return tuple(sorted(path.stem for path in folder().glob(f"*{SUFFIX}")))


def text_of(name: str) -> str:
    """The text of a preset. Raises InputError for what is the name of none, a file's among it."""
    if path := find(name):
        return path.read_text(encoding="utf-8")
    from abu_calc.inputs.reading.suggestions import nearest

    known = names()
    close = nearest(name, known)
    raise InputError(
        "no preset of this name",
        found=name,
        allowed=", ".join(known),
        remedy=f'the nearest is "{close}"' if close else None,
    )


def find(name: str) -> Path | None:
    """The file of a preset, or None where there is none of this name."""
    return folder() / f"{name}{SUFFIX}" if name in names() else None


LARGEST_FILE: Final = 200_000
"""Bytes of the largest file that is read; ours have a few thousand."""
STANDARD_INPUT: Final = "-"


def bytes_of(source: str) -> bytes:
    """Bytes of a source.

    Raises InputError if it is no file, cannot be read, or is too large.
    """
    raw = _standard_input() if source == STANDARD_INPUT else regular_file(_path(source))
    if len(raw) > LARGEST_FILE:  # of standard input
        raise InputError("the file is too large", place=Place(source), allowed=f"at most {LARGEST_FILE} bytes")
    return raw


def _standard_input() -> bytes:
    if sys.stdin is None or sys.stdin.closed:
        raise InputError("standard input is closed", place=Place(STANDARD_INPUT), remedy="Name a file.")
    raw: bytes = sys.stdin.buffer.read(LARGEST_FILE + 1)
    return raw


def regular_file(path: Path, most: int = LARGEST_FILE) -> bytes:
    """Bytes of a file. Raises InputError for what is no regular file, cannot be read, or is too large.

    A pipe or a device, which may never end or begin, is not waited for.
    """
    place = Place(str(path))
    try:
        enter(path, written=False)
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(handle, "rb") as stream:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                remedy = "Save it as a file, or give it on standard input and name that: -"
                raise InputError("this is not a regular file", place=place, remedy=remedy)
            raw = stream.read(most + 1)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror or error}", place=place) from None
    except ValueError:  # a NUL in the name
        raise InputError("not a file name", place=place) from None
    if len(raw) > most:
        raise InputError("the file is too large", place=place, allowed=f"at most {most} bytes")
    return raw


def _path(source: str) -> Path:
    """The file that is meant: one that exists before a preset."""
    path, place = Path(source), Place(source or None)
    try:
        if source and path.is_dir():
            raise InputError("a folder, not a file", place=place, remedy="name the machine file inside")
        if source and path.exists():
            return path
    except (OSError, ValueError):
        raise InputError("not a file name", place=place) from None
    if preset := find(source):
        return preset
    from abu_calc.inputs.reading.suggestions import nearest

    known, beside = names(), path.with_name(f"{path.name}{SUFFIX}") if path.name else path
    if path.name and beside.is_file():
        remedy = f"Did you mean {beside}?"
    elif close := nearest(path.stem, known):
        remedy = f'the nearest preset is "{close}"'
    else:
        remedy = f"presets: {', '.join(known)}" if known else "`abu init FILE` writes a new file"
    raise InputError("no such file, and no preset of this name", place=place, remedy=remedy)
