"""First screen of `abu size`: does the machine suit, what to make, the deciding numbers, what to do next."""

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.features.design.changes import DRAG, DataGap
from abu_calc.features.design.judgement import SEARCHED_LESS
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.tables import (
    INERTIA,
    SLIP,
    TENTH,
    highest_first,
    inch,
    level_in_digits,
    louder,
    other_notes,
    title_with_speed,
    unusual_values,
)
from abu_calc.features.design.verdict import STARTS_UNIT, Verdict, faults, in_capitals, keeps_limit
from abu_calc.foundation.checks import RANK, Check, Grade, first_of, worst
from abu_calc.foundation.errors import shell_word
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, capitalised, number
from abu_calc.reporting.parts import WORD, next_command, replaced_entries
from abu_calc.reporting.screen import BLANK, TIE, height, many
from abu_calc.simulation.result import Result

LEAST_SHARE: Final = 1e-6
"""Part of the required capacity [g·mm] that is not told."""
AMPLE: Final = 1.5
"""Capacity over the required one above which the reason is told."""
REST: Final = "Balls at rest after, s"
LABEL: Final = 9
"""Columns of the labels at the left."""
MOST_FAULTS: Final = 3
"""Checks with a row of their own, beside those that the table shows."""
MOST_OF_CHANGE: Final = 3
"""Lines of a change beyond which what it replaces is left out."""
NOT_IN_BALANCE: Final = frozenset({"frequency_region", "stability", "capacity", "level_lowered", "balance"})
"""Checks without which no value of a table is a pass."""
REPLACE: Final = {
    "autobalancer.race_eccentricity_mm": "Specify the run-out that the shop holds.",
    "autobalancer.rolling_friction_mm": "Measure it{}: {}.",
    DRAG: "Name grade, viscosity_index and fill_ml under [oil].",
    "suspension.natural_frequencies_hz": "Measure how the machine is held.",
    "suspension.damping_ratios": "Measure how the machine is held.",
}
"""How to replace an assumed value by a known one; {}: a note, and the command that tells how to measure it."""
RUN_NAMES: Final = {
    "autobalancer.race_eccentricity_mm": ("eccentricity", 1e3, "µm"),
    "wheel.imbalance_g_mm": ("imbalance", 1.0, "g·mm"),
    "autobalancer.rolling_drag_per_s": ("drag rate", 1.0, "1/s"),
}
"""Names of varied values that are told, with factors and units."""

USUAL_NAMES: Final = {
    "autobalancer.rolling_friction_mm": "friction", "machine.speed_rpm": "speed", "run_up.time_s": "run-up",
    "suspension.natural_frequencies_hz": "suspension",
}  # fmt: skip
"""Names of the others."""

Row = tuple[str, str, str, str, str]
"""Label, without, with, limit, grade."""


def size_screen(result: SizeResult) -> tuple[Block, ...]:
    """The first screen: `first_lines`, then the verdict once more, and where the rest stands."""
    return (*first_lines(result), *last_lines(result, result.verdict, len(other_notes(result))))


def first_lines(result: SizeResult) -> tuple[Block, ...]:
    """Verdict, what to make, the deciding numbers with their limits, what was assumed, the next command."""
    return (
        Heading(title_with_speed(result)), verdict_paragraph(result.verdict, result.checks),
        *unusual_values(result), BLANK,
        *(() if result.verdict.leave_out else
          (*labelled("Make" if result.status == "pass" else "Best", _make(result)), BLANK)),
        numbers(result), BLANK, *_runs(result), *_assumed(result), *_arm(result),
        *replaced(result), *(next_lines(result.verdict, result.checks, result.warnings) or _in_use(result)),
    )  # fmt: skip


def verdict_paragraph(verdict: Verdict, checks: Sequence[Check]) -> Paragraph:
    """The sentence, its first words in capitals."""
    words = in_capitals(verdict.word)
    return Paragraph(f"{words}{verdict.sentence[len(words) :]}", worst(checks))


def labelled(label: str, lines: Sequence[str]) -> list[Block]:
    """Lines beside a label."""
    return [Paragraph(f"{label if k == 0 else '':<{LABEL}}{line}", hang=LABEL) for k, line in enumerate(lines)]


def _make(result: SizeResult) -> list[str]:
    """Balls and race, housing, run-outs, what it carries; of what no change mends the balls alone."""
    abu, section, split = result.autobalancer, result.section, result.eccentricity
    groove = "" if abu.groove_radius_mm is None else (
        f", groove R {abu.groove_radius_mm:.2f} ± {section.groove_tolerance_mm:.2f} mm"
    )  # fmt: skip
    kind = f"{abu.ball_material} {abu.corrector}s"
    arm = next((f", rolling {row.requirement.partition(':')[0]}" for row in result.drawing
                if row.feature == "rolling friction"), "")  # fmt: skip
    first = (
        f"{abu.ball_count} {kind} Ø{round(abu.ball_diameter_mm, 3):g} mm{inch(abu)} in a race R "
        f"{abu.race_radius_mm:.2f} ± {number(section.race_tolerance_mm, 1)} mm{groove}, {section.hardness}{arm}"
    )
    if result.verdict.leave_out:
        return [first]
    fit = "without a standard fit" if split.spindle_class is None else f"{split.bore_class} on {split.spindle_class}"
    return [
        first,
        f"housing Ø{number(abu.outer_diameter_mm, 3)} × {number(abu.width_mm, 3)} mm, bore "
        f"{section.bore_diameter_mm:g} {fit}, {abu.housing.split(':')[0]}; {number(abu.mass_g, 3)} g, "
        f"{number(100 * abu.mass_fraction, 2)} %",
        f"run-out TIR: race to bore ≤ {split.race_tir_um:.3g} µm, spindle ≤ {split.spindle_tir_um:.3g} µm "
        f"({split.total_um:.3g} µm off axis)",
        _capacity(result),
    ]


def _capacity(result: SizeResult) -> str:
    """What the balls carry and must carry, and why that is more than the imbalance."""
    bare, own, model = result.required_capacity_g_mm, result.autobalancer.capacity_g_mm, result.model
    check = first_of(result.checks, "capacity")
    limit = (None if check is None else check.limit) or bare
    if not bare:
        return f"carries {number(own, 4)} g·mm"
    named = ("imbalance", result.imbalance_g_mm), ("wheel run-out", model.runout_part_g_mm)
    parts = [(name, part) for name, part in (*named, ("race", model.eccentricity_part_g_mm)) if part > LEAST_SHARE]
    needed = " + ".join(f"{name} {number(part, 3)}" for name, part in parts)
    least = "" if own >= limit else f", at least {limit / bare:.3g} ×"
    large = "; larger balls roll more easily" if own > AMPLE * limit and result.status == "pass" else ""
    return f"carries {number(own, 4)} g·mm, {own / bare:.3g} × what is needed: {needed}{least}{large}"


def numbers(result: SizeResult) -> Grid:
    """Levels, accelerations and times, each with its limit and grade; then checks that these do not show."""
    checks = {check.key: check for check in result.checks}
    many_starts, rows = result.ensemble, {
        "idle_level": [*_idle(result, checks.get("idle_level"))],
        "handles": [*_handles(result, checks.get("handles"))],
        "motor_idle_speed": [*_motor_idle(result, checks.get("motor_idle_speed"))], "at work": [*_grinding(result)],
    }  # fmt: skip
    if many_starts is not None:
        further = many_starts.further_starts
        times, rests = [many_starts.quiet_time_s.worst], [many_starts.rest_time_s.worst]
        if further is not None:
            times, rests = [*times, further.quiet_time_s], [*rests, further.rest_time_s]
        rare = None if further is None else math.inf if further.rare_quiet_time_s is None else further.rare_quiet_time_s
        rows["quiet_time"] = time_rows(times, rests, rare, checks.get("quiet_time"))
    return number_table(rows, result.checks)


def number_table(rows: Mapping[str, Sequence[Row]], checks: Sequence[Check]) -> Grid:
    """Rows of levels and times, by the key of the check that limits them, none a pass where the balls do not balance;
    then checks of which no row shows the grade.
    """
    shown = {key for key, its in rows.items() if any(row[4] not in ("", "pass") for row in its)}
    every = _tightest(rows, bad=any(check.status in ("warn", "fail") for check in checks if check.requested))
    failed = {check.key for check in checks if check.status == "fail"}
    if failed:
        every = [row for row in every if row[0] != REST or row[4]]
    if failed & NOT_IN_BALANCE:
        every = [(*row[:4], "" if row[4].startswith("pass") else row[4]) for row in every if row[0] != REST]
    header = ("Vibration, dB", "without", "with", "limit", "")
    return Grid(header, (*every, *_fault_rows(checks, shown)), frozenset({1, 2, 3}))


def _tightest(rows: Mapping[str, Sequence[Row]], *, bad: bool) -> list[Row]:
    """All rows; if no check is `bad`, that with the largest share of its limit is marked."""
    every = [row for its in rows.values() for row in its]
    shares = {
        row: 10 ** ((float(row[2]) - float(row[3])) / 20) if key == "idle_level" else float(row[2]) / float(row[3])
        for key, its in rows.items() for row in its if row[4] == "pass"
    }  # fmt: skip
    if bad or len(shares) < 2:
        return every
    least = max(shares, key=lambda row: shares[row])
    return [(*row[:4], f"{row[4]}, tightest") if row == least else row for row in every]


def _idle(result: SizeResult, check: Check | None) -> Iterator[Row]:
    """Idle level: as expected, and of the loudest start case."""
    vibration, many_starts = result.vibration, result.ensemble
    over_range = [entry.level_after_db for entry in vibration.by_speed or ()]
    expected = max((level for level in (vibration.level_after_db, *over_range) if level is not None), default=None)
    before = vibration.level_before_db
    of_range = "expected" if expected == vibration.level_after_db else "loudest speed"
    yield level_row(f"Idle, {vibration.place}, {of_range}", before, expected, check)
    levels = [] if many_starts is None else [many_starts.level_db.worst]
    if many_starts is not None and many_starts.further_starts is not None:
        levels.append(many_starts.further_starts.level_db)
    loudest = max((level for level in levels if level is not None), default=None)
    if many_starts is not None and loudest is not None and (expected is None or loudest > expected + TENTH):
        *cells, grade = level_row(f"  loudest of {many(many_starts.runs, 'start case')}", None, loudest, check)
        label, without, after, limit = cells
        yield label, without, after, limit, louder(loudest, before) or grade


def level_row(label: str, before: float | None, after: float | None, check: Check | None) -> Row:
    """Row of a level [dB] without and with the autobalancer, None: not known, against the limit of a check."""
    limit = None if check is None else check.limit
    without = "" if before is None else level_in_digits(before)
    if after is None:
        return label, without, "–", "" if limit is None else f"{limit:g}", _grade(None, check)
    return label, without, level_in_digits(after, limit), "" if limit is None else f"{limit:g}", _grade(after, check)


def _grade(value: float | None, check: Check | None) -> str:
    """Grade of a value that a check limits: beyond the limit it only warns if the check does."""
    if value is None or check is None or check.limit is None:
        return ""
    return "pass" if value <= check.limit else WORD["warn" if check.status in ("pass", "warn") else "fail"]


def _handles(result: SizeResult, check: Check | None) -> Iterator[Row]:
    """Weighted acceleration of the handles that shake most."""
    shown, more = highest_first(result)
    limit = None if check is None else check.limit
    for handle in shown:
        before, after = handle.a_hv_before_m_per_s2, handle.a_hv_after_m_per_s2
        cells = "" if before is None else f"{before:.2f}", "" if after is None else _digits(after, limit)
        yield f"a_hv in m/s², {handle.name}"[:32], *cells, "" if limit is None else f"{limit:.2f}", _grade(after, check)
    if more > 0:
        yield f"  {many(more, 'more handle')}: --full", "", "", "", ""


def _motor_idle(result: SizeResult, check: Check | None) -> Iterator[Row]:
    """Level at the motor's idle speed, and the speed it may have where that is lower."""
    idle = result.vibration.at_idle_speed
    if idle is not None:
        before, after = (level_in_digits(level) for level in (idle.level_before_db, idle.level_after_db))
        beyond, grade = "", ""
        if check is not None and check.limit is not None and check.status != "pass":
            beyond, grade = f" {'>' if check.bound == 'most' else '<'} {check.limit:.0f}", WORD[check.status]
        yield f"Motor idle, {idle.speed_rpm:.0f}{beyond} rpm", before, after, "", grade


def _grinding(result: SizeResult) -> Iterator[Row]:
    """Levels at the workpiece; a face works as it idles, so that it has none."""
    loaded = result.vibration_loaded
    if loaded is None or loaded.at_once_stays is None:
        return
    before, after, early = loaded.level_before_db, loaded.level_after_db, loaded.level_at_once_db
    without = "not known" if before is None else level_in_digits(before)
    settled = "not known" if after is None else level_in_digits(after)
    yield "Grinding, pressed when quiet", without, settled, "", louder(after, before)
    if after is not None and early is not None and early > after + TENTH:
        yield "  pressed earlier (not judged)", "", level_in_digits(early), "", louder(early, before)


def time_rows(
    quiet: Sequence[float | None], rest: Sequence[float | None], rare: float | None, check: Check | None
) -> list[Row]:
    """Quiet and rest time of the slowest start case [s], None: never.

    `rare`: the quiet time that one of 1000 exceeds, which is told if it alone is late.
    """
    slowest, rested = (max(math.inf if time is None else time for time in times) for times in (quiet, rest))
    label, limit = "Quiet after, s: slowest start", None if check is None else check.limit
    late = check is not None and check.status != "pass" and limit is not None and slowest <= limit
    if late and rare is not None and limit is not None and rare > limit:
        slowest, label, late = rare, "Quiet after, s: one start of 1000", False
    creeps = WORD[check.status] if late and check is not None else ""
    first = label, "", _seconds(slowest, limit), "" if limit is None else f"{limit:.2f}", _grade(slowest, check)
    never = math.isinf(slowest) and math.isinf(rested)  # once is enough
    return [first] if never else [first, (REST, "", _seconds(rested), "", creeps)]


def _seconds(time: float | None, limit: float | None = None) -> str:
    return "never" if time is None or math.isinf(time) else _digits(time, limit)


def _digits(value: float, limit: float | None) -> str:
    """A value in two decimals, or in as many as show on which side of its limit it lies.

    >>> _digits(0.934, 1.0), _digits(1.0041, 1.0), _digits(0.9, None)
    ('0.93', '1.004', '0.90')
    """
    kept = (limit is None or (round(value, digits) <= limit) == (value <= limit) for digits in range(2, 6))
    return f"{value:.{2 + next((k for k, its in enumerate(kept) if its), 4)}f}"


def _fault_rows(checks: Sequence[Check], shown: Collection[str]) -> list[Row]:
    """Checks that are not passed and not `shown`, each in a row with its value and limit."""
    grades: tuple[Grade, ...] = ("fail", "not-done", "warn")
    bad = _once(check for grade in grades for check in faults(checks, grade) if check.key not in shown)
    told = ([check for check in bad if check.status == "fail"] or bad)[:MOST_FAULTS]
    rows, more = [*map(_fault_row, told)], len(bad) - len(told)
    return rows + ([(f"{many(more, 'more check')}: --full", "", "", "", "")] if more > 0 else [])


def _once(checks: Iterable[Check]) -> list[Check]:
    """Checks that both races have alike as one, that of the worse race."""
    worse = dict[tuple[str, ...], Check]()
    for check in checks:
        name, race, number = check.name.partition(", race ")
        key = check.code, name, number if check.value is None else race, check.status
        both = sorted((check, worse.get(key, check)), key=lambda each: abs((each.value or 0) / (each.limit or 1) - 1))
        worse[key] = replace(both[1], name=name) if key in worse else check
    return list(worse.values())


def _fault_row(check: Check) -> Row:
    hidden, sign = keeps_limit(check), "" if check.bound == "most" else "≥ "
    digits = 5 if check.unit == "rpm" else 4
    value, limit = ("" if value is None or hidden else f"{value:g}" if check.unit == STARTS_UNIT
                    else number(value, digits) for value in (check.value, check.limit))  # fmt: skip
    unit = f", {check.unit}" if check.unit and value else ""
    return f"{capitalised(check.name)}{unit}", "", value, f"{sign}{limit}" if limit else "", WORD[check.status]


def _arm(result: SizeResult) -> list[Block]:
    """What is not as it should be with a swing arm."""
    arm = result.swing_arm
    return [] if arm is None or arm.advice.startswith("nothing") else labelled("Arm", [arm.advice])


def _runs(result: SizeResult) -> list[Block]:
    """What the start cases cover, promised values first, and whether they are fewer than usual."""
    if (many_starts := result.ensemble) is None:
        return []
    ends = dict[str, tuple[float, float]]()
    for row in many_starts.band:
        low, high = ends.get(row.key, (row.low, row.high))
        ends[row.key] = min(low, row.low), max(high, row.high)
    named = [
        f"{name} {' … '.join(f'{float(number(factor * end, 3)):g}' for end in ends.pop(key))} {unit}"
        for key, (name, factor, unit) in RUN_NAMES.items() if key in ends
    ]  # fmt: skip
    usual = ", ".join(name for key, name in USUAL_NAMES.items() if key in ends)
    others = f"; usual {usual}" if usual else ""
    over = f": {', '.join(named)}{others}" if named else " at the values of the file"
    few = any(SEARCHED_LESS in text for text in result.warnings)
    fewer = "; fewer than usual, since each takes long (--patience 300)" if few else ""
    return labelled("Runs", [f"{many(many_starts.runs, 'start case')}{over}{fewer}"])


def _assumed(result: SizeResult) -> list[Block]:
    """The assumed value that moves the verdict most, and what to do about it."""
    for text in result.warnings:
        if INERTIA in text and "Measure" in text:
            said = text[text.index("Measure") :].partition(": --set")[0].replace("machine.", "")
            said = re.sub("the effective mass .* and (?=the imbalance)| without an autobalancer", "", said)
            return labelled("Assumed", [f"Point mass. {said}"])
    gap = next((gap for gap in result.data_gaps if gap.key == DRAG or gap.level_db[0] != gap.level_db[1]), None)
    if gap is None:
        return []
    limits = [check.limit for check in result.checks if check.key == "idle_level" and check.limit is not None]
    known = result.starts.of is None or result.starts.of[0].case.table.run_up is not None
    plan = next_command("abu measure-plan", result.provenance, (), *([] if known else ["--run-up 1"]))
    note, plan = "" if known else " (1: your run-up in s)", f"`{plan}`".replace(" ", TIE)
    return labelled("Assumed", [f"{_moves(gap, *limits)} {REPLACE.get(gap.key, '').format(note, plan)}".rstrip()])


def _moves(gap: DataGap, limit: float = math.inf) -> str:
    """What both ends of the usual range give, beside the limit of the level [dB] where one exceeds it."""
    ends = [f"{level:.1f} dB" for level in gap.level_db]
    if gap.level_db[0] == gap.level_db[1]:  # an oil moves the times alone
        ends = [f"beyond these runs, quiet after {_seconds(time)} s" for time in gap.quiet_time_s or ()]
    given = ", ".join(f"{text} at {value:g}" for text, value in zip(ends, gap.usual_range, strict=False))
    given = given.replace(", beyond these runs, quiet after", ",")
    beyond = f", limit {limit:g} dB" if max(gap.level_db) > limit else ""
    key = gap.key.rpartition(".")[2]
    named = f"Drag rate {gap.value:g} 1/s" if gap.key == DRAG else f"{key} = {gap.value:g}"
    return f"{named}; {given or 'no time was simulated'}{beyond}."


def next_lines(verdict: Verdict, checks: Sequence[Check], warnings: Sequence[str] = ()) -> list[Block]:
    """The change that was tried with what it does, and the command that makes it; nothing for what suits.

    A value in what seems another unit is corrected first.
    """
    slip = any(SLIP in text for text in warnings)
    if verdict.next is not None and slip:
        return labelled("Next", ["correct the value marked with !, or see --full for a change if it is meant"])
    if verdict.next is None:
        if verdict.leave_out:
            unless = ", unless the value marked with ! is a slip" if slip else ""
            return labelled("Next", [f"leave the autobalancer out{unless}"])
        if verdict.word == "suits" or verdict.in_vain:
            return []
        return labelled("Next", ["--full: what the checks ask for; --patience 300: more changes"])
    own = (check for grade in RANK for check in checks if check.status == grade and check.overrides
           and all(f"--set {shell_word(entry)}" in verdict.next for entry in check.overrides))  # fmt: skip
    promised = next((check.remedy for check in own), None) or ""
    if verdict.change and height(labelled("Next", [promised])) > MOST_OF_CHANGE:
        brief = re.sub(r" \(viscosity index[^)]*\)", "", capitalised(verdict.change))  # the command has it
        promised = f"{brief}: {promised.partition(': ')[2].replace(' Keep balls and race.', '')}"
    return [*labelled("Next", [promised]), Paragraph(verdict.next, whole=True)]


def _in_use(result: SizeResult) -> list[Block]:
    """How to use what suits, if it is louder than without only when pressed early."""
    grades = [grade for *_, grade in _grinding(result)]
    if result.verdict.word != "suits" or len(grades) < 2 or grades[0] or not grades[1]:
        return []
    return labelled("Next", ["press only when it is quiet: before, it is louder than without"])


def replaced(result: Result) -> list[Block]:
    """Entries that the command replaced, to be written into the file."""
    entries = replaced_entries(result.provenance)
    return labelled("Replaced", [f"{'; '.join(entries)}. Write into the file what shall stay."]) if entries else []


def last_lines(result: Result, verdict: Verdict, notes: int = 0) -> list[Block]:
    """The verdict once more, and where the rest stands."""
    more = f", {many(notes, 'note')}" if notes else ""
    commands = f"--full: all numbers{more}   -o report.html   -o section.svg"
    return [Paragraph(f"{in_capitals(verdict.word)}   {commands}", worst(result.checks))]
