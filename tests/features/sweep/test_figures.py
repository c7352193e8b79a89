"""Figures of a sweep: bars of shares, courses of numbers, cells of a chart."""

from dataclasses import replace

import pytest

from abu_calc.features.sweep.figures import sweep_extras
from abu_calc.features.sweep.result import Chart, Distribution, Price, Sensitivity, SweepResult
from abu_calc.reporting.charts.chart import Bars, Cells, Plot
from tests.features.sweep.conftest import Sweeps


@pytest.fixture
def result(sweeps: Sweeps) -> SweepResult:
    return sweeps.run()


def shown(result: SweepResult) -> dict[str, object]:
    return {figure.name: figure.shown for figure in sweep_extras(result).figures}


def test_shares_are_in_hundredths_with_their_intervals(result: SweepResult) -> None:
    bars = shown(result)["shares"]
    assert isinstance(bars, Bars) and (bars.axis.low, bars.axis.high) == (0.0, 100.0)
    whole = bars.rows[-1]
    assert whole.name == "meets all limits" and whole.value == 100 * result.meets_limits.share
    assert whole.span == pytest.approx([100 * end for end in result.meets_limits.confidence_interval])


def test_the_course_of_a_number_ends_where_it_is_never_reached(result: SweepResult) -> None:
    course = Distribution(percent=(0.0, 5.0, 50.0, 95.0, 100.0), values=(80.0, 81.0, 90.0, 101.0, None), limit=100.0)
    lone = Distribution(percent=(0.0, 100.0), values=(1.0, None), limit=None)
    figures = sweep_extras(replace(result, distributions={"level_db": course, "residual_um": lone})).figures
    (figure,) = [figure for figure in figures if figure.name.startswith("percentiles")]
    assert isinstance(figure.shown, Plot) and len(figure.shown.lines[0].points) == 4
    assert [point.x for point in figure.shown.points] == [5.0, 50.0, 95.0]
    assert figure.shown.points[-1].word == ""  # the word would lie over that of the limit
    assert figure.caption.endswith("In the last 5 % it is never reached.")


def test_bars_of_what_decides_reach_to_the_total(result: SweepResult) -> None:
    rows = Sensitivity(key="a", first_order=0.6, total=0.8), Sensitivity(key="b", first_order=0.0, total=0.001)
    bars = shown(replace(result, sensitivity_by_quantity={"level_db": rows}))["decides-level_db"]
    assert isinstance(bars, Bars) and [(bar.name, bar.value, bar.span) for bar in bars.rows] == [("a", 0.6, (0.6, 0.8))]


def test_tightening_lowers_and_chance_is_left_out(result: SweepResult) -> None:
    real = Price(key="a", better="lower", median=1.0, gain_db=4.0, cost_db=1.0, within_chance=False, advice="tighten")
    bars = shown(replace(result, prices=(real, replace(real, key="b", within_chance=True))))["tighten"]
    assert isinstance(bars, Bars) and [bar.value for bar in bars.rows] == [-4.0] and bars.axis.low == -4.0


def test_cells_grow_with_the_share(result: SweepResult) -> None:
    chart = Chart(x_key="wheel.mass_kg", y_key="start.kind", x=(0.5, 0.6), y=("a", "b"), of="balances",
                  shares=((0.0, 0.3), (None, 1.0)), meets=None, levels_db=((80.0, 90.0), (None, 100.0)))  # fmt: skip
    cells = shown(replace(result, chart=chart))
    assert isinstance(cells["cells"], Cells) and cells["cells"].classes == [[0, 1], [None, 4]]
    assert cells["cells"].across == "wheel.mass_kg [kg]"
    assert isinstance(cells["cells-level"], Cells) and cells["cells-level"].classes == [[1, 3], [None, 4]]
