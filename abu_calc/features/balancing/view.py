"""The report of `abu balance`: the correction in both planes, drawn, its error, and the next run expected.

The drawing shows both planes as seen by somebody who stands before the roll's end: the mark on top, the correction on
the circle.
"""

import cmath
import math
from collections.abc import Iterable, Sequence
from typing import Final

from abu_calc.features.balancing.records import (
    PlaneCorrection,
    ResidualCheck,
    RunReadings,
    SensorReading,
    Share,
    Verification,
)
from abu_calc.features.balancing.study import BalanceResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.parts import check_blocks, notices, provenance_blocks
from abu_calc.reporting.screen import one_screen, verdict_line

WIDTH: Final = 36
HEIGHT: Final = 13
ACROSS: Final = 11
DOWN: Final = 5
SIGNS: Final = {"remove": "-", "add": "+"}
LEGEND: Final = (
    "- remove here, + add here, o heavy spot, 0 zero mark. Degrees count from the mark against the arrows of rotation."
)


def drawing(left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str) -> list[str]:
    """Lines with both planes side by side, the left one seen from the left end, the right one from the right."""
    sense = 1 if turns_from_left == "counterclockwise" else -1
    pictures = [
        _plane("LEFT plane, from the left end", left, sense),
        _plane("RIGHT plane, from the right end", right, -sense),
    ]
    return [f"  {line:<{WIDTH}}  {other}".rstrip() for line, other in zip(*pictures, strict=True)]


def _plane(title: str, plane: PlaneCorrection, sense: int) -> list[str]:
    """`sense`: 1 where the roll turns counterclockwise to the one who looks, so that degrees run clockwise."""
    cells = [[" "] * WIDTH for _ in range(HEIGHT)]
    for degrees in range(0, 360, 3):
        _put(cells, ".", degrees, sense)
    for quarter in (90, 180, 270):
        _put(cells, f"{quarter}", quarter, sense, 1.25)
    for row, arrow in ((-2, "<---" if sense > 0 else "--->"), (2, "--->" if sense > 0 else "<---")):
        _write(cells, arrow, WIDTH // 2, HEIGHT // 2 + row)
    for sign, place in _marks(plane):
        _put(cells, sign, place, sense)
    _put(cells, "0", 0, sense, 1.25)
    return [f"{title:^{WIDTH}}".rstrip(), *("".join(row).rstrip() for row in cells)]


def _marks(plane: PlaneCorrection) -> Iterable[tuple[str, float]]:
    heavy = [("o", plane.angle_deg)] if plane.mass_g else []
    return [*heavy, *((SIGNS[share.action], share.angle_deg) for share in plane.corrections)]


def _put(cells: list[list[str]], text: str, degrees: float, sense: int, out: float = 1.0) -> None:
    """Text at an angle from the mark against rotation, its middle on the circle, or farther out."""
    angle = math.radians(degrees)
    column = WIDTH // 2 + round(ACROSS * out * math.sin(angle) * sense)
    _write(cells, text, column, HEIGHT // 2 - round(DOWN * out * math.cos(angle)))


def _write(cells: list[list[str]], text: str, middle: int, row: int) -> None:
    for offset, letter in enumerate(text):
        cells[row][middle - len(text) // 2 + offset] = letter


DO: Final = {"remove": "remove", "add": "add"}
CONVENTION: Final = (
    "All angles of planes count from the zero mark AGAINST rotation. A phase is that of A_j·cos(Ωt − phase), t from "
    "the passage of the mark at its sensor; amplitudes are 0–peak. Uncertainties are one standard deviation, by "
    "[errors]. The verification run is expected to show the rms over them; at most means twice that, exceeded less "
    "than once in twenty."
)
TRIALS_OFF: Final = "The correction is for the roll without the trial masses: remove them first."
PRINTED: Final = (
    "As published (Didukh 2010, (3)–(6)), the angle is the arctan of a quotient. A negative mass means half a turn "
    "more. Readings are not converted to displacements: accelerations point to the wrong side. For comparison only."
)


def balance_screen(result: BalanceResult) -> tuple[Block, ...]:
    """Correction to make, drawn, on one screen."""
    return one_screen(result, _about(result), [_planes(result), *_drawn(result)])


def balance_blocks(result: BalanceResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        Heading("Planes", "planes"),
        _planes(result),
        Heading("As one stands before the roll", "before-the-roll"),
        *_drawn(result),
        *check_blocks(result.checks),
        Heading("Verification run", "verification-run"),
        _verification(result.residual_check.verification),
        Paragraph(_misfit(result)),
        Heading("Readings"),
        _readings(result.runs),
        *_records(result.runs),
        *_rig(result),
        Heading("Causes of the uncertainty", "uncertainty"),
        _causes(result),
        *_printed(result),
        Heading("Conventions", "conventions"),
        Paragraph(CONVENTION),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _about(result: BalanceResult) -> list[Block]:
    """Title, verdict and what to do."""
    orders = [Paragraph(line) for line in _orders(result)]
    return [Heading(_title(result)), verdict_line(result), *orders]


def _title(result: BalanceResult) -> str:
    count = len(result.runs)
    return f"{result.title}: balancing in two planes, {count} run{'' if count == 1 else 's'}, by {result.method}"


def _orders(result: BalanceResult) -> list[str]:
    """Instructions for the correction, one sentence per plane."""
    sentences = []
    for name, plane in (("left", result.left), ("right", result.right)):
        if not plane.mass_g or not plane.corrections:
            sentences.append(f"Leave the {name} plane as it is.")
            continue
        parts = " and ".join(f"{DO[share.action]} {_share(share)}" for share in plane.corrections)
        sentences.append(f"{name.upper()} plane: {parts}.")
    return [*sentences, TRIALS_OFF] if any(run.trials for run in result.runs) else sentences


def _share(share: Share) -> str:
    return _at(share.mass_g, share.angle_deg)


def _planes(result: BalanceResult) -> Grid:
    both = (result.left, result.right)
    rows = [
        ("remove at the heavy spot", *(_at(plane.mass_g, plane.remove_at_deg) for plane in both)),
        ("or add opposite", *(_at(plane.mass_g, plane.add_at_deg) for plane in both)),
        ("  standard deviation", *(_uncertain(plane) for plane in both)),
        ("imbalance now", *(f"{number(plane.imbalance_g_mm)} g·mm" for plane in both)),
        ("  expected after correction", *(_rest(plane) for plane in both)),
    ]
    for run in result.residual_check.verification:
        at = f"{run.quantity} now, {run.speed_rpm:.0f} rpm"
        rows.append((at, *(f"{number(value, 3)} {run.unit}" for value in (run.left_before, run.right_before))))
        most = (run.left_at_most, run.right_at_most)
        rows.append(("  at most after correction", *(f"{number(value, 2)} {run.unit}" for value in most)))
    return Grid(("", "left", "right"), tuple(rows))


def _at(mass: float, angle: float) -> str:
    return f"{number(mass)} g at {round(angle, 1) % 360:.1f}°"


def _uncertain(plane: PlaneCorrection) -> str:
    angle = plane.angle_uncertainty_deg
    angle_text = "angle not known" if angle >= 180 else f"± {number(angle, 2)}°"
    return f"± {number(plane.mass_uncertainty_g, 2)} g, {angle_text}"


def _rest(plane: PlaneCorrection) -> str:
    limit = "" if plane.permitted_g_mm is None else f", permitted {number(plane.permitted_g_mm, 3)}"
    return f"{number(plane.rest_g_mm, 2)} g·mm{limit}"


def _drawn(result: BalanceResult) -> list[Block]:
    lines = drawing(result.left, result.right, result.turns_from_left)
    return [Paragraph(""), Picture(tuple(lines), LEGEND, indent=0)]


def _verification(runs: Sequence[Verification]) -> Grid:
    rows = tuple(
        (f"{run.speed_rpm:.0f}", f"{run.quantity}, {run.unit}", side, *map(number, (before, expected, most), (4, 2, 2)))
        for run in runs
        for side, before, expected, most in (
            ("left", run.left_before, run.left_expected, run.left_at_most),
            ("right", run.right_before, run.right_expected, run.right_at_most),
        )
    )
    return Grid(("rpm", "quantity", "", "now", "expected", "at most"), rows, frozenset({0, 3, 4, 5}))


def misfit(check: ResidualCheck) -> str:
    """Relative difference of the readings from those recalculated; of rounding only the bound."""
    return f"{number(100 * check.reproduced, 2)} %" if check.reproduced > ROUNDING else "less than 0.0001 %"


def _misfit(result: BalanceResult) -> str:
    check = result.residual_check
    text = f"Readings recalculated from this imbalance differ by {misfit(check)} of the largest reading"
    if check.disagreement is not None:
        text += f", {number(check.disagreement, 2)} standard deviations"
    return f"{text}. Vibration expected after the correction: {number(100 * check.rest_share, 2)} % of that now."


ROUNDING: Final = 1e-6
"""Relative misfit below which only rounding differs."""


def _readings(runs: Sequence[RunReadings]) -> Grid:
    rows = tuple(
        (str(index), f"{run.speed_rpm:.1f}", f"{run.quantity}, {run.unit}", _reading(run.left), _reading(run.right))
        for index, run in enumerate(runs, 1)
    )
    return Grid(("run", "rpm", "quantity", "left", "right"), rows, frozenset({0, 1}))


def _reading(reading: SensorReading) -> str:
    return f"{number(reading.amplitude, 5)} at {reading.phase_deg:.2f}°"


def _records(runs: Sequence[RunReadings]) -> list[Block]:
    return [
        Paragraph(
            f"Run {index} is recorded in {run.file}, SHA-256 {(run.sha256 or '')[:16]}…: {run.revolutions} "
            f"revolutions, by the {run.mark_edge}{'' if run.mark_edge == 'middle' else ' edge'} of the mark's pulses."
        )
        for index, run in enumerate(runs, 1)
        if run.file is not None
    ]


def _rig(result: BalanceResult) -> list[Block]:
    natural = result.natural_frequencies_hz
    paragraphs = (
        []
        if natural is None
        else [Paragraph("Natural frequencies: " + ", ".join(f"{frequency:.2f} Hz" for frequency in natural) + ".")]
    )
    rows = tuple(
        (f"{name} sensor", *(_polar(complex(*coefficient)) for coefficient in row))
        for name, row in zip(("left", "right"), result.influence_coefficients, strict=True)
    )
    title = "Influence of the planes on the sensors, µm of displacement per g·mm"
    return [Heading("Rig"), *paragraphs, Heading(title), Grid(("", "left plane", "right plane"), rows)]


def _polar(value: complex) -> str:
    return f"{number(abs(value))} at {math.degrees(-cmath.phase(value)) % 360:.1f}°"


def _causes(result: BalanceResult) -> Grid:
    rows = tuple(
        (cause.cause, f"{number(cause.left_percent, 2)} %", f"{number(cause.right_percent, 2)} %")
        for cause in result.uncertainty_by_cause
    )
    return Grid(("of the imbalance", "left", "right"), rows, frozenset({1, 2}))


def _printed(result: BalanceResult) -> list[Block]:
    both = (result.left, result.right)
    if any(plane.printed_mass_g is None for plane in both):
        return []
    cells = [
        f"{number(plane.printed_mass_g or 0.0)} g at "
        + ("no angle" if plane.printed_angle_deg is None else f"{plane.printed_angle_deg:.1f}°")
        for plane in both
    ]
    rows = (("as published", *cells), ("derived anew", *(_at(plane.mass_g, plane.angle_deg) for plane in both)))
    return [Heading("The published formula"), Grid(("", "left", "right"), rows), Paragraph(PRINTED)]
