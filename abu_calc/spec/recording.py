"""A recorded motion: equally spaced samples of up to three axes of one place, from a CSV or a WAV file."""

import hashlib
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.errors import InputError, Place
from abu_calc.spec.plain import found_as

MotionQuantity = Literal["acceleration", "velocity", "displacement"]
QUANTITIES: Final[tuple[MotionQuantity, ...]] = ("acceleration", "velocity", "displacement")
MOST_AXES: Final = 3
SUFFIXES: Final = (".csv", ".wav", ".txt", ".tsv", ".dat")
LARGEST: Final = 2**30
"""Bytes of a file that is read."""


@dataclass(frozen=True, eq=False)
class Recording:
    """Samples [SI] of a quantity at `rate` [1/s]: axis by axis, in their order in the file, with their names.

    `told`: what a reader must know of how the file was taken; `simulated`: whether it is a trajectory of a simulation.
    """

    file: str
    sha256: str
    quantity: MotionQuantity
    names: tuple[str, ...]
    samples: tuple[NDArray[np.float64], ...]
    rate: float
    told: tuple[str, ...] = ()
    simulated: bool = False

    @property
    def duration(self) -> float:
        """Of the record [s]."""
        return len(self.samples[0]) / self.rate


@dataclass(frozen=True)
class Asked:
    """How a file is to be taken: quantity, SI per unit, which columns or channels; None: as the file says."""

    quantity: MotionQuantity | None = None
    scale: float | None = None
    channels: tuple[str, ...] = ()


def read_recording(
    file: str | os.PathLike[str], quantity: str | None = None, scale: float | None = None, channels: Sequence[str] = ()
) -> Recording:
    """Reads a CSV (time and up to three columns of a motion) or a WAV file.

    `scale`: m/s² (velocity: m/s, displacement: m) per unit of the file, for WAV per full scale. `channels`: names or
    numbers, from 1, of the columns or channels to take. Raises InputError with file, line and column for what is wrong.
    """
    path, content = _content(file)
    known = next((one for one in QUANTITIES if one == quantity), None)
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
    """Whether a file's name is that of a recording; others hold machines or scenes, or are presets."""
    return Path(file).suffix.lower() in SUFFIXES


def _content(file: str | os.PathLike[str]) -> tuple[str, bytes]:
    """The name of a file as text, and its bytes."""
    if not isinstance(file, (str, os.PathLike)):
        raise InputError("not the name of a file", place=Place(key="source"), found=found_as(file))
    path = os.fspath(file)
    try:
        size = Path(path).stat().st_size
        if size > LARGEST:
            raise InputError("the file is too large", place=Place(path), found=f"{size} bytes", allowed=f"{LARGEST}")
        content = Path(path).read_bytes()
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", place=Place(path)) from None
    if not content.strip():
        raise InputError("the file is empty", place=Place(path))
    return path, content


def recording(
    path: str, content: bytes, quantity: MotionQuantity, axes: Sequence[tuple[str, NDArray[np.float64]]], rate: float,
    told: Sequence[str] = (), *, simulated: bool = False,
) -> Recording:  # fmt: skip
    """What was read; refused with more than three axes, or one that stands still."""
    names, samples = tuple(name for name, _ in axes), tuple(values for _, values in axes)
    if len(axes) > MOST_AXES:
        raise InputError(
            "a place moves along three axes at most", place=Place(path), found=", ".join(names),
            remedy="Say which to take: --channels 1,2,3, or their names (Python: channels=).",
        )  # fmt: skip
    still = [name for name, values in axes if float(np.ptp(values)) == 0]
    if still:
        raise InputError(
            "the signal is the same number from start to end", place=Place(path, key=still[0]),
            remedy="A sensor that is not connected? Leave the channel out: --channels (Python: channels=).",
        )  # fmt: skip
    digest = hashlib.sha256(content).hexdigest()
    return Recording(path, digest, quantity, names, samples, rate, tuple(told), simulated)


def chosen(path: str, names: Sequence[str], channels: Sequence[str]) -> list[int]:
    """Indices of the columns or channels asked for, by name or by number from 1."""
    found = []
    for asked in channels:
        index = names.index(asked) if asked in names else int(asked) - 1 if asked.isdecimal() else -1
        if not 0 <= index < len(names):
            raise InputError(
                "no such channel", place=Place(path), found=asked,
                allowed=", ".join(f"{k} ({name})" for k, name in enumerate(names, 1)),
            )  # fmt: skip
        if index in found:
            raise InputError("the same channel twice", place=Place(path), found=asked)
        found.append(index)
    return found


def flat_tops(values: NDArray[np.float64], least_step: float, run: int = 3) -> int | None:
    """Index of the first run of equal samples at the largest or smallest value that is cut off, not rounded; or None.

    A crest that is only rounded falls off by a few steps beside such a run, one that is cut off falls steeply.
    """
    for extreme in (float(values.max()), float(values.min())):
        at = np.flatnonzero(values == extreme)
        starts = at[: -run + 1] if len(at) >= run else at[:0]
        for begin in starts[at[run - 1 :] - starts == run - 1][:1000]:
            before, after = values[max(begin - 1, 0)], values[begin]
            end = int(begin)
            while end + 1 < len(values) and values[end + 1] == extreme:
                end += 1
            beyond = values[min(end + 1, len(values) - 1)]
            if begin and values[begin - 1] == extreme:
                continue
            if min(abs(after - before), abs(beyond - extreme)) > 4 * least_step:
                return int(begin)
    return None
