"""The report of `abu stability`: the verdict, what it rests on, and where it changes."""

from collections.abc import Sequence

from abu_calc.report.arm import BOUNDS, arm_bounds, arm_line, motion_blocks, printed_otherwise
from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.report.parts import check_blocks, facts, notices, provenance_blocks, value_of
from abu_calc.studies.design_records import StabilityBoundary
from abu_calc.studies.hanging import Hanging
from abu_calc.studies.stability import Crossing, StabilityResult

CHANGES = "Speeds where stability changes"
FORBIDDEN = (
    "A speed above the natural frequencies is necessary, not sufficient: balls of finite mass lose the balanced state "
    "well above them, and light damping opens further gaps."
)
ONE_STATE = (
    "This speaks of one state, the balanced one, and of small disturbances. A start far away, or a run-up, may end "
    "elsewhere."
)
WHAT_TELLS = (
    "What tells: `abu size`, or `abu simulate --scene run-up`; of a scene file, `abu simulate` with "
    "[scene.effects.run_up]."
)
ON_A_GRID = (
    "They were looked for on a grid of speeds, refined where the growth rate bends or comes near zero, at up to some "
    "five hundred speeds: a gap far narrower than a hundredth of its speed may be missed."
)


def stability_blocks(result: StabilityResult) -> tuple[Block, ...]:
    """The whole report."""
    word, check = {True: "STABLE", False: "NOT STABLE", None: "NOT JUDGED"}[result.stable], result.checks[0]
    rest = ("resting_angles_deg",) if result.resting_angles_deg else ()
    return (
        Heading(f"{result.title}: stability of the balanced state"),
        Paragraph(f"{word} at {value_of(result, 'speed_rpm')}: {check.message}.", check.status),
        *([Paragraph(result.consequence.text)] if result.consequence else []),
        *arm_line(result.arm_advice),
        facts(result, "growth_rate_per_s", "critical_damping_N_s_per_m", *rest),
        *((Heading(BOUNDS), arm_bounds(result.swing_arm)) if result.swing_arm else ()),
        *(motion_blocks(result.arm_motion) if result.arm_motion else []),
        *_hanging(result.hanging),
        *_values("Eigenvalues, 1/s", result.eigenvalues),
        *_values("Floquet multipliers of one revolution", result.floquet_multipliers),
        Heading(CHANGES),
        *_boundaries(result),
        *_crossings(result.crossings_rpm),
        *check_blocks(result.checks),
        *notices(result),
        Heading("Model"),
        Paragraph(FORBIDDEN),
        *(printed_otherwise() if result.arm_motion else []),
        *provenance_blocks(result.provenance),
    )


def hanging_word(stall: Hanging) -> str:
    """Verdict on stalling: balls may stall, or none does."""
    drag = f"the drag, {number(stall.drag_per_s, 3)} 1/s, is"
    return (
        f"Balls may hang: {drag} not above every bound." if stall.doubt else f"No balls hang: {drag} above every bound."
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
    header = ("balls hang", "below, 1/s", "the drag over it")
    table: list[Block] = [Grid(header, rows, frozenset({1, 2}))] if rows else []
    return [Heading("Beside the balanced state"), Paragraph(ONE_STATE), Paragraph(word), *table]


def _crossings(crossings: Sequence[Crossing] | None) -> list[Block]:
    """A row for each."""
    if crossings is None:
        return []
    rows = tuple((number(row.speed_rpm, 6), f"{row.growing_below}", f"{row.growing_above}") for row in crossings)
    header = ("rpm", "growing below", "growing above")
    title = Heading("Crossings of eigenvalues, of the arrangement judged")
    return [title, Grid(header, rows, frozenset({0, 1, 2})) if rows else Paragraph("None.")]


def _values(title: str, values: Sequence[tuple[float, float]] | None) -> list[Block]:
    """One row for a number and its conjugate."""
    if values is None:
        return []
    rows = tuple((number(re, 5), f"± {number(im, 5)}" if im else "") for re, im in values if im >= 0)
    return [Heading(title), Grid(("real part", "imaginary part"), rows, frozenset({0, 1}))]


def _boundaries(result: StabilityResult) -> list[Block]:
    if result.boundaries_rpm is None:
        return [Paragraph("Not asked for: --speeds LOW:HIGH finds them.")]
    searched = "{:g} to {:g}".format(*result.searched_rpm or ())
    block = _grid(result.boundaries_rpm) if result.boundaries_rpm else Paragraph(f"None from {searched} rpm.")
    solved_for = result.state == "balanced" and result.eigenvalues
    return [block] if solved_for else [block, Paragraph(ON_A_GRID)]


def _grid(boundaries: Sequence[StabilityBoundary]) -> Grid:
    """A row for each boundary."""
    rows = tuple((number(limit.speed_rpm, 6), "stable" if limit.stable_above else "not stable") for limit in boundaries)
    return Grid(("rpm", "above it"), rows, frozenset({0}))
