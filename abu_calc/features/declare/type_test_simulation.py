"""The type test simulated: where balls come to rest from random starts, and what each handle then feels.

Each run is one start with the test wheel in one of its orientations. The race keeps its eccentricity, friction leaves
another displacement at each start, and both move the handles: a_hv = W_h Ω²·|P U e^{iψ} + Q (Δ − c)|/√2.
"""

import math
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.averaging.resting_places import SEED, RestingPlaces, SlowBalls, resting_places
from abu_calc.formulas.type_test import (
    MANY,
    HandleGain,
    TypeTestBody,
    acceleration_per_displacement,
    evenly,
    frictionless_break_even,
)
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, Stage
from abu_calc.foundation.roots import root
from abu_calc.foundation.units import to_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.type_test import background, band, type_test_body, upright_band
from abu_calc.standards.vibration import balancing_factor, usual_orientations

STARTS: Final = 10_000
"""Starts that are simulated; means are then known to about 1 %."""
EXACT: Final = 0.002
"""Share of an eccentricity to which the break-even one is searched."""
FURTHER: Final = 1.3
"""Factor by which the search goes on where friction lowers a value."""
MOST_FURTHER: Final = 5
FRICTIONLESS: Final = (0.0, 0.5, 1.0, 1.3)
"""Shares of the break-even eccentricity at which a race without friction is evaluated, for its curve."""
GOLDEN: Final = (math.sqrt(5) - 1) / 2
"""Share of a turn between the race eccentricities of two series: they spread evenly, however many there are."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Spindle:
    """What a type test of one design has in common [SI]: body without and with autobalancer, balls, orientations.

    `gain`: weighted acceleration per rms displacement [1/s²]; `background` [m/s²]; `factor`: of the declared value.
    """

    bare: TypeTestBody
    body: TypeTestBody
    balls: SlowBalls
    orientations: tuple[float, ...]
    gain: float
    background: float
    factor: float

    @classmethod
    def of(cls, case: Case, candidate: Candidate, *, upright: bool = False) -> "Spindle":
        """The type test of a design at its rated speed; `upright`: with the spindle vertical in any case."""
        body = type_test_body(case, candidate)
        balls = SlowBalls(
            candidate.ball_count, candidate.ball_moment, candidate.pitch_radius, case.drag,
            case.inertia_factor, (upright_band if upright else band)(case, candidate), body.race_by_race, case.speed,
        )  # fmt: skip
        plan, usual = case.table.type_test, usual_orientations()
        given = None if plan is None else plan.orientations
        angles = given or (360.0 * k / usual for k in range(usual))
        return cls(
            type_test_body(case), body, balls, tuple(to_si(angle, "deg") for angle in angles),
            acceleration_per_displacement(case.speed), background(case.table), balancing_factor(),
        )  # fmt: skip

    def without(self, imbalance: float) -> dict[str, float]:
        """a_hv of each handle without the autobalancer [m/s²]."""
        return {each.name: math.hypot(self.gain * each.without(imbalance), self.background) for each in self.bare.gains}


@dataclass(frozen=True, eq=False)
class SimulatedTest:
    """Runs of a type test: an imbalance [kg m] on a spindle with a race eccentricity [m], one orientation a run."""

    spindle: Spindle
    imbalance: float
    eccentricity: float
    turns: Array
    """Orientation of the wheel in each run [rad], from the race eccentricity."""
    ends: RestingPlaces

    @cached_property
    def values(self) -> dict[str, Array]:
        """a_hv of each handle in each run [m/s²]."""
        return {gain.name: self._of(gain) for gain in self.spindle.body.gains}

    @cached_property
    def means(self) -> dict[str, float]:
        """Mean a_hv of each handle [m/s²]."""
        return {name: float(values.mean()) for name, values in self.values.items()}

    @property
    def highest(self) -> str:
        """The handle with the highest mean."""
        return max(self.means, key=self.means.__getitem__)

    @property
    def declared(self) -> float:
        """The declared value [m/s²]: the mean at the highest handle, times the factor."""
        return self.spindle.factor * self.means[self.highest]

    def _of(self, gain: HandleGain) -> Array:
        kept = self.eccentricity - self.ends.displacements
        wheel = self.imbalance * np.exp(1j * self.turns)
        square = gain.imbalance * self.imbalance**2 + gain.race * np.abs(kept) ** 2
        square += 2 * (gain.cross * wheel.conj() * kept).real
        spindle = self.spindle
        return np.asarray(np.sqrt(spindle.gain**2 * np.maximum(square, 0.0) + spindle.background**2))

    @property
    def friction_rms(self) -> float:
        """Displacement of the race that friction leaves [m], rms over the runs."""
        return float(np.sqrt((np.abs(self.ends.displacements) ** 2).mean()))

    def standard_error(self, name: str) -> float:
        """Standard error of the mean at a handle [m/s²], from the spread of the series."""
        series = self._series(name)
        return float(series.std(ddof=1) / math.sqrt(len(series)))

    def deviation_of_series(self, name: str) -> float:
        """Standard deviation [m/s²] of a series: its mean over the orientations, with one run at each."""
        return float(self._series(name).std(ddof=1))

    def _series(self, name: str) -> Array:
        """Means of one run at each orientation."""
        return np.asarray(self.values[name].reshape(-1, len(self.spindle.orientations)).mean(axis=1))


def simulated_test(
    spindle: Spindle, imbalance: float, eccentricity: float, starts: int = STARTS, seed: int = SEED
) -> SimulatedTest:
    """Simulate at least so many starts, as many at each orientation.

    Nobody knows the angle of the race eccentricity, so each series of orientations has another one, evenly spread.
    Without friction every start ends with the race where its eccentricity puts it: c = 0.
    """
    rounds = max(2, -(-starts // len(spindle.orientations)))
    turns = (np.array(spindle.orientations) + 2 * math.pi * GOLDEN * np.arange(rounds)[:, None]).ravel()
    if not spindle.balls.band:
        return SimulatedTest(
            spindle,
            imbalance,
            eccentricity,
            turns,
            RestingPlaces(np.zeros(len(turns), dtype=complex), 0, np.zeros((0, len(turns)))),
        )
    undisturbed = eccentricity - spindle.body.race_by_wheel * imbalance * np.exp(1j * turns)
    return SimulatedTest(spindle, imbalance, eccentricity, turns, resting_places(spindle.balls, undisturbed, seed))


@dataclass(frozen=True)
class BreakEven:
    """Race eccentricities [m] at which the declared value is that without autobalancer, or None: at none is it lower.

    `frictionless`: closed form; `simulated`; `tried`: eccentricities [m] of the search with the declared value [m/s²].
    """

    frictionless: float | None
    simulated: float | None
    tried: tuple[tuple[float, float], ...]


def search_break_even(test: SimulatedTest, starts: int, progress: Progress) -> BreakEven:
    """Search by simulation, with the same random starts at each eccentricity; the closed form beside it."""
    spindle, imbalance = test.spindle, test.imbalance
    limit = max(spindle.without(imbalance).values())
    noise = spindle.background / spindle.gain
    ideal = frictionless_break_even(
        spindle.body.gains, imbalance, limit / (spindle.factor * spindle.gain), evenly(MANY), noise
    )
    if ideal is None:
        return BreakEven(None, None, ())
    if not spindle.balls.band:
        points = (share * ideal for share in FRICTIONLESS)
        tested = ((point, simulated_test(spindle, imbalance, point, starts).declared) for point in points)
        return BreakEven(ideal, ideal, tuple(tested))
    tried: dict[float, float] = {}

    def excess(eccentricity: float) -> float:
        progress(Stage("break-even eccentricity", min(len(tried) / 8, 1.0)))
        tried[eccentricity] = simulated_test(spindle, imbalance, eccentricity, starts).declared
        return tried[eccentricity] - limit

    found = None
    if excess(0.0) < 0:
        high = ideal
        for _ in range(MOST_FURTHER):
            if excess(high) >= 0:
                found = root(lambda e: tried[e] - limit if e in tried else excess(e), 0.0, high, EXACT * ideal)
                break
            high *= FURTHER
    return BreakEven(ideal, found, tuple(sorted(tried.items())))
