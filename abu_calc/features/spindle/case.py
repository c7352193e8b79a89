"""A machine with two races in SI, and the machine with one race that stands for each of them.

A race feels the mass M_i = (J_t − J_p + M·z_k²)/(z₁ − z₂)², k the other race: an eccentricity Δ of race i alone asks
its balls for M_i·Δ. Balls, housing and strength of a race are those of a machine of that mass with one race.
"""

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import pairwise, product
from typing import ClassVar, Final

from pydantic import ValidationError

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.formulas.balls import INERTIA_FACTORS
from abu_calc.formulas.tilting_contact import TiltingContact
from abu_calc.formulas.tilting_rotor import (
    ONE_PLANE,
    Bearing,
    PlacedImbalance,
    TiltingRotor,
    balancing_resultants,
    eccentricity_resultants,
    lever_shares,
    two_races_balance,
    worst_resultants,
)
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import in_file, shown
from abu_calc.inputs.duty import Grinding
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.spindle import PlacedAutobalancer, TwoRaceFile
from abu_calc.sizing import RaceDesign, size_race
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import UNKNOWN_OIL
from abu_calc.sizing.design import built_race
from abu_calc.standards.vibration import permissible_imbalance


@dataclass(frozen=True)
class LevelPlaceOnSpindle:
    """Place on the spindle axis [m] from the centre of mass at which a level is wanted."""

    name: str
    place: float


@dataclass(frozen=True)
class SpindleCase:
    """The machine without autobalancers, its imbalances and races [SI]; angles [rad], None: unknown phase."""

    table: TwoRaceFile
    rotor: TiltingRotor
    wheels: tuple[PlacedImbalance, ...]
    angles: tuple[float | None, ...]
    races: tuple[float, ...]
    speed: float
    speed_range: tuple[float, float]
    eccentricity: float
    friction_arm: float
    inertia_factor: float
    drag_shares: ClassVar = UNKNOWN_OIL
    places: tuple[LevelPlaceOnSpindle, ...]

    @property
    def autobalancer(self) -> PlacedAutobalancer:
        """Table of the first race, whose eccentricity, friction and kind of balls are those of all."""
        return self.table.autobalancer[0]

    @property
    def race_keys(self) -> tuple[str, ...]:
        """Keys of the tables of all races."""
        return tuple(f"autobalancer.{number}" for number in range(len(self.races)))

    @property
    def wheel_keys(self) -> tuple[str, ...]:
        """Keys of the tables of all wheels."""
        return tuple(f"wheel.{number}" for number in range(len(self.wheels)))

    @property
    def drags(self) -> tuple[float, ...]:
        """Viscous drag rate of each race [1/s]."""
        return tuple(race.rolling_drag_per_s for race in self.table.autobalancer)

    @property
    def drag(self) -> float:
        """The largest of them [1/s], which stands for all in a start case."""
        return max(self.drags)

    @property
    def level_limit(self) -> float:
        """Limit of the velocity level [dB]."""
        return self.table.limits.vibration_level_db

    @property
    def speeds(self) -> tuple[float, ...]:
        """Both ends of the speed range and the rated speed [rad/s]."""
        return tuple(dict.fromkeys((*self.speed_range, self.speed)))

    @property
    def balances(self) -> bool:
        """True if the races balance at every speed that is judged."""
        return all(map(self.balances_at, self.speeds))

    def balances_at(self, speed: float) -> bool:
        """True if the races balance at a speed [rad/s]."""
        return two_races_balance(self.rotor, speed)

    def turned(self, phases: Sequence[float]) -> tuple[PlacedImbalance, ...]:
        """Imbalances as vectors; those of unknown phase take these `phases` [rad], in order."""
        left = iter(phases)
        known = [angle if angle is not None else next(left, 0.0) for angle in self.angles]
        return tuple(
            PlacedImbalance(wheel.place, abs(wheel.imbalance) * complex(math.cos(angle), math.sin(angle)))
            for wheel, angle in zip(self.wheels, known, strict=True)
        )

    @property
    def unknown_phases(self) -> int:
        """Number of imbalances whose phase against the others is unknown."""
        missing = sum(angle is None for angle in self.angles)
        return missing - 1 if missing == len(self.angles) else missing

    def with_races(self, races: tuple[float, ...]) -> "SpindleCase":
        """The machine with its races at these places [m]; levels that are wanted at the races go with them."""
        own = {f"race {number}": place for number, place in enumerate(races, 1)}
        at_races = not self.table.machine.handle and self.table.suspension.model != "bearings"
        places = tuple(replace(held, place=own[held.name]) if at_races else held for held in self.places)
        return replace(self, races=races, places=places)

    def carrying(self, masses: tuple[float, ...]) -> "SpindleCase":
        """The machine with autobalancers of these masses [kg] at their races, the centre of mass kept in its place."""
        added = sum(mass * place**2 for mass, place in zip(masses, self.races, strict=True))
        rotor = replace(
            self.rotor, mass=self.rotor.mass + sum(masses), transverse_inertia=self.rotor.transverse_inertia + added
        )
        return replace(self, rotor=rotor)


def read_case(table: TwoRaceFile) -> SpindleCase:
    """The case of a file; the angle of the first wheel is the zero mark if it is the only unknown one."""
    machine = table.machine
    speed = machine.speed
    wheels = tuple(
        PlacedImbalance(
            wheel.plane,
            wheel.imbalance if wheel.imbalance_g_mm is not None
            else permissible_imbalance(wheel.balance_grade or "", wheel.mass_kg, speed),
        )
        for wheel in table.wheel
    )  # fmt: skip
    angles = tuple(wheel.imbalance_angle for wheel in table.wheel)
    if len(wheels) == 1:
        angles = (0.0,)
    rotor = TiltingRotor(
        machine.mass_kg, machine.transverse_inertia_kg_m2, machine.rotor_polar_inertia_kg_m2, _bearings(table)
    )
    abu = table.autobalancer[0]
    case = SpindleCase(
        table=table,
        rotor=rotor,
        wheels=wheels,
        angles=angles,
        races=tuple(race.plane for race in table.autobalancer),
        speed=speed,
        speed_range=tuple(machine.speed_range or (machine.speed, machine.speed)),
        eccentricity=abu.race_eccentricity,
        friction_arm=abu.rolling_friction,
        inertia_factor=INERTIA_FACTORS[abu.corrector],
        places=_places(table),
    )
    return _placed(case)


def _placed(case: SpindleCase) -> SpindleCase:
    """The case with its races at the best places of the stretches that the file allows.

    Of those that leave the loudest place least, the ones with the smallest required capacity are taken.
    """
    tables = case.table.autobalancer
    if all(race.plane_range_mm is None for race in tables):
        return case
    own = case.table.machine.handle or case.table.suspension.model == "bearings"

    def rank(races: tuple[float, ...]) -> tuple[float, float, float]:
        """Least displacement of the loudest place, then the least capacity of the largest race, then of all."""
        needs, places = capacity_needs(replace(case, races=races)), [held.place for held in case.places]
        return round(arms(places if own else races, races) / ALIKE) * ALIKE, max(needs), sum(needs)

    grids = (_grid(place, race.plane_range) for place, race in zip(case.races, tables, strict=True))
    apart = (
        races for races in product(*grids) if all(abs(a - b) > LEAST_APART + ONE_PLANE for a, b in pairwise(races))
    )
    return case.with_races(min((case.races, *apart), key=rank))


def _grid(place: float, stretch: tuple[float, float] | None) -> list[float]:
    """Places [m] on a stretch; without one the place itself."""
    if stretch is None:
        return [place]
    low, high = stretch
    return [low + (high - low) * step / STEPS for step in range(STEPS + 1)]


STEPS: Final = 40
"""Steps from one end of a stretch to the other."""
LEAST_APART: Final = 1e-3
"""Least distance [m] of the races."""
ALIKE: Final = 1e-6
"""Relative difference below which places of the races leave as much."""


def arms(places: Sequence[float], races: Sequence[float]) -> float:
    """Largest displacement of the places [m] per eccentricity of both races, worst directions.

    Races off by Δ leave a place p of the spindle at most Δ·(|p − z₁| + |p − z₂|)/|z₁ − z₂| off: Δ between both races,
    more outside.

    >>> round(arms((0.2, -0.2), (0.3, -0.3)), 9), round(arms((0.6,), (0.3, -0.3)), 9)
    (1.0, 2.0)
    """
    first, second = races
    return max((abs(place - first) + abs(place - second)) / abs(first - second) for place in places)


def _bearings(table: TwoRaceFile) -> tuple[Bearing, ...]:
    """The bearings of the file, or two that stand for springs with one frequency and damping ratio of all freedoms.

    At ±√(J_t/M) translation and tilt have the same frequency, and do not couple.
    """
    given, machine = table.suspension, table.machine
    if given.model == "bearings":
        rows = zip(
            given.bearing_positions or (), given.bearing_stiffness_N_per_m or (),
            given.bearing_damping_N_s_per_m or (), strict=True,
        )  # fmt: skip
        return tuple(Bearing(*row) for row in rows)
    place = math.sqrt(machine.transverse_inertia_kg_m2 / machine.mass_kg)
    frequency = given.natural_frequencies or 0.0
    stiffness = machine.mass_kg * frequency**2 / 2
    damping = (given.damping_ratios or 0.0) * machine.mass_kg * frequency
    return Bearing(place, stiffness, damping), Bearing(-place, stiffness, damping)


def _places(table: TwoRaceFile) -> tuple[LevelPlaceOnSpindle, ...]:
    if table.machine.handle:
        return tuple(LevelPlaceOnSpindle(handle.name, handle.position[2]) for handle in table.machine.handle)
    if table.suspension.model == "bearings":
        positions = table.suspension.bearing_positions or ()
        return tuple(LevelPlaceOnSpindle(f"bearing {k}", z) for k, z in enumerate(positions, 1))
    return tuple(LevelPlaceOnSpindle(f"race {k}", race.plane) for k, race in enumerate(table.autobalancer, 1))


def felt_mass(case: SpindleCase, race: int) -> float:
    """Mass [kg] that the balls of a race feel: resultant per eccentricity of this race alone, far above resonance."""
    own, other = case.races[race], case.races[1 - race]
    return (case.rotor.forward_inertia + case.rotor.mass * other**2) / (own - other) ** 2


def capacity_needs(case: SpindleCase) -> tuple[float, ...]:
    """Largest resultants [kg m] that the balls of each race must have, over unknown phases and the speed range."""
    return _largest(_needs_at(case, speed) for speed in case.speeds)


def _largest(needs: Iterable[Sequence[float]]) -> tuple[float, ...]:
    return tuple(map(max, zip(*needs, strict=True)))


def _needs_at(case: SpindleCase, speed: float) -> tuple[float, ...]:
    """Largest resultants [kg m] at one speed [rad/s]."""
    spread = (case.eccentricity,) * len(case.races)
    needs = worst_resultants(case.rotor, case.races, case.wheels, spread, speed)
    if not case.unknown_phases:
        exact = balancing_resultants(case.races, case.turned(()))
        needs = tuple(abs(own) + off for own, off in zip(exact, eccentric_needs(case, speed), strict=True))
    return tuple(idle + work for idle, work in zip(needs, work_needs(case, speed), strict=True))


def work_needs(case: SpindleCase, speed: float) -> tuple[float, ...]:
    """Largest resultants [kg m] that a workpiece asks for by the runout of the wheel at work, at its worst angle.

    Zero without [grinding], and for the contact of a face, whose runout does not press.
    """
    needs = [(0.0,) * len(case.races)]
    for wheel in pressed_wheels(case):
        acting = abs(wheel.contact(case.rotor, speed, complex(wheel.runout)).acting_imbalance())
        needs.append(tuple(abs(share) * acting for share in lever_shares(case.races, wheel.place)))
    return _largest(needs)


@dataclass(frozen=True)
class PressedWheel:
    """A wheel at work: its number from 0 and its contact [SI]; `runout` [m], its angle from its own imbalance [rad]."""

    index: int
    name: str
    place: float
    radius: float
    runout: float
    runout_angle: float
    table: Grinding

    @property
    def stiffness(self) -> float:
        """Of the contact [N/m]; 0 of a rigid one."""
        return self.table.contact_stiffness_N_per_m if self.table.contact == "compliant" else 0.0

    @property
    def presses(self) -> bool:
        """True if runout presses in the plane; that of a face does not."""
        return self.table.contact != "face"

    def contact(
        self, rotor: TiltingRotor, speed: float, runout: complex, balls: Sequence[PlacedImbalance] = ()
    ) -> TiltingContact:
        """The steady contact at a speed [rad/s]; `runout` [m] in the rotor's frame."""
        compliance = 1 / self.stiffness if self.stiffness else 0.0
        friction = self.table.rotation_sense * self.table.cutting_coefficient
        return TiltingContact.of(rotor, self.place, speed, compliance, friction, runout, balls, self.presses)

    def runout_at(self, case: SpindleCase, phases: Sequence[float]) -> complex:
        """E [m] in the rotor's frame, with the imbalances at these phases [rad]."""
        own = case.turned(phases)[self.index].imbalance
        return cmath.rect(self.runout, (cmath.phase(own) if own else 0.0) + self.runout_angle)

    def effect(self, case: SpindleCase, phases: Sequence[float]) -> GrindingContactEffect:
        """The contact as an effect of a scene."""
        runout, table = self.runout_at(case, phases), self.table
        return GrindingContactEffect(
            table.press_force_N, table.cutting_coefficient, table.contact, self.stiffness, table.rotation_sense,
            self.runout, cmath.phase(runout) if runout else 0.0, self.radius, self.place,
        )  # fmt: skip


def pressed_wheels(case: SpindleCase) -> tuple[PressedWheel, ...]:
    """Each wheel of the file at the contact that the file gives; none without [grinding]."""
    table = case.table.grinding
    if table is None:
        return ()
    return tuple(
        PressedWheel(
            index, wheel.name or f"wheel {index + 1}", wheel.plane, wheel.diameter / 2,
            wheel.runout, wheel.runout_angle, table,
        )
        for index, wheel in enumerate(case.table.wheel)
    )  # fmt: skip


def eccentric_needs(case: SpindleCase, speed: float) -> tuple[float, ...]:
    """Largest resultants [kg m] that the eccentricity of all races asks for at a speed [rad/s]."""
    return worst_resultants(case.rotor, case.races, (), (case.eccentricity,) * len(case.races), speed)


def typical_needs(case: SpindleCase) -> tuple[float, ...]:
    """Root of the mean square of the resultants [kg m] over all phases."""
    wheels = [[wheel] for wheel in case.wheels] if case.unknown_phases else [case.turned(())]
    off = ((case.eccentricity, 0j), (0j, case.eccentricity))
    parts = (
        *(balancing_resultants(case.races, own) for own in wheels),
        *(eccentricity_resultants(case.rotor, case.races, each, case.speed) for each in off),
    )
    return tuple(math.sqrt(sum(abs(part) ** 2 for part in own)) for own in zip(*parts, strict=True))


def one_race_machine(case: SpindleCase, race: int, need: float, ball: float | None = None) -> MachineFile:
    """Machine with one race whose need is that of a race of two; `ball` pins the diameter of its balls.

    Its mass is that which the race feels, without the autobalancer, since every autobalancer adds its own.
    """
    abu, machine, limits = case.table.autobalancer[race], case.table.machine, case.table.limits
    mass = felt_mass(case, race)
    wheel = min(0.1 * mass, case.table.wheel[0].mass_kg)
    given = abu.model_dump(exclude={"plane_mm", "plane_offset_mm", "plane_range_mm"}, exclude_unset=True)
    share = abu.max_mass_fraction * machine.mass_kg / (mass - wheel)
    frequencies, hertz = in_file("natural_frequencies_hz", max((*case.rotor.critical_speeds(), 1e-3)))
    return MachineFile.model_validate(
        {
            "machine": {
                "name": f"{machine.name}, race {race + 1}", "layout": machine.layout, "mass_kg": mass - wheel,
                "speed_rpm": machine.speed_rpm, "speed_range_rpm": machine.speeds_rpm,
                "spindle_axis": machine.spindle_axis,
            },
            "suspension": {
                "model": "springs", frequencies: [hertz] * 2, "damping_ratios": [0.1, 0.1],
            },
            "wheel": {
                "mass_kg": wheel, "diameter_mm": max(wheel_.diameter_mm for wheel_ in case.table.wheel),
                **dict([in_file("imbalance_g_mm", max(need - mass * case.eccentricity, 0.0))]),
            },
            "autobalancer": {
                **given, "max_mass_fraction": min(share, 1.0),
                **({} if ball is None else dict([in_file("ball_diameter_mm", ball)])),
            },
            "limits": {"vibration_level_db": limits.vibration_level_db, "quiet_time_s": limits.longest_quiet_time},
        }
    )  # fmt: skip


ROUNDS = 3
"""Rounds in which the masses of the autobalancers and what the races ask for are found together."""


@dataclass(frozen=True)
class SizedRace(RaceDesign):
    """One of several races: its design as a race of its own, its need and typical need [kg m], its place [m].

    `shares`: of each wheel's imbalance that it carries.
    """

    place: float
    need: float
    typical: float
    shares: tuple[float, ...]

    @property
    def capacity_ratio(self) -> float:
        """Capacity of the balls over the need."""
        return self.autobalancer.capacity / self.need if self.need else float("inf")


@dataclass(frozen=True)
class SpindleDesign:
    """The machine with its autobalancers on it, and all races."""

    case: SpindleCase
    """With the masses of the autobalancers without balls, which rest in the forward whirl."""
    bare: SpindleCase
    races: tuple[SizedRace, ...]

    @property
    def autobalancers(self) -> tuple[Candidate, ...]:
        """Balls and housing of each race."""
        return tuple(race.autobalancer for race in self.races)

    @property
    def imbalances(self) -> tuple[float, ...]:
        """Imbalance of each wheel [kg m]."""
        return tuple(abs(wheel.imbalance) for wheel in self.case.wheels)

    @property
    def system_mass(self) -> float:
        """Mass with all autobalancers and their balls [kg]."""
        return self.bare.rotor.mass + sum(made.mass for made in self.autobalancers)

    def balls(self, share: float = 1.0) -> tuple[PlacedImbalance, ...]:
        """A share of the mass of all balls of each race [kg], at its place."""
        masses = (made.balls_mass for made in self.autobalancers)
        return tuple(PlacedImbalance(race.place, share * mass) for race, mass in zip(self.races, masses, strict=True))

    def built(self, table: TwoRaceFile) -> "SpindleDesign":
        """The design as it came out in one machine, whose file may pin the balls and the races that were made."""
        bare = read_case(table).with_races(self.case.races)
        case = bare.carrying(tuple(made.housing.mass for made in self.autobalancers))
        made = (built_race(race, one_race_machine(case, k, race.need)) for k, race in enumerate(self.races))
        return SpindleDesign(case, bare, tuple(made))


def size_races(machine: Machine) -> SpindleDesign:
    """Balls and races of a machine. Raises InputError for a file with one race, and for what cannot be sized."""
    if machine.spindle is None:
        raise InputError("this file has one race")
    return choose_all(read_case(machine.spindle))


def choose_all(case: SpindleCase) -> SpindleDesign:
    """Balls and races for the worst phases; the largest of the balls serves all races.

    Raises InputError if no ball fits the room of a race.
    """
    masses, ball = (0.0,) * len(case.races), None
    for _ in range(ROUNDS):
        loaded = case.carrying(masses)
        races = _sized(loaded, ball)
        diameters = {race.autobalancer.ball_diameter for race in races}
        if len(diameters) > 1:
            ball = max(diameters)
            races = _sized(loaded, ball)
        housings = tuple(race.autobalancer.housing.mass for race in races)
        if housings == masses:
            break
        masses = housings
    return SpindleDesign(case.carrying(masses), case, races)


def _sized(case: SpindleCase, ball: float | None) -> tuple[SizedRace, ...]:
    shares = zip(*(lever_shares(case.races, wheel.place) for wheel in case.wheels), strict=True)
    each = zip(case.races, capacity_needs(case), typical_needs(case), shares, strict=True)
    return tuple(
        SizedRace(**vars(_as_one_race(case, race, need, ball)), place=place, need=need, typical=usual, shares=own)
        for race, (place, need, usual, own) in enumerate(each)
    )


def _as_one_race(case: SpindleCase, race: int, need: float, ball: float | None) -> RaceDesign:
    """Design of one race; checks that depend on the whole machine are left to it."""
    pinned = case.table.autobalancer[race].ball_diameter_mm is not None
    try:
        machine = one_race_machine(case, race, need, None if pinned else ball)
    except ValidationError as error:
        fault = error.errors()[0]
        raise InputError(
            f"race {race + 1} cannot be sized as a race of its own: {'.'.join(map(str, fault['loc']))} would be out of "
            "range",
            place=Place(key="autobalancer"),
            found=f"it feels {felt_mass(case, race):.4g} kg and must carry {shown(need, 'g_mm', '.4g')}",
            remedy="Check masses, inertias, places and imbalances. A flat disc takes one race.",
        ) from None
    return size_race(machine)
