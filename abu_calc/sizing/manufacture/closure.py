"""Checks of the closed housing: filling, stress and burst at overspeed, containment of a ball."""

import math
from typing import Final

from abu_calc.formulas.press_fit import MATERIALS, Ring, RingMaterial, spin_stress
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import LEAST_FILLING, balls_go_in, filling_gap, last_ball_passes
from abu_calc.sizing.parts.housing_parts import HousingParts
from abu_calc.sizing.parts.profile import moments

OVERSPEED: Final = 1.2
"""Overspeed of the proof, over the highest speed (assumed)."""
PROOF_SHARE: Final = 2 / 3
"""Share of the yield strength that overspeed may use (assumed)."""
BURST_RATIO: Final = 1.87
"""Least burst speed over the highest speed: √3.5, the factor of hand-held grinding wheels (EN 12413)."""
PERFORATION: Final = 1.4e9
"""Energy per (diameter × thickness)^1.5 at which a ball perforates mild steel [J/m³], of the BRL formula."""


def filling_gap_of(parts: HousingParts) -> float:
    """Gap [m] beside a ball on its way into the race."""
    size = parts.dimensions
    return filling_gap(size.shoulder_radius, parts.balls.diameter, size.hub_radius)


def filling_check(parts: HousingParts) -> Check:
    """Check that the balls can be put in through the open cover side."""
    size, balls = parts.dimensions, parts.balls
    beside = last_ball_passes(size, balls.count, balls.diameter)
    side = "beside the others" if beside else "but the last one does not pass the others"
    passed = balls_go_in(size, balls.count, balls.diameter)
    message = (
        f"The balls go in one by one before the cover is {parts.closure}, between hub and edge of the race, {side}"
    )
    return coded("ABU305", verdict(passed), message, filling_gap_of(parts), LEAST_FILLING)


@formula(
    "Hoop stress of the wall by balls that touch all round, and by its own rotation",
    "q_b·(R_o² + R²)/(R_o² − R²) + ρ·Ω²/4·[(3 + ν)·R_o² + (1 − ν)·R²], q_b = F/(d·b_r)",
    "Pa",
    signs="F d b_r R R_o",
    where="R and R_o are the inner and the outer radius of the wall, F the force of one ball, all at 1.2 × top speed.",
    assumed="a free ring: the webs carry nothing; balls side by side all round, an upper bound",
    source="Lamé; Timoshenko",
)
def wall_stress(wall: Ring, width: float, ball_force: float, ball_diameter: float, speed: float) -> float:
    pressure = ball_force / (ball_diameter * width)
    lame = (wall.outer**2 + wall.inner**2) / (wall.outer**2 - wall.inner**2)
    return pressure * lame + spin_stress(wall, speed)


def overspeed_stress(parts: HousingParts, force: float, top: float) -> tuple[str, float, RingMaterial]:
    """Place, stress [Pa] and material where overspeed takes the largest share of the strength; `force` at top speed."""
    size, speed = parts.dimensions, OVERSPEED * top
    race, body = MATERIALS[parts.race_part.density], MATERIALS[parts.body.density]
    wall = Ring(size.race_radius, size.ring_radius, race)
    width = size.ring_end - size.web
    stressed = (
        ("wall of the race", wall_stress(wall, width, OVERSPEED**2 * force, parts.balls.diameter, speed), race),
        ("bore of the body", spin_stress(Ring(size.bore_radius, size.outer_radius, body), speed), body),
        ("hole of the cover", spin_stress(Ring(size.hub_radius, size.seat_radius, body), speed), body),
    )
    return max(stressed, key=lambda place: place[1] / place[2].strength)


def overspeed_check(parts: HousingParts, force: float, top: float) -> Check:
    """Check of the stresses of wall, body and cover at overspeed, against what each material bears."""
    place, stress, material = overspeed_stress(parts, force, top)
    limit = PROOF_SHARE * material.strength
    passed = stress <= limit
    return coded("ABU306", verdict(passed), f"Hoop and spin stress at 1.2 × the highest speed, largest at the {place} "
        f"({material.name})", stress, limit,
    )  # fmt: skip


@formula(
    "Burst speed over the highest speed",
    "√(Σ σ_m·A_p/(Σ ρ·Ω²·I_p + n·F/2))",
    "1",
    signs="σ_m A_p ρ Ω I_p n F",
    where=(
        "Each half of the housing pulls on the cut through the axis. A_p is the area of a part's half section, "
        "I_p its second moment about the axis, σ_m its strength. All n balls lie on one side."
    ),
    assumed="the section yields as a whole before it bursts; a hard ring counts at the same strength",
    source="Robinson 1944 (mean hoop stress)",
)
def burst_ratio(parts: HousingParts, ball_force: float, speed: float) -> float:
    pull, held = parts.balls.count * ball_force / 2, 0.0
    for part in parts.turned:
        section = moments(part.profile)
        pull += part.density * speed**2 * section.second
        if part is not parts.cover:
            held += MATERIALS[part.density].strength * section.area
    return math.sqrt(held / pull)


def burst_check(parts: HousingParts, force: float, top: float) -> Check:
    """Check of the burst speed; the cover, which may be loose in its seat, pulls and does not hold."""
    ratio = burst_ratio(parts, force, top)
    passed = ratio >= BURST_RATIO
    return coded("ABU309", verdict(passed), "Burst speed over the highest speed, by the mean hoop stress with all "
        "balls on one side; the cover counts as load alone", ratio, BURST_RATIO,
    )  # fmt: skip


def _ball_energy(parts: HousingParts, top: float) -> float:
    return parts.balls.mass * (OVERSPEED * top * parts.balls.pitch_radius) ** 2 / 2


def contained(case: Case, parts: HousingParts, top: float) -> bool:
    """True if the guard stops a ball, or no guard is given."""
    given = case.autobalancer.guard_thickness
    return given is None or bool(given >= perforated_thickness(_ball_energy(parts, top), parts.balls.diameter))


def containment_check(case: Case, parts: HousingParts, top: float) -> tuple[Check, ...]:
    """Check that the guard stops a ball; none if no guard is given."""
    energy = _ball_energy(parts, top)
    least = perforated_thickness(energy, parts.balls.diameter)
    given = case.autobalancer.guard_thickness
    if given is None:
        return ()
    message = f"A ball that leaves the housing at 1.2 × the highest speed has {energy:.3g} J"
    passed = contained(case, parts, top)
    return (coded("ABU310", verdict(passed), f"{message}, which the guard of mild steel must stop", given, least,
                  None if passed else "Specify a thicker guard."),)  # fmt: skip


@formula(
    "Thickness of mild steel that stops a ball, with a factor of 1.5 on its energy",
    "(1.5·E_b/(1.4·10⁹))^(2/3)/d",
    "m",
    signs="E_b d",
    where="The formula was fitted at 57 … 270 m/s; slower balls dent more than they perforate.",
    assumed="a hard sphere at a right angle",
    source="BRL formula for missiles (Bechtel 1974)",
)
def perforated_thickness(energy: float, diameter: float) -> float:
    """
    >>> round(1e3 * perforated_thickness(100.0, 16e-3), 2)
    1.41
    """
    return float((1.5 * energy / PERFORATION) ** (2 / 3)) / diameter
