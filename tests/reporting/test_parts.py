"""Parts that reports share: checks with their reasons, defaults, and where a result comes from."""

from dataclasses import replace
from typing import Any

from abu_calc.foundation.checks import Check, Grade
from abu_calc.reporting.blocks import Heading, Paragraph
from abu_calc.reporting.parts import (
    SaidSentences,
    default_blocks,
    limit_in_file,
    limit_of,
    measured_after_line,
    provenance_blocks,
    reasons,
    unlike,
    value_and_limit,
    warning_blocks,
    written,
)
from abu_calc.reporting.screen import as_text
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.vibration_records import MeasuredAfterRecord


def test_a_value_beyond_its_limit_is_not_shown_as_the_limit() -> None:
    def told(value: float) -> str:
        return "".join(as_text(reasons([Check("ABU401", "level", "fail", "told", value, 109.0, "dB")])))

    assert "(109.03 dB, at most 109.00)" in told(109.0312)
    assert "(112.0 dB, at most 109.0)" in told(112.04)
    assert "(109.0 dB, at most 109.0)" in told(109.0)


def check(code: str, status: Grade, message: str = "reason", **values: Any) -> Check:
    return Check(code, f"name of {code}", status, message, **values)


def test_reasons_come_worst_first_and_alike_ones_together() -> None:
    checks = [
        check("ABU401", "warn"), check("ABU201", "pass"), check("ABU301", "not-done"), check("ABU202", "fail"),
        check("ABU303", "fail"),
    ]  # fmt: skip
    groups = [[each.code for each in alike] for alike in unlike(checks)]
    assert groups == [["ABU202", "ABU303"], ["ABU301"], ["ABU401"]]
    first, *_ = reasons(checks)
    assert first.mark == "fail" and first.text.startswith("FAIL ABU202") and "ABU303" in first.text


def test_limits_say_whether_more_or_less_is_permitted() -> None:
    assert limit_of(check("ABU201", "pass", limit=5.0, bound="least")) == "at least 5.000"
    assert limit_of(check("ABU201", "pass", limit=5.0)) == "at most 5.000"
    assert limit_of(check("ABU201", "not-done")) == ""
    assert limit_in_file(check("ABU401", "pass", limit=109.0, unit="dB")) == "at most 109 dB"
    assert limit_in_file(None) == ""


def test_a_value_of_rounding_beside_a_limit_of_zero_has_no_digits() -> None:
    growth = Check("ABU103", "stable speed range", "fail", "it grows", 3.052e-15, 0.0, "1/s")
    assert value_and_limit(growth) == " (< 1e-09 1/s, at most 0)"
    assert value_and_limit(replace(growth, value=0.5)).startswith(" (0.5")


def test_values_stand_as_a_file_would_have_them() -> None:
    assert [written(value) for value in (True, 0.5, (1.0, 2.5), "k6")] == ["true", "0.5", "[1, 2.5]", "k6"]


def test_each_entry_of_a_replaced_table_has_a_line() -> None:
    overrides = (
        ("wheel", {"mass_kg": 0.5, "diameter_mm": 150.0}),
        ("bearing", [{"shaft_fit": "m6"}]),
        ("grinding", {}),
    )
    made = Provenance.today("m.toml", "0" * 64, overrides)
    texts = [block.text for block in provenance_blocks(made) if isinstance(block, Paragraph)]
    assert texts[2:] == [
        "wheel.mass_kg = 0.5", "wheel.diameter_mm = 150.0", 'bearing[0].shaft_fit = "m6"', "grinding = {}"
    ]  # fmt: skip
    assert "m.toml, SHA-256 0000000000000000…" in texts[0]


def test_nothing_to_warn_of_has_no_heading() -> None:
    assert warning_blocks(()) == [] == default_blocks(())
    heading, line = warning_blocks(("careful",))
    assert isinstance(heading, Heading) and line == Paragraph("! careful", hang=2)


def record(**changes: Any) -> MeasuredAfterRecord:
    given = {
        "place": "rear", "measured": "103 dB", "measured_level_db": 103.0, "predicted_level_db": 100.0,
        "difference_db": 3.0, "predicted_value": None, "unit": "dB",
    }  # fmt: skip
    return MeasuredAfterRecord(**(given | changes))


def test_a_measurement_is_above_or_below_the_prediction() -> None:
    assert measured_after_line(record()).endswith(
        "rear: 103 dB. Predicted, median of the start cases: 100.0 dB. The measurement is 3.0 dB above it."
    )
    assert "2.0 dB below it" in measured_after_line(record(difference_db=-2.0))
    assert "No idle level is predicted" in measured_after_line(record(predicted_level_db=None, difference_db=None))
    assert measured_after_line(record(predicted_loaded_db=105.0)).endswith("above it. Under load: 105.0 dB.")
    assert measured_after_line(record(this_run_db=99.0)).endswith("above it. This run: 99.0 dB.")


def test_actions_with_the_same_entries_say_each_sentence_once() -> None:
    said = SaidSentences()
    assert said.unsaid("Set a = 1: b rises. All else holds.", ("a=1",)) == "Set a = 1: b rises. All else holds."
    assert said.unsaid("Set a = 1: c falls. All else holds.", ("a=1",)) == "The same change: c falls."
    assert said.unsaid("Set a = 2: c falls. All else holds.", ("a=2",)) == "Set a = 2: c falls. All else holds."
    assert said.unsaid("All else holds.", ()) == said.unsaid("All else holds.", ()) == "All else holds."


def test_entries_of_an_action_stand_once_below_it_to_be_pasted() -> None:
    entries = ("machine.mass_kg=5.6", "autobalancer.ball_count=4")
    asked = {"remedy": "Set both.", "overrides": entries}
    first, second = check("ABU202", "fail", "too heavy", **asked), check("ABU301", "warn", "too few", **asked)
    lone = check("ABU401", "warn", "too loud", remedy="Set one.", overrides=("wheel.mass_kg=1",))
    told = reasons([first, second, lone, check("ABU402", "warn", "no action")])
    options = "--set machine.mass_kg=5.6 --set autobalancer.ball_count=4"
    assert [line.text for line in told if line.text.startswith("--set")] == [options, "--set wheel.mass_kg=1"]
    place = [line.text for line in told].index(options)
    assert told[place - 1].text.startswith("FAIL ABU202") and told[place - 1].text.endswith("Action: Set both.")
    assert told[place].indent > told[place - 1].indent
