"""A machine file in SI, with its rigid body: given, estimated, or a point mass.

Elsewhere sizing asks the tables only which of several ways people have chosen.
"""

from dataclasses import replace
from typing import TYPE_CHECKING, ClassVar, Final

from abu_calc.formulas.balls import INERTIA_FACTORS
from abu_calc.formulas.rigid_body import KEYS, BodyEstimate, Inertia, PlacedBody, RigidBody, Vector, estimated_body
from abu_calc.formulas.suspension import Hands, Springs, SuspensionReaction
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.autobalancer import Autobalancer
from abu_calc.inputs.body import pair
from abu_calc.inputs.duty import Grinding, Motor
from abu_calc.inputs.machine import MachineFile
from abu_calc.standards.vibration import hand

if TYPE_CHECKING:
    from abu_calc.formulas.oil import OilDrag


@dataclass(frozen=True)
class RigidMachine:
    """Machine and wheel without the autobalancer, as a rigid body; places [m] are vectors from the centre of mass.

    The mass of the autobalancer is `added` to the body's; centre of mass and inertia are meant with it. `in_space`: the
    body is known in space, so that levels are limited in the wheel plane and handles have their own beside it; else
    it moves along its spindle, or is a point mass. `estimate`: its inertia is estimated, with a band.
    """

    body: RigidBody
    wheel: Vector = (0.0, 0.0, 0.0)
    in_space: bool = False
    estimate: BodyEstimate | None = None

    @property
    def mass(self) -> float:
        """Mass without the autobalancer [kg]."""
        return self.body.mass

    @property
    def is_rigid(self) -> bool:
        """True if the inertia is known or estimated."""
        return self.body.inertia is not None

    def inertance(self, at: Vector, force_at: Vector, added: float = 0.0) -> float:
        """Forward whirl at a place per rotating force at another, ½·g_pq [1/kg]; on the spindle 1/M + a_p·a_q/J_c.

        >>> plane = RigidMachine(RigidBody(6.4, Inertia(0.1, 0.1, 0.1)), (0.0, 0.0, 0.2))
        >>> round(1 / plane.inertance(plane.wheel, plane.wheel), 1)
        1.8
        """
        return self.body.forward(at, force_at, added).real / 2

    def effective_mass(self, added: float = 0.0, at: Vector | None = None) -> float:
        """Effective mass m_F that balls feel [kg] at a place of the spindle, at the wheel unless another is named."""
        place = self.wheel if at is None else at
        return 1 / self.inertance(place, place, added)

    def axes(self, at: Vector, added: float = 0.0, force_at: Vector | None = None) -> Vector:
        """Motion along x, y and z at a place per rotating force, at the wheel unless another place is named [1/kg]."""
        x, y, z = map(abs, self.body.acceleration(at, self.wheel if force_at is None else force_at, added=added))
        return x, y, z

    def loudest_axis(self, at: Vector, added: float = 0.0) -> float:
        """The largest of `axes` by a force at the wheel; in the wheel plane that of x and y."""
        return max(self.axes(at, added)[: 2 if at == self.wheel else 3])

    def transmission(self, at: Vector, added: float = 0.0) -> float:
        """Motion of a place's loudest axis per forward whirl of the wheel, both caused by a force at the wheel [1]."""
        return self.loudest_axis(at, added) / self.inertance(self.wheel, self.wheel, added)


WHEEL_PLANE: Final = "wheel plane"
"""Name of the place at which levels are given without handles."""

UNKNOWN_OIL: Final = (1.0, 1 / 3, 3.0)
"""Factors on the viscous drag rate that stand for working, hot and cold oil if the oil is not known."""

EQUAL_SPEEDS: Final = 1e-3
"""Relative difference of two speeds that counts as none: 0.01 dB of a level, 0.2 % of a stress."""


@dataclass(frozen=True)
class HandlePlace:
    """Place at which levels are wanted: a name and a place [m] from the centre of mass."""

    name: str
    place: Vector


@dataclass(frozen=True)
class Case:
    """Machine data that sizing needs [SI]; masses without the autobalancer."""

    race_keys: ClassVar = ("autobalancer",)
    wheel_keys: ClassVar = ("wheel",)
    """Keys of the tables of all races and wheels: one is a list of one."""

    table: MachineFile
    autobalancer: Autobalancer
    machine_mass: float
    body: RigidMachine
    suspension: SuspensionReaction
    speed: float
    speed_range: tuple[float, float]
    """Lowest and highest speed judged [rad/s]: the working speeds of the file, and the motor's idle speed."""
    runout: float
    contact: Grinding | None
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
    oil: "OilDrag | None" = None
    """Drag by the oil in the race; None: the file has no [oil], or no race is chosen yet."""

    @property
    def drags(self) -> tuple[float, ...]:
        """Viscous drag rate of each race [1/s]."""
        return (self.drag,)

    @property
    def drag_shares(self) -> tuple[float, float, float]:
        """Factors on the viscous drag rate: at work, in hot oil, in cold oil; of oil that is not known 1, 1/3, 3."""
        return UNKNOWN_OIL if self.oil is None else self.oil.shares

    @property
    def race_place(self) -> Vector:
        """Place of the race's centre from the centre of mass [m]."""
        x, y, z = self.body.wheel
        return x, y, z + self.race_offset

    @property
    def places(self) -> tuple[HandlePlace, ...]:
        """The handles, or the wheel plane if the file names none."""
        return self.handles or (HandlePlace(WHEEL_PLANE, self.body.wheel),)

    @property
    def judged_places(self) -> tuple[HandlePlace, ...]:
        """Places whose level is limited: the wheel plane of a body in space, else `places`."""
        return (HandlePlace(WHEEL_PLANE, self.body.wheel),) if self.body.in_space else self.places

    def with_body(self, placed: PlacedBody) -> "Case":
        """The same machine with another body; handles keep their distance from the wheel, springs their frequency."""
        moved = tuple(new - old for new, old in zip(placed.wheel, self.body.wheel, strict=True))
        handles = tuple(
            HandlePlace(
                handle.name, (handle.place[0] + moved[0], handle.place[1] + moved[1], handle.place[2] + moved[2])
            )
            for handle in self.handles
        )
        body = RigidMachine(placed.body, placed.wheel, self.body.in_space)
        return replace(self, body=body, handles=handles, suspension=_suspension(self.table, body))


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
    body, eccentricity = _body(machine), abu.race_eccentricity
    suspension = _suspension(machine, body)
    idle = _idle_speed(machine.motor, suspension, eccentricity)
    return Case(
        table=machine,
        autobalancer=abu,
        machine_mass=top.mass_kg,
        body=body,
        suspension=suspension,
        speed=top.speed,
        speed_range=_judged_range(working_speeds(machine), idle),
        runout=machine.wheel.runout,
        contact=machine.grinding,
        handles=tuple(HandlePlace(handle.name, handle.position) for handle in top.handle),
        race_eccentricity=eccentricity,
        drag=abu.rolling_drag_per_s,
        friction_arm=abu.rolling_friction,
        inertia_factor=INERTIA_FACTORS[abu.corrector],
        race_offset=abu.plane_offset,
        wheel_radius=machine.wheel.diameter / 2,
        level_limit=machine.limits.vibration_level_db,
        background_level=top.background_level_db,
        idle_speed=idle,
    )


def working_speeds(machine: MachineFile) -> tuple[float, float]:
    """Lowest and highest working speed [rad/s] that the file gives."""
    low, high = machine.machine.speed_range or (machine.machine.speed, machine.machine.speed)
    return low, high


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

    return idle_speed(motor.stall_torque_N_m, motor.no_load_speed, displacement, reaction)


def _body(machine: MachineFile) -> RigidMachine:
    top = machine.machine
    mass = top.mass_kg + machine.wheel.mass_kg
    if top.transverse_inertia_kg_m2 is not None and top.center_of_mass_to_wheel_mm is not None:
        J = top.transverse_inertia_kg_m2
        return RigidMachine(RigidBody(mass, Inertia(J, J, J)), (0.0, 0.0, top.center_of_mass_to_wheel))
    x, y, z = top.center_of_mass_from_wheel or (0.0, 0.0, 0.0)
    wheel = None if top.center_of_mass_from_wheel_mm is None else (0.0 - x, 0.0 - y, 0.0 - z)
    if top.inertia_kg_m2 is not None and wheel is not None:
        return RigidMachine(_given_body(machine, mass, *top.inertia_kg_m2), wheel, in_space=True)
    if not top.estimates:
        return RigidMachine(RigidBody(mass))
    lengths = {name: value for name, value in (("L", top.length), ("H", top.height)) if value}
    radius = machine.wheel.diameter / 2
    polar = top.rotor_polar_inertia_kg_m2
    try:
        estimate = estimated_body(
            top.layout, mass, lengths, machine.wheel.mass_kg * radius**2 / 2 if polar is None else polar, wheel
        )
    except InputError as error:
        if polar is not None or error.place.key != "machine.rotor_polar_inertia_kg_m2":
            raise
        name = "L" if "L" in lengths else "H"
        raise InputError(
            "the machine is too short for its wheel, whose polar inertia exceeds that of the estimated body",
            place=Place(key=KEYS[name]),
            found=f"{1000 * lengths[name]:g} mm",
            remedy="Correct the length, or specify machine.rotor_polar_inertia_kg_m2.",
        ) from None
    return RigidMachine(estimate.nominal.body, estimate.nominal.wheel, in_space=True, estimate=estimate)


def _given_body(machine: MachineFile, mass: float, xx: float, yy: float, zz: float) -> RigidBody:
    top = machine.machine
    try:
        inertia = Inertia(xx, yy, zz, top.inertia_xz_kg_m2 or 0.0).checked()
    except InputError as error:
        raise error.at(Place(key="machine.inertia_kg_m2")) from None
    return RigidBody(mass, inertia, top.rotor_polar_inertia_kg_m2 or 0.0)


def _suspension(machine: MachineFile, body: RigidMachine) -> SuspensionReaction:
    """Suspension in the plane of the race; `hand_axes` turns the hands of a body in space."""
    table, mass = machine.suspension, body.effective_mass()
    frequencies = pair(table.natural_frequencies)
    if frequencies is None or table.dampings is None:
        along, across, _ = hand_axes(machine.machine.layout if body.in_space else "straight")
        return Hands((hand(along), hand(across)))
    wx, wy = frequencies
    zx, zy = table.dampings
    return Springs((mass * wx**2, mass * wy**2), (2 * zx * mass * wx, 2 * zy * mass * wy))


def hand_axes(layout: str) -> tuple[str, str, str]:
    """Axes of the hands along the body's x, y and z: forearms push toward the workpiece, along their own z.

    Along y where the wheel's rim works (straight), along the spindle where its face does.
    """
    return ("x", "z", "y") if layout == "straight" else ("x", "y", "z")
