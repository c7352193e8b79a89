"""The report of `abu verify`: differing values in a table, files as expected in one line."""

import pytest

from abu_calc.features.verify.study import VerifiedFile, VerifyResult, _check, compare, verify_blocks, verify_screen
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.screen import as_text
from abu_calc.simulation.result import Provenance

ENTRIES = {"a": 1.0, "b": "k6"}


def result(*expected: dict[str, object]) -> VerifyResult:
    files = tuple(
        VerifiedFile(file=f"file{k}.toml", values=compare(values, {}, ENTRIES)) for k, values in enumerate(expected)
    )
    return VerifyResult(title="verify", checks=tuple(map(_check, files)), provenance=Provenance.today(), files=files)


def test_only_values_that_differ_stand_in_the_table() -> None:
    """1.25 expected, 1.0 there: off by 0.25/1.25."""
    mixed = result({"a": 1.25, "b": "k6", "c": 3.0})
    (grid,) = [block for block in verify_blocks(mixed) if isinstance(block, Grid)]
    assert grid.rows == (("a", "1.25000", "1.00000", "20.0 %", "0.100 %"), ("c", "3.00000", "none", "", "0.100 %"))
    assert mixed.status == "fail" and "3 values, 2 differ" in as_text(verify_screen(mixed), 80)


def test_the_screen_names_files_as_expected_in_one_line() -> None:
    text = as_text(verify_screen(result({"a": 1.0}, {"b": "k6"})), 80)
    assert text.splitlines()[0].strip().startswith("PASS: 2 of 2 files as expected")
    assert "As expected: file0.toml, file1.toml." in text and "--update" not in text
    some = as_text(verify_screen(result({"a": 1.0}, {"b": "h6"})), 80)
    assert "FAIL: 1 of 2 files as expected" in some and "--update" in some


@pytest.mark.slow
def test_many_files_still_fit_one_screen() -> None:
    text = as_text(verify_screen(result(*({"a": 2.0} for _ in range(20)))), 80)
    assert len(text.splitlines()) <= 48
