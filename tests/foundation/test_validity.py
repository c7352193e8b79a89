"""A range holds what is inside it, and refuses all else with its bounds."""

import math

import pytest

from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.validity import Range


@pytest.mark.parametrize("open_low", [False, True])
@pytest.mark.parametrize("value", [-math.inf, 0.999, 1.0, 1.5, 2.0, 2.001, math.inf, math.nan])
def test_a_value_is_given_back_inside_and_refused_outside(value: float, open_low: bool) -> None:
    limit = Range("share", 1.0, 2.0, open_low=open_low)
    if 1.0 < value <= 2.0 or (value == 1.0 and not open_low):
        assert limit.check(value) == value
        return
    with pytest.raises(RangeError):
        limit.check(value)


def test_a_refusal_names_quantity_key_value_bounds_and_remedy() -> None:
    limit = Range("speed", 0, 3e5, "rpm", open_low=True, remedy="slower", key="machine.speed_rpm")
    with pytest.raises(RangeError) as refused:
        limit.check(4e5)
    error = refused.value
    assert (error.place.key, error.found, error.allowed) == ("machine.speed_rpm", "400000 rpm", "above 0 … 300000 rpm")
    assert "speed" in error.message and error.remedy == "slower"


def test_bounds_without_an_upper_end_are_said_so() -> None:
    assert str(Range("mass", 0, unit="kg", open_low=True)) == "above 0 kg"
    assert str(Range("mass", 0, unit="kg")) == "at least 0 kg"
    assert Range("mass", 0).check(math.inf) == math.inf
