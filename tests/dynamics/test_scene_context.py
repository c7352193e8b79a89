"""What a scene tells of itself: revolution, balls, what its effects tell together, and what it refuses."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.rotor import STEADY
from abu_calc.dynamics.support import Unbalance
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import scene_on


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
