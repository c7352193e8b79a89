"""Results of a run at the work, read from motions that are known; copies and times of chaotic runs."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.features.grinding.simulation import (
    COPIES,
    SECONDS,
    _copies,
    _times,
    harmonic_force,
    only_contact,
    read,
)
from abu_calc.simulation.response import SAMPLES_PER_REVOLUTION
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing import size
from tests.sizing.machines import machine


@pytest.fixture(scope="module")
def scene() -> Scene:
    grinding = {"contact_stiffness_N_per_m": 4.9e5, "press_force_N": 45.0}
    return scene_of_design(size(machine(wheel__runout_mm=0.0, grinding=grinding)), "grinding")


def test_a_circling_axis_comes_back_as_its_phasors(scene: Scene) -> None:
    """x = A·cos(Ωt + a), y = B·cos(Ωt + b) about a place of 2 µm: N = N₀ − c·y, so N_c = −c·Y on a true wheel."""
    turns, omega = 3, scene.speed
    times = np.arange(turns * SAMPLES_PER_REVOLUTION + 1) * (math.tau / omega / SAMPLES_PER_REVOLUTION)
    X, Y = cmath.rect(2e-5, 0.4), cmath.rect(1e-5, -1.0)
    turn = np.exp(1j * omega * times)
    states = np.zeros((scene.state_count, len(times)))
    states[0], states[1] = (X * turn).real, (Y * turn).real + 2e-6
    for k, angle in enumerate(np.linspace(0, math.tau, len(scene.ball_masses), endpoint=False)):
        states[2 * len(scene.support.names) + k] = angle
    plain = replace(only_contact(scene))
    result = read(plain, times, states)
    assert result.axis == (pytest.approx(X), pytest.approx(Y))
    assert result.x == pytest.approx(2e-5, rel=1e-3) and result.y == pytest.approx(1e-5, rel=1e-3)
    assert result.reaction == pytest.approx(-4.9e5 * Y, rel=1e-6)
    assert result.force.mean() == pytest.approx(45.0 - 4.9e5 * 2e-6) and not result.parts and result.apart == 0.0
    # Balls evenly round the race carry nothing: what is left is the imbalance of the wheel.
    assert abs(result.imbalance - scene.imbalance * cmath.exp(1j * scene.imbalance_angle)) < 1e-9
    # The point that is at the work while it presses hardest.
    hardest = max(result.profile, key=lambda point: point[1])[0]
    assert abs(math.remainder(hardest - cmath.phase(result.pressure), math.tau)) < 2 * math.tau / SAMPLES_PER_REVOLUTION


def test_only_the_contact_is_left_of_the_effects(scene: Scene) -> None:
    kept = only_contact(scene).effects
    assert kept and all(isinstance(effect, GrindingContactEffect) for effect in kept)
    assert len(scene.effects) > len(kept)


def test_a_force_that_would_pull_is_none() -> None:
    """100 ± 50 N has the mean of 100; 0 + 50 cos is a half-wave, whose mean is 50/π."""
    assert harmonic_force(100.0, 30 + 40j).mean() == pytest.approx(100.0)
    assert harmonic_force(100.0, 30 + 40j).max() == pytest.approx(150.0, rel=1e-4)
    half = harmonic_force(0.0, 50 + 0j)
    assert half.min() == 0.0 and half.mean() == pytest.approx(50 / math.pi, rel=1e-4)


def test_copies_differ_in_their_start_alone(scene: Scene) -> None:
    copies = list(_copies(scene))
    assert len(copies) == COPIES and len({copy.races[0].start_angles for copy in copies}) == COPIES
    for copy in copies:
        turns = copy.duration / scene.revolution
        assert turns == pytest.approx(round(turns)) and copy.duration == pytest.approx(SECONDS, abs=scene.revolution)
        times = _times(copy)
        assert times[-1] == copy.duration and (len(times) - 1) % SAMPLES_PER_REVOLUTION == 0
        assert (times[-1] - times[0]) / copy.duration == pytest.approx(2 / 3, abs=0.01)
