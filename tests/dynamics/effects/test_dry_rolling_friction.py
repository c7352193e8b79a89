"""Dry rolling friction: sticking is exact, Coulomb's law holds at every decision, and balls rest within its band."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations
from abu_calc.dynamics.integrators.scipy_solvers import integrate
from abu_calc.dynamics.motion import Solved
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.switching.modes import starting
from abu_calc.dynamics.switching.stick_slip import Rolling
from abu_calc.foundation.errors import RangeError
from tests.dynamics.scenes import coupled_scene, dimensionless

RADIUS = 0.1
SPEED, BALL, IMBALANCE, DAMPING = 2.0, 0.05, 0.02, 0.1


def rubbing(scene: Scene, coefficient: float) -> Scene:
    return replace(scene, effects=(DryRollingFrictionEffect(coefficient * RADIUS, RADIUS),))


def planar_scene(*angles: float, duration: float = 150.0, drag: float = 0.1) -> Scene:
    return dimensionless(SPEED, BALL, IMBALANCE, DAMPING, drag, angles, duration)


def accelerated(scene: Scene) -> Solved:
    """What acts at the start."""
    equations = assemble(rubbing(scene, 1e-3))
    state, modes = starting(equations)
    return accelerations(np, 0.0, state, equations.in_mode(modes))[2]


def whirl(angles: tuple[float, ...]) -> complex:
    """Displacement of the axis in the rotor, balls fixed: U Ω²/(k − M Ω² + i c Ω)."""
    resultant = IMBALANCE + BALL * sum(np.exp(1j * angle) for angle in angles)
    mass = 1 + len(angles) * BALL
    return complex(resultant * SPEED**2 / (1 - mass * SPEED**2 + 2j * DAMPING * SPEED))


@pytest.mark.slow
@pytest.mark.parametrize("coefficient", [1e-5, 1e-4, 1e-3, 1e-2, 1e-1])
def test_balls_come_to_rest_within_the_band(coefficient):
    """|w| ≤ f R_p/min(|sin θ*|, |cos θ*|), first order in |w|/R_p: n differs from R_p Ω² by that much."""
    scene = rubbing(planar_scene(1.6, -1.4, duration=400.0), coefficient)
    end = integrate(assemble(scene), 1e-7, [0.0, scene.duration]).y[:, -1]
    amplitude, angles = math.hypot(*end[:2]), end[4:6]
    assert end[6:].tolist() == [0.0, 0.0]
    smallest = min(np.abs(np.sin(angles)).min(), np.abs(np.cos(angles)).min())
    assert amplitude <= coefficient / smallest * (1 + amplitude)
    assert amplitude == pytest.approx(abs(whirl(tuple(angles))), rel=1e-6, abs=1e-9)


def test_a_ball_sticks_up_to_friction_and_no_further():
    """On the steady whirl a ball feels Ω² Im(w e^{−iθ}) along its race and Ω² (R_p + Re(w e^{−iθ})) into it."""
    angles = (1.0, 2.9)
    w = whirl(angles)
    turned = [w * np.exp(-1j * angle) for angle in angles]
    needed = max(abs(z.imag) / (1 + z.real) for z in turned)
    start = replace(
        planar_scene(*angles, duration=20.0),
        start_position=(w.real, w.imag),
        start_velocity=(-SPEED * w.imag, SPEED * w.real),
    )
    t = np.linspace(0, 20, 101)
    held = integrate(assemble(rubbing(start, needed * (1 + 1e-5))), 1e-10, t)
    assert held.events == 0
    assert (held.y[4:6] == np.array(angles)[:, None]).all()
    assert (held.y[6:] == 0).all()
    np.testing.assert_allclose(np.hypot(*held.y[:2]), abs(w), rtol=1e-7)
    freed = integrate(assemble(rubbing(start, needed * (1 - 1e-3))), 1e-10, t)
    assert np.abs(freed.y[4:6, -1] - angles).max() > 1e-4


def smoothed(scene: Scene, coefficient: float, times: list[float], sides: Sequence[float] = ()) -> np.ndarray:
    """A second derivation: planar equations as one linear system, sign(θ') smoothed over 1e-6 rad/s.

    Balls on given sides, or on those to which they are pressed without friction.
    """
    angles, drag = np.array(scene.start_angles), scene.races[0].drag
    n = len(angles)

    def rhs(t, y):
        place, velocity, theta, rate = np.split(y, [2, 4, 4 + n])
        gamma = theta + SPEED * t
        outward = np.array((np.cos(gamma), np.sin(gamma)))
        along = np.array((-np.sin(gamma), np.cos(gamma)))
        A, b = np.zeros((2 + 2 * n, 2 + 2 * n)), np.zeros(2 + 2 * n)
        A[:2, :2], A[:2, 2 : 2 + n] = (1 + n * BALL) * np.eye(2), BALL * along
        phase = np.array((math.cos(SPEED * t), math.sin(SPEED * t)))
        b[:2] = -place - 2 * DAMPING * velocity + scene.imbalance * SPEED**2 * phase
        b[:2] += BALL * (outward * (rate + SPEED) ** 2).sum(axis=1)
        A[2 : 2 + n, :2], A[2 : 2 + n, 2 : 2 + n] = along.T, np.eye(n)
        b[2 : 2 + n] = -drag * rate
        A[2 + n :, :2], A[2 + n :, 2 + n :], b[2 + n :] = outward.T, np.eye(n), (rate + SPEED) ** 2
        side = sides or np.sign(np.linalg.solve(A, b)[2 + n :])
        A[2 : 2 + n, 2 + n :] = coefficient * np.diag(side * np.tanh(rate / 1e-6))
        found = np.linalg.solve(A, b)
        return np.concatenate([velocity, found[:2], rate, found[2 : 2 + n]])

    start = np.concatenate([scene.start_position, scene.start_velocity, angles, np.zeros(n)])
    solution = solve_ivp(rhs, (0, times[-1]), start, method="LSODA", rtol=1e-8, atol=1e-10, t_eval=times)
    return np.asarray(solution.y)


@pytest.mark.few(1)
@pytest.mark.parametrize("coefficient", [1e-3, 1e-2])
def test_same_motion_as_friction_smoothed_over_a_tiny_speed(coefficient):
    """What creeps at 1e-6 rad/s for 20 s differs by 2e-5 rad from what sticks."""
    scene, times = planar_scene(1.6, -1.4, duration=20.0), [5.0, 12.0, 20.0]
    mine = integrate(assemble(rubbing(scene, coefficient)), 1e-9, times)
    np.testing.assert_allclose(mine.y, smoothed(scene, coefficient, times), atol=5e-5)


def test_without_a_lever_arm_there_is_no_friction():
    scene = coupled_scene()
    t = np.linspace(0, scene.duration, 21)
    plain, zero = (integrate(assemble(one), 1e-8, t) for one in (scene, rubbing(scene, 0.0)))
    np.testing.assert_allclose(zero.y, plain.y, atol=1e-6)
    assert zero.events == 0


@pytest.mark.slow
def test_a_start_that_chatters_is_gone_through():
    """Free vibration of the support shakes the balls loose and lets them stick again, ever less."""
    scene = dimensionless(SPEED, 0.01, 0.0, 0.02, 0.1, (1.6, -1.4), 200.0)
    equations = assemble(rubbing(replace(scene, start_velocity=(0.4, 0.0)), 2e-2))
    t = np.linspace(0, 200, 4001)
    trajectory = integrate(equations, 1e-7, t)
    assert 30 < trajectory.events < 300
    assert (trajectory.y[4:6, 2000] == trajectory.y[4:6, -1]).all()
    # What sticks at a sample needs no more than f n to be held, and now and then nearly that.
    shares = []
    for moment, state in zip(t, trajectory.y.T, strict=True):
        mode = Rolling(np.sign(state[6:]), np.ones(2), np.ones(2))
        _, _, solved = accelerations(np, moment, state, equations.in_mode((mode,)))
        shares += (np.abs(solved.left) / solved.normal)[state[6:] == 0].tolist()
    assert 0.0198 < max(shares) < 0.02 * (1 + 1e-6)
    assert (trajectory.y[6:, -1] == 0).all()


def told(scene: Scene) -> tuple[str, ...]:
    """By its first effect, of a run."""
    equations = assemble(scene)
    return scene.effects[0].remarks(equations, integrate(equations, 1e-6, np.linspace(0, 20, 2001)))


def test_a_ball_off_the_outer_side_of_its_race_rubs_on_the_inner_one():
    """The support swings back with x'' = −x = 3.9 cos t; the balls are pressed by R_p Ω² = 4 and turn with 2 t."""
    scene = replace(planar_scene(1.6, 0.1), start_position=(-3.9, 0.0), imbalance=0.0)
    assert (accelerated(scene).normal > 0).all()
    scene = replace(scene, start_position=(-4.5, 0.0))
    equations = assemble(rubbing(scene, 1e-3))
    state, modes = starting(equations)
    assert modes[0].side.tolist() == [1.0, -1.0]
    assert accelerations(np, 0.0, state, equations.in_mode(modes))[2].normal[1] < -0.4


@pytest.mark.few(1)
@pytest.mark.parametrize("coefficient", [1e-3, 1e-2])
def test_same_motion_as_smoothed_where_balls_change_sides(coefficient):
    """What creeps at 1e-6 rad/s for 5 s differs by 5e-6 rad from what sticks."""
    scene = replace(planar_scene(1.6, -0.6), start_position=(-6.0, 0.0), imbalance=0.0)
    times = [1.0, 2.0, 3.0, 5.0]
    mine = integrate(assemble(rubbing(scene, coefficient)), 1e-9, times)
    np.testing.assert_allclose(mine.y, smoothed(scene, coefficient, times), atol=1e-5)
    # Were the inner side not known, friction would drive the ball there.
    assert np.abs(mine.y - smoothed(scene, coefficient, times, (1.0, 1.0))).max() > 1e-3


def test_a_ball_off_the_outer_side_of_its_race_is_told():
    """Once it is pulled off by more than nothing, with the first sample at which it is."""
    scene = replace(planar_scene(1.6, -0.6), start_position=(-4.3, 0.0), imbalance=0.0)
    dry = rubbing(scene, 1e-3)
    [said] = told(dry)
    assert "ball 2 is pulled off the outer side of its race at t = 0.0" in said
    calm = rubbing(replace(scene, start_position=(-1.0, 0.0)), 1e-3)
    assert told(calm) == ()


@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.integers(1, 20).flatmap(
        lambda n: st.tuples(
            st.lists(st.floats(0, 6.2), min_size=n, max_size=n),
            st.lists(st.floats(0.001, 0.2), min_size=n, max_size=n),
            st.lists(st.sampled_from([0.0, 0.0, 0.1, -0.2]), min_size=n, max_size=n),
        )
    ),
    st.floats(-5, -1),
    st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.1)),
)
@pytest.mark.slow
def test_every_start_obeys_the_law_of_coulomb(balls, exponent, position):
    """Balls as heavy as the support: sticking ones are held by |F| ≤ f n, and their speed is 0; others roll with σ."""
    angles, masses, speeds = (tuple(values) for values in balls)
    scene = planar_scene(*angles)
    race = replace(scene.races[0], ball_masses=masses, start_speeds=speeds)
    scene = rubbing(replace(scene, races=(race,), start_position=position), 10**exponent)
    equations = assemble(scene)
    state, modes = starting(equations)
    _, _, solved = accelerations(np, 0.0, state, equations.in_mode(modes))
    sigma, side, rates = modes[0].direction, modes[0].side, state[-len(angles) :]
    assert (side * solved.normal > 0).all()
    sticks = sigma == 0
    assert (rates[sticks] == 0).all()
    assert (solved.balls[sticks] == 0).all()
    assert (np.abs(solved.left[sticks]) <= 10**exponent * np.abs(solved.normal[sticks]) * (1 + 1e-6)).all()
    starts = ~sticks & (rates == 0)
    assert (sigma[starts] * solved.balls[starts] >= 0).all()
    moving = rates != 0
    assert (sigma[moving] == np.sign(rates[moving])).all()
    np.testing.assert_array_equal(rates, speeds)


@pytest.mark.slow
@settings(max_examples=8, deadline=None, derandomize=True)
@given(st.lists(st.floats(0, 6.2), min_size=1, max_size=5), st.floats(-4, -1), st.floats(0.4, 3.0))
def test_balls_rest_exactly_or_move(angles, exponent, speed):
    """Where a ball stands at two samples with the speed 0 and nothing happened between, its angle has the same bits."""
    scene = rubbing(dimensionless(speed, 0.02, 0.01, 0.1, 0.1, tuple(angles), 20.0), 10**exponent)
    equations = assemble(scene)
    seen = []
    rhs = equations.rhs

    def spying(xp, t, y, p):
        stuck = p.modes[0].direction == 0
        seen.append(np.all(y[-len(angles) :][stuck] == 0))
        return rhs(xp, t, y, p)

    integrate(replace(equations, rhs=spying), 1e-6, np.linspace(0, 20, 41))
    assert all(seen)


def test_power_is_what_friction_takes():
    """−Σ m f n R_p |θ'|, n = R_p Ω² for balls on a support too heavy to move."""
    scene = planar_scene(1.0, 2.0)
    heavy = replace(scene, imbalance=0.0, support=replace(scene.support, mass=((1e12, 0.0), (0.0, 1e12))))
    race = replace(heavy.races[0], start_speeds=(0.3, -0.2))
    effect = DryRollingFrictionEffect(0.01 * RADIUS, RADIUS)
    equations = assemble(replace(heavy, races=(race,), effects=(effect,)))
    state, modes = starting(equations)
    motion, _, solved = accelerations(np, 0.0, state, equations.in_mode(modes))
    expected = -BALL * 0.01 * ((SPEED + 0.3) ** 2 * 0.3 + (SPEED - 0.2) ** 2 * 0.2)
    assert effect.power(motion, modes[0], None, solved, equations.parameters) == pytest.approx(expected, rel=1e-9)


def test_weight_is_the_band_over_the_amplitude_it_is_weighed_by():
    """Two balls at ±θ*, cos θ* = −0.2; the amplitude without balls is U Ω²/|k − MΩ² + icΩ|, 1 % of it one unit."""
    scene = planar_scene(1.6, -1.4)
    amplitude = IMBALANCE * SPEED**2 / abs(1 - SPEED**2 + 2j * DAMPING * SPEED)
    assert DryRollingFrictionEffect(1e-5, RADIUS).weight(scene).value == pytest.approx(1e-4 / 0.2 / (0.01 * amplitude))
    assert DryRollingFrictionEffect(0.0, RADIUS).weight(scene).value == 0


@pytest.mark.slow
def test_rolling_across_the_race_shakes_friction_out():
    """A ball that rolls across by v ≫ R_p θ' feels f n R_p θ'/|v| along: next to nothing holds it beside its place.

    Without axial runout nothing moves across, and the balls stick as without that freedom.
    """
    dry = rubbing(planar_scene(1.6, -1.4, duration=60.0), 1e-3)
    ends = [
        integrate(assemble(replace(dry, effects=(*more, *dry.effects))), 1e-7, [dry.duration]).y[:8, -1]
        for more in ((), (TransverseMotionEffect(0.4, RADIUS, 0.0),), (TransverseMotionEffect(0.4, RADIUS, 0.02),))
    ]
    np.testing.assert_allclose(ends[1], ends[0], atol=1e-5)
    resting, _, shaken = (math.hypot(*end[:2]) for end in ends)
    assert shaken < resting / 2
    assert (ends[0][6:] == 0).all()


def test_a_ball_starts_no_faster_than_drag_lets_it_go():
    """With a drag of 1e5 Ω it could not keep the speed it usually starts with, and would stop and start without end."""
    scene = rubbing(planar_scene(1.6, -1.4, duration=4.0, drag=1e5 * SPEED), 1e-3)
    shaken = replace(scene, effects=(TransverseMotionEffect(0.4, RADIUS, 0.02), *scene.effects))
    trajectory = integrate(assemble(shaken), 2e-4, [4.0], method="scipy-radau")
    assert trajectory.events < 40


@pytest.mark.parametrize(("arm", "radius"), [(-1e-6, 0.01), (0.02, 0.01), (math.nan, 0.01), (1e-6, 0.0)])
def test_wrong_numbers_are_refused(arm, radius):
    with pytest.raises(RangeError):
        DryRollingFrictionEffect(arm, radius)
