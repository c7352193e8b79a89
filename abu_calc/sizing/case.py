"""A machine file in SI, and the effective mass at places along the spindle axis.

The machine is a rigid body. Elsewhere sizing asks the tables only which of several ways people have chosen.
"""

from typing import Final, Literal

from abu_calc.formulas.balls import INERTIA_FACTORS
from abu_calc.formulas.suspension import Hands, Springs, SuspensionReaction
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.inputs.machine import Autobalancer, Grinding, MachineFile, Motor
from abu_calc.standards.vibration import hand


@dataclass(frozen=True)
class RigidMachine:
    """Machine and wheel without the autobalancer; places [m] from the centre of mass, toward the wheel positive.

    A point mass is the body whose `inverse_inertia` [1/(kg m²)] is zero: every place then moves alike.
    """

    mass: float
    inverse_inertia: float
    wheel: float

    @property
    def is_rigid(self) -> bool:
        """True if transverse inertia and the place of the wheel are known."""
        return self.inverse_inertia > 0

    @formula(
        "Acceleration at one place per force at another",
        "I_a = 1/M + a_p·a_q/J_c",
        "1/kg",
        where="M includes the autobalancer.",
        assumed="frequencies well above those of the suspension",
        source="Newton–Euler of a free rigid body in the plane",
    )
    def inertance(self, at: float, force_at: float, added: float = 0.0) -> float:
        """
        >>> round(1 / RigidMachine(6.4, 1 / 0.10, 0.2).inertance(0.2, 0.2), 1)
        1.8
        """
        return 1 / (self.mass + added) + at * force_at * self.inverse_inertia

    @formula(
        "Effective mass at a place, at the wheel unless another place is named",
        "1/m_eff = 1/M + a_p²/J_c",
        "kg",
        assumed="as for the inertance",
        source="the inertance with force and motion at one place",
    )
    def effective_mass(self, added: float = 0.0, at: float | None = None) -> float:
        place = self.wheel if at is None else at
        return 1 / self.inertance(place, place, added)

    def transmission(self, at: float, added: float = 0.0) -> float:
        """Motion at a place per motion at the wheel, both caused by a force at the wheel [1]."""
        return abs(self.inertance(at, self.wheel, added)) / self.inertance(self.wheel, self.wheel, added)


EQUAL_SPEEDS: Final = 1e-3
"""Relative difference of two speeds that counts as none: 0.01 dB of a level, 0.2 % of a stress."""


@dataclass(frozen=True)
class WorkContact:
    """Wheel and work under load; `stiffness` is zero unless the contact is compliant."""

    kind: Literal["compliant", "rigid", "face"]
    press_force: float
    cutting_coefficient: float
    stiffness: float
    sense: int


@dataclass(frozen=True)
class HandlePlace:
    """Place at which levels are wanted: a name and a place [m] from the centre of mass."""

    name: str
    place: float


@dataclass(frozen=True)
class Case:
    """Machine data that sizing needs [SI]; masses without the autobalancer."""

    table: MachineFile
    autobalancer: Autobalancer
    machine_mass: float
    body: RigidMachine
    suspension: SuspensionReaction
    speed: float
    speed_range: tuple[float, float]
    """Lowest and highest speed judged [rad/s]: the working speeds of the file, and the motor's idle speed."""
    runout: float
    contact: WorkContact | None
    handles: tuple[HandlePlace, ...]
    race_eccentricity: float
    drag: float
    friction_arm: float
    inertia_factor: float
    race_offset: float
    wheel_radius: float
    level_limit: float
    """Highest permitted velocity level [dB]."""
    background_level: float | None
    """Velocity level with a balanced wheel [dB]; None: not given."""
    idle_speed: float | None = None
    """Speed [rad/s] at which the motor's torque equals what the settled machine takes; None: no motor is given."""

    @property
    def race_place(self) -> float:
        """Place of the race plane from the centre of mass [m]."""
        return self.body.wheel + self.race_offset


def read_case(machine: MachineFile) -> Case:
    """The case of a machine file; refused where the file has no [autobalancer]."""
    if not isinstance(machine, MachineFile):
        raise InputError(
            "not the tables of a whole machine",
            place=Place(key="machine"),
            found=type(machine).__name__,
            remedy='abu_calc.read("machine.toml").whole() returns them, where there are suspension and wheel.',
        )
    abu, top = machine.autobalancer, machine.machine
    if abu is None:
        raise InputError(
            "missing: sizing needs the room there is for the autobalancer",
            place=Place(key="autobalancer.max_outer_diameter_mm"),
            remedy="Add a table [autobalancer] with max_outer_diameter_mm and max_width_mm.",
        )
    body, eccentricity = _body(machine), to_si(abu.race_eccentricity_mm, "mm")
    suspension = _suspension(machine, body.effective_mass())
    idle = _idle_speed(machine.motor, suspension, eccentricity)
    return Case(
        table=machine,
        autobalancer=abu,
        machine_mass=top.mass_kg,
        body=body,
        suspension=suspension,
        speed=to_si(top.speed_rpm, "rpm"),
        speed_range=_judged_range(working_speeds(machine), idle),
        runout=to_si(machine.wheel.runout, "mm"),
        contact=_contact(machine.grinding),
        handles=tuple(HandlePlace(h.name, to_si(h.from_center_of_mass_mm, "mm")) for h in top.handle),
        race_eccentricity=eccentricity,
        drag=abu.rolling_drag_per_s,
        friction_arm=to_si(abu.rolling_friction_mm, "mm"),
        inertia_factor=INERTIA_FACTORS[abu.corrector],
        race_offset=to_si(abu.plane_offset_mm, "mm"),
        wheel_radius=to_si(machine.wheel.diameter_mm, "mm") / 2,
        level_limit=machine.limits.vibration_level_db,
        background_level=top.background_level_db,
        idle_speed=idle,
    )


def working_speeds(machine: MachineFile) -> tuple[float, float]:
    """Lowest and highest working speed [rad/s] that the file gives."""
    low, high = machine.machine.speed_range
    return to_si(low, "rpm"), to_si(high, "rpm")


def _judged_range(working: tuple[float, float], idle: float | None) -> tuple[float, float]:
    """The working speeds, extended to the idle speed [rad/s] if that lies outside by more than `EQUAL_SPEEDS`."""
    low, high = working
    if idle is None or low * (1 - EQUAL_SPEEDS) <= idle <= high * (1 + EQUAL_SPEEDS):
        return working
    return min(low, idle), max(high, idle)


def _idle_speed(motor: Motor | None, suspension: SuspensionReaction, displacement: float) -> float | None:
    """The idle speed [rad/s] of a machine whose settled balls leave a displacement [m]; None without a motor."""
    if motor is None:
        return None
    from abu_calc.formulas.motor import idle_speed

    def reaction(speed: float) -> complex:
        """Reaction of both axes [N/m] at a speed [rad/s]."""
        return suspension.reaction(0, speed) + suspension.reaction(1, speed)

    return idle_speed(motor.stall_torque_N_m, to_si(motor.no_load_speed_rpm, "rpm"), displacement, reaction)


def _body(machine: MachineFile) -> RigidMachine:
    top = machine.machine
    mass = top.mass_kg + machine.wheel.mass_kg
    if top.transverse_inertia_kg_m2 is None or top.center_of_mass_to_wheel_mm is None:
        return RigidMachine(mass, 0.0, 0.0)
    return RigidMachine(mass, 1 / top.transverse_inertia_kg_m2, to_si(top.center_of_mass_to_wheel_mm, "mm"))


def _suspension(machine: MachineFile, mass: float) -> SuspensionReaction:
    table = machine.suspension
    if table.frequencies is None or table.dampings is None:
        return Hands((hand("x"), hand("z")))
    wx, wy = (to_si(frequency, "hz") for frequency in table.frequencies)
    zx, zy = table.dampings
    return Springs((mass * wx**2, mass * wy**2), (2 * zx * mass * wx, 2 * zy * mass * wy))


def _contact(grinding: Grinding | None) -> WorkContact | None:
    if grinding is None:
        return None
    return WorkContact(
        kind=grinding.contact,
        press_force=grinding.press_force_N,
        cutting_coefficient=grinding.cutting_coefficient,
        stiffness=grinding.contact_stiffness_N_per_m if grinding.contact == "compliant" else 0.0,
        sense=grinding.rotation_sense,
    )
