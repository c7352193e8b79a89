"""The study of what accuracy costs: records of measurements, the check, arguments that are refused."""

import math

import pytest

import abu_calc
from abu_calc.features.accuracy.study import (
    MeasuredPoint,
    PriceList,
    PricePoint,
    Reference,
    ReferenceRun,
    _affordable,
    accuracy,
)
from abu_calc.foundation.errors import InputError

GOOD = PricePoint("equations", "scipy-dop853", 1e-6, 2e-3, 900, 90, 0.02, 0.5)
REFERENCE = ReferenceRun(("scipy-dop853", "scipy-radau"), (1e-11, 1e-10), 3e-9, None, 4.0)  # type: ignore[arg-type]


def listed(chosen: PricePoint | None) -> PriceList:
    return PriceList("amplitude", 0.01, REFERENCE, (GOOD,), chosen, ())


def test_the_check_passes_with_the_error_of_the_chosen_way() -> None:
    check = _affordable(listed(GOOD))
    assert (check.status, check.value, check.limit, check.remedy) == ("pass", 2e-3, 0.01, None)
    none = _affordable(listed(None))
    assert (none.status, none.value) == ("fail", None) and "--time-budget" in str(none.remedy)


def test_what_is_infinite_is_no_number_of_a_record() -> None:
    record = MeasuredPoint.read(PricePoint("envelope", None, None, math.inf, 0, 0, math.nan, 0.5, "far off"))
    assert (record.error, record.wall_s, record.cold_s, record.note) == (None, None, 0.5, "far off")


def test_records_that_differ_in_time_alone_are_equal() -> None:
    """Times belong to the machine at that moment."""
    slower = PricePoint("equations", "scipy-dop853", 1e-6, 2e-3, 900, 90, 0.04, 0.7)
    assert MeasuredPoint.read(GOOD) == MeasuredPoint.read(slower)
    assert Reference.read(REFERENCE).disagreement == 3e-9 and Reference.read(REFERENCE).wall_s == 4.0


@pytest.mark.parametrize(
    ("options", "key"),
    [({"quantity": "beauty"}, "quantity"), ({"budget_s": 0.0}, "budget_s"), ({"accuracy": 0.0}, "accuracy"),
     ({"scene": "flying"}, "scene")],
)  # fmt: skip
def test_wrong_arguments_are_refused_by_name(options: dict[str, object], key: str) -> None:
    with pytest.raises(InputError) as refused:
        accuracy(abu_calc.read("msh-230"), **options)  # type: ignore[arg-type]
    assert refused.value.place.key == key
