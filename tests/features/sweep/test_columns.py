"""Columns of a sample: units by their names, flags that end in all together, and the drag of oil."""

import pytest

from abu_calc.features.sweep.batches import DECIDING, FLAGS, LEVEL, MEETS, QUANTITIES, QUIET, drag_ratio
from abu_calc.foundation.errors import InputError


def test_oil_has_the_viscosities_of_its_table_and_thins_with_warmth() -> None:
    """ISO VG 46: 46 mm²/s at 40 °C and 6.8 at 100 °C; some 68 at 31.5 °C by the charts of ASTM D341."""
    assert drag_ratio(40.0) == pytest.approx(1.0) and drag_ratio(100.0) == pytest.approx(6.8 / 46)
    ratios = [drag_ratio(temperature) for temperature in range(-20, 121, 10)]
    assert ratios == sorted(ratios, reverse=True)
    assert 46 * drag_ratio(31.5) == pytest.approx(68, rel=0.05)


@pytest.mark.parametrize("temperature", [-20.5, 120.5])
def test_a_temperature_beyond_the_range_is_refused(temperature: float) -> None:
    with pytest.raises(InputError) as refused:
        drag_ratio(temperature)
    assert refused.value.place.key == "start.temperature_C"


def test_each_kind_has_a_deciding_number_and_ends_in_all_limits() -> None:
    assert (LEVEL.unit, QUIET.unit, MEETS.unit) == ("dB", "s", "")
    for what, columns in QUANTITIES.items():
        names = [column.name for column in columns] + [column.name for column in FLAGS[what]]
        assert DECIDING[what] in names and len(set(names)) == len(names)
        assert FLAGS[what][-1] == MEETS
