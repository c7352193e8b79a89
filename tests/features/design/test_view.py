"""The whole report of `abu size`."""

from dataclasses import replace

import pytest

from abu_calc.features.design.view import size_blocks
from abu_calc.reporting.blocks import Grid
from abu_calc.reporting.screen import as_text
from tests.cli.runner import once
from tests.reporting.drawings.samples import whole


@pytest.mark.slow
def test_report_reads_like_a_calculation_note() -> None:
    seen = once("size", "avtovaz-707-222", "--full")
    lines = seen.out.splitlines()
    assert seen.status == 0 and max(map(len, lines)) <= 80
    assert lines[1].strip().startswith("SUITS")
    order = [
        "Contents",
        "Levels and times",
        "Checks",
        "Notes",
        "Design",
        "Frequencies and capacity",
        "Defaults used (not in the file)",
        "Provenance",
    ]
    places = [lines.index(title) for title in order]
    assert places == sorted(places)


def test_parts_and_balls_of_the_report_add_up_to_the_mass() -> None:
    result = whole()
    grids = {block.header: block for block in size_blocks(result) if isinstance(block, Grid)}
    parts = grids["part", "material", "mass"].rows
    masses = [float(row[2].removesuffix(" g")) for row in parts]
    design = result.autobalancer
    assert sum(masses) + design.ball_count * design.ball_mass_g == pytest.approx(design.mass_g, rel=2e-3)


@pytest.mark.slow
def test_a_machine_without_arm_seats_or_starts_has_no_such_chapters() -> None:
    bare = as_text(size_blocks(replace(whole(), ensemble=None, alternatives=())), 80)
    full = as_text(size_blocks(whole()), 80)
    assert "Start cases\n" in full and "Start cases\n" not in bare
    assert "Swing arm" not in full
