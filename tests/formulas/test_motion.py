"""Formulas of a simulation are registered with what their words claim."""

import pytest

from abu_calc.formulas.motion import (
    ACCURACY,
    EQUATIONS,
    HARDLY,
    QUIET_TIME,
    REST_TIME,
    SETTLED,
    SETTLING_TIME,
    SIMULATE,
)
from abu_calc.foundation.errors import RangeError
from abu_calc.simulation.quiet import GRAZE, GRAZED, LAST


@pytest.mark.parametrize("accuracy", [0.0, 0.6, -0.01, float("nan")])
def test_an_accuracy_that_no_simulation_has_is_refused_by_its_key(accuracy: float) -> None:
    with pytest.raises(RangeError) as refused:
        ACCURACY.check(accuracy)
    assert refused.value.place.key == "accuracy"
    assert ACCURACY in SIMULATE.checked


def test_the_words_of_settling_and_quiet_name_the_shares_that_the_code_uses() -> None:
    for formula in (SETTLING_TIME, REST_TIME):
        assert f"{100 * HARDLY:g} %" in formula.equation and f"{SETTLED:g}·max" in formula.equation
    assert 0 < HARDLY < SETTLED < 1
    assert f"last {100 * (1 - LAST):.0f} % of the run" in QUIET_TIME.where
    assert f"threshold by {100 * GRAZE:g} %" in QUIET_TIME.where and GRAZED == 0.1 and "a tenth" in QUIET_TIME.where


def test_every_formula_says_where_it_is_from() -> None:
    assert all(formula.source for formula in (EQUATIONS, SETTLING_TIME, QUIET_TIME, REST_TIME, SIMULATE))
