"""The report of `abu balance`: the correction in each plane, drawn, its error, and the next run expected."""

import cmath
import math
from collections import Counter
from collections.abc import Sequence
from typing import Final

from abu_calc.features.balancing.case import RunReadings, SensorReading
from abu_calc.features.balancing.corrections import Share
from abu_calc.features.balancing.drawn import LEGEND, called, drawing, plane_picture, sense_of, sketch
from abu_calc.features.balancing.solution import PlaneCorrection
from abu_calc.features.balancing.study import BalanceResult, ResidualCheck, Verification
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.parts import check_blocks, notices, provenance_blocks
from abu_calc.reporting.screen import one_screen, verdict_line

MOST_ORDERS: Final = 6
"""Most masses of a plane that are orders of their own."""
SIGNS: Final = {"remove": "−", "add": "+"}
MARKS: Final = {
    "against rotation": "Angles of planes count from the zero mark AGAINST rotation.",
    "with rotation": "Angles of planes count from the zero mark WITH rotation, as rotor.angle_marks says.",
}
CONVENTION: Final = (
    "A lagging phase is that of A_j·cos(Ωt − phase), a leading one that of A_j·cos(Ωt + phase), t from the passage of "
    "the mark at its sensor. Uncertainties are one standard deviation, by [errors]. A reading below a tenth of the "
    "largest at its speed has the errors of that tenth. Predicted is what remains without errors. Expected is the rms "
    "over the errors. At most adds twice the rms of the errors to what the planes leave. It is exceeded less than once "
    "in twenty."
)
TRIALS_OFF: Final = "The correction is for the rotor without the trial masses: remove them first."
TOTAL: Final = "The correction takes the place of the fitted masses: remove them first."
TRIM: Final = "The fitted masses stay on: the correction is made in addition to them."
PRINTED: Final = (
    "As published (Didukh 2010, (3)–(6)), the angle is the arctan of a quotient. A negative mass means half a turn "
    "more. Readings are not converted to displacements: accelerations point to the wrong side. For comparison only."
)


def balance_screen(result: BalanceResult) -> tuple[Block, ...]:
    """Correction to make, drawn, on one screen."""
    verification = result.residual_check.verification
    shown = all(len(run.sensors) == len(result.planes) for run in verification)
    table: list[Block] = [] if shown else [Paragraph(""), _verification(verification)]
    return one_screen(result, _about(result), [_planes(result), *table, *_drawn(result)])


def balance_blocks(result: BalanceResult) -> tuple[Block, ...]:
    """The whole report."""
    picture, legend = sketch(result)
    return (
        *_about(result),
        Heading("Planes", "planes"),
        _planes(result),
        *_pieces(result),
        Heading("As one stands before the rotor", "before-the-roll"),
        *_drawn(result),
        *check_blocks(result.checks),
        *_tolerance(result),
        Heading("Verification run", "verification-run"),
        _verification(result.residual_check.verification),
        Paragraph(_misfit(result)),
        Heading("Readings"),
        _readings(result.runs),
        *_records(result.runs),
        *_rig(result),
        *_trial_masses(result),
        Heading("Causes of the uncertainty", "uncertainty"),
        _causes(result),
        *_printed(result),
        Heading("Conventions", "conventions"),
        Paragraph(MARKS[result.angle_marks]),
        Paragraph(CONVENTION),
        Picture(tuple(picture), legend, indent=0),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _about(result: BalanceResult) -> list[Block]:
    """Title, verdict and what to do."""
    orders = [Paragraph(line) for line in _orders(result)]
    return [Heading(_title(result)), verdict_line(result), *orders]


def _title(result: BalanceResult) -> str:
    count, planes = len(result.runs), "two planes" if len(result.planes) == 2 else "one plane"
    return f"{result.title}: balancing in {planes}, {count} run{'' if count == 1 else 's'}, by {result.method}"


def _orders(result: BalanceResult) -> list[str]:
    """Instructions for the correction, one sentence per plane."""
    sentences = []
    for name, plane in result.planes:
        if not plane.mass_g or not plane.corrections:
            sentences.append(f"Leave the {called(name)} as it is.")
            continue
        parts = " and ".join(orders_of(plane))
        head = "PLANE" if name == "single" else f"{name.upper()} plane"
        sentences.append(f"{head}: {parts}.")
    if result.fitted:
        sentences.append(TOTAL if result.answer == "total" else TRIM)
    return [*sentences, TRIALS_OFF] if any(run.trials for run in result.runs) else sentences


def order_of(share: Share, short: bool = False) -> str:
    """A share as an order: what to do, how much, where.

    `short`: with a sign in place of a word.
    """
    sign = SIGNS[share.action] if short else share.action
    at = f"{round(share.angle_deg, 1) % 360:.1f}°"
    if share.weights_g is not None:
        weights = weights_text(share.weights_g)
        return f"{sign} {weights} g at {at}"
    depth = "" if share.depth_mm is None else f"{number(share.depth_mm, 3)} mm"
    drilled = (f", {depth}" if short else f" ({depth} deep)") if depth else ""
    return f"{sign} {number(share.mass_g)} g at {at}{drilled}"


def weights_text(weights: Sequence[float]) -> str:
    """Weights of a place, equal ones together.

    >>> weights_text((20.0, 20.0, 5.0))
    '2 × 20 + 5'
    """
    counted = Counter(weights)
    return " + ".join(f"{weight:g}" if count == 1 else f"{count} × {weight:g}" for weight, count in counted.items())


def orders_of(plane: PlaneCorrection, short: bool = False) -> list[str]:
    """Orders of a plane; of many masses the first and their number."""
    orders = [order_of(share, short) for share in plane.corrections[:MOST_ORDERS]]
    more = len(plane.corrections) - MOST_ORDERS
    return [*orders, f"{more} more masses, listed under Masses (--full)"] if more > 0 else orders


def _planes(result: BalanceResult) -> Grid:
    planes = [plane for _, plane in result.planes]
    rows = [
        (
            "remove at the heavy spot" if any(plane.corrections for plane in planes) else "heavy spot",
            *(_at(plane.mass_g, plane.remove_at_deg) for plane in planes),
        ),
        *(
            [("or add opposite", *(_at(plane.mass_g, plane.add_at_deg) for plane in planes))]
            if any(plane.corrections for plane in planes)
            else []
        ),
        ("  standard deviation", *(_uncertain(plane) for plane in planes)),
        ("imbalance to correct", *(f"{number(plane.imbalance_g_mm)} g·mm" for plane in planes)),
        ("  expected after correction", *(_rest(result, name, plane) for name, plane in result.planes)),
    ]
    if result.tolerance is not None and result.tolerance.planes == "bearing planes":
        rows.append(("  in the bearing planes", *(_in_tolerance_plane(result, name) for name, _ in result.planes)))
    for run in result.residual_check.verification:
        shown = run.sensors
        if len(shown) != len(planes):
            continue
        at = f"{run.quantity} now, {run.speed_rpm:.0f} rpm"
        rows.append((at, *(f"{number(sensor.before, 3)} {run.unit}" for sensor in shown)))
        rows.append(("  at most after correction", *(f"{number(sensor.at_most, 2)} {run.unit}" for sensor in shown)))
    names = ("" if name == "single" else name for name, _ in result.planes)
    return Grid(("", *names), tuple(rows))


def _rest(result: BalanceResult, name: str, plane: PlaneCorrection) -> str:
    tolerance = result.tolerance
    limit = ""
    if tolerance is not None and tolerance.planes == "correction planes":
        limit = f", permitted {number(_permitted(result, name), 3)}"
    return f"{number(plane.rest_g_mm, 2)} g·mm{limit}"


def _permitted(result: BalanceResult, name: str, what: str = "") -> float:
    """Permitted imbalance of a tolerance plane, or that now or expected."""
    side = "single_plane" if name == "single" else name
    value: float | None = getattr(result.tolerance, f"{side}{what}_g_mm")
    return value or 0.0


def _in_tolerance_plane(result: BalanceResult, name: str) -> str:
    permitted = number(_permitted(result, name), 3)
    return f"{number(_permitted(result, name, '_rest'), 2)} g·mm, permitted {permitted}"


def _pieces(result: BalanceResult) -> list[Block]:
    """Table of the masses of a correction, if there are many, or holes, or weights in stock."""
    shares = [(name, share) for name, plane in result.planes for share in plane.corrections]
    drilled, stocked = (any(getattr(share, key) for _, share in shares) for key in ("depth_mm", "weights_g"))
    if not drilled and not stocked and len(shares) <= 2 * len(result.planes):
        return []
    rows = []
    for name, share in shares:
        row = [name, share.action, f"{number(share.mass_g)} g", f"{round(share.angle_deg, 1) % 360:.1f}°"]
        if drilled:
            row.append("" if share.depth_mm is None else f"{number(share.depth_mm, 3)} mm")
        if stocked:
            row.append("" if share.weights_g is None else weights_text(share.weights_g))
        rows.append(tuple(row))
    columns = ("plane", "", "mass", "at", *(["hole depth"] * drilled), *(["weights, g"] * stocked))
    return [Heading("Masses", "masses"), Grid(columns, tuple(rows))]


def _tolerance(result: BalanceResult) -> list[Block]:
    tolerance = result.tolerance
    if tolerance is None:
        return []
    rows = tuple(
        (tolerance.planes.removesuffix("s") if name == "single" else name,
         *(f"{number(_permitted(result, name, what), 4)} g·mm" for what in ("_now", "_rest", "")))
        for name, _ in result.planes
    )  # fmt: skip
    words = f"ISO 21940-11: {number(tolerance.whole_g_mm)} g·mm in all, {tolerance.rule}."
    grid = Grid((tolerance.planes, "now", "expected", "permitted"), rows, frozenset({1, 2, 3}))
    return [Heading("Tolerance planes", "tolerance"), grid, Paragraph(words)]


def _trial_masses(result: BalanceResult) -> list[Block]:
    if not result.trial_masses:
        return []
    rows = tuple(
        ("" if trial.plane == "single" else trial.plane, f"{number(trial.mass_g, 2)} g", f"{number(trial.safe_g, 3)} g",
         "" if trial.visible_g is None else f"{number(trial.visible_g, 3)} g", f"{number(trial.force_percent, 2)} %")
        for trial in result.trial_masses
    )  # fmt: skip
    words = (
        "Safe: the centrifugal force is at most a tenth of the bearing load. Visible: the largest reading changes by "
        "30 %."
    )
    columns = ("plane", "proposed", "safe", "visible", "force of load")
    return [Heading("Trial masses for the next time", "trial-masses"), Grid(columns, rows), Paragraph(words)]


def _at(mass: float, angle: float) -> str:
    return f"{number(mass)} g at {round(angle, 1) % 360:.1f}°"


def _uncertain(plane: PlaneCorrection) -> str:
    angle = plane.angle_uncertainty_deg
    angle_text = "angle not known" if angle >= 180 else f"± {number(angle, 2)}°"
    return f"± {number(plane.mass_uncertainty_g, 2)} g, {angle_text}"


def _drawn(result: BalanceResult) -> list[Block]:
    if result.left is not None and result.right is not None:
        lines = drawing(result.left, result.right, result.turns_from_left, result.angle_marks)
    else:
        sense = sense_of(result.turns_from_left)
        lines = plane_picture("Plane, from the left end", result.planes[0][1], sense, result.angle_marks)
    legend = LEGEND.format(marks="against the arrows of" if result.angle_marks == "against rotation" else "with")
    return [Paragraph(""), Picture(tuple(lines), legend, indent=0)]


def _verification(runs: Sequence[Verification]) -> Grid:
    rows = tuple(
        (f"{run.speed_rpm:.0f}", f"{run.quantity}, {run.unit}", sensor.name,
         *map(number, (sensor.before, sensor.after, sensor.expected, sensor.at_most), (4, 3, 2, 2)))
        for run in runs
        for sensor in run.sensors
    )  # fmt: skip
    return Grid(("rpm", "quantity", "", "now", "predicted", "expected", "at most"), rows, frozenset({0, 3, 4, 5, 6}))


def misfit(check: ResidualCheck) -> str:
    """Relative difference of the readings from those recalculated; of rounding only the bound."""
    return f"{number(100 * check.reproduced, 2)} %" if check.reproduced > ROUNDING else "less than 0.0001 %"


def _misfit(result: BalanceResult) -> str:
    check = result.residual_check
    text = f"Readings recalculated from this imbalance differ by {misfit(check)} of the largest reading"
    if check.disagreement is not None:
        text += "," if check.planes_share is None else ". Beyond what the planes leave, runs differ by"
        text += f" {number(check.disagreement, 2)} standard deviations"
    text += f". Vibration expected after the correction: {number(100 * check.rest_share, 2)} % of that now."
    if check.minimised is not None and not any(plane.leftover_g_mm for _, plane in result.planes):
        text += f" No other correction in these planes makes the sum of its squares smaller ({check.minimised})."
    return text


ROUNDING: Final = 1e-6
"""Relative misfit below which only rounding differs."""


def _readings(runs: Sequence[RunReadings]) -> Grid:
    if all(len(run.sensors) == 2 for run in runs):
        names = [sensor.name for sensor in runs[0].sensors]
        rows = tuple(
            (str(index), f"{run.speed_rpm:.1f}", f"{run.quantity}, {run.unit}", *map(_reading, run.sensors))
            for index, run in enumerate(runs, 1)
        )
        return Grid(("run", "rpm", "quantity", *names), rows, frozenset({0, 1}))
    rows = tuple(
        (str(index), f"{run.speed_rpm:.1f}", f"{run.quantity}, {run.unit}", sensor.name, _reading(sensor))
        for index, run in enumerate(runs, 1)
        for sensor in run.sensors
    )
    return Grid(("run", "rpm", "quantity", "sensor", "reading"), rows, frozenset({0, 1}))


def _reading(reading: SensorReading) -> str:
    phase = "" if reading.phase_deg is None else f" at {reading.phase_deg:.2f}°"
    return f"{number(reading.amplitude, 5)}{phase}"


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
    names = [sensor.name for sensor in result.runs[0].sensors]
    rows = tuple(
        (f"{name} sensor", *(_polar(complex(*coefficient)) for coefficient in row))
        for name, row in zip(names, result.influence_coefficients, strict=True)
    )
    title = "Influence of the planes on the sensors, µm of displacement per g·mm"
    columns = (called(name) for name, _ in result.planes)
    head: list[Block] = [Heading("Rig"), *paragraphs] if paragraphs else []
    return [*head, Heading(title), Grid(("", *columns), rows)]


def _polar(value: complex) -> str:
    return f"{number(abs(value))} at {math.degrees(-cmath.phase(value)) % 360:.1f}°"


def _causes(result: BalanceResult) -> Grid:
    names = ["single_plane" if name == "single" else name for name, _ in result.planes]
    rows = tuple(
        (cause.cause, *(f"{number(getattr(cause, f'{name}_percent') or 0.0, 2)} %" for name in names))
        for cause in result.uncertainty_by_cause
    )
    columns = ("" if name == "single_plane" else name for name in names)
    return Grid(("of the imbalance", *columns), rows, frozenset({1, 2}))


def _printed(result: BalanceResult) -> list[Block]:
    planes = [plane for _, plane in result.planes]
    if any(plane.printed_mass_g is None for plane in planes):
        return []
    cells = [
        f"{number(plane.printed_mass_g or 0.0)} g at "
        + ("no angle" if plane.printed_angle_deg is None else f"{plane.printed_angle_deg:.1f}°")
        for plane in planes
    ]
    rows = (("as published", *cells), ("derived anew", *(_at(plane.mass_g, plane.angle_deg) for plane in planes)))
    return [Heading("The published formula"), Grid(("", "left", "right"), rows), Paragraph(PRINTED)]
