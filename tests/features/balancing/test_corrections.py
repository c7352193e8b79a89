"""Corrections as they are made: shares at places, limits, holes, stock weights."""

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.features.balancing.corrections import Making, correction, removed, total

SPREAD = st.lists(st.floats(0, 6.28), min_size=2, max_size=6).filter(lambda p: abs(math.sin(p[1] - p[0])) > 0.01)


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
