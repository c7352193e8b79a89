"""The screen and the whole report of `abu size` for a machine with two races.

Figures of a machine with two races: section of both, displacement against speed in closed form and in a run-up.

The report of `abu grinding` for a machine with two races, and its figure.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from abu_calc.features.design.records import AutobalancerRecord, Section
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
from abu_calc.features.design.section_drawing import alone, described, section_view
from abu_calc.features.design.sheet import design_items
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.features.spindle.records import (
    PlacedAutobalancerRecord,
    SpindleGrindingResult,
    SpindleSizeResult,
    WheelAtWork,
)
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, capitalised, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Curve, Extras, Figure, Plot, db, run_up_chart
from abu_calc.reporting.drawings.dimensions import extent, moved
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Shape, Text, digits, plain
from abu_calc.reporting.parts import (
    check_blocks,
    contents,
    default_blocks,
    facts,
    file_of,
    notices,
    provenance_blocks,
    warning_blocks,
)
from abu_calc.reporting.screen import BLANK, many, one_screen, verdict_line
from abu_calc.reporting.solids.assembly import PlacedSolid, SolidAssembly

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult


MEANT: Final = (
    "Levels above: without autobalancers at the worst phase; with them median and loudest start case, any oil."
)


def spindle_sheets(result: SpindleSizeResult) -> tuple[Drawing, ...]:
    """The section of both autobalancers."""

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


SECTION = "vibration"


def spindle_extras(result: SpindleSizeResult) -> Extras:
    """Figures of the page."""
    return Extras((*_section(result), *_over_speed(result), *_run_up(result)))


def _section(result: SpindleSizeResult) -> Iterator[Figure]:
    drawing = both_sections(result)
    drawn = f"{drawing.scale:g}:1" if drawing.scale >= 1 else f"1:{1 / drawing.scale:g}"
    yield Figure("section", "make", drawing, f"Sections through the axis, drawn to scale {drawn}, sizes in mm.")


def _run_up(result: SpindleSizeResult) -> Iterator[Figure]:
    """Amplitude against speed of the simulated run-up."""
    points = result.run_up
    if not points:
        return
    without = [(point.speed_rpm, point.without_um) for point in points]
    balls = [(point.speed_rpm, point.with_um) for point in points if point.with_um is not None]
    caption = (
        "Simulated run-up: largest displacement of any place in each revolution against speed, imbalances of unknown "
        "phase in phase, balls together at the start. Balls do not help below the critical speeds. At full speed they "
        "settle: the curve falls there."
    )
    yield Figure("run-up", SECTION, run_up_chart(balls, without), caption)


def _over_speed(result: SpindleSizeResult) -> Iterator[Figure]:
    response = result.response
    without = [(point.speed_rpm, point.without_um) for point in response]
    balanced = [(point.speed_rpm, point.balanced_um) for point in response if point.balanced_um is not None]
    lines = [Curve(without, "without autobalancers")]
    lines += [Curve(balanced, "balanced, closed form", 2)] if balanced else []
    across = Axis.around("speed [rpm]", (speed for speed, _ in without))
    up = Axis.around("displacement, 0–peak [µm]", [0.0, *(value for _, value in (*without, *balanced))])
    speeds = ", ".join(f"{speed:.0f}" for speed in result.frequency.critical_speeds_rpm)
    text = f"Largest displacement of a place against speed; critical speeds {speeds} rpm."
    caption = (
        "Largest displacement of any place against speed, at the worst phase of the imbalances. Balls in two races "
        "balance above both critical speeds only; race eccentricity is what is left there."
    )
    yield Figure("speeds", SECTION, Plot("Displacement against speed", text, across, up, lines), caption)


ROOM: Final = 110.0
"""Outer diameter of the larger autobalancer on paper, at most [mm]."""
GAP: Final = 12.0
"""Distance from one view to the other, on paper [mm]."""


@dataclass(frozen=True)
class OneOfTwo:
    """What the section of a single autobalancer is drawn from."""

    title: str
    autobalancer: AutobalancerRecord
    section: Section


def races_of(result: SpindleSizeResult) -> "tuple[SizeResult, ...]":
    """Each autobalancer as the section view of one takes it."""
    pairs: Any = zip(result.autobalancers, result.sections, strict=True)
    each: Any = tuple(OneOfTwo(result.title, race, section) for race, section in pairs)
    return each  # type: ignore[no-any-return]


def both_sections(result: SpindleSizeResult, room: float = ROOM) -> Drawing:
    """Both sections, the first race left; one scale for both."""
    outer = max(race.outer_diameter_mm for race in result.autobalancers)
    scale = next((ratio for ratio in SCALES if ratio * outer <= room), SCALES[-1])
    shapes: list[Shape] = []
    for index, race in enumerate(races_of(result)):
        place = f"race {index + 1}, z = {digits(result.autobalancers[index].plane_mm, 2)}"
        view = tuple(_titled(section_view(race, scale), place))
        right = 0.0 if not shapes else extent(shapes, scale)[1][0] + GAP / scale - extent(view, scale)[0][0]
        shapes += [moved(shape, (right, 0.0)) for shape in view]
    words = " ".join(f"Race {number}: {described(race)}" for number, race in enumerate(races_of(result), 1))
    return alone("section", f"Section of both autobalancers, {result.title}", words, shapes, scale)


def both_solids(result: SpindleSizeResult) -> SolidAssembly:
    """Both autobalancers on one axis, the middle of each at its plane along the spindle."""
    items = tuple(
        PlacedSolid(
            f"race {number} {item.name}",
            replace(item.solid, name=f"race {number} {item.solid.name}"),
            (*item.shift[:2], item.shift[2] + own.plane_mm - own.width_mm / 2),
        )
        for number, (own, race) in enumerate(zip(result.autobalancers, races_of(result), strict=True), 1)
        for item in design_items(race)
    )
    return SolidAssembly("autobalancers", f"Both autobalancers of {plain(result.title)}, lengths in mm", items)


def _titled(view: Sequence[Shape], title: str) -> Iterator[Shape]:
    """The view with a title for the name of its cutting plane."""
    for shape in view:
        yield replace(shape, text=title) if isinstance(shape, Text) and shape.text == "A–A" else shape


def work_screen(result: SpindleGrindingResult) -> tuple[Block, ...]:
    """One screen: verdict, levels and capacities with each wheel at work."""
    more = (f"`abu size {file_of(result)}`, the design",)
    return one_screen(result, _head(result), _work_numbers(result), more=more)


def work_blocks(result: SpindleGrindingResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_head(result),
        Heading("Levels and capacity", "levels"),
        *_work_numbers(result),
        *(block for wheel in result.wheels for block in _wheel(wheel)),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _head(result: SpindleGrindingResult) -> tuple[Block, ...]:
    return Heading(f"{result.title} at work"), verdict_line(result), Paragraph(""), Paragraph(result.verdict)


def _work_numbers(result: SpindleGrindingResult) -> list[Block]:
    wheels = result.wheels
    rows = [
        ("Level without autobalancers, dB", *(_or_dash(wheel.level_before_db) for wheel in wheels)),
        ("  with them, pressed after settling", *(_or_dash(wheel.level_after_db) for wheel in wheels)),
        ("  with them, pressed at once", *(_or_dash(wheel.level_at_once_db) for wheel in wheels)),
        ("  change, worst phase and oil", *(_change(wheel.worst_change_db) for wheel in wheels)),
        ("Contact force, variable part, N", *(number(wheel.reaction.amplitude_N, 3) for wheel in wheels)),
        ("  without autobalancers", *(number(wheel.reaction_without.amplitude_N, 3) for wheel in wheels)),
        ("Time apart, largest share", *(_share(wheel.apart) for wheel in wheels)),
    ]
    for race in (0, 1):
        needs = (
            f"{number(wheel.races[race].required_g_mm, 4)} of {number(wheel.races[race].capacity_g_mm, 4)}"
            for wheel in wheels
        )
        rows.append((f"Required of race {race + 1}, g·mm", *needs))
    names = tuple(wheel.wheel for wheel in wheels)
    return [Grid(("Wheel at work", *names), tuple(rows), frozenset(range(1, 1 + len(wheels))))]


def _change(value: float | None) -> str:
    return "–" if value is None else f"{value:+.1f}"


def _share(value: float | None) -> str:
    return "–" if value is None else f"{100 * value:.0f} %"


def _wheel(wheel: WheelAtWork) -> list[Block]:
    blocks: list[Block] = [
        Heading(f"{wheel.wheel} at work", f"wheel-{wheel.number}"),
        Paragraph("Forces, motions and resultants: closed forms without separation, imbalances in phase."),
        facts(
            wheel, "level_before_db", "level_after_db", "level_at_once_db", "growth_rate_per_s",
            "growth_rate_worst_per_s", "apart", "disagreement", "runs",
        ),
    ]  # fmt: skip
    for title, record in (
        ("Contact force with autobalancers", wheel.reaction), ("Contact force without", wheel.reaction_without),
        ("Axis at the wheel with autobalancers", wheel.axis), ("Axis at the wheel without", wheel.axis_without),
        ("Axis at the wheel, simulated, loudest run", wheel.axis_simulated), ("Wear", wheel.wear),
    ):  # fmt: skip
        blocks += [Paragraph(f"{title}:"), facts(record, *record.entries())]
    for index, race in enumerate(wheel.races, 1):
        blocks += [Paragraph(f"Race {index}:"), facts(race, *race.entries())]
    places = tuple((place.name, _or_dash(place.level_before_db), _or_dash(place.level_after_db))
                   for place in wheel.places)  # fmt: skip
    return [*blocks, Grid(("Level at work, dB", "without", "with"), places, frozenset({1, 2}))]


def work_extras(result: SpindleGrindingResult) -> Extras:
    """Levels with each wheel at work, and the calculation note."""
    rows = [
        Bar(f"{wheel.wheel}, {name}", value, db(value), series)
        for wheel in result.wheels
        for name, value, series in (
            ("without autobalancers", wheel.level_before_db, 2), ("with them", wheel.level_after_db, 1),
            ("with them, pressed at once", wheel.level_at_once_db, 3),
        ) if value is not None
    ]  # fmt: skip
    notes = (*step_blocks(STEPS["two-races"]), *step_blocks(STEPS["grinding"]))
    if not rows:
        return Extras((), notes)
    axis = Axis.around("velocity level at work [dB]", (bar.value for bar in rows))
    chart = Bars("Levels at work", "; ".join(f"{bar.name} {bar.text}" for bar in rows), axis, rows)
    caption = (
        "Velocity level of the loudest place, 0 dB = 5e-8 m/s rms, one wheel at work: loudest phase without "
        "autobalancers, loudest run with them."
    )
    return Extras((Figure("levels", "levels", chart, caption),), notes)
