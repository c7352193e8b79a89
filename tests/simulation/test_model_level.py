"""Closed form, envelope and equations agree as far as they claim; the envelope costs a tenth.

Why an accuracy is out of reach: chaos, a settling that hangs on the end of the run, or rounding.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.averaging import envelope as envelope_module
from abu_calc.dynamics.averaging.envelope import averages, not_averaged
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.units import velocity_from_level
from abu_calc.simulation.model_level import (
    MOVED,
    QUANTITIES,
    FinestRuns,
    _moved,
    averaged,
    closed_form,
    difference,
    offer,
    unreached,
)
from abu_calc.simulation.quiet import TimeRange
from abu_calc.simulation.response import NEVER, evaluate, needed_times
from abu_calc.simulation.simulate import simulate
from tests.dynamics.scenes import dimensionless, straight_grinder


def integrated(scene, tolerance=1e-6):
    return evaluate(scene, scipy_.integrate(assemble(scene), tolerance, needed_times(scene)))


@pytest.mark.slow
def test_envelope_follows_the_equations_of_a_grinder():
    """The balls' rate is 58 against 607 rad/s, so a few hundredths for where four balls find their places."""
    scene = replace(straight_grinder(), effects=(RaceEccentricityEffect(1e-5, 0.4),))
    scene = replace(scene, quiet_velocity=velocity_from_level(109.0))
    slow, full = averaged(scene, 1e-6), integrated(scene)
    bounds = {"amplitude": 0.01, "level": 0.01, "settling": 0.01, "rest": 0.01, "quiet": 0.1, "angles": 0.05}
    for quantity, most in bounds.items():
        assert QUANTITIES[quantity](scene, slow, full) < most, quantity


@pytest.mark.slow
def test_gravity_gives_the_balls_a_mean_speed_at_the_start():
    """Without it their places would be a tenth off."""
    scene = replace(straight_grinder(), effects=(RaceEccentricityEffect(1e-5, 0.4), GravityEffect()))
    slow, full = averaged(scene, 1e-6), integrated(scene)
    assert QUANTITIES["angles"](scene, slow, full) < 0.05
    kicks = [averages(replace(scene, effects=effects)).kick for effects in (scene.effects, scene.effects[:1])]
    np.testing.assert_allclose(kicks[0] - kicks[1], 9.80665 * np.sin(scene.start_angles) / 607.3746 / 0.023 / 1.4)


@pytest.mark.slow
def test_each_order_of_the_envelope_leaves_the_next_power_of_slowness():
    """Balls of a share μ of the rotor's mass move at a rate √μ; so the orders leave √μ and μ, by regression.

    The drag follows the rate, so that all of these scenes are one in the time of the balls, however fast they are.
    """
    shares, errors = np.geomspace(1e-4, 6.4e-3, 4), {1: [], 2: []}
    for share in shares:
        rate = 3 * math.sqrt(share)
        scene = dimensionless(3.0, share / 4, 0.3 * share, 0.3, rate, (0.4, 0.6, 0.8, 1.0), 12 / rate)
        full = integrated(scene, 1e-9)
        for order, found in errors.items():
            found.append(QUANTITIES["angles"](scene, averaged(scene, 1e-9, order), full))
    slopes = {order: np.polyfit(np.log(shares), np.log(found), 1)[0] for order, found in errors.items()}
    assert slopes[1] == pytest.approx(0.5, abs=0.15)
    assert slopes[2] == pytest.approx(1.0, abs=0.15)


def test_envelope_costs_a_tenth():
    """Of evaluations, at tolerances that do for one per cent, and each is cheaper."""
    scene = straight_grinder()
    run = scipy_.integrate(assemble(scene), 2e-4, needed_times(scene))
    assert 10 * averaged(scene, 1e-4).evaluations < run.evaluations


LIGHT = replace(dimensionless(3.0, 2e-4, 1e-4, 0.3, 0.04, (0.4, 1.0), 400.0), quiet_velocity=1e-4)
"""With a level that is asked for: its motion dies out, so that the level of its end is no measure."""


@pytest.mark.slow
def test_the_cheapest_rung_that_is_accurate_enough_is_taken():
    """Light balls: the envelope for a per cent, the equations for more, or where they are asked for."""
    slow, full = simulate(LIGHT, 0.02), simulate(LIGHT, 1e-5)
    assert (slow.rung, full.rung) == ("envelope", "equations")
    assert difference(LIGHT, slow.response, full.response) <= slow.error_estimate <= 0.02
    assert slow.cost.evaluations < full.cost.evaluations / 10
    assert full.offered.error > 1e-5 and "estimated" in full.offered.why
    assert slow.trajectory.y.shape == full.trajectory.y.shape
    for asked in ({"integrator": "scipy"}, {"sample_times": (1.0,)}):
        assert simulate(LIGHT, 0.02, **asked).rung == "equations"


@pytest.mark.slow
def test_the_motion_of_the_envelope_is_that_of_the_equations():
    """Support and balls through the whole run, the free motion of the support at the start among it."""
    slow, full = simulate(LIGHT, 0.02), simulate(LIGHT, 1e-6, integrator="scipy")
    scales = np.array(assemble(LIGHT).scales)[:, None]
    assert np.abs((slow.trajectory.y - full.trajectory.y) / scales).max() < 0.05


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"effects": (GravityEffect(),)}, "gravity"),
        ({"effects": (BallContactEffect(0.1, 0.5),)}, "ball_contact"),
        ({"races": (replace(LIGHT.races[0], start_speeds=(-3.0, -3.0)),)}, "estimated"),
        ({"races": (replace(LIGHT.races[0], ball_masses=(0.02, 0.02)),)}, "estimated"),
        ({"support": planar(1.0, (1.0, 1.0), (0.0, 0.0))}, "estimated"),
    ],
)
def test_the_envelope_is_not_taken_where_it_does_not_hold(change, reason):
    """The last is a support that never forgets its start."""
    found = offer(replace(LIGHT, **change), 0.02, needed_times(LIGHT))
    assert found.trajectory is None and reason in found.why
    assert found.error is None or found.error > 0.02


def test_an_envelope_that_is_lost_leaves_the_equations(monkeypatch):
    monkeypatch.setattr(envelope_module, "MOST_STEPS", 1)
    found = offer(LIGHT, 0.02, needed_times(LIGHT))
    assert found.trajectory is None and "lost" in found.why
    assert simulate(LIGHT, 0.02).rung == "equations"


def test_closed_form_of_two_balls():
    """cos θ* = −m₀e/(2mR_p); nothing is left; e^{−λt} with the slower root of J s² + h₀ s + κ(1 − |cos 2θ*|) = 0."""
    scene = dimensionless(3.0, 0.002, 0.001, 0.3, 0.05, (1.4, -1.4), 2000.0)
    told = closed_form(scene)
    place = math.acos(-0.25)
    assert sorted(told.ball_angles) == pytest.approx([-place, place])
    assert told.axis_amplitude == 0
    mass, k = 1 + 2 * 0.002, 1.0
    forward = (1 / complex(k - 9 * mass, 3 * 0.6)).real
    kappa = -0.002 * 81 * forward * (1 - abs(math.cos(2 * place)))
    slowest = min(-np.roots([1.0, 0.05, kappa]).real)
    start = abs(0.001 + 2 * 0.002 * math.cos(1.4))
    assert told.settling_time == pytest.approx(math.log(start / 1e-4) / slowest, rel=1e-9) == told.rest.time
    asked = closed_form(replace(scene, quiet_velocity=1e-4))
    loud = unbalanced_amplitude(scene, start) * 3.0 / math.sqrt(2)
    assert asked.quiet.time == pytest.approx(math.log(loud / 1e-4) / slowest, rel=1e-9)
    assert closed_form(replace(scene, quiet_velocity=1.01 * loud)).quiet.time == 0.0


@pytest.mark.slow
def test_offset_races_keep_the_axis_whirling():
    scene = replace(
        dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (2.0, -2.2), 2000.0), effects=(RaceEccentricityEffect(0.002),)
    )
    assert closed_form(scene).axis_amplitude == pytest.approx(0.002)
    assert averaged(scene, 1e-8).axis_amplitude == pytest.approx(0.002, rel=1e-6)
    assert integrated(scene).axis_amplitude == pytest.approx(0.002, rel=1e-2)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"effects": (BallContactEffect(0.1, 0.5),)}, "ball_contact cannot be averaged"),
        ({"speed": 1.02}, "nearest natural frequency"),
    ],
)
def test_averages_say_where_they_do_not_hold(change, reason):
    scene = replace(dimensionless(3.0, 0.01, 0.02, 0.3, 0.05, (0.4, 1.0), 10.0), **change)
    assert reason in (not_averaged(scene) or "")
    for rung in (lambda: averaged(scene, 1e-4), lambda: closed_form(scene)):
        with pytest.raises(InputError):
            rung()


def test_closed_form_is_for_balls_that_balance():
    with pytest.raises(InputError, match="can balance"):
        closed_form(dimensionless(3.0, 0.01, 0.05, 0.3, 0.05, (0.4, 1.0), 10.0))
    with pytest.raises(InputError, match="does not come to rest"):
        closed_form(dimensionless(0.5, 0.0001, 0.0001, 0.3, 0.05, (0.4, 1.0), 20.0))


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
