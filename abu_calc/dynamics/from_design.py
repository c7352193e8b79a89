"""From a design to its scenes."""

import math

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.linear import planar
from abu_calc.sizing.ball_ring import half_angle
from abu_calc.sizing.design import Design
from abu_calc.sizing.suspension import Springs

AHEAD = math.radians(20)
"""The bunch starts this far ahead of the imbalance: on the heavy side, and not in unstable equilibrium."""

DECAY_TIMES = 8.0
LONGEST_REVOLUTIONS = 400.0
LEAST_REVOLUTIONS = 40.0


def idle_scene(design: Design) -> Scene | None:
    """The machine idling at full speed with its balls bunched on the heavy side; None on supports without a scene yet.

    The axis starts at rest at its place, the balls at rest in the race, neighbours touching, their middle 20° ahead of
    the imbalance. Planar springs; the mass is that felt at the wheel, without balls. It lasts eight decay times of the
    slow motion of the balls, between 40 and 400 revolutions.
    """
    case, one = design.case, design.autobalancer
    if not isinstance(case.suspension, Springs):
        return None
    mass = one.requirement.effective_mass - one.ball_count * one.ball_mass
    beta = half_angle(one.ball_diameter / 2, one.pitch_radius)
    angles = tuple(AHEAD + (2 * k - one.ball_count + 1) * beta for k in range(one.ball_count))
    race = Race(
        pitch_radius=one.pitch_radius,
        ball_masses=(one.ball_mass,) * one.ball_count,
        drag=case.drag,
        inertia_factor=case.inertia_factor,
        start_angles=angles,
        start_speeds=(0.0,) * one.ball_count,
    )
    return Scene(
        name="idle",
        support=planar(mass, case.suspension.stiffness, case.suspension.damping),
        speed=case.speed,
        imbalance=design.imbalance.value * one.requirement.plane_ratio,
        imbalance_angle=0.0,
        race=race,
        duration=_duration(design),
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )


def _duration(design: Design) -> float:
    """Eight decay times of the slow motion of the balls where it decays, within bounds counted in revolutions."""
    case = design.case
    revolution = 2 * math.pi / case.speed
    _, rate = design.track.decay_rates[0]
    wanted = DECAY_TIMES / rate if rate > 0 else math.inf
    longest = max(LONGEST_REVOLUTIONS * revolution, 3 * case.table.limits.settling_time_s)
    return min(max(wanted, LEAST_REVOLUTIONS * revolution), longest)
