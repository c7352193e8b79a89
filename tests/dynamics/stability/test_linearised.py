"""Small motion about balanced balls: neutral directions, free decay, and limits that are known by hand."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.stability.linearised import BalancedMotion, diagonal, growth_of, span_of
from abu_calc.dynamics.supports.planar import planar
from tests.dynamics.scenes import dimensionless

HALF = math.acos(-0.01 / (2 * 0.05))
PAIR = BalancedMotion(dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0), (HALF, -HALF))


def test_published_growth_of_two_balls() -> None:
    """Green, Champneys & Lieven 2006: the slowest of the four pairs has Re λ = −0.004087."""
    assert PAIR.isotropic and PAIR.neutral == 0
    values = PAIR.eigenvalues(2.0)
    assert values is not None and len(values) == PAIR.states == 8
    assert PAIR.growth(2.0) == pytest.approx(-0.004087, abs=6e-7)
    assert PAIR.growing(2.0, -0.0045) == 2 and PAIR.growing(2.0, 0.0) == 0


def test_multipliers_of_a_revolution_are_exponentials_of_the_eigenvalues() -> None:
    assert growth_of(PAIR.multipliers(2.0), 2.0) == pytest.approx(PAIR.growth(2.0), rel=1e-6)
    assert growth_of((), 2.0) == growth_of((0j,), 2.0) == -math.inf
    assert growth_of((math.e + 0j,), 2 * math.pi) == pytest.approx(1.0)


def test_balls_beyond_two_are_free_and_decay_by_drag_alone() -> None:
    """−h₀/J for each of n − 2; a fourth of balls in one place cannot be told from them."""
    scene = dimensionless(2.0, 0.02, 0.0, 0.1, 0.07, (0.0,) * 4, 10.0, inertia_factor=1.4)
    cross = BalancedMotion(scene, tuple(k * math.pi / 2 for k in range(4)))
    values = cross.eigenvalues(2.0)
    assert values is not None and cross.neutral == 2
    assert sum(abs(value + 0.07 / 1.4) < 1e-12 for value in values) >= 2
    assert cross.on_one_line is cross and not cross.in_one_place


def test_a_support_that_differs_along_x_and_y_has_no_eigenvalues() -> None:
    scene = replace(PAIR.scene, support=planar(1.0, (1.0, 1.3), (0.02, 0.02)))
    unlike = BalancedMotion(scene, PAIR.angles)
    assert not unlike.isotropic and unlike.eigenvalues(2.0) is None
    nearly = replace(PAIR.scene, support=planar(1.0, (1.0, 1.0 + 1e-7), (0.02, 0.02)))
    assert BalancedMotion(nearly, PAIR.angles).growth(2.0) == pytest.approx(PAIR.growth(2.0), rel=1e-4)


def test_rows_span_as_many_directions_as_are_independent() -> None:
    rows = np.array(((1.0, 2.0, 3.0), (2.0, 4.0, 6.0), (0.0, 1.0, 0.0)))
    span = span_of(rows, 1e-9)
    assert span.shape == (3, 2) and np.allclose(span.T @ span, np.eye(2))
    assert np.allclose(span @ span.T @ rows.T, rows.T)
    assert span_of(np.zeros((0, 3)), 1e-9).shape == (3, 0)


def test_blocks_stand_along_a_diagonal() -> None:
    a, b = np.array(((1.0, 2.0),)), np.array(((3.0,), (4.0,)))
    assert diagonal(a, b).tolist() == [[1, 2, 0], [0, 0, 3], [0, 0, 4]]
    assert diagonal().shape == (0, 0)
