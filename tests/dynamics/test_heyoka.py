"""heyoka against SciPy on every support and effect; its errors, events, compilations, samples and limits."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.effects.run_up import RunUp
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import run, scipy_
from abu_calc.dynamics.integrators.compiled.cache import FOLDER
from abu_calc.dynamics.integrators.run import work
from abu_calc.dynamics.scene import Scene, placed
from abu_calc.dynamics.supports.planar import planar
from abu_calc.errors import InputError, NotTrustworthyError, RangeError
from tests.dynamics.examples import EXAMPLES
from tests.dynamics.scenes import (
    ROTORS,
    SUPPORTS,
    coupled_scene,
    dimensionless,
    scene_on,
    straight_grinder,
    with_effects,
)
from tests.dynamics.test_contract import taken
from tests.dynamics.test_integrators import run_away

heyoka = pytest.importorskip("heyoka")
from abu_calc.dynamics.integrators import heyoka_  # noqa: E402

pytestmark = pytest.mark.usefixtures("in_loops")

UNROLLED, SYSTEMS = heyoka_.MOST_UNROLLED, {}


@pytest.fixture
def unrolled(in_loops, monkeypatch):
    """Code of small smooth scenes as users have it."""
    monkeypatch.setattr(heyoka_, "MOST_UNROLLED", UNROLLED)
    monkeypatch.setattr(heyoka_, "_systems", SYSTEMS)
    yield
    assert SYSTEMS and not any(one.integrator.compact_mode for one in SYSTEMS.values())


def agree(scene: Scene, tolerance: float = 1e-9, within: float = 1e-7) -> int:
    """Compare both integrators all along a run, in units of the states' scales; returns the number of events.

    A hundred times the tolerance: errors of some dozens of steps add up, and balls on a loose support let them grow.
    """
    equations, times = assemble(scene), np.linspace(0, scene.duration, 41)
    exact = scipy_.integrate(equations, 1e-11, times)
    found = heyoka_.integrate(equations, tolerance, times)
    scales = np.array(equations.scales)[:, None]
    np.testing.assert_allclose(found.y / scales, exact.y / scales, rtol=0, atol=within)
    assert found.events == exact.events
    assert found.integrator == "heyoka"
    return found.events


@pytest.mark.parametrize("support", SUPPORTS)
def test_every_support_and_rotor(support):
    """One support with each way in which the rotor turns would be eighteen compilations: they go round."""
    way = list(ROTORS)[list(SUPPORTS).index(support) % 3]
    agree(replace(scene_on(support, *ROTORS[way]), duration=10.0))


SWITCHING = ("ball_contact", "grinding_contact", "dry_rolling_friction", "run_up")
"""Effects that are more than a smooth force; those come into the code of heyoka all in one way."""


@pytest.mark.parametrize(
    "name", [name if name in SWITCHING else pytest.param(name, marks=pytest.mark.slow) for name in EXAMPLES]
)
def test_every_effect(name):
    """On the supports in turn; a rigid contact lets errors pass into the motion along the constraint."""
    supports = ["planar", "tilting", "swing arm"]
    place = list(EXAMPLES).index(name)
    scene = next(
        scene
        for scene in (taken(supports[(place + k) % 3], name) for k in range(3))
        if scene is not None and name_fits(scene)
    )
    agree(placed(replace(scene, duration=7.0)), within=1e-6)


def name_fits(scene: Scene) -> bool:
    """Whether SciPy comes through: a ball may leave its race or its groove, where there is nothing to compare."""
    try:
        scipy_.integrate(assemble(placed(scene)), 1e-4, [7.0])
    except NotTrustworthyError:
        return False
    return True


def rubbing(coefficient: float = 1e-2) -> Scene:
    """Two balls that stick and roll many times before they rest, at zero speed exactly."""
    scene = dimensionless(2.0, 0.05, 0.02, 0.1, 0.1, (1.6, -1.4), 100.0)
    return with_effects(scene, DryRollingFriction(0.1 * coefficient, 0.1))


def test_balls_that_stick_and_roll():
    """Sticking from the very start: the first number watched is zero there and rises."""
    scene = rubbing()
    assert agree(scene, within=1e-6) > 3
    end = heyoka_.integrate(assemble(scene), 1e-8, [400.0]).y[:, -1]
    assert end[6:].tolist() == [0.0, 0.0]


def test_breaks_are_met():
    """A run-up ends and a run-down begins within the run: Ω' jumps there."""
    scene = with_effects(dimensionless(2.0, 0.05, 0.02, 0.1, 0.1, (1.6, -1.4), 30.0), RunUp(7.0, 9.0))
    agree(scene)
    turn = heyoka_.integrate(assemble(scene), 1e-9, [7.0, 21.0, 30.0]).y[-2:]
    np.testing.assert_allclose(turn, [(7.0, 35.0, 44.0), (2.0, 2.0, 0.0)], atol=1e-9)


@pytest.mark.slow
@pytest.mark.usefixtures("unrolled")
def test_errors_fall_with_the_tolerance():
    """Three decades of tolerance are at least two of error, until rounding of some hundred steps is met."""
    scene = straight_grinder()
    equations = assemble(scene)
    reference = heyoka_.integrate(equations, 1e-13, [scene.duration]).y[:, -1]
    errors = [
        np.abs(
            (heyoka_.integrate(equations, tolerance, [scene.duration]).y[:, -1] - reference) / equations.scales
        ).max()
        for tolerance in (1e-3, 1e-6, 1e-9)
    ]
    assert errors[1] < 1e-2 * errors[0]
    assert errors[2] < 1e-2 * errors[1]
    assert errors[0] < 10 * 1e-3
    assert errors[2] < 10 * 1e-9


def test_large_angles_do_not_loosen_the_tolerance():
    """A motor's turn grows to thousands of radians; heyoka alone would take it as the size of the state."""
    scene = replace(scene_on("planar", *ROTORS["driven"]), duration=2000.0)
    equations = assemble(scene)
    exact, found = (heyoka_.integrate(equations, tolerance, [2000.0]).y[:, -1] for tolerance in (1e-12, 1e-6))
    assert exact[-2] > 3000
    np.testing.assert_allclose(found / equations.scales, exact / equations.scales, rtol=0, atol=1e-4)


def test_compiled_once_for_all_designs_of_a_structure(monkeypatch):
    """Other numbers, other imbalance, other tolerance, gravity of another size: one compilation."""
    built: list[Any] = []
    original = heyoka_._compile
    monkeypatch.setattr(heyoka_, "_compile", lambda *given: built.append(given) or original(*given))
    monkeypatch.setattr(heyoka_, "_systems", {})
    first = with_effects(straight_grinder(), Gravity())
    race = first.races[0]
    others = (
        replace(first, speed=500.0, imbalance=1e-5, imbalance_angle=1.0),
        replace(first, support=planar(3.0, (1000.0, 2000.0), (5.0, 6.0)), start_position=(1e-4, 0.0)),
        replace(
            first, races=(replace(race, pitch_radius=0.03, drag=5.0, inertia_factor=1.5, ball_masses=(0.01,) * 4),)
        ),
        with_effects(first, Gravity(1.6)),
    )
    for scene in (first, *others):
        agree(replace(scene, duration=0.1))
    heyoka_.integrate(assemble(first), 1e-8, [0.1])
    assert len(built) == 1
    agree(replace(with_effects(first), duration=0.1))
    assert len(built) == 2


def test_modes_do_not_compile_anew(monkeypatch):
    built: list[Any] = []
    original = heyoka_._compile
    monkeypatch.setattr(heyoka_, "_compile", lambda *given: built.append(given) or original(*given))
    monkeypatch.setattr(heyoka_, "_systems", {})
    assert heyoka_.integrate(assemble(rubbing()), 1e-6, [100.0]).events > 3
    assert len(built) == 1


def test_samples_are_where_they_were_asked_for():
    """From the start, at a break, and dense between two steps; the same alone."""
    scene = with_effects(dimensionless(2.0, 0.05, 0.02, 0.1, 0.1, (1.6, -1.4), 30.0), RunUp(7.0, 9.0))
    equations = assemble(scene)
    times = [0.0, 0.001, 0.0011, 7.0, 7.0 + 1e-9, 30.0]
    found = heyoka_.integrate(equations, 1e-9, times)
    assert found.t.tolist() == times
    assert found.y[:, 0] == pytest.approx(equations.initial)
    for moment, column in zip(times[1:], found.y.T[1:], strict=True):
        alone = heyoka_.integrate(equations, 1e-9, [moment]).y[:, -1]
        np.testing.assert_allclose(alone, column, rtol=0, atol=1e-9)


def test_motion_without_bound_is_told_with_its_moment():
    with pytest.raises(NotTrustworthyError, match=r"lost at t = (0\.99|1\.?0?)"):
        heyoka_.integrate(run_away(2), 1e-6, [2.0])


def test_endless_work_is_given_up():
    with pytest.raises(NotTrustworthyError, match="more work than allowed"):
        heyoka_.integrate(assemble(coupled_scene()), 1e-6, [20.0], most_evaluations=100)


@pytest.mark.parametrize("library", [scipy_, heyoka_])
def test_events_are_work(library, monkeypatch):
    """Evaluations that would suffice for the motion do not for the events in it."""
    equations = assemble(rubbing())
    free = library.integrate(equations, 1e-6, [100.0])
    assert work(free) == free.evaluations + 50 * free.events
    monkeypatch.setattr(run, "EVENT", free.evaluations)
    with pytest.raises(NotTrustworthyError, match=f"and {free.events - 1} events"):
        library.integrate(equations, 1e-6, [100.0], most_evaluations=free.evaluations * (free.events - 1))


@pytest.mark.usefixtures("unrolled")
@pytest.mark.parametrize("tolerance", [1e-5, 1e-8, 1e-11])
def test_every_order_keeps_the_tolerance(tolerance):
    """Orders 12, 15 and 19, from loose to tight: errors of hundreds of steps stay near it."""
    scene = straight_grinder()
    equations, end = assemble(scene), [scene.duration / 4]
    exact = heyoka_.integrate(equations, 1e-13, end).y[:, -1]
    off = np.abs((heyoka_.integrate(equations, tolerance, end).y[:, -1] - exact) / equations.scales).max()
    assert off < 100 * tolerance


def test_compiled_code_is_kept_apart_and_bounded(tmp_path, monkeypatch):
    """In a folder of its own, in this process alone; where somebody has chosen one, there."""
    monkeypatch.delenv(FOLDER, raising=False)
    state = heyoka.llvm_state
    before = state.get_diskcache_path()
    try:
        state.set_diskcache_path(str(tmp_path / "heyoka"))
        heyoka_._keep_apart(state)
        assert Path(state.get_diskcache_path()) == tmp_path / "abu-calc"
        assert state.get_diskcache_limit() == heyoka_.ON_DISK
        state.set_diskcache_path(str(tmp_path / "chosen"))
        heyoka_._keep_apart(state)
        assert Path(state.get_diskcache_path()) == tmp_path / "chosen"
        assert state.get_diskcache_limit() > heyoka_.ON_DISK
    finally:
        state.set_diskcache_path(before)


@pytest.mark.parametrize("times", [[], [0.0], [-1.0, 1.0], [1.0, 1.0], [2.0, 1.0], [np.nan], [np.inf]])
def test_wrong_samples_are_refused(times):
    with pytest.raises(InputError, match="sample times"):
        heyoka_.integrate(run_away(1), 1e-6, times)


@pytest.mark.parametrize("tolerance", [0.0, 1.0, np.nan])
def test_wrong_tolerances_are_refused(tolerance):
    with pytest.raises(RangeError, match="tolerance"):
        heyoka_.integrate(run_away(1), tolerance, [1.0])


def test_decisions_by_values_are_refused_while_tracing():
    """A right-hand side that asks for the sign of a state cannot be compiled; a silent branch would be wrong."""
    equations = replace(run_away(1), rhs=lambda xp, t, y, p: y if y[0] else -y)
    with pytest.raises(TypeError, match="decide"):
        heyoka_.integrate(equations, 1e-6, [1.0])


@pytest.mark.parametrize(
    ("rhs", "expected"),
    [
        (lambda xp, t, y, p: 3.0 - y, lambda t: 3 - 2 * math.exp(-t)),
        (lambda xp, t, y, p: np.array([0.0]), lambda t: 1.0),
        (lambda xp, t, y, p: (2 - (1 + y - y)) / (1 / y), math.exp),
        (lambda xp, t, y, p: -np.float64(2.0) * y**2 / 2, lambda t: 1 / (1 + t)),
        (lambda xp, t, y, p: xp.cos(t) + 0.0 * y, lambda t: 1 + math.sin(t)),
        (lambda xp, t, y, p: -(y - 0.5) - (0.5 - y) * 0.5, lambda t: 0.5 + 0.5 * math.exp(-t / 2)),
    ],
)
def test_symbols_are_arithmetic(rhs, expected):
    end = heyoka_.integrate(replace(run_away(1), rhs=rhs), 1e-12, [1.5]).y[0, -1]
    assert end == pytest.approx(expected(1.5), rel=1e-12)


@pytest.mark.slow
@pytest.mark.usefixtures("unrolled")
def test_a_million_revolutions_without_drift():
    """An undamped rotor whose balls swing about the places where they balance it keeps its integral of motion.

    Seen in the rotor nothing depends on time, so T − Ω L + V of the inertial motion is constant (Jacobi's integral),
    and balls that swing go on swinging as far. Errors of 1e-13 in eight million steps make a random walk of 3e-10.
    """
    scene = dimensionless(2.0, 0.05, 0.02, 0.0, 0.0, (1.8, -1.75), 1e6 * math.pi)
    times = np.linspace(0, scene.duration, 10_001)
    y = heyoka_.integrate(assemble(scene), 1e-13, times, most_evaluations=10**10).y
    integral = np.array([jacobi(scene, t, column) for t, column in zip(times, y.T, strict=True)])
    np.testing.assert_allclose(integral, integral[0], rtol=0, atol=1e-9 * abs(integral[0]))
    first, last = y[4:6, 1:1001], y[4:6, -1000:]
    np.testing.assert_allclose(np.ptp(last, axis=1), np.ptp(first, axis=1), rtol=0.05)


def jacobi(scene: Scene, t: float, y: np.ndarray) -> float:
    """Σ ½ m v² + ½ k r² − Ω Σ m (r × v), as far as it can change; the imbalance m₀e turns with the rotor."""
    race, speed = scene.races[0], scene.speed
    mass, stiffness = scene.support.mass[0][0], scene.support.stiffness[0][0]
    r, v = complex(*y[:2]), complex(*y[2:4])
    gamma, swing = y[4:6] + speed * t, y[6:] + speed
    arms = race.pitch_radius * np.exp(1j * gamma)
    places, speeds = r + arms, v + 1j * swing * arms
    moment = scene.imbalance * np.exp(1j * (speed * t + scene.imbalance_angle))
    masses = np.array(race.ball_masses)

    def turning(a: Any, b: Any) -> Any:
        return (np.conj(a) * b).imag

    moved = 1j * speed * moment
    kinetic = 0.5 * mass * abs(v) ** 2 + 0.5 * masses @ np.abs(speeds) ** 2 + (np.conj(v) * moved).real
    angular = mass * turning(r, v) + masses @ turning(places, speeds) + turning(moment, v) + turning(r, moved)
    return float(kinetic + 0.5 * stiffness * abs(r) ** 2 - speed * angular)
