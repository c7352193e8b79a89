"""Blocks and figure of the attractors that starts reach, and of the closed stuck speeds beside them."""

from collections.abc import Iterator

from abu_calc.features.stability.attractors import Attractor, AttractorSearch
from abu_calc.features.stability.study import StabilityResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, db
from abu_calc.reporting.charts.figure import Figure

NOTE = (
    "Closed: all balls of a race together, drag against dissipation, without friction and gravity. The last speed, "
    "near the rotor's, is that of balls which turn with the race and may spread."
)


def attractor_blocks(result: StabilityResult) -> Iterator[Block]:
    """Table of attractors, closed stuck speeds, commands, criterion."""
    groups, searched = result.attractors or (), result.attractor_search
    if searched is None:
        return
    yield Heading("Attractors: where starts end", "attractors")
    drawn, left = f"{searched.drawn_starts} drawn by lot (seed {searched.seed})", searched.undecided_starts
    yield Paragraph(f"Starts: {drawn}, {searched.designed_starts} designed; {left or 'none'} without a decided end.")
    rows = tuple(_row(group) for group in groups)
    yield Grid(("end", "share of drawn", "95 % interval", "balls at, rpm", "level, dB"), rows, frozenset({1}))
    if searched.stuck_speeds:
        yield Paragraph(_closed(searched))
    yield Heading("Starts to run again", "examples")
    for group in groups:
        sure = "" if group.example.confirmed else " (a closer run of it ends elsewhere)"
        yield Paragraph(f"{group.kind}{sure}: `{group.example.command or 'no command: the scene has no file'}`")
    for reason in searched.undecided_reasons:
        yield Paragraph(f"No decided end: {reason}.")
    yield Heading("Criterion of attractors", "criterion")
    yield Paragraph(searched.criterion)
    yield Paragraph(NOTE)


def _row(group: Attractor) -> tuple[str, ...]:
    speeds = sorted({number(speed, 4) for speed in group.ball_speeds_rpm}, key=float)
    return (
        f"{group.kind}: {group.text}" if group.kind in ("limit-cycle",) else group.text,
        f"{group.share:.1%}",
        f"{group.low:.1%} … {group.high:.1%}",
        ", ".join(speeds),
        "none" if group.level_db is None else f"{group.level_db:.1f}",
    )


def _closed(searched: AttractorSearch) -> str:
    """Closed stuck speeds in a sentence."""
    speeds = ", ".join(
        f"{number(each.speed_rpm, 5)}{'' if each.holds else ' (does not hold)'}" for each in searched.stuck_speeds
    )
    natural = ", ".join(number(each, 5) for each in searched.natural_frequencies_rpm)
    return f"Closed stuck speeds of balls together, rpm: {speeds}. Natural frequencies with the balls, rpm: {natural}."


def attractor_figure(result: StabilityResult) -> Iterator[Figure]:
    """Shares of drawn starts with their intervals."""
    groups = result.attractors
    if not groups:
        return
    rows = tuple(
        Bar(
            f"{group.text}{'' if group.level_db is None else f', {db(group.level_db)}'}", 100 * group.share,
            f"{group.share:.1%}", 1 if group.kind == "balanced" else 2, 0.0, (100 * group.low, 100 * group.high),
        )
        for group in groups
    )  # fmt: skip
    summary = "; ".join(f"{group.text}: {group.share:.1%}" for group in groups)
    chart = Bars("Where starts end", summary, Axis("share of drawn starts [%]", 0.0, 100.0), rows)
    caption = "Share of the starts drawn by lot that end in each state, with 95 % intervals."
    yield Figure("attractors", "attractors", chart, caption)
