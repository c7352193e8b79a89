"""Stability on swing arms, tilting rotors, several races and further bodies, against second derivations.

The worst arrangement on an anisotropic support is searched: a case that a list missed, and others.
"""

import cmath
import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import abu_calc
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.equations.assemble import assemble, jacobian
from abu_calc.dynamics.equations.right_hand_side import rhs
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.boundaries import boundaries, crossings_of, growth_over
from abu_calc.dynamics.stability.family import Family, closed, likeness
from abu_calc.dynamics.stability.floquet import multipliers
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.resting import NotKnownError, Rest, resting_angles, resting_state
from abu_calc.dynamics.stability.two_modes import two_modes
from abu_calc.dynamics.stability.verdict import Search, critical_damping, judged, searched, stability
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.features.stability.disturbed import consequence
from abu_calc.simulation.subject import subject_of
from tests.cli.runner import abu
from tests.dynamics.scenes import coupled_scene, dimensionless, hand_support
from tests.studies.arrangements import arrangements, case_of, growth

ALIKE = ((21500.0, 21500.0), (21500.0, 21500.0))
PUBLISHED = ((21500.0, 15800.0), (21500.0, 15800.0))
DAMPING = ((5.0, 5.0), (5.0, 5.0))


def on(support: Support, races: tuple[Race, ...], **other: float) -> Scene:
    rest = (0.0,) * len(support.names)
    settings_ = {"speed": 400.0, "imbalance": 1e-5, "imbalance_angle": 0.3, "couple": 0.0, "couple_angle": 0.0} | other
    return Scene(name="s", support=support, races=races, duration=10.0, start_position=rest, start_velocity=rest,
                 **settings_)  # fmt: skip


def race(place: float = 0.0, balls: int = 2, drag: float = 20.0, mass: float = 0.003, factor: float = 1.4) -> Race:
    return Race(0.03, (mass,) * balls, drag, factor, (0.0,) * balls, (0.0,) * balls, place)


def rotor(*races: Race, stiffness=ALIKE, polar=0.00124, axial=False, **other: float) -> Scene:
    support = tilting(1.2, 0.0138, polar, (0.11, -0.15), stiffness, DAMPING, axial)
    return on(support, races, **{"couple": 2e-6, "couple_angle": 1.1} | other)


def arm(
    kappa: float = 0.1, ratio: float = 0.5, sigma: float = 0.0, races: tuple[Race, ...] = (), **other: float
) -> Scene:
    """κ = l·U/J, ω₀/Ω, σ = h/(κ ω₀) of Kovalenko 2010, (17)."""
    length, inertia, speed = 0.3, 0.45, 300.0
    natural = ratio * speed
    damping = 2 * inertia * sigma * kappa * natural / length**2
    support = SwingArmSupport(length, inertia, inertia * natural**2 / length**2, damping)
    return on(support, races or (race(balls=0),), **{"speed": speed, "imbalance": kappa * inertia / length} | other)


def place_of(scene: Scene, rest: Rest, t: float) -> np.ndarray:
    motion = np.array(rest.motion or (0.0,) * len(scene.support.names)) * cmath.exp(1j * scene.speed * t)
    return np.concatenate([motion.real, (1j * scene.speed * motion).real, rest.angles, np.zeros(len(rest.angles))])


def monodromy(scene: Scene) -> np.ndarray:
    """Multipliers by the variational equations of the whole state, in the inertial frame, by another integrator."""
    rest, equations = resting_state(scene), assemble(scene)
    size = len(equations.states)

    def slope(t: float, flat: np.ndarray) -> np.ndarray:
        return (jacobian(equations, t, place_of(scene, rest, t)) @ flat.reshape(size, size)).ravel()

    run = solve_ivp(slope, (0, scene.revolution), np.eye(size).ravel(), method="DOP853", rtol=1e-8, atol=1e-11)
    values = np.linalg.eigvals(run.y[:, -1].reshape(size, size))
    return values[np.argsort(-np.abs(values))]


def found_multipliers(scene: Scene) -> np.ndarray:
    found = stability(scene, 0.0, "fan")
    values = (
        np.exp(np.array(found.eigenvalues) * scene.revolution) if found.eigenvalues else np.array(found.multipliers)
    )
    return values[np.argsort(-np.abs(values))]


def without_neutral(values: np.ndarray, count: int) -> np.ndarray:
    """Multipliers without those of neutral directions, which are 1."""
    order = np.argsort(np.abs(values - 1))
    np.testing.assert_allclose(values[order[:count]], 1, atol=1e-4)  # double ones: the root of the integrator's error
    return values[order[count:]]


CASES = {
    "two races": (rotor(race(0.11), race(-0.15, drag=30.0)), 0),
    "three balls in one": (rotor(race(0.11, balls=3), race(-0.15)), 1),
    "three planes": (rotor(race(0.11), race(0.0, factor=1.5), race(-0.15, drag=5.0)), 2),
    "two races in a plane": (rotor(race(0.11), race(0.11, drag=5.0), race(-0.15)), 2),
    "bearings unlike": (rotor(race(0.11), race(-0.15, drag=30.0), stiffness=PUBLISHED, axial=True), 0),
    "race elsewhere": (rotor(race(0.11, balls=3), axial=True), 1),
    "odd coordinates": (replace(coupled_scene(), imbalance=0.1), 2),
    "further body": (on(hand_support(), (race(), race(drag=3.0)), speed=5.0), 2),
    "arm": (arm(0.001, 0.5, 1.0, (race(balls=3, mass=0.05),)), 1),
}


@pytest.mark.few(1)
@pytest.mark.parametrize("name", CASES)
@pytest.mark.slow
def test_multipliers_are_those_of_the_whole_motion(name: str) -> None:
    """Largest first; what has died out to a tenth is left to the integrators' errors."""
    scene, neutral = CASES[name]
    expected, found = without_neutral(monodromy(scene), neutral), found_multipliers(scene)
    assert len(found) == len(expected)
    sizes = np.sort(np.abs(expected))[::-1]
    large = sizes > 0.1
    np.testing.assert_allclose(np.abs(found)[large], sizes[large], atol=1e-5)
    assert np.abs(found[0]) == pytest.approx(sizes[0], abs=1e-6)


@pytest.mark.parametrize("name", CASES)
def test_the_state_judged_is_one_of_rest(name: str) -> None:
    """The equations themselves, at an odd moment: the support moves as told, no ball accelerates."""
    scene, _ = CASES[name]
    rest, t, N = resting_state(scene), 0.0123, len(scene.support.names)
    slope = rhs(np, t, place_of(scene, rest, t), assemble(scene).acting)
    motion = np.array(rest.motion or (0.0,) * N) * cmath.exp(1j * scene.speed * t)
    expected = np.concatenate([(1j * scene.speed * motion).real, (-(scene.speed**2) * motion).real])
    reach = scene.speed**2 * max(scene.imbalance, 1e-6)
    np.testing.assert_allclose(slope[: 2 * N], expected, atol=1e-9 * reach)
    # Of the second order in the tilt: along directions that change no sum more than two balls drift, ever so slowly.
    np.testing.assert_allclose(slope[2 * N :], 0, atol=1e-9 * scene.speed**2)


def tilting_pencil(scene: Scene, angles: tuple[float, ...]) -> np.ndarray:
    """Second derivation, by complex coordinates in the rotor: r, Θ of the axis, δ of the balls, D = d/dt + iΩ.

    (m + Σm) D²r + Σmz D²Θ + (forces of the bearings) = −Σ m R D²(i e^{iθ} δ), and
    (J_t + Σmz²) D²Θ + Σmz D²r − iJ_pΩ DΘ + … = −Σ z m R D²(i e^{iθ} δ), J δ'' + h₀ δ' = −Im(e^{−iθ} D²(r + zΘ))/R.
    """
    W, balls = scene.speed, [(one, m) for one in scene.races for m in one.ball_masses]
    m, mz, mzz = (sum(mass * one.plane_offset**k for one, mass in balls) for k in range(3))
    own, J_t = scene.support.mass[0][0], scene.support.mass[2][2]
    J_p = scene.support.gyroscopic[2][3]
    second = np.array([[own + m, mz], [mz, J_t + mzz]], dtype=complex)
    first = np.array(scene.support.damping)[::2, ::2] + np.diag([0, -1j * J_p * W])
    zeroth = np.array(scene.support.stiffness)[::2, ::2]
    # Along D: λ² → (λ + iΩ)², λ → λ + iΩ.
    rotating = (second, 2j * W * second + first, -(W**2) * second + 1j * W * first + zeroth)
    size = 4 + len(balls)
    matrices = [np.zeros((size, size)) for _ in range(3)]
    powers = (1, 2j * W, -(W**2))
    for total, part, power in zip(matrices, rotating, powers, strict=True):
        total[:4, :4] = np.kron(part.real, np.eye(2)) + np.kron(part.imag, [[0, -1], [1, 0]])
        for k, ((one, mass), theta) in enumerate(zip(balls, angles, strict=True), 4):
            lever = np.array([1, one.plane_offset])
            pull = mass * one.pitch_radius * 1j * cmath.exp(1j * theta) * power * lever
            total[:4, k] = np.stack([pull.real, pull.imag], axis=1).ravel()
            felt = cmath.exp(-1j * theta) * power * lever / one.pitch_radius
            total[k, :4] = np.stack([felt.imag, felt.real], axis=1).ravel()
    for k, (one, _) in enumerate(balls, 4):
        matrices[0][k, k] += one.inertia_factor
        matrices[1][k, k] += one.drag
    lower = np.linalg.solve(matrices[0], -np.hstack([matrices[2], matrices[1]]))
    return np.linalg.eigvals(np.vstack([np.hstack([np.zeros((size, size)), np.eye(size)]), lower]))


@pytest.mark.parametrize("polar", [0.00124, 0.02])
def test_tilting_rotor_against_a_second_derivation(polar: float) -> None:
    scene = rotor(race(0.11, drag=7.0), race(-0.15, drag=30.0, factor=1.5), polar=polar)
    found = stability(scene)
    expected = tilting_pencil(scene, found.angles)
    key = lambda v: (round(v.imag, 5), round(v.real, 5))  # noqa: E731
    np.testing.assert_allclose(sorted(found.eigenvalues, key=key), sorted(expected, key=key), atol=1e-6)
    assert found.state == "balanced" and found.multipliers is None


def test_a_disc_is_never_balanced_in_two_planes() -> None:
    """J_p > J_t: its conical motion has no critical speed to be above, so the couple is never balanced stably."""
    races = race(0.11), race(-0.15)
    assert [one.stable_above for one in boundaries(rotor(*races), 30.0, 4000.0)] == [True]
    disc = rotor(*races, polar=0.02)
    assert boundaries(disc, 30.0, 4000.0) == ()
    assert not any(stability(replace(disc, speed=speed)).stable for speed in (50.0, 400.0, 1500.0, 4000.0))


@settings(deadline=None, derandomize=True, max_examples=40)
@given(
    places=st.lists(st.sampled_from([-0.2, -0.1, 0.0, 0.15]), min_size=2, max_size=3, unique=True),
    imbalance=st.floats(0, 1e-4), couple=st.floats(-1e-5, 1e-5), angle=st.floats(-3, 3),
)  # fmt: skip
def test_force_and_couple_vanish(places: list[float], imbalance: float, couple: float, angle: float) -> None:
    races = tuple(race(place, balls=2 + k, mass=0.01) for k, place in enumerate(places))
    scene = rotor(*races, imbalance=imbalance, couple=couple, couple_angle=angle)
    rest = resting_state(scene)
    moments = [(m, one.plane_offset) for one in races for m in [one.ball_masses[0] * 0.03] * len(one.ball_masses)]
    unit = [(m * cmath.exp(1j * a), z) for (m, z), a in zip(moments, rest.angles, strict=True)]
    force = sum(v for v, _ in unit) + cmath.rect(imbalance, 0.3)
    moment = sum(z * v for v, z in unit) + cmath.rect(couple, angle)
    # What is a hundred-millionth of a ball's moment is left out of the polygon.
    assert abs(force) < 1e-8 * 3e-4 and abs(moment) < 1e-8 * 3e-4 and rest.motion == ()


@pytest.mark.slow
def test_one_race_and_its_plane() -> None:
    """An imbalance in the race's own plane is balanced exactly; elsewhere the race alone is held still."""
    scene = rotor(race(0.11), couple=1.1e-6, couple_angle=0.3)  # 1e-5 kg m at 0.11 m
    assert stability(scene).state == "balanced" and resting_state(scene).motion == ()
    elsewhere = rotor(race(0.11))
    x, y, tx, ty = resting_state(elsewhere).motion
    assert abs(x + 0.11 * tx) < 1e-6 * abs(x) and abs(y + 0.11 * ty) < 1e-6 * abs(y)
    assert stability(elsewhere).state == "race still"
    assert len(boundaries(elsewhere, 200.0, 400.0)) % 2 == 1
    unlike = stability(rotor(race(0.11), stiffness=PUBLISHED))
    assert unlike.stable is None and unlike.eigenvalues is None and "differs along x and y" in unlike.reason
    with pytest.raises(NotKnownError):
        boundaries(rotor(race(0.11), stiffness=PUBLISHED), 100.0, 200.0)


def test_a_plane_that_cannot_take_its_share() -> None:
    heavy = rotor(race(0.11), race(-0.15, mass=1e-5), imbalance=1e-4)
    assert resting_state(heavy) is None and stability(heavy).stable is False
    with pytest.raises(NotKnownError, match="share"):
        resting_state(rotor(race(0.11), race(0.0, balls=1), race(-0.15)))
    assert resting_state(rotor(race(balls=0))) is None


def mathieu(damping: float, strength: float, ratio: float) -> float:
    """ln|μ| over a period of x'' + 2ζω₀x' + ω₀²(1 + ε cos ωt) x = 0, ω₀ = ratio, ω = 1."""

    def matrices(t: np.ndarray) -> np.ndarray:
        found = np.zeros((len(t), 2, 2))
        found[:, 0, 1], found[:, 1, 1] = 1.0, -2 * damping * ratio
        found[:, 1, 0] = -(ratio**2) * (1 + strength * np.cos(t))
        return found

    return math.log(np.abs(multipliers(matrices, 2 * math.pi, np.eye(2))).max())


@pytest.mark.few(1)
@pytest.mark.parametrize(("ratio", "law"), [(0.5, lambda z: 4 * z), (1.0, lambda z: math.sqrt(8 * z))])
def test_tongues_of_the_damped_mathieu_equation(ratio: float, law) -> None:
    """ε = 4ζ at ω = 2ω₀ and √(8ζ) at ω₀, known to leading order; the second tongue leans, so its tip is sought."""
    damping = 0.002
    ratios = [ratio] if ratio == 0.5 else np.linspace(ratio * 0.99, ratio * 1.01, 41).tolist()
    critical = min(
        brentq(lambda e, r=r: mathieu(damping, e, r), 0.3 * law(damping), 3 * law(damping))
        for r in ratios
        if mathieu(damping, 3 * law(damping), r) > 0
    )
    assert critical == pytest.approx(law(damping), rel=0.03)


def test_growth_of_the_arm_alone() -> None:
    """At Ω = 2ω₀ and κ = 0.02 without damping: ± 0.005001 per radian (Floquet), κ/4 = 0.005 to leading order."""
    scene = arm(0.02)
    found = stability(scene)
    assert found.growth_rate / scene.speed == pytest.approx(0.005001, abs=5e-7)
    assert found.state == "arm alone" and not found.stable and found.eigenvalues is None
    one, other = (abs(value) for value in found.multipliers)
    assert one * other == pytest.approx(1, abs=1e-8)


@pytest.mark.parametrize(("kappa", "derived"), [(0.05, 0.49867), (0.1, 0.49461), (0.2, 0.47687)])
def test_damping_that_parametric_resonance_needs(kappa: float, derived: float) -> None:
    """σ_c at ω₀/Ω = ½ exactly; the bound of (24), 1/2 with the second order, is that of the worst detuning."""
    critical = brentq(lambda sigma: stability(arm(kappa, sigma=sigma)).growth_rate, 0.3, 0.6, xtol=1e-8)
    assert critical == pytest.approx(derived, abs=1e-5)
    worst = arm(kappa, 0.5 - 13 * kappa**2 / 32)
    limit = critical_damping(worst)
    damped = replace(worst, support=replace(worst.support, damping=limit * 1.002))
    assert stability(damped).stable
    assert not stability(replace(worst, support=replace(worst.support, damping=limit * 0.99))).stable


@pytest.mark.parametrize("ratio", [1.0, 2.0])
@pytest.mark.parametrize("kappa", [0.1, 0.3])
def test_no_tongue_at_whole_ratios(kappa: float, ratio: float) -> None:
    """Kovalenko 2010 speaks of infinitely many unstable frequencies ω₀/i; of them none is."""
    for near in (0.99, 1.0, 1.01):
        assert abs(stability(arm(kappa, near * ratio)).growth_rate) < 1e-7


@pytest.mark.slow
def test_the_tongue_of_the_arm_is_found() -> None:
    """Its ends at |ω₀/Ω − ½| = (κ/4)√(1 − 4σ²), to leading order."""
    kappa, sigma, natural = 0.01, 0.2, 150.0
    scene = replace(arm(kappa, natural / 300, sigma), speed=500.0)
    low, high = boundaries(scene, 30.0, 3000.0)
    assert (low.stable_above, high.stable_above) == (False, True)
    half = kappa / 4 * math.sqrt(1 - 4 * sigma**2)
    assert natural / low.speed - 0.5 == pytest.approx(half, rel=0.02)
    assert 0.5 - natural / high.speed == pytest.approx(half, rel=0.02)


def test_arm_with_balls_against_the_printed_equations() -> None:
    """Kovalenko 2010, (1) and (2), linearised by hand about balls that balance; points, as printed.

    m R (δ'' + φ'' + h δ') + m l φ'' cos ψ = 0, and J φ'' + b l² φ' + c l² φ + Σ m R [(R + l cos ψ) δ'' − 2lΩ sin ψ δ'
    − l Ω² cos ψ δ] = 0, with J = J_O + Σ m (l² + R²).
    """
    scene = arm(0.001, 0.5, 2.0, (race(balls=2, mass=0.06, factor=1.0),))
    held, one, W = scene.support, scene.races[0], scene.speed
    found, m, R, l = stability(scene), one.ball_masses[0], one.pitch_radius, held.length  # noqa: E741
    inertia = held.inertia + 2 * m * (l**2 + R**2)

    def slope(t: float, flat: np.ndarray) -> np.ndarray:
        psi = W * t + np.array(found.angles)
        M, C, K = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((3, 3))
        M[0] = inertia, *(m * R * (R + l * np.cos(psi)))
        M[1:, 0], M[1:, 1:] = m * R * (R + l * np.cos(psi)), m * R**2 * np.eye(2)
        C[0] = held.damping * l**2, *(-2 * m * R * l * W * np.sin(psi))
        C[1:, 1:] = m * R**2 * one.drag * np.eye(2)
        K[0] = held.stiffness * l**2, *(-m * R * l * W**2 * np.cos(psi))
        A = np.block([[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
        return (A @ flat.reshape(6, 6)).ravel()

    run = solve_ivp(slope, (0, scene.revolution), np.eye(6).ravel(), method="DOP853", rtol=1e-10, atol=1e-12)
    expected = np.linalg.eigvals(run.y[:, -1].reshape(6, 6))
    np.testing.assert_allclose(np.sort(np.abs(found.multipliers)), np.sort(np.abs(expected)), atol=1e-7)


def published_arm(ratio: float) -> Scene:
    """l = 0.3 m, J_O = 0.45, 10 g at 30 mm, 400 g·mm, h/m = 10 1/s, joint damping ratio 0.1, Ω = 300 rad/s."""
    natural = 300.0 / ratio
    held = SwingArmSupport(0.3, 0.45, 0.45 * natural**2 / 0.09, 2 * 0.45 * 0.1 * natural / 0.09)
    return on(held, (race(mass=0.01, drag=10.0, factor=1.0),), speed=300.0, imbalance=4e-4, imbalance_angle=0.0)


@pytest.mark.slow
def test_where_balls_balance_an_arm() -> None:
    """Full motion: balls at ± 131.8° at Ω/ω₀ = 5 and 2, merged on the heavy side at 0.75 and 0.5."""
    for ratio, balances in ((5, True), (2, True), (0.75, False), (0.5, False)):
        found = stability(published_arm(ratio))
        assert found.state == "balanced" and found.stable is balances
        assert sorted(math.degrees(a) for a in found.angles) == pytest.approx([-131.81, 131.81], abs=0.01)
    (one,) = boundaries(published_arm(2), 20.0, 2000.0)
    assert one.stable_above and 150.0 < one.speed < 1.2 * 150.0


def test_balls_that_cannot_balance_an_arm() -> None:
    scene = replace(published_arm(2), imbalance=7e-4)
    found = stability(scene)
    assert (found.state, found.stable, found.angles) == ("arm alone", False, None)
    assert len(found.multipliers) == 2 and boundaries(scene, 20.0, 2000.0) == ()
    inertia = 0.45 + 0.02 * (0.09 + 0.0009)
    kappa = 0.3 * 7e-4 / inertia
    natural = math.sqrt(scene.support.stiffness * 0.09 / inertia)
    assert critical_damping(scene) == pytest.approx(7e-4 / 0.3 * natural * (1 + 17 * kappa**2 / 64), rel=1e-6)
    fallen = replace(scene, support=replace(scene.support, stiffness=-1.0))
    assert critical_damping(fallen) is None and critical_damping(rotor(race())) is None
    assert critical_damping(arm(0.4)) is None and not stability(replace(fallen, imbalance=4e-4)).stable


def test_effects_are_left_out_and_named() -> None:
    plain = rotor(race(0.11), race(-0.15))
    found = stability(replace(plain, effects=(RaceEccentricityEffect(1e-5), GravityEffect())))
    assert found.left_out == ("race_eccentricity", "gravity")
    assert found.eigenvalues == stability(plain).eigenvalues


@pytest.mark.slow
@pytest.mark.parametrize("low", [0.1, 10.0])
def test_work_is_bounded_at_any_speed(low: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Far below and far above the natural frequencies, soft and stiff: so many speeds, and few steps at each."""
    counted = []
    multipliers_of = BalancedMotion.multipliers
    monkeypatch.setattr(
        BalancedMotion, "multipliers", lambda motion, speed: counted.append(speed) or multipliers_of(motion, speed)
    )
    support = tilting(1.2, 0.0138, 0.00124, (0.11, -0.15), PUBLISHED, ((500.0, 500.0), (500.0, 500.0)))
    boundaries(on(support, (race(drag=1e4),)), low, 1000.0)
    assert len(counted) < 800


REFUTED = Path(__file__).parents[2] / "machines" / "stability-worst-arrangement.toml"


@pytest.fixture(scope="module")
def refuted() -> Scene:
    return subject_of(abu_calc.read_scene(REFUTED), command="stability").scene


@pytest.mark.slow
def test_the_arrangement_that_a_list_missed(refuted: Scene) -> None:
    """+2.534e-4 1/s and 2.7432 rad/s at the start angles of the file; the worst arrangement is worse than these."""
    start, worst = stability(refuted, 0.0, "start"), stability(refuted)
    assert start.growth_rate == pytest.approx(2.534e-4, rel=1e-3) and start.stable is False
    assert boundaries(refuted, 0.5, 6.0, 0.0, "start")[-1].speed == pytest.approx(2.7432, rel=2e-4)
    assert worst.stable is False and worst.growth_rate is not None and worst.growth_rate > 2.53e-4
    assert worst.angles is not None and likeness(refuted.ball_masses, worst.angles) == pytest.approx(0, abs=1e-9)
    (limit,) = boundaries(refuted, 0.5, 6.0)
    assert limit.stable_above and limit.speed == pytest.approx(2.96415, rel=1e-5)


@pytest.mark.slow
def test_the_growth_told_is_that_of_the_arrangement_told(refuted: Scene) -> None:
    worst = stability(refuted)
    assert worst.angles is not None
    total = sum(m * np.exp(1j * a) for m, a in zip(refuted.ball_masses, worst.angles, strict=True))
    assert abs(total + refuted.imbalance / refuted.races[0].pitch_radius) < 1e-9 * refuted.imbalance
    assert BalancedMotion(refuted, worst.angles).growth(refuted.speed) == pytest.approx(worst.growth_rate, rel=1e-6)
    ((_, rate),) = growth_over(refuted, [refuted.speed])
    assert rate == pytest.approx(worst.growth_rate, rel=1e-3)
    assert any(change.growing_below for change in crossings_of(refuted, 2.0, 4.0))


@pytest.mark.slow
def test_balls_drift_from_it_to_a_stable_neighbour(refuted: Scene) -> None:
    end = consequence(refuted, stability(refuted))
    assert end is not None and end.kind == "drift" and end.resting_angles is not None and end.growth_rate is not None
    assert end.growth_rate < 0 and end.residual_ratio is not None and end.residual_ratio < 1e-3
    assert BalancedMotion(refuted, end.resting_angles).growth(refuted.speed) == pytest.approx(end.growth_rate, rel=1e-6)
    stiff = replace(refuted, speed=3.5)
    assert consequence(stiff, stability(stiff)) is None


@pytest.mark.slow
def test_the_command_tells_the_worst_and_its_consequence() -> None:
    result = abu("stability", str(REFUTED), "--json").document["result"]
    assert result["stable"] is False and result["growth_rate_per_s"] > 2.53e-4
    assert result["consequence"]["kind"] == "drift"
    screen = " ".join(abu("stability", str(REFUTED)).out.split())
    assert "NOT STABLE" in screen and "the balls drift to a stable arrangement nearby" in screen
    other = abu("stability", str(REFUTED), "--arrangement", "start", "--json").document["result"]
    assert "consequence" not in other


@pytest.mark.parametrize(
    ("balls", "share", "gap", "least"),
    [(3, 0.5, 0.0, 0.25), (4, 1.2, 0.0, 0.0), (4, 1.2, 0.4, 0.0), (5, 3.0, 0.2, 0.0), (6, 4.5, 0.0, 0.125)],
)
def test_a_family_reaches_every_likeness(balls: int, share: float, gap: float, least: float) -> None:
    """Least χ by a general search (SLSQP) from twelve starts."""
    scene = dimensionless(2.0, 1e-3, 1e-3 * share, 0.1, 0.1, tuple(map(float, range(balls))), 100.0)
    fan = resting_angles(scene, gap / 2)
    assert fan is not None
    family = Family.of((1.0,) * balls, fan, gap)
    assert family.chi[0] == pytest.approx(least, abs=1e-6)
    for chi in np.linspace(family.chi[0], family.chi[-1], 7):
        angles = family.nearest(float(chi))
        assert abs(np.exp(1j * angles).sum() + share) < 1e-11
        assert likeness((1.0,) * balls, angles.tolist()) == pytest.approx(chi, abs=0.02)
        places = sorted(angles % (2 * math.pi))
        assert min(b - a for a, b in pairwise([*places, places[0] + 2 * math.pi])) >= gap - 1e-8


@pytest.mark.parametrize("seed", [1, 3, 8])
def test_likeness_alone_decides(seed: int) -> None:
    """For random arrangements, of unequal balls too: the equations of the study, all balls, and two modes agree."""
    case = case_of(seed)
    rows, scene = arrangements(case, 6), case.scene
    for speed in (1.2, 2.5):
        rates = growth(case, rows, speed) * speed
        for angles, rate in zip(rows, rates, strict=True):
            motion = BalancedMotion(scene, tuple(angles.tolist()))
            two = two_modes(motion)
            assert two is not None and not two.isotropic
            assert motion.growth(speed) == pytest.approx(rate, abs=1e-7)
            assert two.growth(speed) == pytest.approx(rate, abs=1e-7)


@pytest.mark.slow
def test_balls_of_several_races_are_moved() -> None:
    """No random arrangement is worse than the one found, but for the last steps of the search."""
    scene = case_of(7).scene
    (race,) = scene.races
    races = tuple(
        replace(
            race, ball_masses=(mass,) * count, start_angles=tuple(map(float, range(count))), start_speeds=(0.0,) * count
        )
        for mass, count in ((0.004, 4), (0.003, 3))
    )
    scene = replace(scene, races=races, imbalance=0.006, speed=1.5)
    listed = judged(scene)[1]
    search = searched(listed, 0.0)
    assert search is not None and not search.in_plane
    searched_growth = search.worst(1.5).growth(1.5)
    rng, rates = np.random.default_rng(0), []
    for _ in range(60):
        angles = closed(search.races, rng.uniform(0, 2 * math.pi, 7))
        if angles is not None:
            rates.append(BalancedMotion(scene, tuple(angles.tolist())).growth(1.5))
    assert searched_growth > max(motion.growth(1.5) for motion in listed) + 1e-3
    assert searched_growth > max(rates) - 1e-4


def test_isotropic_supports_keep_their_list() -> None:
    case = replace(case_of(1), stiffness=1.0, damping=(0.02, 0.02))
    listed = judged(case.scene)[1]
    assert len(listed) > 2 and searched(listed, 0.0) is None
    assert stability(case.scene).arrangements == len(listed)
    assert consequence(case.scene, stability(case.scene)) is None
    assert isinstance(searched(judged(case_of(1).scene)[1], 0.0), Search)
