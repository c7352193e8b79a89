"""Seat of the race ring in its body: interference over temperature and speed, by limits that hold it tight."""

import math
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
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, shown, to_si
from abu_calc.sizing.case import Case
from abu_calc.sizing.manufacture.closure import OVERSPEED, PROOF_SHARE
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
