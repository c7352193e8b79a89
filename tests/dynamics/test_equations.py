"""The right-hand side against a second derivation, and its symmetries."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.energy import energy, mass_matrix, power
from abu_calc.dynamics.equations import assemble
from abu_calc.dynamics.jacobian import jacobian
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import InputError
from tests.dynamics.scenes import coupled_scene, dimensionless

TURN = 2 * math.pi
states = st.lists(st.floats(-3, 3), min_size=14, max_size=14).map(np.array)
moments = st.floats(0, 10)
inertia_factors = st.sampled_from([1.0, 7 / 5, 3 / 2])


def rhs_of(scene: Scene, t: float, y: np.ndarray) -> np.ndarray:
    equations = assemble(scene)
    return equations.rhs(np, t, y, equations.parameters)


@settings(deadline=None, derandomize=True, max_examples=60)
@given(gamma=st.lists(st.floats(-10, 10), min_size=4, max_size=4), inertia_factor=inertia_factors)
def test_mass_matrix_is_symmetric_and_positive_definite(gamma, inertia_factor):
    matrix = mass_matrix(coupled_scene(inertia_factor), np.array(gamma))
    assert np.array_equal(matrix, matrix.T)
    assert np.linalg.eigvalsh(matrix).min() > 0


@settings(deadline=None, derandomize=True, max_examples=60)
@given(y=states, t=moments, inertia_factor=inertia_factors)
def test_rhs_is_the_lagrangian_system(y, t, inertia_factor):
    """Accelerations solved from the full mass matrix with its own forces; balls are not eliminated there."""
    scene = coupled_scene(inertia_factor)
    race, support = scene.race, scene.support
    q, velocity, theta, rate = y[:3], y[3:6], y[6:10], y[10:]
    gamma, swing = theta + scene.speed * t, rate + scene.speed
    masses, P = np.array(race.ball_masses), np.array(support.race_map)
    phase = scene.speed * t + scene.imbalance_angle
    centrifugal = [masses @ (swing**2 * f(gamma)) * race.pitch_radius for f in (np.cos, np.sin)]
    force = scene.imbalance * scene.speed**2 * np.array([math.cos(phase), math.sin(phase)]) + centrifugal
    on_support = P.T @ force - np.array(support.damping) @ velocity - np.array(support.stiffness) @ q
    on_balls = -masses * race.pitch_radius**2 * race.drag * rate
    accelerations = np.linalg.solve(mass_matrix(scene, gamma), np.concatenate([on_support, on_balls]))
    expected = np.concatenate([velocity, accelerations[:3], rate, accelerations[3:]])
    np.testing.assert_allclose(rhs_of(scene, t, y), expected, rtol=1e-10, atol=1e-10)


@settings(deadline=None, derandomize=True, max_examples=60)
@given(y=states, t=moments, inertia_factor=inertia_factors)
def test_energy_changes_by_the_power_alone(y, t, inertia_factor):
    scene = coupled_scene(inertia_factor)
    h = 1e-100
    rate = energy(scene, t + 1j * h, y + 1j * h * rhs_of(scene, t, y)).imag / h
    assert rate == pytest.approx(power(scene, t, y), rel=1e-10, abs=1e-9)


def test_without_drag_damping_and_imbalance_energy_is_kept():
    scene = coupled_scene(drag=0.0)
    support = replace(scene.support, damping=((0.0,) * 3,) * 3)
    scene = replace(scene, support=support, imbalance=0.0)
    y = np.linspace(-1, 2, 14)
    assert power(scene, 0.3, y) == 0.0
    assert energy(scene, 0.3 + 1e-100j, y + 1e-100j * rhs_of(scene, 0.3, y)).imag / 1e-100 == pytest.approx(
        0, abs=1e-10
    )


def rotation(angle: float) -> np.ndarray:
    return np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])


@settings(deadline=None, derandomize=True, max_examples=40)
@given(values=st.lists(st.floats(-2, 2), min_size=10, max_size=10), angle=st.floats(-3, 3), t=moments)
def test_isotropic_rotor_knows_no_direction(values, angle, t):
    scene = dimensionless(1.7, 0.05, 0.02, 0.1, 0.2, (0.0, 1.0, 2.0), 10.0, inertia_factor=1.4)
    turn = np.zeros((10, 10))
    turn[:2, :2] = turn[2:4, 2:4] = rotation(angle)
    turn[4:, 4:] = np.eye(6)
    y = np.array(values)
    moved = turn @ y + np.array([0] * 4 + [angle] * 3 + [0] * 3)
    np.testing.assert_allclose(
        rhs_of(replace(scene, imbalance_angle=angle), t, moved), turn @ rhs_of(scene, t, y), rtol=1e-10, atol=1e-10
    )


@settings(deadline=None, derandomize=True, max_examples=40)
@given(values=st.lists(st.floats(-2, 2), min_size=10, max_size=10), t=moments)
def test_mirror_case_turns_the_other_way(values, t):
    """y → −y with all angles and the sense of rotation reversed; a scene itself always turns from +x to +y."""
    scene = replace(
        dimensionless(1.7, 0.05, 0.02, 0.1, 0.2, (0.0, 1.0, 2.0), 10.0, stiffness=(1.0, 2.5)), imbalance_angle=0.3
    )
    equations = assemble(scene)
    p = equations.parameters
    mirrored = replace(p, speed=-p.speed, imbalance_phases=-0.3 - np.array([0, math.pi / 2]))
    sign = np.array([1, -1, 1, -1] + [-1] * 6)
    y = np.array(values)
    np.testing.assert_allclose(
        equations.rhs(np, t, sign * y, mirrored), sign * equations.rhs(np, t, y, p), rtol=1e-10, atol=1e-10
    )


@settings(deadline=None, derandomize=True, max_examples=30)
@given(y=states, order=st.permutations(range(4)))
def test_balls_have_no_order(y, order):
    scene = coupled_scene()
    masses = tuple(scene.race.ball_masses[k] for k in order)
    index = [*range(6), *(6 + k for k in order), *(10 + k for k in order)]
    moved = rhs_of(replace(scene, race=replace(scene.race, ball_masses=masses)), 0.7, y[index])
    np.testing.assert_allclose(moved, rhs_of(scene, 0.7, y)[index], rtol=1e-10, atol=1e-12)


def in_units(scene: Scene, length: float, mass: float, time: float) -> Scene:
    """The same scene told in other units: a number of it is multiplied by what the new unit is smaller."""

    def scaled(matrix, factor):
        return tuple(tuple(factor * value for value in row) for row in matrix)

    s, race = scene.support, scene.race
    return Scene(
        name=scene.name,
        support=replace(
            s,
            mass=scaled(s.mass, mass),
            damping=scaled(s.damping, mass / time),
            stiffness=scaled(s.stiffness, mass / time**2),
        ),
        speed=scene.speed / time,
        imbalance=scene.imbalance * mass * length,
        imbalance_angle=scene.imbalance_angle,
        race=replace(
            race,
            pitch_radius=race.pitch_radius * length,
            ball_masses=tuple(m * mass for m in race.ball_masses),
            drag=race.drag / time,
            start_speeds=tuple(v / time for v in race.start_speeds),
        ),
        duration=scene.duration * time,
        start_position=tuple(v * length for v in scene.start_position),
        start_velocity=tuple(v * length / time for v in scene.start_velocity),
    )


@pytest.mark.parametrize("imbalance", [0.3, 0.0])
def test_units_do_not_matter(imbalance):
    """Nor do the scales of the tolerance: they carry the same units, whatever they are taken from."""
    length, mass, time = 1000.0, 7.0, 60.0
    scene = replace(coupled_scene(), imbalance=imbalance)
    one, other = assemble(scene), assemble(in_units(scene, length, mass, time))
    units = np.array([length] * 3 + [length / time] * 3 + [1.0] * 4 + [1 / time] * 4)
    y = np.array(one.initial)
    np.testing.assert_allclose(other.initial, units * y, rtol=1e-12)
    np.testing.assert_allclose(other.scales, units * np.array(one.scales), rtol=1e-12)
    np.testing.assert_allclose(
        other.rhs(np, 0.7 * time, units * y, other.parameters),
        units / time * one.rhs(np, 0.7, y, one.parameters),
        rtol=1e-10,
    )


def test_object_arrays_serve_as_well_as_numbers():
    """Symbols come as object arrays; here the symbols are plain numbers."""

    class Namespace:
        sin = staticmethod(np.frompyfunc(math.sin, 1, 1))
        cos = staticmethod(np.frompyfunc(math.cos, 1, 1))

    equations = assemble(coupled_scene())
    y = np.linspace(-1, 2, 14)
    symbolic = equations.rhs(Namespace, 0.7, y.astype(object), equations.parameters)
    assert symbolic.dtype == object
    np.testing.assert_allclose(symbolic.astype(float), equations.rhs(np, 0.7, y, equations.parameters), rtol=1e-12)


def test_jacobian_is_the_limit_of_differences():
    equations = assemble(coupled_scene())
    y, h = np.linspace(-1, 2, 14), 1e-5
    exact = jacobian(equations, 0.7, y)
    for j in range(14):
        step = h * np.eye(14)[j]
        difference = (rhs_at(equations, y + step) - rhs_at(equations, y - step)) / (2 * h)
        # central differences: h² of the third derivative beside rounding/h
        np.testing.assert_allclose(exact[:, j], difference, rtol=1e-6, atol=1e-7)


def rhs_at(equations, y):
    return equations.rhs(np, 0.7, y, equations.parameters)


def rotating_frame_eigenvalues(scene: Scene, angles: tuple[float, float]) -> np.ndarray:
    """Eigenvalues about the balanced state; in the frame that turns with an isotropic rotor nothing depends on time.

    y = B(t) z with q = R(Ωt) q_r, so at t = 0: z' = B⁻¹ (∂rhs B − B') z.
    """
    skew = np.array([[0.0, -1.0], [1.0, 0.0]])
    B = np.eye(8)
    B[2:4, :2] = scene.speed * skew
    turning = np.zeros((8, 8))
    turning[:2, :2] = turning[2:4, 2:4] = scene.speed * skew
    balanced = np.array([0.0] * 4 + [*angles] + [0.0] * 2)
    equations = assemble(scene)
    np.testing.assert_allclose(rhs_of(scene, 0.0, balanced), 0, atol=1e-15)
    return np.linalg.eigvals(np.linalg.solve(B, jacobian(equations, 0.0, balanced) @ B - turning @ B))


def test_published_eigenvalues_of_two_balls():
    """(Ω, μ, δ, ζ, β) = (2, .05, .01, .01, .01), as in Green, Champneys & Lieven 2006."""
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)
    half = math.acos(-0.01 / (2 * 0.05))
    values = rotating_frame_eigenvalues(scene, (half, -half))
    upper = sorted(values[values.imag > 0], key=lambda s: s.imag)
    expected = [-0.004952 + 0.068382j, -0.004087 + 0.744047j, -0.011363 + 1.006468j, -0.009185 + 2.956028j]
    np.testing.assert_allclose(upper, expected, atol=6e-7, rtol=0)


@pytest.mark.parametrize(
    ("ball_mass", "boundaries"),
    [(0.01, [1.40154]), (0.03, [1.69396]), (0.05, [1.02969, 1.09363, 1.88224])],
)
def test_speeds_at_which_balance_is_lost_or_gained(ball_mass, boundaries):
    """Rodrigues et al. 2008, fig. 5a, δ = ζ = β = .01: stability changes within the last digit of each speed."""

    def stable(speed: float) -> bool:
        scene = dimensionless(speed, ball_mass, 0.01, 0.01, 0.01, (0.0, 1.0), 100.0)
        half = math.acos(-0.01 / (2 * ball_mass))
        return rotating_frame_eigenvalues(scene, (half, -half)).real.max() < 0

    for speed in boundaries:
        assert stable(speed - 1e-5) != stable(speed + 1e-5)
    assert stable(boundaries[-1] + 1e-5)


def test_support_that_is_no_mechanical_system_is_refused():
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)
    scene = replace(scene, support=replace(scene.support, mass=((1.0, 2.0), (2.0, 1.0))))
    with pytest.raises(InputError, match="positive definite"):
        assemble(scene)
