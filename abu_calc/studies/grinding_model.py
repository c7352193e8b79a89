"""The SI numbers behind a machine at its work, for those who check it by hand."""

from typing import Self

from abu_calc.analysis.grinding import Work
from abu_calc.analysis.under_load import contact_of
from abu_calc.studies.quantity import Record, record

Pair = tuple[float, float]


@record
class GrindingModel(Record):
    """Masses with and without the autobalancer, the contact, the balls; complex numbers as (real, imaginary)."""

    system_mass_kg: float
    effective_mass_kg: float
    mass_without_autobalancer_kg: float
    speed_rad_per_s: float
    reaction_of_suspension_N_per_m: tuple[Pair, Pair]
    dynamic_stiffness_N_per_m: tuple[Pair, Pair]
    imbalance_kg_m: float
    runout_m: float
    runout_angle_deg: float
    contact: str
    contact_stiffness_N_per_m: float | None
    press_force_N: float
    cutting_coefficient: float
    rotation_sense: int
    ball_count: int
    ball_mass_kg: float
    ball_radius_m: float
    pitch_radius_m: float
    capacity_kg_m: float
    inertia_factor: float
    drag_per_s: float
    slow_stiffness_per_s2: tuple[Pair, Pair] | None
    total_imbalance_kg_m: Pair | None

    @classmethod
    def of(cls, work: Work) -> Self:
        """Model of a design pressed to the workpiece."""
        design, steady = work.design, work.fitted.steady
        case, autobalancer, contact = design.case, design.autobalancer, design.case.contact
        mass = case.body.effective_mass(autobalancer.mass)
        stiffness = contact_of(case, autobalancer.mass).dynamic_stiffness
        held = [each + mass * case.speed**2 for each in stiffness]
        return cls(
            system_mass_kg=design.system_mass,
            effective_mass_kg=mass,
            mass_without_autobalancer_kg=case.body.mass,
            speed_rad_per_s=case.speed,
            reaction_of_suspension_N_per_m=(_pair(held[0]), _pair(held[1])),
            dynamic_stiffness_N_per_m=(_pair(stiffness[0]), _pair(stiffness[1])),
            imbalance_kg_m=design.imbalance.value,
            runout_m=case.runout,
            runout_angle_deg=case.table.wheel.runout_angle_deg,
            contact=contact.kind if contact else "",
            contact_stiffness_N_per_m=contact.stiffness if contact and contact.kind == "compliant" else None,
            press_force_N=contact.press_force if contact else 0.0,
            cutting_coefficient=contact.cutting_coefficient if contact else 0.0,
            rotation_sense=contact.sense if contact else 0,
            ball_count=autobalancer.ball_count,
            ball_mass_kg=autobalancer.ball_mass,
            ball_radius_m=autobalancer.ball_diameter / 2,
            pitch_radius_m=autobalancer.pitch_radius,
            capacity_kg_m=autobalancer.capacity,
            inertia_factor=case.inertia_factor,
            drag_per_s=case.drag,
            slow_stiffness_per_s2=None if steady.balls is None else (
                _pair(steady.balls.stiffness[0]), _pair(steady.balls.stiffness[1])),
            total_imbalance_kg_m=None if steady.imbalance is None else _pair(steady.imbalance),
        )  # fmt: skip


def _pair(value: complex) -> Pair:
    return value.real, value.imag
