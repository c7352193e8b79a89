"""A bearing by its designation or its sizes, and what its two seats may say."""

import pytest

from abu_calc.inputs.rolling_bearing import Bearing


@pytest.mark.parametrize(("given", "told"), [
    ({"bore_mm": 17.0, "outer_mm": 40.0, "width_mm": 12.0}, {"series": "light", "bearing_class": "0"}),
    ({"designation": "6203"}, {"bearing_class": "0"}), ({"designation": "6203/P6"}, {}),
    ({"designation": "6203", "bearing_class": "5"}, {}), ({"designation": "nonsense"}, {}),
])  # fmt: skip
def test_class_and_series_of_a_bearing_are_defaults_where_no_designation_tells_them(
    given: dict[str, object], told: dict[str, str]
) -> None:
    defaults = Bearing.model_validate(given).own_defaults()
    assert {key: defaults[key] for key in ("series", "bearing_class") if key in defaults} == told


def test_a_designation_may_have_its_own_chamfer() -> None:
    assert Bearing(designation="7516", chamfer_mm=2.0).chamfer_mm == 2


SIZED = {"bore_mm": 17.0, "outer_mm": 40.0, "width_mm": 12.0}


@pytest.mark.parametrize(("given", "words"), [
    (SIZED | {"housing_outer_mm": 40.0}, "housing_outer_mm must be"),
    (SIZED | {"shaft_limits_um": [2.0, 1.0]}, "ascend"), (SIZED | {"asked_interference_um": [5.0, 5.0]}, "ascend"),
    (SIZED | {"ring_temperature_difference_K": -501.0}, "ring_temperature"), (SIZED | {"speed_rpm": -1.0}, "speed_rpm"),
    (SIZED | {"seat_friction": 1.001}, "seat_friction"), (SIZED | {"axial_load_kN": float("nan")}, "axial_load"),
])  # fmt: skip
def test_a_bearing_that_cannot_be_is_refused(given: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Bearing.model_validate(given)


@pytest.mark.parametrize(("written", "meant"), [("P5", "5"), ("normal", "0"), (" p6 ", "6"), ("4", "4")])
def test_a_class_may_be_written_as_iso_does(written: str, meant: str) -> None:
    assert Bearing.model_validate(SIZED | {"bearing_class": written}).bearing_class == meant


def test_to_set_a_size_takes_the_designation_away_and_the_other_way_round() -> None:
    assert Bearing.displaced_by("bore_mm", 17.0) == ("designation",)
    assert set(SIZED) <= set(Bearing.displaced_by("designation", "6203"))
    assert Bearing.displaced_by("shaft_fit", "k6") == ("shaft_limits_um",)
