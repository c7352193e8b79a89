"""From 10 g to 10 t and 1 to 300 000 rpm, a horizontal spindle too slow for its balls, disc-like rotors, a long run."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import run as loop
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.foundation.units import GRAVITY
from abu_calc.simulation.simulate import simulate
from tests.dynamics.scenes import dimensionless
from tests.dynamics.transforms import in_units
from tests.hard.scenes import RPM, check_agreement, check_claim, check_energy, machine, resultant, scene_of, standing

pytestmark = pytest.mark.hard


@pytest.mark.parametrize("mass", [0.01, 1.0, 1e4])
@pytest.mark.parametrize("rpm", [1.0, 3e3, 3e5])
def test_the_size_of_a_machine_does_not_matter(mass: float, rpm: float) -> None:
    """The grinder of 5 kg at 600 rad/s built smaller or larger, slower or faster, in proportion: the same answer.

    Angles, settling in revolutions and amplitude in pitch radii, by nearly the same work: nothing in it knows a metre.
    """
    plain = machine(600.0, (1.0, 2.5), 1.0)
    scene = in_units(plain, length=(mass / 5) ** (1 / 3), mass=mass / 5, time=600.0 / (rpm * RPM))
    assert scene.support.mass[0][0] == pytest.approx(mass)
    assert scene.speed == pytest.approx(rpm * RPM)
    one, other = (simulate(each, integrator="scipy") for each in (plain, scene))
    a, b = one.response, other.response
    assert b.ball_angles == pytest.approx(a.ball_angles, abs=1e-8)
    assert b.settling_time / scene.revolution == pytest.approx(a.settling_time / plain.revolution, rel=1e-6)
    assert b.axis_amplitude / scene.races[0].pitch_radius == pytest.approx(a.axis_amplitude / 0.024, rel=1e-6)
    assert other.cost.evaluations == pytest.approx(one.cost.evaluations, rel=0.05)


def weighed(mass: float, rpm: float) -> Scene:
    """Built smaller or larger as before, but on the earth, whose gravity knows of sizes."""
    plain = machine(600.0, (1.0, 2.5), 2.0)
    scene = in_units(plain, length=(mass / 5) ** (1 / 3), mass=mass / 5, time=600.0 / (rpm * RPM))
    return replace(scene, effects=(GravityEffect(),))


def test_loose_tolerances_do_not_agree_on_a_wrong_end() -> None:
    """10 t at 60 rpm, Ω²R_p = 1.2 g: the balls slip, by hundreds of turns, before one of several ends catches them.

    Tolerances of 2e-5, 2e-6 and 2e-7 agree within the accuracy, on an end the motion does not come to; that they made
    other turns tells them apart, and the answer is that of a tight run by another integrator.
    """
    found = check_claim(weighed(1e4, 60.0))
    assert found.cost.tolerance < 1e-7
    (warning,) = found.warnings
    assert "would fall off its race" in warning


@pytest.mark.parametrize(("mass", "rpm"), [(0.01, 3e5), (1e4, 600.0)])
def test_extreme_machines_keep_their_claims(mass: float, rpm: float) -> None:
    """10 g at 300 000 rpm does not feel its weight; balls of 10 t at 600 rpm swing by g/(J R_p Ω²). Both balance."""
    scene = weighed(mass, rpm)
    found = check_claim(scene)
    swing = GRAVITY / (1.4 * scene.races[0].pitch_radius * scene.speed**2)
    last = found.trajectory.t > scene.duration - 2 * scene.revolution
    assert np.ptp(found.trajectory.y[4, last]) / 2 == pytest.approx(swing, rel=0.1, abs=1e-6)
    assert abs(resultant(scene, found.trajectory.y[4:6, last].mean(axis=1))) < 0.05 * scene.imbalance


@pytest.mark.parametrize(("drag", "rpm", "hangs"), [(5.0, 120.0, True), (20.0, 180.0, True), (30.0, 250.0, False)])
def test_a_horizontal_axis_too_slow_for_its_balls(drag: float, rpm: float, hangs: bool) -> None:
    """A ball at rest at first hangs where drag carries its weight, g cos γ = h₀ R_p Ω, on a support too heavy to move.

    Where h₀ R_p Ω > g nothing holds it, and it goes round. Below Ω²R_p = g, at 193 rpm, that is beyond the equations:
    it would fall at the top, and the result says so; hanging it does not.
    """
    speed = rpm * RPM
    scene = machine(speed, (-1.0,), 4.0, GravityEffect(), mass=1e6, imbalance=1e-6, drag=drag)
    scene = standing(scene)
    motion = check_agreement(scene, 1e-3)
    lift = drag * 0.024 * speed / GRAVITY
    assert (lift < 1) is hangs
    place = math.remainder(motion.y[4, -1] + speed * 4.0, 2 * math.pi)
    found = check_claim(scene)
    if hangs:
        assert place == pytest.approx(-math.pi / 2 + math.asin(lift), abs=1e-3)
        assert not any("fall off" in warning for warning in found.warnings)
    else:
        assert abs(found.response.final.ball_speeds[0]) < 0.1 * speed
    check_energy(scene, 0.0, 1.0, 1e-5)


def test_a_ball_that_would_fall_off_its_race_is_told() -> None:
    """Carried over the top by drag at 180 rpm, Ω²R_p = 8.5 m/s² < g; and a ball that starts at rest at the top."""
    for drag, angle, rpm in ((60.0, -1.0, 180.0), (5.0, 1.5, 600.0)):
        scene = standing(machine(rpm * RPM, (angle,), 1.0, GravityEffect(), mass=1e6, imbalance=1e-6, drag=drag))
        (warning,) = simulate(scene, integrator="scipy").warnings
        assert "ball 1 would fall off its race" in warning
    assert simulate(machine(600.0, (1.0, 2.5), 0.5, GravityEffect()), integrator="scipy").warnings == ()


def two_planes(polar: float, speed: float, duration: float) -> Scene:
    """2 kg of 4e-3 kg m² across, two races with two balls of 4 g each, an imbalance and a couple, damped bearings."""
    support = tilting(2.0, 4e-3, polar, (-0.05, 0.05), ((2e5, 2e5),) * 2, ((60.0, 60.0),) * 2)
    races = tuple(
        Race(0.03, (0.004,) * 2, 20.0, 1.4, angles, (0.0, 0.0), place)
        for place, angles in ((-0.03, (1.0, 2.5)), (0.03, (3.0, 5.0)))
    )
    scene = scene_of(support, speed, 60e-6, races, duration)
    return replace(scene, couple=math.copysign(3e-7, 4e-3 - polar), couple_angle=1.0)


@pytest.mark.parametrize(("polar", "balances"), [(1e-3, True), (5e-3, False)])
def test_disc_like_rotors_are_never_balanced_in_two_planes(polar: float, balances: bool) -> None:
    """J_p > J_t: the tilting frequency runs away from the speed, which so stays below it; balls in two planes fail.

    Nowhere stable from 200 to 10 000 rad/s. A slender rotor is stable above its critical speeds. At 1000 rad/s: the
    slender one comes to rest, the disc keeps its vibration.
    """
    speeds = 200.0, 300.0, 600.0, 1000.0, 2000.0, 5000.0, 10000.0
    stable = [stability(two_planes(polar, speed, 1.0)).stable for speed in speeds]
    assert stable == [balances and speed >= 1000 for speed in speeds]
    found = check_claim(two_planes(polar, 1000.0, 1.0)).response
    left = found.axis_amplitude / found.unbalanced_amplitude
    assert left < 0.01 if balances else left > 0.5


def test_a_million_revolutions() -> None:
    """Three balls at rest, of which one angle is free: it has not drifted, nor the axis moved, a million turns later.

    A ball's angle in space is by then 6e6 rad, known to 1e-9 rad: so much of its force is noise.
    """
    scene = dimensionless(2.0, 0.1 / 3, 0.02, 0.05, 0.05, (1.5, 1.9, 2.3), 1e6 * math.pi, inertia_factor=1.4)
    times = np.concatenate([[0.0], np.linspace(1e4, scene.duration, 101)])
    y = loop.integrate(assemble(scene), 1e-12, times, most_evaluations=10**9, method="dop853").y[:, 1:]
    assert np.ptp(y[4:7], axis=1).max() < 1e-8
    assert np.hypot(*y[:2]).max() < 1e-7 * scene.imbalance
    assert abs(resultant(scene, y[4:7, -1])) < 1e-7 * scene.imbalance
