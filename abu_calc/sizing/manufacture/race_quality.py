"""Form, surface and hardness asked of race and balls, each as large as the limit on vibration allows."""

import math
from bisect import bisect_right
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.standards.tolerance_classes import grade_tolerance

CIRCULARITY_SHARE: Final = 0.1
WAVINESS_SHARE: Final = 0.08
DENT_SHARE: Final = 1 / 32
ROUGHNESS_SHARE: Final = 0.005
BALL_SHARE: Final = 1 / 64
"""Shares of the permitted displacement (assumed). On a grinder that may keep 33 µm they give the usual 3 µm, 2.5 µm,
1 µm, Ra 0.16 µm and grade 20."""
GRADE_PER_MICRON: Final = 40
"""Grade of a ball over its deviation from spherical form in micrometres (ISO 3290-1: G20 has 0.5 µm)."""
LENGTHS_UM: Final = (0.5, 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50, 60, 80, 100)
ROUGHNESSES_UM: Final = (0.05, 0.08, 0.1, 0.16, 0.2, 0.32, 0.4, 0.63, 0.8, 1.25, 1.6)
BALL_GRADES: Final = (5, 10, 16, 20, 28, 40, 100, 200)
LEAST_CASE = 0.5e-3
"""Least depth of the hard case after grinding [m]."""
CASE_FACTOR: Final = 2.5
"""Depth of the case over the half-width of the contact: five times the depth of the largest shear (assumed)."""


@dataclass(frozen=True)
class RaceQuality:
    """Requirements of race and balls [m]; `hardness` in HRC from … to; `ball_grade` by ISO 3290-1."""

    circularity: float
    waviness: float
    dent: float
    roughness: float
    case_depth: float
    hardness: tuple[float, float]
    ball_grade: int


@formula(
    "Tolerances of race and balls from the permitted displacement",
    "circularity: w_p/10; waviness n_k·a_k: w_p/12.5; dent: w_p/32; Ra: w_p/200; ball form: w_p/64",
    "m",
    shown="um",
    where=(
        "Each is rounded down to a usual value. Circularity is never below IT1 of the race's diameter, which grinding "
        "attains at best. Largest values: 100 µm, Ra 1.6 µm, grade 200."
    ),
    assumed="shares of the permitted displacement that leave most of it to eccentricity and friction",
    source="assumed, from engineering practice",
)
def race_quality(case: Case, candidate: Candidate) -> RaceQuality:
    permitted, hardness = candidate.budget.permitted, case.autobalancer.race_hardness_HRC
    microns = from_si(permitted, "um")

    def usual(share: float, series: tuple[float, ...]) -> float:
        return to_si(_usual(share * microns, series), "um")

    stress = candidate.strength
    half_width = math.sqrt(1.5 * stress.ball_force / (math.pi * stress.contact_pressure))
    return RaceQuality(
        circularity=max(usual(CIRCULARITY_SHARE, LENGTHS_UM), grade_tolerance(1, 2 * candidate.race_radius)),
        waviness=usual(WAVINESS_SHARE, LENGTHS_UM),
        dent=usual(DENT_SHARE, LENGTHS_UM),
        roughness=usual(ROUGHNESS_SHARE, ROUGHNESSES_UM),
        case_depth=max(LEAST_CASE, to_si(math.ceil(10 * from_si(CASE_FACTOR * half_width, "mm")) / 10, "mm")),
        hardness=(hardness, min(hardness + 3, 68.0)),
        ball_grade=int(_usual(GRADE_PER_MICRON * BALL_SHARE * microns, BALL_GRADES)),
    )


def _usual(value: float, series: tuple[float, ...]) -> float:
    """The largest usual value that is not above, or the least there is.

    >>> _usual(3.4, (1, 3, 5)), _usual(0.2, (1, 3, 5))
    (3, 1)
    """
    return series[max(0, bisect_right(series, value * (1 + 1e-9)) - 1)]
