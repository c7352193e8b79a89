"""Charts of the atlas on which a machine has a place, with its mark."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence

from abu_calc.features.atlas.charts import AtlasChart, ChartAxis, cells, charts, place
from abu_calc.features.atlas.machine_numbers import Numbers, machine_numbers
from abu_calc.reporting.charts.chart import Cells, MarkedPoint
from abu_calc.reporting.charts.figure import Figure
from abu_calc.sizing.design import Design


def atlas_figures(design: Design) -> Iterator[Figure]:
    """A figure for each chart whose fixed numbers the machine has and whose axes hold it."""
    numbers = machine_numbers(design)
    for chart in charts():
        spot = spot_of(chart, numbers)
        if spot is not None:
            yield _figure(chart, numbers, *spot)


def spot_of(chart: AtlasChart, numbers: Numbers) -> tuple[float, float] | None:
    """The machine's place in columns and rows; None if a fixed number differs, or an axis does not hold it."""
    if not all(each.number in numbers and each.fits(numbers[each.number]) for each in chart.fixed):
        return None
    across, up = along(chart.across, numbers), along(chart.up, numbers)
    return None if across is None or up is None else (across, up)


def along(axis: ChartAxis, numbers: Numbers) -> float | None:
    """Place between the values of an axis, in cells: by the logarithm where both neighbours are above zero."""
    value, values = numbers.get(axis.number), axis.values
    if value is None or isinstance(value, str) or not values[0] <= value <= values[-1]:
        return None
    first = min(bisect_right(values, value) - 1, len(values) - 2)
    low, high = values[first], values[first + 1]
    if low > 0:
        return first + math.log(value / low) / math.log(high / low)
    return first + (value - low) / (high - low)


def _figure(chart: AtlasChart, numbers: Numbers, across: float, up: float) -> Figure:
    known = cells()
    grid = [[known.get(place(chart.name, x, y)) for x in chart.across.values] for y in chart.up.values]
    classes = [[None if cell is None else chart.class_of(cell[0]) for cell in line] for line in grid]
    where = ", ".join(f"{axis.symbol} = {numbers[axis.number]:.3g}" for axis in (chart.across, chart.up))
    here = _around(chart, [grid[row][column] for row in _both(up) for column in _both(across)])
    seen = {kind for line in classes for kind in line}
    words = [(None, "not computed"), *enumerate(chart.words)]
    drawn = Cells(
        f"{chart.title} ({chart.panel})", f"This machine: {where}.{here}", chart.across.label, chart.up.label,
        [f"{value:g}" for value in chart.across.values], [f"{value:g}" for value in chart.up.values], classes,
        [entry for entry in words if entry[0] in seen], MarkedPoint(across, up, "this machine"),
    )  # fmt: skip
    caption = (
        f"{chart.title} ({chart.panel}), chart {chart.letter} of the atlas: {chart.quantity}. {chart.definition} "
        f"This machine: {where}.{here} It has the {len(chart.fixed)} fixed numbers of the chart within their "
        "tolerances; the atlas in the documentation lists them."
    )
    return Figure(f"atlas-{chart.name}", "", drawn, caption)


def _both(where: float) -> tuple[int, int]:
    """The cells on either side of a place; twice the same in the middle of a cell."""
    return math.floor(where), math.ceil(where)


def _around(chart: AtlasChart, near: Sequence[tuple[float, float, float] | None]) -> str:
    """Values of the cells around a machine, from the lowest to the highest, with their intervals."""
    known = [cell for cell in near if cell is not None]
    if not known:
        return ""
    factor, unit = (100.0, " %") if chart.share else (1.0, "")
    values = sorted({f"{factor * value:.3g}" for value, _, _ in known}, key=float)
    low, high = factor * min(cell[1] for cell in known), factor * max(cell[2] for cell in known)
    within = f" (intervals: {low:.3g} … {high:.3g}{unit})" if any(cell[2] > cell[1] for cell in known) else ""
    between = values[0] if len(values) == 1 else f"{values[0]} … {values[-1]}"
    return f" Cells around it: {between}{unit}{within}."
