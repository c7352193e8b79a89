"""Races and their balls."""

import sys
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

LARGEST: Final = sys.float_info.max
NON_NEGATIVE: Final = (0.0, LARGEST)


def finite(name: str, values: tuple[float, ...]) -> None:
    """Refuse infinities and NaN."""
    for value in values:
        Range(name, -LARGEST, LARGEST, remedy="give a finite number").check(value)


def same_length(name: str, values: tuple[float, ...], count: int, of: str) -> None:
    """Refuse values that are more or fewer than what they belong to."""
    if len(values) != count:
        raise InputError(f"{name}: one value for each {of}", found=str(len(values)), allowed=str(count))


@dataclass(frozen=True)
class Race:
    """A race and its balls.

    pitch_radius R_p [m] to the ball centres; ball_masses [kg], none or more; drag h0 [1/s], the torque on a ball being
    −m·R_p²·h0·(speed relative to the race); inertia_factor J = 1 (point), 7/5 (rolling ball), 3/2 (rolling roller);
    start_angles [rad] in the rotor; start_speeds [rad/s] relative to the race; plane_offset z [m] from the centre of
    mass; ball_radius r [m], 0 where it is not known. Raises RangeError, InputError.
    """

    pitch_radius: float
    ball_masses: tuple[float, ...]
    drag: float
    inertia_factor: float
    start_angles: tuple[float, ...]
    start_speeds: tuple[float, ...]
    plane_offset: float = 0.0
    ball_radius: float = 0.0

    def __post_init__(self) -> None:
        Range("pitch radius", 0, LARGEST, "m", open_low=True).check(self.pitch_radius)
        Range("rolling drag", *NON_NEGATIVE, "1/s").check(self.drag)
        # Below 1 a ball would have less than its own mass, above 2 more than a rolling thin ring.
        Range("inertia factor", 1, 2).check(self.inertia_factor)
        Range("ball radius", 0, self.pitch_radius, "m").check(self.ball_radius)
        finite("plane offset", (self.plane_offset,))
        for mass in self.ball_masses:
            Range("ball mass", 0, LARGEST, "kg", open_low=True).check(mass)
        for name, values in (("start angles", self.start_angles), ("start speeds", self.start_speeds)):
            same_length(name, values, len(self.ball_masses), "ball")
            finite(name, values)

    @property
    def static_moment(self) -> float:
        """Σ m·R_p [kg m]: the imbalance of all balls in one place."""
        return sum(self.ball_masses) * self.pitch_radius


Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Balls:
    """All balls of some races, race by race: arrays with one number each, and which race a ball is in.

    masses m [kg], radii R_p [m], drags h₀ [1/s], factors J, sizes r [m], places z of their races [m].
    """

    race: NDArray[np.intp]
    masses: Array
    radii: Array
    drags: Array
    factors: Array
    sizes: Array
    places: Array

    @property
    def static_moments(self) -> Array:
        """m R_p [kg m]."""
        return self.masses * self.radii

    def mass(self, rows: int) -> Array:
        """Σ m [[I, zI], [zI, z²I]], or its first rows: what they weigh at the centres of their races.

        In x and y of the centre of mass and the tilts toward these. That is all that balls which are free to roll weigh
        in the motion of the frame, when their angles are counted in space; see `Support.holding` for balls that stand.
        """
        m, places = self.masses, self.places
        sums = m.sum(), (m * places).sum(), (m * places**2).sum()
        planes = np.array([[sums[0], sums[1]], [sums[1], sums[2]]])
        return np.kron(planes, np.eye(2))[:rows, :rows]


def balls_of(races: Sequence[Race]) -> Balls:
    """All balls of the races."""
    sizes = [len(race.ball_masses) for race in races]

    def each(name: str) -> Array:
        """A number of each race, repeated for its balls."""
        return np.repeat(np.array([getattr(race, name) for race in races], dtype=float), sizes)

    return Balls(
        race=np.repeat(np.arange(len(sizes)), sizes),
        masses=np.array([mass for race in races for mass in race.ball_masses], dtype=float),
        radii=each("pitch_radius"),
        drags=each("drag"),
        factors=each("inertia_factor"),
        sizes=each("ball_radius"),
        places=each("plane_offset"),
    )
