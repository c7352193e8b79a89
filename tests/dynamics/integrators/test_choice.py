"""Which integrator is chosen, and why."""

import importlib.util
import math
import warnings
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.choice import LOOP, choose, loop_method, verifiers
from abu_calc.dynamics.integrators.compiled import code
from abu_calc.dynamics.integrators.run import DECISION, TooMuchWorkError, decision_work, work
from abu_calc.dynamics.integrators.work_estimates import RUNS, counts, stiff
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import coupled_scene, dimensionless, straight_grinder, with_effects
from tests.studies.bounded_work import scene_with_every_effect

FRICTION = DryRollingFrictionEffect(8e-6, 0.008)


@pytest.fixture
def unloaded(monkeypatch: pytest.MonkeyPatch) -> None:
    """As in a process that has run nothing."""
    monkeypatch.setattr(code, "_codes", {})


@pytest.fixture
def without_compiler(monkeypatch: pytest.MonkeyPatch, unloaded: None) -> None:
    """As where no wheel of it exists."""
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)


def smooth(duration: float) -> Equations:
    return assemble(replace(straight_grinder(), duration=duration))


def switching(duration: float) -> Equations:
    return assemble(with_effects(replace(straight_grinder(), duration=duration), GravityEffect(), FRICTION))


def test_methods_follow_the_scene_and_the_tolerance():
    """Smooth: order 8. With events: order 5, but for tight tolerances."""
    assert {loop_method(smooth(1.0), 10.0**-k) for k in range(2, 13)} == {"dop853"}
    assert [loop_method(switching(1.0), 10.0**-k) for k in range(2, 9)] == ["rk45"] * 4 + ["dop853"] * 3


def test_each_run_has_the_method_of_its_own_tolerance():
    """One choice serves runs at several tolerances."""
    chosen = choose(switching(0.2), "plain", 1e-4)
    assert chosen.name == "plain-rk45"
    names = [chosen.integrate(switching(0.2), tolerance, [0.2], 10**6).integrator for tolerance in (1e-4, 1e-7)]
    assert names == ["plain-rk45", "plain-dop853"]


@pytest.mark.usefixtures("unloaded")
@pytest.mark.parametrize("scene", [smooth, switching])
def test_long_runs_are_compiled_and_short_ones_are_not(scene):
    short, long = (choose(scene(duration), "auto", 1e-4) for duration in (0.02, 20.0))
    assert long.name.startswith("compiled-") and short.name.startswith("plain-")
    assert "before compiled code would be loaded" in short.why
    assert ("switches" in long.why) is (scene is switching)


@pytest.mark.hard
@pytest.mark.usefixtures("unloaded")
def test_a_run_in_plain_python_that_proves_long_goes_on_in_compiled_code():
    """Steps are two thousand times as short as counting expects."""
    equations = switching(0.1)
    hard = replace(equations, longest_step=equations.longest_step / 2000)
    chosen = choose(equations, "auto", 1e-4)
    assert chosen.name == "plain-rk45"
    run, asked = (each.integrate(hard, 1e-4, [0.1], 10**7) for each in (chosen, choose(equations, "plain", 1e-4)))
    assert (run.integrator, asked.integrator) == ("compiled-rk45", "plain-rk45")
    assert 0 <= run.evaluations - asked.evaluations <= 1 and run.evaluations > 20_000
    assert np.array_equal(run.y, asked.y)


def test_what_is_loaded_is_used_for_short_runs_too():
    assert choose(switching(20.0), "auto", 1e-4).name == "compiled-rk45"
    assert choose(switching(0.02), "auto", 1e-4).name == "compiled-rk45"


@pytest.mark.usefixtures("unloaded")
def test_one_waits_for_compiled_code_with_a_word():
    waits: list[str] = []
    choose(switching(20.0), "auto", 1e-4, waits.append)
    assert len(waits) == 1 and "loading compiled code" in waits[0]
    choose(switching(20.0), "auto", 1e-4, waits.append)
    assert len(waits) == 1


@pytest.mark.usefixtures("without_compiler")
@pytest.mark.parametrize("scene", [smooth, switching])
def test_without_a_compiler_the_loop_is_plain_and_says_so(scene):
    with pytest.warns(RuntimeWarning, match="some ten times faster, with the same numbers, but llvmlite"):
        chosen = choose(scene(20.0), "auto", 1e-4)
    assert chosen.name == "plain-" + loop_method(scene(20.0), 1e-4)
    assert "llvmlite is not installed" in chosen.why
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert choose(scene(0.02), "auto", 1e-4).name.startswith("plain-")  # as with it: nothing to say
    with pytest.warns(RuntimeWarning), pytest.raises(InputError, match="llvmlite is not installed"):
        choose(scene(20.0), "compiled", 1e-4)


def test_what_cannot_be_traced_goes_to_scipy(monkeypatch):
    monkeypatch.setattr(GravityEffect, "traceable", False)
    chosen = choose(switching(20.0), "auto", 1e-6)
    assert chosen.name == "scipy-dop853"
    assert "cannot trace the effect gravity" in chosen.why
    for wanted in ("plain", "compiled"):
        with pytest.raises(InputError, match="gravity"):
            choose(switching(20.0), wanted, 1e-6)


def stiff_scene(drag: float, *effects: Effect) -> Equations:
    """Motion of the balls against their race dies out in a small part of a revolution."""
    scene = straight_grinder()
    return assemble(with_effects(replace(scene, races=(replace(scene.races[0], drag=drag),)), *effects))


def test_stiff_equations_go_to_radau():
    for wanted in ("auto", "scipy"):
        assert choose(stiff_scene(1e7), wanted, 1e-6).name == "scipy-radau"
    assert choose(stiff_scene(1e7), "plain", 1e-6).name == "plain-dop853"


def test_stiff_equations_whose_events_keep_steps_short_go_to_the_loop():
    """An implicit method would begin anew at each event; where motion dies out faster still, it is quicker anyhow."""
    effects = GravityEffect(), FRICTION
    names = [choose(stiff_scene(drag, *effects), "auto", 1e-4).name for drag in (2e5, 1e7)]
    assert names == ["compiled-rk45", "scipy-radau"]
    assert choose(stiff_scene(2e5, *effects), "scipy", 1e-4).name == "scipy-radau"


def test_balls_that_friction_shakes_loose_look_stiff_at_the_start_alone():
    """Friction f n/|v| turns the way of a ball that has hardly begun to roll: 1e5 1/s at first, soon some hundreds."""
    effects = TransverseMotionEffect(0.0237, 0.008, 1e-4), DryRollingFrictionEffect(2e-6, 0.008)
    equations = assemble(with_effects(replace(straight_grinder(), duration=0.5), *effects))
    assert stiff(equations) and choose(equations, "scipy", 1e-4).name == "scipy-radau"
    chosen = choose(equations, "auto", 1e-4)
    assert chosen.name == "compiled-rk45"
    run = chosen.integrate(equations, 1e-4, [0.5], 10**6)
    assert run.evaluations < 100 * 0.5 / equations.scene.revolution * 7


def test_a_stiff_scene_with_more_events_than_counted_stays_in_the_loop():
    """Balls that bounce ever faster while a stiff wheel grinds: 2416 events of three runs where counting expects 20."""
    equations = assemble(scene_with_every_effect(23))
    assert stiff(equations) and choose(equations, "scipy", 2e-4).name == "scipy-radau"
    assert choose(equations, "auto", 2e-4).name in LOOP


def test_a_decision_counts_as_long_as_python_takes():
    """Six balls that move across their race take seven quarters of the time of three, twice over."""

    def grinder(balls):
        scene = straight_grinder()
        every = {"ball_masses": (0.016,) * balls, "start_angles": tuple(range(balls)), "start_speeds": (0.0,) * balls}
        return replace(scene, races=(replace(scene.races[0], **every),))

    six = grinder(6)
    assert decision_work(assemble(grinder(3))) == DECISION
    assert decision_work(assemble(six)) == DECISION * 7 // 4
    across = with_effects(six, TransverseMotionEffect(0.0237, 0.008, 1e-4))
    assert decision_work(assemble(across)) == 2 * decision_work(assemble(six))


def test_what_is_asked_for_is_taken():
    assert choose(smooth(20.0), "scipy", 1e-6).name == "scipy-dop853"
    with pytest.raises(InputError, match=r"unknown integrator .*auto, scipy, plain, compiled"):
        choose(smooth(20.0), "Heyoka", 1e-6)


def test_an_integrator_of_earlier_versions_is_refused_with_what_replaces_it():
    with pytest.raises(InputError, match=r"not an integrator of this version[\s\S]*Use auto or compiled"):
        choose(smooth(20.0), "heyoka", 1e-6)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-8])
def test_the_counted_work_is_near_the_truth(tolerance):
    """A factor of two either way: it decides between a third of a second and an hour."""
    equations = assemble(straight_grinder())
    counted = scipy_.integrate(equations, tolerance, [equations.scene.duration]).evaluations
    assert 0.5 < counts(equations, tolerance).scipy / RUNS / counted < 2


def test_two_kinds_of_integrators_verify_each_other():
    for equations, names in (
        (smooth(1.0), ("scipy-lsoda", "compiled-dop853")),
        (switching(1.0), ("compiled-rk45", "scipy-dop853")),
    ):
        assert tuple(name for name, _ in verifiers(equations, 0.01)) == names


@pytest.mark.slow
def test_the_same_work_is_allowed_to_all():
    """Whoever does it."""
    equations, times = switching(0.5), [0.5]
    for name in ("scipy", "plain", "compiled"):
        chosen = choose(equations, name, 1e-4)
        run = chosen.integrate(equations, 1e-4, times, chosen.evaluations(400_000))
        assert chosen.evaluations(chosen.work(run)) >= work(run, chosen.event)
        with pytest.raises(TooMuchWorkError):
            chosen.integrate(equations, 1e-4, times, chosen.evaluations(chosen.work(run) // 4))


def test_short_scenes_have_integrators_by_name():
    assert choose(assemble(coupled_scene()), "compiled", 1e-6).name == "compiled-dop853"


@pytest.mark.parametrize(("balls", "factor"), [(1, 1.0), (4, 1.0), (6, 1.0), (13, 2**1.15), (20, 3**1.15)])
def test_an_evaluation_of_the_loop_counts_more_with_many_balls(balls: int, factor: float) -> None:
    """A fifth of one of SciPy's up to six balls; from there on with the power 1.15 of the balls and the rotor."""
    angles = [2 * math.pi * k / balls for k in range(balls)]
    chosen = choose(assemble(dimensionless(2.0, 0.001, 0.01, 0.1, 0.1, angles, 10.0)), "plain", 1e-4)
    assert chosen.share == pytest.approx(factor / 5)
    assert chosen.evaluations(1000) == pytest.approx(5000 / factor, abs=1)
