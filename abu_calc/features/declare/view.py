"""The report of `abu declare MACHINE`, and its figures."""

from collections.abc import Iterator
from typing import Final

from abu_calc.features.declare.study import DeclareResult
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number, with_unit
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Curve, Extras, Figure, MarkedPoint, Plot
from abu_calc.reporting.parts import check_blocks, file_of, notices, provenance_blocks
from abu_calc.reporting.screen import many, one_screen, verdict_line

ALIKE: Final = 1e-6
"""Relative difference of runs that end alike."""
SHARE: Final = 0.001
"""Least share of a cause that is listed."""


def declare_blocks(result: DeclareResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_head(result),
        Heading("Vibration value", "values"),
        *_values(result),
        *_causes(result),
        *check_blocks(result.checks),
        *_conventions(result),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def declare_screen(result: DeclareResult) -> tuple[Block, ...]:
    """One screen of it."""
    body = [*_values(result), *_causes(result)]
    file = file_of(result)
    return one_screen(result, _head(result), body, more=(f"`abu size {file}`, the design",))


def _head(result: DeclareResult) -> tuple[Block, ...]:
    wheel, plan = result.test_wheel, result.plan
    of = f"Ø{wheel.diameter_mm:g} mm, " if wheel.diameter_mm is not None else ""
    force = f", feed force {wheel.feed_force_N:g} N" if wheel.feed_force_N is not None else ""
    runs = f" × {many(plan.runs, 'run')}" if plan.runs > 1 else ""
    series = f"{many(len(plan.orientations_deg), 'orientation')}{runs} × {many(plan.operators, 'operator')}"
    rows = (
        ("Test wheel", f"{of}{number(wheel.imbalance_g_mm, 3)} g·mm{force} ({_status(result)})"),
        ("Type test", f"{series}; {plan.starts} starts simulated" if plan.starts else series),
        ("Machine", f"{result.body}; highest value at: {_place(result.handle)}"),
    )
    title = Heading(f"{result.title}: declared vibration value")
    return (title, verdict_line(result), Paragraph(""), Grid(("", ""), rows))


def _status(result: DeclareResult) -> str:
    given = result.test_wheel.status == "given"
    return "from the file" if given else "ISO 28927-4, secondary source"


def _place(name: str) -> str:
    return name if name == "wheel plane" else f'handle "{name}"'


def _values(result: DeclareResult) -> list[Block]:
    with_, without = result.with_, result.without
    factor = 1.3 if with_ is None else with_.factor
    header = ("a_hv, m/s²", "without", "with", f"with × {factor:g}")
    rows = [
        (_place(row.name), _short(row.without_m_per_s2), _short(row.with_m_per_s2), _short(row.with_m_per_s2, factor))
        for row in result.handles
    ]
    if with_ is not None and result.model.friction_band_m:
        rows.append(
            ("no rolling friction", "", _short(with_.no_friction_m_per_s2), _short(with_.no_friction_m_per_s2, factor))
        )
    if with_ is not None and with_.upright_m_per_s2 is not None:
        held = with_.upright_m_per_s2
        rows.append(("spindle vertical, friction holds", "", _short(held), _short(held, factor)))
    used = result.wheel_in_use
    rows.append(
        (
            f"wheel in use, {number(used.imbalance_g_mm, 3)} g·mm",
            _short(used.without_m_per_s2),
            _short(used.with_m_per_s2),
            "",
        )
    )
    declared = "not known" if with_ is None else _declared(with_.declared_m_per_s2, with_.K_m_per_s2)
    facts = [("declared without", _declared(without.a_hv_m_per_s2, without.K_m_per_s2))]
    facts += _estimated(without.band_m_per_s2)
    facts.append((f"declared with, × {factor:g}", declared))
    facts += [] if with_ is None else _estimated(with_.declared_band_m_per_s2)
    if with_ is not None and with_.p95 - with_.p05 < ALIKE * with_.p95:
        facts.append(("  every start", "alike: no friction holds the balls"))
    elif with_ is not None:
        low, high = with_.declared_low_m_per_s2, with_.declared_high_m_per_s2
        facts += [
            ("  90 % of type tests", f"{_short(low)} … {_short(high)} m/s²"),
            (
                "  90 % of single runs, × 1",
                f"{_short(with_.p05)} … {_short(with_.p95)}, median {_short(with_.p50)} m/s²",
            ),
            ("  standard error, × 1", f"{number(with_.standard_error_m_per_s2, 2)} m/s²"),
        ]
    facts.append(("break-even eccentricity", _break_even(result)))
    return [Grid(header, tuple(rows), frozenset({1, 2, 3})), Paragraph(""), Grid(("", ""), tuple(facts))]


def _estimated(band: tuple[float, float] | None) -> list[tuple[str, str]]:
    """Band of an estimated inertia."""
    return [] if band is None else [("  95 % of such machines", f"{_short(band[0])} … {_short(band[1])} m/s²")]


def _declared(value: float, uncertainty: float) -> str:
    return f"{number(value, 3)} m/s², K {number(uncertainty, 2)} m/s²"


def _short(value: float | None, factor: float = 1.0) -> str:
    return "–" if value is None else number(factor * value, 3)


def _break_even(result: DeclareResult) -> str:
    own = f"this race: {_um(1e3 * result.model.race_eccentricity_m)}"
    if result.break_even_eccentricity_mm is None:
        return f"none; {own}. {result.break_even_reason}"
    ideal = ""
    if result.break_even_frictionless_mm is not None and result.friction_rms_mm:
        ideal = f"; without friction {_um(result.break_even_frictionless_mm)}"
    return f"{_um(result.break_even_eccentricity_mm)} ({own}{ideal})"


def _um(millimetres: float) -> str:
    return with_unit(1e3 * millimetres, "µm", 3)


def _causes(result: DeclareResult) -> list[Block]:
    """Causes at the highest handle with the autobalancer."""
    listed = [cause for cause in result.causes if cause.share >= SHARE]
    if not listed:
        return []
    rows = tuple((cause.name, _short(cause.a_hv_m_per_s2), f"{100 * cause.share:.0f} %") for cause in listed)
    blocks: list[Block] = [
        Heading(f"Causes with the autobalancer, {_place(result.handle)}", "causes"),
        Grid(("", "alone, m/s²", "share of the mean square"), rows, frozenset({1, 2})),
    ]
    if result.friction_rms_mm:
        blocks.append(
            Paragraph(f"Friction leaves the race {_um(result.friction_rms_mm)} off its place, rms over starts.")
        )
    return blocks


def _conventions(result: DeclareResult) -> list[Block]:
    return [
        Heading("Conventions", "conventions"),
        Paragraph(
            "a_hv is the W_h-weighted vector total of three axes, rms. The value of a handle is the mean over "
            "orientations, runs and operators. The declared value is that of the highest handle. Machines with "
            f"automatic balancing declare it times {1.3 if result.with_ is None else result.with_.factor:g}. A change "
            "smaller than K cannot be told from two declarations. Causes alone are combined as squares."
        ),
    ]


def declare_extras(result: DeclareResult) -> Extras:
    """Figures and formulas of a page."""
    note = step_blocks(STEPS["declare"])
    return Extras((*_bars(result), *_distribution(result), *_over_eccentricity(result)), tuple(note))


def _bars(result: DeclareResult) -> Iterator[Figure]:
    """Values of each handle, without and with, and the declared value with the factor."""
    rows = []
    for handle in result.handles:
        rows.append(Bar(f"{handle.name}, without", handle.without_m_per_s2, _told(handle.without_m_per_s2), 2))
        if handle.with_m_per_s2 is not None:
            rows.append(Bar(f"{handle.name}, with", handle.with_m_per_s2, _told(handle.with_m_per_s2), 1))
    if result.with_ is not None:
        declared = result.with_
        span = declared.declared_low_m_per_s2, declared.declared_high_m_per_s2
        value = declared.declared_m_per_s2
        rows.append(Bar(f"declared with, × {declared.factor:g}", value, _told(value), 3, span=span))
    limit = result.without.a_hv_m_per_s2, f"declared without: {_told(result.without.a_hv_m_per_s2)}"
    highest = [*(bar.value for bar in rows), *(bar.span[1] for bar in rows if bar.span)]
    axis = Axis.around("weighted acceleration a_hv [m/s²]", highest, zero=True)
    text = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
    caption = (
        "Weighted acceleration at each handle in the type test, and the declared value with the autobalancer, which "
        "90 % of type tests give within the span. It should stay left of the dashed line."
    )
    yield Figure("values", "values", Bars("Declared value", text, axis, rows, limit), caption)


def _told(value: float) -> str:
    return f"{number(value, 3)} m/s²"


def _distribution(result: DeclareResult) -> Iterator[Figure]:
    """Share of single runs below each value."""
    values = result.distribution_m_per_s2
    if result.with_ is None or values[-1] - values[0] < 1e-9 * values[-1]:
        return
    last = len(values) - 1
    curve = Curve([(value, 100.0 * k / last) for k, value in enumerate(values[:-1])])  # the last one is a rare outlier
    across = Axis.around("a_hv of one run [m/s²]", [*values[:-1], result.without.a_hv_m_per_s2], zero=True)
    points = [
        MarkedPoint(result.with_.a_hv_m_per_s2, _share_below(values, result.with_.a_hv_m_per_s2), "mean"),
        MarkedPoint(result.without.a_hv_m_per_s2, 100.0, "without", 2),
    ]
    marks = ((5, result.with_.p05), (50, result.with_.p50), (95, result.with_.p95))
    text = ", ".join(f"{percent} % below {_told(value)}" for percent, value in marks)
    caption = (
        "Share of single runs with the autobalancer below a value, at the highest handle, the factor not included."
    )
    plot = Plot("Single runs", text, across, Axis("share of the runs [%]", 0.0, 105.0), (curve,), points)
    yield Figure("runs", "values", plot, caption)


def _share_below(values: tuple[float, ...], value: float) -> float:
    return 100.0 * sum(1 for each in values if each < value) / len(values)


def _over_eccentricity(result: DeclareResult) -> Iterator[Figure]:
    points = [(1e3 * at.race_eccentricity_mm, at.declared_m_per_s2) for at in result.by_eccentricity]
    if len(points) < 3:
        return
    own = 1e6 * result.model.race_eccentricity_m
    marked = [MarkedPoint(x, y, "this race" if abs(x - own) < 1e-9 else "") for x, y in points]
    without = result.without.a_hv_m_per_s2
    across = Axis.around("race eccentricity [µm]", (x for x, _ in points), zero=True)
    up = Axis.around("declared value [m/s²]", [*(y for _, y in points), without], zero=True)
    text = "; ".join(f"{number(x, 3)} µm: {_told(y)}" for x, y in points)
    limit = without, f"without: {_told(without)}"
    caption = (
        "Declared value with the autobalancer, the factor included, against race eccentricity. Below the dashed line "
        "it is lower."
    )
    yield Figure(
        "eccentricity",
        "values",
        Plot("Break-even eccentricity", text, across, up, (Curve(points),), marked, limit),
        caption,
    )
