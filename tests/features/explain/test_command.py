"""`abu explain`: steps and check codes in words, and as data."""

import pytest

from abu_calc.features.explain.steps import STEPS
from abu_calc.foundation.checks import CHECK_CODES
from abu_calc.foundation.formula import formula_of
from tests.cli.runner import abu, once


@pytest.mark.parametrize("code", CHECK_CODES)
def test_a_code_is_explained(code: str) -> None:
    one = CHECK_CODES[code]
    assert not one.step or one.step in STEPS
    shown = abu("explain", code.lower())
    assert shown.status == 0
    for part in (
        one.name,
        one.question,
        one.fail_if,
        one.action,
        *(formula_of(key).for_users[0] for key in one.formulas),
    ):
        assert " ".join(part.split()) in " ".join(shown.out.split())


@pytest.mark.slow
def test_codes_are_listed_and_given_as_data() -> None:
    listed = abu("explain", "--json").document["result"]
    assert listed["checks"]["ABU203"] == "mass of the autobalancer"
    told = abu("explain", "ABU203", "--json").document["result"]
    assert (told["check"], told["step"]) == ("ABU203", "balls")
    assert "did you mean" in abu("explain", "ABU2Z3").err.lower()


@pytest.mark.parametrize("typed", ["ABU4O1", "abu4o1", "ABU40l", "ABU4OI", "АВU4О1"])
def test_a_letter_for_a_digit_of_a_code_is_understood(typed: str) -> None:
    assert abu("explain", typed, "--json").document["result"]["check"] == "ABU401"


def test_a_step_has_each_of_its_formulas() -> None:
    shown = once("explain", "capacity", "--json").document["result"]
    assert shown["step"] == "capacity"
    assert set(shown["formulas"]) == {formula.name for formula in STEPS["capacity"].formulas}


@pytest.mark.slow
def test_an_unknown_step_is_refused_with_those_there_are() -> None:
    seen = abu("explain", "capacitie")
    assert seen.status == 2 and "Did you mean capacity?" in seen.err
    assert all(step in seen.err for step in STEPS)
    assert "Did you mean" not in abu("explain", "qqqqqqqq").err
