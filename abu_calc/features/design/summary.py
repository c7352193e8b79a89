"""Summary of a sized machine for the first two sheets of its page: the numbers of the first screen, actions, notes.

Formulas of each step with the numbers of a sized machine put in: lines, or None if it has no such step.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import accumulate
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.features.design.screen import verdict_paragraph
from abu_calc.features.design.study import SizeResult
from abu_calc.features.design.tables import (
    action_groups,
    arm_change,
    gap_table,
    make,
    marked,
    numbers_that_matter,
    other_notes,
    point_mass,
    starts_and_defaults,
    title_with_speed,
    unusual_values,
)
from abu_calc.features.explain.steps import STEPS, si_conversions, step_formulas
from abu_calc.features.swing_arm.view import arm_bounds
from abu_calc.foundation.formula import Formula
from abu_calc.foundation.units import from_si
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number
from abu_calc.reporting.parts import unlike
from abu_calc.reporting.screen import many

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult


ENTRIES: Final = Paragraph(
    "The lines below an action are entries of the machine file, each behind the table in which it stands."
)


SHEETS_MM: Final = 2 * 269.0
"""Height of two A4 sheets between their margins."""
SPARE_MM: Final = 60.0
"""Height that may stay empty above a table that begins on the second sheet."""
TITLE_MM: Final = 25.0
HEADING_MM: Final = 12.0
ROW_MM: Final = 6.3
LINE_MM: Final = 4.9
"""Heights of the title with the verdict, of a heading, of a row of a table and of a line of text."""
LETTERS: Final = 92
"""Letters of a line of text."""


class Summary(NamedTuple):
    """Blocks of the summary, and whether they hold every note."""

    blocks: tuple[Block, ...]
    whole: bool


def size_summary(result: SizeResult, drawing_mm: float) -> Summary:
    """Title, verdict, what to make, levels and settling times with limits, actions, notes.

    `drawing_mm`: height of the section drawing. What has no room on two sheets is named and stands in the details.
    """
    tables = numbers_that_matter(result)
    changed = any(check.overrides for check in result.checks if check.status != "pass")
    body: list[Block] = [
        *unusual_values(result, most=None),
        *arm_change(result),
        *make(result),
        *tables,
        *([arm_bounds(result.swing_arm)] if result.swing_arm else []),
        Paragraph(starts_and_defaults(result)),
    ]
    notes = [*point_mass(result), *other_notes(result)]
    room = SHEETS_MM - SPARE_MM - TITLE_MM - drawing_mm - sum(map(height_mm, body))
    codes = [alike[0].code for alike in unlike(result.checks)]
    shown = first_that_fit(action_groups(result.checks, marked(tables)), room - HEADING_MM - 2 * LINE_MM)
    more = [Paragraph(f"More actions, see Checks: {', '.join(codes[len(shown) :])}.")] if codes[len(shown) :] else []
    actions = [*([ENTRIES] if changed else []), *(line for group in shown for line in group), *more]
    if codes:
        body += [Heading("Actions"), *actions]
    room -= HEADING_MM + sum(map(height_mm, actions)) if codes else 0.0
    gaps = gap_table(result.data_gaps)
    body += gaps
    room -= sum(map(height_mm, gaps))
    fitting = first_that_fit([[note] for note in notes], room - HEADING_MM - LINE_MM)
    left = len(notes) - len(fitting)
    further = [Paragraph(f"See Warnings for {many(left, 'more note')}.")] if left else []
    if notes:
        body += [Heading("Notes"), *(note for group in fitting for note in group), *further]
    return Summary(
        (Heading(title_with_speed(result)), verdict_paragraph(result.verdict, result.checks), *body), not left
    )


def first_that_fit(groups: Sequence[Sequence[Paragraph]], room_mm: float) -> list[Sequence[Paragraph]]:
    """The first groups of lines that fit into a height."""
    heights = accumulate(sum(map(height_mm, group)) for group in groups)
    return [group for group, height in zip(groups, heights, strict=True) if height <= room_mm]


def height_mm(block: Block) -> float:
    """Approximate height of a block on paper."""
    match block:
        case Paragraph(text) if text:
            entries = text.count("--set ")
            return LINE_MM * (entries or math.ceil(len(text) / LETTERS)) + (0.0 if entries else 1.0)
        case Grid(_, rows):
            return ROW_MM * (1 + len(rows)) + 2.0
        case Heading():
            return HEADING_MM
    return 0.0


Lines = tuple[str, ...]


def _n(value: float | None) -> str:
    return "not computed" if value is None else number(value)


def frequency(result: "SizeResult") -> Lines:
    """The finite-mass gap, the region of the speed, and the drag rate above which no ball stalls."""
    frequency, design, model = result.frequency, result.autobalancer, result.model
    natural = ", ".join(map(_n, frequency.natural_frequencies_hz))
    return (
        f"(2m/(J·M))^(1/3) = (2 · {_n(design.ball_mass_g)} g / ({_n(model.inertia_factor)} · "
        f"{_n(result.effective_mass_kg)} kg))^(1/3) = {_n(frequency.finite_mass_gap)}",
        f"Ω/2π = {_n(frequency.speed_hz)} Hz, ω/2π = {natural} Hz: {frequency.region}",
        f"no ball stalls above h₀ = {_n(frequency.hanging_drag_per_s)} 1/s; given {_n(model.drag_per_s)} 1/s",
    )


def imbalance(result: "SizeResult") -> Lines:
    """Imbalance, and its source."""
    return (f"m₀e = {_n(result.imbalance_g_mm)} g·mm ({result.model.imbalance_source})",)


def mass(result: "SizeResult") -> Lines:
    """Mass of the whole system, and the effective mass at the wheel."""
    return (f"M = {_n(result.system_mass_kg)} kg, effective mass at the wheel {_n(result.effective_mass_kg)} kg",)


def capacity(result: "SizeResult") -> Lines:
    """The sum, the published limit, the capacity for a compliant contact."""
    model = result.model
    return (
        f"m₀e + M·ε·√{{…}} + M·Δ = {_n(result.imbalance_g_mm)} + {_n(model.runout_part_g_mm)} + "
        f"{_n(model.eccentricity_part_g_mm)} = {_n(result.required_capacity_g_mm)} g·mm, with √{{…}} = "
        f"{_n(model.runout_factor)} and the plane ratio {_n(model.plane_ratio)}",
        f"published limit: m₀e + Mε = {_n(result.required_capacity_limit_g_mm)} g·mm",
        f"compliant contact: {_n(result.required_capacity_compliant_g_mm)} g·mm",
    )


def budget(result: "SizeResult") -> Lines:
    """The root of the sum of squares, and the permitted displacement."""
    budget = result.accuracy_budget
    parts = budget.race_eccentricity_um, budget.rolling_friction_um, budget.race_ovality_um, budget.plane_offset_um
    squares = " + ".join(f"{_n(part)}²" for part in parts)
    return (f"√({squares}) = {_n(budget.residual_um)} µm, permitted {_n(budget.permitted_um)} µm",)


def balls(result: "SizeResult") -> Lines:
    """Capacity that the chosen balls reach."""
    design, model, pitch = result.autobalancer, result.model, _n(result.autobalancer.pitch_radius_mm)
    return (
        f"sin β = r/(R−r) = {_n(model.ball_radius_mm)}/{pitch}; {_n(design.ball_mass_g)} g · {pitch} mm · "
        f"sin({design.ball_count}β)/sin β = {_n(design.capacity_g_mm)} g·mm = {_n(design.capacity_ratio)} × required",
        f"{model.candidates} diameters and counts were examined",
    )


def track(result: "SizeResult") -> Lines:
    """The radius of the groove, and force and pressure on the race."""
    design, model = result.autobalancer, result.model
    return (
        f"R_g = r + (5/7)(R−r) = {_n(model.ball_radius_mm)} + (5/7)·{_n(design.pitch_radius_mm)} = "
        f"{_n(design.groove_radius_mm)} mm",
        f"F = m·R_p·Ω² = {_n(design.ball_force_N)} N, p₀ = {_n(design.contact_pressure_MPa)} MPa, permitted "
        f"{_n(from_si(model.permitted_pressure_Pa, 'MPa'))} MPa",
    )


def vibration(result: "SizeResult") -> Lines:
    """Levels without and with the autobalancer."""
    before, after = result.vibration.level_before_db, result.vibration.level_after_db
    return (f"without autobalancer {_n(before)} dB, with it {_n(after)} dB",)


def seats(result: "SizeResult") -> Lines | None:
    """None of its own: `abu check-fit --explain` puts them in, bearing by bearing; None without bearings."""
    return () if result.fits else None


def swing_arm(result: "SizeResult") -> Lines | None:
    """Stiffness and damping; None without an arm."""
    arm = result.swing_arm
    if arm is None:
        return None
    return (
        f"c_n < {_n(arm.contact_stiffness_limit_N_per_m)} N/m (series), "
        f"{_n(arm.contact_stiffness_limit_exact_N_per_m)} N/m (exact, at Z* = {_n(arm.worst_contact_angle_deg)}°)",
        f"h_sh > {_n(arm.damping_limit_N_s_per_m)} N·s/m; at Ω = 2ω₀* = 2 · {_n(arm.resonance_rpm)} rpm the motion "
        f"of the arm grows at {_n(arm.parametric_growth_rate_per_s)} 1/s",
        f"off the workpiece {_n(arm.idle_frequency_rpm)} rpm, on it {_n(arm.cutting_frequency_rpm)} rpm; the pivot "
        f"alone makes the arm stand at every contact angle above c_sh = {_n(arm.joint_stiffness_standing_N_per_m)} N/m",
        f"T_a = {_n(arm.pressing_moment_N_m)} > {_n(arm.least_pressing_moment_N_m)} N·m; N = {_n(arm.press_force_N)} N",
    )


NUMBERS: Final[Mapping[str, Callable[["SizeResult"], Lines | None]]] = {
    "frequency": frequency,
    "imbalance": imbalance,
    "mass": mass,
    "capacity": capacity,
    "budget": budget,
    "balls": balls,
    "track": track,
    "vibration": vibration,
    "levels": lambda result: (),
    "grinding": lambda result: (),
    "seats": seats,
    "swing-arm": swing_arm,
    "simulation": lambda result: (),
}
"""Functions from a result to the lines of a step with its numbers, by the names of the steps that `abu size` has.

None: that machine has no such step.
"""


def explanation_blocks(result: "SizeResult") -> tuple[Block, ...]:
    """Every step that the result has, formulas and numbers."""
    blocks: list[Block] = [Heading("FORMULAS, WITH THE NUMBERS OF THIS MACHINE")]
    formulas: list[Formula] = []
    for name, step in STEPS.items():
        numbers = NUMBERS[name](result) if name in NUMBERS else None
        if numbers is not None:
            blocks += step_formulas(step, numbers)
            formulas += step.formulas
    return (*blocks, *si_conversions(formulas))
