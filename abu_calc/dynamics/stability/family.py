"""The family of arrangements in which the balls of a race balance, and a search of it for the worst one.

Σ m e^{iθ} is given by the imbalance; n − 2 of the n angles are free. `Family` holds one race and its likeness
χ = |Σ m e^{2iθ}|/Σm, `neighbours` moves any balls of any number of races.

Arrangements of balls that balance: with n > 2 balls in a race, n − 2 angles are free.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Final, Literal, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.linearised import diagonal
from abu_calc.dynamics.stability.resting import TOUCHING, NotKnownError, Rest, narrowest_gap, needed_gap, resting_state
from abu_calc.foundation.frozen import dataclass

Arrangement = Literal["worst", "fan", "start"]
ARRANGEMENTS: Final[tuple[Arrangement, ...]] = ("worst", "fan", "start")

Array = NDArray[np.float64]

HANDFUL: Final = 5
"""Arrangements that stand for all, from the most even to the most alike in direction."""

AROUND: Final = 120
"""Places of the third group round the race."""

SPACINGS: Final = 3
"""Spacings of a group's balls that are tried, from touching to evenly spread."""

STEPS: Final = 4000
"""Steps of the slow motion to an arrangement."""

PACE: Final = 0.5
"""Pace of one of these steps; from 2/3 on it could overshoot."""

CLOSED: Final = 1e-13
"""Relative; what is left of the balls' sum by rounding."""


def rests(scene: Scene, half_angle: float = 0.0, arrangement: Arrangement = "worst") -> tuple[Rest, ...]:
    """States of rest of a scene to be judged, none where there is none; the even fan of `resting_state` comes first.

    "worst": some that stand for all, see `spread`; on an anisotropic support `Search` starts from them. Races change
    together, from the most even to the least. Where the axis moves only the fan. "start": where the balls go from their
    start angles. `half_angle` β [rad] of touching balls. Raises NotKnownError where no formula gives them.
    """
    fan = resting_state(scene, half_angle)
    if fan is None or arrangement == "fan":
        return () if fan is None else (fan,)
    if arrangement == "start":
        return (_from_start(scene, fan, half_angle),)
    if fan.motion:
        return (fan,)
    choices = [_choices(race, own, needed_gap(scene, race, half_angle)) for race, own in scene.by_race(fan.angles)]
    count = max((len(choice) for choice in choices), default=1)
    states = [
        Rest(tuple(angle for choice in choices for angle in choice[min(k, len(choice) - 1)])) for k in range(count)
    ]
    return (fan, *(rest for rest in states if rest.angles != fan.angles))


def likeness(masses: Sequence[float], angles: Sequence[float]) -> float:
    """χ = |Σ m e^{2iθ}|/Σm: 0 where balls stand evenly spread, 1 where all stand on one line.

    All that small motions know of how equal balls of one race balance (derived; the exact equation of `two_modes`).

    >>> round(likeness((1.0, 1.0, 1.0, 1.0), (0.0, math.pi / 2, math.pi, -math.pi / 2)), 12)
    0.0
    """
    return float(abs(np.dot(masses, np.exp(2j * np.array(angles)))) / sum(masses))


def _choices(race: Race, fan: tuple[float, ...], gap: float) -> list[tuple[float, ...]]:
    """Some arrangements of one race with the sum of the fan, by χ ascending."""
    if len(fan) <= 2:
        return [fan]
    masses = np.array(race.ball_masses)
    return spread(masses, complex(masses @ np.exp(1j * np.array(fan))), gap, narrowest_gap(fan)) or [fan]


def spread(masses: Array, resultant: complex, gap: float, fan_gap: float) -> list[tuple[float, ...]]:
    """A handful of arrangements with Σ m e^{iθ} = resultant [kg], their χ spread from the least to the largest found.

    Balls stand in up to three groups of neighbours, `gap` [rad] apart or further, up to `fan_gap`. The largest χ is
    that of such groups, touching: 40 searches each of 11 sets with 3–12 balls found no larger one. Of unequal balls
    neighbours are those of the file.
    """
    angles = candidates(masses, resultant, gap, fan_gap)
    if not len(angles):
        return []
    chi = np.abs(np.exp(2j * angles) @ masses) / masses.sum()
    wanted = np.linspace(chi.min(), chi.max(), HANDFUL)
    nearest = [int(np.abs(chi - target).argmin()) for target in wanted]
    picked = {round(float(chi[k]), 6): k for k in nearest}
    return [tuple(angles[k].tolist()) for k in picked.values()]


def candidates(masses: Array, resultant: complex, gap: float, fan_gap: float) -> Array:
    """Arrangements with Σ m e^{iθ} = resultant [kg], a row each: some hundreds, in up to three groups of neighbours."""
    wider = np.linspace(gap, max(gap, fan_gap), SPACINGS)[1:].tolist()
    groups = [*_grouped(masses, resultant, gap, AROUND)]
    groups += [rows for spacing in wider for rows in _grouped(masses, resultant, spacing, AROUND // 5)]
    angles = np.concatenate(groups)
    places = np.sort(angles % (2 * math.pi), axis=1)
    gaps = np.diff(np.concatenate([places, places[:, :1] + 2 * math.pi], axis=1), axis=1)
    return np.asarray(angles[gaps.min(axis=1) >= gap - TOUCHING], dtype=float)


def _grouped(masses: Array, resultant: complex, spacing: float, around: int) -> Iterator[Array]:
    """Arrangements, a row each: two groups and a third anywhere, the two where the sides of a triangle close."""
    for sizes in _sizes(masses):
        ends = np.cumsum((0, *sizes))
        offsets = [spacing * (np.arange(size) - (size - 1) / 2) for size in sizes]
        sums = [complex(masses[a:b] @ np.exp(1j * own)) for (a, b), own in zip(pairwise(ends), offsets, strict=True)]
        third = np.linspace(0, 2 * math.pi, around, endpoint=False) if sizes[2] else np.zeros(1)
        rest = resultant - sums[2] * np.exp(1j * third)
        length, first_side, two = np.abs(rest), abs(sums[0]), abs(sums[1])
        closes = (length <= first_side + two) & (length >= abs(first_side - two))
        length, third, rest = length[closes], third[closes], rest[closes]
        # Of no length: opposite groups that are alike, in any direction.
        ratio = (length**2 + first_side**2 - two**2, length**2 + two**2 - first_side**2)
        with np.errstate(divide="ignore", invalid="ignore"):
            cosines = [np.nan_to_num(r / (2 * length * side)) for r, side in zip(ratio, (first_side, two), strict=True)]
        inner = [np.arccos(np.clip(cosine, -1, 1)) for cosine in cosines]
        middles = (
            np.angle(rest) + inner[0] - np.angle(sums[0]),
            np.angle(rest) - inner[1] - np.angle(sums[1]),
            third,
        )
        yield np.concatenate([m[:, None] + own for m, own in zip(middles, offsets, strict=True)], axis=1)


def _sizes(masses: Array) -> Iterator[tuple[int, int, int]]:
    """Sizes of the groups: all, or of equal balls each set once."""
    count, alike = len(masses), bool(np.ptp(masses) == 0)
    for third in range(count - 1):
        for second in range(1, count - third):
            first = count - third - second
            if not alike or first >= second >= third:
                yield first, second, third


def _from_start(scene: Scene, fan: Rest, half_angle: float) -> Rest:
    """Arrangement to which balls without size go from their start angles.

    The motion is averaged and heavily damped: down the slope of |Σ m R_p e^{iθ} − V|²/2 in each race, V its
    share as for evenly spread balls. Raises NotKnownError if the path does not end in such a state, or
    balls end one in another.
    """
    if fan.motion:
        raise NotKnownError("the axis keeps moving: only the even fan is known there, --arrangement fan judges it")
    all_angles: list[float] = []
    for race, own in scene.by_race(fan.angles):
        masses, start = np.array(race.ball_masses), np.array(race.start_angles)
        angles = _downhill(masses / max(masses.sum(), 1e-300), start, np.array(own)) if len(own) else start
        if angles is None or narrowest_gap(tuple(angles)) < needed_gap(scene, race, half_angle) - TOUCHING:
            raise NotKnownError(
                "from these start angles balls without size do not come to an arrangement that balances; "
                "--arrangement worst judges them all"
            )
        all_angles += angles.tolist()
    return Rest(tuple(math.remainder(angle, 2 * math.pi) for angle in all_angles))


def _downhill(shares: Array, start: Array, fan: Array) -> Array | None:
    """θ' = −∂/∂θ |Σ p e^{iθ} − V|²/2p, by steps no longer than the curvature allows, Newton's at the end."""
    angles, wanted = start.astype(float), complex(shares @ np.exp(1j * fan))
    for _ in range(STEPS):
        units = np.exp(1j * angles)
        left = complex(shares @ units - wanted)
        if abs(left) <= CLOSED:
            return angles
        slopes = np.array(((1j * units * shares).real, (1j * units * shares).imag))
        size = np.linalg.svd(slopes, compute_uv=False)
        if abs(left) < 0.1 * size[-1] ** 2 / shares.max():
            angles = angles - np.linalg.lstsq(slopes, np.array((left.real, left.imag)), rcond=None)[0]
        else:
            angles = angles - PACE * (1j * units * left.conjugate()).real
    return None


NEWTON: Final = 30
"""Steps of Newton's method to the constraints."""

LONGEST: Final = 0.3
"""Step of an angle in one of them [rad]."""

NEAREST: Final = 8
"""Rows from which a χ is tried."""

STARTS, TRIALS = 3, 12
"""Rows from which χ is led towards 0 and 1, and the steps that are tried from each."""


def moved_to(masses: Array, angles: Array, resultant: complex, chi: float | None = None) -> Array | None:
    """The angles [rad] near the given ones with Σ m e^{iθ} = resultant [kg], and with this χ where one is given.

    Newton's method with the shortest steps that meet the constraints. None if it does not arrive.
    """
    theta, total = angles.astype(float), float(masses.sum())
    for _ in range(NEWTON):
        units = np.exp(1j * theta)
        left, double = complex(masses @ units - resultant), complex(masses @ units**2)
        lacks, slope = [left.real, left.imag], 1j * units * masses
        rows = [slope.real, slope.imag]
        if chi is not None:
            along = double.conjugate() / abs(double) if double else 1.0
            lacks.append(abs(double) - chi * total)
            rows.append((2j * units**2 * masses * along).real)
        if max(map(abs, lacks)) <= CLOSED * total:
            return theta
        step = np.linalg.lstsq(np.array(rows), np.array(lacks), rcond=None)[0]
        theta = theta - step * min(1.0, LONGEST / max(float(np.abs(step).max()), LONGEST))
    return None


@dataclass(frozen=True)
class Family:
    """Arrangements of the balls of one race: Σ m e^{iθ} = `resultant` [kg], neighbours `gap` [rad] apart or further.

    `rows`: arrangements that stand for all, by χ ascending. Range: all χ for two to four balls with room; of more, or
    unequal ones in the order of the file, χ between the least and the largest that were found.
    """

    masses: Array
    resultant: complex
    gap: float
    rows: Array
    chi: Array

    @classmethod
    def of(cls, masses: Sequence[float], angles: Sequence[float], gap: float) -> Self:
        """The family of an arrangement, which is one of its rows."""
        weights = np.array(masses)
        resultant = complex(weights @ np.exp(1j * np.array(angles)))
        rows = np.concatenate([np.array([angles]), candidates(weights, resultant, gap, narrowest_gap(tuple(angles)))])
        family = cls(weights, resultant, gap, *_sorted(weights, rows))
        ends = np.array([*rows, *family._beyond(0.0), *family._beyond(1.0)])
        return cls(weights, resultant, gap, *_sorted(weights, ends))

    def nearest(self, chi: float) -> Array:
        """An arrangement of this χ; if none is reached, the row whose χ is nearest."""
        reached = self._reached(chi)
        return self.rows[int(np.abs(self.chi - chi).argmin())] if reached is None else reached

    def _reached(self, chi: float) -> Array | None:
        """An arrangement of this χ from the rows whose χ are nearest."""
        near = np.argsort(np.abs(self.chi - chi), kind="stable")[:NEAREST]
        return next((moved for k in near if (moved := self.moved(self.rows[k], chi)) is not None), None)

    def moved(self, angles: Array, chi: float) -> Array | None:
        """An arrangement of this χ near the angles; None if none is, or balls overlap there."""
        moved = moved_to(self.masses, angles, self.resultant, chi)
        return moved if moved is not None and narrowest_gap(tuple(moved)) >= self.gap - TOUCHING else None

    def _beyond(self, end: float) -> Iterator[Array]:
        """Arrangements whose χ are nearer to 0 or 1 than those of the rows, by steps, halved where one fails."""
        for angles in self.rows[:STARTS] if end == 0 else self.rows[-STARTS:]:
            best, chi, share = angles, likeness(self.masses.tolist(), angles.tolist()), 1.0
            for _ in range(TRIALS):
                wanted = chi + share * (end - chi)
                moved = self.moved(best, wanted)
                if moved is None:
                    share /= 2
                    continue
                best, chi, share = moved, wanted, min(1.0, 2 * share)
                if chi == end:
                    break
            yield best
            if chi == end:
                break


def _sorted(masses: Array, rows: Array) -> tuple[Array, Array]:
    chi = np.array([likeness(masses.tolist(), row.tolist()) for row in rows])
    order = np.argsort(chi, kind="stable")
    return rows[order], chi[order]


BallGroup = tuple[Array, complex, float]
"""Masses [kg], Σ m e^{iθ} [kg] and the least gap [rad] of the balls of a race."""


def parts(races: Sequence[BallGroup], angles: Array) -> list[Array]:
    """Angles of all balls, race by race."""
    return np.split(angles, np.cumsum([len(masses) for masses, *_ in races])[:-1])


def neighbours(races: Sequence[BallGroup], angles: Array, step: float) -> Iterator[Array]:
    """Arrangements a `step` [rad] away from one, both ways along each free direction of the balls of all races.

    Those in which balls overlap are left out.
    """
    free = []
    for (masses, _, _), own in zip(races, parts(races, angles), strict=True):
        rows = np.array([-masses * np.sin(own), masses * np.cos(own)])
        free.append(np.linalg.svd(rows)[2][2:].T)
    for direction in diagonal(*free).T:
        for way in (step, -step):
            neighbour = closed(races, angles + way * direction)
            if neighbour is not None:
                yield neighbour


def closed(races: Sequence[BallGroup], angles: Array) -> Array | None:
    """The angles [rad] moved so that the balls of each race balance; None if they cannot, or overlap."""
    moved = []
    for (masses, resultant, gap), before in zip(races, parts(races, angles), strict=True):
        own = moved_to(masses, before, resultant)
        if own is None or narrowest_gap(tuple(own)) < gap - TOUCHING:
            return None
        moved.append(own)
    return np.concatenate(moved)


GOLDEN: Final = (math.sqrt(5) - 1) / 2


def largest(function: Callable[[float], float], points: Sequence[float], sections: int) -> float:
    """Place of the largest value of a function of one variable.

    It is found by golden sections about the best of ascending points.

    >>> round(largest(lambda x: -((x - 0.3) ** 2), (0.0, 0.5, 1.0), 20), 4)
    0.3
    """
    values = {x: function(x) for x in points}
    k = max(range(len(points)), key=lambda k: values[points[k]])
    low, high = points[max(0, k - 1)], points[min(len(points) - 1, k + 1)]
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    for _ in range(sections if low < high else 0):
        for x in (left, right):
            if x not in values:
                values[x] = function(x)
        if values[left] >= values[right]:
            high, right = right, left
            left = high - GOLDEN * (high - low)
        else:
            low, left = left, right
            right = low + GOLDEN * (high - low)
    return max(values, key=lambda x: values[x])
