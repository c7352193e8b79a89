"""The type test of a machine with two races simulated: both races settle together, and handles follow both.

A rigid spindle whose races keep the displacements d_i = Δ_i − c_i moves at a place p by s_1p·d_1 + s_2p·d_2, with the
shares s of a lever. So a_hv = W_h Ω²·|s_1p (Δ_1 − c_1) + s_2p (Δ_2 − c_2)|: the test wheel counts only through what
friction leaves. Source: derived; both races still, whatever imbalance there is in any plane.
"""

import math
from functools import cached_property
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.averaging.resting_places import (
    SEED,
    RestingPlacesOfRaces,
    SlowBalls,
    resting_places_of_races,
)
from abu_calc.features.declare.type_test_simulation import (
    EXACT,
    FRICTIONLESS,
    FURTHER,
    GOLDEN,
    MOST_FURTHER,
    HandleMeans,
    orientations_of,
)
from abu_calc.features.two_races.case import LevelPlaceOnSpindle, TwoRaceCase, eccentric_needs
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.formulas.shaken_friction import remaining_band
from abu_calc.formulas.two_races import Pair, PlacedImbalance, lever_shares
from abu_calc.formulas.type_test import acceleration_per_displacement
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.roots import root
from abu_calc.standards.type_test import balancing_factor

DIRECTIONS: Final = 16
"""Angles from the eccentricity of the first race to that of the second, evenly spread: one machine each."""
WEIGHT_FREE: Final = 720
"""Angles between both eccentricities for a mean without friction."""

Array = NDArray[np.float64]
Loads = tuple[PlacedImbalance, ...]


@dataclass(frozen=True)
class TestedSpindle:
    """What the type tests of one design have in common [SI]: both races' balls, handles, orientations.

    `gain`: weighted acceleration per displacement [1/s²]; `background` [m/s²]; `factor`: of the declared value.
    """

    __test__ = False  # not a test of pytest

    design: TwoRaceDesign
    balls: tuple[SlowBalls, SlowBalls]
    handles: tuple[LevelPlaceOnSpindle, ...]
    orientations: tuple[float, ...]
    gain: float
    background: float
    factor: float

    @classmethod
    def of(cls, design: TwoRaceDesign, *, upright: bool = False) -> Self:
        """The type test of a design at its rated speed; `upright`: with the spindle vertical in any case."""
        case = design.case
        test = case.table.type_test
        noise = None if test is None else test.background_a_hv_m_per_s2
        return cls(
            design, (_balls(design, 0, upright), _balls(design, 1, upright)),
            case.places if case.table.machine.handle else (), orientations_of(test),
            acceleration_per_displacement(case.speed), noise or 0.0, balancing_factor(),
        )  # fmt: skip

    @property
    def band(self) -> float:
        """The wider of the friction bands of both races [m]."""
        return max(balls.band for balls in self.balls)

    def shares(self, handle: LevelPlaceOnSpindle) -> Pair:
        """Motion of a handle per motion of each race."""
        return lever_shares(self.design.case.races, handle.place)

    def without(self, loads: Loads) -> dict[str, float]:
        """a_hv of each handle without autobalancers [m/s²], imbalances as given."""
        bare = self.design.bare
        return {
            handle.name: math.hypot(self.gain * abs(bare.rotor.whirl(handle.place, loads, bare.speed)), self.background)
            for handle in self.handles
        }


def _balls(design: TwoRaceDesign, race: int, upright: bool) -> SlowBalls:
    """Balls of a race in their slow motion; gravity shakes friction out of a horizontal spindle."""
    case, abu = design.case, design.races[race].design.autobalancer
    whole = case.friction_arm * abu.pitch_radius / (abu.ball_diameter / 2)
    band = remaining_band(whole, case.speed) if case.horizontal and not upright else whole
    return SlowBalls(
        abu.ball_count, abu.ball_mass * abu.pitch_radius, abu.pitch_radius, case.drags[race], case.inertia_factor,
        band, receptance(case, case.races[race], case.races[race]), case.speed,
    )  # fmt: skip


def receptance(case: TwoRaceCase, at: float, force_at: float) -> complex:
    """Displacement at a place per imbalance at another [1/kg], with the sign of accelerations: −Ω²·h."""
    return -(case.speed**2) * case.rotor.receptance(at, force_at, case.speed)


def required_capacities(design: TwoRaceDesign, loads: Loads) -> Pair:
    """Capacities [kg m] that imbalances require of both races, phases and eccentricities at their worst."""
    off = eccentric_needs(design.case, design.case.speed)
    shares = [(lever_shares(design.case.races, load.place), abs(load.imbalance)) for load in loads]
    first, second = (off[race] + sum(abs(share[race]) * size for share, size in shares) for race in (0, 1))
    return first, second


def carried(design: TwoRaceDesign, loads: Loads) -> bool:
    """True if the balls of both races can balance the imbalances, whatever the angles."""
    return all(
        need <= race.design.autobalancer.capacity
        for need, race in zip(required_capacities(design, loads), design.races, strict=True)
    )


@dataclass(frozen=True, eq=False)
class TwoRaceTest(HandleMeans):
    """Runs with these imbalances on a spindle whose races have an eccentricity [m]: one orientation a run."""

    spindle: TestedSpindle
    loads: Loads
    eccentricity: float
    directions: Array
    """Angle from the eccentricity of the first race to that of the second in each run [rad]."""
    ends: RestingPlacesOfRaces

    @cached_property
    def values(self) -> dict[str, Array]:
        """a_hv of each handle in each run [m/s²]."""
        off = np.stack([np.ones_like(self.directions), np.exp(1j * self.directions)]) * self.eccentricity
        kept, spindle = off - self.ends.displacements, self.spindle
        return {
            handle.name: np.hypot(spindle.gain * np.abs(np.array(spindle.shares(handle)) @ kept), spindle.background)
            for handle in spindle.handles
        }

    @property
    def friction_rms(self) -> float:
        """Displacement that friction leaves [m], rms over the runs, of the race with more of it."""
        return float(np.sqrt((np.abs(self.ends.displacements) ** 2).mean(axis=1)).max())

    def spread(self, name: str) -> tuple[float, float]:
        """Standard deviations [m/s²] at a handle: of a series of one machine, and between machines.

        Machines differ by the angle between the eccentricities of their races.
        """
        by_machine = self.values[name].reshape(-1, DIRECTIONS, len(self.spindle.orientations)).mean(axis=2)
        within = float(by_machine.var(axis=0, ddof=1).mean())
        between = float(by_machine.mean(axis=0).var(ddof=1)) - within / len(by_machine)
        return math.sqrt(within), math.sqrt(max(between, 0.0))

    def standard_error(self, name: str) -> float:
        """Standard error of the mean at a handle [m/s²]: the angles between the eccentricities are not drawn."""
        return self.spread(name)[0] / math.sqrt(len(self.directions) / len(self.spindle.orientations))


def simulated_two_race_test(
    spindle: TestedSpindle, loads: Loads, eccentricity: float, starts: int, seed: int = SEED, *, free: bool = False
) -> TwoRaceTest:
    """Simulate at least so many starts, as many at each orientation and with each angle between the eccentricities.

    The loads turn through the orientations together; `free`: all but the first stand at angles that spread evenly.
    """
    orientations, case = spindle.orientations, spindle.design.case
    rounds = max(2, -(-starts // (len(orientations) * DIRECTIONS)))
    series = np.arange(rounds * DIRECTIONS)
    rounds_of = np.repeat(series, len(orientations))
    directions = 2 * math.pi * (rounds_of % DIRECTIONS) / DIRECTIONS
    turns = (np.array(orientations) + 2 * math.pi * GOLDEN * series[:, None]).ravel()
    races = len(spindle.balls)
    if not spindle.band:
        ends = RestingPlacesOfRaces(np.zeros((races, len(turns)), dtype=complex), 0, np.zeros((0, len(turns))))
        return TwoRaceTest(spindle, loads, eccentricity, directions, ends)
    undisturbed = (np.stack([np.ones_like(directions), np.exp(1j * directions)]) * eccentricity).astype(complex)
    for number, load in enumerate(loads):
        angle = turns + (2 * math.pi * math.sqrt(2 + 4 * number) * rounds_of if free and number else 0.0)
        for race, place in enumerate(case.races):
            undisturbed[race] -= receptance(case, place, load.place) * load.imbalance * np.exp(1j * angle)
    answers = [[receptance(case, at, force_at) for force_at in case.races] for at in case.races]
    return TwoRaceTest(
        spindle, loads, eccentricity, directions, resting_places_of_races(spindle.balls, answers, undisturbed, seed)
    )


def mean_without_friction(spindle: TestedSpindle, eccentricity: float) -> float:
    """Mean a_hv [m/s²] at the highest handle over the angle between both eccentricities, without friction."""
    turned = np.exp(2j * math.pi * np.arange(WEIGHT_FREE) / WEIGHT_FREE)
    means = []
    for handle in spindle.handles:
        first, second = spindle.shares(handle)
        off = spindle.gain * eccentricity * np.abs(first + second * turned)
        means.append(float(np.hypot(off, spindle.background).mean()))
    return max(means)


@dataclass(frozen=True)
class TwoRaceBreakEven:
    """Race eccentricities [m] at which the declared value is that without autobalancers, None: at none is it lower.

    `tried`: eccentricities [m] of the search with the declared value [m/s²].
    """

    frictionless: float | None
    simulated: float | None
    tried: tuple[tuple[float, float], ...]


def search_two_race_break_even(test: TwoRaceTest, limit: float, starts: int) -> TwoRaceBreakEven:
    """Search by simulation, with the same random starts at each eccentricity; `limit`: value without [m/s²]."""
    spindle = test.spindle

    def ideal(eccentricity: float) -> float:
        return spindle.factor * mean_without_friction(spindle, eccentricity) - limit

    if ideal(0.0) >= 0:
        return TwoRaceBreakEven(None, None, ())
    high = limit / spindle.gain
    while ideal(high) < 0:
        high *= 2
    frictionless = root(ideal, 0.0, high, EXACT / 10 * high)
    if not spindle.band:
        points = ((share * frictionless, ideal(share * frictionless) + limit) for share in FRICTIONLESS)
        return TwoRaceBreakEven(frictionless, frictionless, tuple(points))
    tried: dict[float, float] = {}

    def excess(eccentricity: float) -> float:
        if eccentricity not in tried:
            tried[eccentricity] = simulated_two_race_test(spindle, test.loads, eccentricity, starts).declared
        return tried[eccentricity] - limit

    found, high = None, frictionless
    if excess(0.0) < 0:
        for _ in range(MOST_FURTHER):
            if excess(high) >= 0:
                found = root(excess, 0.0, high, EXACT * frictionless)
                break
            high *= FURTHER
    return TwoRaceBreakEven(frictionless, found, tuple(sorted(tried.items())))
