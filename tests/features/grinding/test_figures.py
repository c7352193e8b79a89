"""Figures of a machine at its work: lines broken where nothing is known, no curves for a face."""

from dataclasses import replace

import pytest

from abu_calc.features.grinding.figures import _unbroken, grinding_extras
from abu_calc.reporting.charts.chart import Bars, Plot
from tests.features.grinding.test_command import STRAIGHT, worked


def test_a_line_is_broken_where_a_value_is_not_known() -> None:
    course = [(1.0, 5.0), (2.0, 6.0), (3.0, None), (4.0, 7.0), (5.0, None)]
    lines = list(_unbroken("with", 1, course))
    assert [line.points for line in lines] == [[(1.0, 5.0), (2.0, 6.0)], [(4.0, 7.0)]]
    assert list(_unbroken("with", 1, [(1.0, None)])) == []


@pytest.mark.slow
def test_bars_are_the_levels_of_the_result() -> None:
    result = worked(STRAIGHT, "golden")
    figures = {figure.name: figure.shown for figure in grinding_extras(result).figures}
    bars = figures["levels"]
    assert isinstance(bars, Bars)
    assert [bar.value for bar in bars.rows][:2] == [result.level_before_db, result.level_after_db]
    force = figures["force"]
    assert isinstance(force, Plot) and force.limit is not None and force.limit[0] == 400.0
    reaction = figures["reaction"]
    assert isinstance(reaction, Plot)
    ends = {line.name: (line.points[0], line.points[-1]) for line in reaction.lines}
    assert all(first[0] == 0.0 and last == (360.0, first[1]) for first, last in ends.values())  # round the wheel
    none = replace(result, level_before_db=None, level_after_db=None, level_at_once_db=None)
    assert "levels" not in {figure.name for figure in grinding_extras(none).figures}


def test_a_face_has_no_curves_over_angles() -> None:
    names = {figure.name for figure in grinding_extras(worked("avtovaz-707-370")).figures}
    assert "levels" in names and names <= {"levels", "orbit-simulated"}
