"""What `abu sweep` shows: shares, numbers against members, what decides and its price, a chart over two keys."""

import re
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.report.figures.chart import Axis, Bar, Bars, Cells, Line, Plot, Point, db
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.numbers import number
from abu_calc.report.sweep import (
    LIMITS,
    LOOSE,
    LOOSENED,
    MATTER,
    TIGHTENED,
    change,
    percent,
    side_kept,
    title_deciding,
    words_of,
)
from abu_calc.report.sweep_chart import few, fields, kind_of, label_of, title_of
from abu_calc.studies.sweeping.records import Chart, Distribution, Price, Sensitivity
from abu_calc.studies.sweeping.result import SweepResult
from abu_calc.units import unit_of

MOST: Final = 8
"""Values with a bar."""
NAMED: Final = (5.0, 50.0, 95.0)
"""Percentiles that are written into a figure."""
WIDE: Final = 60
HIGH: Final = 40
"""The most cells beside and above one another."""
STEPS: Final = 4
CLEAR: Final = 0.15
"""Of an axis, beside the limit."""


def sweep_extras(result: SweepResult) -> Extras:
    """The figures; what was computed stands in the report."""
    figures = (
        *_shares(result), *_basins(result), *_distributions(result), *_cells(result), *_decides(result),
        *_tighten(result), *_loosen(result),
    )  # fmt: skip
    return Extras(figures)


def _shares(result: SweepResult) -> Iterator[Figure]:
    """Of each limit and of all, with the confidence interval."""
    met, check = result.meets_limits, next(one for one in result.checks if one.code == "ABU822")
    rows = [
        Bar(LIMITS[name], 100 * one.share, percent(one.share), 1, span=_hundredths(one.confidence_interval))
        for name, one in met.each.items()
    ]
    rows.append(
        Bar("meets all limits", 100 * met.share, percent(met.share), 2, span=_hundredths(met.confidence_interval))
    )
    limit = None if check.limit is None else (check.limit, f"at least {number(check.limit, 3)} %")
    told = "; ".join(f"{one.name} {one.told}" for one in rows) + (f"; {limit[1]}" if limit else "")
    caption = (
        f"Share of {met.of} members that keeps each limit; the thin line is the 95 % confidence interval of the share"
        f"{': for all limits it should end right of the dashed line' if limit else ''}."
    )
    chart = Bars("Share that meets the limits", told, Axis("share of members [%]", 0.0, 100.0), rows, limit)
    yield Figure("shares", "Each limit" if len(met.each) > 1 else "", chart, caption)


def _hundredths(interval: tuple[float, float]) -> tuple[float, float]:
    return 100 * interval[0], 100 * interval[1]


def _basins(result: SweepResult) -> Iterator[Figure]:
    rows = [
        Bar(one.start, 100 * one.share, percent(one.share), 1, span=_hundredths(one.confidence_interval))
        for one in result.basins
    ]
    if len(rows) < 2:
        return
    told = "; ".join(f"{one.name} {one.told}" for one in rows)
    caption = "Share of starts that balances, by how the machine is switched on; the thin line: 95 % confidence."
    axis = Axis("share of starts [%]", 0.0, 100.0)
    yield Figure("basins", "Starts that balance", Bars("Starts that balance", told, axis, rows), caption)


def _distributions(result: SweepResult) -> Iterator[Figure]:
    """Each number against the share of members that keep it."""
    for name, one in result.distributions.items():
        known = [(share, value) for share, value in zip(one.percent, one.values, strict=True) if value is not None]
        if len(known) < 2:
            continue
        yield Figure(f"percentiles-{name}", "Percentiles", _distribution(name, one, known), _kept(name, one, known))


def _distribution(name: str, one: Distribution, known: Sequence[tuple[float, float]]) -> Plot:
    unit = unit_of(name)
    title = words_of(name).capitalize()
    limit = None if one.limit is None else (one.limit, f"limit {number(one.limit)} {unit}".rstrip())
    bound = [] if one.limit is None else [one.limit]
    up = Axis.around(f"{words_of(name)} [{unit or '1'}]", [*(y for _, y in known), *bound])
    across = Axis("share of members [%]", 0.0, 100.0)
    points = [Point(x, y, "" if _hidden(up, y, one.limit) else number(y)) for x, y in known if x in NAMED]
    told = "; ".join(f"{x:g} % of the members at most {number(y)} {unit}".rstrip() for x, y in known if x in NAMED)
    told += f"; {limit[1]}" if limit else ""
    return Plot(f"{title} of the members", told, across, up, (Line(known),), points, limit)


def _hidden(up: Axis, value: float, limit: float | None) -> bool:
    """Whether a word there would stand in the limit's."""
    return limit is not None and abs(up.share(value) - up.share(limit)) < CLEAR


def _kept(name: str, one: Distribution, known: Sequence[tuple[float, float]]) -> str:
    text = f"What the {words_of(name)} is at most in so many of the members; written: 5, 50 and 95 %"
    if one.limit is not None:
        text += "; the line should stay below the dashed limit as far to the right as may be"
    never = 100 - known[-1][0]
    return f"{text}{f'. In the last {never:g} % it is never reached' if never else ''}."


def _decides(result: SweepResult) -> Iterator[Figure]:
    for name, found in result.sensitivity_by_quantity.items():
        rows = [_share_of_variance(one) for one in found if one.total >= MATTER][:MOST]
        if not rows:
            continue
        told = "; ".join(f"{one.name} {one.told}" for one in rows)
        caption = (
            f"Share of the variance of the {words_of(name)} that each value decides: the bar alone, to the end of the "
            "thin line together with others (written). The long bars are worth their money, the others are not."
        )
        axis = Axis("share of the variance [1]", 0.0, 1.0)
        chart = Bars(f"What decides the {words_of(name)}", told, axis, rows)
        yield Figure(f"decides-{name}", title_deciding(name), chart, caption)


def _share_of_variance(one: Sensitivity) -> Bar:
    total = max(one.total, one.first_order)
    return Bar(one.key, one.first_order, f"{one.total:.2f}", 1, span=(one.first_order, min(total, 1.0)))


def _tighten(result: SweepResult) -> Iterator[Figure]:
    found = sorted((one for one in result.prices if not one.within_chance), key=lambda one: -one.gain_db)
    rows = [
        Bar(f"{one.key} {side_kept(one)}", -one.gain_db, change(-one.gain_db), 1)
        for one in found
    ]  # fmt: skip
    if rows:
        yield Figure("tighten", TIGHTENED, _prices("What tightening gains", rows), (
            "By how much the level that 95 % of the members keep changes where a value is kept to its better half."
        ))  # fmt: skip


def _loosen(result: SweepResult) -> Iterator[Figure]:
    rows = [Bar(_tried(one), one.loosened_db, change(one.loosened_db), 1 if one.advice == LOOSE else 2)
            for one in result.prices if one.loosened_db is not None]  # fmt: skip
    if rows:
        of = next(one.loosened_of for one in result.prices if one.loosened_of)
        yield Figure("loosen", LOOSENED, _prices("What loosening costs", rows), (
            f"By how much the level that 95 % keep of {of} members rises where the scatter of one value is doubled."
        ))  # fmt: skip


def _tried(one: Price) -> str:
    return f"{one.key} {one.loosened_to}: {'may be' if one.advice == LOOSE else 'leave'}"


def _prices(title: str, rows: Sequence[Bar]) -> Bars:
    values = [one.value for one in rows]
    axis = Axis("change of the level [dB]", min(0.0, *values), max(0.5 if min(values) >= 0 else 0.0, *values))
    return Bars(title, "; ".join(f"{one.name} {one.told}" for one in rows), axis, rows)


def _cells(result: SweepResult) -> Iterator[Figure]:
    """The share, and the mean level, over two keys."""
    chart = result.chart
    if chart is None:
        return
    words = ((0, "none"), (1, "to a third"), (2, "to two thirds"), (3, "more"), (4, "all"), (None, "not computed"))
    for index, (what, shares) in enumerate(fields(chart)):
        classes = [[kind_of(share) for share in row] for row in shares]
        all_of_them = [one for row in classes for one in row]
        told = f"{what}, of {len(all_of_them)} cells: {all_of_them.count(4)} all, {all_of_them.count(0)} none"
        caption = f"{what[0].upper()}{what[1:]}: the larger the square, the more; a ring: none of the members there."
        field = _field(chart, f"{what[0].upper()}{what[1:]}", told, classes, words)
        yield Figure("cells-meets" if index else "cells", title_of(chart), field, caption)
    levels = [one for row in chart.levels_db or () for one in row if one is not None]
    if not levels or min(levels) == max(levels):
        return
    low, step = min(levels), (max(levels) - min(levels)) / STEPS
    classes = [[None if one is None else min(1 + int((one - low) / step), STEPS) for one in row]
               for row in chart.levels_db or ()]  # fmt: skip
    louder = (*((k, f"to {db(low + k * step)}") for k in range(1, STEPS + 1)), (None, "not computed"))
    told = f"mean level over {len(levels)} cells, from {db(low)} to {db(max(levels))}"
    caption = "Mean velocity level of the members of a cell, 0 dB = 5e-8 m/s rms: the larger the square, the louder."
    field = _field(chart, "Mean level over two values", told, classes, louder)
    yield Figure("cells-level", title_of(chart), field, caption)


def _field(
    chart: Chart, title: str, told: str, classes: Sequence[Sequence[int | None]],
    words: Sequence[tuple[int | None, str]],
) -> Cells:  # fmt: skip
    columns, rows = few(len(chart.x), WIDE), few(len(chart.y), HIGH)
    shown = [[classes[row][column] for column in columns] for row in rows]
    seen = {one for row in shown for one in row}
    return Cells(
        title, told, _axis(chart.x_key), _axis(chart.y_key), [label_of(chart.x[k]) for k in columns],
        [label_of(chart.y[k]) for k in rows], shown, [one for one in words if one[0] in seen],
    )  # fmt: skip


def _axis(key: str) -> str:
    unit = unit_of(re.sub(r"\[\d+\]$", "", key)) or "1"
    return f"{key} [{unit}]"
