"""A bearing between its shaft and its housing: sizes and services that cannot be are refused."""

from dataclasses import replace
from typing import Any

import pytest

from abu_calc.features.seats.bearing import Ring
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.errors import InputError, RangeError
from abu_calc.standards.catalogue import Ratings
from tests.features.seats.samples import bearing, seats, table


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"shaft_fit": "x6"}, "tolerance class of a shaft"),
        ({"housing_fit": "k6"}, "tolerance class of a housing"),
        ({"bearing_class": "7"}, "accuracy class"),
        ({"designation": "6216", "width_mm": 33.0}, "width_mm contradicts"),
        ({"bore_mm": None}, "size of the bearing"),
        ({"outer_mm": 70.0}, "outside diameter must be above bearing bore"),
        ({"chamfer_mm": 16.5}, "above two chamfers"),
        ({"chamfer_mm": -1.0}, "above two chamfers"),
        ({"shaft_bore_mm": 80.0}, "above shaft bore"),
        ({"housing_outer_mm": 130.0}, "housing diameter must be above"),
        ({"housing_outer_mm": 200.0, "housing_material": "wood"}, "unknown material"),
    ],
)
def test_wrong_inputs_are_refused(changes: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        seat_bearing(table(**changes))


@pytest.mark.parametrize(
    ("key", "value"),
    [("radial_load_kN", -1.0), ("radial_load_kN", float("nan")), ("shaft_rz_um", float("inf")),
     ("speed_rpm", float("nan")), ("bore_mm", float("nan")),
     ("bore_mm", 0.5), ("width_mm", 0.0), ("width_mm", float("inf"))],
)  # fmt: skip
def test_values_out_of_range_are_refused(key: str, value: float) -> None:
    with pytest.raises(RangeError):
        seats(**{key: value})


def test_the_seat_ends_at_both_chamfers() -> None:
    assert Ring(0.08, 33e-3, 2e-3, "rotating").seat_length == pytest.approx(29e-3)
    assert Ring(0.08, 33e-3, None, "rotating").seat_length is None


def test_a_share_of_the_rating_is_not_above_itself_by_rounding() -> None:
    """In floating point 0.12·9010/9010 is above 0.12."""
    assert 0.12 * 9010.0 / 9010.0 > 0.12
    rated = replace(bearing(), ratings=Ratings(9010.0, 0.0), service=table(radial_load_kN=0.12 * 9.01))
    assert rated.load_ratio == 0.12
    assert replace(rated, ratings=None).load_ratio is None
    assert replace(rated, service=table(radial_load_kN=None)).load_ratio is None


def test_a_band_of_interference_must_ascend() -> None:
    with pytest.raises(InputError, match="must ascend") as caught:
        replace(bearing(), asked_interference=(28e-6, 10e-6))
    assert caught.value.place.key == "asked_interference_um"
