"""Cutting that stops a rotor: friction turns round with the sliding, and at rest holds no more than it is pulled."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import STEP, assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations
from abu_calc.dynamics.integrators.choice import available, integrate_with
from abu_calc.dynamics.scene import Race, Scene, placed
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.switching.contact_stop import Cutting
from abu_calc.dynamics.switching.modes import settled
from abu_calc.simulation.simulate import simulate
from tests.dynamics.energy import energy, power
from tests.dynamics.scenes import SUPPORTS, scene_on

SPEED, NO_LOAD, INERTIA = 300.0, 600.0, 2e-3
PRESS, F, RADIUS = 45.0, 0.35, 0.075
MOST = F * PRESS * RADIUS
"""1.18125 N m, which cutting takes of a wheel that slides."""
MASS, STIFFNESS, DAMPING = 4.0, 1e4, 40.0


def contact(kind: str, **changes: float) -> GrindingContactEffect:
    stiffness = 2e4 if kind == "compliant" else 0.0
    return replace(GrindingContactEffect(PRESS, F, kind, stiffness, wheel_radius=RADIUS), **changes)  # type: ignore[arg-type]


def cutting(*effects: Effect, y: float = 0.0, races: tuple[Race, ...] = (), duration: float = 3.0) -> Scene:
    """A rotor next to without imbalance, which gives a length to count errors by, its axis out of place along y."""
    scene = Scene("cutting", planar(MASS, (STIFFNESS,) * 2, (DAMPING,) * 2), SPEED, 1e-8, 0.0, races, duration,
                  (0.0, y), (0.0, 0.0), effects=effects)  # fmt: skip
    return placed(scene)


PLAIN, ALL = ("plain-rk45",), ("scipy-dop853", "plain-rk45", "compiled-dop853")


def states_of(scene: Scene, times: np.ndarray, names: tuple[str, ...] = PLAIN) -> list[np.ndarray]:
    """The states of a scene by these integrators, as far as they are here."""
    equations = assemble(scene)
    here = [name for name in names if name in available(equations)]
    return [integrate_with(name, equations, 1e-8, times, 10**7).y for name in here]


@pytest.mark.parametrize(
    ("stall", "names"), [(0.8, PLAIN), (0.0001, PLAIN), pytest.param(0.8, ALL, marks=pytest.mark.slow)]
)
def test_a_rotor_that_the_motor_cannot_drive_comes_to_rest_and_stands(stall, names):
    """J Ω' = M (1 − Ω/Ω₀) − f N R_w until Ω = 0: Ω = Ω∞ + (Ω_s − Ω∞) e^{−t/τ}, τ = J Ω₀/M, Ω∞ = Ω₀ (1 − f N R_w/M)."""
    scene = cutting(MotorEffect(stall, NO_LOAD, INERTIA), contact("face"))
    tau, last = INERTIA * NO_LOAD / stall, NO_LOAD * (1 - MOST / stall)
    stop = tau * math.log((SPEED - last) / -last)
    times = np.array([0.5, 0.9, 0.999, 1.001, 1.5, 2.5]) * stop
    expected = np.where(times < stop, last + (SPEED - last) * np.exp(-times / tau), 0.0)
    assert 0.4 < stop < 1.2 and times[-1] < scene.duration
    for states in states_of(scene, times, names):
        np.testing.assert_allclose(states[-1], expected, atol=1e-6 * SPEED)


@pytest.mark.parametrize("share", [0.9999, 1.0001, 2.0])
def test_from_rest_the_motor_has_to_overcome_friction(share):
    """Where M > f N R_w it starts, Ω = Ω₀ (1 − f N R_w/M) (1 − e^{−M t/(J Ω₀)}); else not at all."""
    scene = cutting(RunUpEffect(0.1), MotorEffect(share * MOST, NO_LOAD, INERTIA), contact("face"), duration=1.0)
    last = max(NO_LOAD * (1 - 1 / share), 0.0) * -math.expm1(-share * MOST / (INERTIA * NO_LOAD))
    for states in states_of(scene, np.array([1.0])):
        assert states[-1, -1] == pytest.approx(last, rel=1e-6, abs=1e-9)


def own_motion(scene: Scene, stall: float, normal, times: np.ndarray) -> np.ndarray:
    """x, Ω by hand: sliding until x' + R Ω = 0, then rolling on the work, J Ω' = M + T R and M x'' = … + T.

    `normal` N(t) of a contact whose y is known. Refuses rolling by more than f N.
    """

    def motor(speed: float) -> float:
        return stall * (1 - speed / NO_LOAD)

    def slides(t: float, z: np.ndarray) -> list[float]:
        T = -F * normal(t)
        return [z[1], (T - STIFFNESS * z[0] - DAMPING * z[1]) / MASS, (motor(z[2]) + T * RADIUS) / INERTIA]

    def stops(t: float, z: np.ndarray) -> float:
        return float(z[1] + RADIUS * z[2])

    def rolls(t: float, z: np.ndarray) -> list[float]:
        """R² (M x'' + c x' + k x) + J x'' = −R M_motor, from T = (J Ω' − M_motor)/R and Ω = −x'/R."""
        speed = -z[1] / RADIUS
        force = -motor(speed) / RADIUS - STIFFNESS * z[0] - DAMPING * z[1]
        a = force / (MASS + INERTIA / RADIUS**2)
        T = (-INERTIA * a / RADIUS - motor(speed)) / RADIUS
        assert abs(T) < F * normal(t)
        return [z[1], a]

    stops.terminal, tight = True, {"rtol": 1e-11, "atol": 1e-13, "dense_output": True}  # type: ignore[attr-defined]
    first = solve_ivp(slides, (0, 10), [0.0, 0.0, SPEED], events=stops, **tight)
    stop = first.t[-1]
    second = solve_ivp(rolls, (stop, times[-1]), first.y[:2, -1], **tight)
    before, after = times[times < stop], times[times >= stop]
    assert len(before) > 5 and len(after) > 5
    rolled = second.sol(after)
    return np.hstack([first.sol(before)[[0, 2]], [rolled[0], -rolled[1] / RADIUS]])


@pytest.mark.few(1)
@pytest.mark.parametrize(("kind", "names"), [("compliant", PLAIN), ("rigid", ALL)])
def test_a_wheel_that_stands_on_its_edge_rolls_with_the_swinging_axis(kind, names):
    """A compliant contact's N swings about the press force as the axis does along y."""
    y, stall = (2e-4 if kind == "compliant" else 0.0), 0.3
    scene = cutting(MotorEffect(stall, NO_LOAD, INERTIA), contact(kind), y=y, duration=1.0)
    rate = DAMPING / (2 * MASS)
    natural = math.sqrt((STIFFNESS + 2e4) / MASS - rate**2)

    def normal(t: float) -> float:
        swing = math.cos(natural * t) + rate / natural * math.sin(natural * t)
        return PRESS - 2e4 * y * math.exp(-rate * t) * swing if y else PRESS

    times = np.linspace(0.01, 1.0, 150)
    x, speed = own_motion(scene, stall, normal, times)
    for states in states_of(scene, times, names):
        np.testing.assert_allclose(states[0], x, atol=1e-5 * np.abs(x).max())
        np.testing.assert_allclose(states[-1], speed, atol=1e-6 * SPEED)


@pytest.mark.parametrize("kind", ["face", "compliant", "rigid"])
@pytest.mark.parametrize("support", [name for name in SUPPORTS if name != "swing arm"])
def test_standing_takes_no_energy_and_keeps_the_surface_at_rest(support, kind):
    """By balls in motion, runout and a rotor that is not quite still, so that nothing is zero by chance."""
    wheel = GrindingContactEffect(2.0, 0.9, kind, 3.0 if kind == "compliant" else 0.0, -1, 0.1, 0.8, 1.1)  # type: ignore[arg-type]
    scene = scene_on(
        support, MotorEffect(0.1, 3.0, 6.0), wheel, BallContactEffect(0.1, 0.5), DryRollingFrictionEffect(0.002, 0.1)
    )
    equations, size = assemble(scene), len(scene.support.names)
    y = np.array(equations.initial) + np.random.default_rng(4).uniform(-0.05, 0.05, len(equations.states))
    y[size : 2 * size] = 0.0
    P = np.array(scene.support.race_map)[:2]  # type: ignore[attr-defined]

    def over_the_work(y: np.ndarray) -> np.ndarray:
        across = P[0] @ y[size : 2 * size] if kind != "face" else 0.0
        return across + y[-1] * (1.1 - (0.1 * np.sin(y[-2] + 0.8) if kind != "face" else 0.0))

    y[-1] = 0.0
    if kind == "rigid":
        y[:size] += P[1] * (-0.1 * math.sin(y[-2] + 0.8) - P[1] @ y[:size]) / (P[1] @ P[1])
    y, modes = settled(equations, 0.0, y, equations.first_modes)
    assert modes[1] == Cutting(1.0, 0.0)
    rates = equations.rhs(np, 0.0, y, equations.in_mode(modes))
    moved = y + 1j * STEP * rates
    assert over_the_work(moved).imag / STEP == pytest.approx(0.0, abs=1e-12)
    change = energy(scene, 1j * STEP, moved, modes).imag / STEP
    assert change == pytest.approx(power(scene, 0.0, y, modes), rel=1e-9, abs=1e-10)
    m, _, solved = accelerations(np, 0.0, y, equations.in_mode(modes))
    held = solved.beside if kind == "rigid" else solved.reaction
    normal = solved.reaction if kind == "rigid" else wheel.pressed(m, modes[1], equations.parameters)
    assert 0 < abs(held) <= 0.9 * normal


def test_friction_turns_round_with_the_rotor():
    """Thrown backward, the rotor is braked all the same."""
    scene = cutting(MotorEffect(0.1, NO_LOAD, INERTIA), contact("face"))
    equations = assemble(scene)
    for speed in (20.0, -20.0):
        y = np.array(equations.initial)
        y[-1] = speed
        y, modes = settled(equations, 0.0, y, equations.first_modes)
        motor = 0.1 * (1 - speed / NO_LOAD)
        expected = (motor - math.copysign(MOST, speed)) / INERTIA
        assert equations.rhs(np, 0.0, y, equations.in_mode(modes))[-1] == pytest.approx(expected, rel=1e-12)


def test_balls_go_on_in_a_rotor_that_stands_and_it_is_told():
    """Their drag brakes them as e^{−h₀ t/J} from where the rotor stopped; an opposite pair pulls at nothing else."""
    race = Race(0.024, (0.0167,) * 2, 3.0, 7 / 5, (0.5, 0.5 + math.pi), (0.0, 0.0), ball_radius=0.008)
    scene = cutting(MotorEffect(0.8, NO_LOAD, INERTIA), contact("face"), races=(race,), duration=2.5)
    stands = simulate(scene)
    (told,) = stands.warnings
    run = stands.trajectory
    since = run.t[np.flatnonzero(np.abs(run.y[-1]) > 0.01 * SPEED)[-1]]
    assert "stands on the work" in told and "1.18 N·m" in told
    assert float(told.split()[told.split().index("t") + 2]) == pytest.approx(since, abs=0.01)
    times = np.array([1.3, 2.3])
    for states in states_of(scene, times):
        assert states[-1] == pytest.approx([0.0, 0.0], abs=1e-6 * SPEED)
        assert states[6, 1] / states[6, 0] == pytest.approx(math.exp(-3.0 / 1.4), rel=1e-6)
        assert states[6, 0] > 10
    driven = replace(scene, effects=(MotorEffect(3.0, NO_LOAD, INERTIA), contact("face")))
    assert simulate(driven).warnings == ()


def test_a_rotor_that_never_starts_leaves_balls_with_dry_friction_at_rest():
    """Nothing presses them, so friction holds nothing, and nothing but rounding pulls."""
    race = Race(0.03, (0.0167,) * 3, 8.0, 1.4, (0.5, 1.7, 2.9), (0.0,) * 3, ball_radius=0.008)
    balls = BallContactEffect(0.008, 0.5), DryRollingFrictionEffect(2e-6, 0.008)
    scene = cutting(
        RunUpEffect(0.1), MotorEffect(0.8, NO_LOAD, INERTIA), contact("face"), *balls, races=(race,), duration=1.0
    )
    run = simulate(replace(scene, imbalance=1e-4))
    assert run.response.ball_angles == pytest.approx(race.start_angles, abs=1e-9)
    assert run.response.final.rotor_speed == pytest.approx(0.0, abs=1e-9)


# A rigid contact that would have to pull


@pytest.mark.parametrize("press", [10.0, 25.0, 40.0])
def test_a_rigid_contact_that_pulls_while_the_speed_is_high_is_told(press):
    """N = N₀ + M y'' + c y' + k y, y = −ε sin(turn + φ₀) given; near the end of a run-down it does not pull."""
    eps, phase, down, duration = 1e-4, 0.6, 0.8, 1.0
    wheel = GrindingContactEffect(press, 0.0, "rigid", runout=eps, runout_angle=phase)
    scene = cutting(RunUpEffect(0.0, down), wheel, duration=duration)
    t = np.linspace(0, duration, 400_001)
    late = np.maximum(t - (duration - down), 0.0)
    fall = SPEED / down * (late > 0)
    turn, speed = SPEED * t - fall * late**2 / 2 + phase, SPEED - fall * late
    y, rate = -eps * np.sin(turn), -eps * np.cos(turn) * speed
    normal = press + MASS * eps * (np.sin(turn) * speed**2 + np.cos(turn) * fall) + DAMPING * rate + STIFFNESS * y
    share, least = 100 * (normal < 0).mean(), normal.min()
    assert normal[t > 0.95].min() > 0 and (least < 0) == (press < 30)
    warnings = simulate(scene).warnings
    assert len(warnings) == (least < 0)
    if least < 0:
        words = warnings[0].split()
        told = float(words[words.index("%") - 1])
        assert told == pytest.approx(share, abs=1.5)
        # Between two of sixteen samples a turn, the deepest point is missed by 2 % of the swing.
        assert float(words[words.index("N:") - 1]) == pytest.approx(least, abs=0.02 * (press - least))
