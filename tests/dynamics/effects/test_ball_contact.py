"""Balls that cannot pass each other: impacts, packed balls, and both together with dry friction."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.scipy_solvers import integrate
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.switching.modes import settled, starting, watched
from abu_calc.foundation.errors import InputError, RangeError
from tests.dynamics.energy import energy
from tests.dynamics.scenes import dimensionless

RADIUS = 0.2
BETA = math.asin(RADIUS)
IMBALANCE, BALL, DAMPING = 0.05, 0.02, 0.1


def bunch(count: int, middle: float = 0.3, beta: float = BETA) -> tuple[float, ...]:
    """Balls that touch each other."""
    return tuple(middle + 2 * beta * (k - (count - 1) / 2) for k in range(count))


def scene_of(speed: float, angles: tuple[float, ...], duration: float, *effects: Effect, drag: float = 0.05) -> Scene:
    return replace(dimensionless(speed, BALL, IMBALANCE, DAMPING, drag, angles, duration), effects=effects)


def heavy(scene: Scene) -> Scene:
    """On a support too heavy to move."""
    return replace(scene, imbalance=0.0, support=replace(scene.support, mass=((1e12, 0.0), (0.0, 1e12))))


def touching(masses: tuple[float, ...], speeds: tuple[float, ...], restitution: float) -> tuple[Equations, np.ndarray]:
    """Balls that touch and meet on a support as light as they are, and the state just after."""
    scene = scene_of(2.0, bunch(len(masses)), 5.0, BallContactEffect(RADIUS, restitution))
    race = replace(scene.races[0], ball_masses=masses, start_speeds=speeds, inertia_factor=1.4)
    equations = assemble(replace(scene, races=(race,), start_velocity=(0.3, -0.2)))
    return equations, starting(equations)[0]


def momentum_and_energy(equations: Equations, state: np.ndarray) -> tuple[np.ndarray, float]:
    """Of the support and the balls at t = 0, from velocities: x, y, and along the race of all balls; kinetic energy."""
    p = equations.parameters
    velocity, gamma, swing = state[2:4], state[4 : 4 + p.balls], state[4 + p.balls :] + equations.scene.speed
    along = np.array((-np.sin(gamma), np.cos(gamma)))
    own = velocity[:, None] + along * swing
    factor = p.inertia_factors
    linear = velocity + (p.masses * own).sum(axis=1)
    turning = (p.masses * ((along * own).sum(axis=0) + (factor - 1) * swing)).sum()
    # The rolling energy counts the spin relative to the race that turns steadily.
    rolling = (p.masses * (factor - 1) * (swing - equations.scene.speed) ** 2).sum()
    relative = own - along * equations.scene.speed
    energy = velocity @ velocity + (p.masses * (relative**2).sum(axis=0)).sum() + rolling
    return np.array((*linear, turning)), energy / 2


masses_and_speeds = st.integers(2, 6).flatmap(
    lambda n: st.tuples(
        st.lists(st.floats(0.01, 1.0), min_size=n, max_size=n), st.lists(st.floats(-1, 1), min_size=n, max_size=n)
    )
)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, derandomize=True)
@given(masses_and_speeds, st.sampled_from([0.0, 0.3, 0.8, 1.0]))
def test_an_impact_keeps_momentum_and_adds_no_energy(balls, restitution):
    masses, speeds = (tuple(values) for values in balls)
    equations, state = touching(masses, speeds, restitution)
    before, energy = momentum_and_energy(equations, np.array(equations.initial))
    after, left = momentum_and_energy(equations, state)
    np.testing.assert_allclose(after, before, rtol=1e-10, atol=1e-12)
    assert left <= energy * (1 + 1e-12)
    rates = state[-len(masses) :]
    assert (np.diff(rates) >= -1e-9).all()


@pytest.mark.parametrize("restitution", [0.0, 0.4, 1.0])
def test_two_balls_part_with_the_restitution(restitution):
    equations, state = touching((0.1, 0.3), (0.5, -0.2), restitution)
    assert state[-1] - state[-2] == pytest.approx(0.7 * restitution, rel=1e-9, abs=1e-12)
    _, before = momentum_and_energy(equations, np.array(equations.initial))
    _, after = momentum_and_energy(equations, state)
    assert after == pytest.approx(before, rel=1e-12) if restitution == 1 else after < before - 1e-3


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_two_balls_on_a_heavy_support_meet_as_by_hand(restitution):
    """Masses 0.1 and 0.3, 0.5 and −0.1 rad/s, 0.3 rad of room: they meet after 0.5 s, v = (Σmv ∓ m e Δv)/Σm."""
    angles = (1.0, 1.3 + 2 * BETA)
    scene = heavy(scene_of(2.0, angles, 3.5, BallContactEffect(RADIUS, restitution), drag=0.0))
    race = replace(scene.races[0], ball_masses=(0.1, 0.3), start_speeds=(0.5, -0.1))
    trajectory = integrate(assemble(replace(scene, races=(race,))), 1e-10, [0.0, 3.5])
    common = (0.1 * 0.5 - 0.3 * 0.1) / 0.4
    after = np.array((common - 0.3 * restitution * 0.6 / 0.4, common + 0.1 * restitution * 0.6 / 0.4))
    np.testing.assert_allclose(trajectory.y[6:, -1], after, atol=1e-9)
    meeting = np.array((1.25, 1.25 + 2 * BETA))
    np.testing.assert_allclose(trajectory.y[4:6, -1], meeting + 3.0 * after, atol=1e-8)


def test_an_elastic_row_passes_the_impact_on():
    """Newton's cradle: of equal balls the last one flies off."""
    scene = heavy(scene_of(2.0, (-0.5, *bunch(3, 1.0)), 5.0, BallContactEffect(RADIUS, 1.0), drag=0.0))
    scene = replace(scene, races=(replace(scene.races[0], start_speeds=(0.3, 0.0, 0.0, 0.0)),))
    end = integrate(assemble(scene), 1e-10, [5.0]).y[:, -1]
    np.testing.assert_allclose(end[-4:], (0, 0, 0, 0.3), atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.9])
def test_below_resonance_balls_stay_packed(restitution):
    """The largest resultant of touching balls, m R_p sin(nβ)/sin β, on the heavy side."""
    scene = scene_of(0.7, bunch(4), 400.0, BallContactEffect(RADIUS, restitution))
    end = integrate(assemble(scene), 1e-7, [400.0]).y[:, -1]
    angles = end[4:8]
    np.testing.assert_allclose(np.diff(angles), 2 * BETA, atol=1e-9)
    resultant = np.exp(1j * angles).sum()
    assert abs(resultant) == pytest.approx(math.sin(4 * BETA) / math.sin(BETA), rel=1e-9)
    unbalanced = abs(IMBALANCE + BALL * resultant) * 0.7**2
    assert unbalanced > IMBALANCE * 0.7**2 * 1.5
    expected = unbalanced / abs(1 - (1 + 4 * BALL) * 0.7**2 + 2j * DAMPING * 0.7)
    assert math.hypot(*end[:2]) == pytest.approx(expected, rel=1e-4)


@pytest.mark.slow
def test_above_resonance_a_bunch_spreads_and_balances():
    """Σ e^{iθ} = −U/(m R_p), with contact as without."""
    plain = scene_of(3.0, bunch(4), 300.0)
    for scene in (plain, replace(plain, effects=(BallContactEffect(RADIUS, 0.5),))):
        end = integrate(assemble(scene), 1e-7, [300.0]).y[:, -1]
        assert math.hypot(*end[:2]) < 1e-4
        assert np.exp(1j * end[4:8]).sum() == pytest.approx(-IMBALANCE / BALL, abs=5e-3)
    assert np.diff(end[4:8]).min() > 2 * BETA - 1e-9


def test_full_turns_in_the_start_angles_mean_nothing():
    angles = bunch(4)
    turned = tuple(angle + 2 * math.pi * k for angle, k in zip(angles, (0, -1, 2, 1), strict=True))
    t = np.linspace(0, 20, 41)
    one, other = (
        integrate(assemble(scene_of(3.0, start, 20.0, BallContactEffect(RADIUS, 0.5))), 1e-9, t).y
        for start in (angles, turned)
    )
    np.testing.assert_allclose(one[:4], other[:4], atol=1e-6)
    gaps = np.diff(one[4:8], axis=0)
    assert gaps.min() > 2 * BETA - 1e-9


@pytest.mark.few(0, 2)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("restitution", "coefficient"),
    [
        (0.5, 1e-2),
        *(pytest.param(*one, marks=pytest.mark.slow) for one in ((0.0, 1e-4), (0.5, 1e-4), (0.0, 1e-2))),
    ],
)
def test_twenty_balls_with_friction(restitution, coefficient):
    radius = 0.1
    beta = math.asin(radius)
    effects = BallContactEffect(radius, restitution), DryRollingFrictionEffect(coefficient * radius, radius)
    scene = scene_of(3.0, bunch(20, beta=beta), 20.0, *effects)
    scene = replace(scene, races=(replace(scene.races[0], ball_masses=(0.005,) * 20),))
    trajectory = integrate(assemble(scene), 1e-6, np.linspace(0, 20, 201))
    gaps = np.diff(trajectory.y[4:24], axis=0)
    assert gaps.min() > 2 * beta - 1e-6
    assert trajectory.y[4, -1] + 2 * math.pi - trajectory.y[23, -1] > 2 * beta - 1e-6


def test_a_bunch_that_friction_holds_never_moves():
    """Friction of each ball is far above what pulls it, pressed together or not."""
    effects = BallContactEffect(RADIUS, 0.5), DryRollingFrictionEffect(0.2 * RADIUS, RADIUS)
    trajectory = integrate(assemble(scene_of(0.7, bunch(4), 30.0, *effects)), 1e-7, np.linspace(0, 30, 61))
    assert (trajectory.y[4:8] == np.array(bunch(4))[:, None]).all()
    assert (trajectory.y[8:] == 0).all()


def test_a_ball_is_held_by_its_neighbour():
    """Pulled together by more than friction holds of one, by less than it holds of both.

    On a support that stands off by x and starts to fall back, balls at γ feel x k/M sin γ along the race (heavy rotor).
    """
    scene = scene_of(2.0, (math.pi / 2, math.pi / 2 + 2 * BETA), 5.0)
    scene = replace(scene, imbalance=0.0, start_position=(-0.5, 0.0), races=(replace(scene.races[0], drag=0.0),))
    race = replace(scene.races[0], ball_masses=(1e-9, 1e-9))
    pulls = 0.5 * np.sin((math.pi / 2, math.pi / 2 + 2 * BETA))
    # x'' = −x = 0.5, so each is pulled forward by 0.5 sin γ, the first one more; n is 4 less 0.5 cos γ.
    normal = 4 - 0.5 * np.cos((math.pi / 2, math.pi / 2 + 2 * BETA))
    assert pulls[0] / normal[0] > 0.12 > pulls[1] / normal[1]
    assert pulls.sum() < 0.12 * normal.sum()
    effects = BallContactEffect(RADIUS, 0.0), DryRollingFrictionEffect(0.12 * RADIUS, RADIUS)
    _, modes = starting(assemble(replace(scene, races=(race,), effects=effects)))
    assert modes[0].joined.tolist() == [1.0, 0.0]
    assert modes[1].direction.tolist() == [0.0, 0.0]
    # Alone, the first one starts.
    _, alone = starting(assemble(replace(scene, races=(race,), effects=effects[1:])))
    assert alone[0].direction.tolist() == [1.0, 0.0]


@pytest.mark.slow
@settings(max_examples=60, deadline=None, derandomize=True)
@given(
    st.lists(st.floats(0.001, 0.3), min_size=2, max_size=12),
    st.sampled_from([0.0, 1e-5, 1e-3, 1e-2, 0.1]),
    st.tuples(st.floats(-0.3, 0.3), st.floats(-0.3, 0.3)),
    st.floats(0, 6),
    st.lists(st.booleans(), min_size=12, max_size=12),
)
def test_every_start_holds(masses, coefficient, position, middle, apart):
    """What is watched, the laws of contact and of friction, is fulfilled by the modes that were decided."""
    effects = BallContactEffect(RADIUS / 2, 0.5), DryRollingFrictionEffect(coefficient * RADIUS, RADIUS)
    steps = 2 * math.asin(RADIUS / 2) + np.where(apart[: len(masses)], 0.03, 0.0)
    scene = scene_of(3.0, tuple(middle + np.cumsum(steps)), 10.0, *effects)
    scene = replace(scene, races=(replace(scene.races[0], ball_masses=tuple(masses)),), start_position=position)
    equations = assemble(scene)
    state, modes = starting(equations)
    values = np.array(watched(0.0, state, equations.in_mode(modes)))
    assert (values >= 0).all()


@pytest.mark.slow
@settings(max_examples=60, deadline=None, derandomize=True)
@given(masses_and_speeds, st.lists(st.floats(-0.2, 0.2), min_size=6, max_size=6), st.floats(0, 6))
def test_an_elastic_impact_of_balls_across_their_race_keeps_the_energy(balls, across, middle):
    """Balls off the middle of the groove stand at radii of their own: what they pass on are torques."""
    masses, speeds = (tuple(values) for values in balls)
    count, radius = len(masses), RADIUS / 2
    effects = MotorEffect(1.0, 3.0, 2.0), TransverseMotionEffect(0.5, radius), BallContactEffect(radius, 1.0)
    scene = scene_of(2.0, bunch(count, middle, math.asin(radius)), 10.0, *effects)
    scene = replace(scene, races=(replace(scene.races[0], ball_masses=masses, start_speeds=speeds),))
    equations = assemble(scene)
    y = np.array(equations.initial)
    y[4 + 2 * count : 4 + 3 * count] = across[:count]
    state, modes = settled(equations, 0.0, y, equations.first_modes)
    # Where a rebound is too slow to count, a millionth of the fastest at most, its energy is lost.
    assert energy(scene, 0.0, state, modes) == pytest.approx(energy(scene, 0.0, y), rel=1e-5)
    assert (np.diff(state[4 + count : 4 + 2 * count]) >= -1e-9).all()
    assert (np.array(watched(0.0, state, equations.in_mode(modes))) >= 0).all()


def test_balls_that_overlap_or_fill_the_race_are_refused():
    with pytest.raises(InputError, match=r"balls 1 and 2 overlap at the start"):
        assemble(scene_of(3.0, (1.0, 1.1), 10.0, BallContactEffect(RADIUS, 0.5)))
    with pytest.raises(InputError, match="fill their race"):
        third = 2 * math.pi / 6
        angles = tuple(third * k for k in range(6))
        assemble(scene_of(3.0, angles, 10.0, BallContactEffect(0.5, 0.5)))
    with pytest.raises(RangeError):
        BallContactEffect(RADIUS, 1.1)
    with pytest.raises(RangeError):
        BallContactEffect(0.0, 0.5)


def test_one_ball_has_no_neighbours():
    scene = scene_of(3.0, (1.0,), 10.0)
    t = np.linspace(0, 10, 11)
    alone, effect = (
        integrate(assemble(one), 1e-8, t).y
        for one in (scene, replace(scene, effects=(BallContactEffect(RADIUS, 0.5),)))
    )
    np.testing.assert_allclose(alone, effect, atol=1e-7)
