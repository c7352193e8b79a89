"""A rotor that changes its speed: the spin it gives its balls, and what drives it standing on a swing arm."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import run as recorder
from abu_calc.dynamics.integrators.scipy_solvers import integrate
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.swing_arm import idle_arm
from abu_calc.formulas.swing_arm import Arm
from abu_calc.simulation import response
from abu_calc.simulation.scene_of_file import scene_from
from abu_calc.simulation.simulate import simulate
from tests.inputs.scenes import ARM, read, refused

BALL, R_P, MASS, DRAG = 0.008, 0.023, 0.0167, 20.0
FACTORS = {"point": 1.0, "ball": 7 / 5, "roller": 3 / 2}
RAMP = """\
[scene]
mass_kg = 4.0
stiffness_N_per_m = [1e4, 1e4]
damping_N_s_per_m = [40.0, 40.0]
speed_rpm = {speed}
imbalance_g_mm = 1e-3
duration_s = 2.0
rolling_inertia = {rolling}
[[scene.race]]
pitch_radius_mm = 23.0
corrector = "{what}"
ball_masses_g = [16.7, 16.7]
rolling_drag_per_s = 20.0
start_angles_deg = [0.0, 180.0]
{radius}
[scene.effects]
{effects}
"""
RUN_UP, RADIUS = "run_up = { time_s = 2.0 }", "ball_radius_mm = 8.0"


def ramp(folder: Path, what: str = "ball", radius: str = RADIUS, effects: str = RUN_UP) -> Scene:
    """Two opposite balls, which leave the axis where it is, run up by 2400 rad/s²."""
    rolling, what = ("false", "ball") if what == "point" else ("true", what)
    text = RAMP.format(speed=4800 * 30 / math.pi, rolling=rolling, what=what, radius=radius, effects=effects)
    return scene_from(read(folder, text).scene)


@pytest.mark.few(1)
@pytest.mark.parametrize("what", FACTORS)
def test_balls_lag_less_by_the_spin_that_the_race_gives_them(tmp_path, what):
    """J θ'' + h₀ θ' = −(1 − (J − 1) r/R_p) Ω': 2/5 of r/R_p for a ball, 1/2 for a roller, nothing for a point."""
    scene = ramp(tmp_path, what)
    J = FACTORS[what]
    lag = -(1 - (J - 1) * BALL / R_P) * 2400 / DRAG
    assert what != "ball" or lag == pytest.approx(-103.304348, abs=1e-6)
    times = np.array([0.05, 0.2, 0.5])
    states = integrate(assemble(scene), 1e-7, times).y
    np.testing.assert_allclose(states[6:8], [lag * -np.expm1(-DRAG * times / J)] * 2, rtol=1e-5)


@pytest.mark.parametrize("given", [RADIUS, "[scene.effects.ball_contact]\nball_radius_mm = 8.0"])
def test_a_driven_rotor_turns_its_balls_too(tmp_path, given):
    """By hand, γ of a ball and φ of the rotor in space, R = R_p + r the radius on which a ball rolls:

    J γ'' + h₀ (γ' − φ') = (2/5) (R/R_p) φ'', (I + (2/5) n m R²) φ'' − (2/5) m R R_p Σ γ'' = M + m R_p² h₀ Σ (γ' − φ').
    """
    inertia, stall, free = 2e-5, 0.2, 600.0
    effects = f"run_up = {{ time_s = 0.1 }}\nmotor = {{ stall_torque_N_m = {stall}, no_load_speed_rpm = 1e5, " \
              f"rotor_inertia_kg_m2 = {inertia} }}"  # fmt: skip
    radius, more = (given, "") if given == RADIUS else ("", "\n" + given)
    scene = replace(ramp(tmp_path, radius=radius, effects=effects + more), speed=free)
    free = 1e5 * math.pi / 30
    R = R_P + BALL

    def by_hand(t: float, z: np.ndarray) -> np.ndarray:
        ball, rotor = z
        left = np.array([[7 / 5, -2 / 5 * R / R_P],
                         [-2 * 2 / 5 * MASS * R * R_P, inertia + 2 * 2 / 5 * MASS * R**2]])  # fmt: skip
        dragged = DRAG * (ball - rotor)
        return np.linalg.solve(left, [-dragged, stall * (1 - rotor / free) + 2 * MASS * R_P**2 * dragged])

    times = np.linspace(0.002, 0.3, 20)
    found = solve_ivp(by_hand, (0, 0.3), [0.0, 0.0], t_eval=times, rtol=1e-11, atol=1e-9).y
    states = integrate(assemble(scene), 1e-9, times).y
    np.testing.assert_allclose(states[-1], found[1], rtol=1e-6)
    np.testing.assert_allclose(states[6] + states[-1], found[0], rtol=1e-6)
    # All that turns has the angular momentum that the motor has given.
    spun = inertia * found[1] + 2 * MASS * (R_P**2 * found[0] + 2 / 5 * BALL * (R * found[1] - R_P * found[0]))
    turned = states[-2]
    np.testing.assert_allclose(spun, stall * (times - turned / free), rtol=1e-6)


def test_balls_of_unknown_size_are_told_where_the_speed_changes(tmp_path):
    """A steel ball of 16.7 g, r = (3 m/4πρ)^(1/3) = 8.0 mm: 2/5 · 8.0/23 = 13.9 % of the lag; a roller 17.4 %."""
    short = "run_up = { time_s = 0.05 }"
    motor = "motor = { stall_torque_N_m = 3.0, no_load_speed_rpm = 1e5 }"

    def told(*how: str) -> list[str]:
        run = simulate(replace(ramp(tmp_path, *how), duration=0.06))
        return [text for text in run.warnings if "ball_radius_mm" in text]

    for what, share in (("ball", "14 %"), ("roller", "17 %")):
        (text,) = told(what, "", short)
        assert share.replace(" ", "") in text and "r = 8 mm" in text
    assert len(told("ball", "", motor)) == 1
    for known in (("ball", RADIUS, short), ("point", "", short), ("ball", "", ""), ("ball", "", short + CONTACT)):
        assert told(*known) == []


CONTACT = "\nball_contact = { ball_radius_mm = 8.0 }"


def test_an_arm_takes_the_reaction_of_what_runs_up_its_rotor():
    """J_O φ'' + b l² φ' + c l² φ = −J_r Ω' and then nothing: a step there and a step back, of a damped oscillator."""
    length, inertia, stiffness, damping, own = 0.35, 0.62, 2000.0, 40.0, 2e-3
    up, speed = 0.25, 150.0
    arm = idle_arm(Arm(length, inertia, stiffness, damping))
    scene = Scene("arm", arm, speed, 1e-9, 0.0, (), 0.5, (0.0,), (0.0,), effects=(RunUpEffect(up, 0.0, own),))
    rate, held = damping * length**2 / (2 * inertia), stiffness * length**2
    natural = math.sqrt(held / inertia - rate**2)

    def step(t: np.ndarray) -> np.ndarray:
        t = np.maximum(t, 0.0)
        return 1 - np.exp(-rate * t) * (np.cos(natural * t) + rate / natural * np.sin(natural * t))

    times = np.linspace(0, 0.5, 51)
    expected = -own * speed / up / held * (step(times) - step(times - up))
    found = integrate(assemble(scene), 1e-7, times).y[0]
    np.testing.assert_allclose(found, expected, atol=1e-4 * np.abs(expected).max())
    assert expected.min() < -5e-3
    # A motor of the same torque has the same ramp, and so the arm the same angle.
    motor = MotorEffect(own * speed / up, 1e7, own)
    driven = replace(scene, effects=(RunUpEffect(up), motor))
    early = times[times < up]
    np.testing.assert_allclose(integrate(assemble(driven), 1e-7, early).y[0], expected[: len(early)], rtol=0.01,
                               atol=1e-5)  # fmt: skip
    unknown = replace(scene, effects=(RunUpEffect(up),))
    assert np.abs(integrate(assemble(unknown), 1e-7, times).y[0]).max() < 1e-6
    (text,) = simulate(replace(unknown, imbalance=1e-4)).warnings
    assert "reaction torque" in text and "600 rad/s² takes 0.6 N·m" in text
    for known in (scene, driven):
        assert simulate(replace(known, imbalance=1e-4)).warnings == ()


def test_a_scene_file_gives_the_rotor_its_inertia(tmp_path):
    effects = "[scene.effects]\n"
    known = "run_up = { time_s = 1.0, rotor_inertia_kg_m2 = 2e-3 }\n"
    run_up, lift_off = scene_from(read(tmp_path, ARM + effects + known).scene).effects
    assert run_up == RunUpEffect(1.0, 0.0, 2e-3) and lift_off.name == "lift_off"
    motor = "motor = { stall_torque_N_m = 3.0, rotor_inertia_kg_m2 = 1e-3 }\n"
    error = refused(tmp_path, ARM + effects + known + motor)
    assert error.place is not None and error.place.key == "scene.effects.run_up.rotor_inertia_kg_m2"
    assert "one moment of inertia" in str(error) and "0.001 kg·m² in motor" in str(error)
    read(tmp_path, ARM + effects + known + motor.replace("1e-3", "2e-3"))
    error = refused(tmp_path, ARM + effects + known.replace("2e-3", "0.45"))
    assert "more inertia than the arm" in str(error) and "below" in str(error)


@pytest.mark.few(1)
@pytest.mark.parametrize("held", [2**22, 0])
def test_remarks_on_the_whole_run_do_not_hang_on_how_it_is_shown(monkeypatch, held):
    """A share of the time is that of the run, of a long one too, which is shown block by block."""
    from tests.dynamics.switching.test_contact_stop import contact, cutting

    wheel = replace(contact("rigid"), press_force=10.0, cutting_coefficient=0.0, runout=1e-4)
    scene = cutting(RunUpEffect(0.0, 0.8), wheel, duration=1.0)
    expected = simulate(scene, integrator="plain").warnings
    monkeypatch.setattr(response, "HELD", held)
    monkeypatch.setattr(recorder, "BLOCK", 50)
    assert simulate(scene, integrator="plain").warnings == expected != ()
