"""Which integrator is chosen, and why; heyoka itself is needed for two of these only."""

import importlib.util
from dataclasses import replace

import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import heyoka_, scipy_
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.estimates import BALL, EVALUATION, RUNS, seconds
from abu_calc.dynamics.integrators.run import TooMuchWorkError, work
from abu_calc.errors import InputError
from tests.dynamics.scenes import coupled_scene, straight_grinder, with_effects

FRICTION = DryRollingFriction(8e-6, 0.008)


def test_short_scenes_stay_with_scipy():
    chosen = choose(assemble(coupled_scene()), "auto", 1e-6)
    assert (chosen.name, chosen.integrate.func) == ("scipy-dop853", scipy_.integrate)
    assert "short run" in chosen.why


def long_run() -> Equations:
    return assemble(replace(straight_grinder(), duration=20.0))


def test_long_scenes_go_to_heyoka():
    pytest.importorskip("heyoka")
    chosen = choose(long_run(), "auto", 1e-6)
    assert (chosen.name, chosen.integrate) == ("heyoka", heyoka_.integrate)
    assert "long run" in chosen.why


def test_without_heyoka_long_scenes_stay_with_scipy(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    chosen = choose(long_run(), "auto", 1e-6)
    assert chosen.name == "scipy-dop853"
    assert "not installed" in chosen.why


def test_heyoka_that_is_missing_is_told_with_the_remedy(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r'pip install "abu-calc\[fast\]"'):
        choose(long_run(), "heyoka", 1e-6)


def test_what_cannot_be_traced_stays_with_scipy(monkeypatch):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: name)
    monkeypatch.setattr(Gravity, "traceable", False)
    equations = assemble(with_effects(replace(straight_grinder(), duration=20.0), Gravity()))
    chosen = choose(equations, "auto", 1e-6)
    assert chosen.name == "scipy-dop853"
    assert "cannot trace the effect gravity" in chosen.why
    with pytest.raises(InputError, match="gravity"):
        choose(equations, "heyoka", 1e-6)


def test_stiff_equations_go_to_radau():
    """A drag whose time is a ten-thousandth of a revolution's."""
    scene = straight_grinder()
    stiff = assemble(replace(scene, races=(replace(scene.races[0], drag=1e7),)))
    for wanted in ("auto", "scipy"):
        assert choose(stiff, wanted, 1e-6).name == "scipy-radau"


def test_what_is_asked_for_is_taken():
    assert choose(long_run(), "scipy", 1e-6).name == "scipy-dop853"
    with pytest.raises(InputError, match="auto, scipy, plain, compiled, heyoka"):
        choose(long_run(), "Heyoka", 1e-6)


def test_heyoka_is_taken_where_asked_for():
    """Whatever the length of the run, and stiff or not."""
    pytest.importorskip("heyoka")
    assert choose(assemble(coupled_scene()), "heyoka", 1e-6).name == "heyoka"


def test_the_estimate_of_work_is_near_the_truth():
    """Counted evaluations, a factor of two either way: it decides between a third of a second and an hour."""
    scene = straight_grinder()
    equations = assemble(scene)
    for tolerance in (1e-4, 1e-8):
        counted = scipy_.integrate(equations, tolerance, [scene.duration]).evaluations
        estimated = seconds(equations, tolerance).scipy / RUNS / (EVALUATION + BALL * len(scene.ball_masses))
        assert 0.5 < estimated / counted < 2


def switching(duration: float) -> Equations:
    return assemble(with_effects(replace(straight_grinder(), duration=duration), Gravity(), FRICTION))


@pytest.mark.parametrize("duration", [0.02, 20.0])
def test_without_extras_scenes_that_switch_take_plain_code(monkeypatch, duration):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    chosen = choose(switching(duration), "auto", 1e-4)
    assert chosen.name == "plain-rk45"
    assert ("llvmlite is not installed" in chosen.why) is (duration > 1)


def test_long_scenes_that_switch_are_compiled():
    """Whatever is on disk."""
    pytest.importorskip("llvmlite")
    waits = []
    chosen = choose(switching(20.0), "auto", 1e-4, waits.append)
    assert chosen.name == "compiled-rk45" and "switches" in chosen.why
    assert all("compiling" in each for each in waits)


def test_the_same_work_is_allowed_to_all():
    """Whoever does it."""
    pytest.importorskip("llvmlite")
    equations, times = switching(0.5), [0.5]
    for name in ("scipy", "plain", "compiled"):
        chosen = choose(equations, name, 1e-4)
        run = chosen.integrate(equations, 1e-4, times, chosen.evaluations(100_000))
        assert chosen.evaluations(chosen.work(run)) >= work(run)
        with pytest.raises(TooMuchWorkError):
            chosen.integrate(equations, 1e-4, times, chosen.evaluations(chosen.work(run) // 4))


def test_what_cannot_be_traced_has_no_plain_code(monkeypatch):
    monkeypatch.setattr(Gravity, "traceable", False)
    assert choose(switching(2.0), "auto", 1e-4).name.startswith("scipy")
    with pytest.raises(InputError, match="gravity"):
        choose(switching(2.0), "plain", 1e-4)
