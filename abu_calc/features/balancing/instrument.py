"""Units as an instrument shows them: "mil peak-peak", "mm/s rms", read to SI and 0–peak, and written back."""

import math
from typing import Final, Literal

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si

Quantity = Literal["displacement", "velocity", "acceleration"]

SIZES: Final[dict[str, tuple[Quantity, str, str]]] = {
    "µm": ("displacement", "um", "µm"),
    "um": ("displacement", "um", "µm"),
    "mm": ("displacement", "mm", "mm"),
    "mil": ("displacement", "mil", "mil"),
    "mm/s": ("velocity", "mm_per_s", "mm/s"),
    "ips": ("velocity", "ips", "ips"),
    "in/s": ("velocity", "ips", "ips"),
    "m/s²": ("acceleration", "m_per_s2", "m/s²"),
    "m/s2": ("acceleration", "m_per_s2", "m/s²"),
    "g": ("acceleration", "g_n", "g"),
}
"""Quantity, suffix of `foundation.units`, and form as printed, by the unit as people write it."""
DETECTORS: Final[dict[str, tuple[float, str]]] = {
    "0-peak": (1.0, "0-peak"),
    "peak": (1.0, "0-peak"),
    "peak-peak": (2.0, "peak-peak"),
    "rms": (math.sqrt(0.5), "rms"),
    **dict.fromkeys(("pk", "0-p", "0-pk"), (1.0, "0-peak")),
    **dict.fromkeys(("pp", "p-p", "pk-pk", "peak-to-peak"), (2.0, "peak-peak")),
}
"""Reading of a sine over its amplitude 0–peak, and the form as printed, by the detector."""
PLAIN: Final = {"displacement": "mm", "velocity": "mm/s", "acceleration": "m/s²"}
"""Units of a run that names its quantity alone; the amplitudes are 0–peak."""


@dataclass(frozen=True)
class Instrument:
    """Unit of the amplitudes of a run."""

    quantity: Quantity
    suffix: str
    shown: str
    """Unit as printed; of a run without `unit` the detector is left out: 0–peak."""
    factor: float = 1.0
    """Reading over amplitude 0–peak."""

    def amplitude(self, reading: float) -> float:
        """Amplitude 0–peak in SI of a reading.

        >>> round(1e6 * instrument_of("mil peak-peak").amplitude(2.0), 6)
        25.4
        """
        return to_si(reading / self.factor, self.suffix)

    def reading(self, amplitude: float) -> float:
        """Reading that the instrument shows of an amplitude 0–peak in SI."""
        return from_si(amplitude * self.factor, self.suffix)


def _plain(text: str) -> str:
    """A unit in the form in which it is looked up: one space, any dash, either micro sign."""
    for dash in "–—‐‑−":
        text = text.replace(dash, "-")
    return " ".join(text.replace("\u03bc", "µ").split())


def instrument_of(unit: str) -> Instrument | None:
    """Instrument of a unit as people write it; None for an unknown one.

    >>> instrument_of("mm/s rms").quantity, instrument_of("mil"), instrument_of("µm 0–peak").shown
    ('velocity', None, 'µm 0-peak')
    """
    size, _, detector = _plain(unit).partition(" ")
    detector = detector.lower()
    if size not in SIZES or detector not in DETECTORS:
        return None
    quantity, suffix, shown = SIZES[size]
    factor, name = DETECTORS[detector]
    return Instrument(quantity, suffix, f"{shown} {name}", factor)


def plain_instrument(quantity: Quantity) -> Instrument:
    """Instrument of a run that names its quantity alone.

    >>> plain_instrument("velocity").amplitude(2.0)
    0.002
    """
    unit = PLAIN[quantity]
    return Instrument(quantity, SIZES[unit][1], unit)


def known_units() -> tuple[str, ...]:
    """Units that are known, as printed, by quantity.

    >>> known_units()[:3]
    ('µm 0-peak', 'µm peak-peak', 'µm rms')
    """
    sizes = dict.fromkeys(shown for _, _, shown in SIZES.values())
    detectors = dict.fromkeys(name for _, name in DETECTORS.values())
    return tuple(f"{size} {detector}" for size in sizes for detector in detectors)
