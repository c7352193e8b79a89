"""Figures of `abu sweep`: shares, numbers against samples, deciding values and prices, two-key chart."""

import re
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.features.sweep.result import Chart, Distribution, Price, Sensitivity, SweepResult
from abu_calc.features.sweep.view import (
    LIMITS,
    LOOSE,
    MATTER,
    change,
    few,
    fields,
    kind_of,
    label_of,
    percent,
    section_deciding,
    side_kept,
    words_of,
)
from abu_calc.foundation.checks import first_of
from abu_calc.foundation.units import unit_of
from abu_calc.reporting.blocks import capitalised, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Cells, Curve, Extras, Figure, MarkedPoint, Plot, db

MOST: Final = 8
"""Values with a bar."""
NAMED: Final = (5.0, 50.0, 95.0)
"""Percentiles that are written into a figure."""
WIDE: Final = 60
HIGH: Final = 40
"""The most cells beside and above one another."""
STEPS: Final = 4
CLEAR: Final = 0.15
"""Share of an axis that words leave clear beside the limit."""


def sweep_extras(result: SweepResult) -> Extras:
    """The figures; what was computed stands in the report."""
    figures = (
        *_shares(result), *_basins(result), *_distributions(result), *_cells(result), *_decides(result),
        *_tighten(result), *_loosen(result),
    )  # fmt: skip
    return Extras(figures)


def _shares(result: SweepResult) -> Iterator[Figure]:
    """Figure of the share that meets each limit, and all limits, with the confidence interval."""
    met, check = result.meets_limits, first_of(result.checks, "share_within_limits")
    rows = [
        Bar(LIMITS[name], 100 * share.share, percent(share.share), 1, span=_hundredths(share.confidence_interval))
        for name, share in met.each.items()
    ]
    rows.append(
        Bar("meets all limits", 100 * met.share, percent(met.share), 2, span=_hundredths(met.confidence_interval))
    )
    limit = None if check is None or check.limit is None else (check.limit, f"at least {number(check.limit, 3)} %")
    summary = "; ".join(f"{bar.name} {bar.text}" for bar in rows) + (f"; {limit[1]}" if limit else "")
    caption = (
        f"Share of {met.of} members that keeps each limit; the thin line is the 95 % confidence interval of the share"
        f"{': for all limits it should end right of the dashed line' if limit else ''}."
    )
    chart = Bars("Share that meets the limits", summary, Axis("share of members [%]", 0.0, 100.0), rows, limit)
    yield Figure("shares", "each-limit" if len(met.each) > 1 else "", chart, caption)


def _hundredths(interval: tuple[float, float]) -> tuple[float, float]:
    return 100 * interval[0], 100 * interval[1]


def _basins(result: SweepResult) -> Iterator[Figure]:
    rows = [
        Bar(basin.start, 100 * basin.share, percent(basin.share), 1, span=_hundredths(basin.confidence_interval))
        for basin in result.basins
    ]
    if len(rows) < 2:
        return
    summary = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
    caption = "Share of starts that balances, by how the machine is switched on; the thin line: 95 % confidence."
    axis = Axis("share of starts [%]", 0.0, 100.0)
    yield Figure("basins", "basins", Bars("Starts that balance", summary, axis, rows), caption)


def _distributions(result: SweepResult) -> Iterator[Figure]:
    """Each number against the share of members that keep it."""
    for name, curve in result.distributions.items():
        known = [(share, value) for share, value in zip(curve.percent, curve.values, strict=True) if value is not None]
        if len(known) < 2:
            continue
        yield Figure(f"percentiles-{name}", "percentiles", _distribution(name, curve, known), _kept(name, curve, known))


def _distribution(name: str, curve: Distribution, known: Sequence[tuple[float, float]]) -> Plot:
    unit = unit_of(name)
    title = words_of(name).capitalize()
    limit = None if curve.limit is None else (curve.limit, f"limit {number(curve.limit)} {unit}".rstrip())
    bound = [] if curve.limit is None else [curve.limit]
    up = Axis.around(f"{words_of(name)} [{unit or '1'}]", [*(y for _, y in known), *bound])
    across = Axis("share of members [%]", 0.0, 100.0)
    points = [MarkedPoint(x, y, "" if _hidden(up, y, curve.limit) else number(y)) for x, y in known if x in NAMED]
    summary = "; ".join(f"{x:g} % of the members at most {number(y)} {unit}".rstrip() for x, y in known if x in NAMED)
    summary += f"; {limit[1]}" if limit else ""
    return Plot(f"{title} of the members", summary, across, up, (Curve(known),), points, limit)


def _hidden(up: Axis, value: float, limit: float | None) -> bool:
    """True if a word at this value would overlap the limit's word."""
    return limit is not None and abs(up.share(value) - up.share(limit)) < CLEAR


def _kept(name: str, curve: Distribution, known: Sequence[tuple[float, float]]) -> str:
    text = f"What the {words_of(name)} is at most in so many of the members; written: 5, 50 and 95 %"
    if curve.limit is not None:
        text += "; the line should stay below the dashed limit as far to the right as may be"
    never = 100 - known[-1][0]
    return f"{text}{f'. In the last {never:g} % it is never reached' if never else ''}."


def _decides(result: SweepResult) -> Iterator[Figure]:
    for name, sensitivities in result.sensitivity_by_quantity.items():
        rows = [_share_of_variance(sensitivity) for sensitivity in sensitivities if sensitivity.total >= MATTER][:MOST]
        if not rows:
            continue
        summary = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
        caption = (
            f"Share of the variance of the {words_of(name)} that each value decides: the bar alone, to the end of the "
            "thin line together with others (written). The long bars are worth their money, the others are not."
        )
        axis = Axis("share of the variance [1]", 0.0, 1.0)
        chart = Bars(f"What decides the {words_of(name)}", summary, axis, rows)
        yield Figure(f"decides-{name}", section_deciding(name), chart, caption)


def _share_of_variance(index: Sensitivity) -> Bar:
    total = max(index.total, index.first_order)
    return Bar(index.key, index.first_order, f"{index.total:.2f}", 1, span=(index.first_order, min(total, 1.0)))


def _tighten(result: SweepResult) -> Iterator[Figure]:
    prices = sorted((price for price in result.prices if not price.within_chance), key=lambda price: -price.gain_db)
    rows = [
        Bar(f"{price.key} {side_kept(price)}", -price.gain_db, change(-price.gain_db), 1)
        for price in prices
    ]  # fmt: skip
    if rows:
        yield Figure("tighten", "tighten", _prices("What tightening gains", rows), (
            "By how much the level that 95 % of the members keep changes where a value is kept to its better half."
        ))  # fmt: skip


def _loosen(result: SweepResult) -> Iterator[Figure]:
    rows = [Bar(_tried(price), price.loosened_db, change(price.loosened_db), 1 if price.advice == LOOSE else 2)
            for price in result.prices if price.loosened_db is not None]  # fmt: skip
    if rows:
        of = next(price.loosened_of for price in result.prices if price.loosened_of)
        yield Figure("loosen", "loosen", _prices("What loosening costs", rows), (
            f"By how much the level that 95 % keep of {of} members rises where the scatter of one value is doubled."
        ))  # fmt: skip


def _tried(price: Price) -> str:
    return f"{price.key} {price.loosened_to}: {'may be' if price.advice == LOOSE else 'leave'}"


def _prices(title: str, rows: Sequence[Bar]) -> Bars:
    values = [bar.value for bar in rows]
    axis = Axis("change of the level [dB]", min(0.0, *values), max(0.5 if min(values) >= 0 else 0.0, *values))
    return Bars(title, "; ".join(f"{bar.name} {bar.text}" for bar in rows), axis, rows)


def _cells(result: SweepResult) -> Iterator[Figure]:
    """The share, and the mean level, over two keys."""
    chart = result.chart
    if chart is None:
        return
    words = ((0, "none"), (1, "to a third"), (2, "to two thirds"), (3, "more"), (4, "all"), (None, "not computed"))
    for index, (what, shares) in enumerate(fields(chart)):
        classes = [[kind_of(share) for share in row] for row in shares]
        all_of_them = [cell for row in classes for cell in row]
        summary = f"{what}, of {len(all_of_them)} cells: {all_of_them.count(4)} all, {all_of_them.count(0)} none"
        caption = f"{capitalised(what)}: the larger the square, the more; a ring: none of the members there."
        field = _field(chart, capitalised(what), summary, classes, words)
        yield Figure("cells-meets" if index else "cells", "chart", field, caption)
    levels = [level for row in chart.levels_db or () for level in row if level is not None]
    if not levels or min(levels) == max(levels):
        return
    low, step = min(levels), (max(levels) - min(levels)) / STEPS
    classes = [[None if level is None else min(1 + int((level - low) / step), STEPS) for level in row]
               for row in chart.levels_db or ()]  # fmt: skip
    louder = (*((k, f"to {db(low + k * step)}") for k in range(1, STEPS + 1)), (None, "not computed"))
    summary = f"mean level over {len(levels)} cells, from {db(low)} to {db(max(levels))}"
    caption = "Mean velocity level of the members of a cell, 0 dB = 5e-8 m/s rms: the larger the square, the louder."
    field = _field(chart, "Mean level over two values", summary, classes, louder)
    yield Figure("cells-level", "chart", field, caption)


def _field(
    chart: Chart, title: str, summary: str, classes: Sequence[Sequence[int | None]],
    words: Sequence[tuple[int | None, str]],
) -> Cells:  # fmt: skip
    columns, rows = few(len(chart.x), WIDE), few(len(chart.y), HIGH)
    shown = [[classes[row][column] for column in columns] for row in rows]
    seen = {cell for row in shown for cell in row}
    return Cells(
        title, summary, _axis(chart.x_key), _axis(chart.y_key), [label_of(chart.x[k]) for k in columns],
        [label_of(chart.y[k]) for k in rows], shown, [entry for entry in words if entry[0] in seen],
    )  # fmt: skip


def _axis(key: str) -> str:
    unit = unit_of(re.sub(r"\[\d+\]$", "", key)) or "1"
    return f"{key} [{unit}]"
