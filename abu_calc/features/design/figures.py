"""Figures of `abu size`: section and face, levels, candidates, budget, cost of tolerances, formulas."""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.features.design.section_drawing import face_drawing, section_drawing
from abu_calc.features.design.sheet import arm_sheets
from abu_calc.features.design.starts import StartView
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.summary import explanation_blocks, size_summary
from abu_calc.features.design.tables import balls
from abu_calc.features.design.verdict import mm_per_s
from abu_calc.features.seats.figures import seat_figures
from abu_calc.foundation.checks import first_of
from abu_calc.foundation.quantity import quantities
from abu_calc.foundation.units import from_si
from abu_calc.reporting.blocks import capitalised, number
from abu_calc.reporting.charts.chart import (
    SUMMARY,
    Axis,
    Bar,
    Bars,
    Curve,
    Extras,
    Figure,
    MarkedPoint,
    Plot,
    RotorMotionFigure,
    Shown,
    caught,
    db,
    level,
    micrometres,
    run_up_chart,
    settling,
)
from abu_calc.reporting.drawings.shapes import Drawing
from abu_calc.reporting.parts import value_of
from abu_calc.simulation.rotor_view import Course, both_courses

SCALES: Final = (5.0, 2.0, 1.0, 0.5, 0.2)
ROOM: Final = 130.0
SUMMARY_ROOM: Final = 100.0
"""Room for the outer diameter on paper [mm], in the details and in the summary."""
BARS_MM: Final = 30.0
BAR_MM: Final = 7.4
"""Height of a chart of bars on paper with its caption [mm], and of each bar."""
PARTS: Final = ("race_eccentricity_um", "rolling_friction_um", "rolling_friction_worst_um", "race_ovality_um",
                "plane_offset_um", "capacity_shortfall_um", "residual_um", "worst_um")  # fmt: skip
SUMS: Final = ("residual_um", "worst_um")


def size_extras(result: SizeResult) -> Extras:
    """Figures, calculation note and summary of a page; warnings stand in the summary if it has room for all."""
    figures = (
        *_levels(result), *_drawings(result), *_over_speed(result), *_oil(result), *_budget(result), *_motion(result),
        *_settling(result), *_over_time(result), *_run_up(result), *_candidates(result), *_costs(result),
    )  # fmt: skip
    summary = size_summary(result, sum(_height_mm(figure.shown) for figure in figures if figure.section == SUMMARY))
    held = frozenset({"contents", "make", "levels", *(["warnings"] if summary.whole else [])})
    return Extras(figures, explanation_blocks(result)[1:], summary.blocks, held)


def _height_mm(shown: Shown) -> float:
    """Height of a figure of the summary on paper."""
    if isinstance(shown, Drawing):
        return shown.size[1]
    return BARS_MM + BAR_MM * len(shown.rows) if isinstance(shown, Bars) else 0.0


def size_charts(result: SizeResult) -> tuple[Figure, ...]:
    """Figures for which a terminal has room."""
    return (*_over_speed(result), *_settling(result), *_candidates(result))


def _drawings(result: SizeResult) -> Iterator[Figure]:
    outer = result.autobalancer.outer_diameter_mm
    small, scale = (_scale(outer, room) for room in (SUMMARY_ROOM, ROOM))
    yield Figure("section", SUMMARY, section_drawing(result, small), f"Section through the axis, {_drawn(small)}.")
    face = f"Face with the cover off, {_drawn(scale)}; balls evenly spread."
    yield Figure("face", "section", face_drawing(result, scale), face)
    for sheet in arm_sheets(result):
        yield Figure("arm", "swing-arm", sheet, "Sketch of the swing arm, not to scale.")
    yield from seat_figures(result, result.fits)


def _scale(outer: float, room: float) -> float:
    return next((ratio for ratio in SCALES if ratio * outer <= room), SCALES[-1])


def _drawn(scale: float) -> str:
    return f"drawn {_ratio(scale)} for this page (sheets have scales of their own), sizes in mm"


def _ratio(scale: float) -> str:
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


def _levels(result: SizeResult) -> Iterator[Figure]:
    """Figure of the levels without, with (expected) and as measured with the autobalancer at each place."""
    vibration = result.vibration
    places = [(place.name, place.level_before_db, place.level_after_db) for place in vibration.handles]
    beside = all(
        name != vibration.place for name, *_ in places
    )  # the handles of a body in space have no limit of level
    if beside:
        places.insert(0, (vibration.place, vibration.level_before_db, vibration.level_after_db))
    rows = [row for name, before, after in places for row in (
        (f"{name}, without autobalancer", before, 2),
        (f"{name}, with: expected", after, 1),
    )]  # fmt: skip
    if (measured := result.measured_after) is not None:
        rows.append((f"{measured.place}, with: measured", measured.measured_level_db, 3))
    known = [Bar(name, mm_per_s(level), db(level), series) for name, level, series in rows if level is not None]
    if not known:
        return
    bound = _limit(result, "idle_level")
    limit = (mm_per_s(bound[0]), bound[1]) if bound else None
    most = max(*(bar.value for bar in known), limit[0] if limit else 0.0)
    axis = Axis("velocity, rms, idle [mm/s]", 0.0, 1.05 * most)
    text = "; ".join(f"{bar.name} {bar.text}" for bar in known) + (f"; {limit[1]}" if limit else "")
    caption = "Vibration at each place, idle, at the rated speed. Beside the bars: level in dB re 5e-8 m/s rms."
    where = f" at the {vibration.place}" if beside else ""
    caption += f" The expected bar{where} should end left of the dashed limit." if limit else ""
    chart = Bars("Vibration without and with the autobalancer", text, axis, known, limit)
    yield Figure("levels", SUMMARY, chart, caption)


def _over_speed(result: SizeResult) -> Iterator[Figure]:
    levels = result.vibration.by_speed or ()
    if len({speed_level.speed_rpm for speed_level in levels}) < 2:
        return
    curve = sorted((speed_level.speed_rpm, speed_level.level_after_db) for speed_level in levels)
    limit = _limit(result, "idle_level")
    bands = _forbidden(result)
    points = [*(MarkedPoint(*pair) for pair in curve), *_measured(result)]
    across = Axis.around("speed [rpm]", (point.x for point in points))
    up = Axis.around("level [dB]", [*(point.y for point in points), *([limit[0]] if limit else [])])
    text = "; ".join(f"{f'{point.word} ' if point.word else ''}{point.x:.0f} rpm {db(point.y)}" for point in points)
    text += f"; {limit[1]}" if limit else ""
    caption = (
        "Expected level with the autobalancer at the loudest place, idle, against speed, dB re 5e-8 m/s rms. The line "
        f"should stay below the dashed limit.{' In the shaded ranges the balls do not balance.' if bands else ''}"
    )
    chart = Plot("Level against speed", text, across, up, (Curve(curve),), points, limit, bands)
    yield Figure("speeds", "vibration-level", chart, caption)


def _oil(result: SizeResult) -> Iterator[Figure]:
    """The drag rate from cold to hot with its uncertainty, and the range of drag rates that the verdict covers."""
    if result.oil is None:
        return
    states = sorted(result.oil.temperatures, key=lambda state: state.temperature_C)
    ways = (("drag rate", "rolling_drag_per_s", 1), ("its band", "low_per_s", 2), ("its band", "high_per_s", 2))
    lines = [
        Curve([(state.temperature_C, math.log10(getattr(state, key))) for state in states], name, series)
        for name, key, series in ways
    ]
    cold, hot = states[0].temperature_C, states[-1].temperature_C
    band = next((each for each in (result.ensemble.band if result.ensemble else ()) if each.key == DRAG), None)
    if band is not None:
        judged = [math.log10(end) for end in (band.low, band.high) if end]
        lines += [Curve([(cold, end), (hot, end)], "judged between", 3) for end in judged]
    told = ", ".join(f"{state.temperature_C:g} °C {number(state.rolling_drag_per_s, 3)} 1/s" for state in states)
    up = Axis.around("power of ten of the drag rate [1/s]", [y for line in lines for _, y in line.points])
    chart = Plot("Drag of the oil", told, Axis("oil [°C]", cold, hot), up, lines)
    caption = (
        "Viscous drag rate of the balls from cold to hot oil. Between the lines of the range judged the verdict holds; "
        "beyond them it is not tried."
    )
    yield Figure("oil", "oil", chart, caption)


DRAG: Final = "autobalancer.rolling_drag_per_s"


def _measured(result: SizeResult) -> Iterator[MarkedPoint]:
    """Point measured with the autobalancer, at the rated speed."""
    measurement = result.measured_after
    if measurement is not None:
        speed = from_si(result.model.speed_rad_per_s, "rpm")
        yield MarkedPoint(speed, measurement.measured_level_db, f"measured, {measurement.place}", 3)


def _forbidden(result: SizeResult) -> list[tuple[float, float]]:
    """Ranges of speed [rpm] in which the balanced state is not stable."""
    ranges, start = [], 0.0
    boundaries = sorted(result.frequency.stability_boundaries_rpm or (), key=lambda edge: edge.speed_rpm)
    lowest = min((speed_level.speed_rpm for speed_level in result.vibration.by_speed or ()), default=0.0)
    for boundary in boundaries:
        if boundary.stable_above and boundary.speed_rpm > lowest:
            ranges.append((start, boundary.speed_rpm))
        start = boundary.speed_rpm
    if boundaries and not boundaries[-1].stable_above:
        ranges.append((start, max(start, *(speed_level.speed_rpm for speed_level in result.vibration.by_speed or ()))))
    return ranges


def _budget(result: SizeResult) -> Iterator[Figure]:
    budget = result.accuracy_budget
    names = quantities(type(budget))
    rows = [
        Bar(names[name].label, value, value_of(budget, name), 2 if name in SUMS else 1)
        for name in PARTS
        if (value := getattr(budget, name))
    ]
    if not rows:
        return
    limit = (budget.permitted_um, f"permitted {micrometres(budget.permitted_um)}") if budget.permitted_um else None
    axis = Axis(
        "displacement of the race, 0–peak [µm]", 0.0, max(max(bar.value for bar in rows), limit[0] if limit else 0)
    )
    text = "; ".join(f"{bar.name} {bar.text}" for bar in rows) + (f"; {limit[1]}" if limit else "")
    caption = "Displacements of the race that remain after the balls settle, by cause, and their sums."
    caption += " The expected residual should end left of the dashed line." if limit else ""
    yield Figure("budget", "accuracy-budget", Bars("Residual-displacement budget", text, axis, rows, limit), caption)


IDLE_START: Final = "bunched"
IDLE_RACE_CENTRE: Final = 180.0
"""Start and angle of the race's centre from the imbalance [deg] in the idle scene."""


def _motion(result: SizeResult) -> Iterator[Figure]:
    if result.idle_run is None:
        return
    others = [(start_label(start), start.view) for start in result.starts.views if not _is_idle_scene(start, result)]
    chosen = " The list offers further start cases, from their beginning." if others else ""
    caption = (
        "Balls and spindle axis as seen in the rotor, which turns anticlockwise. Left: the balls leave the imbalance "
        "(red) and come to rest against it. Right: path of the spindle axis, without its drift. The space key starts "
        f"and stops the run, arrow keys move in time.{chosen}"
    )
    motion = RotorMotionFigure(result.idle_run, _idle_label(result), others)
    yield Figure("motion", "simulation-idle", motion, caption)


def _is_idle_scene(start: StartView, result: SizeResult) -> bool:
    """True for the start case that the idle scene simulates, too."""
    same_start = start.start == IDLE_START and start.race_centre_deg == IDLE_RACE_CENTRE
    return same_start and start.drag_per_s == result.model.drag_per_s


def idle_case(result: SizeResult) -> str:
    """Start case of the idle scene in words."""
    return start_case(IDLE_START, IDLE_RACE_CENTRE, result.model.drag_per_s)


def start_case(start: str, race_centre_deg: float, drag_per_s: float) -> str:
    """A start case in words: how the balls start, the side of the race, the drag rate.

    >>> start_case("standstill", 180.0, 15.0)
    'standstill, race centre 180°, drag rate 15 1/s'
    """
    return f"{start}, race centre {race_centre_deg:g}°, drag rate {drag_per_s:.4g} 1/s"


def start_label(start: StartView) -> str:
    """A start case of the list, with its outcome."""
    placed = f" ({', '.join(f'{angle:.0f}°' for angle in start.angles_deg)})" if start.angles_deg else ""
    case = start_case(f"{start.start}{placed}", start.race_centre_deg, start.drag_per_s)
    reason = ""
    if start.why == "worst" and start.balanced:
        reason = ", the loudest"
    elif start.why == "typical":
        reason = ", median quiet time"
    ends = _quiet(start.quiet_time_s) if start.balanced else "does not balance"
    return f"{capitalised(case)}{reason}: {'balls stall' if start.stalled else ends}, {db(start.level_db)}"


def _quiet(time: float | None) -> str:
    return "never quiet" if time is None else f"quiet after {number(time, 2)} s"


def _idle_label(result: SizeResult) -> str:
    """The idle scene in the list of start cases, with its outcome."""
    scene = next((scene for scene in result.simulation if scene.scene == "idle"), None)
    if scene is None or scene.level_db is None:
        return capitalised(idle_case(result))
    return f"{capitalised(idle_case(result))}: {_quiet(scene.quiet_time_s)}, {db(scene.level_db)}"


def _settling(result: SizeResult) -> Iterator[Figure]:
    if result.idle_run is None:
        return
    check = first_of(result.checks, "balance")
    limit = None if check is None else check.limit
    bound = " It should fall below the dashed line and stay there." if limit is not None else ""
    caption = f"Imbalance that rotor and balls leave together, idle, {idle_case(result)}.{bound}"
    yield Figure("settling", "simulation-idle", settling(result.idle_run, limit), caption)


def _over_time(result: SizeResult) -> Iterator[Figure]:
    """Levels of the simulated runs: idle with the limit and the measured level, grinding without them."""
    where = "at the loudest place, dB re 5e-8 m/s rms"
    if result.idle_run is not None:
        bound, measured = _limit(result, "idle_level"), result.measured_after
        limit = None if bound is None else bound[0]
        shown = None if measured is None else measured.measured_level_db
        caption = f"Velocity level over each revolution, idle, {idle_case(result)}, {where}."
        caption += " It should end below the dashed limit." if limit is not None else " It should fall and stay low."
        caption += "" if measured is None else f" Lozenge: measured with the autobalancer, {measured.place}."
        yield Figure("level", "simulation-idle", level(result.idle_run, limit, shown), caption)
    if result.grinding_run is not None:
        settled = None if result.vibration_loaded is None else result.vibration_loaded.level_after_db
        caption = (
            "Velocity level over each revolution, grinding, pressed to the workpiece before the balls settle: "
            f"{idle_case(result)}, {where}."
        )
        caption += "" if settled is None else f" Pressed after the balls settle: {db(settled)}."
        chart = level(result.grinding_run, None)._replace(title="Level against time, pressed before the balls settle")
        yield Figure("level-loaded", "simulation-grinding", chart, caption)


def _run_up(result: SizeResult) -> Iterator[Figure]:
    """Figure of the ensemble's first start case that runs up, at the given viscous drag rate."""
    for start in result.starts.views:
        if start.view.speed_rpm is not None and start.drag_per_s == result.starts.drag_per_s:
            case = start_case(start.start, start.race_centre_deg, start.drag_per_s)
            caption = (
                f"{capitalised(case)}: speed and imbalance left, from standstill, balls together. The imbalance left "
                "should fall, and stay low at full speed."
            )
            yield Figure("run-up", "many-starts", caught(start.view, start.view.speed_rpm), caption)
            if start.scene is not None:
                yield from amplitude_figure(start.scene, "many-starts", capitalised(case))
            return


def _candidates(result: SizeResult) -> Iterator[Figure]:
    """Mass against residual; the chosen one is filled and named, the others numbered as in the table."""
    all_of_them = [(balls(result.autobalancer), result.autobalancer)] + [
        (f"{number}", candidate) for number, candidate in enumerate(result.alternatives, 1)
    ]
    points = [
        MarkedPoint(candidate.mass_g, candidate.residual_um, word, 1 if candidate is result.autobalancer else 2)
        for word, candidate in all_of_them
        if candidate.residual_um is not None
    ]
    if len(points) < 2:
        return
    up = Axis.around("expected residual [µm]", (point.y for point in points))
    across = Axis.around("mass with balls [g]", (point.x for point in points))
    text = "; ".join(
        f"{balls(candidate)}: {value_of(candidate, 'mass_g')}, {value_of(candidate, 'residual_um')}"
        for _, candidate in all_of_them if candidate.residual_um is not None
    )  # fmt: skip
    caption = (
        "Mass and expected residual of the candidates. The chosen one is filled. Squares carry the row numbers of the "
        "table below."
    )
    chart = Plot("Mass against residual", text, across, up, (), points[::-1])
    yield Figure("candidates", "runners-up", chart, caption)


def _costs(result: SizeResult) -> Iterator[Figure]:
    rows = sorted(
        (Bar(entry.feature, entry.cost_db, db(entry.cost_db)) for entry in result.drawing if entry.cost_db is not None),
        key=lambda bar: -bar.value,
    )
    if not rows or rows[0].value <= 0:
        return
    axis = Axis("level rises by [dB]", min(0.0, rows[-1].value), rows[0].value)
    text = "; ".join(f"{bar.name} {bar.text}" for bar in rows)
    caption = "Rise of the expected level if one tolerance of the drawing is used up, the others as budgeted."
    yield Figure("costs", "for-the-drawing", Bars("Cost of each tolerance", text, axis, rows), caption)


def _limit(result: SizeResult, key: str) -> tuple[float, str] | None:
    limit = next((check.limit for check in result.checks if check.key == key and check.limit is not None), None)
    return None if limit is None else (limit, f"limit {number(limit)} dB")


RUN_UP_ACCURACY: Final = 0.02
"""Accuracy of the two runs that are drawn."""


def amplitude_figure(scene: Scene, section: str, case: str = "") -> Iterator[Figure]:
    """The figure of a scene that runs up; none if neither run can be trusted. `case`: start case in words."""
    with_balls, bare = (_in_user_units(course) for course in both_courses(scene, RUN_UP_ACCURACY))
    if not with_balls and not bare:
        return
    where = "at the race" if scene.races else "of the spindle"
    first = f"{case}: largest" if case else "Largest"
    missing = "" if with_balls or not scene.races else " No trustworthy run with balls."
    missing += "" if bare else " No trustworthy run without balls."
    caption = (
        f"{first} displacement {where} in each revolution against speed, with balls "
        "and without. Balls do not help below the natural frequencies. At full speed they settle: the curve falls "
        f"there.{missing}"
    )
    yield Figure("run-up-amplitude", section, run_up_chart(with_balls, bare, "without balls"), caption)


def _in_user_units(course: Course) -> list[tuple[float, float]]:
    return [(from_si(speed, "rpm"), from_si(amplitude, "um")) for speed, amplitude in course]
