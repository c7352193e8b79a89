"""Stability of balls in a body in space, where the planar model leaves something out: gyroscopic moments, hands.

The planar model has the effective mass m_F on the springs of the file. On springs of one frequency that is enough. A
rotor with gyroscopic moments moves the boundary by 0.6 … 3 %, and hands hold the body at its handles.
"""

from dataclasses import replace

from abu_calc.features.grinding.formulas import growing_roots
from abu_calc.formulas.body_motion import BodyMotion, whirl_receptances
from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.formula import formula
from abu_calc.sizing.budget import judged_speeds
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import body_suspension

SPREADS = (0.0, 0.5, 1.0)
"""|Σe^{2iθ}|/n of balls evenly spread, between, and in two groups side by side or opposite."""


@formula(
    "Small motions of balls that balance, in a body on any linear suspension",
    "Λ² − ½·n·m·(P_F + P_B)·Λ + (½·n·m)²·(1 − χ₂²)·P_F·P_B = 0",
    where=(
        "P_F and P_B are the fourth powers of λ + iΩ and λ − iΩ times the receptances of forward and backward whirl at "
        "the race, the balls' mass on it. Λ is J·λ² + h₀·λ. A root with a growing λ makes the balanced state unstable."
    ),
    signs="J h₀ λ Ω",
    assumed="small motion; equal balls",
    source="derived; within 0.04 % of Floquet multipliers of six degrees of freedom",
)
def growing_whirls(
    motion: BodyMotion, race: Vector, ball_mass: float, spread: float, drag: float, inertia_factor: float
) -> int:
    """Number of growing roots; `ball_mass` n·m [kg], `spread` χ₂ = |Σe^{2iθ}|/n."""
    half = ball_mass / 2

    def value(s: complex) -> complex:
        forward, backward = whirl_receptances(motion, race, s, ball_mass)
        ahead, back = (s + 1j * motion.speed) ** 4 * forward, (s - 1j * motion.speed) ** 4 * backward
        inertia = inertia_factor * s * s + drag * s
        return inertia**2 - half * (ahead + back) * inertia + half**2 * (1 - spread**2) * ahead * back

    return growing_roots(value, motion.speed)


def unstable_speed(design: Design) -> float | None:
    """The first judged speed [rad/s] at which a whirl of the body in space grows; None if there is none.

    None also if the planar model holds: no gyroscopic moments, and springs.
    """
    case, autobalancer = design.case, design.autobalancer
    suspension = body_suspension(case, carrying=True)
    hands = case.table.suspension.model == "hands"
    if not case.body.in_space or suspension is None or not (case.body.body.rotor_polar_inertia or hands):
        return None
    balls = autobalancer.balls_mass
    body = replace(case.body.body, mass=case.body.mass + autobalancer.mass - balls)
    for speed in judged_speeds(case):
        motion = BodyMotion(body, speed, suspension)
        for spread in SPREADS:
            if growing_whirls(motion, case.race_place, balls, spread, case.drag, case.inertia_factor):
                return speed
    return None
