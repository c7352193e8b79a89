"""The report of `abu compare`: digits that tell numbers apart, long cells below tables, bars of machines."""

from dataclasses import replace
from functools import cache

import pytest

import abu_calc
from abu_calc.features.compare.study import CompareResult, Difference
from abu_calc.features.compare.view import (
    ComparisonTable,
    compare_extras,
    label_of,
    table_blocks,
    tables_of,
)
from abu_calc.reporting.blocks import Grid, Heading, Paragraph
from abu_calc.reporting.charts.chart import Bars


@cache
def seats() -> CompareResult:
    """Two shafts that differ in one tolerance class."""
    shaft = abu_calc.read("mmg-3200k-knife-shaft")
    return abu_calc.compare([shaft, shaft.changed({"bearing[0].shaft_fit": "m6"})])


def row(path: str, *values: object, part: str = "design", unit: str = "") -> Difference:
    return Difference(part=part, path=path, unit=unit, values=values)  # type: ignore[arg-type]


def cells(*values: object) -> tuple[str, ...]:
    (table,) = tables_of(seats(), [row("x", *values)])
    return table.lines[0][1:]


def test_numbers_have_as_many_digits_as_tell_them_apart() -> None:
    assert cells(1.0001, 2.0) == ("1.0001", "2")
    first, second = cells(123.4561234, 123.4562345)
    assert first != second and float(first) == pytest.approx(123.4561234, rel=1e-6)
    assert cells(None, True) == ("–", "true")


def test_marks_stand_before_what_differs() -> None:
    (table,) = tables_of(seats(), [row("x", 1, 2), row("y", 1, 1)], marked=True)
    assert [line[0] for line in table.lines] == ["≠ x", "  y"]


def test_long_cells_stand_below_the_table() -> None:
    table = ComparisonTable("file", (("short", "a", "b"), ("long", "a" * 25, "b")))
    heading, grid, label, *values = table_blocks(["A", "B"], table)
    assert heading == Heading("Entries of the files") and isinstance(grid, Grid) and grid.rows == (("short", "a", "b"),)
    assert label == Paragraph("long")
    assert [value.text for value in values if isinstance(value, Paragraph)] == ["A  " + "a" * 25, "B  b"]


def test_bars_stand_for_machines_that_have_the_number() -> None:
    path = "autobalancer.mass_g"
    result = replace(seats(), differences=(row(path, 240.0, 260.0),), alike=())
    (figure,) = compare_extras(result).figures
    assert figure.name == "mass" and isinstance(figure.shown, Bars)
    assert [(bar.name[0], bar.value, bar.text) for bar in figure.shown.rows] == [
        ("A", 240.0, "240 g"),
        ("B", 260.0, "260 g"),
    ]
    alone = replace(seats(), differences=(row(path, 240.0, None),), alike=())
    assert compare_extras(alone).figures == ()


@pytest.mark.parametrize(
    ("path", "unit", "label"),
    [
        ("autobalancer.ball_diameter_mm", "mm", "autobalancer: ball diameter, mm"),
        ("imbalance_g_mm", "g·mm", "imbalance, g·mm"),
        ("drawing.12.requirement", "", "drawing 13: requirement"),
        ("frequency.modes.1.damping_ratio", "", "frequency, modes 2: damping ratio"),
        ("no_such.entry_mm", "mm", "no such: entry, mm"),
    ],
)
def test_a_path_has_the_label_of_its_record(path: str, unit: str, label: str) -> None:
    assert label_of(path, unit) == label
