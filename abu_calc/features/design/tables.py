"""Tables of a sized machine, case by case: what to make, levels, quiet times, actions, data gaps."""

import math
from collections.abc import Mapping, Sequence
from typing import Final, NamedTuple

from abu_calc.features.design.changes import DRAG, RANGES, DataGap
from abu_calc.features.design.records import AutobalancerRecord, Vibration
from abu_calc.features.design.section_drawing import legend, section_lines
from abu_calc.features.design.starts import FurtherStarts, SettlingOfStart
from abu_calc.features.design.study import SizeResult
from abu_calc.features.swing_arm.view import arm_line
from abu_calc.foundation.checks import Check, first_of
from abu_calc.reporting.blocks import Block, Grid, Paragraph, Picture, level_text, number
from abu_calc.reporting.parts import WORD, SaidSentences, paste_lines, unlike, value_and_limit
from abu_calc.reporting.screen import BLANK, many
from abu_calc.simulation.vibration_records import HandleLevels
from abu_calc.sizing.case import WHEEL_PLANE
from abu_calc.sizing.vibration import decibels
from abu_calc.standards.balls import inch_size

SLIP: Final = "Meant in "
"""Words of the warning about a value that would be usual in another unit."""
INERTIA: Final = "modelled as a point mass"
"""Words of the warning that a machine has no inertia; it is the first note."""

MOST_HANDLES: Final = 2
"""Handles on the screen: those with the highest weighted acceleration."""

LEAST_SHOWN: Final = 0.005
"""Weighted acceleration [m/s²] that two decimals still show."""

WITHOUT: Final = "Idle, without autobalancer"
EXPECTED: Final = "  expected, manufacture and friction"
LOUDER: Final = "LOUDER THAN WITHOUT"
"""Labels of cases of the idle level, and the grade of a case under load."""

LONGEST_NAME: Final = 10
"""Letters of a handle's name in the table."""

TENTH: Final = 0.05
"""Difference of two levels [dB] that are printed alike, or nearly."""


class TableCase(NamedTuple):
    """One case of a table: its label, its number as text, its limit and its grade."""

    label: str
    value: str
    limit: str = ""
    grade: str = ""


def title_with_speed(result: SizeResult) -> str:
    """Name of the machine with its rated speed."""
    return f"{result.title}, {result.model.speed_rad_per_s * 30 / math.pi:.6g} rpm"


def arm_change(result: SizeResult) -> list[Block]:
    """The line that says what to change on a swing arm; nothing without one."""
    return arm_line(result.swing_arm.advice) if result.swing_arm else []


def _eccentricity(result: SizeResult) -> str:
    """The total that the simulation uses, run-outs of race and spindle, and the fit."""
    split = result.eccentricity
    fit = "no standard fit" if split.bore_class is None else f"{split.bore_class}/{split.spindle_class}"
    return (
        f"{number(split.total_um, 3)} µm at most: race TIR {number(split.race_tir_um, 3)} µm, {fit}, spindle TIR "
        f"{number(split.spindle_tir_um, 3)} µm"
    )


def make(result: SizeResult) -> list[Block]:
    """Parts to make or buy, in a few rows."""
    abu, section = result.autobalancer, result.section
    title = "Make" if result.status == "pass" else "Best found"
    share = f"{number(100 * abu.mass_fraction, 2)} % of the machine"
    capacity = _required(result)
    groove = abu.groove_radius_mm
    shape = "" if groove is None else (
        f"groove R {groove:.2f} ± {section.groove_tolerance_mm:.2f} mm, "
    )  # fmt: skip
    rows = (
        TableCase("Balls", f"{balls(abu)}{inch(abu)}, {abu.ball_material}"
                  f"{'' if abu.corrector == 'ball' else f' {abu.corrector}s'}"),
        TableCase(
            "Race",
            f"R {abu.race_radius_mm:.2f} ± {number(section.race_tolerance_mm, 1)} mm, {shape}{section.hardness}",
        ),
        TableCase(
            "Housing",
            f"{abu.housing.split(':')[0]}, Ø{number(abu.outer_diameter_mm, 3)} × {number(abu.width_mm, 3)} mm, bore "
            f"{section.bore_diameter_mm:g} mm {section.bore_class}",
        ),
        TableCase("Eccentricity", _eccentricity(result)),
        TableCase("Capacity", f"{number(abu.capacity_g_mm, 5)} g·mm ({capacity})"),
        TableCase("Mass", f"{number(abu.mass_g, 3)} g with balls = {share}{_most(result, 'mass')}"),
    )  # fmt: skip
    return [Grid((title, ""), tuple((row.label, row.value) for row in rows))]


def _required(result: SizeResult) -> str:
    """Required capacity with its margin, and the imbalance, of which it is the larger part."""
    needed, bare = _needed(result), result.required_capacity_g_mm
    margin = f"{needed / bare:.3g} × {number(bare, 5)}" if bare and needed > bare else number(needed, 5)
    return f"required: {margin}; imbalance {number(result.imbalance_g_mm, 4)}"


def _needed(result: SizeResult) -> float:
    """Required capacity times its margin [g·mm], as its check has it."""
    check = first_of(result.checks, "capacity")
    return result.required_capacity_g_mm if check is None or check.limit is None else check.limit


def _most(result: SizeResult, key: str) -> str:
    check = first_of(result.checks, key)
    return "" if check is None or check.limit is None else f" (limit {check.limit:g} {check.unit or ''})"


def numbers_that_matter(result: SizeResult) -> list[Block]:
    """Levels and quiet times, case by case, with limit and grade."""
    numbers = {check.code: k for k, alike in enumerate(unlike(result.checks), 1) for check in alike}
    checks = {check.key: check for check in result.checks}
    levels, settling = _levels(result, checks, numbers), _settling(result, checks, numbers)
    place = _place(result.vibration)
    vibration = _table(f"Vibration, {place}, dB re 5e-8 m/s", "level", levels)
    tables = [_with_weighted(vibration, result.vibration), *handle_tables(result, numbers)]
    if settling:
        tables.append(_table("Quiet time, s", "time", settling))
    return [block for table in tables for block in (BLANK, table)]


def _with_weighted(table: Grid, vibration: Vibration) -> Grid:
    """The table of levels with the weighted acceleration of the loudest axis beside those calculated.

    Without handles no other table shows it. Rows that are louder than without leave no room for it.
    """
    places = vibration.handles
    axes = places[0].axes or () if [place.name for place in places] == [WHEEL_PLANE] else ()
    before = max((axis.a_h_before_m_per_s2 or 0.0 for axis in axes), default=0.0)
    after = max((axis.a_h_after_m_per_s2 or 0.0 for axis in axes), default=0.0)
    if before < LEAST_SHOWN or any(row[-1] == LOUDER for row in table.rows):
        return table
    shown = {WITHOUT: _acceleration(before), EXPECTED: _acceleration(after)}
    rows = tuple((label, level, shown.get(label, ""), *others) for label, level, *others in table.rows)
    title, column, *limit = table.header
    return Grid((title, column, "a_h, m/s²", *limit), rows, frozenset({1, 2, 3}))


def handle_tables(result: SizeResult, numbers: Mapping[str, int], most: int = MOST_HANDLES) -> list[Grid]:
    """Idle levels and weighted accelerations of the handles, axis by axis; nothing if all places move alike.

    `most`: how many handles are shown, those with the highest vector total.
    """
    shown, more = highest_first(result, most)
    check = first_of(result.checks, "handles")
    rows = [row for handle in shown for row in _handle_rows(handle, check, numbers)]
    title = f"{len(shown)} of {len(shown) + more} handles" if more else "Handles, idle"
    head: tuple[str, ...] = (title, "x, dB", "a_h", "y, dB", "a_h", "z, dB", "a_h", "a_hv, m/s²")
    count = len(head)
    if check is not None:
        head = (*head, "" if check.limit is None else f"≤ {_acceleration(check.limit)}")
    return [Grid(head, tuple(row[: len(head)] for row in rows), frozenset(range(1, count + 1)))] if rows else []


def highest_first(result: SizeResult, most: int = MOST_HANDLES) -> tuple[list[HandleLevels], int]:
    """The handles with the highest weighted acceleration in the order of the file, and how many more there are.

    None where all places move alike.
    """
    handles = [] if result.body.kind == "point mass" else result.vibration.handles
    if [handle.name for handle in handles] == [WHEEL_PLANE]:
        return [], 0
    chosen = sorted(handles, key=_total, reverse=True)[:most]
    return [handle for handle in handles if handle in chosen], len(handles) - len(chosen)


def _total(handle: HandleLevels) -> float:
    after = handle.a_hv_after_m_per_s2
    return (handle.a_hv_before_m_per_s2 or 0.0) if after is None else after


def _handle_rows(handle: HandleLevels, check: Check | None, numbers: Mapping[str, int]) -> list[tuple[str, ...]]:
    """Rows of one handle: without the autobalancer, with it, and the band that an estimated inertia leaves."""
    axes = handle.axes or ()
    without = [(axis.level_before_db, axis.a_h_before_m_per_s2) for axis in axes]
    fitted = [(axis.level_after_db, axis.a_h_after_m_per_s2) for axis in axes]

    def cells(values: Sequence[tuple[float | None, float | None]]) -> tuple[str, ...]:
        return tuple(cell for level, weighted in values for cell in (_tenth(level), _acceleration(weighted)))

    name = handle.name if len(handle.name) <= LONGEST_NAME else f"{handle.name[: LONGEST_NAME - 1]}…"
    rows: list[tuple[str, ...]] = [(f"{name}, without", *cells(without), _acceleration(handle.a_hv_before_m_per_s2))]
    if handle.level_after_db is not None:
        after = handle.a_hv_after_m_per_s2
        decides = check is not None and after == check.value
        rows.append(
            ("  with", *cells(fitted), _acceleration(after), _graded(after, check, numbers, decides=decides)[1])
        )
    if handle.a_hv_after_band_m_per_s2 is not None:
        low, high = map(_acceleration, handle.a_hv_after_band_m_per_s2)
        rows.append(("    95 % band", *[""] * 6, f"{low}…{high}"))
    return [row + ("",) * (9 - len(row)) for row in rows]


def _tenth(level: float | None) -> str:
    """A level; a dash where it is not known, or an axis is at rest."""
    return f"{level:.1f}" if level else "–"


def _acceleration(value: float | None) -> str:
    """A weighted acceleration; a dash where it is not known, or too small to show."""
    if value is None or value < LEAST_SHOWN:
        return "–"
    return number(value, 3) if value >= 1 else f"{value:.2f}"


def _table(title: str, column: str, cases: Sequence[TableCase]) -> Grid:
    return Grid((title, column, "limit", ""), tuple(tuple(case) for case in cases), frozenset({1, 2}))


def marked(blocks: Sequence[Block]) -> frozenset[int]:
    """Numbers of the actions to which the tables point: their cases stand there with number and limit."""
    cells = [row[-1] for block in blocks if isinstance(block, Grid) for row in block.rows]
    return frozenset(int(cell.split()[-1]) for cell in cells if cell.startswith(("WARN ", "FAIL ")))


def _graded(value: float | None, check: Check | None, numbers: Mapping[str, int], *, decides: bool) -> tuple[str, str]:
    """Limit and grade of one case; `decides`: whether it fails the check or only warns."""
    if check is None or check.limit is None:
        return "", ""
    limit = number(check.limit, 3)
    if value is not None and value <= check.limit:
        return limit, "pass"
    word = "FAIL" if decides and check.status == "fail" else "WARN"
    return limit, f"{word} {numbers[check.code]}" if check.code in numbers else ""


def _levels(result: SizeResult, checks: Mapping[str, Check], numbers: Mapping[str, int]) -> list[TableCase]:
    vibration, many_starts, check = result.vibration, result.ensemble, checks.get("idle_level")
    cases = [TableCase(WITHOUT, _db(vibration.level_before_db))]

    def judged(label: str, level: float | None, *, decides: bool) -> TableCase:
        limit = None if check is None else check.limit
        text = _db(level) if level is None else level_in_digits(level, limit)
        return TableCase(label, text, *_graded(level, check, numbers, decides=decides))

    if many_starts is not None:
        cases.append(judged("Idle, with: median of the start cases", many_starts.predicted_level_db, decides=True))
    over_range = [entry.level_after_db for entry in vibration.by_speed or ()]
    expected = max((level for level in (vibration.level_after_db, *over_range) if level is not None), default=None)
    cases.append(judged(EXPECTED, expected, decides=True))
    if many_starts is not None and many_starts.level_db.worst is not None:
        loudest = many_starts.level_db.worst
        if expected is None or loudest > expected + TENTH:
            label = f"  loudest of {many(many_starts.members, 'start case')}, any oil"
            cases.append(judged(label, loudest, decides=check is not None and check.status == "fail"))
    further = None if many_starts is None else many_starts.further_starts
    if further is not None and check is not None and check.limit is not None and further.level_db > check.limit:
        label = f"  loudest of {many(further.members, 'further start case')}"
        cases.append(judged(label, further.level_db, decides=check.status == "fail"))
    if vibration.worst_arrangement is not None:
        bound = result.friction_bound
        label = "  bound of friction" + (f": {bound.reached_within_1_db} of {bound.runs} runs near" if bound else "")
        worst, upright = vibration.worst_arrangement, vibration.worst_arrangement_vertical
        cases.append(TableCase(label, _db(worst.level_after_db)))
        if upright is not None and upright.level_after_db >= worst.level_after_db + TENTH:
            cases.append(TableCase("    spindle held vertical", _db(upright.level_after_db)))
    cases += _measured(result)
    if (new := result.new_wheel) is not None:
        least = number(new.break_even_imbalance_g_mm, 3)
        cases.append(TableCase(f"New wheel: balls help above {least} g·mm", _db(new.level_db)))
    return [*cases, *_at_idle_speed(result), *_under_load(result.vibration_loaded)]


def _at_idle_speed(result: SizeResult) -> list[TableCase]:
    """Levels at the motor's idle speed, if that is not the rated speed."""
    idle = result.vibration.at_idle_speed
    if idle is None:
        return []
    label = f"Motor idle, {idle.speed_rpm:.0f} rpm"
    return [
        TableCase(f"{label}, without", _db(idle.level_before_db)),
        TableCase(f"{label}, expected", _db(idle.level_after_db) or "none"),
    ]


def _measured(result: SizeResult) -> list[TableCase]:
    after = result.measured_after
    if after is None:
        return []
    level = after.measured.removesuffix(" dB") if after.unit == "dB" else f"{after.measured_level_db:.1f}"
    place = "" if after.place == _place(result.vibration) else f", {after.place}"
    if after.difference_db is None:
        return [TableCase(f"  measured{place}", level)]
    distance = f"{abs(after.difference_db):.1f} dB {'above' if after.difference_db >= 0 else 'below'} median"
    return [TableCase(f"  measured{place}: {distance}", level)]


def _under_load(loaded: Vibration | None) -> list[TableCase]:
    """Levels at the workpiece; a face works as it idles, so that it has none."""
    if loaded is None or loaded.at_once_stays is None:
        return []
    before, after, early = loaded.level_before_db, loaded.level_after_db, loaded.level_at_once_db
    cases = [
        TableCase("Grinding, without autobalancer", _db(before) or "not known"),
        TableCase("Grinding, with: pressed after settling", _db(after) or "not known", "", louder(after, before)),
    ]
    if after is not None and early is not None and early > after + TENTH:
        cases.append(TableCase("  pressed earlier", _db(early), "", louder(early, before)))
    starts = loaded.starts
    known = max((level for level in (after, early) if level is not None), default=None)
    if starts is not None and starts.worst_db is not None and known is not None and starts.worst_db > known + TENTH:
        label = f"  loudest of {many(starts.count, 'start case')}"
        cases.append(TableCase(label, _db(starts.worst_db), "", louder(starts.worst_db, before)))
    return cases


def louder(level: float | None, before: float | None) -> str:
    """The grade of a level [dB] above that without the autobalancer; nothing for another one."""
    return LOUDER if level is not None and before is not None and level > before else ""


def _settling(result: SizeResult, checks: Mapping[str, Check], numbers: Mapping[str, int]) -> list[TableCase]:
    many_starts, check = result.ensemble, checks.get("quiet_time")
    if many_starts is None:
        return []
    given = result.model.drag_per_s

    def judged(label: str, time: float | None, *, decides: bool) -> TableCase:
        return TableCase(label, _seconds(time), *_graded(time, check, numbers, decides=decides))

    cases = [judged("Median of the start cases", many_starts.quiet_time_s.typical, decides=True)]
    by_drag: dict[float, list[SettlingOfStart]] = {}
    for entry in many_starts.settling_by_start:
        by_drag.setdefault(entry.drag_per_s, []).append(entry)
    slowest_by_drag = {drag: max(entries, key=_time_of) for drag, entries in by_drag.items()}
    others = [drag for drag in slowest_by_drag if drag != given]
    # A file from the template gives the default.
    usual = DRAG in dict(result.provenance.defaults) or given == RANGES[DRAG].assumed
    oils = _oils(result, "default" if usual else "as given")
    shown = [given] * (given in slowest_by_drag)
    shown += [max(others, key=lambda drag: _time_of(slowest_by_drag[drag]))] if others else []
    for drag in shown:
        slowest = slowest_by_drag[drag]
        oil = oils[0] if drag == given else oils[1] if drag < given else oils[2]
        label = f"Slowest, drag rate {number(drag, 3)} 1/s {oil}: {slowest.start}"
        cases.append(judged(label, slowest.quiet_time_s, decides=drag == given))
    return [
        *cases,
        *(
            judged(label, time, decides=check is not None and check.status == "fail")
            for label, time in _late_ones(many_starts.further_starts, check)
        ),
        TableCase("Rest time (the balls keep their places), slowest", _seconds(many_starts.rest_time_s.worst)),
    ]


def _oils(result: SizeResult, given: str) -> tuple[str, str, str]:
    """The oil at work, hot and cold in words; `given`: for a drag rate that is not by the oil."""
    if result.oil is None:
        return given, "hot oil", "cold oil"
    cold, work, hot = (f"{each.temperature_C:g} °C" for each in result.oil.temperatures)
    return given if result.oil.overridden else f"oil {work}", f"hot oil {hot}", f"cold oil {cold}"


def _late_ones(further: FurtherStarts | None, check: Check | None) -> list[tuple[str, float | None]]:
    """Quiet time of the slowest further start case, or that estimated of one of 1000 if it alone is over the limit."""
    if further is None or check is None or check.limit is None:
        return []
    slowest = f"Slowest of {many(further.members, 'further start case')}, over the band", further.quiet_time_s
    rare = further.rare_quiet_time_s
    kept = further.quiet_time_s is not None and further.quiet_time_s <= check.limit
    late = kept and (rare is None or rare > check.limit)
    return [("One start case of 1000, estimated", rare) if late else slowest]


def _time_of(entry: SettlingOfStart) -> float:
    return math.inf if entry.quiet_time_s is None else entry.quiet_time_s


def action_groups(checks: Sequence[Check], in_tables: frozenset[int]) -> list[list[Paragraph]]:
    """Checks that did not simply pass, numbered, each with its action and the entries to paste.

    `in_tables`: numbers whose case stands in a table above; if these have an action, it alone is printed.
    """
    groups, printed, said = list[list[Paragraph]](), set[tuple[str, ...]](), SaidSentences()
    for k, alike in enumerate(unlike(checks), 1):
        first = alike[0]
        todo = said.unsaid(first.remedy or "", first.overrides)
        codes = ", ".join(check.code for check in alike[:3]) + (f" and {len(alike) - 3} more" * (len(alike) > 3))
        start = f"{k} {WORD[first.status]} {codes}"
        if k in in_tables and todo:
            text = f"{start}: {todo}"
        else:
            action = f" Action: {todo}" if todo else ""
            text = f"{start} {first.name}{value_and_limit(first)}: {first.message}.{action}"
        lines = [Paragraph(text, first.status, hang=2)]
        if first.overrides not in printed:
            lines += paste_lines(first.overrides)
            printed.add(first.overrides)
        groups.append(lines)
    return groups


def gap_table(gaps: Sequence[DataGap]) -> list[Block]:
    """Assumed values, ranked, with levels and quiet times at both ends of their usual range; nothing without any."""
    if not gaps:
        return []
    head = ("Data gap and its usual range", "expected, dB", "quiet time, s")
    rows = tuple(
        (
            f"{gap.key.rpartition('.')[2]} {_ends(gap.usual_range, '{:g}')}",
            _ends(gap.level_db, "{:.1f}"),
            "" if gap.quiet_time_s is None else _ends(gap.quiet_time_s, "{:.2f}"),
        )
        for gap in gaps
    )
    return [Grid(head, rows, frozenset({1, 2}))]


def _ends(values: tuple[float | None, float | None], layout: str) -> str:
    low, high = ("never" if value is None else layout.format(value) for value in values)
    return low if low == high else f"{low} … {high}"


def point_mass(result: SizeResult) -> list[Paragraph]:
    """The note on a machine without inertia: it moves the numbers most, so that it comes first."""
    return [Paragraph(f"! {text}", hang=2) for text in result.warnings if INERTIA in text]


def other_notes(result: SizeResult) -> list[Paragraph]:
    """Warnings beside the missing data and the unusual values."""
    return [Paragraph(f"! {text}", hang=2) for text in result.warnings if INERTIA not in text and UNUSUAL not in text]


UNUSUAL: Final = " is unusual"
"""Words of every warning about a value of the file that lies outside its usual range."""
MOST_UNUSUAL: Final = 2
"""Most such warnings on the first screen."""


def unusual_values(result: SizeResult, most: int | None = MOST_UNUSUAL) -> list[Block]:
    """Values that may be slips of a unit, which stand beside the verdict that they decide; `most` None: all of them."""
    texts = [text for text in result.warnings if UNUSUAL in text]
    shown: list[Block] = [Paragraph(f"! {text}", "warn", hang=2) for text in texts[:most]]
    more = len(texts) - len(shown)
    return [*shown, Paragraph(f"! {many(more, 'more unusual value')}: --full.", "warn")] if more else shown


def starts_and_defaults(result: SizeResult) -> str:
    """Start cases that balance, the motor's idle speed and the number of defaults, in sentences."""
    starts, used = result.ensemble, len(result.provenance.defaults)
    sentences = list[str]()
    if starts is not None:
        count = many(starts.members, "start case")
        balance = (
            f"All {count} balance" if starts.balanced == starts.members else f"{starts.balanced} of {count} balance"
        )
        stall = "no ball stalls" if not starts.hanging else f"balls stall in {starts.hanging}"
        sentences.append(f"{balance}; {stall}.")
    if result.idle_speed_rpm is not None:
        sentences.append(f"The motor idles at {result.idle_speed_rpm:.0f} rpm.")
    if used:
        sentences.append(f"{many(used, 'default')} used.")
    if converted := len(result.provenance.converted):
        sentences.append(f"{many(converted, 'value')} converted.")
    return " ".join(sentences)


def section_picture(result: SizeResult, rows: int) -> tuple[Block, ...]:
    """The section in at most so many lines, and one that says what it shows; nothing where that is too few."""
    lines = section_lines(result.autobalancer, result.section, rows)
    if not lines:
        return ()
    column = result.autobalancer.outer_diameter_mm / (max(map(len, lines)) - 1)
    caption = f"Section, {number(column, 2)} mm a column: {legend(result.section)}."
    return (Picture(tuple(lines), caption),)


def balls(autobalancer: AutobalancerRecord) -> str:
    """Count and size, inch sizes to the micrometre."""
    return f"{autobalancer.ball_count} × Ø{round(autobalancer.ball_diameter_mm, 3):g} mm"


def inch(autobalancer: AutobalancerRecord) -> str:
    """The fraction of an inch by which balls are ordered, in brackets; nothing for metric ones and rollers."""
    inch = inch_size(autobalancer.ball_diameter) if autobalancer.corrector == "ball" else ""
    return f" ({inch})" if inch else ""


def _place(vibration: Vibration) -> str:
    """Place of the level; of several places the loudest."""
    return vibration.place


def level_in_digits(level: float | None, limit: float | None = None) -> str:
    """A level as a table shows it, in digits that show on which side of its limit it lies; a dash: not known."""
    if level is None:
        return "–"
    return _db(level) if level < 0 or limit is None else decibels(level, limit).removesuffix(" dB")


def _db(level: float | None) -> str:
    return "" if level is None else level_text(level, 4 if level >= 100 else 3).removesuffix(" dB")


def _seconds(time: float | None) -> str:
    return "never" if time is None or math.isinf(time) else number(time, 3 if time >= 1 else 2)
