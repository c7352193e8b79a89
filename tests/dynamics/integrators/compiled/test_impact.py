"""Impacts of balls in a row, as Newton's cradle has them, and pairs that press without holding."""

from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled.arrays import Pairs
from abu_calc.dynamics.integrators.compiled.impact import evened, passed, squeezed

CHAIN = np.array(((2.0, -1.0, 0.0), (-1.0, 2.0, -1.0), (0.0, -1.0, 2.0)))
"""What unit torques between four equal balls in a row do to the three gaps: each ball of inertia 1."""


def touching(speed: np.ndarray, near: np.ndarray) -> Pairs:
    """The first gaps of the row, which open at these speeds."""
    n = len(speed)
    rows: Any = (CHAIN[:n, :n].ravel().copy(), near, speed, np.zeros(n), np.zeros(n * n), np.zeros(n, dtype=int))
    return Pairs(n, *rows)


def after(speeds: list[float], restitution: float, slow: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Speeds of the gaps after all impacts, and the impulses."""
    n, speed, total = len(speeds), np.array(speeds), np.zeros(len(speeds))
    assert passed(touching(speed, np.zeros(n)), 1e-12, restitution, np.full(n, slow), total)  # type: ignore[arg-type]
    return speed, total


def test_in_newtons_cradle_the_last_ball_leaves() -> None:
    """The first comes with speed 1: gaps close by −1, 0, 0; at the end only the last one opens."""
    speed, total = after([-1.0, 0.0, 0.0], 1.0)
    np.testing.assert_allclose(speed, (0, 0, 1), atol=1e-12)
    np.testing.assert_allclose(total, (1, 1, 1), atol=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.8, 1.0])
@pytest.mark.parametrize("speeds", [[-1.0, -0.5, -2.0], [-1.0, 3.0, -1.0], [-0.2, 0.0, 0.1], [-1.0], [1.0, 2.0]])
def test_impacts_part_what_meets_push_only_and_take_energy(speeds: list[float], restitution: float) -> None:
    """The impulses explain all changes; balls of speeds v have Σ v² with gaps of speeds Cv."""
    speed, total = after(speeds, restitution, 1e-6)
    n = len(speeds)
    np.testing.assert_allclose(speed - speeds, CHAIN[:n, :n] @ total, atol=1e-9)
    assert speed.min() > -2e-6 and total.min() >= 0
    inverse = np.linalg.inv(CHAIN[:n, :n])
    assert speed @ inverse @ speed <= np.array(speeds) @ inverse @ speeds + 1e-12
    if restitution == 1.0:
        assert speed @ inverse @ speed == pytest.approx(np.array(speeds) @ inverse @ speeds, rel=1e-5)


@pytest.mark.parametrize("seed", range(6))
def test_touching_pairs_press_and_never_hold(seed: int) -> None:
    """Torque or parting: no torque is negative, no gap closes, and where there is one there is not the other."""
    closes = np.random.default_rng(seed).uniform(-1, 1, 3)
    speed, torque = np.zeros(3), np.zeros(3)
    squeezed(touching(speed, np.zeros(3)), closes, torque)  # type: ignore[arg-type]
    gaps = closes + CHAIN @ torque
    assert torque.min() >= 0 and gaps.min() > -1e-12
    np.testing.assert_allclose(torque * gaps, 0, atol=1e-12)


def test_pairs_that_are_near_to_it_get_equal_speeds() -> None:
    """Two of three: the third feels its neighbour's torque."""
    speed, total = np.array((-1.0, 0.3, 0.5)), np.zeros(3)
    evened(touching(speed, np.array((1.0, 1.0, 0.0))), total)  # type: ignore[arg-type]
    torque = np.linalg.solve(CHAIN[:2, :2], (1.0, -0.3))
    np.testing.assert_allclose(total, (*torque, 0.0), rtol=1e-12)
    np.testing.assert_allclose(speed, (0, 0, 0.5 - torque[1]), rtol=1e-12)
