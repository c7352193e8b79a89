"""Step 6: the race and what it bears."""

import math
from dataclasses import dataclass

from abu_calc.checks import Check, verdict
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, STEEL, groove_radius
from abu_calc.sizing.slow_motion import ball_stiffness, optimum_drag, slow_stiffness
from abu_calc.sizing.stress import (
    hertz_ball_in_toroid,
    hertz_roller_in_cylinder,
    hoop_stress,
    permitted_pressure,
    ring_flexure,
)
from abu_calc.standards.hardness import vickers
from abu_calc.units import GRAVITY, from_si, to_si

LEAST_HARDNESS_HRC = 58.0
HOOP_LIMIT = {STEEL: to_si(200, "MPa"), ALUMINIUM: to_si(80, "MPa")}
"""Assumed: a third of the yield strength of plain steel and wrought aluminium."""


@dataclass(frozen=True)
class Track:
    """Race geometry, force and stress at the highest speed, slow dynamics at the rated one [SI]."""

    groove_radius: float | None
    ball_force: float
    contact_pressure: float
    permitted_pressure: float
    hoop_stress: float
    free_ring_ovality: float
    carry_over: float
    ball_stiffness: float
    optimum_drag: float | None


def carry_over_speed(pitch_radius: float) -> float:
    """Least speed [rad/s] that carries balls round a horizontal axis: √(g/R_p).

    Range: horizontal spindle; below it balls rattle in the bottom of the race. Source: derived.

    >>> round(from_si(carry_over_speed(23e-3), "rpm"))
    197
    """
    return math.sqrt(GRAVITY / pitch_radius)


def track(case: Case, one: Candidate, frequencies: tuple[float, float]) -> Track:
    """Track of one candidate; stresses at the top of the speed range."""
    top, radius, outer = case.speed_range[1], one.ball_diameter / 2, one.housing.outer_diameter / 2
    force = one.ball_mass * one.pitch_radius * top**2
    wall = 1e-3 * case.autobalancer.min_wall_mm
    kappa = ball_stiffness(one.ball_mass, one.requirement.effective_mass, case.speed, frequencies)
    slowest, _ = slow_stiffness((kappa,) * one.ball_count, one.budget.resting_angles)
    groove = groove_radius(one.race_radius, radius) if case.autobalancer.corrector == "ball" else None
    pressure = (
        hertz_roller_in_cylinder(force, radius, one.race_radius, one.ball_diameter)
        if groove is None
        else hertz_ball_in_toroid(force, radius, one.race_radius, groove)
    )
    return Track(
        groove_radius=groove,
        ball_force=force,
        contact_pressure=pressure,
        permitted_pressure=permitted_pressure(vickers(case.autobalancer.race_hardness_HRC)),
        hoop_stress=hoop_stress(top, outer, _rim_density(case)),
        free_ring_ovality=ring_flexure(force, one.race_radius, one.housing.width, wall),
        carry_over=carry_over_speed(one.pitch_radius),
        ball_stiffness=kappa,
        optimum_drag=optimum_drag(slowest, case.inertia_factor) if slowest > 0 else None,
    )


def track_checks(case: Case, result: Track) -> tuple[Check, ...]:
    """Pressure, hardness, hoop stress, and on a horizontal spindle that the balls are carried over."""
    hardness = case.autobalancer.race_hardness_HRC
    pressure, permitted = from_si(result.contact_pressure, "MPa"), from_si(result.permitted_pressure, "MPa")
    hoop, limit = from_si(result.hoop_stress, "MPa"), from_si(HOOP_LIMIT[_rim_density(case)], "MPa")
    checks = [
        Check("ABU301", "contact pressure", verdict(pressure <= permitted), "Hertz pressure of a ball at top speed "
              "against 5.2·HV, which leaves no dent (assumed rule)", pressure, permitted, "MPa",
              None if pressure <= permitted else "A harder race, more and smaller balls, or a smaller race radius."),
        Check("ABU302", "race hardness", verdict(hardness >= LEAST_HARDNESS_HRC), "a soft race dents, and dents hold "
              "the balls: machines with soft races gained nothing", hardness, LEAST_HARDNESS_HRC, "HRC",
              None if hardness >= LEAST_HARDNESS_HRC else "Harden the race to 60–63 HRC and grind it.", "least"),
        Check("ABU303", "hoop stress", verdict(hoop <= limit), "spinning rim at top speed (limit assumed)", hoop, limit,
              "MPa", None if hoop <= limit else "Reduce the outer diameter, or choose the one-piece steel design."),
    ]  # fmt: skip
    if case.table.machine.spindle_axis == "horizontal":
        lowest, needed = from_si(case.speed_range[0], "rpm"), from_si(result.carry_over, "rpm")
        checks.append(
            Check("ABU102", "ball carry-over", verdict(lowest > needed), "lowest speed carries the balls round the "
                  "horizontal spindle", lowest, needed, "rpm",
                  None if lowest > needed else "Raise the lowest speed, or enlarge the race.", "least")
        )  # fmt: skip
    return tuple(checks)


def _rim_density(case: Case) -> float:
    return ALUMINIUM if case.autobalancer.design == "light" else STEEL
