"""The public module of units."""

import pytest

import abu_calc
from abu_calc import units
from abu_calc.foundation.errors import InputError


def test_it_is_public() -> None:
    assert abu_calc.units is units and "units" in abu_calc.__all__ and "units" in dir(abu_calc)
    assert units.from_si(units.to_si(5800, "rpm"), "rpm") == pytest.approx(5800)
    assert all(hasattr(units, name) for name in units.__all__)


def test_numbers_with_units() -> None:
    assert units.number("97 Hz", "speed_rpm") == 5820.0
    with pytest.raises(InputError, match="rpm, 1/min, r/min, Hz, rad/s"):
        units.number("97 kg", "speed_rpm")
    with pytest.raises(InputError, match="has no unit"):
        units.number("97 kg", "name")
