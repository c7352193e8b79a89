"""Long runs hold what is asked for; results are those of runs held whole. What cannot fit is not begun."""

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effect import Laws
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import run as recorder
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.choice import IntegratorChoice
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Samples, Sampling
from abu_calc.features.simulate.study import equally_spaced
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.simulation import response as response_module
from abu_calc.simulation import simulate as simulate_module
from abu_calc.simulation.response import amplitude_window, evaluate, needed_times, settling_times
from abu_calc.simulation.simulate import Simulation, simulate
from tests.dynamics.scenes import dimensionless

SCENE = replace(dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 300.0), effects=(GravityEffect(12.0),))
"""Weights that pull the balls off their race: there is something to remark."""

LIGHT = replace(dimensionless(3.0, 2e-4, 1e-4, 0.3, 0.04, (0.4, 1.0), 400.0), quiet_velocity=1e-4)
FIRST = 40
"""Samples of the beginning that stay."""
WANTED = (0.0, 1.5, 200.25, 300.0)


def both(monkeypatch: pytest.MonkeyPatch, scene: Scene, **how: object) -> tuple[Simulation, Simulation]:
    """One simulation held whole, and one that is not, its blocks so small that steps go across them."""
    whole = simulate(scene, 0.02, **how)  # type: ignore[arg-type]
    monkeypatch.setattr(response_module, "HELD", 0)
    monkeypatch.setattr(response_module, "BEGINNING", FIRST)
    monkeypatch.setattr(recorder, "BLOCK", 7)
    monkeypatch.setattr(response_module, "BLOCK", 13)
    return whole, simulate(scene, 0.02, **how)  # type: ignore[arg-type]


@pytest.mark.parametrize("integrator", ["scipy", "compiled"])
@pytest.mark.slow
def test_results_of_long_runs_are_those_of_runs_held_whole(monkeypatch: pytest.MonkeyPatch, integrator: str) -> None:
    whole, long = both(monkeypatch, SCENE, integrator=integrator, sample_times=WANTED)
    assert long.response == whole.response
    assert long.warnings == whole.warnings and "would fall off its race" in long.warnings[-1]
    assert (long.cost.evaluations, long.error_estimate) == (whole.cost.evaluations, whole.error_estimate)
    np.testing.assert_array_equal(whole.trajectory.t, np.union1d(needed_times(SCENE), WANTED))
    held = np.union1d(amplitude_window(SCENE).times, (*WANTED, *settling_times(SCENE)[:FIRST]))
    np.testing.assert_array_equal(long.trajectory.t, held)
    np.testing.assert_array_equal(long.trajectory.y, whole.trajectory.at(held))


def test_long_envelopes_likewise(monkeypatch: pytest.MonkeyPatch) -> None:
    """The slow motion is begun anew with each block, so its tolerance, 1e-6, is between them."""
    monkeypatch.setattr("abu_calc.dynamics.averaging.envelope.AT_ONCE", 100)
    whole, long = both(monkeypatch, LIGHT)
    assert whole.rung == long.rung == "envelope"
    held = np.union1d(amplitude_window(LIGHT).times, settling_times(LIGHT)[:FIRST])
    np.testing.assert_array_equal(long.trajectory.t, held)
    scales = np.array(assemble(LIGHT).scales)[:, None]
    assert np.abs((long.trajectory.y - whole.trajectory.at(long.trajectory.t)) / scales).max() < 1e-4
    assert long.response.settling_time == pytest.approx(whole.response.settling_time, rel=1e-4)


def test_memory_is_that_of_what_is_held() -> None:
    """All readers see all samples, in blocks; 400 000 of them, 25 MB of states, take none."""
    scene, seen, first = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 30.0), [0], [0.0]

    def read(samples: Samples) -> None:
        assert samples.t[0] >= first[0] and samples.y.shape == (8, len(samples.t))
        seen[0], first[0] = seen[0] + len(samples.t), float(samples.t[-1])

    times, equations = np.linspace(0, scene.duration, 400_001), assemble(scene)
    scipy_.integrate(equations, 1e-4, [1.0])
    tracemalloc.start()
    run = scipy_.integrate(equations, 1e-4, Sampling(times, times[::100_000], (read,)))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert seen == [400_001] and run.y.shape == (8, 5)
    assert peak < 8e6


def test_settling_times_are_equally_spaced() -> None:
    for duration in (7.0, 300.0, 12345.678):
        scene = replace(SCENE, duration=duration)
        times = settling_times(scene)
        np.testing.assert_array_equal(times, np.linspace(0, duration, len(times)))


def test_a_run_that_cannot_fit_is_not_begun() -> None:
    """143 revolutions, a step each at the least, of 12 evaluations."""
    equations = assemble(SCENE)
    with pytest.raises(NotTrustworthyError, match=r"more work than allowed \(found at least .* allowed: 1e\+03\)"):
        scipy_.integrate(equations, 1e-4, [300.0], most_evaluations=1000)


@pytest.mark.slow
def test_a_second_run_that_cannot_fit_is_not_begun(monkeypatch: pytest.MonkeyPatch) -> None:
    scene, begun = replace(SCENE, effects=()), []
    free = simulate(scene, integrator="scipy").cost.work
    chosen = simulate_module.choose

    def choose(*how: object) -> object:
        choice = chosen(*how)  # type: ignore[arg-type]

        def integrate(*what: object) -> object:
            begun.append(what[1])
            return choice.integrate(*what)

        return replace(choice, integrate=integrate)

    monkeypatch.setattr(simulate_module, "choose", choose)
    with pytest.raises(NotTrustworthyError, match=r"found about .*; allowed: .*\n.*shorten the run"):
        simulate(scene, integrator="scipy", most_evaluations=int(0.3 * free))
    assert begun == []
    monkeypatch.setattr(IntegratorChoice, "expected", lambda *_: 0.0)  # where more is needed than was to be expected
    with pytest.raises(NotTrustworthyError, match=r"found at least .*; allowed: .*\n.*shorten the run"):
        simulate(scene, integrator="scipy", most_evaluations=int(0.6 * free))
    assert begun == [2e-4]
    begun.clear()
    simulate(scene, integrator="scipy", most_evaluations=int(1.1 * free))
    assert begun == [2e-4, 2e-5]


def test_samples_of_many_balls_are_refused_where_they_would_fill_the_memory() -> None:
    race = SCENE.races[0]
    many = replace(race, ball_masses=(1e-3,) * 60, start_angles=tuple(0.1 * k for k in range(60)),
                   start_speeds=(0.0,) * 60)  # fmt: skip
    scene = replace(SCENE, races=(many,))
    assert scene.state_count == len(assemble(scene).states) == 124
    assert len(equally_spaced(SCENE, 1_000_000)) == 1_000_000
    with pytest.raises(InputError, match=r"found 300000; allowed: 2 … 270000\)\n  Ask for a number in this range"):
        equally_spaced(scene, 300_000)


@pytest.mark.parametrize("held", [2**22, 0])
@pytest.mark.slow
def test_samples_change_no_remark(monkeypatch: pytest.MonkeyPatch, held: int) -> None:
    """Gravity tells of the first of the times that results need, not of those asked for between them."""
    monkeypatch.setattr(response_module, "HELD", held)
    monkeypatch.setattr(recorder, "BLOCK", 50)
    asked: list[np.ndarray] = []
    remarks = GravityEffect.remarks

    def counted(self: GravityEffect, equations: Laws, samples: Samples) -> tuple[str, ...]:
        asked.append(samples.t)
        return remarks(self, equations, samples)

    monkeypatch.setattr(GravityEffect, "remarks", counted)
    scene = replace(SCENE, effects=(GravityEffect(1e-3),))
    run = simulate(scene, integrator="scipy", sample_times=np.linspace(0, 300, 9999))
    assert run.warnings == () and len(run.trajectory.t) > 9999
    np.testing.assert_array_equal(np.unique(np.concatenate(asked)), needed_times(scene))


def test_times_that_were_not_sampled_are_an_error() -> None:
    """Never a number of what the memory held before."""
    scene = dimensionless(2.0, 0.01, 0.01, 0.05, 0.1, (0.5, 2.0), 60.0)
    times = needed_times(scene)
    run = simulate(scene, 0.01, times).trajectory
    with pytest.raises(ValueError, match="not sampled"):
        evaluate(replace(scene, duration=0.9 * scene.duration), Samples(times, run.at(times)))
