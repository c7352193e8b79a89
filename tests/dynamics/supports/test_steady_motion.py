"""Steady motion of a support without balls: receptance, the largest excursion, and what errors are measured in."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import (
    receptance,
    reference_imbalance,
    unbalanced_amplitude,
    weighing_amplitude,
)
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import SUPPORTS, dimensionless, scene_on


@pytest.mark.parametrize("support", [name for name in SUPPORTS if name != "swing arm"])
@pytest.mark.parametrize("speed", [0.9, 1.7, 6.0])
def test_the_amplitude_is_the_largest_excursion_of_the_ellipse(support: str, speed: float) -> None:
    scene = replace(scene_on(support), speed=speed)
    h = receptance(scene.support, speed)
    pulls = [(scene.imbalance, scene.imbalance_angle), (scene.couple, scene.couple_angle)]
    forces = np.array([u * np.exp(1j * a) * unit for u, a in pulls for unit in (1, -1j)])[: len(h)] * speed**2
    phases = np.exp(1j * np.linspace(0, 2 * math.pi, 20001))
    x, y = ((h[row] @ forces) * phases for row in (0, 1))
    assert unbalanced_amplitude(scene) == pytest.approx(np.hypot(x.real, y.real).max(), rel=1e-7)


def test_a_mass_far_above_its_resonance_moves_by_its_eccentricity() -> None:
    """A₀ → m₀e/M, whatever springs and dampers."""
    scene = dimensionless(1e4, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0)
    assert unbalanced_amplitude(scene) == pytest.approx(0.02, rel=1e-6)
    assert unbalanced_amplitude(scene, 0.5) == pytest.approx(0.5, rel=1e-6)


def test_a_resonance_that_nothing_damps_is_refused_beside_it_too() -> None:
    scene = dimensionless(1.0, 0.01, 0.02, 0.0, 0.05, (0.4, 1.0), 10.0)
    for speed in (1.0, 1.0 + 1e-14):
        with pytest.raises(InputError, match="nothing damps"):
            unbalanced_amplitude(replace(scene, speed=speed))
    assert unbalanced_amplitude(replace(scene, speed=1.001)) == pytest.approx(
        0.02 * 1.001**2 / (1.001**2 - 1), rel=1e-9
    )


def test_errors_are_measured_against_one_per_cent_of_the_balls_at_least() -> None:
    balanced = dimensionless(3.0, 0.01, 0.0, 0.3, 0.05, (0.4, 1.0), 10.0)
    assert reference_imbalance(balanced) == pytest.approx(0.01 * 0.02)
    assert reference_imbalance(replace(balanced, imbalance=0.3)) == 0.3
    assert weighing_amplitude(balanced) == pytest.approx(0.01 * unbalanced_amplitude(balanced, 2e-4), rel=1e-12)


def test_receptance_is_symmetric_without_a_turning_rotor() -> None:
    """Maxwell: what a force at one place does at another, it does the other way round."""
    h = receptance(SUPPORTS["coupled"], 1.3)
    np.testing.assert_allclose(h, h.T, rtol=1e-12)
    np.testing.assert_allclose(receptance(planar(2.0, (5.0, 3.0), (0.0, 0.0)), 0.0), np.diag((0.2, 1 / 3)), rtol=1e-15)
