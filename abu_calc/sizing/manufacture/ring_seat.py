"""Seat of the race ring in its body: interference over temperature and speed, by limits that hold it tight.

Form, surface and hardness asked of race and balls, each as large as the limit on vibration allows.
"""

import math
from bisect import bisect_right
from typing import Final

from abu_calc.formulas.press_fit import (
    ASSEMBLY_TEMPERATURE,
    MATERIALS,
    Ring,
    contact_pressure,
    inner_hoop,
    interference_left,
    outer_hoop,
    spin_stress,
)
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, shown, to_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.cover import OVERSPEED, PROOF_SHARE
from abu_calc.sizing.parts.housing_parts import HousingParts
from abu_calc.standards.tolerance_classes import DeviationLimits, grade_tolerance, part_limits, ring_limits

SEAT_CLASSES: Final = ("N7", "P7", "R7")
"""Classes of the seat that are tried before limits of its own, loosest first."""
RESERVE: Final = 2e-6
"""Least interference that is left anywhere [m] (assumed)."""
JOINING_GAP: Final = 0.03e-3
"""Clearance at joining, with the body warm [m] (assumed)."""


@dataclass(frozen=True)
class RingSeat:
    """Limits of seat and ring [m], and what they give.

    `seat_class` is empty where no class of ISO 286 holds and the drawing writes limits. `left`: least interference over
    temperatures and speeds [m]; `stress`, `ring_stress`: largest hoop stresses of body and ring [Pa]; `joining`:
    temperature of the body at which the ring drops in [°C].
    """

    seat_class: str
    seat: DeviationLimits
    ring_class: str
    ring: DeviationLimits
    left: float
    stress: float
    ring_stress: float
    joining: float


def ring_seat(case: Case, parts: HousingParts, ball_force: float, top: float) -> RingSeat | None:
    """The loosest seat that keeps the ring tight; none for a race ground into the body."""
    if parts.ring is None:
        return None
    size = parts.dimensions
    inside = Ring(size.race_radius, size.ring_radius, MATERIALS[parts.ring.density])
    outside = Ring(size.ring_radius, size.outer_radius, MATERIALS[parts.body.density])
    ring_class, ring = _ring(parts)
    warm = [(temperature, speed) for temperature in (*case.autobalancer.temperature_range_C, ASSEMBLY_TEMPERATURE)
            for speed in (0.0, OVERSPEED * top)]  # fmt: skip

    def left(interference: float) -> float:
        return min(interference_left(interference, inside, outside, *state) for state in warm)

    seat_class, seat = "", _own_limits(size.ring_radius, ring, RESERVE - left(0.0))
    for name in SEAT_CLASSES:
        try:
            tabulated = part_limits("housing", name, 2 * size.ring_radius)
        except RangeError:
            break
        if left(ring.lower - tabulated.upper) >= RESERVE:
            seat_class, seat = name, tabulated
            break
    most = ring.upper - seat.lower
    pressed = OVERSPEED**2 * ball_force / (parts.balls.diameter * (size.ring_end - size.web))
    stress = max(
        outer_hoop(contact_pressure(interference_left(most, inside, outside, *state), inside, outside)
                   + (pressed if state[1] else 0.0), outside)
        + (spin_stress(outside, state[1]) if state[1] else 0.0)
        for state in warm
    )  # fmt: skip
    ring_stress = max(
        inner_hoop(contact_pressure(interference_left(most, inside, outside, state[0], 0.0), inside, outside), inside)
        for state in warm
    )
    joining = ASSEMBLY_TEMPERATURE + (most + JOINING_GAP) / (outside.material.expansion * 2 * size.ring_radius)
    return RingSeat(seat_class, seat, ring_class, ring, left(ring.lower - seat.upper), stress, ring_stress, joining)


def _ring(parts: HousingParts) -> tuple[str, DeviationLimits]:
    """Class and limits of the ring's outside: h6 of a ring that is made, class 0 of ISO 492 of a bearing's."""
    diameter = 2 * parts.dimensions.ring_radius
    try:
        if parts.design == "bearing-ring":
            return "class 0 (ISO 492)", ring_limits("radial", "outer", "0", diameter)
        return "h6", part_limits("shaft", "h6", diameter)
    except RangeError:
        return "", DeviationLimits(-grade_tolerance(6, diameter), 0.0)


def _own_limits(radius: float, ring: DeviationLimits, needed: float) -> DeviationLimits:
    """Limits of the seat, in whole micrometres, that leave an interference of `needed` [m]; IT7 wide."""
    upper = to_si(math.floor(from_si(ring.lower - needed, "um") + 1e-9), "um")
    return DeviationLimits(upper - grade_tolerance(7, 2 * radius), upper)


def bears_ring(parts: HousingParts, seat: RingSeat | None) -> bool:
    """True if the body bears the interference of its ring, or has none."""
    return seat is None or seat.stress <= PROOF_SHARE * MATERIALS[parts.body.density].strength


def seat_check(case: Case, parts: HousingParts, seat: RingSeat | None) -> tuple[Check, ...]:
    """Check that body and ring bear the interference that keeps the ring tight; nothing without a ring."""
    if seat is None:
        return ()
    low, high = case.autobalancer.temperature_range_C
    limit = PROOF_SHARE * MATERIALS[parts.body.density].strength
    named = f"{seat.seat_class} " if seat.seat_class else ""
    limits = shown((seat.seat.upper, seat.seat.lower), "um", "+.3g", "/")
    message = (
        f"Hoop stress of the body by the ring's interference and overspeed, largest over {low:g} … {high:g} °C. The "
        f"seat ({named}{limits}) keeps {shown(seat.left, 'um')} at least. Join with the body at "
        f"{seat.joining:.0f} °C"
    )
    passed = bears_ring(parts, seat)
    remedy = 'Narrow autobalancer.temperature_range_C, reduce the race, or specify design = "one-piece".'
    return (
        coded("ABU311", verdict(passed), message, seat.stress, limit, None if passed else remedy),
    )  # fmt: skip


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
