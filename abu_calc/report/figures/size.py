"""What `abu size` shows: section and face, levels, candidates, budget, what tolerances cost, the formulas."""

from collections.abc import Iterator
from typing import Final

from abu_calc.report.drawing.autobalancer import face_drawing, section_drawing
from abu_calc.report.drawing.sheets import arm_sheets
from abu_calc.report.explain import explanation_blocks
from abu_calc.report.figures.chart import Axis, Bar, Bars, Line, Plot, Point, db, micrometres
from abu_calc.report.figures.drawings import seat_figures
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.figures.motion import Motion, caught, level, settling
from abu_calc.report.numbers import number
from abu_calc.report.parts import value_of
from abu_calc.report.size_screen import balls
from abu_calc.studies.quantity import quantities
from abu_calc.studies.size import SizeResult
from abu_calc.studies.starts import StartView
from abu_calc.units import from_si

SCALES: Final = (5.0, 2.0, 1.0, 0.5, 0.2)
ROOM: Final = 130.0
"""What the outer diameter may take on paper [mm]."""
PARTS: Final = ("race_eccentricity_um", "rolling_friction_um", "rolling_friction_worst_um", "race_ovality_um",
                "plane_offset_um", "capacity_shortfall_um", "residual_um", "worst_um")  # fmt: skip
SUMS: Final = ("residual_um", "worst_um")


def size_extras(result: SizeResult) -> Extras:
    """Figures, and the calculation note."""
    figures = (
        *_drawings(result), *_levels(result), *_over_speed(result), *_budget(result), *_motion(result),
        *_settling(result), *_over_time(result), *_run_up(result), *_candidates(result), *_costs(result),
    )  # fmt: skip
    return Extras(figures, explanation_blocks(result)[1:])


def size_charts(result: SizeResult) -> tuple[Figure, ...]:
    """Those that a terminal has room for."""
    return (*_over_speed(result), *_settling(result), *_candidates(result))


def _drawings(result: SizeResult) -> Iterator[Figure]:
    outer = result.autobalancer.outer_diameter_mm
    scale = next((one for one in SCALES if one * outer <= ROOM), SCALES[-1])
    told = f"drawn to scale {_ratio(scale)}, sizes in mm"
    yield Figure("section", "Section", section_drawing(result, scale), f"Section through the axis, {told}.")
    face = f"Face with the cover off, {told}; balls evenly round the race."
    yield Figure("face", "Section", face_drawing(result, scale), face)
    for one in arm_sheets(result):
        yield Figure("arm", "Swing arm", one, "Sketch of the swing arm, not to scale.")
    yield from seat_figures(result, result.fits)


def _ratio(scale: float) -> str:
    return f"{scale:g}:1" if scale >= 1 else f"1:{1 / scale:g}"


def _levels(result: SizeResult) -> Iterator[Figure]:
    """Before, after and measured at each place, with the limit."""
    rows = [row for place in result.vibration.handles for row in (
        (f"{place.name}, before", place.level_before_db, 2), (f"{place.name}, after", place.level_after_db, 1)
    )]  # fmt: skip
    if (measured := result.measured_after) is not None:
        rows.append((f"{measured.place}, measured", measured.measured_level_db, 3))
    known = [Bar(name, value, db(value), series) for name, value, series in rows if value is not None]
    if not known:
        return
    limit = _limit(result, "ABU401")
    values = [*(one.value for one in known), *([limit[0]] if limit else [])]
    axis = Axis.around("velocity level, idle [dB]", values)
    told = "; ".join(f"{one.name} {one.told}" for one in known) + (f"; {limit[1]}" if limit else "")
    caption = (
        "Velocity level at each place, idle, at the rated speed, 0 dB = 5e-8 m/s rms: what is after (round) should "
        "stand left of the dashed limit; squares: before, lozenge: measured."
    )
    yield Figure("levels", "Vibration level", Bars("Levels before and after", told, axis, known, limit), caption)


def _over_speed(result: SizeResult) -> Iterator[Figure]:
    levels = result.vibration.by_speed or ()
    if len({one.speed_rpm for one in levels}) < 2:
        return
    course = sorted((one.speed_rpm, one.level_after_db) for one in levels)
    limit = _limit(result, "ABU401")
    bands = _forbidden(result)
    points = [*(Point(*one) for one in course), *_measured(result)]
    across = Axis.around("speed [rpm]", (one.x for one in points))
    up = Axis.around("level [dB]", [*(one.y for one in points), *([limit[0]] if limit else [])])
    told = "; ".join(f"{f'{one.word} ' if one.word else ''}{one.x:.0f} rpm {db(one.y)}" for one in points)
    told += f"; {limit[1]}" if limit else ""
    caption = (
        "Level with the autobalancer at the loudest place over the speed range, 0 dB = 5e-8 m/s rms: the line should "
        f"stay below the dashed limit{', and out of shaded speeds, where the balls do not balance' if bands else ''}."
    )
    chart = Plot("Level against speed", told, across, up, (Line(course),), points, limit, bands)
    yield Figure("speeds", "Vibration level", chart, caption)


def _measured(result: SizeResult) -> Iterator[Point]:
    """What was measured with the autobalancer, at the rated speed."""
    one = result.measured_after
    if one is not None:
        speed = from_si(result.model.speed_rad_per_s, "rpm")
        yield Point(speed, one.measured_level_db, f"measured, {one.place}", 3)


def _forbidden(result: SizeResult) -> list[tuple[float, float]]:
    """Ranges of speed [rpm] in which the balanced state is not stable."""
    found, start = [], 0.0
    boundaries = sorted(result.frequency.stability_boundaries_rpm or (), key=lambda one: one.speed_rpm)
    lowest = min((one.speed_rpm for one in result.vibration.by_speed or ()), default=0.0)
    for one in boundaries:
        if one.stable_above and one.speed_rpm > lowest:
            found.append((start, one.speed_rpm))
        start = one.speed_rpm
    if boundaries and not boundaries[-1].stable_above:
        found.append((start, max(start, *(one.speed_rpm for one in result.vibration.by_speed or ()))))
    return found


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
        "displacement at the wheel, 0–peak [µm]", 0.0, max(max(one.value for one in rows), limit[0] if limit else 0)
    )
    told = "; ".join(f"{one.name} {one.told}" for one in rows) + (f"; {limit[1]}" if limit else "")
    caption = "What keeps the balls from balancing to nothing; the sums should end left of what is permitted (dashed)."
    yield Figure("budget", "Accuracy budget", Bars("Accuracy budget", told, axis, rows, limit), caption)


def _motion(result: SizeResult) -> Iterator[Figure]:
    if result.idle_run is None:
        return
    others = [(_start(one), one.view) for one in result.starts.views]
    chosen = " Other starts of the machine can be chosen, from their beginning." if others else ""
    caption = (
        "The simulated run, seen in the rotor, which turns anticlockwise: the balls leave the imbalance (red) and come "
        "to rest against it; beside them how the axis goes round, drift taken off. Space plays, arrows move in time."
        f"{chosen}"
    )
    yield Figure("motion", "Simulation: idle", Motion(result.idle_run, "simulated: idle", others), caption)


def _start(one: StartView) -> str:
    """A start in a line."""
    ends = "does not balance"
    if one.balanced:
        ends = "balances" if one.settling_time_s is None else f"settles in {number(one.settling_time_s, 2)} s"
    why = f"{one.why}: " if one.why else ""
    return f"{why}{one.start}, drag {number(one.drag_per_s, 3)} 1/s, {ends}, {db(one.level_db)}"


def _settling(result: SizeResult) -> Iterator[Figure]:
    if result.idle_run is None:
        return
    limit = next((one.limit for one in result.checks if one.code == "ABU701"), None)
    caption = "Imbalance of rotor and balls together: it should fall below the dashed line, and stay there."
    yield Figure("settling", "Simulation: idle", settling(result.idle_run, limit), caption)


def _over_time(result: SizeResult) -> Iterator[Figure]:
    """Levels of the simulated runs: idle with the limit and what was measured, at work without."""
    where = "at the loudest place, 0 dB = 5e-8 m/s rms"
    if result.idle_run is not None:
        found, measured = _limit(result, "ABU401"), result.measured_after
        limit = None if found is None else found[0]
        shown = None if measured is None else measured.measured_level_db
        caption = f"Velocity level over each revolution, idle, {where}"
        caption += ": it should end below the dashed limit." if limit is not None else ": it should fall, and stay low."
        caption += "" if measured is None else f" Lozenge: as measured with the autobalancer, {measured.place}."
        yield Figure("level", "Simulation: idle", level(result.idle_run, limit, shown), caption)
    if result.grinding_run is not None:
        caption = f"Velocity level over each revolution at work, {where}: what is left when the balls have settled."
        chart = level(result.grinding_run, None)._replace(title="Level against time, at work")
        yield Figure("level-loaded", "Simulation: grinding", chart, caption)


def _run_up(result: SizeResult) -> Iterator[Figure]:
    """Of the start among those of the ensemble that runs up, at the drag given."""
    for one in result.starts.views:
        if one.view.speed_rpm is not None and one.drag_per_s == result.starts.drag_per_s:
            caption = (
                f"{one.start[0].upper()}{one.start[1:]} from standstill, balls side by side: the imbalance that is "
                "left should fall, and stay low, when the speed is up."
            )
            yield Figure("run-up", "Many starts", caught(one.view, one.view.speed_rpm), caption)
            return


def _candidates(result: SizeResult) -> Iterator[Figure]:
    """Mass against residual; the chosen one is filled and named, the others numbered as in the table."""
    all_of_them = [(balls(result.autobalancer), result.autobalancer)] + [
        (f"{number}", one) for number, one in enumerate(result.alternatives, 1)
    ]
    points = [
        Point(one.mass_g, one.residual_um, word, 1 if one is result.autobalancer else 2)
        for word, one in all_of_them
        if one.residual_um is not None
    ]
    if len(points) < 2:
        return
    up = Axis.around("expected residual [µm]", (one.y for one in points))
    across = Axis.around("mass with balls [g]", (one.x for one in points))
    told = "; ".join(
        f"{balls(one)}: {value_of(one, 'mass_g')}, {value_of(one, 'residual_um')}"
        for _, one in all_of_them if one.residual_um is not None
    )  # fmt: skip
    caption = (
        "Candidates, lighter on the left, nearer to rest below: the chosen one is filled, squares are numbered as the "
        "rows below."
    )
    chart = Plot("Mass against residual", told, across, up, (), points[::-1])
    yield Figure("candidates", "Runners-up", chart, caption)


def _costs(result: SizeResult) -> Iterator[Figure]:
    rows = sorted(
        (Bar(one.feature, one.cost_db, db(one.cost_db)) for one in result.drawing if one.cost_db is not None),
        key=lambda one: -one.value,
    )
    if not rows or rows[0].value <= 0:
        return
    axis = Axis("level rises by [dB]", min(0.0, rows[-1].value), rows[0].value)
    told = "; ".join(f"{one.name} {one.told}" for one in rows)
    caption = (
        "What the level rises by where a tolerance of the drawing is used up: the long bars are worth their money."
    )
    yield Figure("costs", "For the drawing", Bars("What tolerances cost", told, axis, rows), caption)


def _limit(result: SizeResult, code: str) -> tuple[float, str] | None:
    found = next((one.limit for one in result.checks if one.code == code and one.limit is not None), None)
    return None if found is None else (found, f"limit {number(found)} dB")
