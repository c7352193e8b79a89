"""Why an accuracy is out of reach: chaos, a settling that hangs on the end of the run, or rounding."""

import math
from dataclasses import replace

import pytest

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.model_level import MOVED, FinestRuns, _moved, unreached
from abu_calc.simulation.quiet import TimeRange
from abu_calc.simulation.response import NEVER, evaluate, needed_times
from abu_calc.simulation.simulate import simulate
from tests.dynamics.scenes import dimensionless

CALM = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 40.0)
TUMBLING = replace(
    dimensionless(3.0, 0.1, 0.05, 0.1, 0.0, (1.5, -1.7, 0.3), 100.0), effects=(GravityEffect(4.0),), name="tumbling"
)
"""Balls without drag; at the top of their race their weight is half of what presses them to it."""
TOLERANCE, MOST = 1e-11, 10**6


def reason(scene, accuracy, apart, changes=({}, {})):
    """What is said of a run and one that differs from it in these results."""
    equations = assemble(scene)
    choice = choose(equations, "scipy", TOLERANCE)
    response = evaluate(scene, choice.integrate(equations, TOLERANCE, needed_times(scene), MOST))
    runs = tuple(replace(response, **change) for change in changes)
    return str(unreached(scene, accuracy, FinestRuns(*runs, apart, choice, TOLERANCE), MOST))


@pytest.mark.slow
def test_chaos_is_called_so():
    told = reason(TUMBLING, 0.01, 0.4)
    assert "differ by 0.4" in told and "The motion is chaotic: 1e-09 rad at its start grow" in told
    assert len(told.splitlines()) == 2


@pytest.mark.slow
def test_a_chaotic_scene_is_refused_with_that_reason():
    """By the way from end to end, in fewer revolutions than would cost much."""
    with pytest.raises(NotTrustworthyError, match="chaotic"):
        simulate(replace(TUMBLING, duration=60.0), 1e-3, integrator="scipy")


def test_a_calm_motion_is_not():
    assert "rounding decides" in reason(CALM, 1e-8, 2e-8)


@pytest.mark.slow
def test_settling_that_hangs_on_the_end_is_told():
    told = reason(CALM, 0.01, math.inf, ({"settling_time": None}, {"settling_time": 37.9}))
    assert "differ in whether they settle" in told and "--duration" in told
    once = TimeRange(37.9, 37.8, 38.0)
    for key in ("quiet", "rest"):  # a time that only one run has
        told = reason(CALM, 0.01, math.inf, ({key: NEVER}, {key: once}))
        assert "differ in whether they settle" in told and "--duration" in told
    quiet = TimeRange(20.0, 19.9, 20.1)
    assert "most in the quiet time" in reason(CALM, 0.01, 0.9, ({"quiet": once}, {"quiet": quiet}))


def test_other_turns_are_told():
    assert "in the turns of the balls" in reason(CALM, 0.01, math.inf)


@pytest.mark.parametrize("angles", [(0.3,), (0.3, 0.5), (6.2, 0.1, 0.3), (0.5, 0.1, 0.3, 6.2), (0.0, 2.0, 4.0)])
def test_the_ball_that_is_moved_comes_nearer_to_none(angles):
    """But by a billionth to the one across the widest gap: balls that touch are never moved into each other."""
    moved = _moved(angles)
    assert [b - a for a, b in zip(angles, moved, strict=True) if b != a] == [pytest.approx(MOVED, rel=1e-6)]
    others = [angle for angle, after in zip(angles, moved, strict=True) if after == angle]
    ball = next(angle for angle, after in zip(angles, moved, strict=True) if after != angle)
    ahead = min(((other - ball) % (2 * math.pi) for other in others), default=2 * math.pi)
    assert ahead >= 2 * math.pi / len(angles)
