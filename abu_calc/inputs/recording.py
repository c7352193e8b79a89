"""A recorded motion: equally spaced samples of up to three axes of one place, and the meaning of its columns.

A column's name tells whether it is time or motion, its quantity and its unit.
"""

import hashlib
import re
from collections.abc import Sequence
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY

MotionQuantity = Literal["acceleration", "velocity", "displacement"]
QUANTITIES: Final[tuple[MotionQuantity, ...]] = ("acceleration", "velocity", "displacement")
LARGEST: Final = 1e9
"""Largest sample, in SI units: squares of much larger ones, and their sums, are infinite."""
MOST_AXES: Final = 3


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
        """Duration of the record [s]."""
        return len(self.samples[0]) / self.rate


@dataclass(frozen=True)
class RecordingOptions:
    """Reading of a file: quantity, SI per unit, which columns or channels; None: as the file says."""

    quantity: MotionQuantity | None = None
    scale: float | None = None
    channels: tuple[str, ...] = ()


def recording(
    path: str, content: bytes, quantity: MotionQuantity, axes: Sequence[tuple[str, NDArray[np.float64]]], rate: float,
    remarks: Sequence[str] = (), *, simulated: bool = False,
) -> Recording:  # fmt: skip
    """Recording of the data read; refused with more than three axes, or with one that stands still."""
    names, samples = tuple(name for name, _ in axes), tuple(values for _, values in axes)
    if len(axes) > MOST_AXES:
        raise InputError(
            "a place moves along three axes at most", place=Place(path), found=", ".join(names),
            remedy="Say which to take: --channels 1,2,3, or their names (Python: channels=).",
        )  # fmt: skip
    for name, values in axes:
        if (largest := float(np.abs(values).max())) > LARGEST:
            raise InputError(
                "a sample is larger than anything that vibrates", place=Place(path, key=name),
                found=f"{largest:g} in SI units", allowed=f"at most {LARGEST:g}",
                remedy="Correct the sample, the unit in the column's name or --scale (Python: scale=).",
            )  # fmt: skip
    still = [name for name, values in axes if float(np.ptp(values)) == 0]
    if still:
        raise InputError(
            "the signal is the same number from start to end", place=Place(path, key=still[0]),
            remedy="A sensor that is not connected? Leave the channel out: --channels (Python: channels=).",
        )  # fmt: skip
    digest = hashlib.sha256(content).hexdigest()
    return Recording(path, digest, quantity, names, samples, rate, tuple(remarks), simulated)


def chosen(path: str, names: Sequence[str], channels: Sequence[str]) -> list[int]:
    """Indices of the columns or channels asked for, by name or by number from 1."""
    indices = []
    for asked in channels:
        index = names.index(asked) if asked in names else int(asked) - 1 if asked.isdecimal() else -1
        if not 0 <= index < len(names):
            raise InputError(
                "no such channel", place=Place(path), found=asked,
                allowed=", ".join(f"{k} ({name})" for k, name in enumerate(names, 1)),
                remedy="--channels takes numbers or names (Python: channels=).",
            )  # fmt: skip
        if index in indices:
            raise InputError("the same channel twice", place=Place(path), found=asked)
        indices.append(index)
    return indices


def flat_tops(values: NDArray[np.float64], least_step: float, run: int = 3) -> int | None:
    """Index of the first run of equal samples at the largest or smallest value that is cut off, not rounded; or None.

    A crest that is only rounded falls off by a few steps beside such a run, one that is cut off falls steeply.
    """
    for extreme in (values.max(), values.min()):
        edges = np.flatnonzero(np.diff(np.concatenate([[False], values == extreme, [False]])))
        begins, ends = edges[::2], edges[1::2]
        before, behind = (values[np.clip(k, 0, len(values) - 1)] for k in (begins - 1, ends))
        steep = np.minimum(np.abs(before - extreme), np.abs(behind - extreme)) > 4 * least_step
        cut = begins[(ends - begins >= run) & steep]
        if len(cut):
            return int(cut[0])
    return None


TIME: Final = {"s": 1.0, "sec": 1.0, "с": 1.0, "ms": 1e-3, "мс": 1e-3, "us": 1e-6, "µs": 1e-6, "min": 60.0}
_SPELLED: Final[tuple[tuple[MotionQuantity, float, str], ...]] = (
    ("acceleration", 1.0, "m/s² m/s^2 m/s2 m/s/s m_per_s2 m/s**2 м/с² м/с^2 м/с2"),
    ("acceleration", 1e-3, "mm/s² mm/s^2 mm/s2 mm_per_s2 мм/с² мм/с2"),
    ("acceleration", GRAVITY, "g gn g0"),
    ("velocity", 1.0, "m/s m_per_s м/с"),
    ("velocity", 1e-3, "mm/s mm_per_s мм/с"),
    ("velocity", 1e-6, "um/s µm/s μm/s um_per_s мкм/с"),
    ("velocity", 1e-2, "cm/s cm_per_s см/с"),
    ("displacement", 1.0, "m м"),
    ("displacement", 1e-3, "mm мм"),
    ("displacement", 1e-6, "um µm μm micron мкм"),
)
MOTION: Final = {unit: (quantity, size) for quantity, size, units in _SPELLED for unit in units.split()}
"""Units of a column: its quantity, and the value in SI."""
WORDS: Final[dict[str, MotionQuantity]] = {
    **dict.fromkeys(("a", "ax", "ay", "az", "acc", "accel", "acceleration"), "acceleration"),
    **dict.fromkeys(("v", "vx", "vy", "vz", "vel", "velocity"), "velocity"),
    **dict.fromkeys(("disp", "displacement"), "displacement"),
}
TIMES: Final = frozenset({"t", "time", "times", "zeit", "время"})
AXIS: Final = re.compile(r"(ch(annel)?[\s_]*\d+|column \d+|(.*[\s_])?[xyz])", re.IGNORECASE)
"""Names of columns that may be axes though they tell no quantity."""
BRACKETS: Final = re.compile(r"^(.*?)\s*[\[(]\s*([^\])]+?)\s*[\])]\s*$")


@dataclass(frozen=True)
class RecordingColumn:
    """A column by its name: its quantity (None: not known), time or not, SI per unit (None: no unit is named)."""

    name: str
    quantity: MotionQuantity | None
    is_time: bool
    unit: float | None


def column_of(name: str) -> RecordingColumn:
    """Meaning of a column's name, such as "vx_mm_per_s", "a [m/s^2]", "Time (ms)".

    >>> column_of("vx_mm_per_s").quantity, column_of("t_s").is_time, column_of("a [g]").unit
    ('velocity', True, 9.80665)
    """
    match = BRACKETS.match(name)
    word, unit = (match[1], match[2].replace(" ", "")) if match else (name, "")
    bare = re.split(r"[_\s]", word.strip().lower())[0]
    if not match:
        endings = (key for key in (*MOTION, *TIME) if word.endswith(f"_{key}"))
        unit = max(endings, key=len, default="")
    known = MOTION.get(unit) or MOTION.get(unit.lower())
    if bare in TIMES or unit.lower() in TIME:
        return RecordingColumn(name, None, True, TIME.get(unit.lower()))
    quantity, size = known or (WORDS.get(bare), None)
    return RecordingColumn(name, quantity, False, size)
