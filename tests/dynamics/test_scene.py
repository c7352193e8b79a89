"""What a scene refuses, and how balls that start in one place are parted."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import only, parted_angles, with_parted_balls, without
from abu_calc.dynamics.supports.planar import PlanarSupport, planar
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1.0])
@pytest.mark.parametrize("name", ["speed", "imbalance", "duration"])
def test_scene_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError, match=name):
        replace(SCENE, **{name: value})


def test_scene_refuses_less_than_one_revolution_and_wrong_starts():
    with pytest.raises(InputError, match="one revolution"):
        replace(SCENE, duration=0.99 * SCENE.revolution)
    with pytest.raises(InputError, match="start position"):
        replace(SCENE, start_position=(0.0,))
    with pytest.raises(InputError, match="imbalance angle"):
        replace(SCENE, imbalance_angle=math.nan)


def test_support_refuses_wrong_shapes_and_numbers():
    square = ((1.0, 0.0), (0.0, 1.0))
    with pytest.raises(InputError, match="2 × 2"):
        PlanarSupport(square, ((1.0,),), square, square, ("x", "y"))
    with pytest.raises(InputError, match="support stiffness"):
        planar(1.0, (1.0, math.nan), (0.0, 0.0))
    with pytest.raises(InputError, match="support mass"):
        planar(0.0, (1.0, 1.0), (0.0, 0.0))


@settings(deadline=None, derandomize=True, max_examples=100)
@given(st.lists(st.sampled_from([0.0, 5e-7, 1e-6, 2 * math.pi - 3e-7, -1.0, 2.0, 8.0]), max_size=6))
def test_parted_balls_keep_apart_and_near_their_places(angles):
    parted = parted_angles(tuple(angles))
    for k, a in enumerate(parted):
        assert all(abs(math.remainder(a - b, 2 * math.pi)) > 0.999e-6 for b in parted[:k])
    assert all(0 <= a - b <= 1e-6 * len(angles) for a, b in zip(parted, angles, strict=True))
    assert parted_angles(parted) == parted


def test_balls_apart_are_left_alone_and_parting_is_told():
    assert with_parted_balls(SCENE) == (SCENE, ())
    scene, warnings = with_parted_balls(replace(SCENE, races=(replace(SCENE.races[0], start_angles=(1.0, 1.0)),)))
    assert scene.start_angles == pytest.approx((1.0, 1.000001), abs=1e-12)
    assert len(warnings) == 1
    assert "1e-06 rad" in warnings[0]


def test_balls_of_a_size_are_parted_by_their_size():
    """The last digits of a file: three balls of 0.5 rad that overlap by rounding."""
    parted = parted_angles((0.0, 0.4999999, 0.9999998), 0.5)
    assert parted == pytest.approx((0.0, 0.5, 1.0), abs=1e-15)
    assert parted_angles(parted, 0.5) == parted


def test_scene_refuses_couple_and_places_where_nothing_tilts():
    with pytest.raises(InputError, match="couple"):
        replace(SCENE, couple=1e-6)
    with pytest.raises(InputError, match="places along the spindle"):
        replace(SCENE, races=(*SCENE.races, replace(SCENE.races[0], plane_offset=0.1)))
    with pytest.raises(InputError, match="couple imbalance"):
        replace(SCENE, couple_angle=math.nan)
    with pytest.raises(InputError, match="ball radius"):
        replace(SCENE.races[0], ball_radius=1.5)


def test_effects_are_picked_by_name_and_keep_their_order():
    scene = replace(SCENE, effects=(RaceEccentricityEffect(1e-3), GravityEffect()))
    assert only(scene, ["gravity", "race_eccentricity"]) == scene
    assert only(scene, ["gravity"]).effects == (GravityEffect(),)
    assert without(scene, ["gravity", "motor"]).effects == (RaceEccentricityEffect(1e-3),)
    assert only(scene, []).effects == ()
    with pytest.raises(InputError, match=r"no data.*found motor; allowed: race_eccentricity, gravity"):
        only(scene, ["gravity", "motor"])
