"""Explanations of steps, formulas and checks as text.

Equation, units, range, source and misprints of a formula are registered beside its function.
"""

from collections.abc import Iterable, Mapping
from typing import Final

from abu_calc.foundation.checks import CONDITIONS, CheckCode
from abu_calc.foundation.formula import Formula, conversions, formula_of
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block, Heading, Paragraph


@dataclass(frozen=True)
class Step:
    """A step of sizing: its title and the keys of its registered formulas."""

    title: str
    keys: tuple[str, ...]

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """Formulas of this step."""
        return tuple(map(formula_of, self.keys))


STEPS: Final[Mapping[str, Step]] = {
    "frequency": Step(
        "Frequency region",
        (
            "sizing.operating_speed:zones",
            "sizing.operating_speed:finite_mass_gap",
            "formulas.suspension:natural_frequency",
            "formulas.motor:idle_speed",
            "formulas.motor:working_speed",
            "formulas.slow_motion:resonance_drag",
            "formulas.slow_motion:side_by_side",
            "formulas.slow_motion:damped_drag",
            "formulas.slow_motion:gravity_drag",
            "features.design.whirl:growing_whirls",
        ),
    ),
    "imbalance": Step(
        "Imbalance",
        (
            "sizing.imbalance:imbalance_from_level",
            "sizing.instruments:velocity_shown",
            "standards.vibration:permissible_imbalance",
        ),
    ),
    "mass": Step(
        "Mass that moves",
        (
            "formulas.rigid_body:RigidBody.inertance",
            "formulas.rigid_body:RigidBody.forward",
            "formulas.rigid_body:RigidBody.effective_mass",
            "formulas.body_estimate:estimated_body",
            "formulas.body_estimate:BodyEstimate.band",
            "formulas.body_motion:BodyMotion.receptance",
            "formulas.body_motion:BodyMotion.ball_resultant",
            "formulas.body_motion:weighted_acceleration",
            "formulas.body_motion:vector_total",
            "formulas.suspension:Hands",
        ),
    ),
    "capacity": Step(
        "Required capacity",
        (
            "sizing.capacity:required_capacity",
            "sizing.capacity:runout_factor",
            "formulas.steady_contact:SteadyContact.balancing_imbalance",
            "sizing.capacity:plane_ratio",
        ),
    ),
    "budget": Step(
        "Residual-displacement budget",
        (
            "formulas.friction_band:friction_band",
            "formulas.friction_band:worst_friction",
            "formulas.shaken_friction:remaining_band",
            "sizing.budget:ovality_residual",
            "sizing.budget:permitted_displacement",
            "sizing.place_response:plane_rest",
            "sizing.manufacture.eccentricity:eccentricity_sum",
            "sizing.manufacture.spindle_fit:fit_eccentricity",
            "sizing.manufacture.eccentricity:housing_eccentricity",
        ),
    ),
    "balls": Step(
        "Balls",
        (
            "formulas.balls:half_angle",
            "formulas.balls:capacity",
            "formulas.balls:best_count",
            "sizing.balls:choose",
        ),
    ),
    "track": Step(
        "Race and housing",
        (
            "sizing.housing:groove_radius",
            "sizing.housing:housing",
            "sizing.strength:hertz_ball_in_toroid",
            "sizing.strength:hertz_roller_in_cylinder",
            "sizing.strength:permitted_pressure",
            "sizing.strength:hoop_stress",
            "sizing.strength:ring_flexure",
            "sizing.strength:web_lobes",
            "sizing.strength:wall_lobes",
            "sizing.strength:hinged_wall_lobes",
            "sizing.track:carry_over_speed",
            "formulas.slow_motion:ball_stiffness",
            "formulas.slow_motion:decay_rate",
            "formulas.slow_motion:optimum_drag",
            "features.sweep.columns:drag_ratio",
        ),
    ),
    "oil": Step(
        "Drag of oil in the race",
        (
            "formulas.oil:viscosity_index",
            "formulas.oil:oil_viscosity",
            "formulas.oil:oil_depth",
            "formulas.oil:rolling_drag_coefficient",
            "formulas.oil:oil_drag_rate",
        ),
    ),
    "construction": Step(
        "Construction: parts, closure, fastening, ring",
        (
            "sizing.manufacture.race_quality:race_quality",
            "sizing.housing:filling_gap",
            "sizing.manufacture.closure:wall_stress",
            "sizing.manufacture.closure:burst_ratio",
            "sizing.manufacture.cover:axial_load",
            "sizing.manufacture.closure:perforated_thickness",
            "sizing.manufacture.fastening:needed_torque",
            "sizing.manufacture.fastening:clamped_torque",
            "sizing.manufacture.bearing_ring:sphere_radius",
            "formulas.press_fit:spin_stress",
            "formulas.press_fit:interference_left",
            "formulas.press_fit:contact_pressure",
            "formulas.press_fit:fit_torque",
            "formulas.press_fit:fit_force",
        ),
    ),
    "vibration": Step(
        "Vibration level",
        (
            "sizing.vibration:idle_vibration",
            "sizing.vibration:loaded_vibration",
            "sizing.budget:displacement_level",
            "sizing.drawing_requirements:extra_level",
        ),
    ),
    "levels": Step(
        "Levels as instruments show them, weighted acceleration, exposure",
        ("sizing.instruments:readings", "standards.vibration:hand_arm_response", "standards.vibration:daily_exposure"),
    ),
    "declare": Step(
        "Declared vibration value (`abu declare`)",
        (
            "formulas.type_test:acceleration_per_displacement",
            "formulas.type_test:friction_displacement",
            "formulas.type_test:break_even",
            "standards.type_test:reproducibility",
            "standards.type_test:declared_uncertainty",
        ),
    ),
    "identify": Step(
        "Drag, friction and eccentricity from recorded starts (`abu identify`)",
        ("formulas.shaken_friction:friction_number", "features.identification.formulas:equivalent_drag"),
    ),
    "grinding": Step(
        "Machine at its workpiece",
        (
            "features.grinding.formulas:published_resultant",
            "features.grinding.formulas:loaded_stiffness",
            "features.grinding.formulas:flutter_drag",
            "features.grinding.formulas:characteristic",
            "features.grinding.formulas:stiffness_regions",
            "features.grinding.formulas:hodograph_limit",
            "features.grinding.formulas:runout_rate",
            "features.grinding.formulas:shaking_threshold",
            "features.grinding.formulas:shaken_drag",
        ),
    ),
    "seats": Step(
        "Bearing seats",
        (
            "features.seats.interference:theoretical_interference",
            "features.seats.interference:probable_interference",
            "features.seats.interference:clearance_probability",
            "features.seats.interference:truncated_clearance_probability",
            "features.seats.requirement:creep_interference",
            "features.seats.requirement:load_loss",
            "features.seats.requirement:smoothing_loss",
            "features.seats.requirement:catalogue_smoothing_loss",
            "features.seats.requirement:temperature_loss",
            "features.seats.requirement:centrifugal_loss",
            "features.seats.joint:contact_pressure",
            "features.seats.joint:inner_ring_stress",
            "features.seats.joint:outer_ring_stress",
            "features.seats.joint:raceway_change",
            "features.seats.creep:slip_torque",
            "features.seats.clearance:clearance_left",
            "features.seats.notes:selective_groups",
            "features.seats.drawing_requirements:seat_requirements",
            "features.seats.drawing_requirements:seat_repair",
            "features.seats.notes:load_intensity",
            "features.seats.equivalent_load:equivalent_dynamic",
            "features.seats.equivalent_load:equivalent_static",
            "features.seats.rating_life:basic_rating_life",
            "features.seats.rating_life:reference_viscosity",
            "features.seats.rating_life:life_modification",
            "features.seats.life_in_use:combined_load",
            "features.seats.drawing_requirements:seat_form",
            "standards.catalogue:estimated_ratings",
        ),
    ),
    "swing-arm": Step(
        "Swing arm",
        (
            "formulas.swing_arm:contact_gain",
            "formulas.swing_arm:worst_contact_angle",
            "formulas.swing_arm:series_gain",
            "formulas.swing_arm:lifting_angle",
            "formulas.swing_arm:standing_stiffness",
            "formulas.swing_arm:lifted_angles",
            "formulas.swing_arm:parametric_angles",
            "formulas.swing_arm:stiffness_limit",
            "formulas.swing_arm:resonance",
            "formulas.swing_arm:damping_limit",
            "formulas.swing_arm:growth_rate",
            "formulas.swing_arm:arm_stiffness",
            "formulas.swing_arm:pressed_angle",
            "formulas.swing_arm:least_pressing_moment",
            "formulas.swing_arm:normal_force",
            "formulas.swing_arm:forced_harmonics",
            "formulas.swing_arm:free_rates",
            "formulas.swing_arm:averaged_edge",
        ),
    ),
    "two-races": Step(
        "Two races on one spindle",
        (
            "formulas.two_races:TiltingRotor.receptance",
            "formulas.two_races:TiltingRotor.critical_speeds",
            "formulas.two_races:TiltingRotor.forward_modes",
            "formulas.two_races:lever_shares",
            "formulas.two_races:balancing_resultants",
            "formulas.two_races:eccentricity_resultants",
            "formulas.two_races:worst_resultants",
            "formulas.two_races:resultant_quantile",
            "formulas.two_races:one_race_limit",
            "formulas.two_races:two_races_balance",
            "formulas.two_races:mode_margin",
            "formulas.two_race_contact:TiltingContact.balanced_force",
            "formulas.two_race_contact:TiltingContact.acting_imbalance",
        ),
    ),
    "balance": Step(
        "Balancing in one plane or two (`abu balance`)",
        (
            "features.balancing.formulas:displacement",
            "features.balancing.formulas:kernels",
            "features.balancing.formulas:imbalances",
            "features.balancing.formulas:support_damping",
            "features.balancing.formulas:natural_frequencies",
            "features.balancing.formulas:influence",
            "features.balancing.formulas:condition_number",
            "features.balancing.methods:solved",
            "features.balancing.without_phase:solved_without_phase",
            "features.balancing.tolerance:tolerance_shares",
            "features.balancing.corrections:hole_mass",
            "features.balancing.next_run:safe_trial_mass",
            "features.balancing.formulas:bar_bending_speed",
            "features.balancing.formulas:published_answer",
        ),
    ),
    "simulation": Step(
        "Simulation",
        (
            "formulas.motion:equations",
            "formulas.motion:quiet_time",
            "formulas.motion:rest_time",
            "formulas.motion:settling_time",
            "formulas.motion:simulate",
        ),
    ),
}
"""Steps in the order of the pipeline."""


def step_blocks(step: Step, numbers: tuple[str, ...] = ()) -> list[Block]:
    """One step: its numbers, each of its formulas, and the conversion to SI."""
    return [*step_formulas(step, numbers), *si_conversions(step.formulas)]


def step_formulas(step: Step, numbers: tuple[str, ...] = ()) -> list[Block]:
    """One step without the conversion to SI, for reports of several steps."""
    return [Heading(step.title), *(Paragraph(f"→ {line}") for line in numbers), *formula_blocks(step.formulas)]


def formula_blocks(formulas: Iterable[Formula]) -> list[Block]:
    """Each formula under its name."""
    blocks: list[Block] = []
    for formula in formulas:
        blocks += [Heading(f"  {formula.name}"), *(Paragraph(part, indent=4) for part in formula.for_users)]
    return blocks


def si_conversions(formulas: Iterable[Formula]) -> list[Block]:
    """Conversion to SI, which the equations take; it stands once after all formulas."""
    units = conversions(tuple(unit for formula in formulas for unit in formula.file_units))
    return [Paragraph(f"Equations take SI: {units}.")] if units else []


def code_blocks(code: CheckCode) -> list[Block]:
    """One check code: question, condition of each grade, action, and the formulas that decide it."""
    see = [Paragraph(f"Step: abu explain {code.step}")] if code.step else []
    formulas = tuple(map(formula_of, code.formulas))
    conditions = ((label, getattr(code, f"{grade}_if")) for grade, label in CONDITIONS.items())
    return [
        Heading(f"{code.code} {code.name}"),
        Paragraph(f"Question: {code.question}"),
        *(Paragraph(f"{label} if {condition}") for label, condition in conditions if condition),
        Paragraph(f"Action: {code.action}"),
        *see,
        *formula_blocks(formulas),
        *si_conversions(formulas),
    ]
