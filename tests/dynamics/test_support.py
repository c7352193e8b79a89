"""What a scene tells of itself: revolution, balls, what its effects tell together, and what it refuses.

Small motion of a support about rest, against the closed forms of one mass on a spring.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.rotor import STEADY
from abu_calc.dynamics.support import SmallMotion, Unbalance
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import SUPPORTS, scene_on


def test_what_a_scene_tells_is_what_its_effects_tell():
    scene = scene_on("planar")
    assert (scene.rotor, scene.start_speed, scene.run_down, scene.holding) == (STEADY, scene.speed, 0.0, None)
    scene = scene_on("planar", BallContactEffect(0.1, 0.5), DryRollingFrictionEffect(0.02, 0.1))
    assert scene.balls_meet and scene.holding.friction == pytest.approx(0.2)
    scene = scene_on("planar", TransverseMotionEffect(0.7, 0.1))
    assert scene.ball_states == ("across", "across'")


def test_a_revolution_is_a_whole_turn() -> None:
    scene = scene_on("planar")
    assert scene.revolution * scene.speed == pytest.approx(2 * math.pi, rel=1e-15)
    assert scene.unbalance == Unbalance(scene.imbalance, scene.imbalance_angle, scene.couple, scene.couple_angle)


def test_small_motion_carries_the_balls() -> None:
    """Five balls of 0.75 kg on 2 kg: √(k/m) along x and y, less what dampers take."""
    motion = scene_on("planar").small_motion
    np.testing.assert_allclose(motion.mass, np.diag((2.75, 2.75)))
    frequencies = sorted({round(abs(value), 12) for value in np.linalg.eigvals(motion.motion)})
    assert frequencies == pytest.approx([math.sqrt(3.0 / 2.75), math.sqrt(5.0 / 2.75)])


@pytest.mark.parametrize(("change", "words"), [
    ({"speed": 0.0}, "speed"), ({"start_velocity": (0.0,)}, "one value for each support coordinate"),
    ({"start_position": (0.0, math.inf)}, "start position"),
])  # fmt: skip
def test_circumstances_that_cannot_be_are_refused(change: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        replace(scene_on("planar"), **change)


MASS, STIFFNESS, DAMPING = 2.0, 5.0, 0.3
SINGLE = SmallMotion(MASS * np.eye(2), DAMPING * np.eye(2), STIFFNESS * np.eye(2), np.eye(2))
UNDAMPED = SmallMotion(MASS * np.eye(2), 0.0 * np.eye(2), STIFFNESS * np.eye(2), np.eye(2))


@pytest.mark.parametrize("frequency", [0.0, 0.9, math.sqrt(2.5), 40.0])
def test_a_mass_on_a_spring_answers_as_it_must(frequency: float) -> None:
    expected = 1 / complex(STIFFNESS - MASS * frequency**2, frequency * DAMPING)
    np.testing.assert_allclose(SINGLE.receptance(frequency), expected * np.eye(2), rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize("support", SUPPORTS)
def test_the_slope_of_an_answer_is_the_limit_of_differences(support: str) -> None:
    motion, step = scene_on(support).small_motion, 1e-5
    _, slope = motion.answer(1.3)
    difference = (motion.answer(1.3 + step)[0] - motion.answer(1.3 - step)[0]) / (2 * step)
    np.testing.assert_allclose(slope, difference, rtol=1e-6, atol=1e-8)


def test_an_undamped_resonance_has_no_steady_motion() -> None:
    with pytest.raises(InputError, match="nothing damps"):
        SmallMotion(np.eye(2), 0 * np.eye(2), 4 * np.eye(2), np.eye(2)).receptance(2.0)
    assert UNDAMPED.left_of_stiffness(math.sqrt(STIFFNESS / MASS)) < 1e-15
    assert UNDAMPED.left_of_stiffness(0.0) == pytest.approx(1.0)


def test_rates_of_free_motion_are_those_of_a_damped_spring() -> None:
    decay = DAMPING / (2 * MASS)
    swing = math.sqrt(STIFFNESS / MASS - decay**2)
    values = np.linalg.eigvals(SINGLE.motion)
    np.testing.assert_allclose(values.real, -decay, rtol=1e-9)
    np.testing.assert_allclose(np.abs(values.imag), swing, rtol=1e-9)


@pytest.mark.parametrize("t", [0.0, 3.0, 20.0])
def test_a_sudden_force_lets_the_axis_swing_about_its_new_place(t: float) -> None:
    """By F/k without damping, for ever; with it e^{−ζωt}/√(1 − ζ²) of that."""
    force = np.array((0.7, 0.0))
    assert UNDAMPED.swinging(force, t) == pytest.approx(0.7 / STIFFNESS, rel=1e-9)
    decay, natural = DAMPING / (2 * MASS), math.sqrt(STIFFNESS / MASS)
    expected = 0.7 / STIFFNESS * math.exp(-decay * t) / math.sqrt(1 - (decay / natural) ** 2)
    assert SINGLE.swinging(force, t) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("support", [name for name, held in SUPPORTS.items() if not held.couples])
def test_places_along_the_spindle_are_for_supports_that_tilt(support: str) -> None:
    held = SUPPORTS[support]
    held.refuse_couples(0.0, [0.0, 0.0])
    for couple, places in ((0.1, [0.0]), (0.0, [0.0, 0.2])):
        with pytest.raises(InputError, match="tilts"):
            held.refuse_couples(couple, places)
