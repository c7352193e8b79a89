"""Explanations of steps, formulas and checks as text.

Equation, units, range, source and misprints of a formula are registered beside its function.
"""

from collections.abc import Iterable, Mapping
from typing import Final, Self

from abu_calc.foundation.checks import CONDITIONS, CheckCode
from abu_calc.foundation.formula import Formula, conversions, formula_of
from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.blocks import Block, Heading, Paragraph


@dataclass(frozen=True)
class Step:
    """A step of sizing: its title and the keys of its registered formulas."""

    title: str
    keys: tuple[str, ...]

    @classmethod
    def of(cls, title: str, *groups: str) -> Self:
        """Step of formulas that are named by groups, "module: name name"."""
        parts = (group.partition(": ") for group in groups)
        return cls(title, tuple(f"{module}:{name}" for module, _, names in parts for name in names.split()))

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """Formulas of this step."""
        return tuple(map(formula_of, self.keys))


STEPS: Final[Mapping[str, Step]] = {
    "frequency": Step.of(
        "Frequency region",
        "sizing.design: zones finite_mass_gap",
        "formulas.suspension: natural_frequency",
        "formulas.motor: idle_speed working_speed",
        "formulas.slow_motion: resonance_drag side_by_side damped_drag gravity_drag",
        "features.design.region: growing_whirls",
    ),
    "imbalance": Step.of(
        "Imbalance",
        "sizing.imbalance: imbalance_from_level",
        "sizing.imbalance: velocity_shown",
        "standards.vibration: permissible_imbalance",
    ),
    "mass": Step.of(
        "Mass that moves",
        "formulas.rigid_body: RigidBody.inertance RigidBody.forward RigidBody.effective_mass",
        "formulas.rigid_body: estimated_body BodyEstimate.band",
        "formulas.body_motion: BodyMotion.receptance BodyMotion.ball_resultant weighted_acceleration vector_total",
        "formulas.suspension: Hands",
    ),
    "capacity": Step.of(
        "Required capacity",
        "sizing.budget: required_capacity runout_factor",
        "formulas.tilting_contact: SteadyContact.balancing_imbalance",
        "sizing.budget: plane_ratio",
    ),
    "budget": Step.of(
        "Residual-displacement budget",
        "formulas.friction_band: friction_band worst_friction",
        "formulas.friction_band: remaining_band",
        "sizing.budget: ovality_residual permitted_displacement",
        "sizing.budget: plane_rest",
        "sizing.manufacture.eccentricity: eccentricity_sum",
        "sizing.manufacture.cover: fit_eccentricity",
        "sizing.manufacture.eccentricity: housing_eccentricity",
    ),
    "balls": Step.of(
        "Balls",
        "formulas.balls: half_angle capacity best_count",
        "sizing.balls: choose",
    ),
    "track": Step.of(
        "Race and housing",
        "sizing.housing: groove_radius housing",
        "sizing.strength: hertz_ball_in_toroid hertz_roller_in_cylinder permitted_pressure hoop_stress "
        "ring_flexure web_lobes wall_lobes hinged_wall_lobes",
        "sizing.track: carry_over_speed",
        "formulas.slow_motion: ball_stiffness decay_rate optimum_drag",
        "features.sweep.batches: drag_ratio",
    ),
    "oil": Step.of(
        "Drag of oil in the race",
        "formulas.oil: viscosity_index oil_viscosity oil_depth rolling_drag_coefficient oil_drag_rate",
    ),
    "construction": Step.of(
        "Construction: parts, closure, fastening, ring",
        "sizing.manufacture.ring_seat: race_quality",
        "sizing.housing: filling_gap",
        "sizing.manufacture.cover: wall_stress burst_ratio",
        "sizing.manufacture.cover: axial_load",
        "sizing.manufacture.cover: perforated_thickness",
        "sizing.manufacture.fastening: needed_torque clamped_torque",
        "sizing.manufacture.bearing_ring: sphere_radius",
        "formulas.press_fit: spin_stress interference_left contact_pressure fit_torque fit_force",
    ),
    "vibration": Step.of(
        "Vibration level",
        "sizing.vibration: idle_vibration loaded_vibration",
        "sizing.budget: displacement_level",
        "sizing.drawing_requirements: extra_level",
    ),
    "levels": Step.of(
        "Levels as instruments show them, weighted acceleration, exposure",
        "sizing.imbalance: readings",
        "standards.vibration: hand_arm_response daily_exposure",
    ),
    "declare": Step.of(
        "Declared vibration value (`abu declare`)",
        "formulas.type_test: acceleration_per_displacement friction_displacement break_even",
        "standards.vibration: reproducibility declared_uncertainty",
    ),
    "identify": Step.of(
        "Drag, friction and eccentricity from recorded starts (`abu identify`)",
        "formulas.friction_band: friction_number equivalent_drag",
    ),
    "grinding": Step.of(
        "Machine at its workpiece",
        "features.grinding.formulas: published_resultant loaded_stiffness flutter_drag characteristic "
        "stiffness_regions hodograph_limit runout_rate shaking_threshold shaken_drag",
    ),
    "seats": Step.of(
        "Bearing seats",
        "features.seats.interference: theoretical_interference probable_interference clearance_probability "
        "truncated_clearance_probability",
        "features.seats.lookup: process_load",
        "features.seats.interference: creep_interference load_loss smoothing_loss catalogue_smoothing_loss "
        "temperature_loss centrifugal_loss",
        "features.seats.joint: contact_pressure inner_ring_stress outer_ring_stress raceway_change",
        "features.seats.creep: slip_torque",
        "features.seats.joints: heated mounting_force",
        "features.seats.clearance: clearance_left",
        "features.seats.notes: selective_groups",
        "features.seats.drawing_requirements: seat_requirements seat_repair",
        "features.seats.notes: load_intensity",
        "features.seats.bearing: equivalent_dynamic equivalent_static",
        "features.seats.rating_life: basic_rating_life reference_viscosity life_modification",
        "features.seats.life_in_use: combined_load",
        "features.seats.drawing_requirements: seat_form",
        "standards.catalogue: estimated_ratings",
    ),
    "swing-arm": Step.of(
        "Swing arm",
        "formulas.swing_arm: contact_gain worst_contact_angle series_gain lifting_angle standing_stiffness "
        "lifted_angles parametric_angles stiffness_limit resonance damping_limit growth_rate arm_stiffness "
        "pressed_angle least_pressing_moment normal_force forced_harmonics free_rates averaged_edge",
    ),
    "two-races": Step.of(
        "Two races on one spindle",
        "formulas.tilting_rotor: TiltingRotor.receptance TiltingRotor.critical_speeds TiltingRotor.forward_modes "
        "lever_shares balancing_resultants eccentricity_resultants worst_resultants resultant_quantile "
        "one_race_limit two_races_balance mode_margin",
        "formulas.tilting_contact: TiltingContact.balanced_force TiltingContact.acting_imbalance",
    ),
    "balance": Step.of(
        "Balancing in one plane or two (`abu balance`)",
        "features.balancing.formulas: displacement kernels imbalances support_damping natural_frequencies "
        "influence condition_number",
        "features.balancing.methods: solved",
        "features.balancing.runs: solved_without_phase",
        "features.balancing.tolerance: tolerance_shares",
        "features.balancing.corrections: hole_mass",
        "features.balancing.tolerance: safe_trial_mass",
        "features.balancing.formulas: bar_bending_speed published_answer",
    ),
    "simulation": Step.of(
        "Simulation",
        "formulas.motion: equations quiet_time rest_time settling_time simulate",
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
