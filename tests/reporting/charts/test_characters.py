"""Charts in characters: what stands where the axes say, and in signs that every console has."""

import pytest

from abu_calc.reporting.blocks import Heading, Paragraph, Picture
from abu_calc.reporting.charts.characters import HIGH, WIDE, characters, pictured
from abu_calc.reporting.charts.chart import Axis, Curve, Figure, MarkedPoint, Plot

AXES = Axis("x [s]", 0.0, 59.0), Axis("y [mm]", 0.0, 36.0)


def field(plot: Plot) -> list[str]:
    """The lines between the axes, the lowest last, as far as the field reaches."""
    lines = characters(plot)
    assert all(len(line) <= 76 and line.isascii() for line in lines)
    start = lines[HIGH + 1].index("+") + 1
    return [row[start:].ljust(WIDE) for row in lines[1 : HIGH + 1]]


def test_a_line_stands_at_the_height_of_each_value() -> None:
    """Three signs for three heights in a row: 36 heights of 12 rows."""
    shown = field(Plot("A", "told", *AXES, (Curve([(k, k % 36 + 0.5) for k in range(36)]),)))
    for column in range(36):
        row = HIGH - 1 - column // 3
        assert shown[row][column] == ".-'"[column % 3]
    assert all(line[40:].strip() == "" for line in shown)


def test_steep_lines_are_whole_and_gaps_are_filled() -> None:
    shown = field(Plot("A", "told", *AXES, (Curve([(0, 0.5), (1, 35.5), (58, 35.5)]),)))
    assert all(row[0] + row[1] != "  " for row in shown)
    assert shown[0][1:59] == "'" * 58


def test_points_words_limit_and_bands() -> None:
    points = [MarkedPoint(10, 1.0, "first"), MarkedPoint(58, 35.0, "last", 2)]
    shown = field(Plot("A", "told", *AXES, (), points, (18.5, "limit 18.5 mm"), [(30.0, 34.0)]))
    assert shown[HIGH - 1][10:16] == "O firs" and shown[0][:59].endswith("last #")
    assert " limit 18.5 mm " in shown[5] and shown[5].count("=") > 15
    assert all(row[30:35] == ":::::" for row in shown[6:])


@pytest.mark.parametrize("ends", [(0.0, 1.0), (98.0, 111.0), (-3e-7, 5e-7), (1e5, 1.0001e5)])
def test_any_axis_has_its_numbers(ends: tuple[float, float]) -> None:
    axis = Axis("z [1]", *ends)
    lines = characters(Plot("A", "told", axis, axis, (Curve([(ends[0], ends[0]), (ends[1], ends[1])]),)))
    assert sum("+" in line.partition(" ")[2] or "+" in line for line in lines[1 : HIGH + 1]) >= 3
    assert len(lines) == HIGH + 4 and lines[-1].endswith("z [1]")


def test_pictures_stand_below_their_sections() -> None:
    chart = Plot("A", "told", *AXES, (Curve([(0, 1), (9, 2)]),))
    blocks = (Heading("First", "one"), Paragraph("a"), Heading("one", "two"), Paragraph("b"))
    found = pictured(blocks, [Figure("a", "one", chart, ""), Figure("b", "", chart, "")])
    assert [type(one) for one in found] == [Heading, Paragraph, Picture, Heading, Paragraph]
