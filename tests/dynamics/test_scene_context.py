"""What a scene tells of itself: revolution, balls, what its effects tell together, and what it refuses."""

import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.rotor import STEADY
from tests.dynamics.scenes import scene_on


def test_what_a_scene_tells_is_what_its_effects_tell():
    scene = scene_on("planar")
    assert (scene.rotor, scene.start_speed, scene.run_down, scene.holding) == (STEADY, scene.speed, 0.0, None)
    scene = scene_on("planar", BallContactEffect(0.1, 0.5), DryRollingFrictionEffect(0.02, 0.1))
    assert scene.balls_meet and scene.holding.friction == pytest.approx(0.2)
    scene = scene_on("planar", TransverseMotionEffect(0.7, 0.1))
    assert scene.ball_states == ("across", "across'")
