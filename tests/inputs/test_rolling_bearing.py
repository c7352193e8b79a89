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
    found = Bearing.model_validate(given).own_defaults()
    assert {key: found[key] for key in ("series", "bearing_class") if key in found} == told


def test_a_designation_may_have_its_own_chamfer() -> None:
    assert Bearing(designation="7516", chamfer_mm=2.0).chamfer_mm == 2
