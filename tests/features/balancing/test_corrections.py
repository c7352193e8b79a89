"""Corrections as they are made: shares at places, limits, holes, stock weights."""

import math
from itertools import combinations_with_replacement, pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from abu_calc.features.balancing.corrections import (
    Drill,
    Making,
    added,
    correction,
    hole_depth,
    hole_mass,
    removed,
    total,
)

SPREAD = st.lists(st.floats(0, 6.28), min_size=2, max_size=6).filter(lambda p: abs(math.sin(p[1] - p[0])) > 0.01)


@pytest.mark.slow
@settings(max_examples=60, deadline=None, derandomize=True)
@given(st.floats(0.001, 1.0), st.floats(-7, 7), st.none() | st.floats(0, 1), st.none() | SPREAD)
def test_shares_take_away_the_heavy_spot(mass: float, angle: float, removable: float | None, places) -> None:
    shares = correction(mass, angle, Making(removable), places, 0.1)
    assert abs(total(shares) - mass * np.exp(1j * angle)) < 1e-9 * mass / 0.01
    assert all(share.mass > 0 and 0 <= share.angle < 2 * math.pi for share in shares) and 1 <= len(shares) <= 2
    if places is not None:
        assert all(any(abs(math.sin((share.angle - p) / 2)) < 1e-9 for p in places) for share in shares)
    elif removable is not None:
        assert removed(shares) <= removable


CIRCLE = st.integers(3, 12).map(lambda count: [math.tau * k / count for k in range(count)])
ANY = st.lists(st.floats(0, 6.28), min_size=3, max_size=8).filter(
    lambda p: min(abs(math.sin(b - a)) for a, b in pairwise(p)) > 0.05
)


@pytest.mark.slow
@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.floats(0.001, 1.0), st.floats(0, 6.28), CIRCLE | ANY, st.floats(0.15, 1.5))
def test_masses_with_a_cap_are_the_least_that_do_it(mass: float, angle: float, places: list[float], cap: float) -> None:
    """Held against a solver of linear programs: feasible if that says so, and no heavier."""
    shares = correction(mass, angle, Making(per_place=cap * mass), places, 0.1)
    assert max(share.mass for share in shares) <= cap * mass * (1 + 1e-6)
    off = abs(total(shares) - mass * np.exp(1j * angle)) / mass
    for signs in ((1.0,), (-1.0,), (1.0, -1.0)):  # remove, add, both
        ways = np.concatenate([sign * np.exp(1j * np.array(places)) for sign in signs])
        best = linprog(
            np.ones(len(ways)), A_eq=np.array([ways.real, ways.imag]), bounds=(0, cap * mass),
            b_eq=[mass * math.cos(angle), mass * math.sin(angle)],
        )  # fmt: skip
        if best.status == 0:
            assert off < 1e-6
            if signs == (1.0,) and added(shares) == 0:
                assert removed(shares) <= best.fun * (1 + 1e-4)
            break
    else:
        assert off > 1e-9


STOCK = (0.002, 0.005, 0.010)


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.floats(0.001, 0.2), st.floats(0, 6.28))
def test_weights_at_free_angles_take_all_away(mass: float, angle: float) -> None:
    shares = correction(mass, angle, Making(stock=STOCK), None, 0.1)
    assert abs(total(shares) - mass * np.exp(1j * angle)) < 1e-7 * mass
    for share in shares:
        assert share.action == "add" and sum(share.weights) == pytest.approx(share.mass)
        assert set(share.weights) <= set(STOCK)


@pytest.mark.parametrize("seed", range(12))
def test_weights_at_places_leave_no_more_than_any_three_do(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = sorted(rng.uniform(0, 6.28, 5))
    target = rng.uniform(0.004, 0.015) * np.exp(1j * rng.uniform(0, 6.28))
    shares = correction(abs(target), float(np.angle(target)), Making(stock=STOCK), places, 0.1)
    left = abs(total(shares) - target)
    pieces = [0j, *(-weight * np.exp(1j * place) for weight in STOCK for place in places)]
    best = min(abs(a + b + c - target) for a, b, c in combinations_with_replacement(pieces, 3))
    assert left <= best + 3 * 0.002 * abs(target) + 1e-12


@pytest.mark.parametrize(("radial", "point"), [(False, 180.0), (False, 118.0), (True, 180.0), (True, 118.0)])
def test_the_depth_of_a_hole_is_that_of_its_mass(radial: bool, point: float) -> None:
    """The volume summed slice by slice, each at its distance from the axis."""
    drill, radius, depth = Drill(0.012, 7200.0, radial, math.radians(point)), 0.08, 0.011
    tip = 0.006 / math.tan(math.radians(point / 2))
    slices = (np.arange(20000) + 0.5) / 20000 * depth
    half = np.where(slices < depth - tip, 0.006, 0.006 * (depth - slices) / tip if tip > 1e-12 else 0.006)
    moments = 7200.0 * math.pi * half**2 * ((1 - slices / radius) if radial else 1.0) * depth / 20000
    assert hole_mass(drill, depth, radius) == pytest.approx(float(np.sum(moments)), rel=1e-4)
    assert hole_depth(drill, hole_mass(drill, depth, radius), radius) == pytest.approx(depth, rel=1e-9)
    assert hole_depth(Drill(0.012, 7200.0, True), 10.0, radius) is None


def test_side_by_side_holes_are_few_and_equal() -> None:
    drill = Drill(0.010, 7850.0, most=0.012)
    shares = correction(0.030, 1.0, Making(drill=drill), None, 0.12)
    assert len(shares) == 5 and abs(total(shares) - 0.030 * np.exp(1j)) < 1e-12
    assert {round(share.mass, 12) for share in shares} == {round(shares[0].mass, 12)}
    assert all(share.depth < 0.012 for share in shares)


def test_stock_weights_keep_the_limit_of_a_place() -> None:
    shares = correction(0.010, 1.0, Making(per_place=0.005, stock=(0.001, 0.002, 0.005)), None, 0.1)
    assert shares and max(share.mass for share in shares) <= 0.005 * (1 + 1e-9)
    assert abs(total(shares) - 0.010 * np.exp(1j)) < 0.05 * 0.010
    assert correction(0.010, 1.0, Making(per_place=0.0005, stock=(0.001, 0.002)), None, 0.1) == ()


def test_a_radial_hole_ends_at_the_axis() -> None:
    """A hole of 2 mm through 100 mm of steel has 1.233 g at the radius: π/4·4·100·7.85e-3/2."""
    drill = Drill(0.002, 7850.0, radial=True)
    shares = correction(0.010, 1.0, Making(drill=drill), None, 0.1)
    assert len(shares) >= 9 and all(share.depth is not None and share.depth <= 0.1 for share in shares)
    assert max(share.mass for share in shares) <= 1.2331e-3
    assert abs(total(shares) - 0.010 * np.exp(1j)) < 1e-9
