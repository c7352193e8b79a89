"""Figures of bearing seats: sketches, tolerance zones, interference and clearance."""

from abu_calc.features.seats.figures import check_fit_figures, seat_sheets, zones_drawing
from abu_calc.features.seats.study import check_fit
from abu_calc.inputs.read_machine import read_machine
from abu_calc.reporting.charts.chart import Bars
from abu_calc.reporting.drawings.shapes import Length, Region, Text
from tests.reporting.drawings.overlaps import check_clear


def test_zones_stand_at_their_limits_and_say_them() -> None:
    result = check_fit(read_machine("mmg-3200k-knife-shaft"))
    shaft, housing = result.seats[:2]
    drawing = zones_drawing("zones-1", shaft, housing)
    regions = [one for one in drawing.shapes if isinstance(one, Region)]
    heights = [(min(y for _, y, _ in one.corners), max(y for _, y, _ in one.corners)) for one in regions]
    assert heights == [shaft.ring_limits_um, shaft.part_limits_um, housing.ring_limits_um, housing.part_limits_um]
    words = [one.text for one in drawing.shapes if isinstance(one, Text)]
    assert {"+21", "+2", "-15", "0", "+40", "-18", "k6", "H7"} <= set(words)
    assert any("2 … 36" in word for word in words)
    assert any(word.startswith("clearance 0 … 58") for word in words)
    named = [one.name for one in check_fit_figures(result)]
    assert len(named) == len(set(named)) == 9


def test_sizes_and_limits_of_the_knife_shaft_s_seats() -> None:
    """Afanasiev 2015: Ø80 k6 is +21/+2, Ø140 K7 is +12/−28; by ISO 286 Ø80 m6 is +30/+11, Ø140 H7 +40/0."""
    drawn = []
    for drawing in seat_sheets(check_fit(read_machine("mmg-3200k-knife-shaft")))[:2]:
        check_clear(drawing)
        drawn.append({each.text: (each.value, each.below) for each in drawing.shapes if isinstance(each, Length)})
    assert drawn[0] == {"Ø80 k6": (80.0, "(+0.021 / +0.002)"), "Ø140 H7": (140.0, "(+0.04 / 0)"), "33": (33.0, "")}
    assert drawn[1] == {"Ø80 m6": (80.0, "(+0.03 / +0.011)"), "Ø140 K7": (140.0, "(+0.012 / -0.028)"), "33": (33.0, "")}


def test_bars_of_interference_start_and_end_at_its_limits() -> None:
    result = check_fit(read_machine("mmg-3200k-knife-shaft"))
    chart = next(figure.shown for figure in check_fit_figures(result) if figure.name == "interference-1")
    assert isinstance(chart, Bars)
    rows = {row.name: row for row in chart.rows}
    shaft, housing = result.seats[:2]
    extreme = rows["shaft: extreme"]
    assert (extreme.start, extreme.value) == shaft.interference_um == (2.0, 36.0)
    assert rows["shaft: permitted"].start == shaft.needed_um
    assert rows["housing: permitted"].start == chart.axis.low  # a ring that needs no interference has no least one
    assert rows["housing: permitted"].value == housing.permitted_interference_um
