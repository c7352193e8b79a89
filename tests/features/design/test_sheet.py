"""The sheet to hand over: paper size, scale, title block, parts list."""

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
