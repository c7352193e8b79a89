"""What a scene refuses, and how balls that start in one place are parted."""

import math
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.scene import LinearSupport, parted_angles, with_parted_balls
from abu_calc.dynamics.supports.linear import planar
from abu_calc.errors import InputError
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, -1.0])
@pytest.mark.parametrize("name", ["speed", "imbalance", "duration"])
def test_scene_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError, match=name):
        replace(SCENE, **{name: value})


@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0])
@pytest.mark.parametrize("name", ["pitch_radius", "drag", "inertia_factor"])
def test_race_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError):
        replace(SCENE.race, **{name: value})


@pytest.mark.parametrize(
    "change",
    [
        {"ball_masses": (0.05,)},
        {"ball_masses": (0.05, 0.0)},
        {"start_angles": (0.0, math.nan)},
        {"start_speeds": (0.0, math.inf)},
        {"start_speeds": (0.0,)},
    ],
)
def test_race_refuses_wrong_balls(change):
    with pytest.raises(InputError):
        replace(SCENE.race, **change)


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
        LinearSupport(square, ((1.0,),), square, square, ("x", "y"))
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
    scene, warnings = with_parted_balls(replace(SCENE, race=replace(SCENE.race, start_angles=(1.0, 1.0))))
    assert scene.race.start_angles == pytest.approx((1.0, 1.000001), abs=1e-12)
    assert len(warnings) == 1
    assert "1e-06 rad" in warnings[0]
