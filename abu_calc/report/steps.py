"""The steps of sizing as `abu explain` shows them: the formulas of each, and how the numbers of a result go in."""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final

from abu_calc.formula import Formula, formula_of
from abu_calc.frozen import dataclass
from abu_calc.report import step_numbers

if TYPE_CHECKING:
    from abu_calc.studies.size import SizeResult


@dataclass(frozen=True)
class Step:
    """A step of sizing: the keys of its registered formulas, and lines with the numbers of a result put in."""

    title: str
    keys: tuple[str, ...]
    numbers: "Callable[[SizeResult], step_numbers.Lines | None]" = lambda result: ()
    """None: that machine has no such step."""

    @property
    def formulas(self) -> tuple[Formula, ...]:
        """Formulas of this step."""
        return tuple(map(formula_of, self.keys))


STEPS: Final[Mapping[str, Step]] = {
    "frequency": Step(
        "Frequency region",
        (
            "sizing.frequency:zones",
            "sizing.frequency:finite_mass_gap",
            "formulas.suspension:natural_frequency",
            "formulas.motor:idle_speed",
            "formulas.motor:working_speed",
            "formulas.hanging:resonance_drag",
            "formulas.hanging:side_by_side",
            "formulas.hanging:damped_drag",
            "formulas.hanging:gravity_drag",
        ),
        step_numbers.frequency,
    ),
    "imbalance": Step(
        "Imbalance",
        (
            "sizing.imbalance:imbalance_from_level",
            "sizing.instruments:velocity_shown",
            "standards.balance:permissible_imbalance",
        ),
        step_numbers.imbalance,
    ),
    "mass": Step(
        "Mass that moves",
        ("sizing.body:Body.inertance", "sizing.body:Body.effective_mass", "formulas.suspension:Hands"),
        step_numbers.mass,
    ),
    "capacity": Step(
        "Required capacity",
        (
            "sizing.capacity:required_capacity",
            "sizing.capacity:runout_factor",
            "formulas.contact:SteadyContact.balancing_imbalance",
            "sizing.capacity:plane_ratio",
        ),
        step_numbers.capacity,
    ),
    "budget": Step(
        "Accuracy budget",
        (
            "formulas.friction_band:friction_band",
            "formulas.worst_friction:worst_friction",
            "sizing.budget:oval_rest",
            "sizing.budget:permitted_displacement",
            "sizing.budget:plane_rest",
        ),
        step_numbers.budget,
    ),
    "balls": Step(
        "Balls",
        (
            "formulas.ball_ring:half_angle",
            "formulas.ball_ring:capacity",
            "formulas.ball_ring:best_count",
            "sizing.balls:choose",
        ),
        step_numbers.balls,
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
            "sizing.stress:web_lobes",
            "sizing.stress:wall_lobes",
            "sizing.stress:hinged_wall_lobes",
            "sizing.track:carry_over_speed",
            "formulas.slow_motion:ball_stiffness",
            "formulas.slow_motion:decay_rate",
            "formulas.slow_motion:optimum_drag",
            "formulas.oil:drag_ratio",
        ),
        step_numbers.track,
    ),
    "vibration": Step(
        "Vibration level",
        (
            "sizing.vibration:idle_vibration",
            "sizing.vibration:loaded_vibration",
            "sizing.budget:displacement_level",
            "sizing.drawing:extra_level",
        ),
        step_numbers.vibration,
    ),
    "levels": Step(
        "Levels as instruments show them, weighted acceleration, exposure",
        ("sizing.instruments:readings", "standards.vibration:hand_arm_response", "standards.vibration:daily_exposure"),
    ),
    "grinding": Step(
        "Machine at its work",
        (
            "formulas.grinding:printed_resultant",
            "formulas.grinding:loaded_stiffness",
            "formulas.grinding:flutter_drag",
            "formulas.loaded_stability:characteristic",
            "formulas.grinding:stiffness_regions",
            "formulas.grinding:hodograph_limit",
            "formulas.grinding:runout_rate",
            "formulas.shaking:shaking_threshold",
            "formulas.shaking:shaken_drag",
        ),
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
            "fits.repair:seat_repair",
            "fits.intensity:load_intensity",
        ),
        step_numbers.seats,
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
            "formulas.swing_arm:press_force",
            "formulas.arm_motion:forced_harmonics",
            "formulas.arm_motion:free_rates",
            "formulas.arm_motion:averaged_edge",
        ),
        step_numbers.swing_arm,
    ),
    "balance": Step(
        "Balancing in two planes (`abu balance`)",
        (
            "formulas.two_planes:displacement",
            "formulas.two_planes:kernels",
            "formulas.two_planes:imbalances",
            "formulas.two_planes:support_damping",
            "formulas.two_planes:natural_frequencies",
            "formulas.two_planes:influence",
            "formulas.two_planes:condition_number",
            "formulas.two_planes:bar_bending_speed",
            "formulas.two_planes:printed_answer",
        ),
        lambda result: None,
    ),
    "simulation": Step(
        "Simulation",
        ("formulas.motion:equations", "formulas.motion:settling_time", "formulas.motion:simulate"),
    ),
}
"""Steps in the order of the pipeline."""
