"""The report of `abu stability`, on one screen and whole: the verdict, its reasons, the speeds where it changes.

Figures: decay rate of disturbances over the speeds, eigenvalues, the formulas.

Blocks and figure of the attractors that starts reach, and of the closed stuck speeds beside them.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final

from abu_calc.dynamics.stability.boundaries import Crossing, StabilityBoundary
from abu_calc.features.explain.steps import STEPS, Step, step_blocks
from abu_calc.features.stability.attractors import Attractor, AttractorSearch
from abu_calc.features.stability.study import GrowthAt, Hanging, StabilityResult
from abu_calc.features.swing_arm.view import BOUNDS, arm_bounds, arm_line, motion_blocks, printed_otherwise
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Curve, Extras, Figure, MarkedPoint, Plot, alike, db
from abu_calc.reporting.parts import check_blocks, facts, file_of, notices, provenance_blocks, value_of
from abu_calc.reporting.screen import shortened

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


FORBIDDEN = (
    "A speed above the natural frequencies is necessary, not sufficient. Balls of finite mass lose the balanced state "
    "well above them, and light damping opens further instability regions."
)
ONE_STATE = (
    "The verdict holds for the balanced state and small disturbances. A start far from it, or a run-up, may end "
    "elsewhere."
)
WHAT_TELLS = (
    "A simulation shows it: `abu simulate FILE`, for a machine with --scene run-up and [run_up], for a scene with "
    "[scene.effects.run_up]."
)
ON_A_GRID = (
    "The search uses a grid of up to about five hundred speeds, refined where the growth rate bends or nears zero. It "
    "may miss an instability region far narrower than a hundredth of its speed."
)


def stability_blocks(result: StabilityResult) -> tuple[Block, ...]:
    """The whole report."""
    word, check = {True: "STABLE", False: "NOT STABLE", None: "NOT EVALUATED"}[result.stable], result.checks[0]
    mark = "warn" if _elsewhere(result) and check.status == "pass" else check.status
    rest = ("resting_angles_deg",) if result.resting_angles_deg else ()
    return (
        Heading(f"{result.title}: stability of the balanced state"),
        Paragraph(f"{word} at {value_of(result, 'speed_rpm')}{_elsewhere(result)}: {check.message}.", mark),
        *([Paragraph(result.consequence.text)] if result.consequence else []),
        *arm_line(result.arm_advice),
        facts(result, "growth_rate_per_s", "critical_damping_N_s_per_m", *rest),
        *((BOUNDS, arm_bounds(result.swing_arm)) if result.swing_arm else ()),
        *(motion_blocks(result.arm_motion) if result.arm_motion else []),
        *_hanging(result.hanging),
        *_values(Heading("Eigenvalues, 1/s", "eigenvalues"), result.eigenvalues),
        *_values(Heading("Floquet multipliers of one revolution", "multipliers"), result.floquet_multipliers),
        Heading("Speeds where stability changes", "changes"),
        *_boundaries(result),
        *_crossings(result.crossings_rpm),
        *check_blocks(result.checks),
        *notices(result),
        *(attractor_blocks(result) if result.attractors is not None else ()),
        Heading("Model", "model"),
        Paragraph(FORBIDDEN),
        *(printed_otherwise() if result.arm_motion else []),
        *provenance_blocks(result.provenance),
    )


def _elsewhere(result: StabilityResult) -> str:
    """Number of the drawn starts that do not end balanced; nothing if all do, or none was drawn."""
    other = sum(group.drawn_starts for group in result.attractors or () if group.kind != "balanced")
    if not other or result.attractor_search is None:
        return ""
    return f", but {other} of {result.attractor_search.drawn_starts} drawn starts end elsewhere"


def hanging_word(stall: Hanging) -> str:
    """Verdict on stalling: balls may stall, or none does."""
    drag = f"the viscous drag rate, {number(stall.drag_per_s, 3)} 1/s, is"
    return (
        f"Balls may stall: {drag} not above every bound."
        if stall.doubt
        else f"No ball stalls: {drag} above every bound."
    )


def _hanging(stall: Hanging | None) -> list[Block]:
    """States beside the balanced one: bounds on the viscous drag rate above which no ball stalls."""
    if stall is None:
        return [Paragraph(ONE_STATE)]
    rows = tuple(
        (bound.state, "any" if bound.drag_per_s is None else number(bound.drag_per_s, 3),
         "none" if bound.margin is None else number(bound.margin, 3))
        for bound in stall.bounds
    )  # fmt: skip
    word = hanging_word(stall) + (f" {WHAT_TELLS}" if stall.doubt else "")
    header = ("balls can stall", "at drag rates below, 1/s", "drag rate / bound")
    table: list[Block] = [Grid(header, rows, frozenset({1, 2}))] if rows else []
    return [Heading("Beside the balanced state", "beside"), Paragraph(ONE_STATE), Paragraph(word), *table]


def _crossings(crossings: Sequence[Crossing] | None) -> list[Block]:
    """A row for each."""
    if crossings is None:
        return []
    rows = tuple((number(row.speed_rpm, 6), f"{row.growing_below}", f"{row.growing_above}") for row in crossings)
    header = ("rpm", "growing eigenvalues below", "above")
    title = Heading("Speeds where an eigenvalue crosses, judged arrangement")
    return [title, Grid(header, rows, frozenset({0, 1, 2})) if rows else Paragraph("None.")]


def _values(heading: Heading, values: Sequence[tuple[float, float]] | None) -> list[Block]:
    """One row for a number and its conjugate."""
    if values is None:
        return []
    rows = tuple((number(re, 5), f"± {number(im, 5)}" if im else "") for re, im in values if im >= 0)
    return [heading, Grid(("real part", "imaginary part"), rows, frozenset({0, 1}))]


def _boundaries(result: StabilityResult) -> list[Block]:
    if result.boundaries_rpm is None:
        return [Paragraph("Not searched. `--speeds LOW:HIGH` finds them.")]
    searched = "{:g} to {:g}".format(*result.searched_rpm or ())
    block = _grid(result.boundaries_rpm) if result.boundaries_rpm else Paragraph(f"None from {searched} rpm.")
    solved_for = result.state == "balanced" and result.eigenvalues
    return [block] if solved_for else [block, Paragraph(ON_A_GRID)]


def _grid(boundaries: Sequence[StabilityBoundary]) -> Grid:
    """A row for each boundary."""
    rows = tuple((number(limit.speed_rpm, 6), "stable" if limit.stable_above else "not stable") for limit in boundaries)
    return Grid(("rpm", "above it"), rows, frozenset({0}))


LEFT_OUT = ("eigenvalues", "multipliers")
"""Ids of the sections that are left to the whole report."""
FOR_THE_ARM = (BOUNDS.id, "beside", "model")
"""Ids of the sections that make room for those of a swing arm."""


def stability_screen(result: StabilityResult) -> tuple[Block, ...]:
    """One screen: the whole report without the eigenvalues; their largest real part is the growth rate."""
    asked = result.boundaries_rpm is not None
    more: tuple[str, ...] = () if asked else ("--speeds LOW:HIGH, where stability changes",)
    blocks = stability_blocks(result)
    if result.arm_motion is None:
        return shortened(result, blocks, *LEFT_OUT, head=3 if result.arm_advice or result.consequence else 2, more=more)
    if result.swing_arm:
        more = (*more, f"`abu size {file_of(result)}`, the bounds of the arm")
    if result.hanging:
        first = next(k for k, block in enumerate(blocks) if k and isinstance(block, Heading))
        blocks = (*blocks[:first], Paragraph(hanging_word(result.hanging)), *blocks[first:])
    left_out = FOR_THE_ARM if asked else (*FOR_THE_ARM, "changes")
    return shortened(result, blocks, *LEFT_OUT, *left_out, head=3, more=more)


FORMULAS: Final = (
    "formulas.motion:equations", "formulas.slow_motion:resonance_drag", "formulas.slow_motion:side_by_side",
    "formulas.slow_motion:damped_drag", "formulas.slow_motion:gravity_drag",
)  # fmt: skip
RIM: Final = tuple((math.cos(math.tau * k / 90), math.sin(math.tau * k / 90)) for k in range(91))
"""Points of the circle within which multipliers die out."""


def stability_extras(result: StabilityResult) -> Extras:
    """Figures, and the calculation note."""
    figures = (*_over_speeds(result), *_eigenvalues(result), *_multipliers(result), *attractor_figure(result))
    keys = (*FORMULAS, *(STEPS["swing-arm"].keys if result.swing_arm else ()))
    step = Step("Stability of the balanced state", keys)
    return Extras(figures, tuple(step_blocks(step, _numbers(result))))


def _over_speeds(result: StabilityResult) -> Iterator[Figure]:
    """The growth rate, with the speeds shaded at which something grows."""
    course = result.growth_by_speed or ()
    if len(course) < 2:
        return
    points = [(growth.speed_rpm, growth.growth_rate_per_s) for growth in course]
    across = Axis("speed [rpm]", points[0][0], points[-1][0])
    marks = [MarkedPoint(boundary.speed_rpm, 0.0, "", 2) for boundary in result.boundaries_rpm or ()]
    here = result.growth_rate_per_s
    if here is not None and across.low <= result.speed_rpm <= across.high:
        marks.append(MarkedPoint(result.speed_rpm, here, "this speed"))
    up = Axis.around("growth rate [1/s]", [0.0, *(rate for _, rate in points), *(point.y for point in marks)])
    bands = _forbidden(course, result)
    changes = ", ".join(f"{boundary.speed_rpm:.0f} rpm" for boundary in result.boundaries_rpm or ()) or "no speed"
    summary = f"From {points[0][1]:.3g} 1/s at {points[0][0]:.0f} rpm to {points[-1][1]:.3g} 1/s at "
    summary += f"{points[-1][0]:.0f} rpm; stability changes at {changes}"
    caption = (
        "Growth rate of the slowest-dying disturbance of the balanced state: below zero the balls return to it, the "
        "lower the faster. Squares mark speeds where stability changes. Avoid shaded speeds."
    )
    chart = Plot(
        "Growth rate against speed", summary, across, up, (Curve(points),), marks, (0.0, "edge of stability"), bands
    )
    yield Figure("growth", "changes", chart, caption)


def _forbidden(course: Sequence[GrowthAt], result: StabilityResult) -> list[tuple[float, float]]:
    """Ranges of speed [rpm] between boundaries that are not stable."""
    low, high = course[0].speed_rpm, course[-1].speed_rpm
    inner = sorted(result.boundaries_rpm or (), key=lambda boundary: boundary.speed_rpm)
    if not inner:
        return [(low, high)] if course[0].growth_rate_per_s >= 0 else []
    ends = [low, *(boundary.speed_rpm for boundary in inner), high]
    stable = [not inner[0].stable_above, *(boundary.stable_above for boundary in inner)]
    return [(a, b) for a, b, safe in zip(ends, ends[1:], stable, strict=False) if not safe]


def _eigenvalues(result: StabilityResult) -> Iterator[Figure]:
    values = result.eigenvalues
    if not values:
        return
    across = Axis.around("real part [1/s]", [0.0, *(re for re, _ in values)])
    up = Axis.around("imaginary part [1/s]", [0.0, *(im for _, im in values)])
    edge = Curve(((0.0, up.low), (0.0, up.high)), "edge of stability", 2)
    summary = _in_words(values)
    chart = Plot("Eigenvalues", summary, across, up, (edge,), [MarkedPoint(*eigenvalue) for eigenvalue in values])
    caption = (
        "Eigenvalues of small motions about the balanced state at the speed judged: left of the dashed line they die "
        "out, the farther left the faster; up and down: how fast they swing."
    )
    yield Figure("eigenvalues", "eigenvalues", chart, caption)


def _multipliers(result: StabilityResult) -> Iterator[Figure]:
    values = result.floquet_multipliers
    if not values:
        return
    across, up = alike("real part", "imaginary part", [*RIM, *values])
    summary = _in_words(values)
    rim = Curve(RIM, "edge of stability", 2)
    chart = Plot(
        "Floquet multipliers", summary, across, up, (rim,), [MarkedPoint(*multiplier) for multiplier in values]
    )
    caption = (
        "Floquet multipliers of one revolution: inside the dashed circle a disturbance dies out, the nearer to the "
        "middle the faster."
    )
    yield Figure("multipliers", "multipliers", chart, caption)


def _in_words(values: Sequence[tuple[float, float]]) -> str:
    """One of a number and its conjugate."""
    return "; ".join(
        f"{number(re, 5)}, imaginary part ± {number(im, 5)}" if im else number(re, 5) for re, im in values if im >= 0
    )


def _numbers(result: StabilityResult) -> tuple[str, ...]:
    """The verdict's number, and the bounds of drag."""
    growth = "none" if result.growth_rate_per_s is None else f"{number(result.growth_rate_per_s)} 1/s"
    lines = [f"max Re λ = {growth} at {result.speed_rpm:.6g} rpm; stable below −1e-9·Ω"]
    if result.hanging is not None:
        lines += [
            f"{bound.state}: no ball stalls above h₀ = {number(bound.drag_per_s, 3)} 1/s; given "
            f"{number(result.hanging.drag_per_s, 3)} 1/s"
            for bound in result.hanging.bounds
            if bound.drag_per_s is not None
        ]
    if result.critical_damping_N_s_per_m is not None:
        lines.append(f"h_sh > {number(result.critical_damping_N_s_per_m)} N·s/m against parametric resonance")
    return tuple(lines)
