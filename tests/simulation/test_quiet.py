"""Quiet time and rest time against closed forms: of sampled courses, of motions made up, and of whole machines."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.simulation.quiet import GRAZE, PER_TURN, TimeRange, last_crossing, range_of, turn_velocities
from abu_calc.simulation.response import Response, evaluate, needed_times
from abu_calc.simulation.scene_of_design import level_without, scene_of_design
from abu_calc.simulation.simulate import simulate
from abu_calc.sizing import size
from tests.dynamics.scenes import dimensionless, straight_grinder
from tests.sizing.machines import PINNED, machine

TIMES = np.arange(0.0, 20.0 + 1e-9, 1 / PER_TURN)
"""Twenty turns of a second each."""


# crossings
def test_crossings_are_read_between_samples_and_not_near_the_end() -> None:
    t = np.arange(11.0)
    # Falling straight from 6 at 2 s to 0 at 8 s after a dip; a quintic through samples of a line is the line.
    assert last_crossing(t, np.array([5.0, 1, 6, 5, 4, 3, 2, 1, 0, 0, 0]), 3.5) == pytest.approx(4.5)
    assert last_crossing(t, np.array([1.0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0]), 2.0) == 0.0
    assert last_crossing(t, np.array([5.0, 1, 4, 0, 0, 0, 0, 0, 0, 0, 3]), 2.0) is None
    # Falling from 4 at 9 s to 0 at 10 s: it passes 0.1 later than 95 % of the run.
    assert last_crossing(t, np.array([5.0, 1, 4, 4, 4, 4, 4, 4, 4, 4, 0]), 0.1) is None
    # A sample on the limit itself.
    assert last_crossing(t, np.array([5.0, 4, 3, 2, 1, 0, 0, 0, 0, 0, 0]), 1.0) == pytest.approx(4.0)


@pytest.mark.parametrize("limit", [-0.3, 0.0, 0.5, 0.8])
def test_the_last_of_many_crests_passes_where_its_sine_does(limit: float) -> None:
    """16 samples h a turn: 3.5 h⁶/720 of the sixth derivative over the slope, h = 2π/16; a line is 500 times as far
    off.
    """
    exact = 14.37 + 0.5 - math.asin(limit) / math.tau
    swings = np.where(exact + 0.25 > TIMES, np.sin(math.tau * (TIMES - 0.37)), -1.0)  # then it stays low
    error = 3.52 * (math.tau / PER_TURN) ** 6 / 720 / (math.tau * math.sqrt(1 - limit**2))
    assert last_crossing(TIMES, swings, limit) == pytest.approx(exact, abs=1.01 * error)


def test_an_exponential_passes_at_its_logarithm() -> None:
    for constant in (0.5, 2.0, 5.0):
        exact = constant * math.log(10)
        assert last_crossing(TIMES, np.exp(-TIMES / constant), 0.1) == pytest.approx(exact, rel=1e-8)


# ranges
def test_a_plateau_near_the_threshold_is_told_as_a_range() -> None:
    """0.4 % above it from 2 s to 8 s: the threshold 1 % higher is kept from before, the same and a lower one after."""

    def course(height: float) -> Any:
        return np.interp(TIMES, [0, 2, 8, 9], [3.0, height, height, 0.0])

    grazed = range_of(TIMES, course(1.004), 1.0, 0.5)
    assert grazed.time == pytest.approx(8 - 0.5 + 0.004, abs=0.01) and grazed.latest is not None
    assert grazed.earliest == pytest.approx(2 - 0.5 - 2 * 0.006 / 1.996, abs=0.01) and grazed.latest >= grazed.time
    assert grazed.grazed(0.1) == (grazed.earliest, grazed.latest)
    clear = range_of(TIMES, course(1.0 + 2 * GRAZE), 1.0, 0.5)
    assert clear.grazed(0.1) is None and clear.earliest is not None and clear.earliest > 7.4
    # Less than a revolution is no range, and neither is never.
    assert grazed.grazed(7.0) is None and TimeRange(None, None, None).grazed(0.0) is None
    assert TimeRange(0.3, 0.2, None).grazed(0.0) == (0.2, None)


def test_times_are_apart_unless_each_lies_in_the_range_of_the_other() -> None:
    early, late = TimeRange(1.0, 0.9, 3.1), TimeRange(3.0, 0.95, 3.2)
    assert early.apart(late, 0.1) == late.apart(early, 0.1) == 0.0
    assert TimeRange(1.0, 0.9, 1.1).apart(late, 0.1) == pytest.approx(2 / 3)
    assert TimeRange(0.01, 0.01, 0.01).apart(TimeRange(0.0, 0.0, 0.0), 0.1) == pytest.approx(0.1)
    never = TimeRange(None, None, None)
    assert never.apart(never, 0.1) == 0 and never.apart(early, 0.1) == early.apart(never, 0.1) == math.inf
    assert TimeRange(None, 2.0, None).apart(TimeRange(3.0, 2.0, None), 0.1) == 0.0


# velocities of a turn
@pytest.mark.parametrize("phase", [0.0, 0.4, 2.0])
def test_an_even_whirl_has_one_velocity_whatever_drifts_beside_it(phase: float) -> None:
    """A/√2; exactly so with any constant velocity and any steady acceleration besides."""
    whirl = 3.0 * np.array([np.cos(math.tau * TIMES + phase), np.sin(math.tau * TIMES + phase)])
    drift = np.array([7.0 - 2.0 * TIMES, 40.0 + 0.3 * TIMES])
    for moved in (whirl, whirl + drift):
        assert turn_velocities(moved) == pytest.approx(3.0 / math.sqrt(2), rel=1e-9)
    # Of an ellipse the larger axis counts.
    assert turn_velocities(whirl * [[0.2], [1.0]]) == pytest.approx(3.0 / math.sqrt(2), rel=1e-9)


def test_a_suspension_that_swings_out_hardly_counts() -> None:
    """A sway as fast as the whirl, at a tenth of its speed, which dies out in 16 turns. Raw, it would be there long."""
    turning = np.array([np.cos(math.tau * TIMES), np.sin(math.tau * TIMES)])
    sway = np.exp(-0.1 * math.tau * 0.1 * TIMES) * np.array([np.cos(0.1 * math.tau * TIMES), 0 * TIMES])
    raw = np.sqrt(np.convolve((turning + sway)[0] ** 2, np.full(PER_TURN, 1 / PER_TURN), "valid"))
    assert raw.max() > 1.6 / math.sqrt(2)
    found = turn_velocities(turning + sway)
    assert found == pytest.approx(1 / math.sqrt(2), rel=0.04)
    assert turn_velocities(sway).max() < 0.03


def test_a_whirl_that_dies_out_is_followed_a_turn_behind() -> None:
    """Its velocity is that of the turn before: between that of its end and that of its beginning."""
    rate = 0.2
    falling = np.exp(-rate * TIMES) * np.array([np.cos(math.tau * TIMES), np.sin(math.tau * TIMES)])
    found = turn_velocities(falling)[PER_TURN:] * math.sqrt(2)
    ends = np.exp(-rate * TIMES[PER_TURN:])
    assert (found > ends).all() and (found < ends * math.exp(rate)).all()
    time = last_crossing(TIMES, turn_velocities(falling), 0.2 / math.sqrt(2))
    assert time is not None and math.log(5) / rate < time < math.log(5) / rate + 1


# rest and creep
SCENE = dimensionless(2.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 400.0)


def made(scene: Scene, angles: Callable[[Any], Any], size: float = 1e-3) -> Response:
    """Of a motion made up: the axis on an even circle, the balls at these angles in the rotor."""
    t = needed_times(scene)
    whirl = size * np.exp(1j * scene.speed * t)
    velocity = 1j * scene.speed * whirl
    balls = np.array(angles(t))
    states = np.array([whirl.real, whirl.imag, velocity.real, velocity.imag, *balls, *np.gradient(balls, t, axis=1)])
    return evaluate(scene, Trajectory(t, states, "formula", 1e-6, 0, 0))


def test_an_imbalance_that_only_turns_has_not_come_to_rest() -> None:
    """|U| is that of one ball all the time, so that it settles at once; its direction e^{iα}, α = e^{−t/20}, rests when
    2 sin(α/2) is a tenth of 1 % of the ball's moment.
    """
    alone = dimensionless(2.0, 0.02, 0.0, 0.2, 0.3, (1.0,), 400.0)
    response = made(alone, lambda t: [np.exp(-t / 20)])
    assert response.settling_time == 0.0 and not response.creeping
    assert response.rest_time == pytest.approx(20 * math.log(1 / (2 * math.asin(0.0005))), rel=1e-4)
    assert response.quiet_time == 0.0


def test_balls_creep_that_drift_by_more_than_the_band_in_a_run() -> None:
    """Opposite balls that turn together: U = 0.02 + 0.04 cos(…) turns by rate · T; the band is a tenth of 0.02."""
    apart = 2 * math.pi / 3 - 0.3

    def drifting(rate: float) -> Response:
        return made(SCENE, lambda t: [apart + rate * t, -apart + rate * t])

    moved = 0.04 * math.cos(apart)
    for share, creeps in ((0.9, False), (1.1, True)):
        response = drifting(share * 0.1 * 0.02 / abs(moved) / 400.0)
        assert response.creeping is creeps and (response.rest_time is None) is creeps
    # Without a level that is asked for, what creeps is not quiet; with one, it is.
    creeping = drifting(0.1)
    assert creeping.creeping and creeping.quiet_time is None
    asked = made(replace(SCENE, quiet_velocity=1.0), lambda t: [apart + 0.1 * t, -apart + 0.1 * t])
    assert asked.creeping and asked.quiet_time == 0.0 and asked.rest_time is None


def test_balls_that_have_just_come_to_rest_do_not_creep() -> None:
    """They stand from 85 % of the run on, and moved by a quarter turn in the 15 % before."""
    response = made(SCENE, lambda t: [np.pi / 2 * np.clip((t - 280) / 60, 0, 1), np.pi + 0 * t])
    assert not response.creeping and 330 < response.rest_time < 340  # type: ignore[operator]


def test_balls_that_swing_with_a_slow_support_do_not_creep() -> None:
    """By 0.5 % of the imbalance, a swing in a ninth of the run: its steps from window to window would be 20 % in it."""
    place = 2 * math.pi / 3
    swing = 0.005 / (2 * math.sin(place))
    for phase in (0.0, 0.8, 1.6, 2.4):
        response = made(SCENE, lambda t, phase=phase: [place + swing * np.cos(0.14 * t + phase),
                                                       -place - swing * np.cos(0.14 * t + phase)])  # fmt: skip
        assert not response.creeping and response.rest_time == 0.0


# machines
def test_without_a_limit_it_is_quiet_a_decibel_above_its_end() -> None:
    """A whirl that falls to an even one of 1 mm: 1 + 9 e^{−t/20} times it; the turn that it lags lies between."""
    t = needed_times(SCENE)
    grown = 1e-3 * (1 + 9 * np.exp(-t / 20)) * np.exp(2j * t)
    velocity = 1e-3 * (2j * (1 + 9 * np.exp(-t / 20)) - 9 / 20 * np.exp(-t / 20)) * np.exp(2j * t)
    rest = [0 * t + 2 * math.pi / 3, 0 * t - 2 * math.pi / 3, 0 * t, 0 * t]
    run = Trajectory(t, np.array([grown.real, grown.imag, velocity.real, velocity.imag, *rest]), "formula", 1e-6, 0, 0)
    exact = 20 * math.log(9 / (10 ** (1 / 20) - 1))
    late = evaluate(SCENE, run).quiet_time
    assert late is not None and exact < late < exact + math.pi
    # Asked to keep 5 mm's velocity, sooner; asked to keep less than its end, never.
    soon = evaluate(replace(SCENE, quiet_velocity=5e-3 * 2 / math.sqrt(2)), run).quiet_time
    assert soon is not None and 20 * math.log(9 / 4) < soon < 20 * math.log(9 / 4) + math.pi
    assert evaluate(replace(SCENE, quiet_velocity=0.99e-3 * 2 / math.sqrt(2)), run).quiet_time is None


def test_a_motion_that_dies_out_is_quiet_at_a_hundredth_of_that_without_balls() -> None:
    """There is no level of its end. U/M is the amplitude of a mass that is far above its springs."""
    t, rate, support = needed_times(SCENE), 0.05, SCENE.support
    dying = 1e-2 * np.exp((2j - rate) * t)
    velocity = (2j - rate) * dying
    rest = [0 * t + 2 * math.pi / 3, 0 * t - 2 * math.pi / 3, 0 * t, 0 * t]
    run = Trajectory(t, np.array([dying.real, dying.imag, velocity.real, velocity.imag, *rest]), "formula", 1e-6, 0, 0)
    time = evaluate(SCENE, run).quiet_time
    mass = support.felt_mass + sum(SCENE.ball_masses)
    least = 0.01 * 0.02 * 4 / abs(complex(1 - 4 * mass, 2 * 0.4))
    exact = math.log(1e-2 / least) / rate
    assert time is not None and exact < time < exact + math.pi


@pytest.mark.slow
def test_a_machine_above_its_level_without_balls_is_never_quiet() -> None:
    """Below its natural frequency the balls gather on the heavy side, far below a limit of 200 dB."""
    stiff = {"model": "springs", "natural_frequencies_hz": [200.0, 200.0], "damping_ratios": [0.05, 0.05]}
    limits = {"vibration_level_db": 200.0}
    for suspension, quiet in ((stiff, False), (machine().suspension.model_dump(exclude_none=True), True)):
        design = size(machine(suspension=suspension, limits=limits, **PINNED))
        scene = scene_of_design(design)
        response = simulate(scene).response
        assert scene.quiet_velocity is not None
        assert level_from_velocity(scene.quiet_velocity) == pytest.approx(level_without(design), abs=0.5)
        assert (response.quiet_time is not None) is quiet
        assert response.level is not None and (response.level < level_without(design)) is quiet
        assert response.level < 200.0
    plain = replace(scene, races=())
    assert scene.quiet_velocity == pytest.approx(unbalanced_amplitude(plain) * scene.speed / math.sqrt(2), rel=0.06)


def test_quiet_time_does_not_depend_on_how_the_suspension_swings_out() -> None:
    """Damping ratios of 0.5, 0.05 and 0.02: the raw velocity of a turn takes its time with each of them."""
    scene = replace(straight_grinder(), quiet_velocity=velocity_from_level(109.0))
    mass, natural = scene.support.felt_mass, 2 * math.pi * 2.5
    times = []
    for ratio in (0.5, 0.05, 0.02):
        held = planar(mass, (6.4 * natural**2,) * 2, (2 * ratio * natural * 6.4,) * 2)
        times.append(simulate(replace(scene, support=held, duration=4.0)).response.quiet_time)
    assert times[0] is not None and times[0] > 10 * scene.revolution
    assert times == pytest.approx([times[0]] * 3, rel=0.2, abs=scene.revolution)
