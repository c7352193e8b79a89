"""The worst arrangement on a swing arm, against random ones that balance, and its growth by the full equations."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import rhs
from abu_calc.dynamics.rotor import Acting
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.verdict import Search, decided, judged, searched, stability
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from tests.studies.arrangements import Case, arrangements, case_of

MISSED = 0.005


def on_arm(seed: int) -> tuple[Case, Scene]:
    """Balls of a scene of the study, on an arm of 2–12 pitch radii that alone swings at 1 rad/s; 0.8–3 rad/s."""
    case, rng = case_of(seed), np.random.default_rng(seed + 77)
    length = float(rng.uniform(2, 12))
    arm = SwingArmSupport(length, length**2, 1.0, case.damping[0])
    speed = float(np.exp(rng.uniform(math.log(0.8), math.log(3))))
    return case, replace(
        case.scene, support=arm, speed=speed, start_position=(0.0,), start_velocity=(0.0,), duration=4 * math.pi / speed
    )


def search_of(case: Case, scene: Scene) -> Search:
    """Of all arrangements of a scene."""
    found = searched(judged(scene, case.half_angle)[1], case.half_angle)
    assert found is not None
    return found


def growth(scene: Scene, angles: np.ndarray) -> float:
    """Of one arrangement."""
    return decided(BalancedMotion(scene, tuple(angles.tolist())), scene.speed)[1]


@pytest.mark.few(0, 1)
@pytest.mark.parametrize(
    "seed",
    [
        *(pytest.param(each, marks=pytest.mark.slow) for each in (8, 39)),
        *(pytest.param(each, marks=pytest.mark.hard) for each in (19, 33, 55, 59)),
    ],
)
def test_no_random_arrangement_grows_faster(seed: int) -> None:
    """200 of them for each of six arms; the arrangements that are listed alone missed faster growth on four."""
    case, scene = on_arm(seed)
    search, rows = search_of(case, scene), arrangements(case)
    assert len(rows) == 200
    most = max(growth(scene, row) for row in rows)
    found = search.growth(scene.speed)
    assert found >= most - MISSED * abs(most)
    judgement = stability(scene, case.half_angle)
    assert judgement.growth_rate == pytest.approx(found, rel=1e-9)
    assert judgement.angles is not None and judgement.arrangements > 200
    assert np.isclose(np.array(case.masses) @ np.exp(1j * np.array(judgement.angles)), -case.imbalance, atol=1e-12)


@pytest.mark.slow
def test_the_list_alone_misses_a_growing_arrangement() -> None:
    """Six balls, 2.55 times as fast as the arm swings: all that are listed die out, the one that is found grows."""
    case, scene = on_arm(39)
    assert max(growth(scene, np.array(one.angles)) for one in judged(scene, case.half_angle)[1]) < 0
    assert search_of(case, scene).growth(scene.speed) > 0
    assert stability(scene, case.half_angle).stable is False


@pytest.mark.parametrize("seed", [pytest.param(19, marks=pytest.mark.slow), pytest.param(55, marks=pytest.mark.hard)])
def test_growth_by_the_equations_themselves(seed: int) -> None:
    """ln|μ|/T of a revolution, by central differences of the full equations and Runge–Kutta's method."""
    case, scene = on_arm(seed)
    worst = search_of(case, scene).worst(scene.speed)
    equations = assemble(replace(scene, support=scene.support.without_steady_force()))
    acting = Acting(equations.parameters, equations.first_modes)
    rest = np.array([0.0, 0.0, *worst.angles, *(0.0 for _ in worst.angles)])
    scales = np.array(equations.scales)

    def matrix(t: float) -> np.ndarray:
        columns = []
        for unit in np.eye(len(rest)) * scales * 1e-4:
            ahead, behind = (np.asarray(rhs(np, t, rest + way * unit, acting), dtype=float) for way in (1, -1))
            columns.append((ahead - behind) / (2 * np.abs(unit).max()))
        return np.array(columns).T

    steps, period = 100, 2 * math.pi / scene.speed
    h, state = period / steps, np.eye(len(rest))
    for k in range(steps):
        first, middle, last = (matrix((k + share) * h) for share in (0.0, 0.5, 1.0))
        one = first @ state
        two = middle @ (state + h / 2 * one)
        three = middle @ (state + h / 2 * two)
        state = state + h / 6 * (one + 2 * two + 2 * three + last @ (state + h * three))
    largest = np.abs(np.linalg.eigvals(state)).max()
    assert math.log(largest) / period == pytest.approx(decided(worst, scene.speed)[1], rel=1e-3)
