"""Reading a recorded motion: which kind of file it is, and what is wrong with it before it is looked into."""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np

from abu_calc.errors import InputError, Place
from abu_calc.spec.plain import found_as
from abu_calc.spec.recording import QUANTITIES, Asked, Recording
from abu_calc.spec.source import regular_file

SUFFIXES: Final = (".csv", ".wav", ".txt", ".tsv", ".dat")
LARGEST: Final = 2**30
"""Bytes of a file that is read."""


def read_recording(
    file: str | os.PathLike[str], quantity: str | None = None, scale: float | None = None, channels: Sequence[str] = ()
) -> Recording:
    """Reads a CSV (time and up to three columns of a motion) or a WAV file.

    `scale`: m/s² (velocity: m/s, displacement: m) per unit of the file, for WAV per full scale. `channels`: names or
    numbers, from 1, of the columns or channels to take. Raises InputError with file, line and column for what is wrong.
    """
    path, content = _content(file)
    known = next((name for name in QUANTITIES if name == quantity), None)
    if quantity is not None and known is None:
        allowed = ", ".join(QUANTITIES)
        raise InputError("not a quantity of motion", place=Place(key="quantity"), found=quantity, allowed=allowed)
    if scale is not None and not (np.isfinite(scale) and scale > 0):
        raise InputError(
            "not a scale", place=Place(key="scale"), found=f"{scale:g}", allowed="a number above 0",
            remedy="SI per unit of the file: m/s² for accelerations, m/s for velocities.",
        )  # fmt: skip
    asked = Asked(known, scale, tuple(channels))
    if content[:4] in (b"RIFF", b"RIFX", b"RF64") or Path(path).suffix.lower() == ".wav":
        from abu_calc.spec.recording_wav import wav_recording

        return wav_recording(path, content, asked)
    from abu_calc.spec.recording_csv import csv_recording

    return csv_recording(path, content, asked)


def is_recording(file: str) -> bool:
    """True if a file's name is that of a recording; others hold machines or scenes, or are presets."""
    return Path(file).suffix.lower() in SUFFIXES


def _content(file: str | os.PathLike[str]) -> tuple[str, bytes]:
    """The name of a file as text, and its bytes."""
    if not isinstance(file, (str, os.PathLike)):
        raise InputError("not the name of a file", place=Place(key="source"), found=found_as(file))
    path = os.fspath(file)
    try:
        content = regular_file(Path(path), LARGEST)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place=Place(path)) from None
    if len(content) > LARGEST:
        raise InputError("the file is too large", place=Place(path), allowed=f"at most {LARGEST} bytes")
    if not content.strip():
        raise InputError("the file is empty", place=Place(path))
    return path, content
