"""From a design to its scenes."""

import math
from typing import Final, Literal

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.linear import planar
from abu_calc.sizing.ball_ring import half_angle
from abu_calc.sizing.design import Design
from abu_calc.sizing.suspension import Springs

AHEAD = math.radians(20)
"""The bunch starts this far ahead of the imbalance: on the heavy side, and not in unstable equilibrium."""

Start = Literal["bunched", "spread", "standstill"]

STARTS: Final[dict[Start, str]] = {
    "bunched": "balls at rest in the race, neighbours touching, their middle 20° ahead of the imbalance",
    "spread": "balls at rest in the race, evenly round it, the first 20° ahead of the imbalance",
    "standstill": "balls not turning at all, neighbours touching, their middle 20° ahead of the imbalance",
}

DECAY_TIMES = 7.0
LONGEST_REVOLUTIONS = 400.0
LEAST_REVOLUTIONS = 40.0
MOST_CYCLES = 4000.0
"""Of the speed or of the suspension, whichever is faster: a few seconds of work."""


def idle_scene(design: Design, start: Start = "bunched") -> Scene | None:
    """The machine idling at full speed; None on supports without a scene yet.

    The axis starts at rest at its place, the balls as `STARTS` tells. Planar springs; the mass is that felt at the
    wheel, without balls. It lasts seven decay times of the slow motion of the balls and of the suspension's own sway,
    within bounds.
    """
    case, one = design.case, design.autobalancer
    if not isinstance(case.suspension, Springs):
        return None
    mass = one.requirement.effective_mass - one.ball_count * one.ball_mass
    race = Race(
        pitch_radius=one.pitch_radius,
        ball_masses=(one.ball_mass,) * one.ball_count,
        drag=case.drag,
        inertia_factor=case.inertia_factor,
        start_angles=_start_angles(design, start),
        start_speeds=(-case.speed if start == "standstill" else 0.0,) * one.ball_count,
    )
    return Scene(
        name="idle",
        support=planar(mass, case.suspension.stiffness, case.suspension.damping),
        speed=case.speed,
        imbalance=design.imbalance.value * abs(one.requirement.plane_ratio),
        imbalance_angle=0.0,
        race=race,
        duration=_duration(design, case.suspension),
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )


def contact_half_angle(design: Design) -> float:
    """Half the angle between touching balls [rad]."""
    one = design.autobalancer
    return half_angle(one.ball_diameter / 2, one.pitch_radius)


def _start_angles(design: Design, start: Start) -> tuple[float, ...]:
    count = design.autobalancer.ball_count
    if start == "spread":
        return tuple(AHEAD + k * 2 * math.pi / count for k in range(count))
    beta = contact_half_angle(design)
    return tuple(AHEAD + (2 * k - count + 1) * beta for k in range(count))


def _duration(design: Design, support: Springs) -> float:
    """Seven decay times of whatever dies out last, balls or suspension, within bounds that keep the work reasonable."""
    case, mass = design.case, design.autobalancer.requirement.effective_mass
    revolution = 2 * math.pi / case.speed
    _, balls = design.track.decay_rates[0]
    sway = min(_sway_rate(mass, c, b) for c, b in zip(support.stiffness, support.damping, strict=True))
    wanted = max(DECAY_TIMES / rate if rate > 0 else math.inf for rate in (balls, sway))
    longest = max(LONGEST_REVOLUTIONS * revolution, 3 * case.table.limits.settling_time_s)
    fastest = max(case.speed, *(math.sqrt(c / mass) for c in support.stiffness))
    cap = max(MOST_CYCLES * 2 * math.pi / fastest, 2 * revolution)
    return min(max(wanted, LEAST_REVOLUTIONS * revolution), longest, cap)


def _sway_rate(mass: float, stiffness: float, damping: float) -> float:
    """Slower decay rate [1/s] of m·s² + b·s + c = 0."""
    half = damping / (2 * mass)
    root = half**2 - stiffness / mass
    return half if root <= 0 else half - math.sqrt(root)
