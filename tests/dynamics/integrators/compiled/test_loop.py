"""The factor on the next step, and states that are numbers."""

import math

import pytest

from abu_calc.dynamics.integrators.compiled.dopri5 import METHOD_ORDER
from abu_calc.dynamics.integrators.compiled.loop import LEAST_FACTOR, MOST_FACTOR, SAFETY, finite, longer, shorter


@pytest.mark.parametrize("off", [1e-4, 0.3, 1.0, 5.0, 1e3])
def test_the_next_step_aims_at_a_share_of_what_is_allowed(off: float) -> None:
    """An error goes with h^p, so after the factor it is 0.9^p of what is allowed."""
    factor = shorter(off) if off > 1 else longer(off)
    assert off * factor**METHOD_ORDER == pytest.approx(SAFETY**METHOD_ORDER, rel=1e-12)
    assert factor < 1 or off < SAFETY**METHOD_ORDER


@pytest.mark.parametrize("off", [1e9, 1e11, math.inf, math.nan])
def test_no_step_shrinks_to_less_than_a_fifth_at_once(off: float) -> None:
    assert shorter(off) == LEAST_FACTOR == 0.2


@pytest.mark.parametrize("off", [0.0, 1e-12, 1e-8])
def test_no_step_grows_to_more_than_ten_times_at_once(off: float) -> None:
    assert longer(off) == MOST_FACTOR == 10.0


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_state_that_is_no_number_is_seen_among_those_that_count(value: float) -> None:
    assert finite(3, [0.0, 1e308, -1e-308])
    assert not finite(3, [0.0, 1.0, value]) and finite(2, [0.0, 1.0, value])
