"""A design and its simulations as the result of `abu size`: SI in, keys and units of the interface out."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from abu_calc.analysis.machine import Run
from abu_calc.analysis.region import TrueRegion
from abu_calc.formulas.friction_band import friction_band
from abu_calc.report.outcome import finite
from abu_calc.report.simulation import simulation_result
from abu_calc.report.stability import boundaries_result
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import AccuracyBudget
from abu_calc.sizing.design import Design
from abu_calc.sizing.frequency import FrequencyRegion
from abu_calc.sizing.track import Track
from abu_calc.sizing.vibration import Levels, Vibration
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.sizing.swing_arm import SwingArmBounds

Result = dict[str, Any]


def size_result(design: Design, simulations: Sequence[Run], region: TrueRegion) -> Result:
    """Everything `abu size` tells, in the order in which it is printed."""
    need = design.autobalancer.requirement
    return {
        "system_mass_kg": design.system_mass,
        "effective_mass_kg": need.effective_mass,
        "frequency": _frequency(design.frequency) | _true_region(region),
        "imbalance_g_mm": from_si(design.imbalance.value, "g_mm"),
        "required_capacity_g_mm": from_si(need.required, "g_mm"),
        "required_capacity_limit_g_mm": from_si(need.printed_limit, "g_mm"),
        "required_capacity_compliant_g_mm": None if need.compliant is None else from_si(need.compliant, "g_mm"),
        "autobalancer": autobalancer(design.autobalancer, design.track),
        "alternatives": [
            autobalancer(one, race) | {"why_not": why}
            for (one, why), race in zip(design.choice.runners_up, design.runner_up_tracks, strict=True)
        ],
        "accuracy_budget": _budget(design.autobalancer.budget) | _reached(design, simulations),
        "vibration": _vibration(design.idle),
        "vibration_loaded": None if design.loaded is None else _vibration(design.loaded),
        "simulation": [_run(design, run) for run in simulations],
        "fits": _fits(design),
        "swing_arm": None if design.swing_arm is None else _swing_arm(design.swing_arm),
        "drawing": [
            {"feature": line.feature, "requirement": line.requirement, "cost_db": line.cost_db}
            for line in design.drawing
        ],
    }


def size_model(design: Design) -> Result:
    """The SI numbers behind the result, for those who check it by hand."""
    case, one = design.case, design.autobalancer
    need = one.requirement
    return {
        "speed_rad_per_s": case.speed,
        "speed_range_rad_per_s": list(case.speed_range),
        "mass_without_autobalancer_kg": case.body.mass,
        "effective_mass_kg": need.effective_mass,
        "natural_frequencies_rad_per_s": list(design.frequency.natural_frequencies),
        "reaction_N_per_m": [[z.real, z.imag] for z in (case.suspension.reaction(i, case.speed) for i in (0, 1))],
        "runout_m": case.runout,
        "runout_factor": need.runout_factor,
        "runout_part_kg_m": need.runout_part,
        "eccentricity_part_kg_m": need.eccentricity_part,
        "plane_ratio": need.plane_ratio,
        "inertia_factor": case.inertia_factor,
        "drag_per_s": case.drag,
        "ball_stiffness_per_s2": design.track.ball_stiffness,
        "resting_angles_rad": list(one.budget.resting_angles),
        "permitted_pressure_Pa": one.strength.permitted_pressure,
        "candidates": design.choice.examined,
        "imbalance_source": design.imbalance.source,
    }


def autobalancer(one: Candidate, race: Track) -> Result:
    """One candidate as people write it."""
    groove = race.groove_radius
    return {
        "ball_count": one.ball_count,
        "ball_diameter_mm": from_si(one.ball_diameter, "mm"),
        "ball_mass_g": from_si(one.ball_mass, "g"),
        "race_radius_mm": from_si(one.race_radius, "mm"),
        "pitch_radius_mm": from_si(one.pitch_radius, "mm"),
        "groove_radius_mm": None if groove is None else from_si(groove, "mm"),
        "capacity_g_mm": from_si(one.capacity, "g_mm"),
        "capacity_ratio": finite(one.capacity_ratio),
        "outer_diameter_mm": from_si(one.housing.outer_diameter, "mm"),
        "width_mm": from_si(one.housing.width, "mm"),
        "mass_g": from_si(one.mass, "g"),
        "mass_fraction": one.mass_fraction,
        "ball_force_N": one.strength.ball_force,
        "contact_pressure_MPa": from_si(one.strength.contact_pressure, "MPa"),
        "hoop_stress_MPa": from_si(one.strength.hoop_stress, "MPa"),
        "optimum_drag_per_s": race.optimum_drag,
        "carry_over_rpm": from_si(race.carry_over, "rpm"),
        "residual_um": finite(from_si(one.budget.residual, "um")),
    }


def _frequency(region: FrequencyRegion) -> Result:
    return {
        "speed_hz": from_si(region.speed, "hz"),
        "natural_frequencies_hz": [from_si(w, "hz") for w in region.natural_frequencies],
        "region": region.region,
        "balancing_possible": region.balancing_possible,
        "finite_mass_gap": region.finite_mass_gap,
    }


def _true_region(region: TrueRegion) -> Result:
    limits = region.boundaries
    return {
        "stable": region.stable,
        "stability_boundaries_rpm": None if limits is None else boundaries_result(limits),
    }


def _budget(budget: AccuracyBudget) -> Result:
    parts = {
        "race_eccentricity_um": budget.race_eccentricity,
        "rolling_friction_um": budget.rolling_friction,
        "plane_offset_um": budget.plane_offset,
        "capacity_shortfall_um": budget.shortfall,
        "residual_um": budget.residual,
        "worst_um": budget.worst,
        "permitted_um": budget.permitted,
    }
    return {key: finite(from_si(value, "um")) for key, value in parts.items()}


def _reached(design: Design, simulations: Sequence[Run]) -> Result:
    """The friction band at the angles where the simulated balls came to rest."""
    one, arm = design.autobalancer, design.case.friction_arm
    for run in simulations:
        angles = run.simulation.response.final.ball_angles
        band = friction_band(arm, one.pitch_radius, one.ball_diameter / 2, angles)
        return {"rolling_friction_reached_um": finite(from_si(band, "um"))}
    return {}


def _vibration(vibration: Vibration) -> Result:
    handles = [
        {"name": place.name, **_levels(place.levels), "effective_mass_kg": place.effective_mass}
        for place in vibration.places
    ]
    return {**_levels(vibration.worst), "handles": handles}


def _run(design: Design, run: Run) -> Result:
    result = simulation_result(run.simulation, run.ledger)
    return result | _other_drags(design.track, run) if run.ledger.scene.name == "idle" else result


def _other_drags(race: Track, run: Run) -> Result:
    """Settling at a third and at three times the drag: the simulated time, scaled by the rates of the slow motion."""
    (_, rate), *others = race.decay_rates
    time = run.simulation.response.settling_time
    return {
        "settling_estimates": [
            {"drag_per_s": drag, "settling_time_s": time * rate / other if time and other > 0 and rate > 0 else None}
            for drag, other in others
        ]
    }


def _levels(levels: Levels) -> Result:
    return {"level_before_db": levels.before, "level_after_db": levels.after, "reduction_db": levels.reduction}


def _fits(design: Design) -> list[Result]:
    if not design.seats:
        return []
    from abu_calc.report.fits import seats_result

    return [row for bearing in design.seats for row in seats_result(bearing)]


def _swing_arm(arm: "SwingArmBounds") -> Result:
    return {
        "contact_stiffness_limit_N_per_m": arm.stiffness_limit,
        "contact_stiffness_limit_exact_N_per_m": arm.stiffness_limit_exact,
        "worst_contact_angle_deg": from_si(arm.worst_angle, "deg"),
        "resonance_rpm": from_si(arm.resonance, "rpm"),
        "damping_limit_N_s_per_m": arm.damping_limit,
        "parametric_growth_rate_per_s": arm.growth_rate,
        "pressed_angle_deg": None if arm.pressed_angle is None else from_si(arm.pressed_angle, "deg"),
    }
