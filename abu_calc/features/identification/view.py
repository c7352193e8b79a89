"""The report of `abu identify`: values with intervals, checks, assumptions, every start beside a simulated one."""

from collections.abc import Iterator
from typing import Final

from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.features.identification.plan import MeasurePlanResult
from abu_calc.features.identification.results import ExpectedValues, IdentifiedValue, IdentifyResult
from abu_calc.foundation.quantity import quantities
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Curve, Extras, Figure, Plot
from abu_calc.reporting.parts import check_blocks, facts, next_command, notices, provenance_blocks
from abu_calc.reporting.screen import one_screen, shortened, verdict_line


def identify_blocks(result: IdentifyResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_answer(result),
        *_block(result),
        Heading("Starts", "starts"),
        _starts(result),
        *check_blocks(result.checks),
        *_assumptions(result),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def identify_screen(result: IdentifyResult) -> tuple[Block, ...]:
    """The values, the block to paste, and what they rest on."""
    answer = _answer(result)
    return one_screen(result, answer[:2], [*answer[2:], *_block(result), *_assumptions(result)])


def _answer(result: IdentifyResult) -> list[Block]:
    known = facts(
        result, "starts", "noise_um", "residual_um", *(("friction_number",) if result.friction_number else ())
    )
    return [
        Heading(f"{result.title}: drag, friction and eccentricity from recorded starts"),
        verdict_line(result),
        _values(result),
        known,
    ]


def _values(result: IdentifyResult | ExpectedValues, column: str = "identified") -> Grid:
    rows = tuple(
        (quantity.label, *_cells(getattr(result, name), quantity.meaning), quantity.meaning.replace("deg", "°"))
        for name, quantity in quantities(ExpectedValues).items()
    )
    return Grid(("value", column, "95 % from", "to", "unit"), rows, frozenset({1, 2, 3}))


def _cells(value: IdentifiedValue | None, unit: str) -> tuple[str, str, str]:
    if value is None:
        return "not evaluated", "–", "–"
    if unit == "deg":
        return f"{value.value:.0f}", f"{value.low:.0f}", f"{value.high:.0f}"
    return number(value.value, 4), number(value.low, 3), number(value.high, 3)


def _block(result: IdentifyResult) -> list[Block]:
    if result.toml is None:
        return []
    return [Heading("Lines for the machine file", "lines"), *(Paragraph(line) for line in result.toml.splitlines())]


def _assumptions(result: IdentifyResult) -> list[Block]:
    return [Heading("Assumptions", "assumptions"), *map(Paragraph, result.assumed)]


def _starts(result: IdentifyResult) -> Grid:
    rows = tuple(
        (course.file, f"{course.end_um[0]:.2f}", f"{course.end_um[1]:.2f}", f"{course.distance_um[0]:.1f}")
        for course in result.courses
    )
    header = ("recording", "end x, µm", "end y, µm", "distance at full speed, µm")
    return Grid(header, rows, frozenset({1, 2, 3}))


PLACES: Final = (
    "Fix a velocity or acceleration sensor across the spindle, near the race.",
    "Put a mark on the heavy spot of the rotor, and a pick-up where the sensor points.",
    "Record each start from the switching-on until the balls rest, in a CSV with t_s, vx_mm_per_s and mark.",
    "Record one more start with the balls taken out: no-balls.csv.",
    "If the sensor sits away from the race, repeat that run with the trial mass: the change calibrates lengths.",
)
"""What to do at the rig."""


def plan_blocks(result: MeasurePlanResult) -> tuple[Block, ...]:
    """What to record, and what it will tell."""
    run_up = () if result.run_up_s is None else (f"--run-up {result.run_up_s:g}",)
    options = "start*.csv", "--without no-balls.csv", *run_up
    return (
        Heading(f"{result.title}: recordings for abu identify"),
        facts(result, "runs", "rate_hz", "length_s", "noise_um", "largest_velocity_mm_per_s", "trial_mass_g_mm"),
        Heading("Expected values", "expected"),
        _values(result.expected, "expected"),
        Heading("At the rig", "rig"),
        *(Paragraph(f"{k}. {text}", hang=3) for k, text in enumerate(PLACES, 1)),
        Paragraph(f"{len(PLACES) + 1}. Then:", hang=3),
        Paragraph(next_command("abu identify", result.provenance, (), *options), whole=True),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def plan_screen(result: MeasurePlanResult) -> tuple[Block, ...]:
    """One screen of it."""
    return shortened(result, plan_blocks(result))


def identify_extras(result: IdentifyResult) -> Extras:
    """The figure of all starts, and the calculation note."""
    return Extras(tuple(_courses(result)), tuple(step_blocks(STEPS["identify"])))


def _courses(result: IdentifyResult) -> Iterator[Figure]:
    times = result.times_s
    curves = [Curve(tuple(zip(times, course.distance_um, strict=True))) for course in result.courses]
    predicted = result.courses[0].predicted_um
    if predicted is not None:
        curves.append(Curve(tuple(zip(times, predicted, strict=True)), "simulated, median", 2))
    across = Axis("time from the switching-on [s]", 0.0, times[-1])
    up = Axis.around("distance from the end [µm]", [0.0, *(y for curve in curves for _, y in curve.points)])
    summary = f"Distance of the axis from its end in {result.starts} recorded starts"
    caption = (
        "Distance of the axis from where it comes to rest, in the frame of the rotor: recorded starts (solid) and the "
        "median of starts simulated with the identified values (dashed). Starts differ by where the balls lie."
    )
    yield Figure("starts", "starts", Plot("Recorded and simulated starts", summary, across, up, curves), caption)
