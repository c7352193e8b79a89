"""The report of `abu size` on one screen, and the lines with which the whole report begins."""

import math
from typing import Final, NamedTuple

from abu_calc.features.design.records import AutobalancerRecord, Vibration
from abu_calc.features.design.section_drawing import legend, section_lines
from abu_calc.features.design.starts import EnsembleResult
from abu_calc.features.design.study import SizeResult
from abu_calc.features.swing_arm.view import arm_bounds, arm_line
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, Picture, number
from abu_calc.reporting.parts import file_of, limit_in_file, measured_after_blocks
from abu_calc.reporting.screen import BLANK, one_screen, verdict_line

ON_ARM = "`abu stability {} --scene swing-arm-cutting`, the arm's motion and instability region"
MORE = ("--explain, every formula with its numbers",)

MOST_ROWS = 9
"""Most rows of the section on one screen."""


class ShownSpread(NamedTuple):
    """A number as one run or the typical one has it, and the worst of many, if there were many."""

    typical: float | None
    worst: float | None = None


TENTH: Final = 0.05
"""Two levels [dB] no further apart are printed alike, or nearly."""


def size_screen(result: SizeResult) -> tuple[Block, ...]:
    """The one screen; the section stands in the room that is left."""
    arm = [BLANK, arm_bounds(result.swing_arm)] if result.swing_arm else []
    more = (*MORE, ON_ARM.format(file_of(result))) if arm else MORE
    return one_screen(
        result, about(result), [*numbers_that_matter(result)[1:], *arm], more,
        lambda room: section_picture(result, min(room - 1, MOST_ROWS)),
    )  # fmt: skip


def section_picture(result: SizeResult, rows: int) -> tuple[Block, ...]:
    """The section in at most so many lines, and one that says what it shows; nothing where that is too few."""
    lines = section_lines(result.autobalancer, result.section, rows)
    if not lines:
        return ()
    column = result.autobalancer.outer_diameter_mm / (max(map(len, lines)) - 1)
    caption = f"Section, {number(column, 2)} mm a column: {legend(result.section)}."
    return (Picture(tuple(lines), caption),)


def about(result: SizeResult) -> list[Block]:
    """Title, verdict, the design in a line."""
    abu = result.autobalancer
    housing = f"{abu.housing.split(':')[0]} housing Ø{number(abu.outer_diameter_mm, 3)} × {number(abu.width_mm, 3)} mm"
    best = "" if result.status == "pass" else "Best that was found: "
    line = f"{best}{balls(abu)} {abu.ball_material} {abu.corrector}s, race R {abu.race_radius_mm:g} mm, {housing}."
    arm = arm_line(result.swing_arm.advice) if result.swing_arm else []
    return [Heading(result.title), verdict_line(result), *arm, Paragraph(line)]


def balls(autobalancer: AutobalancerRecord) -> str:
    """Count and size, inch sizes to the micrometre."""
    return f"{autobalancer.ball_count} × Ø{round(autobalancer.ball_diameter_mm, 3):g} mm"


def numbers_that_matter(result: SizeResult) -> list[Block]:
    """Level without and with the autobalancer, settling, mass; each with its limit, and what many starts came to."""
    many, measured = result.ensemble, measured_after_blocks(result.measured_after)
    if many is None:
        return [BLANK, _table(result, ShownSpread(result.vibration.level_after_db), ShownSpread(None)), *measured]
    over_range = (speed_level.level_after_db for speed_level in result.vibration.by_speed or ())
    levels = many.level_db.worst, result.vibration.level_after_db, *over_range
    level = ShownSpread(many.level_db.typical, max((value for value in levels if value is not None), default=None))
    settling_time = many.settling_time_s
    settling = ShownSpread(settling_time.typical, math.inf if settling_time.worst is None else settling_time.worst)
    return [BLANK, _table(result, level, settling), Paragraph(_starts(result, many)), *measured]


def _idle(result: SizeResult) -> str:
    """The idle speed, if the file gives a motor."""
    return "" if result.idle_speed_rpm is None else f" The motor idles at {result.idle_speed_rpm:.0f} rpm."


def _starts(result: SizeResult, many: EnsembleResult) -> str:
    """Number of start cases, and the worst of them."""
    text = f"Of {many.members} starts, with the drag given, a third and three times of it, {many.balanced} balance"
    worst = many.worst_member
    if worst is None:
        return f"{text}.{_idle(result)}"
    speed = "" if worst.speed_rpm is None else f" ({worst.speed_rpm:.6g} rpm)"
    return f"{text}; the worst of all: {worst.start}{speed}, drag {number(worst.drag_per_s, 3)} 1/s.{_idle(result)}"


def _table(result: SizeResult, level: ShownSpread, settling: ShownSpread) -> Grid:
    """The worst stand beside the typical ones where many runs were made."""
    autobalancer, limits = result.autobalancer, {check.code: check for check in result.checks}
    rows = (
        (f"idle level, {_place(result.vibration)}", _db(result.vibration.level_before_db),
         _db(level.typical) or "not known", _db(level.worst), limit_in_file(limits.get("ABU401"))),
        *_at_idle_speed(result),
        *_under_load(result.vibration_loaded),
        ("settling time", "", _seconds(settling.typical) or "none", _seconds(settling.worst),
         limit_in_file(limits.get("ABU702"))),
        ("mass with balls", "", f"{number(autobalancer.mass_g, 3)} g", "",
         f"{number(100 * autobalancer.mass_fraction, 2)} %, {limit_in_file(limits.get('ABU203'))}".removesuffix(", ")),
    )  # fmt: skip
    header = ("", "without", "with", "worst", "limit")
    if level.worst is None and settling.worst is None:
        return Grid((*header[:3], header[4]), tuple((*row[:3], row[4]) for row in rows), frozenset({1, 2}))
    return Grid(header, rows, frozenset({1, 2, 3}))


def _at_idle_speed(result: SizeResult) -> tuple[tuple[str, ...], ...]:
    """Levels at the idle speed of a motor, if that is not the rated speed; the limit and the worst stand a line
    above.
    """
    idle = result.vibration.at_idle_speed
    if idle is None:
        return ()
    without, fitted = _db(idle.level_before_db), _db(idle.level_after_db)
    return ((f"at the motor's {idle.speed_rpm:.0f} rpm", without, fitted or "not known", "", ""),)


def _under_load(loaded: Vibration | None) -> tuple[tuple[str, ...], ...]:
    """Pressed when the balls have settled; the worst: of all start cases. A face works as it idles."""
    if loaded is None or loaded.at_once_stays is None:
        return ()
    after, worst = loaded.level_after_db, loaded.level_after_db
    of = ""
    hasty, starts = loaded.level_at_once_db, loaded.starts
    if after is not None and worst is not None and hasty is not None and hasty > worst:
        worst, of = hasty, "worst: at once"
    if worst is not None and starts is not None and starts.worst_db is not None and starts.worst_db > worst + TENTH:
        worst, of = starts.worst_db, f"worst of {starts.count} starts"
    levels = (_db(loaded.level_before_db) or "not known", _db(after) or "not known", _db(worst))
    return (("level under load", *levels, of),)


def _place(vibration: Vibration) -> str:
    """Place of the level; of several places the loudest."""
    after = vibration.level_after_db
    known = [hand.name for hand in vibration.handles if (hand.level_before_db if after is None else hand.level_after_db)
             == (vibration.level_before_db if after is None else after)]  # fmt: skip
    return known[0] if known else "loudest place"


def _db(level: float | None) -> str:
    return "" if level is None else f"{level:.1f} dB"


def _seconds(time: float | None) -> str:
    if time is None:
        return ""
    return f"{number(time, 2)} s" if math.isfinite(time) else "never"
