"""The whole report of `abu size`: verdict, checks, warnings, design, then the reasons."""

from collections.abc import Iterator, Sequence

from abu_calc.dynamics.stability.boundaries import StabilityBoundary
from abu_calc.features.design.band import OilRecord, oil_blocks
from abu_calc.features.design.figures import idle_case, size_charts
from abu_calc.features.design.records import AutobalancerRecord, Frequency, Vibration
from abu_calc.features.design.screen import first_lines
from abu_calc.features.design.starts import EnsembleResult, FurtherStarts, SettlingOfStart
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.tables import (
    MOST_HANDLES,
    action_groups,
    balls,
    gap_table,
    handle_tables,
    make,
    numbers_that_matter,
    section_picture,
)
from abu_calc.features.grinding.view import start_blocks
from abu_calc.features.swing_arm.view import arm_facts, motion_blocks, printed_otherwise
from abu_calc.foundation.checks import Check, first_of
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, number
from abu_calc.reporting.charts.characters import pictured
from abu_calc.reporting.parts import (
    check_blocks,
    contents,
    default_blocks,
    facts,
    file_of,
    measured_after_blocks,
    not_requested,
    options_of,
    provenance_blocks,
    shown_blocks,
    value_of,
    warning_blocks,
)
from abu_calc.simulation.records import SimulatedScene

CONVENTIONS = (
    "Amplitudes are 0–peak. Levels are 20 lg(v / 5e-8 m/s), v the rms velocity in the louder of x and y. "
    "Negative interference is clearance. Angles of balls count from the imbalance in the sense of rotation."
)
START = (
    "Every scene starts at full speed, with the axis at rest. The balls start at rest in the race, together 20° ahead "
    "of the imbalance. The race's centre lies at 180° from it. Rolling inertia and viscous drag are always included. "
    "The estimated influence of an effect is the change that leaving it out may cause. `abu effects {file}` lists them."
)

UNKNOWN_OIL = "A third of the given drag rate stands for hot oil, three times of it for cold oil."
WAYS = (
    "Bunched: the balls start together, 20° ahead of the imbalance. Behind: together, 20° behind it. Spread: evenly "
    "spread. Standstill: not turning with the race. Run-up: the machine starts from standstill.",
    f"{UNKNOWN_OIL} Settling times count from full "
    "speed. Each is that of the slower side of the race. Its centre is at 0° from the imbalance, and at the given drag "
    "rate also at 180°.",
    "Below the optimum drag rate small disturbances decay at h₀/(2J), whatever the mass of the balls. Above it heavier "
    "balls settle faster. From standstill the balls take up the speed at h₀/J. The radius of the groove has no "
    "influence in the plane.",
)
BAND = (
    "A further start case within what is promised can fail a check, one within what is usual warns. All are judged by "
    "the limits of the file, and by the level without balls at its imbalance. `machine.held` says whether the spindle "
    "may be turned."
)
REPEAT = "`abu simulate {file} --start spread --race-centre 0` repeats one listed start case."
GAPS = (
    "A value counts as assumed if the file leaves it to the default, or gives the same figure. The table lists the "
    "three assumed values that most move the verdict, for the balls and the race of this design. Levels are "
    "calculated, as expected. The quiet time is simulated, for the start case that "
    "is slowest as the file stands. At other drag rates it is that of the slowest start case there. Usual ranges are "
    "engineering practice (unverified)."
)
ROWS = 15
"""Rows of the section's picture."""


def size_blocks(result: SizeResult) -> tuple[Block, ...]:
    """The whole report."""
    return pictured(_blocks(result), size_charts(result))


def _blocks(result: SizeResult) -> tuple[Block, ...]:
    details = _details(result)
    return *first_lines(result), *contents(details), *details


def _details(result: SizeResult) -> tuple[Block, ...]:
    """From the decision to the reasons."""
    return (
        Heading("Parts", "make"),
        *make(result),
        Heading("Levels and times", "levels"),
        *numbers_that_matter(result)[1:],
        *_checks(result.checks),
        *warning_blocks(result.warnings),
        *_design(result),
        *_section(result),
        *_drawing(result),
        *_need(result),
        *_vibration(result),
        *oil_blocks(result.oil, result.autobalancer.optimum_drag_per_s),
        *_ensemble(result),
        *_data_gaps(result),
        *_simulation(result),
        *_alternatives(result.alternatives),
        *_swing_arm(result),
        *_seats(result),
        Heading("Conventions", "conventions"),
        Paragraph(CONVENTIONS),
        *default_blocks(result.provenance.defaults),
        *provenance_blocks(result.provenance),
    )


def _checks(checks: Sequence[Check]) -> list[Block]:
    """All checks as a table; those that did not simply pass with their actions, by the numbers of the tables above."""
    groups = action_groups(checks, frozenset())
    return [*check_blocks(checks, with_reasons=False), *(line for group in groups for line in group),
            *not_requested(checks)]  # fmt: skip


def _design(result: SizeResult) -> list[Block]:
    """The chosen autobalancer; the speed that carries balls over concerns horizontal spindles alone."""
    design, horizontal = result.autobalancer, first_of(result.checks, "carry_over")
    names = (
        *("ball_mass_g", "race_radius_mm", "pitch_radius_mm", "groove_radius_mm", "outer_diameter_mm", "width_mm"),
        *("mass_g", "mass_fraction", "capacity_g_mm", "capacity_ratio", "ball_force_N", "contact_pressure_MPa"),
        *("hoop_stress_MPa", *(("carry_over_rpm",) if horizontal else ()), "optimum_drag_per_s"),
        "slowest_decay_per_s",
    )
    rows = ((f"{design.ball_material} {design.corrector}s", "n × 2r", balls(design)), *facts(design, *names).rows)
    return [Heading("Design"), Facts(rows), Paragraph(f"Housing {design.housing}.")]


def _section(result: SizeResult) -> list[Block]:
    """The picture, and what the drawing shows."""
    section = result.section
    names = (
        *("bore_diameter_mm", "bore_class", "bore_limits_um", "hub_diameter_mm", "race_diameter_mm"),
        *("race_tolerance_mm", "ring_diameter_mm", "wall_mm", "web_mm", "inner_width_mm"),
    )
    rows = tuple((part.name, part.material, value_of(part, "mass_g")) for part in section.parts)
    return [
        Heading("Section", "section"),
        *section_picture(result, ROWS),
        facts(section, *names),
        Grid(("part", "material", "mass"), rows, frozenset({2})),
        Paragraph("To scale with dimensions: --output section.dxf or section.svg."),
    ]


def _ensemble(result: SizeResult) -> list[Block]:
    """Medians and the worst of many starts."""
    many = result.ensemble
    if many is None:
        return []
    spreads = (
        ("quiet time", many.quiet_time_s, "s"),
        ("rest time", many.rest_time_s, "s"),
        ("level", many.level_db, "dB"),
        ("residual", many.residual_um, "µm"),
    )
    rows = tuple((name, _or_never(spread.typical), _or_never(spread.worst), unit) for name, spread, unit in spreads)
    return [
        Heading("Start cases", "many-starts"),
        facts(many, "members", "balanced", "hanging"),
        Grid(("", "median at rated speed", "largest of all", ""), rows, frozenset({1, 2})),
        Heading("Quiet time in s, by start case and drag rate, slower side of the race"),
        _ways(many.settling_by_start),
        *map(Paragraph, _ways_in_words(result.oil)),
        Paragraph(REPEAT.format(file=file_of(result))),
        *_band(many),
        *_further(result, many.further_starts),
    ]


def _ways_in_words(oil: OilRecord | None) -> tuple[str, ...]:
    """Explanation of the start cases; drag rates stand for working, hot and cold oil."""
    if oil is None:
        return WAYS
    cold, _, hot = oil.temperatures
    states = (
        f"The lowest drag rate is that of hot oil, {hot.temperature_C:g} °C, the highest that of cold oil, "
        f"{cold.temperature_C:g} °C."
    )
    return WAYS[0], WAYS[1].replace(UNKNOWN_OIL, states), WAYS[2]


def _band(many: EnsembleResult) -> list[Block]:
    """How far further start cases vary the values of the file."""
    if not many.band:
        return []
    rows = tuple(
        (row.key, number(row.low, 3), number(row.high, 3), "promised" if row.promised else "usual") for row in many.band
    )
    return [
        Heading("Band of the further start cases"),
        Grid(("", "lowest", "highest", ""), rows, frozenset({1, 2})),
        Paragraph(BAND),
    ]


def _further(result: SizeResult, further: FurtherStarts | None) -> list[Block]:
    """Worst further start cases, with the commands that repeat them."""
    if further is None or not further.repeats:
        return []
    replaced = options_of(result.provenance)
    return [
        Heading("To repeat further start cases"),
        *(
            Paragraph(f"{each.check}, {each.which}: `abu simulate {file_of(result)}{replaced} {each.options}`.", hang=2)
            for each in further.repeats
        ),
    ]


def _data_gaps(result: SizeResult) -> list[Block]:
    """Assumed values that most move the verdict."""
    table = gap_table(result.data_gaps)
    return [Heading("Data gaps", "data-gaps"), *table, Paragraph(GAPS)] if table else []


def _ways(entries: Sequence[SettlingOfStart]) -> Grid:
    """A row for each kind of start, a column for each drag, ascending."""
    drags = sorted({entry.drag_per_s for entry in entries})
    times = {(entry.start, entry.drag_per_s): entry.quiet_time_s for entry in entries}
    rows = tuple(
        (start, *(_or_never(times[start, drag]) if (start, drag) in times else "" for drag in drags))
        for start in dict.fromkeys(entry.start for entry in entries)
    )
    return Grid(("", *(f"{number(drag, 3)} 1/s" for drag in drags)), rows, frozenset(range(1, len(drags) + 1)))


def _or_never(value: float | None) -> str:
    return "never" if value is None else number(value, 3)


def _need(result: SizeResult) -> list[Block]:
    budget = result.accuracy_budget
    silent = {name for name in ("plane_offset_um", "capacity_shortfall_um") if not getattr(budget, name)}
    return [
        Heading("Frequencies and capacity"),
        facts(result, "system_mass_kg", "effective_mass_kg"),
        facts(result.body),
        facts(result.frequency, "speed_hz", "natural_frequencies_hz", "region", "finite_mass_gap"),
        facts(result, "idle_speed_rpm"),
        Paragraph(_stability(result.frequency)),
        Paragraph(_hanging(result)),
        facts(result, "imbalance_g_mm", "required_capacity_g_mm", "required_capacity_limit_g_mm",
              "required_capacity_compliant_g_mm"),
        Heading("Residual-displacement budget of the race", "accuracy-budget"),
        facts(budget, *(name for name in budget.entries() if name not in silent)),
    ]  # fmt: skip


def _stability(frequency: Frequency) -> str:
    """Stability by the eigenvalues, stated beside the simple rule."""
    stable, limits = frequency.stable, frequency.stability_boundaries_rpm
    if stable is None or limits is None:
        return "The stability of the balanced state at idle is not known."
    word = "stable" if stable else "not stable"
    changes = ", ".join(f"{number(boundary.speed_rpm, 4)} rpm ({_above(boundary)} above)" for boundary in limits)
    modes = (f"{number(mode.frequency_hz, 3)} Hz ({_damping(mode.damping_ratio)})" for mode in frequency.modes)
    return (
        f"The balanced state at idle is {word} at the rated speed, by the eigenvalues of its least stable arrangement. "
        f"Its stability changes at {changes or 'no speed'}. The machine's free oscillations are at "
        f"{', '.join(dict.fromkeys(modes)) or 'no frequency'}."
    )


def _damping(ratio: float) -> str:
    """The damping ratio of a mode; the eigenvalues of an undamped one leave rounding errors alone.

    >>> _damping(0.05), _damping(-2e-17)
    ('ζ 0.050', 'ζ below 0.0001')
    """
    return f"ζ {number(ratio, 2)}" if abs(ratio) >= 1e-4 else "ζ below 0.0001"


def _hanging(result: SizeResult) -> str:
    """The closed bound on the drag rate, and the given rate."""
    bound, drag = result.frequency.hanging_drag_per_s, result.model.drag_per_s
    if bound is None:
        return "Balls may stall at a resonance at any drag rate, because nothing damps the resonance."
    if not bound:
        return "No ball stalls at a resonance, at any drag rate."
    if drag > bound:
        times = number(drag / bound, 3)
        return f"No ball stalls above a drag rate of {number(bound, 3)} 1/s. The given rate is {times} times that."
    return (
        f"Below a drag rate of {number(bound, 3)} 1/s balls may stall, at a resonance or at standstill; the given rate "
        f"is {number(drag, 3)} 1/s. This is a bound, not a verdict: a simulated slow run-up decides."
    )


def _above(boundary: StabilityBoundary) -> str:
    return "stable" if boundary.stable_above else "not stable"


def _vibration(result: SizeResult) -> list[Block]:
    states = (("idle", result.vibration), ("under load", result.vibration_loaded))
    rows: list[tuple[str, ...]] = [
        (state, place.name, *map(_tenths, (place.level_before_db, place.level_after_db, place.level_at_once_db,
                                           place.reduction_db, place.effective_mass_kg)))
        for state, vibration in states if vibration
        for place in vibration.handles
    ]  # fmt: skip
    header: tuple[str, ...] = "", "place", "without, dB", "with, dB", "at once", "reduction", "effective mass, kg"
    loaded = result.vibration_loaded
    if loaded is None or loaded.level_at_once_db is None:
        header, *rows = (row[:4] + row[5:] for row in (header, *rows))
    table = Grid(header, tuple(rows), frozenset(range(2, len(header))))
    blocks: list[Block] = [Heading("Vibration level", "vibration-level"), table]
    if len(result.vibration.handles) > MOST_HANDLES:
        blocks += handle_tables(result, {}, len(result.vibration.handles))
    if result.vibration.at_idle_speed:
        blocks.append(facts(result.vibration.at_idle_speed))
    if loaded:
        blocks += [Paragraph(text) for text in _under_load(loaded)]
        blocks += start_blocks(loaded.starts)
    shown = [
        (f"{place.name}, {state}{when}", readings)
        for state, vibration in states if vibration
        for place in vibration.handles
        for when, readings in ((", without", place.shown_before), (", with", place.shown_after)) if readings
    ]  # fmt: skip
    return [*blocks, *shown_blocks(shown), *measured_after_blocks(result.measured_after)]


def _under_load(loaded: Vibration) -> Iterator[str]:
    """Explanation of the levels under load."""
    yield "Levels under load are information, not a check: they depend on the contact stiffness."
    if loaded.level_at_once_db is not None:
        stays = " Wheel and workpiece then go on bouncing." if loaded.at_once_stays else ""
        yield f"With: pressed to the workpiece after the balls have settled. At once: pressed before that.{stays}"
    if loaded.steady_level_after_db is not None:
        steady = f"the {_tenths(loaded.steady_level_after_db)} dB of steady contact are not valid"
        yield f"Wheel and workpiece lose contact. The level with the autobalancer is simulated; {steady}."


def _tenths(value: float | None) -> str:
    return "–" if value is None else f"{value:.1f}"


def _simulation(result: SizeResult) -> list[Block]:
    blocks = [block for scene in result.simulation for block in _scene(scene, idle_case(result))]
    return [*blocks, Paragraph(START.format(file=file_of(result)))] if blocks else []


def _scene(scene: SimulatedScene, case: str) -> list[Block]:
    """Outcome of one scene; `case`: the start case from which every scene begins."""
    cost, angles = scene.cost, ", ".join(f"{angle:.1f}°" for angle in scene.final.ball_angles_deg)
    work = f"{cost.integrator}, tolerance {cost.tolerance:g}, {cost.evaluations} evaluations"
    times = facts(scene, "quiet_time_s", "rest_time_s").rows
    named = tuple((f"{label}, {case}", symbol, value) for label, symbol, value in times)
    return [
        Heading(f"Simulation: {scene.scene}", f"simulation-{scene.scene}"),
        Facts((
            *facts(scene, "duration_s").rows,
            *named,
            *facts(scene, "residual_imbalance_g_mm", "axis_amplitude_mm", "level_db", "error_estimate").rows,
        )),
        Paragraph(f"Scene {scene.scene}: the balls end at {angles} from the imbalance."),
        Paragraph(f"Effects in scene {scene.scene}: {_in(scene)}. Left out: {_out(scene)}."),
        Paragraph(f"Cost: {work}, {cost.wall_s:.2f} s."),
    ]  # fmt: skip


def _in(scene: SimulatedScene) -> str:
    return ", ".join(each.name for each in scene.effects if each.included) or "none"


def _out(scene: SimulatedScene) -> str:
    return ", ".join(f"{each.name} ({_weight(each.weight)})" for each in scene.effects if not each.included) or "none"


def _weight(weight: float | None) -> str:
    return "influence not known" if weight is None else f"estimated influence {number(weight, 2)}"


def _alternatives(others: Sequence[AutobalancerRecord]) -> list[Block]:
    if not others:
        return []
    names = ("race_radius_mm", "mass_g", "capacity_ratio", "residual_um", "slowest_decay_per_s")
    rows = tuple((balls(other), *(_bare(other, name) for name in names), other.why_not or "") for other in others)
    header = ("balls", "R, mm", "mass, g", "capacity ratio", "residual, µm", "decay, 1/s", "why not")
    return [Heading("Runners-up", "runners-up"), Grid(header, rows, frozenset({1, 2, 3, 4, 5}))]


def _bare(autobalancer: AutobalancerRecord, name: str) -> str:
    """A number whose unit stands in the header."""
    return "–" if getattr(autobalancer, name) is None else value_of(autobalancer, name).split(" ")[0]


def _swing_arm(result: SizeResult) -> list[Block]:
    arm, motion = result.swing_arm, result.arm_motion
    if arm is None:
        return []
    moved = [*motion_blocks(motion, " while cutting"), *printed_otherwise()] if motion else []
    return [*arm_facts(arm), *moved]


def _seats(result: SizeResult) -> tuple[Block, ...]:
    if not result.fits:
        return ()
    from abu_calc.features.seats.view import fit_blocks

    return fit_blocks(result.fits)


def _drawing(result: SizeResult) -> list[Block]:
    rows = tuple(
        (line.feature, line.requirement, "" if line.cost_db is None else f"{line.cost_db:.1f}")
        for line in result.drawing
    )
    note = (
        "The cost is the rise of the level if this tolerance is used up and all others stay. "
        "Requirements are engineering practice (assumed)."
    )
    return [
        Heading("For the drawing", "for-the-drawing"),
        Grid(("feature", "requirement", "costs, dB"), rows, frozenset({2})),
        Paragraph(note),
    ]
