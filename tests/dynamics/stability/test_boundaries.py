"""Stability of the balanced state against published values, a second derivation, and the full motion."""

import cmath
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.dynamics.equations.assemble import assemble, jacobian
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.boundaries import boundaries, crossings
from abu_calc.dynamics.stability.floquet import magnus, multipliers
from abu_calc.dynamics.stability.linearised import BalancedMotion, growth_of
from abu_calc.dynamics.stability.resting import resting_angles
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.dynamics.supports.planar import planar
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from tests.dynamics.scenes import dimensionless


def scene_of(
    speed: float = 2.0, ball_mass: float = 0.05, imbalance: float = 0.01, damping: float = 0.01, drag: float = 0.01,
    balls: int = 2, **other
) -> Scene:  # fmt: skip
    return dimensionless(speed, ball_mass, imbalance, damping, drag, (0.0,) * balls, 100.0, **other)


def pencil_eigenvalues(scene: Scene, angles: tuple[float, ...]) -> np.ndarray:
    """Second derivation, by complex coordinates in the rotor: w of the axis, δ of the balls, D = d/dt + iΩ.

    M w̄: (M + Σm) D²w + c D w + k w + Σ m R i e^{iθ}δ-terms = 0, ball: J δ'' + h₀ δ' + Im(e^{−iθ} D²w)/R = 0, where
    Σ m R D²(i e^{iθ} δ) is the force of the balls. As λ² M₂ + λ M₁ + M₀ on (Re w, Im w, δ).
    """
    race, mass = scene.races[0], scene.support.mass[0][0] + sum(scene.ball_masses)
    c, k, W, R = scene.support.damping[0][0], scene.support.stiffness[0][0], scene.speed, race.pitch_radius
    n = 2 + len(angles)
    second, first, zeroth = np.zeros((n, n)), np.zeros((n, n)), np.zeros((n, n))

    def put(column: int, row_pair: complex, into: np.ndarray) -> None:
        into[0, column] += row_pair.real
        into[1, column] += row_pair.imag

    for column, unit in ((0, 1.0 + 0j), (1, 1j)):
        put(column, mass * unit, second)
        put(column, (2j * W * mass + c) * unit, first)
        put(column, (-(W**2) * mass + 1j * W * c + k) * unit, zeroth)
        for ball, theta in enumerate(angles, 2):
            e = cmath.exp(-1j * theta) * unit / R
            second[ball, column] += e.imag
            first[ball, column] += (2j * W * e).imag
            zeroth[ball, column] += (-(W**2) * e).imag
    for ball, (theta, m) in enumerate(zip(angles, race.ball_masses, strict=True), 2):
        arm = m * R * 1j * cmath.exp(1j * theta)
        put(ball, arm, second)
        put(ball, 2j * W * arm, first)
        put(ball, -(W**2) * arm, zeroth)
        second[ball, ball] += race.inertia_factor
        first[ball, ball] += race.drag
    lower = np.linalg.solve(second, -np.hstack([zeroth, first]))
    return np.linalg.eigvals(np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), lower]))


def by_size(values) -> list[complex]:
    return sorted((complex(v) for v in values), key=lambda v: (round(v.imag, 9), round(v.real, 9)))


def test_published_eigenvalues() -> None:
    """(Ω, μ, δ, ζ, β) = (2, .05, .01, .01, .01), printed to six digits after the point."""
    found = stability(scene_of())
    upper = [v for v in found.eigenvalues if v.imag > 0]
    expected = [-0.004087 + 0.744047j, -0.004952 + 0.068382j, -0.009185 + 2.956028j, -0.011363 + 1.006468j]
    np.testing.assert_allclose(upper, expected, atol=6e-7, rtol=0)
    assert len(found.eigenvalues) == 8
    assert found.growth_rate == upper[0].real and found.stable and found.multipliers is None
    assert sorted(math.degrees(angle) for angle in found.angles) == pytest.approx([-95.739, 95.739], abs=1e-3)


@pytest.mark.parametrize(
    ("ball_mass", "published", "derived"),
    [
        (0.01, [1.4006], [1.40154]),
        (0.03, [1.6933], [1.69396]),
        (0.05, [1.0295, 1.0932, 1.8820], [1.02969, 1.09363, 1.88224]),
    ],
)
def test_speeds_at_which_stability_changes(ball_mass: float, published: list[float], derived: list[float]) -> None:
    """Rodrigues et al. 2008, fig. 5a, δ = ζ = β = .01; published values are read off the figure, hence ± 0.001."""
    scene = scene_of(ball_mass=ball_mass)
    found = boundaries(scene, 0.1, 20.0)
    speeds = [one.speed for one in found]
    assert speeds == pytest.approx(published, abs=1e-3)
    assert speeds == pytest.approx(derived, abs=1e-5)
    assert [one.stable_above for one in found] == [(len(found) - k) % 2 == 1 for k in range(len(found))]
    for speed in speeds:
        values = pencil_eigenvalues(replace(scene, speed=speed), resting_angles(scene))
        assert values.real.max() == pytest.approx(0, abs=1e-8)


@pytest.mark.parametrize("inertia_factor", [1.0, 1.4])
@pytest.mark.parametrize("balls", [2, 3, 4])
def test_eigenvalues_are_those_of_a_second_derivation(balls: int, inertia_factor: float) -> None:
    """There the n − 2 neutral directions are found as zeros."""
    scene = scene_of(1.7, 0.03, 0.02, 0.05, 0.07, balls, inertia_factor=inertia_factor)
    found = stability(scene)
    expected = pencil_eigenvalues(scene, found.angles)
    neutral = sorted(expected, key=abs)[: balls - 2]
    np.testing.assert_allclose(neutral, 0, atol=1e-12)
    rest = sorted(expected, key=abs)[balls - 2 :]
    np.testing.assert_allclose(by_size(found.eigenvalues), by_size(rest), atol=1e-10)
    assert found.growth_rate == pytest.approx(max(v.real for v in rest), abs=1e-10)


def test_neutral_directions_do_not_count_without_drag_either() -> None:
    """Their own speeds count: balls without drag drift on along them for ever, and that is no stability."""
    found = stability(scene_of(3.0, 0.01, 0.02, 0.2, 0.0, 4))
    assert list(found.eigenvalues).count(0) == 2 and not found.stable
    assert len(found.eigenvalues) == 2 * (2 + 4) - 2


def test_multipliers_are_the_exponentials_of_eigenvalues() -> None:
    """Floquet theory on an isotropic support, where the answer is known."""
    scene = scene_of(1.5, 0.03, 0.02, 0.05, 0.07, 3)
    found, motion = stability(scene, 0.0, "fan"), BalancedMotion(scene, resting_angles(scene))
    expected = [cmath.exp(v * scene.revolution) for v in found.eigenvalues]
    multipliers = motion.multipliers(scene.speed)
    np.testing.assert_allclose(sorted(np.abs(multipliers)), sorted(abs(v) for v in expected), rtol=1e-7)
    assert min(abs(multipliers[0] - v) for v in expected) < 1e-8
    assert growth_of(multipliers, scene.speed) == pytest.approx(found.growth_rate, abs=1e-8)


@pytest.mark.parametrize("stiffness", [(1.0, 1.0), (1.0, 4.0)])
def test_multipliers_are_those_of_the_motion_itself(stiffness: tuple[float, float]) -> None:
    """The variational equations in the inertial frame, over a whole revolution, by another integrator."""
    from scipy.integrate import solve_ivp

    scene = scene_of(1.45, 0.05, 0.02, 0.05, 0.07, stiffness=stiffness)
    angles, equations = resting_angles(scene), assemble(scene)
    balanced = np.array([0.0] * 4 + [*angles] + [0.0] * 2)

    def slope(t: float, flat: np.ndarray) -> np.ndarray:
        return (jacobian(equations, t, balanced) @ flat.reshape(8, 8)).ravel()

    run = solve_ivp(slope, (0, scene.revolution), np.eye(8).ravel(), method="DOP853", rtol=1e-10, atol=1e-12)
    expected = np.linalg.eigvals(run.y[:, -1].reshape(8, 8))
    found = BalancedMotion(scene, angles).multipliers(scene.speed)
    np.testing.assert_allclose(by_size(found), by_size(expected), atol=1e-7)


@pytest.mark.slow
def test_nearly_isotropic_supports_are_nearly_the_same() -> None:
    one = [b.speed for b in boundaries(scene_of(), 0.9, 3.0)]
    other = boundaries(scene_of(stiffness=(1.0, 1.0 + 1e-6)), 0.9, 3.0)
    assert [b.speed for b in other] == pytest.approx(one, abs=1e-5)
    assert stability(scene_of(stiffness=(1.0, 1.0 + 1e-6))).multipliers is not None


@pytest.mark.slow
def test_between_the_natural_frequencies_of_an_anisotropic_support() -> None:
    """ω = 300 and 700 rad/s: published simulations balance at 460 and 1000, not at 200 and 620."""
    base = Scene(
        name="between", support=planar(5.0, (5 * 300.0**2, 5 * 700.0**2), (150.0, 350.0)), speed=460.0,
        imbalance=1e-4, imbalance_angle=0.3, races=(scene_of().races[0],), duration=1.0,
        start_position=(0.0, 0.0), start_velocity=(0.0, 0.0),
    )  # fmt: skip
    race = replace(base.races[0], pitch_radius=0.024, ball_masses=(0.004, 0.004), drag=30.0)
    base = replace(base, races=(race,))
    verdicts = {speed: stability(replace(base, speed=speed)).stable for speed in (200.0, 460.0, 620.0, 1000.0)}
    assert verdicts == {200.0: False, 460.0: True, 620.0: False, 1000.0: True}
    found = boundaries(base, 150.0, 1500.0)
    assert [one.stable_above for one in found] == [True, False, True]
    # Undamped light balls: √((300² + 700²)/2) = 538.5; damping and mass move it by a few per cent.
    assert found[1].speed == pytest.approx(538.5, rel=0.03)


def test_a_close_pair_is_not_missed() -> None:
    """At μ = 0.03398684 a gap of stability opens; these two speeds are 2.7e-8 apart, a little above 8.6e-5."""
    for ball_mass, gap in ((0.03398683951372733, 1e-6), (0.03398693951372733, 2e-4)):
        found = boundaries(scene_of(ball_mass=ball_mass), 0.5, 3.0)
        assert [one.stable_above for one in found] == [True, False, True]
        assert 0 < found[1].speed - found[0].speed < gap
    assert len(boundaries(scene_of(ball_mass=0.03398673951372733), 0.5, 3.0)) == 1


@settings(deadline=None, derandomize=True, max_examples=15)
@given(
    ball_mass=st.floats(0.005, 0.3),
    share=st.floats(0.05, 0.95),
    damping=st.floats(0.003, 0.3),
    drag=st.floats(0.003, 1.0),
    balls=st.integers(2, 4),
)
@pytest.mark.slow
def test_scanning_finds_no_change_that_was_missed(
    ball_mass: float, share: float, damping: float, drag: float, balls: int
) -> None:
    scene = scene_of(2.0, ball_mass, share * balls * ball_mass, damping, drag, balls)
    found = boundaries(scene, 0.3, 6.0, 0.0, "fan")
    motion = BalancedMotion(scene, resting_angles(scene))
    for low, high in pairwise([0.3, *(one.speed for one in found), 6.0]):
        inside = np.linspace(low, high, 22)[1:-1]
        signs = {motion.growth(speed) < 0 for speed in inside if motion.growth(speed) != 0}
        assert len(signs) <= 1, (low, high)


def test_every_boundary_is_among_the_crossings() -> None:
    scene = scene_of()
    motion = BalancedMotion(scene, resting_angles(scene))
    solutions = crossings(motion)
    for one in boundaries(scene, 0.1, 20.0):
        assert min(abs(one.speed - speed) for speed in solutions) < 1e-7


@pytest.mark.parametrize("factor", [0.98, 1.02])
@pytest.mark.slow
def test_the_full_motion_agrees_just_inside_and_outside(factor: float) -> None:
    """A small disturbance of the balanced state grows or dies at the rate found; ζ = .05, β = .1."""
    base = scene_of(2.0, 0.05, 0.03, 0.05, 0.1)
    speed = boundaries(base, 0.2, 20.0)[-1].speed * factor
    angles = resting_angles(base)
    start = (angles[0] + 1e-5, angles[1] - 0.5e-5)
    scene = replace(base, speed=speed, races=(replace(base.races[0], start_angles=start),))
    found = stability(scene)
    assert found.stable is (factor > 1)
    times = np.linspace(0.0, 300.0, 6001)
    states = scipy_.integrate(assemble(scene), 1e-11, times).y
    size = np.hypot(states[0], states[1])
    # The slowest mode alone is left by then: its crests 100 apart. It is small still: 1e-5 grows to some 1e-3.
    early, late = (size[(times > moment) & (times < moment + 30)].max() for moment in (150, 250))
    assert math.log(late / early) / 100 == pytest.approx(found.growth_rate, rel=0.05)


@settings(deadline=None, derandomize=True, max_examples=80)
@given(
    masses=st.lists(st.floats(0.01, 1.0), min_size=1, max_size=8),
    share=st.floats(0.0, 1.2),
    angle=st.floats(-3, 3),
)
def test_resting_balls_carry_the_imbalance(masses: list[float], share: float, angle: float) -> None:
    scene = scene_of(balls=len(masses))
    race = replace(scene.races[0], ball_masses=tuple(masses))
    scene = replace(scene, races=(race,), imbalance=share * sum(masses), imbalance_angle=angle)
    angles = resting_angles(scene)
    least = max(0.0, 2 * max(masses) - sum(masses))
    if angles is None:
        assert scene.imbalance > sum(masses) * (1 - 1e-9) or scene.imbalance < least * (1 + 1e-9)
        return
    assert least * (1 - 1e-9) <= scene.imbalance <= sum(masses) * (1 + 1e-9)
    total = cmath.rect(scene.imbalance, angle) + sum(cmath.rect(m, a) for m, a in zip(masses, angles, strict=True))
    assert abs(total) < 1e-9 * sum(masses)
    assert all(-math.pi <= a <= math.pi for a in angles)


def test_equal_balls_are_spread_evenly_about_the_light_side() -> None:
    scene = replace(scene_of(balls=5, imbalance=0.1), imbalance_angle=0.4)
    turned = np.sort((np.array(resting_angles(scene)) - 0.4) % (2 * math.pi))
    assert np.ptp(np.diff(turned)) < 1e-9 and turned.mean() == pytest.approx(math.pi)
    spacing = np.diff(turned)[0]
    assert resting_angles(scene, spacing / 2 - 1e-6) is not None
    assert resting_angles(scene, spacing / 2 + 1e-6) is None


@pytest.mark.parametrize(("balls", "imbalance"), [(2, 0.11), (1, 0.02), (0, 0.01)])
def test_without_a_balanced_state_nothing_is_stable(balls: int, imbalance: float) -> None:
    scene = scene_of(imbalance=imbalance, balls=balls)
    found = stability(scene)
    assert (found.angles, found.eigenvalues, found.growth_rate, found.stable) == (None, None, None, False)
    assert boundaries(scene, 0.1, 10.0) == ()


@pytest.mark.parametrize(
    ("balls", "imbalance", "stable"),
    [(2, 0.0, True), (3, 0.0, True), (2, 0.1, False), (1, 0.05, True), (0, 0.0, True)],
)
def test_edges_of_existence(balls: int, imbalance: float, stable: bool) -> None:
    """No imbalance, capacity exactly equal to need, no balls: a verdict, and no eigenvalue that is not finite.

    Two balls that just carry the imbalance are held by nothing of first order; that is not called stable.
    """
    found = stability(scene_of(3.0, 0.05, imbalance, 0.1, 0.1, balls))
    assert found.angles is not None and np.isfinite(found.eigenvalues).all()
    assert found.stable is stable, found


def test_one_direction_of_a_machine_is_as_good_as_another() -> None:
    scene = scene_of(1.3, 0.05, 0.02, 0.05, 0.07, stiffness=(1.0, 2.0))
    turned = replace(scene, imbalance_angle=1.0)
    swapped = scene_of(1.3, 0.05, 0.02, 0.05, 0.07, stiffness=(2.0, 1.0))
    for other in (turned, swapped):
        assert stability(other).growth_rate == pytest.approx(stability(scene).growth_rate, abs=1e-8)


def test_what_cannot_be_judged_is_refused() -> None:
    with pytest.raises(InputError, match="lowest speed"):
        boundaries(scene_of(), 0.0, 1.0)
    with pytest.raises(InputError, match="highest speed"):
        boundaries(scene_of(), 1.0, 1.0)
    with pytest.raises(NotTrustworthyError, match="cannot be judged"):
        multipliers(lambda t: np.full((len(t), 1, 1), 800.0), 1.0, np.eye(1))  # e^800 is no number


@pytest.mark.parametrize("rate", [-1.0, -250.0, -1e4])
def test_maps_of_known_systems(rate: float) -> None:
    """z' = (rate + cos t) z with a turning pair beside it, soft and stiff: known in closed form."""

    def matrices(t: np.ndarray) -> np.ndarray:
        found = np.zeros((len(t), 3, 3))
        found[:, 0, 0] = rate + np.cos(t)
        found[:, 1, 2], found[:, 2, 1] = -3.0, 3.0
        return found

    expected = np.zeros((3, 3))
    expected[0, 0] = math.exp(2 * rate + math.sin(2))
    expected[1:, 1:] = [[math.cos(6), -math.sin(6)], [math.sin(6), math.cos(6)]]
    assert magnus(matrices, 2.0, 64) == pytest.approx(expected, abs=1e-7)
