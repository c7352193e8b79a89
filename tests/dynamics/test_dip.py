"""A rotor whose speed dips after its run-up: against equations of its own, and what a pause does to balls that hang."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.simulation.simulate import simulate

FULL, LOW = 4000 * math.pi / 30, 1100 * math.pi / 30
MASS, IMBALANCE, BALL, PLACE, RADIUS, DRAG, INERTIA = 2.919, 300e-6, 9e-3, 0.0199, 5.5e-3, 4.0, 1.4
NATURAL, RATIO = 60 * math.pi, 0.02
START = 0.07, 0.63
"""Two balls without size or friction on springs of 30 Hz; that drag lets them hang."""

Course = list[tuple[float, float]]
"""Speeds [rad/s] at times [s], straight lines between."""


def own(course: Course, rtol: float) -> Any:
    """Place and velocity of the axis, angles and speeds of the balls in the race at the end: theory by hand.

    J γ'' + h₀ (γ' − Ω) = (J − 1)(R/R_p) Ω' + (x'' sin γ − y'' cos γ)/R_p, R = R_p + r, put into the two equations of
    the support, M the mass with the balls.
    """
    mass = MASS + 2 * BALL
    stiffness, damping = mass * NATURAL**2, 2 * RATIO * NATURAL * mass
    end, turned = np.array([0.0, 0.0, 0.0, 0.0, *START, 0.0, 0.0]), 0.0
    for (begin, first), (stop, last) in pairwise(course):
        rise = (last - first) / (stop - begin)

        def rates(t: float, y: Any, begin: float, first: float, rise: float, turned: float) -> Any:
            speed = first + rise * (t - begin)
            turn = turned + (speed + first) / 2 * (t - begin)
            angle, spin = turn + y[4:6], speed + y[6:]
            sin, cos, moment, share = np.sin(angle), np.cos(angle), BALL * PLACE, BALL / INERTIA
            alone = (-DRAG * y[6:] + (INERTIA - 1) * (1 + RADIUS / PLACE) * rise) / INERTIA
            a, b, d = mass - share * sin @ sin, share * sin @ cos, mass - share * cos @ cos
            pulled = IMBALANCE * (speed**2 - 1j * rise) * np.exp(1j * turn)
            x = pulled.real - stiffness * y[0] - damping * y[2] + moment * (spin**2 @ cos + alone @ sin)
            z = pulled.imag - stiffness * y[1] - damping * y[3] + moment * (spin**2 @ sin - alone @ cos)
            ax, ay = (x * d - z * b) / (a * d - b * b), (z * a - x * b) / (a * d - b * b)
            along = alone + (ax * sin - ay * cos) / (INERTIA * PLACE)
            return np.array([y[2], y[3], ax, ay, *y[6:], *(along - rise)])

        given = (begin, first, rise, turned)
        end = solve_ivp(rates, (begin, stop), end, args=given, rtol=rtol, atol=1e-3 * rtol).y[:, -1]
        turned += (first + last) / 2 * (stop - begin)
    return end


def scene(effect: RunUpEffect, duration: float) -> Scene:
    """The same as a scene."""
    mass = MASS + 2 * BALL
    held = planar(MASS, (mass * NATURAL**2,) * 2, (2 * RATIO * NATURAL * mass,) * 2)
    race = Race(PLACE, (BALL,) * 2, DRAG, INERTIA, START, (0.0, 0.0), ball_radius=RADIUS)
    return Scene("dip", held, FULL, IMBALANCE, 0.0, (race,), duration, (0.0, 0.0), (0.0, 0.0), effects=(effect,))


@pytest.mark.slow
@pytest.mark.parametrize("up", [0.0, 0.2])
def test_a_dip_by_other_equations(up: float) -> None:
    """From rest and from full speed, to the last digits that two integrators share."""
    effect = RunUpEffect(up, low=LOW, fall=0.1, pause=0.05, rise=0.15)
    course = [(up, FULL), (up + 0.1, LOW), (up + 0.15, LOW), (up + 0.3, FULL), (up + 0.4, FULL)]
    expected = own([(0.0, 0.0), *course] if up else course, 1e-9)
    found = simulate(scene(effect, up + 0.4), accuracy=1e-5, integrator="scipy")
    assert found.response.final.rotor_speed == pytest.approx(FULL, rel=1e-9)
    assert found.trajectory.y[:8, -1] == pytest.approx(expected, rel=1e-3, abs=1e-7)
    assert effect.at_speed == pytest.approx(up + 0.3)


def test_a_dip_that_is_none() -> None:
    """Changes nothing of a run-up, and a run has to be long enough for one."""
    bare = scene(RunUpEffect(0.3), 0.5)
    assert RunUpEffect(0.3, low=LOW, pause=2.0, rise=1.0).breaks(bare) == RunUpEffect(0.3).breaks(bare) == (0.3,)
    with pytest.raises(Exception, match="before the run-up"):
        RunUpEffect(0.3, low=LOW, fall=0.1, pause=2.0, rise=1.0).breaks(replace(bare, duration=2.0))
