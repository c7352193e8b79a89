"""WAV files: samples of whole numbers or floats, full scale ±1; what they stand for is told by a scale."""

import io
import warnings
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.errors import InputError, Place
from abu_calc.spec.recording import Asked, Recording, chosen, flat_tops, recording

WHOLE: Final = {"uint8": (128.0, 128.0), "int16": (0.0, 32768.0), "int32": (0.0, 2.0**31), "int64": (0.0, 2.0**63)}
"""Zero and full scale of samples that are whole numbers."""


def wav_recording(path: str, content: bytes, asked: Asked) -> Recording:
    """The recording of a WAV file; its scale must be given."""
    if asked.scale is None:
        raise InputError(
            "a WAV file does not say what its samples stand for", place=Place(path),
            remedy="Give --scale S: m/s² at full scale (with --quantity velocity m/s); Python: scale=.",
        )  # fmt: skip
    rate, data = _read(path, content)
    remarks = []
    quantity = asked.quantity or "acceleration"
    if asked.quantity is None:
        remarks.append("The samples are taken for accelerations; --quantity velocity says otherwise.")
    columns = data.reshape(len(data), -1).T
    names = [f"channel {k}" for k in range(1, len(columns) + 1)]
    picked = chosen(path, names, asked.channels) if asked.channels else list(range(len(columns)))
    if len(picked) > 1:
        remarks.append(f"The {len(picked)} channels are taken for axes of one place.")
    axes = [(names[k], _full_scale(path, names[k], columns[k], rate) * asked.scale) for k in picked]
    return recording(path, content, quantity, axes, float(rate), remarks)


def _read(path: str, content: bytes) -> tuple[int, NDArray[Any]]:
    from scipy.io import wavfile

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            warnings.filterwarnings("ignore", message=".*not understood.*")
            rate, data = wavfile.read(io.BytesIO(content))
    except Exception as error:  # whatever the parser stumbles over
        raise InputError(f"not a WAV file that can be read: {error}", place=Place(path)) from None
    if rate <= 0 or len(data) < 2:
        raise InputError("the WAV file holds no samples", place=Place(path))
    return rate, np.asarray(data)


def _full_scale(path: str, name: str, values: NDArray[Any], rate: int) -> NDArray[np.float64]:
    """Samples as shares of full scale; refused where they are cut off there, or are no numbers."""
    kind = str(values.dtype)
    zero, full = WHOLE.get(kind, (0.0, 1.0))
    samples = (values.astype(float) - zero) / full
    bad = np.flatnonzero(~np.isfinite(samples))
    if len(bad):
        raise InputError("a sample is no number", place=Place(path, key=name), found=f"at {bad[0] / rate:.6g} s")
    step = 1 / full if kind in WHOLE else 2.0**-23
    limit = 1 - 1.5 * step if kind in WHOLE else 1.0
    cut = flat_tops(samples, step) if float(np.abs(samples).max()) >= limit else None
    if cut is not None:
        raise InputError(
            "the recording is clipped: the signal stays at full scale, so its levels would be too low",
            place=Place(path, key=name), found=f"first at {cut / rate:.6g} s", remedy="Record again with less gain.",
        )  # fmt: skip
    return samples
