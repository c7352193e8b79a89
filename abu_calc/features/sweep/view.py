"""The report of `abu sweep`: share that meets the limits, spread of the numbers, deciding values.

Shares are drawn as bars, and over two keys as a chart of signs.
"""

from collections.abc import Sequence
from typing import Final

from abu_calc.features.sweep.result import Chart, DecidingValue, Price, Sensitivity, SweepResult
from abu_calc.foundation.units import unit_of
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.parts import check_blocks, notices, provenance_blocks
from abu_calc.reporting.screen import many, one_screen

NAMED: Final = 5
"""Most values that vary which are named."""
BAR: Final = 24
"""Signs of a bar that is full."""
FULL: Final = "█"
SIGNS: Final = "·░▒▓█"
"""No sample, up to a third and so on, and every sample."""
WIDE: Final = 60
HIGH: Final = 24
"""The most columns and rows of a chart."""
Shares = Sequence[Sequence[float | None]]
WORDS: Final = {"balances": "the share that balances", "meets_limits": "the share that meets the limits"}


def bar(share: float) -> str:
    """A share as a bar.

    >>> bar(0.25)
    '██████'
    """
    return FULL * round(BAR * min(max(share, 0.0), 1.0))


def sign(share: float | None) -> str:
    """A share as one sign.

    >>> "".join(sign(share) for share in (None, 0.0, 0.1, 0.5, 0.9, 1.0))
    ' ·░▒▓█'
    """
    kind = kind_of(share)
    return " " if kind is None else SIGNS[kind]


def kind_of(share: float | None) -> int | None:
    """0: none, 1 to 3: a third of the samples each, 4: all of them."""
    if share is None:
        return None
    return 0 if share <= 0 else 4 if share >= 1 else min(1 + int(3 * share), 3)


def title_of(chart: Chart) -> str:
    """Title of a chart: one key over the other."""
    return f"{chart.y_key} over {chart.x_key}"


def chart_blocks(chart: Chart, *, short: bool = False) -> list[Block]:
    """Each field of the chart; `short`: one of them, where not all cells are alike if there is such a one."""
    panels = fields(chart)
    if short:
        panels = [next((panel for panel in panels if len(_kinds(panel[1])) > 1), panels[0])]
    return [Heading(title_of(chart), "chart"), *(_picture(chart, *panel) for panel in panels)]


def _kinds(shares: Shares) -> set[int | None]:
    return {kind_of(share) for row in shares for share in row} - {None}


def fields(chart: Chart) -> list[tuple[str, Shares]]:
    """Fields of a chart: a description and the shares.

    The shares are those that balance, and those that meet all limits if that asks for more.
    """
    panels: list[tuple[str, Shares]] = [(WORDS[chart.of], chart.shares)]
    return panels if chart.meets is None else [*panels, (WORDS["meets_limits"], chart.meets)]


def _picture(chart: Chart, what: str, shares: Shares) -> Picture:
    """The second key upward, and what the signs mean."""
    columns, rows = few(len(chart.x), WIDE), few(len(chart.y), HIGH)
    width = max(1, WIDE // max(len(columns), 1) // 2) if len(columns) <= WIDE // 2 else 1
    labels = [label_of(chart.y[row]) for row in rows]
    margin = max(map(len, labels))
    lines = [
        f"{label:>{margin}} {''.join(sign(shares[row][column]) * width for column in columns)}"
        for label, row in reversed(list(zip(labels, rows, strict=True)))
    ]
    first, last = label_of(chart.x[columns[0]]), label_of(chart.x[columns[-1]])
    gap = max(width * len(columns) - len(first) - len(last), 1)
    lines.append(" " * (margin + 1) + first + " " * gap + last)
    about = f"{what}: {SIGNS[0]} none, ░ to a third, ▒ to two thirds, ▓ more, {FULL} all"
    shown = "" if len(columns) == len(chart.x) and len(rows) == len(chart.y) else "; not every value is shown"
    return Picture(tuple(lines), f"{about[0].upper()}{about[1:]}{shown}.", 2)


def few(count: int, most: int) -> list[int]:
    """Places of at most so many of a list, evenly through it."""
    step = -(-count // most)
    return list(range(0, count, step))


def label_of(value: float | str) -> str:
    """A value on an axis."""
    return value if isinstance(value, str) else number(float(value))


MATTER = 0.01
"""A value whose total index is below is only counted."""
MOST = 8
"""Values with a bar on one screen."""
MEMBERS = {
    "build": ("machine built to one design", "machines built to one design"),
    "design": ("machine, designed anew,", "machines, each designed anew,"),
    "scene": ("run", "runs"),
}
LIMITS = {
    "balances": "balances",
    "none_hangs": "no ball stalls",
    "meets_level": "level within limit",
    "meets_settling": "quiet time within limit",
    "meets_limits": "all limits",
}
LOOSE = "may be loosened"
TIGHTEN = (
    "Change of the level that 95 % of the samples keep, if the value stays in its better half, and in the other half. "
    "Both rest on the samples computed. Chance: so few samples may show that change by chance."
)
LOOSEN = (
    "Values with little influence at their present scatter, each tried alone: {} of the samples are repeated with "
    "twice the scatter. Loosen: the level that 95 % keep rises by at most 0.5 dB, and no more samples fail."
)


def sweep_blocks(result: SweepResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        *_helps(result, len(result.advice)),
        *_limits(result),
        *_failing(result),
        *_basins(result),
        *_numbers(result),
        *(chart_blocks(result.chart) if result.chart else ()),
        *(block for name in result.sensitivity_by_quantity for block in _decides(result, name, None)),
        *_prices(result),
        *_failed(result),
        *_varied(result),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def sweep_screen(result: SweepResult) -> tuple[Block, ...]:
    """Verdict, shares, numbers, chart or what decides."""
    first = result.sensitivity_of
    some = any(basin.share < 1 for basin in result.basins)
    body = [*_helps(result, 1), *_limits(result), *_failing(result), *(_basins(result) if some else ()),
            *_numbers(result)]  # fmt: skip
    if result.chart:
        body = [*chart_blocks(result.chart, short=True), *body]
    elif first:
        body += _decides(result, first, MOST)
    # Advice on the level is no answer where a limit fails.
    body += [*([] if result.failed_limits else _prices(result, short=True)), *_failed(result)]
    more = () if result.store else ("--store FILE.sqlite, every sample",)
    return one_screen(result, _about(result), body, more)


def _about(result: SweepResult) -> list[Block]:
    met = result.meets_limits
    low, high = met.confidence_interval
    does = "balance" if result.what == "scene" else "meet the limits"
    confidence = f"95 % confidence: {percent(low)} to {percent(high)}"
    singular, plural = MEMBERS[result.what]
    failed = "" if met.share == 1 else f"{round(met.of * (1 - met.share))} of {met.of} do not."
    text = f"{percent(met.share)} of {met.of} {plural} {does} ({confidence}). {failed}".rstrip()
    if met.of == 1:
        verb = does.replace("meet", "meets").replace("balance", "balances") if met.share else f"does not {does}"
        text = f"1 {singular} {verb} ({confidence})."
    kept = f" Samples: {result.store}." if result.store else ""
    keys = dict.fromkeys("the start" if value.key.startswith("start.") else value.key for value in result.varied)
    varied = f"varied: {', '.join(keys)}" if len(keys) <= NAMED else f"{len(keys)} values vary"
    return [
        Heading(f"{result.title}: sweep"),
        Paragraph(text, _mark(result)),
        Paragraph(f"Sampling: {result.sampling}, seed {result.seed}; {varied}.{kept}"),
    ]


def _mark(result: SweepResult) -> str:
    share = result.checks[-1].status
    return result.status if result.status != "pass" else share


def percent(share: float) -> str:
    """A share as text; it says 100 % only where it is."""
    return f"{100 * share:.3g} %" if share < 0.995 or share == 1 else f"{100 * share:.2f} %"


def _limits(result: SweepResult) -> list[Block]:
    rows = tuple(
        (LIMITS[name], percent(share.share), "{} to {}".format(*map(percent, share.confidence_interval)))
        for name, share in result.meets_limits.each.items()
    )
    if len(rows) < 2:
        return []
    return [Heading("Each limit", "each-limit"), Grid(("", "share", "95 % confidence"), rows, frozenset({1, 2}))]


def _numbers(result: SweepResult) -> list[Block]:
    rows = tuple(
        (words_of(name), *(_number(value) for value in (stats.p05, stats.p50, stats.p95, stats.mean)), unit_of(name))
        for name, stats in result.quantities.items()
    )
    return [
        Heading("Percentiles", "percentiles"),
        Grid(("", "5 %", "50 %", "95 %", "mean", ""), rows, frozenset({1, 2, 3, 4})),
    ]


def words_of(name: str) -> str:
    """A name without its unit, as words."""
    for unit in ("_db", "_s", "_um", "_g_mm", "_mm", "_g"):
        if name.endswith(unit):
            name = name.removesuffix(unit)
            break
    return name.replace("_", " ")


def _number(value: float | None) -> str:
    return "none" if value is None else number(value)


def _decides(result: SweepResult, name: str, most: int | None) -> list[Block]:
    """The values that matter as bars, the others counted."""
    sensitivities = result.sensitivity_by_quantity[name]
    matter = [sensitivity for sensitivity in sensitivities if sensitivity.total >= MATTER][:most]
    left, rest = len(sensitivities) - len(matter), result.unexplained.get(name, 0.0)
    tail = [f"{many(left, 'other value has', 'other values have')} less influence."] if left else []
    unexplained = f"{percent(rest)} of the variance follows from no single value or pair of values."
    tail += [unexplained] if rest >= MATTER else []
    head = Heading(f"{words_of(name).capitalize()}: deciding values, share of its variance", section_deciding(name))
    body: list[Block] = (
        [Grid(("value", "", "alone", "with others"), tuple(map(_row, matter)), frozenset({2, 3}))] if matter else []
    )
    if not matter:
        body = [Paragraph("No value that varies decides it.")]
        tail = tail[1:]
    return [head, *body, *([Paragraph(" ".join(tail))] if tail else [])]


def section_deciding(name: str) -> str:
    """Id of the section of the values that decide a number."""
    return f"decides-{name.replace('_', '-')}"


def _row(sensitivity: Sensitivity) -> tuple[str, ...]:
    return sensitivity.key, bar(sensitivity.total), f"{sensitivity.first_order:.2f}", f"{sensitivity.total:.2f}"


def _prices(result: SweepResult, *, short: bool = False) -> list[Block]:
    """Tables of the values to tighten and of those that may be loosened.

    The first rests on the samples that lie there, the second on samples that were computed once more.
    """
    tight = [price for price in result.prices if price.advice == "tighten" or not short]
    loose = [price for price in result.prices if price.loosened_of and (price.advice == LOOSE or not short)]
    blocks: list[Block] = []
    if tight:
        rows = tuple(map(_tight, sorted(tight, key=lambda price: (price.advice != "tighten", -price.gain_db))))
        header = ("value", "keep", "95 % level", "other half", *(() if short else ("",)))
        grid = Grid(header, tuple(row[: len(header)] for row in rows), frozenset({2, 3}))
        blocks += [Heading("Values to tighten", "tighten"), *(() if short else (Paragraph(TIGHTEN),)), grid]
    if loose:
        rows = tuple(map(_loose, sorted(loose, key=lambda price: (price.advice != LOOSE, price.loosened_db or 0.0))))
        header = ("value", "tried with", "95 % level", "more fail", *(() if short else ("",)))
        grid = Grid(header, tuple(row[: len(header)] for row in rows), frozenset({2, 3}))
        blocks += [
            Heading("Values that may be loosened", "loosen"),
            *(() if short else (Paragraph(LOOSEN.format(loose[0].loosened_of)),)),
            grid,
        ]
    return blocks


def _tight(price: Price) -> tuple[str, ...]:
    """Table row: level gained within the better half of a value, and level lost in the other half."""
    other = "" if price.cost_db is None else change(price.cost_db)
    word = "tighten" if price.advice == "tighten" else "chance" if price.within_chance else ""
    return price.key, side_kept(price), change(-price.gain_db), other, word


def side_kept(price: Price) -> str:
    """Range in which a value is to be kept."""
    return f"{'to' if price.better == 'lower' else 'from'} {number(price.median)} {unit_of(price.key)}".rstrip()


def _loose(price: Price) -> tuple[str, ...]:
    """Table row: effect of twice the scatter."""
    word = "loosen" if price.advice == LOOSE else "leave"
    return price.key, price.loosened_to or "", change(price.loosened_db), str(price.loosened_fail), word


def change(level: float | None) -> str:
    """Change of a level, as text."""
    return "none" if level is None else f"{round(level, 1) + 0.0:+.1f} dB"


def _failing(result: SweepResult) -> list[Block]:
    """Limits that fail with the values that decide their margins, and the changes that raise the share."""
    if not result.failed_limits:
        return []
    rows = [
        (LIMITS[limit.limit] if not place else "", str(limit.failed) if not place else "",
         row.key.removeprefix("autobalancer."),
         f"{row.total:.2f}", row.fails_at)
        for limit in result.failed_limits
        for place, row in enumerate(limit.decides or (NO_VALUE,))
    ]  # fmt: skip
    header = ("failed limit", "fail", "deciding value", "of margin", "fails at")
    blocks: list[Block] = [Heading("What fails", "failing"), Grid(header, tuple(rows), frozenset({1, 3}))]
    if not result.advice and result.tried:
        tried = many(result.tried, "change was", "changes were")
        blocks.append(Paragraph(f"{tried} tried; none raises the share."))
    return blocks


def _helps(result: SweepResult, commands: int) -> list[Block]:
    """Changes that raise the share, the best first; so many with the whole command that follows them."""
    if not result.advice:
        return []
    blocks: list[Block] = [Heading(f"What helps, tried on the same {result.advice[0].of} samples", "helps")]
    for place, change in enumerate(result.advice):
        blocks.append(Paragraph(f"{percent(change.before)} → {percent(change.after)}: {change.change}", hang=2))
        blocks += [Paragraph(change.next, whole=True)] if place < commands else []
    return blocks


NO_VALUE: Final = DecidingValue(key="no value that varies", total=0.0, fails_at="")


def _basins(result: SweepResult) -> list[Block]:
    """The share of starts that balance, by the kind of start."""
    rows = tuple(
        (basin.start, percent(basin.share), "{} to {}".format(*map(percent, basin.confidence_interval)), str(basin.of))
        for basin in result.basins
    )
    if len(rows) < 2:
        return []
    header = ("start case", "share", "95 % confidence", "runs")
    return [Heading("Start cases that balance", "basins"), Grid(header, rows, frozenset({1, 2, 3}))]


def _failed(result: SweepResult) -> list[Block]:
    rows = tuple((str(failure.members), str(failure.first), failure.reason) for failure in result.failed.reasons)
    if not rows:
        return []
    return [Heading("Samples without a result"), Grid(("samples", "first", "reason"), rows, frozenset({0, 1}))]


def _varied(result: SweepResult) -> list[Block]:
    rows: Sequence[tuple[str, str]] = [(factor.key, factor.how) for factor in result.varied]
    return [Heading("Varied values"), Grid(("value", "distribution"), tuple(rows))]
