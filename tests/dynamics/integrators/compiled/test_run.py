"""The loop against SciPy: motion, events, work, memory, interrupts, failures; compiled and as plain Python."""

import math
import os
import subprocess
import sys
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.integrators.compiled import availability as ready
from abu_calc.dynamics.integrators.compiled import code as compiled_code
from abu_calc.dynamics.integrators.compiled import llvm_engine as machine
from abu_calc.dynamics.integrators.compiled import run as compiled
from abu_calc.dynamics.integrators.compiled.kernels import METHODS, Method
from abu_calc.dynamics.integrators.compiled.program import in_order
from abu_calc.dynamics.scene import Scene, placed
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from tests.dynamics.effects.test_contract import CONTACT
from tests.dynamics.scenes import (
    ROTORS,
    SUPPORTS,
    coupled_scene,
    dimensionless,
    scene_on,
    straight_grinder,
    with_effects,
)

FRICTION, MEETING = DryRollingFrictionEffect(0.002, 0.1), BallContactEffect(0.1, 0.5)
RIGID = replace(CONTACT, contact="rigid", contact_stiffness=0.0)

SCENES: dict[str, Scene] = {
    "friction": scene_on("planar", FRICTION),
    "friction and gravity": scene_on("planar", GravityEffect(0.3), FRICTION),
    "friction, driven": scene_on("planar", *ROTORS["driven"], FRICTION),
    "friction, guided": scene_on("coupled", *ROTORS["guided"], FRICTION),
    "contact": scene_on("hand", MEETING),
    "contact without rebound": scene_on("tilting", BallContactEffect(0.1, 0.0)),
    "contact without loss": scene_on("planar", BallContactEffect(0.1, 1.0)),
    "contact and gravity": scene_on("tilting, axial", GravityEffect(0.3), MEETING),
    "friction and contact": scene_on("planar", GravityEffect(0.3), MEETING, FRICTION),
    "friction and contact on an arm": scene_on("swing arm", MEETING, FRICTION),
    "friction and contact, eccentric": scene_on("tilting", RaceEccentricityEffect(0.05, 0.3), MEETING, FRICTION),
    "wheel and work": scene_on("planar", CONTACT),
    "wheel and work, friction and contact": scene_on("hand", CONTACT, MEETING, FRICTION),
    "a rigid wheel": placed(scene_on("planar", RIGID, FRICTION)),
    "across, where Python decides": scene_on("planar", TransverseMotionEffect(0.7, 0.1, 0.02), MEETING, FRICTION),
    "nothing switches": coupled_scene(),
}
LONG = ("contact", "contact and gravity", "friction and contact, eccentric")
"""In every run their plain code is compared with the compiled one to the last bit; with SciPy others as they are."""


def agree(scene: Scene, within: float, tolerance: float = 1e-8, method: Method = "rk45") -> tuple[int, int]:
    """Compare with SciPy all along a run, in the scales of the states; events of both."""
    equations, times = assemble(scene), np.linspace(0, scene.duration, 41)
    exact = scipy_.integrate(equations, 1e-11, times)
    found = compiled.integrate(equations, tolerance, times, method=method)
    scales = np.array(equations.scales)[:, None]
    np.testing.assert_allclose(found.y / scales, exact.y / scales, rtol=0, atol=within)
    assert found.integrator == f"compiled-{method}"
    return found.events, exact.events


@pytest.mark.few(2)
@pytest.mark.parametrize("name", [pytest.param(each, marks=[pytest.mark.slow] * (each in LONG)) for each in SCENES])
def test_the_motion_is_that_of_scipy(name: str) -> None:
    for method in METHODS:
        found, exact = agree(replace(SCENES[name], duration=10.0), within=1e-5, method=method)
        assert abs(found - exact) <= 3 + exact // 50


@pytest.mark.parametrize("support", SUPPORTS)
def test_smooth_motion_on_every_support_is_that_of_scipy(support: str) -> None:
    """Steady, guided and driven rotors in turn; a hundred times the tolerance, as errors of dozens of steps add up."""
    way = list(ROTORS)[list(SUPPORTS).index(support) % len(ROTORS)]
    agree(replace(scene_on(support, *ROTORS[way]), duration=10.0), within=1e-7, tolerance=1e-9, method="dop853")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.slow
def test_errors_fall_with_the_tolerance(method: Method) -> None:
    """At most a hundred times the tolerance where balls stick, slip and touch."""
    scene = replace(SCENES["friction and contact"], duration=6.0)
    for tolerance in (1e-3, 1e-5, 1e-7):
        agree(scene, 100 * tolerance, tolerance, method)


def test_large_angles_do_not_loosen_the_tolerance() -> None:
    """A motor's turn grows to thousands of radians, which are not the size of the state."""
    equations = assemble(replace(scene_on("planar", *ROTORS["driven"]), duration=2000.0))
    exact, found = (
        compiled.integrate(equations, tolerance, [2000.0], method="dop853").y[:, -1] for tolerance in (1e-12, 1e-6)
    )
    assert exact[-2] > 3000
    np.testing.assert_allclose(found / equations.scales, exact / equations.scales, rtol=0, atol=1e-3)


@pytest.mark.parametrize(
    "revolutions", [pytest.param(2_000, marks=pytest.mark.slow), pytest.param(100_000, marks=pytest.mark.hard)]
)
def test_many_revolutions_without_drift(revolutions: int) -> None:
    """An undamped rotor whose balls swing about the places where they balance it keeps its integral of motion.

    Seen in the rotor nothing depends on time, so T − Ω L + V of the inertial motion is constant (Jacobi's integral),
    and balls that swing go on swinging as far.
    """
    scene = dimensionless(2.0, 0.05, 0.02, 0.0, 0.0, (1.8, -1.75), math.pi * revolutions)
    times = np.linspace(0, scene.duration, min(10_000, 2 * revolutions) + 1)
    y = compiled.integrate(assemble(scene), 1e-12, times, most_evaluations=10**10, method="dop853").y
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


def grinder() -> Equations:
    """A machine whose balls stick and slip thousands of times."""
    effects = GravityEffect(), BallContactEffect(0.008, 0.5), DryRollingFrictionEffect(8e-6, 0.008)
    scene = straight_grinder()
    race = replace(scene.races[0], start_angles=tuple(1.7 * k for k in range(4)))
    return assemble(with_effects(replace(scene, races=(race,)), *effects))


def test_balls_may_be_given_in_any_order() -> None:
    """The same motion ball by ball, and one code for all orders."""
    scene = replace(SCENES["friction and contact"], duration=6.0)
    race, order = scene.races[0], (2, 0, 1)
    turned = replace(
        race, ball_masses=tuple(race.ball_masses[k] for k in order),
        start_angles=tuple(race.start_angles[k] + 2 * math.pi for k in order),
        start_speeds=tuple(race.start_speeds[k] for k in order),
    )  # fmt: skip
    one, other = assemble(scene), assemble(replace(scene, races=(turned, scene.races[1])))
    first, second = (compiled.integrate(equations, 1e-9, [6.0]).y[:, 0] for equations in (one, other))
    balls = np.arange(4, 14).reshape(2, 5)
    moved = first.copy()
    for block in balls:
        moved[block[:3]] = first[block[list(order)]]
    moved[balls[0][:3]] += 2 * math.pi
    np.testing.assert_allclose(second, moved, rtol=1e-5, atol=1e-6)
    structures = [compiled.described(in_order(equations)[0])[1] for equations in (one, other)]
    assert structures[0] == structures[1]


def test_a_ball_may_start_between_two_samples_of_nothing() -> None:
    """Samples need not begin at 0, nor be many."""
    equations = assemble(SCENES["friction"])
    whole = compiled.integrate(equations, 1e-8, [0.0, 2.5, 7.25, 10.0])
    np.testing.assert_array_equal(whole.y[:, 0], equations.initial)
    for times in ([2.5, 7.25, 10.0], [10.0]):
        found = compiled.integrate(equations, 1e-8, times)
        np.testing.assert_allclose(found.y, whole.y[:, -len(times) :], rtol=1e-12)


def test_work_is_bounded() -> None:
    equations = grinder()
    with pytest.raises(NotTrustworthyError, match=r"more work than allowed, .* events") as given_up:
        compiled.integrate(equations, 1e-6, [20.0], most_evaluations=100_000)
    assert "integration lost at t = " in str(given_up.value)


def test_memory_is_that_of_the_samples() -> None:
    """A million evaluations leave nothing behind."""
    equations = grinder()
    compiled.integrate(equations, 1e-4, [0.01])
    tracemalloc.start()
    run = compiled.integrate(equations, 1e-4, [20.0])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert run.evaluations > 200_000
    assert peak < 1_000_000


def test_numbers_that_are_none_are_told() -> None:
    equations = grinder()
    compiled.integrate(equations, 1e-4, [0.01])
    far = replace(equations, initial=(1e308, *equations.initial[1:]))
    with pytest.raises(NotTrustworthyError, match="integration lost at t = 0 s"):
        compiled.integrate(far, 1e-6, [1.0])


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no SIGINT for one process")
@pytest.mark.slow
def test_an_interrupt_is_heard() -> None:
    """In a process of its own: whatever it meets there, it meets no other test."""
    code = """
import signal, threading
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import run
from tests.dynamics.scenes import straight_grinder
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background may ignore it
equations = assemble(straight_grinder())
run.integrate(equations, 1e-4, [0.01])
threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
try:
    run.integrate(equations, 1e-10, [1e6], most_evaluations=10**12)
except KeyboardInterrupt:
    print("heard")
"""
    done = subprocess.run(
        (sys.executable, "-c", code), cwd=Path(__file__).parents[4], capture_output=True, text=True, timeout=300,
        check=False,
    )  # fmt: skip
    assert (done.stdout, done.stderr, done.returncode) == ("heard\n", "", 0)


@pytest.mark.few(5)
@pytest.mark.parametrize("name", SCENES)
def test_plain_code_gives_the_same_numbers(name: str) -> None:
    """To the last bit: so what is on disk decides how long a run takes, never what comes out."""
    scene = replace(SCENES[name], duration=min(SCENES[name].duration, 20.0))
    equations, times = assemble(scene), np.linspace(0, scene.duration, 17)
    for method in METHODS:
        fast, plain = (
            compiled.integrate(equations, 1e-4, times, compiled=with_compiler, method=method)
            for with_compiler in (True, False)
        )
        assert np.array_equal(fast.y, plain.y)
        assert (fast.integrator, plain.integrator) == (f"compiled-{method}", f"plain-{method}")
        assert (fast.events, fast.steps, fast.evaluations) == (plain.events, plain.steps, plain.evaluations)


# What the compiler may do.


@pytest.mark.usefixtures("fresh")
@pytest.mark.parametrize("failing", ["_library", "_target"])
def test_a_compiler_that_does_not_run_is_done_without(failing: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise OSError("no such library: LLVM")

    monkeypatch.setattr(machine, failing, broken)
    equations = grinder()
    with pytest.warns(RuntimeWarning, match="compiled code is not used: .*OSError: no such library: LLVM") as told:
        for _ in range(2):
            with pytest.raises(InputError, match="does not run here"):
                choice.choose(equations, "compiled", 1e-6)
    assert len(told) == 1
    assert choice.choose(equations, "auto", 1e-6).name == "plain-dop853"


@pytest.mark.usefixtures("fresh")
@pytest.mark.slow
def test_code_that_gives_other_numbers_is_done_without(monkeypatch: pytest.MonkeyPatch) -> None:
    original = compiled_code.program

    def wrong(*given):  # type: ignore[no-untyped-def]
        found = original(*given)
        head, body = found.text.split("def rates", 1)
        return replace(found, text=head + "def rates" + body.replace("dy[4] = ", "dy[4] = 1.0 + "))

    monkeypatch.setattr(compiled_code, "program", wrong)
    with pytest.warns(RuntimeWarning, match="does not give what the equations do"):
        assert not ready.load(assemble(SCENES["friction"]), "rk45")


def test_it_is_taken_where_it_is_asked_for() -> None:
    equations = assemble(SCENES["friction"])
    assert choice.choose(equations, "compiled", 1e-6).name == "compiled-dop853"
    for name in ("compiled-rk45", "compiled-dop853"):
        assert choice.integrate_with(name, equations, 1e-6, np.array([1.0]), 10**6).integrator == name


def test_run_ups_are_met() -> None:
    """Ω' jumps within the run."""
    scene = with_effects(straight_grinder(), RunUpEffect(0.5, 0.7), DryRollingFrictionEffect(8e-6, 0.008))
    found = compiled.integrate(assemble(scene), 1e-8, [0.5, scene.duration - 0.7, scene.duration]).y[-2:]
    turns = 0.25 * scene.speed, (scene.duration - 0.95) * scene.speed, (scene.duration - 0.6) * scene.speed
    np.testing.assert_allclose(found[0], turns, rtol=1e-9)


def test_a_wheel_bounces() -> None:
    """Wheel and work part and meet many times."""
    scene = scene_on("planar", GrindingContactEffect(0.7, 0.0, "compliant", 50.0, -1, 0.1, 0.8))
    found, exact = agree(replace(scene, duration=15.0), within=1e-4)
    assert found == exact > 5
