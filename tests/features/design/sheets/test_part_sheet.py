"""Sheets of the parts: nothing stands over anything else, and each says what the shop must know."""

from dataclasses import replace

import pytest

from abu_calc.features.design.sheet import section_sheet, size_sheets
from abu_calc.features.design.sheets.part_sheet import number, part_sheets
from abu_calc.reporting.drawings.dimensions import primitives
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Text, ToleranceFrame
from tests.reporting.drawings.overlaps import check_clear
from tests.reporting.drawings.samples import MACHINES, result


def texts(sheet: Drawing) -> list[str]:
    return [shape.text for shape in primitives(sheet.shapes, sheet.scale) if isinstance(shape, Text)]


def frames(sheet: Drawing) -> list[tuple[str, ...]]:
    return [shape.cells for shape in sheet.shapes if isinstance(shape, ToleranceFrame)]


@pytest.mark.parametrize("name", MACHINES)
def test_nothing_stands_over_a_text(name: str) -> None:
    for sheet in size_sheets(result(name)):
        check_clear(sheet)
        assert sheet.size == pytest.approx((420.0, 297.0)) and sheet.scale in SCALES


@pytest.mark.parametrize("name", ["one-piece", "light", "bearing-ring", "rollers"])
def test_the_body_has_bore_face_and_datums(name: str) -> None:
    body = next(part_sheets(result(name), 4))
    square = [cells for cells in frames(body) if cells[0] == "perpendicularity"]
    assert [cells[2] for cells in square] == ["A"] and ("runout", *square[0][1:]) in frames(body)
    shown = texts(body)
    assert {"A", "B", "Ø20 H6", "(+0.013 / 0)"} <= set(shown)
    assert any(text.startswith("1 Material: ") and "GOST" in text for text in shown)
    assert any("Heat treatment" in text for text in shown)


def test_the_ring_of_a_bearing_is_bought() -> None:
    sized = result("bearing-ring")
    shown = texts(next(each for each in part_sheets(sized, 4) if each.name == "race-ring"))
    assert any(f"self-aligning ball bearing {sized.section.bearing_ring}" in text for text in shown)
    assert not any("Heat treatment" in text for text in shown)


@pytest.mark.parametrize("name", ["one-piece", "light"])
def test_the_part_with_the_race_tells_about_it(name: str) -> None:
    sized = result(name)
    race = sized.parts.race_part.name.replace(" ", "-")
    sheet = next(each for each in part_sheets(sized, 4) if each.name == race)
    form = f"{sized.section.circularity_um / 1000:g}"
    assert ("circularity", form) in frames(sheet)
    assert ("runout", f"{round(sized.section.runout_um / 1000, 4):g}", "A") in frames(sheet)
    shown = texts(sheet)
    assert f"Ra {sized.section.roughness_Ra_um:g}" in shown and any(sized.section.hardness in text for text in shown)
    assert any(text.startswith("Z (") for text in shown)
    groove = sized.autobalancer.groove_radius_mm
    assert groove is not None
    assert f"R{round(groove, 2):g} ±0.2" in shown


def test_a_design_without_ring_has_no_sheet_of_one() -> None:
    assert [sheet.name for sheet in part_sheets(result("one-piece"), 3)] == ["body", "cover"]
    assert [sheet.name for sheet in part_sheets(result("light"), 4)] == ["body", "race-ring", "cover"]


@pytest.mark.parametrize("name", ["one-piece", "light"])
def test_sheets_are_numbered_and_counted(name: str) -> None:
    sized = result(name)
    sheets = [section_sheet(sized), *part_sheets(sized, 1 + len(sized.parts.turned))]
    for index, sheet in enumerate(sheets, 1):
        assert f"{index} / {len(sheets)}" in texts(sheet) and number(sized, index) in texts(sheet)
        assert {"legal owner", "checked by", "approved by", "rev.", "projection", "identification number"} <= set(
            texts(sheet))  # fmt: skip
    assert len({number(sized, index) for index in range(1, 5)}) == 4


def test_another_file_has_another_number() -> None:
    sized = result("one-piece")
    other = replace(sized, provenance=replace(sized.provenance, sha256="f" * 64))
    assert number(sized, 2) != number(other, 2)


@pytest.mark.parametrize("name", ["one-piece", "light", "bearing-ring"])
def test_the_assembly_says_closure_fits_and_balance(name: str) -> None:
    sized = result(name)
    shown = " ".join(texts(section_sheet(sized)))
    assert "Fits: cover Ø" in shown and "H8/h7" in shown
    assert ("race ring Ø" in shown) == (len(sized.parts.turned) > 2)
    for item in range(1, len(sized.parts.turned) + 2):
        assert texts(section_sheet(sized)).count(str(item)) >= 2, "in the list and in a balloon"
    speed = max(sized.model.speed_range_rad_per_s)
    bare = sized.autobalancer.mass_g - sized.autobalancer.ball_count * sized.autobalancer.ball_mass_g
    permitted = float(sized.eccentricity.balance_grade[1:]) / speed * bare
    assert f"{permitted:.3g} g·mm" in shown and "without balls and oil" in shown
