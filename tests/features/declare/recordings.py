"""Recordings of a type test whose values are known: sines, weighted by hand."""

import math
from pathlib import Path
from typing import Final

import numpy as np

HERTZ: Final = 5800 / 60
RATE: Final = 4000
AXES: Final = (0.8, 0.5, 0.33)
"""Weighted acceleration of x, y, z, as shares of a run's size."""
TOTAL: Final = math.sqrt(0.8**2 + 0.5**2 + 0.33**2)
MV: Final = 100 / 9.80665
"""100 mV/g in mV per m/s²."""


def weight(hertz: float = HERTZ) -> float:
    """|W_h| as a product of magnitudes."""

    def second(corner: float, q: float) -> float:
        return math.hypot(1 - (hertz / corner) ** 2, hertz / corner / q)

    band = (hertz / 6.31) ** 2 / second(6.31, 0.5**0.5) / second(1258.9, 0.5**0.5)
    return band * math.hypot(1, hertz / 15.915) / second(15.915, 0.64)


def wave(size: float, phase: float = 0.0, seconds: float = 1.5, hertz: float = HERTZ) -> tuple[np.ndarray, np.ndarray]:
    """Times and acceleration whose weighted rms is `size`."""
    t = np.arange(round(RATE * seconds)) / RATE
    return t, math.sqrt(2) * size / weight(hertz) * np.sin(2 * math.pi * hertz * t + phase)


def run_file(
    folder: Path, name: str, size: float, *, axes: int = 3, unit: str = "m_per_s2", per_unit: float = 1.0,
    decimal: str = ".", prefix: str = "", seconds: float = 1.5, limit: float = math.inf,
) -> str:  # fmt: skip
    """A CSV of a run: each axis has its share of `size`; `limit`: where the recorder cuts off."""
    waves = [wave(size * share, 0.7 * k, seconds) for k, share in enumerate(AXES[:axes])]
    columns = [waves[0][0], *(np.clip(values * per_unit, -limit, limit) for _, values in waves)]
    delimiter = "," if decimal == "." else ";"
    heads = ["t_s", *(f"{prefix}a{axis}_{unit}" for axis in "xyz"[:axes])]
    rows = [delimiter.join(f"{value:.9g}".replace(".", decimal) for value in row) for row in zip(*columns, strict=True)]
    path = folder / name
    path.write_text("\n".join([delimiter.join(heads), *rows]) + "\n", encoding="utf-8")
    return str(path)
