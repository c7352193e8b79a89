"""Choice of the balls of both races: each sized for itself, with one ball for both."""

from pydantic import ValidationError

from abu_calc.features.two_races.case import TwoRaceCase, capacity_needs, felt_mass, one_race_machine, typical_needs
from abu_calc.formulas.two_races import Pair, lever_shares
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.sizing import RaceDesign, size_race
from abu_calc.sizing.track import Track

ROUNDS = 3
"""Rounds in which the masses of the autobalancers and what the races ask for are found together."""


@dataclass(frozen=True)
class SizedRace:
    """One of the two races: its design as a race of its own, its need and typical need [kg m], its place [m].

    `shares`: of each wheel's imbalance that it carries.
    """

    place: float
    need: float
    typical: float
    shares: tuple[float, ...]
    design: RaceDesign

    @property
    def capacity_ratio(self) -> float:
        """Capacity of the balls over the need."""
        return self.design.autobalancer.capacity / self.need if self.need else float("inf")

    @property
    def track(self) -> Track:
        """Race and groove."""
        return self.design.track


@dataclass(frozen=True)
class TwoRaceDesign:
    """The machine with its autobalancers on it, and both races."""

    case: TwoRaceCase
    """With the masses of the autobalancers without balls, which rest in the forward whirl."""
    bare: TwoRaceCase
    races: tuple[SizedRace, SizedRace]

    @property
    def ball_masses(self) -> Pair:
        """Mass of all balls of each race [kg]."""
        first, second = (
            race.design.autobalancer.ball_count * race.design.autobalancer.ball_mass for race in self.races
        )
        return first, second

    @property
    def system_mass(self) -> float:
        """Mass with both autobalancers and their balls [kg]."""
        return self.bare.rotor.mass + sum(race.design.autobalancer.mass for race in self.races)


def choose_both(case: TwoRaceCase) -> TwoRaceDesign:
    """Balls and races for the worst phases; the larger of the two balls serves both races.

    Raises InputError if no ball fits the room of a race.
    """
    masses, ball = (0.0, 0.0), None
    for _ in range(ROUNDS):
        loaded = case.carrying(masses)
        races = _both(loaded, ball)
        diameters = [race.design.autobalancer.ball_diameter for race in races]
        if diameters[0] != diameters[1]:
            ball = from_si(max(diameters), "mm")
            races = _both(loaded, ball)
        first, second = (race.design.autobalancer.housing.mass for race in races)
        if (first, second) == masses:
            break
        masses = (first, second)
    return TwoRaceDesign(case.carrying(masses), case, races)


def _both(case: TwoRaceCase, ball_mm: float | None) -> tuple[SizedRace, SizedRace]:
    needs, typical = capacity_needs(case), typical_needs(case)
    shares = [lever_shares(case.races, wheel.place) for wheel in case.wheels]
    first, second = (
        SizedRace(
            case.races[k], needs[k], typical[k], tuple(share[k] for share in shares),
            _as_one_race(case, k, needs[k], ball_mm),
        )
        for k in (0, 1)
    )  # fmt: skip
    return first, second


def _as_one_race(case: TwoRaceCase, race: int, need: float, ball_mm: float | None) -> RaceDesign:
    """Design of one race; checks that depend on the whole machine are left to it."""
    given = case.table.autobalancer[race].ball_diameter_mm
    try:
        machine = one_race_machine(case, race, need, None if given is not None else ball_mm)
    except ValidationError as error:
        fault = error.errors()[0]
        raise InputError(
            f"race {race + 1} cannot be sized as a race of its own: {'.'.join(map(str, fault['loc']))} would be out of "
            "range",
            place=Place(key="autobalancer"),
            found=f"it feels {felt_mass(case, race):.4g} kg and must carry {from_si(need, 'g_mm'):.4g} g·mm",
            remedy="Check masses, inertias, places and imbalances. A flat disc takes one race.",
        ) from None
    return size_race(machine)
