"""Sheets of the parts: nothing stands over anything else, and each says what the shop must know."""

from dataclasses import replace

import pytest

from abu_calc.features.design.sheet import section_sheet, size_sheets
from abu_calc.features.design.sheets.manufacture import corner_relief
from abu_calc.features.design.sheets.part_sheet import number, part_sheets
from abu_calc.reporting.drawings.dimensions import extent, primitives
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Text, ToleranceFrame
from tests.reporting.drawings.overlaps import check_clear
from tests.reporting.drawings.samples import MACHINES, result


def texts(sheet: Drawing) -> list[str]:
    return [shape.text for shape in primitives(sheet.shapes, sheet.scale) if isinstance(shape, Text)]


def frames(sheet: Drawing) -> list[tuple[str, ...]]:
    return [shape.cells for shape in sheet.shapes if isinstance(shape, ToleranceFrame)]


@pytest.mark.few(1)
@pytest.mark.parametrize("name", MACHINES)
def test_nothing_stands_over_a_text(name: str) -> None:
    for sheet in size_sheets(result(name)):
        check_clear(sheet)
        assert sheet.size == pytest.approx((420.0, 297.0)) and sheet.scale in SCALES


@pytest.mark.few(1)
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
    assert f"R{groove:.2f} ±0.20" in shown


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
    assert "Fits: cover Ø" in shown and "F8/h7" in shown
    assert ("race ring Ø" in shown) == (len(sized.parts.turned) > 2)
    for item in range(1, len(sized.parts.turned) + 2):
        assert texts(section_sheet(sized)).count(str(item)) >= 2, "in the list and in a balloon"
    speed = max(sized.model.speed_range_rad_per_s)
    bare = sized.autobalancer.mass_g - sized.autobalancer.ball_count * sized.autobalancer.ball_mass_g
    permitted = float(sized.eccentricity.balance_grade[1:]) / speed * bare
    assert f"{permitted:.3g} g·mm" in shown and "without balls and oil" in shown


CHANGED = (("autobalancer.race_eccentricity_mm", 0.003), ("autobalancer.ball_count", 5))


def test_a_replaced_entry_has_another_number_and_stands_on_the_sheet() -> None:
    sized = result("one-piece")
    source = replace(sized.provenance, overrides=())
    plain, changed, other, turned = (
        replace(sized, provenance=replace(source, overrides=overrides))
        for overrides in ((), CHANGED, (CHANGED[0], ("autobalancer.ball_count", 6)), CHANGED[::-1])
    )
    numbers = [number(each, 1) for each in (plain, changed, other)]
    assert len(set(numbers)) == 3 and number(turned, 1) == numbers[1]
    for sheet in (section_sheet(changed), *part_sheets(changed, 3)):
        said = next(text for text in texts(sheet) if "changed: " in text)
        assert "autobalancer.race_eccentricity_mm = 0.003" in said and "autobalancer.ball_count = 5" in said
    assert not any("changed: " in text for text in texts(section_sheet(plain)))


def test_many_replaced_entries_are_counted() -> None:
    sized = result("one-piece")
    many = tuple((f"autobalancer.some_rather_long_key_{index}", index) for index in range(9))
    shown = texts(section_sheet(replace(sized, provenance=replace(sized.provenance, overrides=many))))
    said = next(text for text in shown if "changed: " in text)
    assert "some_rather_long_key_0 = 0" in said and "… (9 in all)" in said


@pytest.mark.parametrize("name", ["one-piece", "light", "tiny", "narrow"])
def test_the_detail_is_marked_where_it_lies_as_it_is_drawn(name: str) -> None:
    """In the upper half, metal above: the mark encloses race and seat, and its letter stands beside it."""
    from abu_calc.features.design.sheets.dimension_plan import dimension_plan
    from abu_calc.features.design.sheets.manufacture import demanded
    from abu_calc.features.design.sheets.part_views import detail_mark

    plan = dimension_plan(demanded(result(name).parts.race_part))
    race = next(edge for edge in plan.edges if edge.surface == "race")
    shapes = list(detail_mark(plan, 1.0))
    (_, low), (_, high) = extent([shape for shape in shapes if not isinstance(shape, Text)], 1.0)
    assert 0 < low < min(race.start[1], race.end[1]) and high > max(edge.start[1] for edge in plan.edges)
    assert [shape.text for shape in shapes if isinstance(shape, Text)] == ["Z"]


@pytest.mark.few(4)
@pytest.mark.parametrize("name", MACHINES)
def test_an_undercut_stands_only_where_the_seat_has_room(name: str) -> None:
    """DIN 509 E 0.4 × 0.2 is 2 mm wide; covers are 1.5 or 2 mm thick, so their seats have none."""
    sized = result(name)
    size = sized.parts.dimensions
    assert size.web < 3 * 2e-3
    for sheet in part_sheets(sized, 4):
        shown = " ".join(texts(sheet))
        assert "cover seat: DIN 509" not in shown
        if "Undercut at the stop of the ring seat" in shown:
            assert sheet.name == "body" and size.ring_end - size.web > 2e-3


@pytest.mark.few(1)
@pytest.mark.parametrize("name", ["one-piece", "tiny", "thick wall"])
def test_the_cover_s_chamfer_clears_the_corner_of_its_stop(name: str) -> None:
    sized = result(name)
    relief = corner_relief(sized.parts)
    assert relief is not None
    chamfer, radius = relief
    size = sized.parts.dimensions
    assert 0 < radius <= chamfer <= max(1e3 * (size.seat_radius - size.shoulder_radius) / 2, 0.1) + 1e-9
    body, cover = (" ".join(texts(sheet)) for sheet in part_sheets(sized, 3))
    assert f"radius {radius:g} at most" in body and f"Chamfer {chamfer:g} × 45°" in cover


def test_a_screwed_cover_has_no_undercut_either() -> None:
    body, cover = (" ".join(texts(sheet)) for sheet in part_sheets(result("screwed"), 3))
    assert "Thread up to one turn before the stop" in body and "core diameter" in cover
    assert "pressed in" not in body


def test_through_hardened_steel_has_no_depth_of_a_case() -> None:
    for name in ("one-piece", "light"):
        sized = result(name)
        said = " ".join(text for sheet in (section_sheet(sized), *part_sheets(sized, 4)) for text in texts(sheet))
        assert "depth" not in said and "case ≥" not in said


@pytest.mark.parametrize("name", ["one-piece", "light"])
def test_the_cover_never_stands_out(name: str) -> None:
    """The largest of what lies in the depth is not above the least depth."""
    sized = result(name)
    sheets = {sheet.name: texts(sheet) for sheet in part_sheets(sized, 4)}
    web = 1e3 * sized.parts.dimensions.web
    holder = sized.parts.race_part.name.replace(" ", "-")
    assert f"{web:g} 0/-0.1" in sheets["cover"] and f"{web:g} +0.1/0" in sheets[holder]
    if holder != "body":
        depth = next(text for text in sheets["body"] if text.endswith(" +0.1/0"))
        width = next(text for text in sheets[holder] if text.endswith(" 0/-0.1"))
        assert depth.split()[0] == width.split()[0]


def test_race_and_seat_of_one_diameter_have_names() -> None:
    shown = texts(next(part_sheets(result("one-piece"), 3)))
    assert "race Ø62.00 ±0.10" in shown and "seat Ø62 H6" in shown and "cover seat" in shown


def test_a_pressed_cover_is_as_round_as_the_race_and_the_growth_stands_there() -> None:
    sized = result("one-piece")
    body, cover = part_sheets(sized, 3)
    form = ("circularity", f"{sized.section.circularity_um / 1000:g}")
    assert frames(body).count(form) == 2 and frames(cover).count(form) == 1
    assert "before the cover is pressed in" in " ".join(texts(body))


def test_sheets_of_a_design_that_does_not_pass_say_so() -> None:
    """Every sheet, of the assembly and of each part; those of a design that passes do not."""
    good = result("one-piece")
    failed = replace(good.checks[0], status="fail")
    for made, stamped in ((good, False), (replace(good, checks=(failed, *good.checks[1:])), True)):
        assert (made.status != "pass") is stamped
        sheets = size_sheets(made)
        assert len(sheets) > 1
        for sheet in sheets:
            assert any(text.startswith("NOT FOR MANUFACTURE: ") for text in texts(sheet)) is stamped
            check_clear(sheet)
