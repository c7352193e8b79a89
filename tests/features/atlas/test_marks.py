"""Marks of machines on charts: where the axes say, and only if every fixed number fits."""

import subprocess
import sys

import pytest

import abu_calc
from abu_calc.features.atlas.charts import ChartAxis, charts
from abu_calc.features.atlas.machine_numbers import machine_numbers
from abu_calc.features.atlas.marks import along, atlas_figures, spot_of
from abu_calc.features.design.figures import size_extras
from abu_calc.reporting.charts.chart import Cells
from abu_calc.sizing import size

AXIS = ChartAxis("drag", "h", "drag", (0.0, 0.1, 1.0, 10.0))
HORIZONTAL = next(chart for chart in charts() if chart.name == "c-horizontal")


def _numbers(**changed: float | str) -> dict[str, float | str]:
    numbers: dict[str, float | str] = {each.number: each.value for each in HORIZONTAL.fixed}
    return {**numbers, "eccentricity": 0.2, "friction": 0.1, **changed}


def test_a_mark_stands_between_cells_by_the_logarithm() -> None:
    places = {0.0: 0.0, 0.05: 0.5, 0.1: 1.0, 10**-0.5: 1.5, 10.0: 3.0}
    for value, where in places.items():
        assert along(AXIS, {"drag": value}) == pytest.approx(where)
    for beyond in ({"drag": -0.1}, {"drag": 10.1}, {"drag": "none"}, {}):
        assert along(AXIS, beyond) is None


def test_a_mark_needs_every_fixed_number_and_both_axes() -> None:
    assert spot_of(HORIZONTAL, _numbers()) == pytest.approx((3.0, 3.0))
    assert spot_of(HORIZONTAL, _numbers(eccentricity=2.0)) is None
    for each in HORIZONTAL.fixed:
        other: float | str = "other" if isinstance(each.value, str) else 3.0 * each.value + 1.0
        assert spot_of(HORIZONTAL, _numbers(**{each.number: other})) is None, each.number
        lacking = _numbers()
        del lacking[each.number]
        assert spot_of(HORIZONTAL, lacking) is None, each.number


@pytest.mark.slow
def test_the_figures_of_a_machine_stand_on_its_page_with_the_nearest_cell() -> None:
    result = abu_calc.size(abu_calc.read("avtovaz-707-222"), starts="one")
    figures = {figure.name: figure for figure in size_extras(result).figures if figure.name.startswith("atlas-")}
    assert {"atlas-c-horizontal", "atlas-d-settled", "atlas-e", "atlas-g"} <= set(figures)
    shown = figures["atlas-c-horizontal"].shown
    assert isinstance(shown, Cells) and shown.spot is not None
    # Δ·m₀/U = 0.242 lies between 0.2 and 0.3, the friction band 0.141 between 0.1 and 0.2.
    assert 3 < shown.spot.x < 4 and 3 < shown.spot.y < 4
    assert "Δ·m₀/U = 0.242" in shown.summary and "Cells around it: 0.2 … 0.3." in shown.summary


def test_a_machine_beside_all_charts_gets_none() -> None:
    machine = abu_calc.read("avtovaz-707-222").changed({"autobalancer.ball_count": 6, "autobalancer.max_width_mm": 40})
    numbers = machine_numbers(size(machine.whole("size")))
    assert numbers["balls"] == 6
    assert not list(atlas_figures(size(machine.whole("size"))))


@pytest.mark.slow
def test_the_atlas_is_not_imported_before_a_page_is_written() -> None:
    code = (
        "import sys, abu_calc, abu_calc.features.design.figures\n"
        "abu_calc.size(abu_calc.read('avtovaz-707-222'), starts='none')\n"
        "assert not [name for name in sys.modules if name.startswith('abu_calc.features.atlas')]\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
