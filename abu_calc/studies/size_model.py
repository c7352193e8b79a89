"""The SI numbers behind a sized design, for those who check it by hand."""

from collections.abc import Mapping, Sequence
from typing import Self

from abu_calc.analysis.machine import Run
from abu_calc.sizing.design import Design
from abu_calc.studies.quantity import Record, record
from abu_calc.studies.scene_model import SceneModel
from abu_calc.units import from_si


@record
class SizeModel(Record):
    """Numbers behind the steps of sizing, a few in user units too; complex ones as (real, imaginary)."""

    speed_rad_per_s: float
    speed_range_rad_per_s: tuple[float, float]
    mass_without_autobalancer_kg: float
    effective_mass_kg: float
    natural_frequencies_rad_per_s: tuple[float, float]
    reaction_N_per_m: tuple[tuple[float, float], ...]
    runout_m: float
    runout_factor: float
    runout_part_kg_m: float
    runout_part_g_mm: float
    eccentricity_part_kg_m: float
    eccentricity_part_g_mm: float
    plane_ratio: float
    ball_radius_mm: float
    inertia_factor: float
    drag_per_s: float
    ball_stiffness_per_s2: float | None
    resting_angles_rad: tuple[float, ...]
    permitted_pressure_Pa: float
    candidates: int
    imbalance_source: str
    scenes: Mapping[str, SceneModel]

    @classmethod
    def of(cls, design: Design, runs: Sequence[Run]) -> Self:
        """Model of a design and its simulations."""
        case, autobalancer = design.case, design.autobalancer
        need, reactions = autobalancer.requirement, (case.suspension.reaction(axis, case.speed) for axis in (0, 1))
        return cls(
            speed_rad_per_s=case.speed,
            speed_range_rad_per_s=case.speed_range,
            mass_without_autobalancer_kg=case.body.mass,
            effective_mass_kg=need.effective_mass,
            natural_frequencies_rad_per_s=design.frequency.natural_frequencies,
            reaction_N_per_m=tuple((force.real, force.imag) for force in reactions),
            runout_m=case.runout,
            runout_factor=need.runout_factor,
            runout_part_kg_m=need.runout_part,
            runout_part_g_mm=from_si(need.runout_part, "g_mm"),
            eccentricity_part_kg_m=need.eccentricity_part,
            eccentricity_part_g_mm=from_si(need.eccentricity_part, "g_mm"),
            plane_ratio=need.plane_ratio,
            ball_radius_mm=from_si(autobalancer.ball_diameter / 2, "mm"),
            inertia_factor=case.inertia_factor,
            drag_per_s=case.drag,
            ball_stiffness_per_s2=design.track.ball_stiffness,
            resting_angles_rad=autobalancer.budget.resting_angles,
            permitted_pressure_Pa=autobalancer.strength.permitted_pressure,
            candidates=design.choice.examined,
            imbalance_source=design.imbalance.source,
            scenes={run.ledger.scene.name: SceneModel.of(run.ledger.scene) for run in runs},
        )
