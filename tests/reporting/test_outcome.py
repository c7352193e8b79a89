"""Outcomes of commands, and the one JSON document they become."""

import json
import math
from dataclasses import replace
from typing import Annotated, ClassVar

import pytest

import abu_calc
from abu_calc.foundation.checks import Check, Grade
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome, document, error_document, finite, to_json
from abu_calc.simulation.result import Provenance, Result

WHOLE, SHORT = (Paragraph("whole"),), (Paragraph("short"),)


def test_blocks_are_made_when_they_are_wanted() -> None:
    made: list[str] = []

    def view() -> tuple[Paragraph, ...]:
        made.append("view")
        return WHOLE

    outcome = Outcome("size", {}, view)
    assert made == [] and outcome.blocks == WHOLE and made == ["view"]


def test_the_screen_is_the_short_report_or_else_the_whole_one() -> None:
    assert Outcome("size", {}, WHOLE, short=lambda: SHORT).screen == SHORT
    assert Outcome("size", {}, WHOLE).screen == WHOLE


@record
class Sample(Result):
    """A result with one number."""

    command: ClassVar[str] = "sample"

    mass_g: Annotated[float, Quantity("mass")] = 240.5


def sample(*checks: Check) -> Outcome:
    result = Sample(title="sample", checks=checks, warnings=("careful",), provenance=Provenance.today())
    return Outcome(result.command, result, lambda: WHOLE)


def check(status: Grade) -> Check:
    return Check("ABU201", "capacity", status, "enough", 2.0, 1.0, "g·mm", None, "least")


def test_only_a_pass_exits_with_zero() -> None:
    statuses = [sample(check(status)).exit_status for status in ("pass", "warn", "fail", "not-done")]
    assert statuses == [0, 0, 1, 1]
    assert Outcome("presets", {}, WHOLE).exit_status == 0


def test_the_envelope_holds_what_the_result_holds_and_no_input_without_a_file() -> None:
    made = document(sample(check("pass")))
    assert made["abu"]["command"] == "sample" and made["abu"]["version"] == abu_calc.__version__
    assert made["input"] is None and made["warnings"] == ["careful"] and made["result"] == {"mass_g": 240.5}
    assert made["checks"] == [
        {"code": "ABU201", "name": "capacity", "status": "pass", "message": "enough", "value": 2.0, "limit": 1.0,
         "unit": "g·mm", "remedy": None, "bound": "least", "overrides": (), "change": None}
    ]  # fmt: skip


def test_an_action_is_told_with_everything_that_it_replaces() -> None:
    entries = ("oil.grade=VG 100", "run_up.time_s=0.5", "machine.speed_range_rpm=[3000,6000]")
    made = document(sample(replace(check("fail"), overrides=entries)))
    assert made["checks"][0]["change"] == {
        "oil.grade": "VG 100", "run_up.time_s": 0.5, "machine.speed_range_rpm": [3000, 6000]
    }  # fmt: skip


def test_a_command_without_a_study_has_its_notes_for_warnings() -> None:
    made = document(Outcome("validate", {"files": []}, WHOLE, notes=("careful",)))
    assert (made["status"], made["checks"], made["model"]) == ("pass", [], {})
    assert (made["result"], made["warnings"]) == ({"files": []}, ["careful"])


def test_a_wrong_input_is_told_by_its_place() -> None:
    error = InputError("out of range", place=Place("m.toml", 3, "wheel.mass_kg"), found="-1", allowed="above 0")
    facts = error_document("size", error)["error"]
    assert (facts["file"], facts["line"], facts["key"]) == ("m.toml", 3, "wheel.mass_kg")
    assert (facts["message"], facts["found"], facts["allowed"], facts["remedy"]) == (
        "out of range",
        "-1",
        "above 0",
        None,
    )


def test_what_is_no_error_of_ours_is_a_bug() -> None:
    facts = error_document("size", ZeroDivisionError("by zero"))
    assert facts["error"] == {"kind": "bug", "message": "by zero"} and facts["status"] == "not-done"


def test_json_holds_no_nan_and_is_ascii() -> None:
    for number in (math.nan, math.inf):
        with pytest.raises(ValueError):
            to_json({"a": number})
        assert finite(number) is None
    text = to_json({"unit": "µm"})
    assert text.isascii() and json.loads(text) == {"unit": "µm"}
    assert finite(0.0) == 0.0
