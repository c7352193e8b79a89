"""The family of arrangements in which the balls of a race balance, and a search of it for the worst one.

Σ m e^{iθ} is given by the imbalance; n − 2 of the n angles are free. `Family` holds one race and its likeness
χ = |Σ m e^{2iθ}|/Σm, `neighbours` moves any balls of any number of races.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.stability.arrangements import CLOSED, candidates, likeness
from abu_calc.dynamics.stability.linearised import diagonal
from abu_calc.dynamics.stability.resting import TOUCHING, narrowest_gap
from abu_calc.foundation.frozen import dataclass

Array = NDArray[np.float64]

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


Race = tuple[Array, complex, float]
"""Masses [kg], Σ m e^{iθ} [kg] and the least gap [rad] of the balls of a race."""


def parts(races: Sequence[Race], angles: Array) -> list[Array]:
    """Angles of all balls, race by race."""
    return np.split(angles, np.cumsum([len(masses) for masses, *_ in races])[:-1])


def neighbours(races: Sequence[Race], angles: Array, step: float) -> Iterator[Array]:
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


def closed(races: Sequence[Race], angles: Array) -> Array | None:
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
