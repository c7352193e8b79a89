"""Early stopping of a run: when it may end, and that neither creeping balls nor a rising level end it."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.trajectory import Samples, Sampling
from abu_calc.simulation.early_stopping import LOOKS, SEEN, Early
from abu_calc.simulation.response import Response, settling_times
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(3.0, 0.05, 0.05, 0.2, 0.3, (1.0, 2.5), 400.0)


def early(at_speed: float = 0.0) -> Early:
    def decided(response: Response, creep: float, rise: float) -> bool:
        return True

    return Early(SCENE, at_speed, decided)


def motion(end: float, drift: float = 0.0, growth: float = 0.0, sampled: Sampling | None = None) -> Samples:
    """Axis on a circle that grows at a rate [1/s], the first ball drifting at a rate [rad/s], the second at rest."""
    times = settling_times(SCENE) if sampled is None else sampled.times
    times = times[times <= end]
    turn, size = SCENE.speed * times, np.exp(growth * times)
    axis = [size * np.cos(turn), size * np.sin(turn)]
    velocity = [-SCENE.speed * size * np.sin(turn), SCENE.speed * size * np.cos(turn)]
    balls = [drift * times, 0 * times + math.pi]
    return Samples(times, np.array([*axis, *velocity, *balls, 0 * times + drift, 0 * times]))


def test_looks_are_shares_of_the_time_at_full_speed() -> None:
    step = float(np.diff(settling_times(SCENE)).max())
    assert early(80.0).looks == pytest.approx([80.0 + share * 320.0 for share in LOOKS], abs=step)
    assert max(early(80.0).looks) < SCENE.duration


def test_no_run_ends_within_its_first_revolution() -> None:
    short = replace(early(), scene=replace(SCENE, duration=3.0))
    assert 0 < len(short.looks) < len(LOOKS) and min(short.looks) >= SCENE.revolution


def test_a_run_is_sampled_where_it_may_end() -> None:
    sampling = early().sampling()
    assert set(early().looks) <= set(sampling.times.tolist())
    assert sampling.until is not None and sampling.until.times == early().looks


def test_balls_at_rest_on_an_even_whirl_move_nothing() -> None:
    creep, rise = early().moving(motion(200.0))
    assert creep == pytest.approx(0.0, abs=1e-12) and rise == pytest.approx(0.0, abs=1e-6)


def test_creep_is_the_pace_of_the_imbalance_times_the_time_left() -> None:
    """A ball of m·R_p = 0.05 that drifts by 1e-3 rad/s changes the imbalance by 5e-5 a second."""
    end = 200.0
    samples = motion(end, drift=1e-3)
    creep, _ = early().moving(samples)
    seen = SEEN * end
    averaged = seen - SCENE.revolution  # means over one turn each: one turn less to look back upon
    assert creep == pytest.approx(5e-5 * averaged / seen * (400.0 - float(samples.t[-1])), rel=0.01)
    assert not early().enough(samples)


def test_balls_that_creep_end_no_run() -> None:
    """A ball that drifts by 1e-6 rad/s ends it; the same, called creeping, does not."""
    ending = early()
    end = ending.looks[-2]
    samples = motion(end, 1e-6, sampled=ending.sampling())
    assert ending.enough(samples) and not ending.response(samples).creeping
    ending._responses[end] = replace(ending.response(samples), creeping=True)
    ending._creeping.clear()
    assert not ending.enough(samples)


def test_a_growing_whirl_rises_and_does_not_end_the_run() -> None:
    """Its level rises by 8.686 dB times the growth, from the middle of one half of the time seen to the other's."""
    samples = motion(200.0, growth=0.01)
    _, rise = early().moving(samples)
    half = (SEEN * float(samples.t[-1]) - SCENE.revolution) / 2
    assert rise == pytest.approx(20 * math.log10(math.e) * 0.01 * half, rel=0.02)
    assert not early().enough(samples)


def test_too_little_has_been_seen_at_first() -> None:
    assert early().moving(motion(2 * SCENE.revolution)) == (math.inf, math.inf)
