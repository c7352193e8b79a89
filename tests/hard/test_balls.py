"""Balls that start badly, are too many, too heavy or too weak, and a race that hardly lets them move."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.verdict import stability
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.simulate import simulate
from tests.hard.scenes import (
    CLAIM,
    check_agreement,
    check_claim,
    check_energy,
    jacobi,
    machine,
    resultant,
    run,
    standing,
)

pytestmark = pytest.mark.hard

W = 600.0
BALL = 0.008
"""Radius [m] of a ball that is rubbed or met."""


def response(scene: Scene, moment: float, balls: int) -> float:
    """|w| of the loaded support by an imbalance [kg m] that turns with the rotor."""
    mass = scene.support.mass[0][0] + balls * scene.ball_masses[0]
    k, c = scene.support.stiffness[0][0], scene.support.damping[0][0]
    return moment * scene.speed**2 / abs(k - mass * scene.speed**2 + 1j * c * scene.speed)


@pytest.mark.parametrize("coefficient", [1e-5, 1e-4, 1e-3, 1e-2, 1e-1])
def test_dry_friction_from_a_trace_to_a_brake(coefficient: float) -> None:
    """Balls end at rest, each with a speed of exactly 0, where |Im(w e^{−iθ})| ≤ f (R_p + Re(w e^{−iθ})).

    From f = 1e-2 on they stick from the start and never move; below they roll, and what they leave of the imbalance's
    whirl grows with f.
    """
    friction = DryRollingFrictionEffect(coefficient * BALL, BALL)
    scene = machine(W, (1.0, 2.5), 3.0 if coefficient < 1e-2 else 1.0, friction)
    found = check_claim(scene)
    y = found.trajectory.y[:, -1]
    w = complex(*y[:2]) * np.exp(-1j * W * scene.duration)
    seen = w * np.exp(-1j * y[4:6])
    assert (y[6:8] == 0).all()
    assert (np.abs(seen.imag) <= 1.001 * coefficient * (0.024 + seen.real)).all()
    if coefficient >= 1e-2:
        assert found.cost.events == 0
        assert y[4:6].tolist() == [1.0, 2.5]
    else:
        assert found.cost.events > 5
        assert abs(w) < 1.1 * coefficient * 0.024 / 0.25


def test_what_dry_friction_takes() -> None:
    """−Σ m f n R_p |θ'| beside dampers, drag and drive: the energy of balls that stick and roll is balanced."""
    check_energy(machine(W, (1.0, 2.5), 1.0, DryRollingFrictionEffect(1e-3 * BALL, BALL)), 0.0, 0.05, 1e-3)


@pytest.mark.parametrize("coefficient", [1e-5, 1e-3, 1e-2])
def test_a_chattering_start(coefficient: float) -> None:
    """The support is thrown and its free vibration shakes the balls loose, again and again: two integrators agree."""
    scene = machine(W, (1.0, 2.5), 0.5, DryRollingFrictionEffect(coefficient * BALL, BALL), damping_ratio=0.02)
    scene = replace(scene, start_position=(3e-4, -2e-4), start_velocity=(0.3, 0.0))
    motion = check_agreement(scene, 2e-3)
    assert motion.events > (10 if coefficient < 1e-2 else -1)
    check_claim(scene)


def test_without_drag_or_damping_the_integral_stays() -> None:
    """Seen from the rotor nothing depends on time: E − Ω L (Jacobi) keeps its value to the tolerance, while E does not.

    Two integrators go the same way for a hundred turns of balls that nothing settles.
    """
    scene = machine(W, (1.0, 2.5), 1.0, drag=0.0, damping_ratio=0.0)
    motion = check_agreement(scene, 1e-3, 21)
    integral = jacobi(scene, motion)
    assert np.ptp(integral) < 1e-10 * np.abs(integral).max()
    check_claim(replace(scene, duration=0.3))


def test_without_drag_balls_still_go_to_the_light_side() -> None:
    """Only the support is damped: nothing but its whirl takes energy from the balls, and hardly any of it.

    E changes by what dampers take and the drive gives.
    """
    scene = machine(W, (1.0, 2.5), 0.5, drag=0.0, damping_ratio=0.5)
    check_agreement(scene, 1e-3)
    check_energy(scene, 0.0, 0.05, 1e-5)
    growth = stability(scene).growth_rate
    assert growth is not None
    assert abs(growth) < 1.0


@pytest.mark.parametrize("drag", [1e5, 1e6, 1e7])
def test_enormous_drag_is_stiff(drag: float) -> None:
    """Radau is chosen; balls creep as h₀ θ' = (Ω²/R_p) Im(w e^{−iθ}), the averaged motion without its inertia.

    Integrated here, with w of the receptance. Start-up of the support moves the balls a little more: 1 % of the creep.
    """
    scene = machine(W, (1.0, 2.5), 1.0, drag=drag)
    assert choose(assemble(scene), "auto", 1e-4).name == "scipy-radau"
    end = run(scene, [1.0], "scipy-radau", 1e-7).y[4:6, -1]
    mass, k, c = 5.0 + 2 * 0.0167, 5.0 * 80**2, 2 * 0.1 * 5 * 80
    answer = W**2 / (k - mass * W**2 + 1j * c * W)

    def creep(_: float, theta: np.ndarray) -> np.ndarray:
        w = answer * resultant(scene, theta)
        return W**2 / 0.024 * (w * np.exp(-1j * theta)).imag / drag

    expected = solve_ivp(creep, (0, 1), (1.0, 2.5), rtol=1e-9, atol=1e-13).y[:, -1]
    np.testing.assert_allclose(end - (1.0, 2.5), expected - (1.0, 2.5), rtol=0.01)
    assert 1e-6 < np.abs(end - (1.0, 2.5)).max() < 0.02


def test_an_explicit_method_agrees_where_drag_is_enormous() -> None:
    """By a hundred times the work: DOP853 and Radau end at the same places."""
    scene = machine(W, (1.0, 2.5), 0.1, drag=1e5)
    times = np.linspace(0, 0.1, 11)
    explicit, implicit = run(scene, times, tolerance=1e-8), run(scene, times, "scipy-radau", 1e-8)
    # Places of balls in rad, of the axis in m₀e/M; rates of balls die within 1/h₀ and are left out.
    np.testing.assert_allclose(implicit.y[4:6], explicit.y[4:6], atol=1e-7)
    np.testing.assert_allclose(implicit.y[:2], explicit.y[:2], atol=1e-5 * 200e-6 / 5)


@pytest.mark.parametrize("count", [2, 3, 5, 10, 20])
def test_balls_from_exactly_one_place(count: int) -> None:
    """They are parted by a millionth and it is told; then they spread and balance, U + m R_p Σe^{iθ} = 0."""
    scene = machine(W, (1.0,) * count, 4.0, ball_mass=0.0334 / count)
    found = check_claim(scene)
    assert len(found.warnings) == 1
    assert "parted" in found.warnings[0]
    assert abs(resultant(scene, np.array(found.response.ball_angles))) < 1e-6 * scene.imbalance


@pytest.mark.parametrize("count", [2, 5, 20])
@pytest.mark.parametrize("friction", [0.0, 1e-4])
def test_packed_balls(count: int, friction: float) -> None:
    """Started touching in a row, above resonance: they spread, never nearer than 2β, and balance but for the friction.

    Of twenty balls eighteen angles are free, and remember some two hundred impacts, of which a loose tolerance does not
    see the faintest: there the accuracy asked for is kept, while two tolerances are nearer to each other than to it.
    """
    radius = 0.024 * math.sin(math.pi / count / 2)
    beta = math.asin(radius / 0.024)
    angles = tuple(1 + 2 * beta * (k - (count - 1) / 2) * (1 + 1e-9) for k in range(count))
    effects = [BallContactEffect(radius, 0.5)] + (
        [DryRollingFrictionEffect(friction * radius, radius)] if friction else []
    )
    scene = machine(W, angles, 2.0, *effects, ball_mass=0.0434 / count)
    found = check_claim(scene, claim=math.inf if count == 20 else CLAIM)
    balls = found.trajectory.y[4 : 4 + count]
    least = 2 * beta - found.cost.tolerance
    assert np.diff(balls, axis=0).min() > least
    assert (balls[0] + 2 * math.pi - balls[-1]).min() > least
    left = abs(resultant(scene, balls[:, -1])) / scene.imbalance
    assert left < (0.5 if friction else 1e-3)


def test_balls_that_overlap_or_fill_their_race() -> None:
    """Refused, with what is found and allowed, where balls have a size; points may stand as near as they like."""
    contact = BallContactEffect(BALL, 0.5)
    for angles in ((1.0, 1.1), (1.0, 1.0)):
        with pytest.raises(InputError, match=r"balls 1 and 2 overlap at the start \(found .*; allowed: at least 38.94"):
            simulate(machine(W, angles, 1.0, contact))
    with pytest.raises(InputError, match=r"fill their race.*\n?.*at most 9 balls"):
        simulate(machine(W, tuple(0.6 * k for k in range(10)), 1.0, contact))
    assert simulate(machine(W, (1.0, 1.1), 1.0), integrator="scipy").error_estimate <= 0.01


def test_zero_imbalance() -> None:
    """Two balls end opposite each other and the axis still; none at all leave nothing, no level, and finite numbers."""
    found = check_claim(machine(W, (1.0, 2.5), 4.0, imbalance=0.0)).response
    one, other = found.ball_angles
    assert math.remainder(one - other - math.pi, 2 * math.pi) == pytest.approx(0, abs=1e-6)
    assert found.axis_amplitude < 1e-9 * 0.024
    assert found.unbalanced_amplitude == 0
    nothing = simulate(machine(W, (), 1.0, imbalance=0.0), integrator="scipy").response
    assert (nothing.axis_amplitude, nothing.velocity_rms, nothing.level) == (0.0, 0.0, None)


def test_capacity_exactly_equal_to_need() -> None:
    """U = 2 m R_p: both at 180°, where the linear motion is neutral, so not called stable; they close in, ever slower.

    What remains shrinks from run to run, as the square of the distance from 180°.
    """
    scene = machine(W, (1.0, 2.5), 3.0, imbalance=2 * 0.0167 * 0.024)
    assert not stability(scene).stable
    distances, left = [], []
    for duration in (1.0, 3.0):
        found = check_claim(replace(scene, duration=duration)).response
        distances.append(max(abs(math.remainder(angle - math.pi, 2 * math.pi)) for angle in found.ball_angles))
        left.append(found.residual_imbalance / scene.imbalance)
    assert distances[1] < 0.8 * distances[0] < 0.2
    assert left[1] == pytest.approx(distances[1] ** 2 / 2, rel=0.2)


@pytest.mark.parametrize("need", [1.001, 1.5])
def test_too_little_capacity(need: float) -> None:
    """Both balls at the light side, |w| = (U − 2 m R_p) Ω²/|k − MΩ² + icΩ|; no state of rest, so no stability."""
    scene = machine(W, (1.0, 2.5), 3.0 if need > 1.1 else 6.0, imbalance=need * 2 * 0.0167 * 0.024)
    judged = stability(scene)
    assert (judged.stable, judged.angles) == (False, None)
    found = check_claim(scene).response
    expected = response(scene, scene.imbalance - scene.static_moment, 2)
    # Just short, the balls are still closing in.
    assert found.axis_amplitude == pytest.approx(expected, rel=1e-3 if need > 1.1 else 0.5)
    assert max(abs(math.remainder(angle - math.pi, 2 * math.pi)) for angle in found.ball_angles) < 0.03


@pytest.mark.parametrize("ball_mass", [0.5, 2.0, 10.0])
def test_balls_heavier_than_the_rotor(ball_mass: float) -> None:
    """Up to twenty times its mass: the linear motion says stable, and the simulation comes to rest balanced.

    The energy balance and two integrators hold where the reduced mass matrix is far from that of the rotor.
    """
    scene = machine(
        W, (1.0, 2.5), 2.0, mass=1.0, ball_mass=ball_mass, imbalance=ball_mass * 0.024, damping_ratio=0.3
    )  # fmt: skip
    assert stability(scene).stable
    found = check_claim(scene).response
    assert found.residual_imbalance < 2e-3 * scene.imbalance
    check_agreement(replace(scene, duration=0.2), 1e-3)
    check_energy(scene, 0.0, 0.02, 1e-4, 81)


def test_balls_at_rest_when_the_rotor_turns_at_full_speed() -> None:
    """The drag spins them up from γ' = 0 past the support's frequency; the drive pays for it; they balance."""
    scene = standing(machine(W, (1.0, 2.5), 2.0))
    found = check_claim(scene).response
    assert found.residual_imbalance < 1e-4 * scene.imbalance
    assert np.abs(found.final.ball_speeds).max() < 1e-4
    check_agreement(replace(scene, duration=0.3), 1e-3)
    check_energy(scene, 0.0, 0.06, 1e-5)
