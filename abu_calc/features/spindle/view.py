"""The screen and the whole report of `abu size` for a machine with two races."""

from typing import Final

from abu_calc.features.design.screen import (
    Row,
    labelled,
    last_lines,
    level_row,
    next_lines,
    number_table,
    time_rows,
    verdict_paragraph,
)
from abu_calc.features.spindle.records import PlacedAutobalancerRecord, SpindleSizeResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, capitalised, number
from abu_calc.reporting.drawings.shapes import Drawing
from abu_calc.reporting.parts import (
    check_blocks,
    contents,
    default_blocks,
    facts,
    provenance_blocks,
    warning_blocks,
)
from abu_calc.reporting.screen import BLANK, many

MEANT: Final = (
    "Levels above: without autobalancers at the worst phase; with them median and loudest start case, any oil."
)


def spindle_sheets(result: SpindleSizeResult) -> tuple[Drawing, ...]:
    """The section of both autobalancers."""
    from abu_calc.features.spindle.figures import both_sections

    return (both_sections(result),)


def spindle_screen(result: SpindleSizeResult) -> tuple[Block, ...]:
    """The first screen: verdict, what to make, the deciding numbers, the next command, the verdict once more."""
    notes = len(result.warnings)
    return (*_first_lines(result), *last_lines(result, result.verdict, notes))


def _first_lines(result: SpindleSizeResult) -> tuple[Block, ...]:
    many_starts = result.ensemble
    covered = "over all imbalance phases; usual oil, friction, speed"
    runs = [] if many_starts is None else labelled("Runs", [f"{many(many_starts.runs, 'start case')} {covered}"])
    return (
        Heading(result.title), verdict_paragraph(result.verdict, result.checks), BLANK, *_make(result), BLANK,
        _table(result), BLANK, *runs, *next_lines(result.verdict, result.checks),
    )  # fmt: skip


def _table(result: SpindleSizeResult) -> Grid:
    """Levels of all places and times, with limits and grades; then checks that these do not show."""
    checks, vibration, many_starts = {check.key: check for check in result.checks}, result.vibration, result.ensemble
    level, rows = checks.get("idle_level"), list[Row]()
    for place in vibration.handles:
        before = place.level_before_db
        rows.append(level_row(f"{capitalised(place.name)}, median", before, place.level_after_db, level))
        if place.level_after_worst_db is not None:
            rows.append(level_row("  loudest start case", None, place.level_after_worst_db, level))
    times: list[Row] = []
    if many_starts is not None:
        quiet, rest = [many_starts.quiet_time_s.worst], [many_starts.rest_time_s.worst]
        times = time_rows(quiet, rest, None, checks.get("quiet_time"))
    return number_table({"idle_level": rows, "quiet_time": times}, result.checks)


def spindle_blocks(result: SpindleSizeResult) -> tuple[Block, ...]:
    """The whole report."""
    details = _details(result)
    return *_first_lines(result), *contents(details), *details


def _details(result: SpindleSizeResult) -> tuple[Block, ...]:
    """From the decision to the reasons."""
    return (
        Heading("Vibration and quiet time", "vibration"),
        *_numbers(result),
        *(block for index in range(len(result.autobalancers)) for block in _race(result, index)),
        Heading("Speeds", "frequency"),
        facts(result.frequency, *result.frequency.entries()),
        *_single(result),
        *check_blocks(result.checks),
        *warning_blocks(result.warnings),
        *default_blocks(result.provenance.defaults),
        *provenance_blocks(result.provenance),
    )


def _make(result: SpindleSizeResult) -> list[Block]:
    rows = (
        ("Balls", lambda race: f"{race.ball_count} × Ø{round(race.ball_diameter_mm, 3):g} mm"),
        ("Race R, groove R, mm", _radii),
        ("Housing", lambda race: f"Ø{number(race.outer_diameter_mm, 4)} × {number(race.width_mm, 3)} mm"),
        (
            "Carries, must carry, g·mm",
            lambda race: f"{number(race.capacity_g_mm, 4)}, {number(race.resultant_worst_g_mm, 4)}",
        ),
        ("Mass with balls, g", lambda race: number(race.mass_g, 4)),
    )
    cells = tuple((label, *(show(race) for race in result.autobalancers)) for label, show in rows)
    places = (f"race {k}, at {number(race.plane_mm, 4)} mm" for k, race in enumerate(result.autobalancers, 1))
    return [Grid(("Make" if result.status == "pass" else "Best", *places), cells, frozenset({1, 2}))]


def _radii(race: PlacedAutobalancerRecord) -> str:
    groove = "" if race.groove_radius_mm is None else f", {number(race.groove_radius_mm, 4)}"
    return f"{number(race.race_radius_mm, 4)}{groove}"


def _numbers(result: SpindleSizeResult) -> list[Block]:
    ensemble = result.ensemble
    blocks: list[Block] = [Paragraph(MEANT)]
    if ensemble is not None:
        spread = ensemble.quiet_time_s
        unanswered = f"; {ensemble.lost} more gave no answer" if ensemble.lost else ""
        blocks += [
            Paragraph(
                f"{ensemble.balanced} of {ensemble.members - ensemble.lost} start cases balance, over all phases of "
                f"the imbalances, in hot and cold oil{unanswered}. Quiet time: median "
                f"{_or_dash(spread.typical, 2)} s, slowest {_or_dash(spread.worst, 3)} s"
                f"{f' ({ensemble.slowest})' if ensemble.slowest else ''}. The balls rest after "
                f"{_or_dash(ensemble.rest_time_s.worst, 3)} s at the latest."
            ),
        ]
    return blocks


def _or_dash(value: float | None, digits: int = 4) -> str:
    return "–" if value is None else number(value, digits)


def _race(result: SpindleSizeResult, index: int) -> list[Block]:
    race, parts = result.autobalancers[index], result.eccentricities[index]
    return [
        Heading(f"Race {index + 1}", f"race-{index + 1}"),
        facts(race, *race.entries()),
        Heading(f"Eccentricity of race {index + 1}", f"eccentricity-{index + 1}"),
        facts(parts, *parts.entries()),
    ]


def _single(result: SpindleSizeResult) -> list[Block]:
    if result.one_race is None:
        return [Heading("One race instead", "one-race"), Paragraph("A single race balances nowhere between the two.")]
    return [Heading("One race instead", "one-race"), facts(result.one_race, *result.one_race.entries())]
