"""The report of `abu declare` for a machine with two races, and its figures."""

from typing import Final

from abu_calc.features.declare.two_race_records import TwoRaceDeclareResult
from abu_calc.features.declare.view import (
    declared_text,
    eccentricity_figure,
    micrometres,
    place_text,
    short,
    single_runs,
    value_bars,
)
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.figure import Extras
from abu_calc.reporting.parts import check_blocks, file_of, notices, provenance_blocks
from abu_calc.reporting.screen import many, one_screen, verdict_line

FACTOR: Final = 1.3
RIGHT: Final = frozenset({1, 2, 3})


def two_race_declare_blocks(result: TwoRaceDeclareResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_head(result),
        *([Heading("Vibration value", "values"), *_values(result)] if result.without else []),
        *check_blocks(result.checks),
        *_conventions(result),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def two_race_declare_screen(result: TwoRaceDeclareResult) -> tuple[Block, ...]:
    """One screen of it."""
    more = (f"`abu size {file_of(result)}`, the design",)
    return one_screen(result, _head(result), _values(result) if result.without else [], more=more)


def _head(result: TwoRaceDeclareResult) -> tuple[Block, ...]:
    top = (Heading(f"{result.title}: declared vibration value"), verdict_line(result))
    if result.test_wheel is None or result.handle is None:
        return top
    wheel, plan = result.test_wheel, result.plan
    of = f"Ø{wheel.diameter_mm:g} mm, " if wheel.diameter_mm is not None else ""
    source = "from the file" if wheel.status == "given" else "ISO 28927-4, secondary source"
    runs = f" × {many(plan.runs, 'run')}" if plan.runs > 1 else ""
    series = f"{many(len(plan.orientations_deg), 'orientation')}{runs} × {many(plan.operators, 'operator')}"
    simulated = f"; {plan.starts} starts simulated on each wheel place" if plan.starts else ""
    rows = (
        ("Test wheel", f"{of}{number(wheel.imbalance_g_mm, 3)} g·mm ({source})"),
        ("Type test", series + simulated),
        ("Highest value", f"at {place_text(result.handle)}, test wheel on {_deciding(result)}"),
    )
    return (*top, Paragraph(""), Grid(("", ""), rows))


def _deciding(result: TwoRaceDeclareResult) -> str:
    """The wheel place of the highest value."""
    return max(result.test_wheels, key=lambda place: place.with_m_per_s2 or place.without_m_per_s2).wheel


def _values(result: TwoRaceDeclareResult) -> list[Block]:
    with_, without = result.with_, result.without
    if without is None:
        return []
    factor = FACTOR if with_ is None else with_.factor
    rows = [
        (place_text(row.name), short(row.without_m_per_s2), short(row.with_m_per_s2), short(row.with_m_per_s2, factor))
        for row in result.handles
    ]
    rows += [
        (f"test wheel on {place.wheel}", short(place.without_m_per_s2), short(place.with_m_per_s2),
         short(place.with_m_per_s2, factor))
        for place in result.test_wheels
    ]  # fmt: skip
    if with_ is not None and max(result.model.friction_bands_m):
        ideal = with_.no_friction_m_per_s2
        rows.append(("no rolling friction", "", short(ideal), short(ideal, factor)))
    if with_ is not None and with_.upright_m_per_s2 is not None:
        held = with_.upright_m_per_s2
        rows.append(("spindle vertical, friction holds", "", short(held), short(held, factor)))
    if result.wheel_in_use is not None:
        used = result.wheel_in_use
        rows.append(("wheels in use", short(used.without_m_per_s2), short(used.with_m_per_s2), ""))
    told = "not known" if with_ is None else declared_text(with_.declared_m_per_s2, with_.K_m_per_s2)
    facts = [
        ("declared without", declared_text(without.a_hv_m_per_s2, without.K_m_per_s2)),
        (f"declared with, × {factor:g}", told),
    ]
    if with_ is not None:
        low, high = with_.declared_low_m_per_s2, with_.declared_high_m_per_s2
        facts += [
            ("  90 % of type tests", f"{short(low)} … {short(high)} m/s²"),
            ("  90 % of single runs, × 1", f"{short(with_.p05)} … {short(with_.p95)} m/s²"),
        ]
    facts.append(("break-even eccentricity", _break_even(result)))
    header = ("a_hv, m/s²", "without", "with", f"with × {factor:g}")
    return [Grid(header, tuple(rows), RIGHT), Paragraph(""), Grid(("", ""), tuple(facts))]


def _break_even(result: TwoRaceDeclareResult) -> str:
    own = f"these races: {micrometres(1e3 * result.model.race_eccentricity_m)}"
    if result.break_even_eccentricity_mm is None:
        return f"none; {own}"
    return f"{micrometres(result.break_even_eccentricity_mm)} ({own})"


def _conventions(result: TwoRaceDeclareResult) -> list[Block]:
    factor = FACTOR if result.with_ is None else result.with_.factor
    return [
        Heading("Conventions", "conventions"),
        Paragraph(
            "a_hv is the W_h-weighted vector total of three axes, rms. The value of a handle is the mean over "
            "orientations, runs, operators and angles between the race eccentricities. The declared value is that of "
            f"the highest handle with the test wheel on its worst place, times {factor:g} for automatic balancing. A "
            "change smaller than K cannot be told from two declarations."
        ),
    ]


def two_race_declare_extras(result: TwoRaceDeclareResult) -> Extras:
    """Figures and formulas of the page."""
    notes = (*step_blocks(STEPS["declare"]), *step_blocks(STEPS["two-races"]))
    if result.without is None:
        return Extras((), notes)
    without = result.without.a_hv_m_per_s2
    points = [(1e3 * at.race_eccentricity_mm, at.declared_m_per_s2) for at in result.by_eccentricity]
    own = 1e6 * result.model.race_eccentricity_m
    figures = [
        *value_bars(result.handles, result.with_, without),
        *single_runs(result.distribution_m_per_s2, result.with_, without),
        *([eccentricity_figure(points, own, without)] if len(points) > 2 else []),
    ]
    return Extras(tuple(figures), notes)
