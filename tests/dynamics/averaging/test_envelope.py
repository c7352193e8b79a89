"""The averaged slow motion: the whirl it gives, races in two planes, and where it does not hold."""

from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.averaging.envelope import averages, envelope, not_averaged
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.tilting import tilting
from tests.dynamics.scenes import dimensionless

LIGHT = dimensionless(3.0, 2e-4, 1e-4, 0.3, 0.04, (0.4, 1.0), 400.0)


def test_a_resonance_that_nothing_damps_is_not_averaged():
    mass = 1 + 2 * 2e-4
    scene = replace(LIGHT, speed=1.0, support=planar(1.0, (mass, mass), (0.0, 0.0)))
    assert "nearest natural frequency" in (not_averaged(scene) or "")


def test_whirl_of_the_envelope_is_the_steady_response():
    """Balls held in their places are more imbalance: the response of the support with their mass, by hand."""
    scene = dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0)
    total = 0.02 + 0.01 * (np.exp(0.4j) + np.exp(1j))
    w = total * 9 / complex(1 - 9 * 1.02, 3 * 0.6)
    assert averages(scene).whirl(np.array((0.4, 1.0)))[0] == pytest.approx(w, rel=1e-12)


def test_balls_of_two_planes_are_averaged_apart():
    """On a support that tilts without coupling two like races share alike."""
    support = tilting(1.0, 0.1, 0.05, (0.2, -0.2), ((0.5, 0.5),) * 2, ((0.1, 0.1),) * 2)
    base = dimensionless(3.0, 0.005, 0.004, 0.1, 0.05, (1.5, -1.7), 400.0)
    races = tuple(replace(base.races[0], plane_offset=z) for z in (0.1, -0.1))
    scene = replace(base, support=support, races=races, start_position=(0.0,) * 4, start_velocity=(0.0,) * 4)
    slow = envelope(scene, 1e-8, np.linspace(0, 400, 101))
    np.testing.assert_allclose(slow.theta[:2], slow.theta[2:], atol=1e-5)
