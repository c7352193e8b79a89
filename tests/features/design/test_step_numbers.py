"""Formulas with the numbers of a machine put in."""

import re

import pytest

import abu_calc
from abu_calc.features.design.summary import explanation_blocks
from abu_calc.reporting.blocks import number
from tests.cli.runner import abu, once
from tests.remembered import recalled


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
