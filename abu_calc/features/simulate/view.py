"""The report of `abu simulate`: results, final places of the balls, effects left out, cost; figures and CSV.

figures    path of the balls; imbalance, level and speed against time; the formulas
CSV        the axis in mm, ball angles in degrees, unwrapped, and whatever else of the scene moves
"""

from collections.abc import Iterator
from typing import Final

import numpy as np

from abu_calc.features.design.figures import amplitude_figure
from abu_calc.features.effects.study import effects_grid
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.features.simulate.study import SampledMotion, SimulateResult
from abu_calc.foundation.checks import first_of
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Extras, Figure, RotorMotionFigure, level, run_up, settling
from abu_calc.reporting.parts import (
    check_blocks,
    default_blocks,
    facts,
    limit_in_file,
    measured_after_blocks,
    of_scene,
    provenance_blocks,
    value_of,
    warning_blocks,
)
from abu_calc.reporting.screen import one_screen, verdict_line
from abu_calc.simulation.response import End
from abu_calc.simulation.rotor_view import RotorView
from abu_calc.simulation.simulate import Cost
from abu_calc.simulation.subject import Audit
from abu_calc.sizing.case import WHEEL_PLANE

CONVENTIONS = (
    "Amplitudes are 0–peak over the last twentieth of the run, about the mean place. Velocities are rms, the larger of "
    "x and y; levels are 20 lg(v / 5e-8 m/s). Ball angles count in the rotor from its zero mark (of a machine: the "
    "imbalance) in the sense of rotation. Ball speeds are relative to the race. Quiet: from then on "
    "the level stays at or below its limit and below the level without balls. Without a limit, it stays within 1 dB of "
    "its end. "
    "At rest: from then on the imbalance in the rotor stays near that of the end. Times count from full speed."
)
UNJUDGED: Final = "NO LIMITS for this scene: only the accuracy is checked (reached)."
UNDER_LOAD: Final = "Under load the level is not checked: the limit of the file is for idling."

MOTION = (
    *(
        "duration_s",
        "full_speed_s",
        "quiet_time_s",
        "quiet_time_range_s",
        "rest_time_s",
        "rest_time_range_s",
        "settling_time_s",
        "residual_imbalance_g_mm",
        "axis_amplitude_mm",
        "unbalanced_amplitude_mm",
    ),
    *("largest_amplitude_mm", "bearing_amplitudes_mm", "velocity_rms_mm_per_s", "error_estimate"),
)
FINAL = (
    *("x_mm", "y_mm", "vx_mm_per_s", "vy_mm_per_s", "tilt_x_mrad", "tilt_y_mrad", "arm_angle_mrad"),
    "rotor_speed_rpm",
)


SECTION: Final = "motion"
"""Id of the section below whose heading the figures stand."""
MOST_BALLS: Final = 12
"""Largest number of balls whose places a screen shows."""
MORE: Final = ("--trajectory FILE.csv, the motion",)


def simulate_blocks(result: SimulateResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_about(result),
        Heading("Motion", SECTION),
        Facts((*facts(result, *MOTION).rows, *_levels(result))),
        *([Paragraph(UNDER_LOAD)] if _informs(result) else []),
        *measured_after_blocks(result.measured_after),
        *_final(result.final),
        *check_blocks(result.checks),
        *warning_blocks(result.warnings),
        *((Heading("Effects"), effects_grid(result.effects)) if result.effects else ()),
        *_audit(result.audit),
        Heading("Model"),
        Paragraph(f"Start: {result.start}."),
        Paragraph(f"{_rung(result)} {_cost(result.cost)}"),
        Heading("Conventions", "conventions"),
        Paragraph(CONVENTIONS),
        *default_blocks(result.provenance.defaults),
        *provenance_blocks(result.provenance),
    )


def simulate_screen(result: SimulateResult) -> tuple[Block, ...]:
    """The one screen."""
    angles = result.final.ball_angles_deg
    ends = ", ".join(f"{angle:.1f}°" for angle in angles[:MOST_BALLS]) + (", …" if len(angles) > MOST_BALLS else "")
    left_out = [each.name for each in result.effects if not each.included]
    body: list[Block] = [
        _numbers(result),
        *([Paragraph(UNDER_LOAD)] if _informs(result) else []),
        *measured_after_blocks(result.measured_after),
        *([Paragraph(f"The balls end at {ends} from {_origin(result)}.")] if angles else []),
        *([Paragraph(f"Effects left out: {', '.join(left_out)}.")] if left_out else []),
    ]
    return one_screen(result, [*_about(result), Paragraph(f"Start: {result.start}.")], body, MORE)


def _origin(result: SimulateResult) -> str:
    """Place from which the angles of the balls count: a machine has its imbalance at the rotor's zero mark."""
    return "the rotor's zero mark" if result.scene in (None, "scene") else "the imbalance, in the sense of rotation"


def _numbers(result: SimulateResult) -> Grid:
    """Amplitude, levels, times, error, each with its limit."""
    limits = {check.key: limit_in_file(check) for check in result.checks}
    limit, bearings = limits.get("idle_level", ""), result.bearing_amplitudes_mm is not None
    names = [hand.name for hand in result.handles or ()]
    held = [f"level, {name}" for name in ([WHEEL_PLANE] if WHEEL_PLANE in names else names)]
    before = value_of(result, "unbalanced_amplitude_mm")
    since = "" if result.full_speed_s is None else ", from full speed"
    rows = (
        ("spindle amplitude", before, value_of(result, "axis_amplitude_mm"), ""),
        *([("at the bearings", "", value_of(result, "bearing_amplitudes_mm"), "")] if bearings else []),
        *((place, "", level, limit if place in held else "") for place, _, level in _levels(result)),
        (f"quiet time{since}", "", _quiet(result), limits.get("quiet_time", "")),
        (f"rest time{since}", "", _rested(result), ""),
        ("error estimate", "", value_of(result, "error_estimate"), limits.get("accuracy", "")),
    )  # fmt: skip
    if _pressed(result):
        return Grid(("", "with balls", "limit"), tuple((name, *others) for name, _, *others in rows), frozenset({1}))
    return Grid(("", "without balls", "with balls", "limit"), rows, frozenset({1, 2}))


def _quiet(result: SimulateResult) -> str:
    return "never" if result.quiet_time_s is None else value_of(result, "quiet_time_s")


def _rested(result: SimulateResult) -> str:
    if result.rest_time_s is None:
        return "still creeping" if result.creeping else "not yet"
    return value_of(result, "rest_time_s")


def _about(result: SimulateResult) -> list[Block]:
    """Title, verdict, the scene in a sentence."""
    title = f"{result.title}: simulation{of_scene(result.scene)}"
    verdict = verdict_line(result, None if _judged(result) else UNJUDGED)
    return [Heading(title), verdict, Paragraph(_sentence(result)), Paragraph(result.description)]


def _sentence(result: SimulateResult) -> str:
    when = "not quiet by the end" if result.quiet_time_s is None else f"quiet after {_quiet(result)}"
    if result.quiet_time_s is not None and result.full_speed_s is not None:
        when += f" at full speed, which is reached at {value_of(result, 'full_speed_s')}"
    when += ", the balls still creep" if result.creeping else ""
    before, after = (value_of(result, name) for name in ("unbalanced_amplitude_mm", "axis_amplitude_mm"))
    bare = "without balls off the workpiece" if _pressed(result) else "without balls"
    return f"Spindle amplitude at the end {after}, {before} {bare}; {when}."


def _pressed(result: SimulateResult) -> bool:
    """True if a wheel is pressed to its workpiece.

    The amplitude without balls is then of the imbalance alone, off the workpiece.
    """
    return any(each.name == "grinding_contact" and each.included for each in result.effects)


def _levels(result: SimulateResult) -> list[tuple[str, str, str]]:
    """Each with its place; on the axis and where the machine is held, unless these are the same."""
    bare = [] if result.level_db is None else [(f"level, {result.level_at}", "L", value_of(result, "level_db"))]
    places = [(f"level, {handle.name}", "L", value_of(handle, "level_db")) for handle in result.handles or ()]
    return [*(row for row in bare if row not in places), *places]


def _judged(result: SimulateResult) -> bool:
    """True if the limits of a file are for this scene."""
    return first_of(result.checks, "idle_level") is not None


def _informs(result: SimulateResult) -> bool:
    """True if levels are given for which there is no limit."""
    return result.handles is not None and not _judged(result)


def _final(final: End) -> list[Block]:
    rows = tuple(
        (str(k), f"{angle:.3f}°", f"{number(speed, 3)} rpm")
        for k, (angle, speed) in enumerate(zip(final.ball_angles_deg, final.ball_speeds_rpm, strict=True), 1)
    )
    blocks: list[Block] = [Heading(f"At the end, {value_of(final, 't_s')}"), facts(final, *FINAL)]
    return [*blocks, Grid(("ball", "angle", "speed"), rows, frozenset({1, 2}))] if rows else blocks


def _audit(audit: Audit | None) -> list[Block]:
    if audit is None:
        return []
    if not audit.effects:
        return [Heading("Audit"), Paragraph("No effect was left out.")]
    text = (
        f"With {', '.join(audit.effects)} simulated too, the results differ by {number(audit.difference, 2)}; "
        f"the estimated influence was {number(audit.promise, 2)}. Cost: {audit.evaluations} evaluations, "
        f"{audit.wall_s:.2f} s."
    )
    return [Heading("Audit"), Paragraph(text)]


def _rung(result: SimulateResult) -> str:
    """Model level that was used, and the reason for not using the one below."""
    if result.rung == "envelope":
        return "Model level: envelope (averaged slow motion), whose estimated error is small enough."
    return f"Model level: full equations. The envelope is not accurate enough: {result.envelope.why}."


def _cost(cost: Cost) -> str:
    events = f", {cost.events} events" if cost.events else ""
    work = f"{cost.integrator}, tolerance {cost.tolerance:g}, {cost.evaluations} evaluations"
    return f"Cost: {work} in {cost.steps} steps{events}, {cost.wall_s:.2f} s. Integrator: {cost.why}."


DIGITS = 12

BLOCK = 10_000
"""Rows that are text at once: a million of them would take a gigabyte."""


@dataclass(frozen=True)
class TrajectoryCsv:
    """Columns t_s, x_mm, y_mm, ball1_deg, … and those of `further`; a row for each time; in pieces of some rows."""

    motion: SampledMotion

    def __len__(self) -> int:
        """Number of pieces."""
        return 1 + -(-len(self.motion.t_s) // BLOCK)

    def __iter__(self) -> Iterator[str]:
        columns = self.motion.columns
        yield ",".join(columns) + "\n"
        for first in range(0, len(self.motion.t_s), BLOCK):
            part = slice(first, first + BLOCK)
            rows = np.vstack([column[part] for column in columns.values()]).T
            yield "".join(",".join([f"{value:.{DIGITS}g}" for value in row]) + "\n" for row in rows.tolist())


def simulate_extras(result: SimulateResult) -> Extras:
    """Figures where the run is held from its beginning, and the calculation note."""
    figures = () if result.view is None else tuple(_figures(result, result.view))
    return Extras(figures, tuple(step_blocks(STEPS["simulation"], _final_numbers(result))))


def _figures(result: SimulateResult, view: RotorView) -> Iterator[Figure]:
    limits = {check.key: check.limit for check in result.checks}
    if view.pitch_radii_mm:
        whole = view.t_s[-1] > 0.9 * result.duration_s
        seen = "The run" if whole else "The beginning of the run"
        caption = (
            f"{seen}, seen in the rotor, which turns anticlockwise: balls and imbalance (red); beside them how the "
            "spindle moves, drift removed. The space bar plays, arrow keys step in time."
        )
        yield Figure("motion", SECTION, RotorMotionFigure(view), caption)
        limit = limits.get("balance")
        below = ": it should fall below the dashed line, and stay there" if limit is not None else ""
        yield Figure("settling", SECTION, settling(view, limit), f"Imbalance of rotor and balls together{below}.")
    limit = limits.get("idle_level")
    below = ", at the loudest place: it should end below the dashed line" if limit is not None else ""
    place = result.level_at if result.handles is None else "where the machine is held"
    caption = f"Velocity level over each revolution, {place}, 0 dB = 5e-8 m/s rms{below}."
    measured = None if result.measured_after is None else result.measured_after.measured_level_db
    caption += "" if measured is None else " Lozenge: as measured with the autobalancer."
    yield Figure("level", SECTION, level(view, limit, measured), caption)
    if view.speed_rpm is not None:
        caption = "Speed of the rotor: times count from full speed."
        yield Figure("run-up", SECTION, run_up(view, view.speed_rpm), caption)
        yield from amplitude_figure(result.run.scene, SECTION)


def _final_numbers(result: SimulateResult) -> tuple[str, ...]:
    """Values of the times and of accuracy for this result."""
    since = "" if result.full_speed_s is None else f", from full speed at {number(result.full_speed_s)} s"
    return (
        f"quiet time{since}: {_quiet(result)}, rest time: {_rested(result)}, remaining imbalance "
        f"{number(result.residual_imbalance_g_mm)} g·mm",
        f"error estimate {number(result.error_estimate, 2)}, by {result.cost.integrator} at tolerance "
        f"{result.cost.tolerance:g}",
    )
