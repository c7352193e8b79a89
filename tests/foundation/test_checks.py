"""Check codes by their hundreds, and the status of several checks."""

from itertools import combinations_with_replacement

import pytest

from abu_calc.foundation.checks import CHECK_CODES, HUNDREDS, Check, Grade, coded, overall, verdict, worst

GRADES: tuple[Grade, ...] = ("pass", "warn", "not-done", "fail")
"""From best to worst."""


def checks(*grades: Grade) -> list[Check]:
    """Checks that differ in nothing but their grades."""
    return [Check("ABU101", "any", grade, "") for grade in grades]


@pytest.mark.parametrize("grades", list(combinations_with_replacement(GRADES, 3)))
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
        assert entry.name and entry.asks and entry.fails and entry.remedy, code


def test_a_code_that_nobody_gave_has_no_entry() -> None:
    for code in ("ABU199", "ABU1199"):
        with pytest.raises(KeyError):
            coded(code, "pass", "")


def test_a_check_of_several_things_names_its_own() -> None:
    assert coded("ABU621", "fail", "too tight", 1.0, 2.0, "µm", of="6203").name.endswith(", 6203")
    assert coded("ABU621", "fail", "too tight").name == CHECK_CODES["ABU621"].name
