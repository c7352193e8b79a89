"""Formulas of a simulation are registered with what their words claim."""

import pytest

from abu_calc.formulas.motion import ACCURACY, EQUATIONS, HARDLY, SETTLED, SETTLING_TIME, SIMULATE
from abu_calc.foundation.errors import RangeError


@pytest.mark.parametrize("accuracy", [0.0, 0.6, -0.01, float("nan")])
def test_an_accuracy_that_no_simulation_has_is_refused_by_its_key(accuracy: float) -> None:
    with pytest.raises(RangeError) as refused:
        ACCURACY.check(accuracy)
    assert refused.value.place.key == "accuracy"
    assert ACCURACY in SIMULATE.checked


def test_the_words_of_settling_name_the_shares_that_the_code_uses() -> None:
    assert f"{100 * HARDLY:g} %" in SETTLING_TIME.equation and f"{SETTLED:g}·max" in SETTLING_TIME.equation
    assert 0 < HARDLY < SETTLED < 1


def test_every_formula_says_where_it_is_from() -> None:
    assert all(formula.source for formula in (EQUATIONS, SETTLING_TIME, SIMULATE))
