"""Formulas of a simulation are registered with what their words claim."""

from abu_calc.formulas.motion import (
    EQUATIONS,
    HARDLY,
    QUIET_TIME,
    REST_TIME,
    SETTLED,
    SETTLING_TIME,
    SIMULATE,
)
from abu_calc.simulation.quiet import GRAZE, GRAZED, LAST


def test_the_words_of_settling_and_quiet_name_the_shares_that_the_code_uses() -> None:
    for formula in (SETTLING_TIME, REST_TIME):
        assert f"{100 * HARDLY:g} %" in formula.equation and f"{SETTLED:g}·max" in formula.equation
    assert 0 < HARDLY < SETTLED < 1
    assert f"last {100 * (1 - LAST):.0f} % of the run" in QUIET_TIME.where
    assert f"threshold by {100 * GRAZE:g} %" in QUIET_TIME.where and GRAZED == 0.1 and "a tenth" in QUIET_TIME.where


def test_every_formula_says_where_it_is_from() -> None:
    assert all(formula.source for formula in (EQUATIONS, SETTLING_TIME, QUIET_TIME, REST_TIME, SIMULATE))
