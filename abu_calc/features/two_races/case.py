"""A machine with two races in SI, and the machine with one race that stands for each of them.

A race feels the mass M_i = (J_t − J_p + M·z_k²)/(z₁ − z₂)², k the other race: an eccentricity Δ of race i alone asks
its balls for M_i·Δ. Balls, housing and strength of a race are those of a machine of that mass with one race.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from abu_calc.features.two_races.places import best_races
from abu_calc.formulas.balls import INERTIA_FACTORS
from abu_calc.formulas.two_race_contact import TiltingContact
from abu_calc.formulas.two_races import (
    Bearing,
    Pair,
    PlacedImbalance,
    TiltingRotor,
    balancing_resultants,
    eccentricity_resultants,
    lever_shares,
    worst_resultants,
)
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.two_races import PlacedAutobalancer, TwoRaceFile
from abu_calc.standards.vibration import permissible_imbalance


@dataclass(frozen=True)
class LevelPlaceOnSpindle:
    """Place on the spindle axis [m] from the centre of mass at which a level is wanted."""

    name: str
    place: float


@dataclass(frozen=True)
class TwoRaceCase:
    """The machine without autobalancers, its imbalances and races [SI]; angles [rad], None: unknown phase."""

    table: TwoRaceFile
    rotor: TiltingRotor
    wheels: tuple[PlacedImbalance, ...]
    angles: tuple[float | None, ...]
    races: Pair
    speed: float
    speed_range: Pair
    eccentricity: float
    friction_arm: float
    inertia_factor: float
    places: tuple[LevelPlaceOnSpindle, ...]

    @property
    def drags(self) -> Pair:
        """Viscous drag rate of each race [1/s]."""
        first, second = (race.rolling_drag_per_s for race in self.table.autobalancer)
        return first, second

    @property
    def drag(self) -> float:
        """The larger of them [1/s], which stands for both in a start case."""
        return max(self.drags)

    @property
    def level_limit(self) -> float:
        """Limit of the velocity level [dB]."""
        return self.table.limits.vibration_level_db

    @property
    def horizontal(self) -> bool:
        """True if gravity acts in the plane of the races."""
        return self.table.machine.spindle_axis == "horizontal"

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

    def with_races(self, races: Pair) -> "TwoRaceCase":
        """The machine with its races at these places [m]; levels that are wanted at the races go with them."""
        own = {f"race {number}": place for number, place in enumerate(races, 1)}
        at_races = not self.table.machine.handle and self.table.suspension.model != "bearings"
        places = tuple(replace(held, place=own[held.name]) if at_races else held for held in self.places)
        return replace(self, races=races, places=places)

    def carrying(self, masses: Pair) -> "TwoRaceCase":
        """The machine with autobalancers of these masses [kg] at their races, the centre of mass kept in its place."""
        added = sum(mass * place**2 for mass, place in zip(masses, self.races, strict=True))
        rotor = replace(
            self.rotor, mass=self.rotor.mass + sum(masses), transverse_inertia=self.rotor.transverse_inertia + added
        )
        return replace(self, rotor=rotor)


def read_case(table: TwoRaceFile) -> TwoRaceCase:
    """The case of a file; the angle of the first wheel is the zero mark if it is the only unknown one."""
    machine = table.machine
    speed = to_si(machine.speed_rpm, "rpm")
    wheels = tuple(
        PlacedImbalance(
            to_si(wheel.plane_mm, "mm"),
            to_si(wheel.imbalance_g_mm, "g_mm") if wheel.imbalance_g_mm is not None
            else permissible_imbalance(wheel.balance_grade or "", wheel.mass_kg, speed),
        )
        for wheel in table.wheel
    )  # fmt: skip
    angles = tuple(
        None if wheel.imbalance_angle_deg is None else to_si(wheel.imbalance_angle_deg, "deg") for wheel in table.wheel
    )
    if len(wheels) == 1:
        angles = (0.0,)
    rotor = TiltingRotor(
        machine.mass_kg, machine.transverse_inertia_kg_m2, machine.rotor_polar_inertia_kg_m2, _bearings(table)
    )
    first, second = (to_si(race.plane_mm, "mm") for race in table.autobalancer)
    abu = table.autobalancer[0]
    low, high = machine.speed_range
    case = TwoRaceCase(
        table=table,
        rotor=rotor,
        wheels=wheels,
        angles=angles,
        races=(first, second),
        speed=speed,
        speed_range=(to_si(low, "rpm"), to_si(high, "rpm")),
        eccentricity=to_si(abu.race_eccentricity_mm, "mm"),
        friction_arm=to_si(abu.rolling_friction_mm, "mm"),
        inertia_factor=INERTIA_FACTORS[abu.corrector],
        places=_places(table),
    )
    return _placed(case)


def _placed(case: TwoRaceCase) -> TwoRaceCase:
    """The case with its races at the best places of the stretches that the file allows."""
    stretches = (_stretch(case.table.autobalancer[0]), _stretch(case.table.autobalancer[1]))
    if stretches == (None, None):
        return case
    own = case.table.machine.handle or case.table.suspension.model == "bearings"
    places = [held.place for held in case.places] if own else []
    races = best_races(case.races, stretches, places, lambda pair: capacity_needs(replace(case, races=pair)))
    return case.with_races(races)


def _stretch(race: PlacedAutobalancer) -> Pair | None:
    if race.plane_range_mm is None:
        return None
    low, high = race.plane_range_mm
    return to_si(low, "mm"), to_si(high, "mm")


def _bearings(table: TwoRaceFile) -> tuple[Bearing, ...]:
    """The bearings of the file, or two that stand for springs with one frequency and damping ratio of all freedoms.

    At ±√(J_t/M) translation and tilt have the same frequency, and do not couple.
    """
    given, machine = table.suspension, table.machine
    if given.model == "bearings":
        rows = zip(
            given.bearing_positions_mm or (), given.bearing_stiffness_N_per_m or (),
            given.bearing_damping_N_s_per_m or (), strict=True,
        )  # fmt: skip
        return tuple(Bearing(to_si(place, "mm"), stiffness, damping) for place, stiffness, damping in rows)
    place = math.sqrt(machine.transverse_inertia_kg_m2 / machine.mass_kg)
    frequency = to_si(given.natural_frequencies_hz or 0.0, "hz")
    stiffness = machine.mass_kg * frequency**2 / 2
    damping = (given.damping_ratios or 0.0) * machine.mass_kg * frequency
    return Bearing(place, stiffness, damping), Bearing(-place, stiffness, damping)


def _places(table: TwoRaceFile) -> tuple[LevelPlaceOnSpindle, ...]:
    if table.machine.handle:
        return tuple(
            LevelPlaceOnSpindle(handle.name, to_si(handle.position[2], "mm")) for handle in table.machine.handle
        )
    if table.suspension.model == "bearings":
        positions = table.suspension.bearing_positions_mm or ()
        return tuple(LevelPlaceOnSpindle(f"bearing {k}", to_si(z, "mm")) for k, z in enumerate(positions, 1))
    return tuple(
        LevelPlaceOnSpindle(f"race {k}", to_si(race.plane_mm, "mm")) for k, race in enumerate(table.autobalancer, 1)
    )


def felt_mass(case: TwoRaceCase, race: int) -> float:
    """Mass [kg] that the balls of a race feel: resultant per eccentricity of this race alone, far above resonance."""
    own, other = case.races[race], case.races[1 - race]
    return (case.rotor.forward_inertia + case.rotor.mass * other**2) / (own - other) ** 2


def capacity_needs(case: TwoRaceCase) -> Pair:
    """Largest resultants [kg m] that the balls of each race must have, over unknown phases and the speed range."""
    by_speed = [_needs_at(case, speed) for speed in dict.fromkeys((case.speed, *case.speed_range))]
    return max(needs[0] for needs in by_speed), max(needs[1] for needs in by_speed)


def _needs_at(case: TwoRaceCase, speed: float) -> Pair:
    """Largest resultants [kg m] at one speed [rad/s]."""
    spread, work = (case.eccentricity, case.eccentricity), work_needs(case, speed)
    worst = worst_resultants(case.rotor, case.races, case.wheels, spread, speed)
    if case.unknown_phases:
        return worst[0] + work[0], worst[1] + work[1]
    exact = balancing_resultants(case.races, case.turned(()))
    off = eccentric_needs(case, speed)
    return abs(exact[0]) + off[0] + work[0], abs(exact[1]) + off[1] + work[1]


def work_needs(case: TwoRaceCase, speed: float) -> Pair:
    """Largest resultants [kg m] that a workpiece asks for by the runout of the wheel at work, at its worst angle.

    Zero without [grinding], and for the contact of a face, whose runout does not press.
    """
    table = case.table.grinding
    if table is None or table.contact == "face":
        return 0.0, 0.0
    compliance = 1 / table.contact_stiffness_N_per_m if table.contact == "compliant" else 0.0
    needs = [(0.0, 0.0)]
    for wheel, load in zip(case.table.wheel, case.wheels, strict=True):
        contact = TiltingContact.of(
            case.rotor, load.place, speed, compliance, table.rotation_sense * table.cutting_coefficient,
            complex(to_si(wheel.runout, "mm")),
        )  # fmt: skip
        shares, acting = lever_shares(case.races, load.place), abs(contact.acting_imbalance())
        needs.append((abs(shares[0]) * acting, abs(shares[1]) * acting))
    return max(need[0] for need in needs), max(need[1] for need in needs)


def eccentric_needs(case: TwoRaceCase, speed: float) -> Pair:
    """Largest resultants [kg m] that the eccentricity of both races asks for at a speed [rad/s]."""
    return worst_resultants(case.rotor, case.races, (), (case.eccentricity, case.eccentricity), speed)


def typical_needs(case: TwoRaceCase) -> Pair:
    """Root of the mean square of the resultants [kg m] over all phases."""
    exact = [balancing_resultants(case.races, [wheel]) for wheel in case.wheels]
    by_race = [
        eccentricity_resultants(case.rotor, case.races, pair, case.speed)
        for pair in ((case.eccentricity, 0j), (0j, case.eccentricity))
    ]
    if not case.unknown_phases:
        whole = balancing_resultants(case.races, case.turned(()))
        exact = [whole]
    first, second = (math.sqrt(sum(abs(each[race]) ** 2 for each in (*exact, *by_race))) for race in (0, 1))
    return first, second


def one_race_machine(case: TwoRaceCase, race: int, need: float, ball_mm: float | None = None) -> MachineFile:
    """Machine with one race whose need is that of a race of two; `ball_mm` pins the diameter of its balls.

    Its mass is that which the race feels, without the autobalancer, since every autobalancer adds its own.
    """
    abu, machine, limits = case.table.autobalancer[race], case.table.machine, case.table.limits
    mass = felt_mass(case, race)
    wheel = min(0.1 * mass, case.table.wheel[0].mass_kg)
    given = abu.model_dump(exclude={"plane_mm", "plane_offset_mm", "plane_range_mm"}, exclude_unset=True)
    share = abu.max_mass_fraction * machine.mass_kg / (mass - wheel)
    frequency = max((*case.rotor.critical_speeds(), 1e-3))
    return MachineFile.model_validate(
        {
            "machine": {
                "name": f"{machine.name}, race {race + 1}", "layout": machine.layout, "mass_kg": mass - wheel,
                "speed_rpm": machine.speed_rpm, "speed_range_rpm": machine.speed_range,
                "spindle_axis": machine.spindle_axis,
            },
            "suspension": {
                "model": "springs", "natural_frequencies_hz": [from_si(frequency, "hz")] * 2,
                "damping_ratios": [0.1, 0.1],
            },
            "wheel": {
                "mass_kg": wheel, "diameter_mm": max(wheel_.diameter_mm for wheel_ in case.table.wheel),
                "imbalance_g_mm": from_si(max(need - mass * case.eccentricity, 0.0), "g_mm"),
            },
            "autobalancer": {
                **given, "max_mass_fraction": min(share, 1.0),
                **({} if ball_mm is None else {"ball_diameter_mm": ball_mm}),
            },
            "limits": {"vibration_level_db": limits.vibration_level_db, "quiet_time_s": limits.longest_quiet_time},
        }
    )  # fmt: skip


def pinned(abu: PlacedAutobalancer) -> bool:
    """True if the file pins the diameter of the balls."""
    return abu.ball_diameter_mm is not None
