"""A race and its balls: what it refuses, and what the balls weigh."""

import math
from dataclasses import replace

import pytest

from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0])
@pytest.mark.parametrize("name", ["pitch_radius", "drag", "inertia_factor"])
def test_race_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError):
        replace(SCENE.races[0], **{name: value})


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
        replace(SCENE.races[0], **change)
