"""Static safety, rating life and limiting speed of a bearing under its loads.

Basic rating life by ISO 281; modified by a_ISO where the lubricant's viscosity is given.
"""

import math
from typing import Final, NamedTuple

from abu_calc.features.seats.bearing import SeatedBearing, load_factors
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import from_si
from abu_calc.foundation.validity import Range
from abu_calc.standards.catalogue import ROLLERS, Kind, fatigue_limit

TURNING: Final = Range("speed of the shaft", 0.0, 1e5, "rad/s", open_low=True)
LOAD_OVER_C: Final = Range("equivalent load over C", 0.0, 10.0, open_low=True)
KAPPA: Final = Range("viscosity ratio", 0.0, 1e6)
MOST_A_ISO: Final = 50.0
MOST_LIFE: Final = 1e12
"""Rating life [s] above which no number is given: 31 700 years."""
GUIDE_LIFE: Final = 3000 * 3600.0
"""Rating life [s] that SKF's General Catalogue guides to for hand-held tools at least."""


def exponent(kind: Kind) -> float:
    """Exponent of the load in the rating life: 3 of balls, 10/3 of rollers (ISO 281:2007)."""
    return 10 / 3 if kind in ROLLERS else 3.0


@formula(
    "Basic rating life of a bearing",
    "L_10h = 2π·10⁶·(C/P)^p_L/Ω",
    "s",
    shown="h",
    where="The exponent p_L is 3 for ball and 10/3 for roller bearings. 10 of 100 bearings fail within this life.",
    checked=(TURNING, LOAD_OVER_C),
    assumed="constant load and speed; P at most C/2, else the number is too large",
    source="ISO 281:2007",
)
def basic_rating_life(load_over_rating: float, speed: float, power: float) -> float:
    """
    >>> round(basic_rating_life(10 / 55.3, 3000 * math.pi / 30, 3.0) / 3600)
    940
    """
    return math.pow(LOAD_OVER_C.check(load_over_rating), -power) * 2e6 * math.pi / TURNING.check(speed)


@formula(
    "Reference viscosity of a bearing's lubricant",
    "ν_1 = 45000·n_s^−0.83·D_m^−0.5 below 1000 rpm, 4500·n_s^−0.5·D_m^−0.5 above",
    "m²/s",
    shown="mm2_per_s",
    where="ν_1 is in mm²/s, n_s in rpm, D_m = (d + D)/2 in mm. The program computes in SI.",
    checked=(TURNING,),
    source="ISO 281:2007, 9.3.3.3",
    own_units=True,
)
def reference_viscosity(mean_diameter: float, speed: float) -> float:
    """
    >>> round(1e6 * reference_viscosity(0.0725, 3000 * math.pi / 30), 2)
    9.65
    """
    turns, mean = from_si(TURNING.check(speed), "rpm"), from_si(mean_diameter, "mm")
    slow = 45_000 * math.pow(turns, -0.83) if turns < 1000 else 4500 / math.sqrt(turns)
    return 1e-6 * slow / math.sqrt(mean)


_BALLS: Final = (2.5671, ((0.4, 2.2649, 0.054381), (1.0, 1.9987, 0.19087), (math.inf, 1.9987, 0.071739)))
_ROLLERS: Final = (1.5859, ((0.4, 1.3993, 0.054381), (1.0, 1.2348, 0.19087), (math.inf, 1.2348, 0.071739)))


@formula(
    "Life modification factor a_ISO",
    "a_ISO = 0.1·[1 − (2.5671 − b_κ/κ_v^c_κ)^0.83·(e_C·C_u/P)^(1/3)]^−9.3",
    where=(
        "The equation is that of radial ball bearings. Radial roller bearings have 0.1·[1 − (1.5859 − b_κ/κ_v^c_κ)·"
        "(e_C·C_u/P)^0.4]^−9.185. The constants b_κ and c_κ change at κ_v = 0.4 and 1. Above κ_v = 4 the value at 4 is "
        "taken. Below κ_v = 0.1 it is 0.1. It is at most 50."
    ),
    checked=(KAPPA,),
    assumed="no solid-film lubricant, no extreme-pressure additives",
    source="ISO 281:2007, 9.3.3.4",
)
def life_modification(kind: Kind, kappa: float, contaminated_ratio: float) -> float:
    """
    >>> round(life_modification("ball", 1.0, 0.1), 2), life_modification("ball", 0.05, 0.1)
    (2.43, 0.1)
    """
    rollers = kind in ROLLERS
    top, rows = _ROLLERS if rollers else _BALLS
    ratio = min(KAPPA.check(kappa), 4.0)
    if ratio < 0.1:
        return 0.1
    _, slope, power = next(row for row in rows if ratio < row[0])
    grip = top - slope / ratio**power
    lost = grip * contaminated_ratio**0.4 if rollers else grip**0.83 * contaminated_ratio ** (1 / 3)
    if lost >= 1:
        return MOST_A_ISO
    return min(MOST_A_ISO, 0.1 * math.pow(1 - lost, -9.185 if rollers else -9.3))


class RatingLife(NamedTuple):
    """Loads [N], safety and lives [s] of a bearing; None where the data are missing.

    `axial_factors_known`: the factors of the axial load are the bearing's own; `carries_axial`: its type does so.
    """

    dynamic_load: float | None = None
    static_load: float | None = None
    static_safety: float | None = None
    basic: float | None = None
    modified: float | None = None
    kappa: float | None = None
    a_iso: float | None = None
    limiting_speed: float | None = None
    reference_speed: float | None = None
    carries_axial: bool = True
    axial_factors_known: bool = True


def rating_life(bearing: SeatedBearing) -> RatingLife:
    """Static safety and rating life of a bearing under the loads of its table, as far as they can be known."""
    entry, ratings, kind, service = bearing.entry, bearing.ratings, bearing.kind, bearing.service
    speeds = (entry.limiting_speed, entry.reference_speed) if entry else (None, None)
    if ratings is None or kind is None:
        return RatingLife(limiting_speed=speeds[0], reference_speed=speeds[1])
    factors, known = load_factors(kind, entry, ratings, service.axial_load or 0.0) if ratings.static else (None, False)
    carries = factors is not None
    loads = bearing.equivalent_loads
    if loads is None:
        return RatingLife(
            limiting_speed=speeds[0], reference_speed=speeds[1], carries_axial=carries, axial_factors_known=known
        )
    safety = ratings.static / loads[1] if loads[1] and ratings.static else None
    basic = life_at(bearing, loads[0])
    modified = kappa = factor = None
    if service.lubricant_viscosity is not None and basic is not None and service.speed:
        mean = (bearing.inner.diameter + bearing.outer.diameter) / 2
        kappa = service.lubricant_viscosity / reference_viscosity(mean, service.speed)
        limit = ratings.fatigue_limit or fatigue_limit(kind, ratings.static, mean)
        factor = life_modification(kind, kappa, service.contamination_factor * limit / loads[0])
        modified = min(factor * basic, MOST_LIFE)
    return RatingLife(*loads, safety, basic, modified, kappa, factor, *speeds, carries, known)


def life_at(bearing: SeatedBearing, load: float) -> float | None:
    """Basic rating life [s] under an equivalent load [N]; None where C, type or speed are missing, or without load."""
    speed = bearing.service.speed
    if bearing.ratings is None or bearing.kind is None or not speed or load <= 0:
        return None
    ratio = load / bearing.ratings.dynamic
    if ratio > LOAD_OVER_C.high:
        return 0.0
    return min(basic_rating_life(max(ratio, 1e-9), speed, exponent(bearing.kind)), MOST_LIFE)
