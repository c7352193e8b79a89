"""The report of `abu optimise`: the recommended design, the front of cost against share, runners-up, costs."""

from collections.abc import Mapping, Sequence
from typing import Any, Final

from abu_calc.features.optimise.answers import short
from abu_calc.features.optimise.result import FrontPoint, OptimiseResult
from abu_calc.foundation.units import unit_of
from abu_calc.inputs.reading.text import shown_short
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Curve, Extras, Figure, MarkedPoint, Plot
from abu_calc.reporting.parts import check_blocks, file_of, notices, options_of, provenance_blocks
from abu_calc.reporting.screen import one_screen
from abu_calc.sizing.actions import set_options

RULE: Final = (
    "Rule: least cost of all candidates whose share in the race is at least the wanted one by its lower bound (risk "
    "0.5 %). Fresh samples then give the share of the recommended design."
)
FALLBACK: Final = "No candidate is proven to reach the wanted share: this is the highest share found."
LABELS: Final = {
    "ball_count": "Balls", "ball_diameter_mm": "Ball diameter", "race_radius_mm": "Race radius",
    "race_eccentricity_mm": "Eccentricity, at most", "rolling_friction_mm": "Rolling friction, lever arm",
    "rolling_drag_per_s": "Viscous drag rate at 40 °C", "race_hardness_HRC": "Race hardness", "design": "Construction",
    "time_s": "Run-up time",
}  # fmt: skip


def percent(share: float) -> str:
    """A share as text; 100 % only where it is.

    >>> percent(0.9987), percent(0.99998), percent(1.0)
    ('99.87 %', '99.99 %', '100 %')
    """
    if share == 1:
        return "100 %"
    return f"{min(100 * share, 99.99):.2f} %" if share >= 0.99 else f"{100 * share:.1f} %"


def optimise_blocks(result: OptimiseResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        *_design(result),
        *_front(result),
        *_runners_up(result),
        *_options(result),
        *_costs(result),
        *_scatter(result),
        *_ruled_out(result),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def optimise_screen(result: OptimiseResult) -> tuple[Block, ...]:
    """Verdict, design, front, runners-up, options."""
    body = [*_design(result), *_front(result), *_runners_up(result), *_options(result)]
    more = ("--write FILE, this design as a machine file",)
    return one_screen(result, _about(result), body, more)


def _about(result: OptimiseResult) -> list[Block]:
    fresh, recommended = result.recommended.fresh_share, result.recommended
    if fresh is None:
        share = "no fresh samples were computed"
    else:
        share = (
            f"{percent(fresh.value)} of {fresh.of} fresh samples meet the limits (95 % confidence: "
            f"{percent(fresh.low)} to {percent(fresh.high)}); wanted: {percent(result.share)}"
        )
    least = " of the machine that meets them least" if len(result.files) > 1 else ""
    lines: list[Block] = [
        Heading(f"{result.title}: optimum of a series"),
        Paragraph(f"Cost {recommended.cost:.3f} (1: a usual housing with its race): {share}{least}.", result.status),
    ]
    if len(result.files) > 1:
        parts = ", ".join(result.share_parts) or "nothing"
        lines.append(Paragraph(f"Machines: {', '.join(result.files)}. They share: {parts}."))
    lines.append(
        Paragraph(
            f"{result.evaluated} candidates of {result.considered} combinations, {result.samples} samples in "
            f"{result.rounds} rounds, seed {result.seed}. {'' if recommended.proven else FALLBACK}".rstrip()
        )
    )
    return lines


def _values(values: Mapping[str, Any]) -> tuple[tuple[str, str, str], ...]:
    rows = []
    for key, value in values.items():
        name = short(key)
        unit = unit_of(name)
        rows.append((LABELS.get(name, key), "", f"{shown_short(value)} {unit}".rstrip()))
    return tuple(rows)


def _by_machine(result: OptimiseResult) -> Mapping[str, Mapping[str, Any]]:
    values = result.recommended.set_
    return values if len(result.files) > 1 else {file_of(result): values}


def _design(result: OptimiseResult) -> list[Block]:
    blocks: list[Block] = [Heading("Recommended design", "recommended")]
    for name, values in _by_machine(result).items():
        if len(result.files) > 1:
            blocks.append(Paragraph(f"{name}:"))
        blocks.append(Facts(_values(values)))
        command = f"abu size {name}{options_of(result.provenance)} {set_options(values)}"
        blocks.append(Paragraph(command, indent=2, whole=True))
    return blocks


def _interval(point: FrontPoint) -> str:
    return f"{percent(point.low)} to {percent(point.high)}"


def _front(result: OptimiseResult) -> list[Block]:
    """Table of the front; the recommended one is marked."""
    points, best = result.front, result.recommended
    header = ("", "cost", "share", "95 % confidence", "samples", "change from the line above")
    rows = []
    for place, point in enumerate(points):
        mark = "→" if point.set_ == best.set_ else ""
        buys = "" if not place else f"{'; '.join(point.changes)}"
        rows.append((mark, f"{point.cost:.3f}", percent(point.share), _interval(point), str(point.samples), buys))
    blocks: list[Block] = [
        Heading("Front: no cheaper design has a higher share", "front"),
        Grid(header, tuple(rows), frozenset({1, 2, 3, 4})),
    ]
    if len(points) == 1:
        blocks.append(Paragraph("No other design is cheaper, or has a higher share."))
    return blocks


def _runners_up(result: OptimiseResult) -> list[Block]:
    rows = tuple(
        (f"{point.cost:.3f}", percent(point.share), _interval(point), point.why_not, "; ".join(point.changes))
        for point in result.runners_up
    )
    if not rows:
        return []
    header = ("cost", "share", "95 % confidence", "why not", "change from the recommended one")
    return [Heading("Runners-up", "runners-up"), Grid(header, rows, frozenset({0, 1, 2}))]


def _options(result: OptimiseResult) -> list[Block]:
    source = ", default list (--choose replaces it)" if any(option.default for option in result.options) else ""
    rows = tuple((option.name, ", ".join(option.values)) for option in result.options)
    return [Heading(f"Choices{source}", "choices"), Grid(("value", "choices"), rows)]


def _costs(result: OptimiseResult) -> list[Block]:
    text = (
        "Relative units: 1 is about the housing of a hand grinder with its race. Costs that all candidates share are "
        "left out. [costs] of the file replaces them."
    )
    rows = tuple((entry.key, entry.formula, entry.source) for entry in result.costs)
    return [Heading("Costs", "costs"), Paragraph(text), Grid(("value", "cost", "source"), rows), Paragraph(RULE)]


def _scatter(result: OptimiseResult) -> list[Block]:
    which = "of the recommended design" if len(result.files) == 1 else f"of {result.files[0]}, recommended design"
    rows = tuple(result.scatter.items())
    return [Heading(f"Scatter {which}", "scatter"), Grid(("value", "distribution"), rows)]


def _ruled_out(result: OptimiseResult) -> list[Block]:
    rows = tuple((entry.code, entry.name, str(entry.combinations)) for entry in result.ruled_out)
    if not rows:
        return []
    header = ("check", "name", "combinations")
    return [Heading("Combinations that closed forms rule out", "ruled-out"), Grid(header, rows, frozenset({2}))]


def optimise_extras(result: OptimiseResult) -> Extras:
    """The figure of the front."""
    return Extras((Figure("front", "front", front_plot(result), CAPTION),))


CAPTION: Final = (
    "Share of the samples that meets all limits against cost. Vertical lines: 95 % confidence interval of each share; "
    "of the recommended design the interval of its fresh samples. The dashed line is the wanted share."
)


def front_plot(result: OptimiseResult) -> Plot:
    """The front with intervals, runners-up, and the recommended design by its fresh samples."""
    best, fresh = result.recommended, result.recommended.fresh_share
    points = [MarkedPoint(p.cost, 100 * p.share, "", 1) for p in result.front if p.set_ != best.set_]
    points += [MarkedPoint(p.cost, 100 * p.share, "runner-up", 3) for p in result.runners_up]
    low, high, value = (best.low, best.high, best.share) if fresh is None else (fresh.low, fresh.high, fresh.value)
    points.append(MarkedPoint(best.cost, 100 * value, "recommended", 2))
    bars = [(p.cost, p.low, p.high) for p in result.front if p.set_ != best.set_]
    bars.append((best.cost, low, high))
    lines = [Curve([(cost, 100 * bottom), (cost, 100 * top)], "", 1) for cost, bottom, top in bars]
    lines.append(Curve([(p.cost, 100 * p.share) for p in result.front], "", 1))
    everything: Sequence[float] = [
        *(100 * bound for _, *bounds in bars for bound in bounds), *(point.y for point in points), 100 * result.share,
    ]  # fmt: skip
    up = Axis.around("share of machines that meets the limits [%]", everything)
    texts = [f"cost {p.cost:.3f}: {percent(p.share)}" for p in result.front]
    limit = (100 * result.share, f"wanted {number(100 * result.share, 4)} %")
    across = Axis.around("cost [relative]", [point.x for point in points])
    summary = f"{'; '.join(texts)}; recommended: cost {best.cost:.3f}, {percent(value)}"
    up = up._replace(high=min(up.high, 101.0))
    return Plot("Front of cost against share", summary, across, up, lines, points, limit)
