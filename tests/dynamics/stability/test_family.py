"""Arrangements that balance: moved on the constraint, by their likeness, and to their neighbours."""

import math

import numpy as np
import pytest

from abu_calc.dynamics.stability.family import Family, closed, largest, likeness, moved_to, neighbours

MASSES, ANGLES = np.array((1.0, 1.0, 0.8, 1.2)), np.array((0.3, 1.9, 3.4, 5.0))


def test_angles_are_moved_to_the_sum_that_is_wanted_and_no_further_than_needed() -> None:
    resultant = complex(MASSES @ np.exp(1j * ANGLES)) + 0.02 + 0.01j
    moved = moved_to(MASSES, ANGLES, resultant)
    assert moved is not None
    assert complex(MASSES @ np.exp(1j * moved)) == pytest.approx(resultant, abs=1e-12)
    assert np.abs(moved - ANGLES).max() < 0.03
    assert moved_to(MASSES, ANGLES, 4.5) is None  # all four together carry 4


@pytest.mark.parametrize("chi", [0.0, 0.4, 1.0])
def test_equal_balls_with_room_have_every_likeness(chi: float) -> None:
    """Four equal balls that balance nothing: from a cross, χ = 0, to two pairs on one line, χ = 1."""
    family = Family.of((1.0,) * 4, (0.0, math.pi / 2, math.pi, 1.5 * math.pi), 0.0)
    angles = family.nearest(chi)
    assert likeness((1.0,) * 4, angles.tolist()) == pytest.approx(chi, abs=1e-6)
    assert abs(np.exp(1j * angles).sum()) < 1e-9
    assert np.all(np.diff(family.chi) >= 0) and len(family.rows) == len(family.chi)


def test_neighbours_balance_as_well_each_a_step_away() -> None:
    """Four balls have two free directions, each both ways."""
    resultant = complex(MASSES @ np.exp(1j * ANGLES))
    races = [(MASSES, resultant, 0.1)]
    around = list(neighbours(races, ANGLES, 1e-3))
    assert len(around) == 4
    for angles in around:
        assert complex(MASSES @ np.exp(1j * angles)) == pytest.approx(resultant, abs=1e-12)
        assert np.linalg.norm(angles - ANGLES) == pytest.approx(1e-3, rel=1e-2)
    assert closed([(MASSES, resultant, 1.7)], ANGLES) is None  # balls of this size overlap


@pytest.mark.parametrize("place", [0.0, 0.21, 0.5, 0.83, 1.0])
def test_the_largest_value_is_found_at_the_ends_too(place: float) -> None:
    assert largest(lambda x: -abs(x - place), (0.0, 0.5, 1.0), 40) == pytest.approx(place, abs=1e-8)
    assert largest(lambda x: -abs(x - place), (0.7,), 40) == 0.7
