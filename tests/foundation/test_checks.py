"""Check codes by their hundreds, and the status of several checks."""

import ast
import re
from itertools import combinations_with_replacement

import pytest

from abu_calc.features.design.next_step import NUMBERS
from abu_calc.features.design.screen import NOT_IN_BALANCE
from abu_calc.features.design.verdict import OF_BALANCING
from abu_calc.foundation.checks import CHECK_CODES, HUNDREDS, Check, Grade, coded, overall, verdict, worst
from abu_calc.foundation.units import UNIT_BY_SUFFIX
from abu_calc.reporting.page.watched import MAIN_CHECKS
from abu_calc.sizing.proposals import PROPOSED
from tests.house.structure import ROOT
from tests.rows import for_each

GRADES: tuple[Grade, ...] = ("pass", "warn", "not-done", "fail")
"""From best to worst."""


def checks(*grades: Grade) -> list[Check]:
    """Checks that differ in nothing but their grades."""
    return [Check("ABU101", "any", grade, "") for grade in grades]


@for_each(list(combinations_with_replacement(GRADES, 3)))
def test_several_checks_are_as_good_as_the_worst(grades: tuple[Grade, ...]) -> None:
    """In any order; a warning passes, what was not done never does."""
    bad = max(grades, key=GRADES.index)
    for order in (grades, grades[::-1]):
        assert worst(checks(*order)) == bad
        assert overall(checks(*order)) == {"pass": "pass", "warn": "pass"}.get(bad, bad)


def test_without_checks_nothing_has_passed() -> None:
    assert overall([]) == "not-done"


def test_a_failed_check_is_no_warning_whatever_the_stricter_rule_says() -> None:
    assert verdict(False, True) == verdict(False, False) == "fail"


def test_every_code_stands_in_the_file_of_its_hundred_under_its_own_name() -> None:
    codes = list(CHECK_CODES)
    assert len(codes) == len(set(codes)) == len(CHECK_CODES)
    for code in codes:
        entry = CHECK_CODES[code]
        assert (entry.code, code[:-2] in HUNDREDS) == (code, True)
        assert entry.name and entry.question.rstrip().endswith(("?", ".", "scene")) and "?" in entry.question, code
        assert entry.action.endswith("."), code
        conditions = [entry.pass_if, entry.warn_if, entry.fail_if, entry.not_evaluated_if]
        assert sum(map(bool, conditions)) >= (1 if code.endswith(("604", "614")) else 2), code
        assert all(condition[0].islower() or condition[0].isupper() for condition in conditions if condition), code
        assert all(condition.endswith(".") for condition in conditions if condition), code


@pytest.mark.slow
def test_the_grades_that_the_code_gives_outright_have_a_condition() -> None:
    """`coded("ABU…", "warn", …)` and likewise: the grade stands in the call."""
    given: dict[str, set[str]] = {}
    for file in (ROOT / "abu_calc").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "coded"):
                continue
            values = [argument.value for argument in node.args[:2] if isinstance(argument, ast.Constant)]
            if len(values) == 2:
                given.setdefault(str(values[0]), set()).add(str(values[1]))
    assert len(given) > 10
    for code, grades in given.items():
        for grade in grades:
            assert getattr(CHECK_CODES[code], f"{grade.replace('not-done', 'not_evaluated')}_if"), (code, grade)


def test_a_code_that_nobody_gave_has_no_entry() -> None:
    for code in ("ABU199", "ABU1199"):
        with pytest.raises(KeyError):
            coded(code, "pass", "")


def test_a_check_of_several_things_names_its_own() -> None:
    assert coded("ABU621", "fail", "too tight", 1.0, 2.0, of="6203").name.endswith(", 6203")
    assert coded("ABU621", "fail", "too tight").name == CHECK_CODES["ABU621"].name


def test_what_a_kind_declares_is_known() -> None:
    """Units have a suffix or are words, keys are unique, and every key by which a check is looked up is one of them."""
    kinds = CHECK_CODES.values()
    keys = [kind.key for kind in kinds if kind.key]
    assert len(keys) == len(set(keys))
    assert {kind.unit for kind in kinds} - UNIT_BY_SUFFIX.keys() == {None, "", "starts", "start cases"}
    assert {kind.bound for kind in kinds} == {"most", "least"}
    used = {key for kind in kinds for key in kind.follows} | PROPOSED.keys() | NUMBERS.keys() | OF_BALANCING
    for file in (ROOT / "abu_calc").rglob("*.py"):
        used |= set(re.findall(r'(?:first_of\([\w.]+, |check\.key == )"(\w+)"', file.read_text("utf-8")))
    assert used | NOT_IN_BALANCE | {*MAIN_CHECKS} <= set(keys)


def test_a_check_has_the_unit_and_the_bound_of_its_kind() -> None:
    check = coded("ABU302", "pass", "hard", 60.0, 58.0)
    assert (check.value, check.limit, check.unit, check.bound) == (60.0, 58.0, "HRC", "least")
    check = coded("ABU206", "pass", "true", 8e-6, 10e-6)
    assert (check.value, check.limit) == pytest.approx((8.0, 10.0)) and check.unit == "µm"
    unknown, none = coded("ABU206", "not-done", "not known", None), coded("ABU206", "not-done", "no number")
    assert (unknown.value, unknown.unit, none.value, none.unit) == (None, "µm", None, None)
    other = coded("ABU424", "warn", "apart", 0.25, 0.0, unit="percent", bound="least")
    assert (other.value, other.unit, other.bound) == (25.0, "%", "least")


def test_texts_are_short_sentences() -> None:
    """A condition goes on after "PASS if"; no sentence has more than 35 words, most have less than 20."""
    for code in CHECK_CODES:
        entry = CHECK_CODES[code]
        texts = (entry.question, entry.pass_if, entry.warn_if, entry.fail_if, entry.not_evaluated_if, entry.action)
        for sentence in re.split(r"(?<=[.?;])\s+", " ".join(" ".join(texts).split())):
            assert len(sentence.split()) <= 35, (code, sentence)
            assert not re.search(r"\b(hang|tongue|remedy|rung|ledger|worst(?! friction case))\b", sentence), (
                code,
                sentence,
            )
