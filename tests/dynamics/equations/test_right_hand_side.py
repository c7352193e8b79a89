"""The right-hand side against Lagrange's equations, and its symmetries.

Small linear systems for any kind of number, and accelerations by forces on the balls.
"""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import STEP, assemble
from abu_calc.dynamics.equations.right_hand_side import by_pulls, motion_of, prepared, solve, solve_all
from abu_calc.dynamics.rotor import DRIVEN, GUIDED, STEADY
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import LinearSupport
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from tests.dynamics.energy import Bodies, demanded, mass_matrix, resisting
from tests.dynamics.scenes import ROTORS, SUPPORTS, coupled_scene, dimensionless, scene_on, with_effects

GRAVITY, ECCENTRICITY = GravityEffect(0.9), RaceEccentricityEffect(0.1, 0.3)
MORE = [(), (ECCENTRICITY,), (GRAVITY,), (ECCENTRICITY, GRAVITY)]
seeds = st.integers(0, 2**32 - 1)
moments = st.floats(0, 10)


def rhs_of(scene: Scene, t: float, y: np.ndarray) -> np.ndarray:
    equations = assemble(scene)
    return equations.rhs(np, t, y, equations.acting)


def state_of(scene: Scene, seed: int) -> np.ndarray:
    """A state at random: anywhere, of either sign, the rotor too; only tilts are small."""
    names = assemble(scene).states
    y = np.random.default_rng(seed).uniform(-2, 2, len(names))
    return np.where([name in ("tilt_x", "tilt_y") for name in names], 0.1 * y, y)


def every_scene(*rotors: str) -> pytest.MarkDecorator:
    """Every support, turned in every way."""
    cases = [(support, rotor) for support in SUPPORTS for rotor in (rotors or ROTORS)]
    return pytest.mark.parametrize(("support", "rotor"), cases)


@pytest.mark.few(1)
@every_scene()
@settings(deadline=None, derandomize=True, max_examples=5)
@given(seed=seeds, t=moments, more=st.sampled_from(MORE))
def test_every_coordinate_obeys_lagrange(support, rotor, seed, t, more):
    """d/dt ∂L/∂v − ∂L/∂x is what dampers, gyroscopic moments, drag and motor supply."""
    scene = scene_on(support, *ROTORS[rotor], *more)
    y = state_of(scene, seed)
    supplied = resisting(scene, t, y)
    if rotor == "driven":
        motor = ROTORS[rotor][0]
        supplied[-1] += motor.stall_torque * (1 - y[-1] / motor.no_load_speed)
    free = Bodies(scene).freedoms
    # Rounding of sums whose terms are near 10.
    np.testing.assert_allclose(demanded(scene, t, y)[:free], supplied[:free], rtol=1e-10, atol=1e-11)


@every_scene()
@settings(deadline=None, derandomize=True, max_examples=4)
@given(seed=seeds, t=moments)
def test_mass_matrix_is_symmetric_and_positive_definite(support, rotor, seed, t):
    scene = scene_on(support, *ROTORS[rotor], ECCENTRICITY)
    matrix = mass_matrix(scene, t, state_of(scene, seed))
    assert len(matrix) == len(scene.support.names) + 5 + (rotor == "driven")
    np.testing.assert_allclose(matrix, matrix.T, rtol=1e-13, atol=1e-15)
    assert np.linalg.eigvalsh(matrix).min() > 0


def test_mass_matrix_of_the_plane_by_hand():
    """One ball of 0.2 kg at R_p = 0.5 m, J = 1.4, at γ = 0.3 + 2·0.7, on 3 kg."""
    scene = dimensionless(2.0, 0.2, 0.1, 0.0, 0.0, (0.0,), 10.0, inertia_factor=1.4)
    scene = replace(
        scene,
        support=replace(scene.support, mass=((3.0, 0.0), (0.0, 3.0))),
        races=(replace(scene.races[0], pitch_radius=0.5),),
    )
    s, c = 0.1 * math.sin(1.7), 0.1 * math.cos(1.7)
    expected = [[3.2, 0, -s], [0, 3.2, c], [-s, c, 1.4 * 0.2 * 0.25]]
    y = np.array([0.1, 0.2, 0, 0, 0.3, 0])
    np.testing.assert_allclose(mass_matrix(scene, 0.7, y), expected, rtol=1e-14, atol=1e-16)


@every_scene()
@settings(deadline=None, derandomize=True, max_examples=4)
@given(seed=seeds, t=moments)
def test_velocities_are_the_rates_of_places(support, rotor, seed, t):
    """The kinetic energy is made of slopes over long steps: they are exact."""
    scene = scene_on(support, *ROTORS[rotor], ECCENTRICITY)
    bodies = Bodies(scene)
    x, v = bodies.split(t, state_of(scene, seed))
    slow = replace(scene, support=massless(scene), races=tuple(replace(r, inertia_factor=1.0) for r in scene.races))
    slow = with_effects(replace(slow, imbalance=0.0, couple=0.0), ECCENTRICITY)
    moving = bodies.places(x + 1j * STEP * v).imag / STEP
    kinetic = (np.array(scene.ball_masses) * moving**2).sum() / 2
    if getattr(scene.support, "axial_inertia", False):  # what a leaning race lacks in radius is told apart
        going = v[bodies.size : bodies.size + bodies.balls] + v[-1]
        kinetic -= (np.array(scene.ball_masses) * bodies.sunk(x) * going**2).sum() / 2
    assert v @ Bodies(slow).mass(x) @ v / 2 == pytest.approx(kinetic, rel=1e-12)


def massless(scene: Scene) -> LinearSupport | SwingArmSupport:
    """The support with next to no mass of its own."""
    if isinstance(scene.support, SwingArmSupport):
        return replace(scene.support, inertia=1e-300)
    return replace(scene.support, mass=tuple(tuple(0.0 for _ in row) for row in scene.support.mass))


@every_scene()
def test_races_have_no_order(support, rotor):
    scene = scene_on(support, *ROTORS[rotor], ECCENTRICITY, GRAVITY)
    y = state_of(scene, 5)
    first = 2 * len(scene.support.names)
    index = np.arange(len(y))
    index[first : first + 10] = first + np.array([3, 4, 0, 1, 2, 8, 9, 5, 6, 7])
    moved = rhs_of(replace(scene, races=scene.races[::-1]), 0.7, y[index])
    np.testing.assert_allclose(moved, rhs_of(scene, 0.7, y)[index], rtol=1e-10, atol=1e-11)


def test_a_rotor_guided_at_constant_speed_is_steady():
    """The same accelerations, whether the turn is told or a state."""
    for support in SUPPORTS:
        scene = scene_on(support, ECCENTRICITY)
        guided = with_effects(scene, RunUpEffect(0.0, 2.0), ECCENTRICITY)
        y = state_of(scene, 11)
        computed = rhs_of(guided, 0.7, np.array([*y, 0.7 * scene.speed, scene.speed]))
        np.testing.assert_allclose(computed[:-2], rhs_of(scene, 0.7, y), rtol=1e-12, atol=1e-13)
        assert computed[-2:].tolist() == [scene.speed, 0.0]


def test_a_heavy_rotor_hardly_feels_its_balls():
    """Of a rotor with very much inertia, the motor alone decides the speed, and the rest goes on as if guided."""
    for support in SUPPORTS:
        if support == "swing arm":  # it carries no rotor that is heavier than itself
            continue
        speed, inertia = 1.3, 1e9
        scene = scene_on(support, MotorEffect(0.0, 1.0, inertia), ECCENTRICITY)
        y = state_of(scene, 13)
        y[-1] = speed
        computed = rhs_of(scene, 0.7, y)
        steady = replace(with_effects(scene, ECCENTRICITY), speed=speed)
        np.testing.assert_allclose(computed[:-2], rhs_of(steady, y[-2] / speed, y[:-2]), rtol=1e-7, atol=1e-7)


def test_object_arrays_serve_as_well_as_numbers():
    """Symbols come as object arrays; here the symbols are plain numbers."""

    class Namespace:
        sin = staticmethod(np.frompyfunc(math.sin, 1, 1))
        cos = staticmethod(np.frompyfunc(math.cos, 1, 1))

    equations = assemble(coupled_scene())
    y = np.linspace(-1, 2, 14)
    symbolic = equations.rhs(Namespace, 0.7, y.astype(object), equations.acting)
    assert symbolic.dtype == object
    np.testing.assert_allclose(symbolic.astype(float), equations.rhs(np, 0.7, y, equations.acting), rtol=1e-12)


@pytest.mark.parametrize("rotor", [STEADY, GUIDED, DRIVEN], ids=lambda rotor: type(rotor).__name__)
@pytest.mark.parametrize("support", SUPPORTS)
def test_turn_and_speed_of_a_state(support, rotor):
    """What carries the rotor adds its own."""
    scene = scene_on(support)
    p = replace(assemble(scene).parameters, rotor=rotor)
    y = np.arange(2 * p.size + 2 * p.balls + 2) / 7.0
    motion = motion_of(np, 0.7, y, p)
    turn, speed = (0.7 * scene.speed, scene.speed) if rotor is STEADY else (y[-2], y[-1])
    carried = (y[0], y[1]) if support == "swing arm" else (0.0, 0.0)
    assert (motion.turn, motion.speed) == pytest.approx((turn + carried[0], speed + carried[1]))
    assert motion.own_speed == pytest.approx(speed)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 7])
def test_a_solution_solves_fractions_as_well_as_numbers(size: int) -> None:
    """Exactly for one and two unknowns, beyond that to the rounding of its zeros."""
    root = [[Fraction((3 * i + 5 * j) % 7 + (i == j) * 9, 4) for j in range(size)] for i in range(size)]
    matrix = [[sum(root[k][i] * root[k][j] for k in range(size)) for j in range(size)] for i in range(size)]
    right = [Fraction(k + 1, 3) for k in range(size)]
    x = solve(matrix, right)
    left = [sum(a * b for a, b in zip(row, x, strict=True)) for row in matrix]
    assert left == (right if size <= 2 else pytest.approx([float(value) for value in right], rel=1e-12))


def test_complex_numbers_are_solved_alike() -> None:
    rng = np.random.default_rng(1)
    matrix = rng.random((5, 5)) + 1j * rng.random((5, 5)) + 9 * np.eye(5)
    right = rng.random(5) - 1j * rng.random(5)
    np.testing.assert_allclose(solve(matrix.tolist(), right.tolist()), np.linalg.solve(matrix, right), rtol=1e-12)


@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("support", SUPPORTS)
def test_unit_forces_along_the_race_answer_like_forces_put_in(support: str, rotor: str) -> None:
    """Accelerations are linear in forces: the answer to one is the difference that it makes."""
    equations = assemble(scene_on(support, *ROTORS[rotor]))
    y, p = np.array(equations.initial) + 0.05, equations.parameters

    def balls(pull: np.ndarray | None) -> np.ndarray:
        motion, levers, loads = prepared(np, 0.3, y, equations.acting)
        if pull is not None:
            loads.add(pull=pull)
        return solve_all(motion, levers, loads, p).balls

    answers, _ = by_pulls(*prepared(np, 0.3, y, equations.acting), p)
    for k, unit in enumerate(np.eye(5)):
        np.testing.assert_allclose(answers[:, k], balls(unit) - balls(None), rtol=1e-9, atol=1e-11)
    assert np.all(np.diag(answers) > 0)
