"""The interference that a ring needs so as not to creep, and what it loses of it in service."""

import math
from typing import Final

from abu_calc.fits.bearing import Series
from abu_calc.standards.balls import Material
from abu_calc.validity import Range

SERIES_FACTORS: Final[dict[Series, float]] = {"light": 2.8, "medium": 2.3, "heavy": 2.0}
"""k of `creep_interference` by series: handbook values quoted by Afanasiev 2015, unverified."""

_LENGTH = Range("length of the seat", 0.0, 10.0, "m", open_low=True)
_DIAMETER = Range("diameter of the seat", 0.0, 10.0, "m", open_low=True)
_LOAD = Range("radial load", 0.0, 1e9, "N")


def creep_interference(load: float, seat_length: float, factor: float) -> float:
    """Least interference [m] that keeps a ring under a rotating load from creeping: N'min = 13·R·k/b µm.

    R radial load [N] (kN in the formula's micrometre form), b = B − 2r length of the seat [m] (mm there), k the
    factor of the series. Range: R ≥ 0, b > 0, else RangeError. Source: Afanasiev 2015; the print gives 13·R·k/(10⁶·b)
    with R in kN and b in m, which is in millimetres, and labels it µm.

    >>> round(1e6 * creep_interference(3000.0, 29e-3, 2.8), 4)
    3.7655
    """
    return 13e-12 * _LOAD.check(load) * factor / _LENGTH.check(seat_length)


def load_loss(load: float, diameter: float, width: float) -> float:
    """Interference [m] that a radial load takes from a seat: 0.08·√(d·F_r/B) µm.

    F_r load [N], d diameter of the seat and B width of the ring [m]. Range: F_r up to a quarter of the static load
    rating (not known here; catalogues go over to 0.02·F_r/B beyond), inner rings on solid shafts; used alike for outer
    rings. RangeError for sizes not above zero. Source: bearing makers' catalogues.

    >>> round(1e6 * load_loss(3000.0, 0.080, 0.033), 2)
    6.82
    """
    return 8e-8 * math.sqrt(_DIAMETER.check(diameter) * _LOAD.check(load) / _LENGTH.check(width))


def smoothing_loss(roughness: float) -> float:
    """Interference [m] lost by the smoothing of one surface: 0.4·Rz, Rz its roughness [m].

    Range: Rz ≥ 0 of turned or ground steel. Source: DIN 7190-1:2017.

    >>> round(1e6 * smoothing_loss(4e-6), 3)
    1.6
    """
    return 0.4 * roughness


def catalogue_smoothing_loss(interference: float, diameter: float) -> float:
    """Interference [m] lost by smoothing as catalogues take it, beside `smoothing_loss`: δ·2/(d + 2), d in mm.

    They leave d/(d + 2) of the apparent interference δ [m] of a ground shaft, d/(d + 3) of a turned one. Range: d > 0,
    a clearance loses nothing; unverified, never counted. Source: bearing makers' catalogues.

    >>> round(1e6 * catalogue_smoothing_loss(41e-6, 0.080), 6)
    1.0
    """
    return max(interference, 0.0) * 2e-3 / (_DIAMETER.check(diameter) + 2e-3)


def temperature_loss(expansion: float, diameter: float, difference: float) -> float:
    """Interference [m] lost by an inner ring warmer than its shaft: α·d·ΔT.

    α [1/K], d [m], ΔT ring minus shaft [K], ≥ 0. Where only the bearing's excess over its surroundings is known,
    catalogues take an eighth of it for ΔT (their 0.0015·d·Δt µm, d in mm). Range: uniform temperature of each part.
    Source: linear expansion.

    >>> round(1e6 * temperature_loss(12e-6, 0.080, 10.0), 2)
    9.6
    """
    return expansion * diameter * difference


def centrifugal_loss(
    speed: float, diameter: float, ring_diameter: float, shaft_bore: float, material: Material
) -> float:
    """Interference [m] lost because the spinning ring grows more than its shaft: (3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E).

    Ω speed [rad/s], d seat, d₁ outer diameter of the ring as a tube, d₀ bore of the shaft [m]; ρ, E, ν of the material
    of both. The difference of the free growths of two annular discs at their common diameter: the terms (1−ν) of both
    cancel. Range: plane stress, elastic, the load of rollers or balls left out. Source: rotating disc (Timoshenko).

    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> round(1e6 * centrifugal_loss(2094.4, 0.017, 0.0234, 0.0, steel), 3)
    0.319
    """
    growth = (3 + material.poisson_ratio) * material.density * speed**2 / (16 * material.youngs_modulus)
    return growth * diameter * (ring_diameter**2 - shaft_bore**2)
