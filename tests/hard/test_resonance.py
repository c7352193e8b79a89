"""At, beside and between natural frequencies, on the way through them, and stuck in one."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq

from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.simulate import simulate
from tests.cli.runner import abu
from tests.hard.scenes import (
    balls_at_end,
    check_agreement,
    check_claim,
    check_energy,
    machine,
    resultant,
    run,
    scene_of,
)

pytestmark = pytest.mark.hard


@pytest.mark.parametrize("ratio", [0.97, 1.0, 1.003, 1.03])
def test_at_resonance_nothing_is_balanced(ratio: float) -> None:
    """Ω/ω from just below to just above: the claim holds, and the balanced state is not called stable.

    Balls that have merged on the heavy side make it worse: more than without them, and at most (U + n m R_p) Ω²/(cΩ),
    all in one place at the peak.
    """
    scene = machine(80.0 * ratio, (1.0, 2.5), 3.0, damping_ratio=0.05)
    response = check_claim(scene).response
    assert not stability(scene).stable
    damper = scene.support.damping[0][0]
    most = (scene.imbalance + scene.static_moment) * scene.speed / damper
    assert response.unbalanced_amplitude < response.axis_amplitude < 1.05 * most


def test_growth_at_an_undamped_resonance() -> None:
    """x'' + Ω²x = (UΩ²/M) cos Ωt from rest: x = (U/2M) Ωt sin Ωt, y = (U/2M)(sin Ωt − Ωt cos Ωt).

    There is no steady amplitude to count errors in: a simulation is refused and says so; with any damping it is not.
    """
    scene = machine(80.0, (), 2.0, damping_ratio=0.0)
    times = np.linspace(0, 2, 101)
    phase, unit = 80.0 * times, scene.imbalance / 10.0
    place = run(scene, times, tolerance=1e-11).y[:2]
    expected = unit * np.array((phase * np.sin(phase), np.sin(phase) - phase * np.cos(phase)))
    np.testing.assert_allclose(place, expected, atol=1e-7 * np.abs(expected).max())
    for angles in ((), (1.0, 2.5)):
        with pytest.raises(InputError, match="natural frequency of the support, which nothing damps"):
            simulate(machine(80.0, angles, 2.0, damping_ratio=0.0))
    arm = scene_of(SwingArmSupport(2.0, 4.0, 6400.0, 0.0), 80.0, 1e-4, (), 1.0)
    with pytest.raises(InputError, match="which nothing damps"):
        simulate(arm)
    assert simulate(machine(80.0, (), 2.0, damping_ratio=1e-6), integrator="scipy").error_estimate <= 0.01


def test_a_machine_at_an_undamped_resonance_is_refused() -> None:
    """5800 rpm is 96.67 Hz: sizing divides by what is left of stiffness and inertia, so it names the key instead."""
    frequency = 5800 / 60
    entry = f"suspension.natural_frequencies_hz=[{frequency!r}, {frequency!r}]"
    seen = abu("size", "avtovaz-707-222", "--set", entry, "--set", "suspension.damping_ratios=0")
    assert seen.status == 2
    assert "suspension.damping_ratios: the speed is a natural frequency, which nothing damps" in seen.err
    assert abu("size", "avtovaz-707-222", "--set", entry, "--set", "suspension.damping_ratios=0.01").status == 1


ZONES = [(200.0, False), (460.0, True), (620.0, False), (1000.0, True)]


@pytest.mark.parametrize(("speed", "balances"), ZONES)
def test_between_two_natural_frequencies(speed: float, balances: bool) -> None:
    """ω = 300 and 700 rad/s: balanced iff 1/(Ω² − ω₁²) + 1/(Ω² − ω₂²) > 0, so for 300 … 538 and above 700.

    The sign of the averaged response, the multipliers of the linear motion, and the simulation tell the same.
    """
    assert (1 / (speed**2 - 300**2) + 1 / (speed**2 - 700**2) > 0) is balances
    scene = machine(
        speed, (1.0, 2.5), 4.0, mass=5.6, frequencies=(300.0, 700.0), damping_ratio=0.01, imbalance=150e-6,
        ball_mass=0.0084,
    )  # fmt: skip
    assert stability(scene).stable is balances
    response = check_claim(scene).response
    left = response.residual_imbalance / scene.imbalance
    assert left < 1e-3 if balances else left > 2


def test_run_up_through_two_resonances() -> None:
    """From rest to 600 rad/s in 1 s past 150 (x) and 300 rad/s (y): each axis swells after its own frequency, and dies.

    What runs through at an even pace peaks late (Lewis 1932), not before the frequency, and here within half of it
    again. Then the balls balance; the energy is what the drive put in.
    """
    scene = machine(
        600.0, (1.0, 2.5), 3.0, RunUpEffect(1.0), frequencies=(150.0, 300.0), damping_ratio=0.05, imbalance=150e-6
    )
    motion = check_agreement(scene, 1e-3, 6001)
    for axis, natural in ((0, 150.0), (1, 300.0)):
        peak = motion.y[-1, np.abs(motion.y[axis]).argmax()]
        assert natural < peak < 1.5 * natural
        assert np.abs(motion.y[axis, -500:]).max() < 0.01 * np.abs(motion.y[axis]).max()
    assert abs(resultant(scene, balls_at_end(scene, motion))) < 0.01 * scene.imbalance
    check_energy(scene, 0.2, 0.45, 1e-4, 401)
    check_claim(replace(scene, duration=2.0))


def motorised(torque: float, angles: tuple[float, ...], frequencies: tuple[float, float], duration: float) -> Scene:
    """A small rotor run up from rest by a motor of 700 rad/s."""
    effects = RunUpEffect(0.1), MotorEffect(torque, 700.0, 5e-5)
    return machine(
        600.0, angles, duration, *effects, frequencies=frequencies, damping_ratio=0.03, imbalance=400e-6
    )  # fmt: skip


def balances_of_torque(torque: float, frequencies: tuple[float, float]) -> list[float]:
    """Speeds at which the motor's torque is what the dampers take: M (1 − Ω/Ω₀) = Σ ½ c Ω |X|², axis by axis."""

    def left(speed: float) -> float:
        taken = 0.0
        for natural in frequencies:
            damper = 2 * 0.03 * 5.0 * natural
            X = 400e-6 * speed**2 / (5.0 * (natural**2 - speed**2) + 1j * damper * speed)
            taken += damper * speed * abs(X) ** 2 / 2
        return torque * (1 - speed / 700.0) - taken

    grid = np.linspace(20, 699.9, 5000)
    values = [left(speed) for speed in grid]
    return [brentq(left, grid[i], grid[i + 1]) for i in range(4999) if values[i] * values[i + 1] < 0]


@pytest.mark.parametrize(("torque", "stuck_below"), [(0.005, 150.0), (0.013, 300.0), (0.06, None)])
def test_a_weak_motor_sticks_in_a_resonance(torque: float, stuck_below: float | None) -> None:
    """Sommerfeld: the weakest sticks at the first of two resonances, the next at the second, the third passes both.

    Stuck, the mean speed is the first root above what was passed of a balance of torques that knows the receptance
    alone; a strong motor's is the last root.
    """
    frequencies = 150.0, 300.0
    scene = motorised(torque, (), frequencies, 6.0)
    speed = run(scene, np.linspace(5.0, 6.0, 2001), tolerance=1e-8).y[-1]
    roots = balances_of_torque(torque, frequencies)
    if stuck_below is None:
        assert roots == pytest.approx([speed.mean()], rel=1e-3)
        assert speed.min() > 600
    else:
        expected = next(root for root in roots if root > 0.8 * stuck_below)
        assert expected < stuck_below
        assert speed.mean() == pytest.approx(expected, rel=1e-3)
    check_energy(scene, 0.1, 0.4, 1e-4)
    check_agreement(replace(scene, duration=0.6), 1e-3)


@pytest.mark.parametrize(("torque", "passes"), [(0.04, False), (0.3, True)])
def test_balls_make_a_motor_stick(torque: float, passes: bool) -> None:
    """A motor that passes without balls sticks with them; a stronger one passes, and the balls balance.

    The balls come together, fall behind and go round in space just below the natural frequency, where their whirl
    holds them, and they the rotor.
    """
    frequencies = 200.0, 200.0
    alone = run(motorised(torque, (), frequencies, 2.0), [2.0], tolerance=1e-8).y[-1, -1]
    assert alone > 600
    scene = motorised(torque, (1.0, 2.5), frequencies, 3.0)
    end = run(scene, np.linspace(2, 3, 201), tolerance=1e-8)
    if passes:
        assert end.y[-1, -1] > 600
        assert abs(resultant(scene, balls_at_end(scene, end))) < 0.05 * scene.imbalance
    else:
        speed, balls = end.y[-1], end.y[4:6]
        assert speed.max() < 300
        assert np.ptp(np.cos(balls[:, -1] - balls[0, -1])) < 1e-6
        assert speed.mean() + (balls[:, -1] - balls[:, 0]) == pytest.approx([190.0] * 2, abs=9)
    check_agreement(replace(scene, duration=0.3), 1e-3)


def hanging_speed(scene: Scene) -> float:
    """ν at which one ball's drag carries it as hard as its own whirl holds it: m R² h₀ (Ω − ν) = c ν |w|²."""
    race, support = scene.races[0], scene.support
    stiffness, damper = support.stiffness[0][0], support.damping[0][0]
    moment, mass = race.ball_masses[0] * race.pitch_radius, support.mass[0][0] + sum(race.ball_masses)

    def left(speed: float) -> float:
        w = moment * speed**2 / (stiffness - mass * speed**2 + 1j * damper * speed)
        return moment * race.pitch_radius * race.drag * (scene.speed - speed) - damper * speed * abs(w) ** 2

    natural = math.sqrt(stiffness / mass)
    return float(brentq(left, 1.0, natural)) if left(natural) < 0 else math.nan


@pytest.mark.parametrize(("drag", "hangs"), [(1.0, True), (10.0, False)])
def test_a_ball_hangs_at_the_natural_frequency(drag: float, hangs: bool) -> None:
    """One ball turns with the rotor, the other starts at rest: with little drag it hangs just below ω for good.

    Its mean speed is that of a balance of torques; where the drag is more than its whirl can hold at any speed there is
    no such balance, and both balls end up with the rotor.
    """
    scene = machine(
        600.0, (2.5, -1.5), 3.0, frequencies=(200.0, 200.0), damping_ratio=0.03, drag=drag, start_speeds=(0.0, -600.0)
    )
    response = check_claim(scene).response
    with_rotor, other = response.final.ball_speeds
    expected = hanging_speed(scene)
    assert abs(with_rotor) < 5
    if hangs:
        assert 600 + other == pytest.approx(expected, rel=2e-3)
    else:
        assert math.isnan(expected)
        assert abs(other) < 0.01
        assert response.residual_imbalance < 1e-3 * scene.imbalance
