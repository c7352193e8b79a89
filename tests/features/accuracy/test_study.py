"""The study of what accuracy costs: records of measurements, the check, arguments that are refused."""

from dataclasses import replace

import pytest

import abu_calc
from abu_calc.features.accuracy.study import (
    MeasuredPoint,
    PriceList,
    Reference,
    _affordable,
    accuracy,
)
from abu_calc.foundation.errors import InputError

GOOD = MeasuredPoint(
    rung="equations", integrator="scipy-dop853", tolerance=1e-6, error=2e-3, evaluations=900, steps=90, wall_s=0.02,
    cold_s=0.5,
)  # fmt: skip
REFERENCE = Reference(
    integrators=("scipy-dop853", "scipy-radau"), tolerances=(1e-11, 1e-10), disagreement=3e-9, wall_s=4.0,
    response=None,  # type: ignore[arg-type]
)  # fmt: skip


def listed(chosen: MeasuredPoint | None) -> PriceList:
    return PriceList("amplitude", 0.01, REFERENCE, (GOOD,), chosen, ())


def test_the_check_passes_with_the_error_of_the_chosen_way() -> None:
    check = _affordable(listed(GOOD))
    assert (check.status, check.value, check.limit, check.remedy) == ("pass", 2e-3, 0.01, None)
    none = _affordable(listed(None))
    assert (none.status, none.value) == ("fail", None) and "--time-budget" in str(none.remedy)


def test_records_that_differ_in_time_alone_are_equal() -> None:
    """Times belong to the machine at that moment."""
    assert replace(GOOD, wall_s=0.04, cold_s=0.7) == GOOD != replace(GOOD, steps=91)
    assert replace(REFERENCE, wall_s=5.0) == REFERENCE and "response" not in REFERENCE.to_dict()


@pytest.mark.parametrize(
    ("options", "key"),
    [({"quantity": "beauty"}, "quantity"), ({"budget_s": 0.0}, "budget_s"), ({"accuracy": 0.0}, "accuracy"),
     ({"scene": "flying"}, "scene")],
)  # fmt: skip
def test_wrong_arguments_are_refused_by_name(options: dict[str, object], key: str) -> None:
    with pytest.raises(InputError) as refused:
        accuracy(abu_calc.read("msh-230"), **options)  # type: ignore[arg-type]
    assert refused.value.place.key == key
