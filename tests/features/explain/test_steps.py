"""Steps that are explained: formulas that are registered, each in one step, shown as they speak of themselves."""

import pytest

from abu_calc.features.explain.steps import STEPS, Step, code_blocks, formula_blocks, si_conversions, step_blocks
from abu_calc.foundation.checks import CHECK_CODES
from abu_calc.reporting.blocks import Heading, Paragraph
from tests.rows import for_each


@for_each(STEPS)
def test_every_key_of_a_step_is_a_registered_formula(name: str) -> None:
    formulas = STEPS[name].formulas
    assert [formula.key for formula in formulas] == list(STEPS[name].keys)
    assert len({formula.name for formula in formulas}) == len(formulas) > 0


def test_numbers_stand_between_the_title_and_the_formulas() -> None:
    title, number, *others = step_blocks(STEPS["capacity"], ("m₀e = 250 g·mm",))
    assert title == Heading(STEPS["capacity"].title)
    assert number == Paragraph("→ m₀e = 250 g·mm")
    formulas = STEPS["capacity"].formulas
    assert others == [*formula_blocks(formulas), *si_conversions(formulas)]


def test_a_formula_without_registration_is_an_error() -> None:
    with pytest.raises((KeyError, AttributeError, ImportError)):
        assert Step("nothing", ("sizing.budget:no_such_formula",)).formulas


def test_a_code_names_its_step_where_it_has_one() -> None:
    for code in ("ABU201", "ABU703"):
        check = CHECK_CODES[code]
        texts = [block.text for block in code_blocks(check) if isinstance(block, Paragraph)]
        assert texts[0] == f"Question: {check.question}"
        assert (f"Step: abu explain {check.step}" in texts) == bool(check.step)
