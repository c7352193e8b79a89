"""Interference that a ring needs so as not to creep, and its losses in service."""

import math
from typing import Final

from abu_calc.features.seats.bearing import RADIAL_LOAD, RING_SPEED, ROUGHNESS, SEAT_DIAMETER, SEAT_LENGTH
from abu_calc.foundation.formula import formula
from abu_calc.standards.balls import Material
from abu_calc.standards.bearing_catalogue import Series

SERIES_FACTORS: Final[dict[Series, float]] = {"light": 2.8, "medium": 2.3, "heavy": 2.0}
"""k of `creep_interference` by series: handbook values quoted by Afanasiev 2015, unverified."""


@formula(
    "Least interference that keeps a ring under a rotating load from creeping",
    "δ_min = 13·(F_r/1000)·k_B/b_s",
    "µm",
    where="δ_min is in µm, F_r in N, b_s in mm. The program computes in SI.",
    checked=(RADIAL_LOAD, SEAT_LENGTH),
    source="Afanasiev 2015",
    published="13·F_r·k_B/(10⁶·b_s) with F_r in kN and b_s in m, which gives millimetres, labelled µm",
    own_units=True,
)
def creep_interference(load: float, seat_length: float, factor: float) -> float:
    """
    >>> round(1e6 * creep_interference(3000.0, 29e-3, 2.8), 4)
    3.7655
    """
    return 13e-12 * RADIAL_LOAD.check(load) * factor / SEAT_LENGTH.check(seat_length)


@formula(
    "Interference lost under a radial load",
    "0.08·√(d·F_r/B)",
    "µm",
    where="The loss is in µm, with F_r in N, d and B in one unit. The program computes in SI.",
    checked=(RADIAL_LOAD, SEAT_DIAMETER, SEAT_LENGTH),
    assumed=(
        "F_r up to a quarter of the static load rating (beyond it catalogues use 0.02·F_r/B); inner rings on solid "
        "shafts; applied to outer rings, too"
    ),
    source="bearing makers' catalogues",
    own_units=True,
)
def load_loss(load: float, diameter: float, width: float) -> float:
    """
    >>> round(1e6 * load_loss(3000.0, 0.080, 0.033), 2)
    6.82
    """
    return 8e-8 * math.sqrt(SEAT_DIAMETER.check(diameter) * RADIAL_LOAD.check(load) / SEAT_LENGTH.check(width))


@formula(
    "Interference lost as one surface becomes smooth",
    "0.4·Rz",
    "m",
    shown="um",
    checked=(ROUGHNESS,),
    assumed="turned or ground steel",
    source="DIN 7190-1:2017",
)
def smoothing_loss(roughness: float) -> float:
    """
    >>> round(1e6 * smoothing_loss(4e-6), 3)
    1.6
    """
    return 0.4 * ROUGHNESS.check(roughness)


@formula(
    "Interference lost by smoothing, according to catalogues",
    "δ·2/(d + 2), d in mm",
    "m",
    shown="um",
    where=(
        "Catalogues leave d/(d + 2) of the apparent interference of a ground shaft, and d/(d + 3) of a turned one. A "
        "clearance loses nothing. This loss is unverified, shown beside the smoothing loss, and counts nowhere."
    ),
    checked=(SEAT_DIAMETER,),
    source="bearing makers' catalogues",
    own_units=True,
)
def catalogue_smoothing_loss(interference: float, diameter: float) -> float:
    """
    >>> round(1e6 * catalogue_smoothing_loss(41e-6, 0.080), 6)
    1.0
    """
    return max(interference, 0.0) * 2e-3 / (SEAT_DIAMETER.check(diameter) + 2e-3)


@formula(
    "Interference lost by thermal expansion",
    "d·(α₂·ΔT₂ − α₁·ΔT₁)",
    "m",
    shown="um",
    where=(
        "If both coefficients are α, the loss is α·d times the difference of the temperature rises. It is negative if "
        "the seat becomes tighter. If only the rise of the bearing over its surroundings is known, catalogues take "
        "an eighth of it as the rise of the inner ring over its shaft (their 0.0015·d·ΔT µm, d in mm)."
    ),
    checked=(SEAT_DIAMETER,),
    assumed="uniform temperature of each part",
    source="linear expansion",
)
def temperature_loss(diameter: float, around: tuple[float, float], inside: tuple[float, float]) -> float:
    """
    >>> round(1e6 * temperature_loss(0.080, (12e-6, 10.0), (12e-6, 0.0)), 2)
    9.6
    """
    (expansion, rise), (expansion_inside, rise_inside) = around, inside
    return SEAT_DIAMETER.check(diameter) * (expansion * rise - expansion_inside * rise_inside)


@formula(
    "Interference lost because the spinning ring grows more than its shaft",
    "(3+ν)·ρ·Ω²·d·(d₁² − d₀²)/(16·E)",
    "m",
    shown="um",
    where=(
        "Ring and shaft have the same ρ, E and ν. The loss is the difference between the free growths of two annular "
        "discs at their common diameter. The terms (1−ν) of both cancel."
    ),
    checked=(RING_SPEED,),
    assumed="plane stress, elastic; the load of rollers or balls left out",
    source="rotating disc (Timoshenko)",
)
def centrifugal_loss(
    speed: float, diameter: float, ring_diameter: float, shaft_bore: float, material: Material
) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> round(1e6 * centrifugal_loss(2094.4, 0.017, 0.0234, 0.0, steel), 3)
    0.319
    """
    growth = (
        (3 + material.poisson_ratio) * material.density * RING_SPEED.check(speed) ** 2 / (16 * material.youngs_modulus)
    )
    return growth * diameter * (ring_diameter**2 - shaft_bore**2)
