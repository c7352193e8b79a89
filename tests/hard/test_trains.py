"""Many elastic balls and long trains: their cost is the number of impacts, and each costs no more than must be.

Counted are events and evaluations, never seconds: 64 balls take some 1.5 µs for an evaluation in compiled code.
"""

import math

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.integrators.compiled.run import integrate
from abu_calc.dynamics.trajectory import Trajectory
from tests.hard.scenes import machine

pytestmark = [pytest.mark.hard, pytest.mark.skipif(not installed(), reason="plain code takes minutes")]

SPEED = 100 * math.pi
TOLERANCE = 2e-5
"""That of the first run at the usual accuracy."""


def run(angles: np.ndarray, radius: float, pitch_radius: float, restitution: float, duration: float) -> Trajectory:
    """A machine of 5 kg and 13 Hz at 3000 rpm with balls of 0.5 g; order and room are kept by all balls."""
    scene = machine(
        SPEED, tuple(angles.tolist()), duration, BallContactEffect(radius, restitution), ball_mass=5e-4,
        pitch_radius=pitch_radius, drag=10.0, imbalance=2e-3, inertia_factor=1.0,
    )  # fmt: skip
    found = integrate(assemble(scene), TOLERANCE, np.linspace(0, duration, 21))
    ordered = found.y[4 : 4 + len(angles)]
    gaps = np.diff(np.vstack([ordered, ordered[:1] + 2 * math.pi]), axis=0)
    assert gaps.min() >= 2 * math.asin(radius / pitch_radius) - 2e-6
    return found


def test_elastic_balls_come_to_rest_against_each_other() -> None:
    """64 balls, e = 1: drag ends the bouncing after 94 000 impacts; with rebounds down to 1e-6 rad it took 740 000."""
    places = 2 * math.pi / 64 * np.arange(64) + math.radians(1.3) * np.sin(7 * np.arange(64))
    found = run(places, 0.002, 0.060, 1.0, 2.0)
    assert found.events < 200_000
    assert found.evaluations < 20 * found.events
    assert np.abs(found.y[-64:, -1]).max() < 1e-2


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_a_packed_train_of_a_hundred(restitution: float) -> None:
    """An impact asks at most once for each of the 99 pairs that touch, and a little more."""
    places = 2 * math.asin(0.0015 / 0.080) * (1 + 1e-12) * np.arange(100)
    found = run(places, 0.0015, 0.080, restitution, 0.5)
    assert 10 < found.events < 20_000
    assert found.evaluations < 40 * found.steps + 110 * found.events
