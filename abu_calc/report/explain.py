"""The formulas behind every step and every check, and with a result the numbers put in.

What a formula says of itself (equation, units, range, source, where the print differs) is registered where it stands.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from abu_calc.check_codes import CheckCode
from abu_calc.formula import Formula, formula_of
from abu_calc.report.blocks import Block, Heading, Paragraph
from abu_calc.report.numbers import number


@dataclass(frozen=True)
class Step:
    """A step of sizing: the keys of its registered formulas, and lines with the numbers of a result put in."""

    title: str
    keys: tuple[str, ...]
    numbers: tuple[str, ...] = ()

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """What they say."""
        return tuple(map(formula_of, self.keys))


STEPS: Final[Mapping[str, Step]] = {
    "frequency": Step(
        "Frequency region",
        ("sizing.frequency:zones", "sizing.frequency:finite_mass_gap", "formulas.suspension:natural_frequency"),
        (
            "(2m/(J·M))^(1/3) = (2 · {ball_mass_g} g / ({inertia_factor} · {effective_mass_kg} kg))^(1/3) = "
            "{finite_mass_gap}",
            "Ω/2π = {speed_hz} Hz, ω/2π = {natural_frequencies_hz} Hz: {region}",
        ),
    ),
    "imbalance": Step(
        "Imbalance",
        (
            "sizing.imbalance:imbalance_from_level",
            "sizing.imbalance:mean_level",
            "standards.balance:permissible_imbalance",
        ),
        ("m₀e = {imbalance_g_mm} g·mm ({imbalance_source})",),
    ),
    "mass": Step(
        "Mass that moves",
        ("sizing.body:Body.inertance", "sizing.body:Body.effective_mass", "formulas.suspension:Hands"),
        ("M = {system_mass_kg} kg, felt at the wheel: {effective_mass_kg} kg",),
    ),
    "capacity": Step(
        "Required capacity",
        (
            "sizing.capacity:required_capacity",
            "sizing.capacity:runout_factor",
            "formulas.contact:SteadyContact.balancing_imbalance",
            "sizing.capacity:plane_ratio",
        ),
        (
            "m₀e + M·ε·√{{…}} + M·Δ = {imbalance_g_mm} + {runout_part_g_mm} + {eccentricity_part_g_mm} = "
            "{required_capacity_g_mm} g·mm, with √{{…}} = {runout_factor} and the ratio of the planes {plane_ratio}",
            "as printed, m₀e + Mε = {required_capacity_limit_g_mm} g·mm",
            "compliant contact: {required_capacity_compliant_g_mm} g·mm",
        ),
    ),
    "budget": Step(
        "Accuracy budget",
        ("formulas.friction_band:friction_band", "sizing.budget:permitted_displacement", "sizing.budget:plane_rest"),
        (
            "√({race_eccentricity_um}² + {rolling_friction_um}² + {plane_offset_um}²) = "
            "{accuracy_budget_residual_um} µm, permitted {permitted_um} µm",
        ),
    ),
    "balls": Step(
        "Balls",
        (
            "formulas.ball_ring:half_angle",
            "formulas.ball_ring:capacity",
            "formulas.ball_ring:best_count",
            "sizing.balls:choose",
        ),
        (
            "sin β = r/(R−r) = {ball_radius_mm}/{pitch_radius_mm}; {ball_mass_g} g · {pitch_radius_mm} mm · "
            "sin({ball_count}β)/sin β = {capacity_g_mm} g·mm = {capacity_ratio} × need",
            "{candidates} diameters and counts were examined",
        ),
    ),
    "track": Step(
        "Track and housing",
        (
            "sizing.housing:groove_radius",
            "sizing.housing:housing",
            "sizing.stress:hertz_ball_in_toroid",
            "sizing.stress:hertz_roller_in_cylinder",
            "sizing.stress:permitted_pressure",
            "sizing.stress:hoop_stress",
            "sizing.stress:ring_flexure",
            "sizing.track:carry_over_speed",
            "formulas.slow_motion:ball_stiffness",
            "formulas.slow_motion:decay_rate",
            "formulas.slow_motion:optimum_drag",
        ),
        (
            "ρ = r + (5/7)(R−r) = {ball_radius_mm} + (5/7)·{pitch_radius_mm} = {groove_radius_mm} mm",
            "F = m·R_p·Ω² = {ball_force_N} N, p₀ = {contact_pressure_MPa} MPa, permitted {permitted_pressure_Pa} Pa",
        ),
    ),
    "vibration": Step(
        "Vibration level",
        (
            "sizing.vibration:idle_vibration",
            "sizing.vibration:loaded_vibration",
            "sizing.budget:displacement_level",
            "sizing.drawing:extra_level",
        ),
        ("{level_before_db} dB → {level_after_db} dB",),
    ),
    "seats": Step(
        "Bearing seats",
        (
            "fits.interference:theoretical_interference",
            "fits.interference:probable_interference",
            "fits.interference:clearance_probability",
            "fits.interference:truncated_clearance_probability",
            "fits.requirement:creep_interference",
            "fits.requirement:load_loss",
            "fits.requirement:smoothing_loss",
            "fits.requirement:catalogue_smoothing_loss",
            "fits.requirement:temperature_loss",
            "fits.requirement:centrifugal_loss",
            "fits.stress:contact_pressure",
            "fits.stress:inner_ring_stress",
            "fits.stress:outer_ring_stress",
            "fits.stress:raceway_change",
            "fits.creep:friction_torque",
            "fits.clearance:clearance_left",
            "fits.selective:selective_groups",
            "fits.drawing:seat_requirements",
            "fits.advice:load_intensity",
        ),
    ),
    "swing-arm": Step(
        "Swing arm",
        (
            "formulas.swing_arm:contact_gain",
            "formulas.swing_arm:worst_contact_angle",
            "formulas.swing_arm:series_gain",
            "formulas.swing_arm:stiffness_limit",
            "formulas.swing_arm:resonance",
            "formulas.swing_arm:damping_limit",
            "formulas.swing_arm:growth_rate",
            "formulas.swing_arm:arm_stiffness",
            "formulas.swing_arm:pressed_angle",
        ),
        (
            "c_n < {contact_stiffness_limit_N_per_m} N/m (series), {contact_stiffness_limit_exact_N_per_m} N/m (exact, "
            "at Z* = {worst_contact_angle_deg}°)",
            "h_sh > {damping_limit_N_s_per_m} N·s/m; at Ω = 2ω₀* = 2 · {resonance_rpm} rpm the arm grows at "
            "{parametric_growth_rate_per_s} 1/s",
        ),
    ),
    "simulation": Step(
        "Simulation",
        ("formulas.motion:equations", "formulas.motion:settling_time", "formulas.motion:simulate"),
    ),
}
"""Steps in the order of the pipeline."""

OPTIONAL: Final = {"swing-arm": "swing_arm", "seats": "fits"}
"""Steps that a result may lack, and its key."""


def explanation_blocks(result: Mapping[str, Any], model: Mapping[str, Any]) -> tuple[Block, ...]:
    """Every step that the result has, formulas and numbers."""
    values = _namespace(result, model)
    blocks: list[Block] = [Heading("FORMULAS, WITH THE NUMBERS OF THIS MACHINE")]
    for name, step in STEPS.items():
        if name in OPTIONAL and not result.get(OPTIONAL[name]):
            continue
        blocks += step_blocks(step, tuple(line.format_map(values) for line in step.numbers))
    return tuple(blocks)


def step_blocks(step: Step, numbers: tuple[str, ...] = ()) -> list[Block]:
    """One step: numbers first, then each formula as it speaks of itself."""
    return [Heading(step.title), *(Paragraph(f"→ {line}") for line in numbers), *formula_blocks(step.formulas)]


def formula_blocks(formulas: tuple[Formula, ...]) -> list[Block]:
    """Each formula under its name."""
    blocks: list[Block] = []
    for one in formulas:
        blocks += [Heading(f"  {one.name}"), *(Paragraph(part, indent=4) for part in one.paragraphs)]
    return blocks


def code_blocks(code: CheckCode) -> list[Block]:
    """One check code: what is asked, what fails it, what to do, and the formulas that decide it."""
    see = [Paragraph(f"Step: abu explain {code.step}")] if code.step else []
    return [
        Heading(f"{code.code} {code.name}"),
        Paragraph(f"Asks: {code.asks}"),
        Paragraph(f"Fails: {code.fails}"),
        Paragraph(f"To do: {code.remedy}"),
        *see,
        *formula_blocks(tuple(map(formula_of, code.formulas))),
    ]


def _namespace(result: Mapping[str, Any], model: Mapping[str, Any]) -> dict[str, str]:
    """Numbers by key as text; a few that the templates need in other units."""
    budget, abu = result["accuracy_budget"], result["autobalancer"]
    tables = (result, result["frequency"], result["vibration"], abu, budget, result.get("swing_arm") or {}, model)
    values = {key: value for table in tables for key, value in table.items()}
    values |= {
        "accuracy_budget_residual_um": budget["residual_um"],
        "ball_radius_mm": abu["ball_diameter_mm"] / 2,
        "runout_part_g_mm": 1e6 * model["runout_part_kg_m"],
        "eccentricity_part_g_mm": 1e6 * model["eccentricity_part_kg_m"],
    }
    return {key: _text(value) for key, value in values.items()}


def _text(value: Any) -> str:
    if isinstance(value, float):
        return number(value)
    if isinstance(value, list) and all(isinstance(each, float) for each in value):
        return ", ".join(map(number, value))
    return "not computed" if value is None else str(value)
