"""The sheet to hand over: paper size, scale, title block, parts list."""

import re
from dataclasses import replace

import pytest

from abu_calc.features.design.sheet import section_sheet, size_sheets
from abu_calc.features.design.sheets.part_sheet import ratio, verdict
from abu_calc.foundation.checks import Check, Grade
from abu_calc.reporting.drawings.shapes import SCALES, Text
from tests.reporting.drawings.samples import result


def texts(name: str) -> list[str]:
    return [shape.text for shape in section_sheet(result(name)).shapes if isinstance(shape, Text)]


@pytest.mark.parametrize("name", ["one-piece", "tiny", "huge"])
def test_a_sheet_is_a3_in_a_standard_scale(name: str) -> None:
    sheet = section_sheet(result(name))
    assert sheet.size == pytest.approx((420.0, 297.0)) and sheet.scale in SCALES
    assert any(text.startswith(f"{ratio(sheet.scale)} ") for text in texts(name))


def test_a_larger_part_is_drawn_smaller() -> None:
    scales = [section_sheet(result(name)).scale for name in ("tiny", "one-piece", "huge")]
    assert scales == sorted(scales, reverse=True) and scales[0] > scales[2]


@pytest.mark.parametrize(("scale", "written"), [(5.0, "5:1"), (1.0, "1:1"), (0.5, "1:2"), (0.1, "1:10")])
def test_scales_are_written_as_ratios(scale: float, written: str) -> None:
    assert ratio(scale) == written


def test_the_verdict_names_each_code_once() -> None:
    grades: tuple[tuple[str, Grade], ...] = (
        ("ABU401", "fail"), ("ABU201", "pass"), ("ABU401", "fail"), ("ABU501", "not-done"),
    )  # fmt: skip
    checks = tuple(Check(code, code, grade, "", None, None, None, None) for code, grade in grades)
    assert verdict(replace(result("one-piece"), checks=checks)) == "FAIL: ABU401"
    assert verdict(replace(result("one-piece"), checks=checks[1:2])) == "PASS"
    assert verdict(replace(result("one-piece"), checks=checks[3:])) == "NOT EVALUATED: ABU501"
    warned = (replace(checks[0], status="warn"), *checks[1:2])
    assert verdict(replace(result("one-piece"), checks=warned)) == "PASS WITH WARNINGS: ABU401"


@pytest.mark.parametrize("name", ["one-piece", "bearing-ring"])
def test_the_list_names_every_part_and_the_balls(name: str) -> None:
    sized = result(name)
    shown = texts(name)
    for part in sized.section.parts:
        assert part.name in shown and part.material in shown
    assert str(sized.provenance.sha256) in shown and sized.provenance.date in shown
    assert any(text.startswith(f"{sized.autobalancer.ball_count} × ") for text in shown)
    names = [sheet.name for sheet in size_sheets(sized)]  # no arm, no bearings
    assert names == ["section", *(part.name.replace(" ", "-") for part in sized.section.parts)]


def test_each_sheet_says_that_there_are_warnings() -> None:
    sized = result("one-piece")
    first, *others = sized.checks
    for sheet in size_sheets(replace(sized, checks=(replace(first, status="warn"), *others))):
        shown = [shape.text for shape in sheet.shapes if isinstance(shape, Text)]
        assert any(text.startswith("PASS WITH WARNINGS: ABU") for text in shown) and "PASS" not in shown


def test_every_note_is_numbered_and_begins_with_a_capital() -> None:
    shown = texts("one-piece")
    first = shown.index("Requirements (engineering practice, assumed)") + 1
    notes = [text for text in shown[first:] if re.match(r"\d+ ", text)]
    assert [text.split()[0] for text in notes] == [str(number) for number in range(1, len(notes) + 1)]
    assert len(notes) > 8 and all(text.split()[1][0].isupper() for text in notes)
    assert shown[first] == notes[0]


def test_the_oil_is_a_decision_of_the_design() -> None:
    shown = " ".join(texts("one-piece"))
    assert "viscous drag rate of 15 1/s, which the design assumes" in shown and "VG 46" not in shown


def test_balls_of_an_inch_size_are_ordered_by_it() -> None:
    sized = result("one-piece")
    assert sized.autobalancer.ball_diameter_mm == 15.875
    assert any("Ø15.875 (5/8 in)" in text for text in texts("one-piece"))
    assert not any(" in)" in text for text in texts("sixteen balls"))


def test_the_body_is_not_drilled_where_it_is_hard() -> None:
    """A third of the wall: 2.5 mm of the one-piece body, 2 mm of the light one round its ring."""
    hard, soft = (" ".join(texts(name)) for name in ("one-piece", "light"))
    assert "grinding a flat" in hard and "Correct by drilling" not in hard and "0.8 mm deep at most" in hard
    assert "Correct by drilling" in soft and "0.6 mm deep at most" in soft


def test_no_size_of_the_parts_list_is_cut() -> None:
    """A ball of 13/32 in is 10.319 mm; its name is longer than its column at the usual height."""
    inch = replace(result("one-piece").autobalancer, ball_diameter=10.31875e-3, ball_count=12, ball_mass=116.3847e-3)
    sheet = section_sheet(replace(result("one-piece"), autobalancer=inch))
    written = [shape.text for shape in sheet.shapes if isinstance(shape, Text)]
    assert "ball Ø10.319 (13/32 in)" in written and "12 × 116.385" in written
