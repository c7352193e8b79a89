"""The report of `abu grinding` for a machine with two races, and its figure."""

from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.features.spindle.records import SpindleGrindingResult, WheelAtWork
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, db
from abu_calc.reporting.charts.figure import Extras, Figure
from abu_calc.reporting.parts import check_blocks, facts, file_of, notices, provenance_blocks
from abu_calc.reporting.screen import one_screen, verdict_line


def work_screen(result: SpindleGrindingResult) -> tuple[Block, ...]:
    """One screen: verdict, levels and capacities with each wheel at work."""
    more = (f"`abu size {file_of(result)}`, the design",)
    return one_screen(result, _head(result), _numbers(result), more=more)


def work_blocks(result: SpindleGrindingResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_head(result),
        Heading("Levels and capacity", "levels"),
        *_numbers(result),
        *(block for wheel in result.wheels for block in _wheel(wheel)),
        *check_blocks(result.checks),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def _head(result: SpindleGrindingResult) -> tuple[Block, ...]:
    return Heading(f"{result.title} at work"), verdict_line(result), Paragraph(""), Paragraph(result.verdict)


def _numbers(result: SpindleGrindingResult) -> list[Block]:
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


def _or_dash(value: float | None) -> str:
    return "–" if value is None else number(value, 4)


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
