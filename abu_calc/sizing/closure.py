"""Checks of the closed housing: filling, stress and burst at overspeed, containment of a ball."""

import math
from typing import Final

from abu_calc.formulas.press_fit import MATERIALS, Ring, spin_stress
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import from_si, to_si
from abu_calc.sizing.case import Case
from abu_calc.sizing.parts.housing_parts import HousingParts
from abu_calc.sizing.parts.profile import moments

OVERSPEED: Final = 1.2
"""Overspeed of the proof, over the highest speed (assumed)."""
PROOF_SHARE: Final = 2 / 3
"""Share of the yield strength that overspeed may use (assumed)."""
LEAST_FILLING: Final = to_si(0.1, "mm")
"""Least gap at which a ball passes between hub and edge of the race [m] (assumed)."""
BURST_RATIO: Final = 1.87
"""Least burst speed over the highest speed: √3.5, the factor of hand-held grinding wheels (EN 12413)."""
PERFORATION: Final = 1.4e9
"""Energy per (diameter × thickness)^1.5 at which a ball perforates mild steel [J/m³], of the BRL formula."""


@formula(
    "Gap through which a ball passes from the open side to its race",
    "R_k − d − R_h",
    "m",
    where=(
        "R_k is the radius of the race at its edge, R_h that of the hub, d the diameter of the balls. The last ball "
        "passes between the others, which are pushed together, if the chord to each of them is at least d."
    ),
    source="geometry",
)
def filling_gap(edge_radius: float, ball_diameter: float, hub_radius: float) -> float:
    """
    >>> round(1e3 * filling_gap(29.6e-3, 15.9e-3, 12.5e-3), 2)
    1.2
    """
    return edge_radius - ball_diameter - hub_radius


def filling_gap_of(parts: HousingParts) -> float:
    """Gap [m] beside a ball on its way into the race."""
    size = parts.dimensions
    return filling_gap(size.shoulder_radius, parts.balls.diameter, size.hub_radius)


def filling_check(parts: HousingParts) -> Check:
    """Check that the balls can be put in through the open cover side."""
    gap = filling_gap_of(parts)
    side = "beside the others" if last_ball_passes(parts) else "but the last one not beside the others"
    passed = gap >= LEAST_FILLING and last_ball_passes(parts)
    message = (
        f"The balls go in one by one before the cover is {parts.closure}, between hub and edge of the race, {side}"
    )
    remedy = "Enlarge the race, reduce the bore, or use smaller or fewer balls."
    return coded("ABU305", verdict(passed), message, from_si(gap, "mm"), from_si(LEAST_FILLING, "mm"), "mm",
                 None if passed else remedy, "least")  # fmt: skip


def last_ball_passes(parts: HousingParts) -> bool:
    """True if the last ball, at the race's edge, passes between the others, pushed together in the race."""
    balls, size = parts.balls, parts.dimensions
    half = math.pi - math.asin(min(1.0, balls.diameter / 2 / balls.pitch_radius)) * (balls.count - 2)
    if half <= 0:
        return False
    entry = size.shoulder_radius - balls.diameter / 2
    squared = entry**2 + balls.pitch_radius**2 - 2 * entry * balls.pitch_radius * math.cos(min(half, math.pi))
    return math.sqrt(squared) >= balls.diameter


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


def overspeed_check(parts: HousingParts, force: float, top: float) -> Check:
    """Check of the stresses of wall and body at overspeed, as a share of what each material bears; `force` at top."""
    size, speed = parts.dimensions, OVERSPEED * top
    race = MATERIALS[parts.race_part.density]
    body = MATERIALS[parts.body.density]
    wall = Ring(size.race_radius, size.ring_radius, race)
    width = size.ring_end - size.web
    stressed = {
        "wall of the race": (wall_stress(wall, width, OVERSPEED**2 * force, parts.balls.diameter, speed), race),
        "bore of the body": (spin_stress(Ring(size.bore_radius, size.outer_radius, body), speed), body),
        "hole of the cover": (spin_stress(Ring(size.hub_radius, size.seat_radius, body), speed), body),
    }
    place, (stress, material) = max(stressed.items(), key=lambda pair: pair[1][0] / pair[1][1].strength)
    limit = PROOF_SHARE * material.strength
    passed = stress <= limit
    remedy = "Thicken the wall (autobalancer.min_wall_mm), or reduce the race or the highest speed."
    return coded(
        "ABU306", verdict(passed), f"Hoop and spin stress at 1.2 × the highest speed, largest at the {place} "
        f"({material.name})", from_si(stress, "MPa"), from_si(limit, "MPa"), "MPa", None if passed else remedy,
    )  # fmt: skip


@formula(
    "Burst speed over the highest speed",
    "√(Σ σ_m·A_p/(Σ ρ·Ω²·∫ r_m² dA + n·F/2))",
    "1",
    signs="σ_m A_p ρ Ω r_m n F",
    where=(
        "Each half of the housing pulls on the cut through the axis. A_p is the area of a part's half section, "
        "∫ r_m² dA its second moment about the axis, σ_m its strength; all n balls lie on one side."
    ),
    assumed="the section yields as a whole before it bursts (Robinson), at the yield strength; the ring of a housing "
    "counts as a hard ring at the same strength",
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
    return coded(
        "ABU309", verdict(passed), "Burst speed over the highest speed, by the mean hoop stress with all balls on one "
        "side; the cover counts as load alone", ratio, BURST_RATIO, "", None if passed else
        "Thicken the wall (autobalancer.min_wall_mm), or reduce the race or the highest speed.", "least",
    )  # fmt: skip


def containment_check(case: Case, parts: HousingParts, top: float) -> Check:
    """Check that the guard stops a ball; not evaluated if no guard is given."""
    energy = parts.balls.mass * (OVERSPEED * top * parts.balls.pitch_radius) ** 2 / 2
    least = perforated_thickness(energy, parts.balls.diameter)
    given = case.autobalancer.guard_thickness_mm
    message = f"A ball that leaves the housing at 1.2 × the highest speed has {energy:.3g} J"
    if given is None:
        return coded(
            "ABU310", "not-done", f"autobalancer.guard_thickness_mm is not given. {message}, which "
            f"{from_si(least, 'mm'):.2g} mm of mild steel stop", None, from_si(least, "mm"), "mm",
            "Specify autobalancer.guard_thickness_mm.", "least", requested=False,
        )  # fmt: skip
    passed = to_si(given, "mm") >= least
    return coded("ABU310", verdict(passed), f"{message}, which the guard of mild steel must stop", given,
                 from_si(least, "mm"), "mm", None if passed else "Specify a thicker guard.", "least")  # fmt: skip


@formula(
    "Thickness of mild steel that stops a ball, with a factor of 1.5 on its energy",
    "(1.5·E_b/1.4e9)^(2/3)/d",
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
