"""The summary of the page: the tables of the screen, and never more than two sheets.

Formulas with the numbers of a machine put in.
"""

import re
from dataclasses import replace

import pytest

import abu_calc
from abu_calc.features.design.summary import SHEETS_MM, explanation_blocks, first_that_fit, height_mm, size_summary
from abu_calc.features.design.tables import make, numbers_that_matter
from abu_calc.foundation.checks import Check
from abu_calc.reporting.blocks import Grid, Heading, Paragraph, number
from tests.cli.runner import abu, once
from tests.remembered import recalled
from tests.reporting.drawings.samples import whole


def test_tables_are_those_of_the_screen() -> None:
    late = Check("ABU702", "quiet time", "warn", "late", 0.3, 1.0, "s", "Less of it.")
    result = replace(whole(), checks=(late, *(check for check in whole().checks if check.code != late.code)))
    blocks, complete = size_summary(result, 120.0)
    assert complete
    wanted = [block for block in (*make(result), *numbers_that_matter(result)) if isinstance(block, Grid)]
    assert [block for block in blocks if isinstance(block, Grid)][: len(wanted)] == wanted
    assert [block.text for block in blocks if isinstance(block, Heading)][1:] == ["Actions", "Notes"]


@pytest.mark.parametrize("count", [0, 3, 60])
def test_what_has_no_room_is_named(count: int) -> None:
    """60 failed checks and warnings take more than two sheets: the rest is counted, and stands in the details."""
    checks = tuple(
        Check(code="ABU401", name="level", status="fail", message=f"reason {k} {'long ' * 40}", remedy=f"action {k}")
        for k in range(count)
    )
    warnings = tuple(f"Warning {k}. {'It is long. ' * 9}" for k in range(count))
    blocks, complete = size_summary(replace(whole(), checks=checks, warnings=warnings), 120.0)
    assert 120.0 + sum(map(height_mm, blocks)) < SHEETS_MM
    texts = [block.text for block in blocks if isinstance(block, Paragraph)]
    told = sum(text.startswith("! Warning") for text in texts)
    assert complete == (told == count) == (count < 60)
    assert any(text == f"See Warnings for {count - told} more notes." for text in texts) == (count == 60)
    assert any(text.startswith("More actions, see Checks: ABU401") for text in texts) == (count == 60)


def test_heights_on_paper() -> None:
    assert height_mm(Paragraph("")) == 0.0
    assert height_mm(Paragraph("--set a.b=1 --set c.d=2", indent=4)) == pytest.approx(2 * height_mm(Paragraph("a")) - 2)
    assert height_mm(Grid(("a",), (("b",),) * 3)) > height_mm(Grid(("a",), (("b",),)))
    lines = [[Paragraph("a" * 92)], [Paragraph("b")], [Paragraph("c")]]
    assert first_that_fit(lines, 2.5 * height_mm(lines[0][0])) == lines[:2]
    assert first_that_fit(lines, 0.0) == []


@pytest.mark.slow
def test_explain_puts_the_numbers_in() -> None:
    plain, note = (
        once("size", "swing-arm-grinder", "--full").out,
        once("size", "swing-arm-grinder", "--explain").out,
    )
    assert note.startswith(plain[:500]) and len(note) > 2 * len(plain)
    assert "→ m₀e + M·ε" in note and "As published: Kladiev 1996, (7)" in note and not re.search(r"\{[a-z]+_", note)
    for step in ("frequency", "capacity", "balls", "track", "swing-arm", "simulation", "seats", "mass"):
        seen = abu("explain", step)
        assert seen.status == 0 and "Source:" in seen.out


def test_the_numbers_put_in_are_those_of_the_result() -> None:
    result = recalled("size", abu_calc.read("avtovaz-707-222"))
    model, shown = result.model, [getattr(block, "text", "") for block in explanation_blocks(result)]
    assert model.runout_part_g_mm > 0 and model.eccentricity_part_g_mm > 0
    for kg_m, g_mm in (
        (model.runout_part_kg_m, model.runout_part_g_mm),
        (model.eccentricity_part_kg_m, model.eccentricity_part_g_mm),
    ):
        assert g_mm == pytest.approx(1e6 * kg_m, rel=1e-12)
    assert 2 * model.ball_radius_mm == result.autobalancer.ball_diameter_mm
    parts = " + ".join(map(number, (result.imbalance_g_mm, model.runout_part_g_mm, model.eccentricity_part_g_mm)))
    summed = f"→ m₀e + M·ε·√{{…}} + M·Δ = {parts} = {number(result.required_capacity_g_mm)} g·mm"
    assert [line for line in shown if line.startswith(summed)]
    assert [line for line in shown if line.startswith(f"→ sin β = r/(R−r) = {number(model.ball_radius_mm)}/")]
