"""Bounds on hanging balls: closed forms, the balance of power by integration, and balls that hang or do not."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.stall import hanging_bounds
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.swing_arm import idle_arm
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.formulas.swing_arm import Arm
from tests.dynamics.scenes import dimensionless


def scene_of(
    speed: float = 2.2, share: float = 0.01, damping: float = 0.02, drag: float = 0.1, *,
    frequencies: tuple[float, float] = (1.0, 1.0), balls: int = 2, inertia_factor: float = 1.4,
) -> Scene:  # fmt: skip
    """1 kg with its balls, R_p = 1 m, the same damping ratio along x and y."""
    scene = dimensionless(speed, share / balls, 0.0, 0.0, drag, (0.0,) * balls, 100.0, inertia_factor=inertia_factor)
    (wx, wy) = frequencies
    return replace(scene, support=planar(1 - share, (wx**2, wy**2), (2 * damping * wx, 2 * damping * wy)))


@pytest.mark.parametrize("damping", [1e-4, 0.002, 0.05])
@pytest.mark.parametrize("speed", [1.05, 2.2, 9.0])
def test_equal_axes(damping: float, speed: float) -> None:
    """n·m·ω²/(2ζM(Ω − ω)), to the damping's own smallness: the greatest is a little off the resonance."""
    found = hanging_bounds(scene_of(speed, damping=damping))
    at_resonance = 0.01 / (2 * damping * (speed - 1))
    assert found.resonance >= at_resonance * (1 - 1e-12)
    assert found.resonance == pytest.approx(at_resonance, rel=0.02 if damping > 0.01 else 3e-4)
    assert found.damped == found.gravity == 0


def test_one_axis_alone_is_half() -> None:
    """By the higher resonance, axes far apart; and by the lower one where the higher is above the speed."""
    expected = 0.01 * 1.5**2 / (2 * 0.01 * (5 - 1.5)) / 2
    found = hanging_bounds(scene_of(5.0, damping=0.01, frequencies=(0.3, 1.5)))
    assert found.resonance == pytest.approx(expected, rel=0.01) and found.frequency == pytest.approx(1.5, rel=0.01)
    found = hanging_bounds(scene_of(1.2, damping=0.01, frequencies=(0.3, 1.5)))
    assert found.frequency == pytest.approx(0.3, rel=0.02)


def test_balls_in_contact_pull_less() -> None:
    """σ = sin(nβ)/(n sin β), squared."""
    free, touching = (hanging_bounds(scene_of(balls=4), beta).resonance for beta in (0.0, 0.2))
    assert touching / free == pytest.approx((math.sin(0.8) / (4 * math.sin(0.2))) ** 2, rel=1e-12)


def test_soft_heavily_damped_springs() -> None:
    """2ζω√(N J/2) for ζ from 0.3 on; at 2.5 Hz, ζ 0.5 and N 0.0055 about 1 1/s."""
    w = 2 * math.pi * 2.5
    scene = scene_of(600.0, 0.0055, 0.5, 15.0, frequencies=(w, w))
    assert hanging_bounds(scene).damped == pytest.approx(w * math.sqrt(0.0055 * 1.4 / 2), rel=1e-9)
    assert 0.9 < hanging_bounds(scene).largest < 1.1
    assert hanging_bounds(scene_of(600.0, 0.0055, 0.29, 15.0, frequencies=(w, w))).damped == 0


def test_weight_holds_balls_below() -> None:
    scene = scene_of(600.0, frequencies=(15.0, 15.0))
    assert hanging_bounds(scene, horizontal=True).gravity == pytest.approx(9.80665 / 600.0)
    assert hanging_bounds(scene).gravity == 0


def test_the_worst_speed_of_a_range_is_the_lowest_here() -> None:
    scene = scene_of(3.0)
    assert hanging_bounds(scene, 0.0, (2.2, 9.0)) == hanging_bounds(scene_of(2.2))


def test_nothing_to_hang_at() -> None:
    """Below all resonances; without damping no drag is enough; without balls there is no bound."""
    assert hanging_bounds(scene_of(0.5)).largest == 0 and not hanging_bounds(scene_of(0.5)).doubt()
    bare = hanging_bounds(scene_of(damping=0.0))
    assert bare.largest == math.inf and bare.doubt(1e9)
    race = scene_of().races[0]
    empty = replace(scene_of(), races=(replace(race, ball_masses=(), start_angles=(), start_speeds=()),))
    assert hanging_bounds(empty).largest == 0


def test_the_race_nearest_to_its_bound_is_told() -> None:
    """Two races of one plane brake as one; that with the smaller drag is told."""
    scene, race = scene_of(balls=4), scene_of(balls=2, share=0.005).races[0]
    split = replace(scene, races=(replace(race, drag=0.3), race))
    assert hanging_bounds(split).resonance == pytest.approx(hanging_bounds(scene).resonance, rel=1e-9)
    assert (
        hanging_bounds(split).drag == race.drag and hanging_bounds(split).doubt() and not hanging_bounds(split).doubt(1)
    )


def test_a_tilting_support_that_does_not_tilt_is_planar() -> None:
    """Race at the centre of mass between like bearings; its tilt has the higher frequency, so the peak counts whole."""
    support = tilting(0.99, 0.2, 0.1, (0.3, -0.3), ((0.5, 0.5), (0.5, 0.5)), ((0.02, 0.02), (0.02, 0.02)))
    scene = replace(scene_of(), support=support, start_position=(0.0,) * 4, start_velocity=(0.0,) * 4)
    assert hanging_bounds(scene).resonance == pytest.approx(hanging_bounds(scene_of()).resonance, rel=2e-3)


def test_an_arm_is_one_axis() -> None:
    """l²(J_O + n m l²) as the mass: one axis alone."""
    arm = idle_arm(Arm(2.0, 4 * 0.99, 1.0, 0.04))
    scene = replace(scene_of(), support=arm, start_position=(0.0,), start_velocity=(0.0,))
    expected = hanging_bounds(scene_of()).resonance / 2
    assert hanging_bounds(scene).resonance == pytest.approx(expected, rel=1e-6)


def motion(scene: Scene, speed_of_balls: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Full equations of one lump of all balls, own derivation; from the steady motion at that speed.

    M x'' + c x' + k x = n m R (γ'' sin γ + γ'² cos γ), J γ'' + h₀(γ' − Ω) = (x'' sin γ − y'' cos γ)/R.
    """
    race, k, c = scene.races[0], np.diag(scene.support.stiffness), np.diag(scene.support.damping)
    m, J, h0, W = sum(race.ball_masses), race.inertia_factor, race.drag, scene.speed
    M = scene.support.mass[0][0] + m

    def slope(_: float, z: np.ndarray) -> np.ndarray:
        place, rate, angle, turning = z[:2], z[2:4], z[4], z[5]
        e, across = np.array((math.cos(angle), math.sin(angle))), np.array((math.sin(angle), -math.cos(angle)))
        known = (m * turning**2 * e - c * rate - k * place) / M
        # x'' = known + (m/M) γ'' across: γ'' (J − m/M) = across·known − h₀(γ' − Ω), R = 1.
        spin = (across @ known - h0 * (turning - W)) / (J - m / M)
        return np.array((*rate, *(known + m / M * spin * across), turning, spin))

    v = speed_of_balls
    X = m * v**2 * np.array((1, -1j)) / (k - M * v**2 + 1j * c * v)
    run = solve_ivp(slope, (0, end), (*X.real, *(1j * v * X).real, 0.0, v), rtol=1e-8, atol=1e-10, dense_output=True)
    times = np.linspace(0.8 * end, end, 2001)
    return times, run.sol(times)


@pytest.mark.slow
@pytest.mark.parametrize("frequencies", [(1.0, 1.0), (0.6, 1.1)])
def test_the_bound_is_the_balance_of_power(frequencies: tuple[float, float]) -> None:
    """Balls driven round at ν: the mean torque on them, by the support's motion integrated in time."""
    scene = scene_of(damping=0.05, frequencies=frequencies)
    v = hanging_bounds(scene).frequency
    k, c = np.diag(scene.support.stiffness), np.diag(scene.support.damping)

    def slope(t: float, z: np.ndarray) -> np.ndarray:
        force = 0.01 * v**2 * np.array((np.cos(v * t), np.sin(v * t)))
        return np.concatenate([z[2:], force - (c * z[2:].T).T - (k * z[:2].T).T])

    start, turns = 400.0, 5
    end = start + turns * 2 * math.pi / v
    run = solve_ivp(slope, (0, end), np.zeros(4), rtol=1e-9, atol=1e-12, dense_output=True)
    times = np.linspace(start, end, 4001)[:-1]
    x, y = slope(times, run.sol(times))[2:]
    braking = -(x * np.sin(v * times) - y * np.cos(v * times)).mean()
    assert hanging_bounds(scene).resonance == pytest.approx(braking / (scene.speed - v), rel=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize(("share_of_bound", "hangs"), [(0.8, True), (1.05, False)])
def test_balls_hang_below_the_bound_and_not_above(share_of_bound: float, hangs: bool) -> None:
    """From the very state that the bound speaks of, or one next to it."""
    bound = hanging_bounds(scene_of()).resonance
    scene = scene_of(drag=share_of_bound * bound)
    # Where the support brakes as the drag pulls, on the way up to the resonance.
    grid = np.linspace(0.8, 0.999, 4000)
    lost = 2 * 0.04 * grid / ((1 - grid**2) ** 2 + (0.04 * grid) ** 2)
    braking = 0.01 * grid**4 * lost / 2
    held = np.flatnonzero(braking >= scene.races[0].drag * (2.2 - grid))
    _, found = motion(scene, float(grid[held[0]]) if hangs else 0.99, 400.0)
    turning = found[5].mean()
    # A lump alone cannot balance: what it dissipates keeps it a little behind.
    assert turning < 1.02 if hangs else 2.19 < turning < 2.2


def test_a_race_needs_no_balls_to_be_beside_one() -> None:
    """An empty race changes nothing."""
    scene = scene_of()
    beside = Race(0.5, (), 1.0, 1.4, (), ())
    assert hanging_bounds(replace(scene, races=(*scene.races, beside))) == hanging_bounds(scene)
