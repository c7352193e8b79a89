"""A recorded motion: equally spaced samples of up to three axes of each place."""

import hashlib
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.recording_columns import MotionQuantity
from abu_calc.inputs.sensitivity import Sensitivity

LARGEST: Final = 1e9
"""Largest sample, in SI units: squares of much larger ones, and their sums, are infinite."""
MOST_AXES: Final = 3


@dataclass(frozen=True, eq=False)
class Recording:
    """Samples [SI] of a quantity at `rate` [1/s]: axis by axis, in their order in the file, with their names.

    `remarks`: facts that a reader must know of how the file was taken; `simulated`: whether a simulation made it.
    `handles`: the handle that each axis is measured at; "": the file names none. `assumed`: what is assumed of units
    that nothing in the file tells.
    """

    file: str
    sha256: str
    quantity: MotionQuantity
    names: tuple[str, ...]
    samples: tuple[NDArray[np.float64], ...]
    rate: float
    remarks: tuple[str, ...] = ()
    simulated: bool = False
    handles: tuple[str, ...] = ()
    clipped: tuple[str, ...] = ()
    assumed: str = ""

    @property
    def duration(self) -> float:
        """Duration of the record [s]."""
        return len(self.samples[0]) / self.rate

    @property
    def axes_by_handle(self) -> dict[str, tuple[int, ...]]:
        """Indices of the axes at each handle, in the order of the file; one key "" if the file names no handle."""
        return by_handle(self.handles or ("",) * len(self.samples))


def by_handle(handles: Sequence[str]) -> dict[str, tuple[int, ...]]:
    """Indices of equal names."""
    return {name: tuple(k for k, other in enumerate(handles) if other == name) for name in dict.fromkeys(handles)}


@dataclass(frozen=True)
class RecordingOptions:
    """Reading of a file: quantity, SI per unit, which columns or channels; None: as the file says.

    `sensitivities` of channels in volts; `handles`: name and channels of each; `full_scale` [V] of a WAV file; `rate`
    [1/s] of a table without times, `time`: its column of times with its unit, `skip`: lines that are left out above.
    """

    quantity: MotionQuantity | None = None
    scale: float | None = None
    channels: tuple[str, ...] = ()
    sensitivities: tuple[Sensitivity, ...] = ()
    handles: tuple[tuple[str, tuple[str, ...]], ...] = ()
    full_scale: float | None = None
    keep_clipped: bool = False
    rate: float | None = None
    time: str | None = None
    skip: int = 0

    @property
    def asked_channels(self) -> tuple[str, ...]:
        """Channels to read; empty: as the file says."""
        return self.channels or tuple(channel for _, channels in self.handles for channel in channels)

    def handle_names(self) -> tuple[str, ...]:
        """Handle of each of `asked_channels`; empty without handles."""
        return tuple(name for name, channels in self.handles for _ in channels)


def recording(
    path: str, content: bytes, quantity: MotionQuantity, axes: Sequence[tuple[str, NDArray[np.float64]]], rate: float,
    remarks: Sequence[str] = (), *, simulated: bool = False, handles: Sequence[str] = (), clipped: Sequence[str] = (),
    assumed: str = "",
) -> Recording:  # fmt: skip
    """Recording of the data read; refused with more than three axes at a place, two of one name, or one at rest."""
    names, samples = tuple(name for name, _ in axes), tuple(values for _, values in axes)
    for handle, members in by_handle(handles or ("",) * len(axes)).items():
        if len(members) > MOST_AXES:
            raise InputError(
                "a place moves along three axes at most", place=Place(path, key=handle or None),
                found=", ".join(names[k] for k in members),
                remedy="Say which to take: --channels 1,2,3, or their names (Python: channels=). For two handles: "
                "--handle front=1,2,3 --handle rear=4,5,6 (Python: handles=).",
            )  # fmt: skip
        doubled = sorted({names[k] for k in members if [names[j] for j in members].count(names[k]) > 1})
        if doubled:
            raise InputError(
                "two axes of a place with the same name", place=Place(path, key=doubled[0]),
                remedy="Name each column by its axis: ax_m_per_s2, ay_m_per_s2, az_m_per_s2.",
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
    return Recording(
        path, digest, quantity, names, samples, rate, tuple(remarks), simulated, tuple(handles), tuple(clipped), assumed
    )


def chosen(path: str, names: Sequence[str], channels: Sequence[str]) -> list[int]:
    """Indices of the columns or channels asked for, by name or by number from 1."""
    indices = []
    for asked in channels:
        counted = asked.isdecimal() and not all(name.isdecimal() for name in names)
        index = names.index(asked) if asked in names else int(asked) - 1 if counted else -1
        if not 0 <= index < len(names):
            raise InputError(
                "no such channel", place=Place(path), found=asked,
                allowed=", ".join(f"{k} ({name})" for k, name in enumerate(names, 1)),
                remedy="--channels and --handle take numbers or names (Python: channels=, handles=).",
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
