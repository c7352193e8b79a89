"""The family of arrangements in which the balls of a race balance, and a search of it for the worst one.

Σ m e^{iθ} is given by the imbalance; n − 2 of the n angles are free. `Family` holds one race and its likeness
χ = |Σ m e^{2iθ}|/Σm, `neighbours` moves any balls of any number of races.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.balanced.arrangements import CLOSED, candidates, likeness
from abu_calc.dynamics.balanced.blocks import diagonal
from abu_calc.dynamics.balanced.resting import TOUCHING, narrowest_gap
from abu_calc.frozen import dataclass

Array = NDArray[np.float64]

NEWTON: Final = 30
"""Steps of Newton's method to the constraints."""

LONGEST: Final = 0.3
"""Step of an angle in one of them [rad]."""

HALVINGS: Final = 6
"""Of the interval between a χ that is reached and one that is not."""

NEAREST: Final = 8
"""Candidates from which a χ is tried."""


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
        found = cls(weights, resultant, gap, *_sorted(weights, rows))
        ends = np.array([*rows, *found._beyond(0.0), *found._beyond(1.0)])
        return cls(weights, resultant, gap, *_sorted(weights, ends))

    def nearest(self, chi: float) -> Array:
        """An arrangement of this χ; if none is reached, the row whose χ is nearest."""
        found = self._reached(chi)
        return self.rows[int(np.abs(self.chi - chi).argmin())] if found is None else found

    def _reached(self, chi: float) -> Array | None:
        for k in np.argsort(np.abs(self.chi - chi), kind="stable")[:NEAREST]:
            found = moved_to(self.masses, self.rows[k], self.resultant, chi)
            if found is not None and narrowest_gap(tuple(found)) >= self.gap - TOUCHING:
                return found
        return None

    def _beyond(self, end: float) -> Iterator[Array]:
        """An arrangement whose χ is nearer to 0 or 1 than that of all rows, by halving what is not reached."""
        last = float(self.chi[0] if end < self.chi[0] else self.chi[-1])
        best, wanted = None, end
        for _ in range(HALVINGS):
            found = self._reached(wanted)
            if found is None:
                wanted = (last + wanted) / 2
                continue
            best, last = found, wanted
            if wanted == end:
                break
            wanted = (last + end) / 2
        if best is not None:
            yield best


def _sorted(masses: Array, rows: Array) -> tuple[Array, Array]:
    chi = np.array([likeness(masses.tolist(), row.tolist()) for row in rows])
    order = np.argsort(chi, kind="stable")
    return rows[order], chi[order]


Race = tuple[Array, complex, float]
"""Masses [kg], Σ m e^{iθ} [kg] and the least gap [rad] of the balls of a race."""


def neighbours(races: Sequence[Race], angles: Array, step: float) -> Iterator[Array]:
    """Arrangements a `step` [rad] away from one, both ways along each free direction of the balls of all races.

    Those in which balls overlap are left out.
    """
    first, free = 0, []
    for masses, _, _ in races:
        own = angles[first : first + len(masses)]
        rows = np.array([-masses * np.sin(own), masses * np.cos(own)])
        free.append(np.linalg.svd(rows)[2][2:].T)
        first += len(masses)
    for direction in diagonal(*free).T:
        for way in (step, -step):
            found = closed(races, angles + way * direction)
            if found is not None:
                yield found


def closed(races: Sequence[Race], angles: Array) -> Array | None:
    """The angles [rad] moved so that the balls of each race balance; None if they cannot, or overlap."""
    parts, first = [], 0
    for masses, resultant, gap in races:
        own = moved_to(masses, angles[first : first + len(masses)], resultant)
        if own is None or narrowest_gap(tuple(own)) < gap - TOUCHING:
            return None
        parts.append(own)
        first += len(masses)
    return np.concatenate(parts)


GOLDEN: Final = (math.sqrt(5) - 1) / 2


def largest(function: Callable[[float], float], points: Sequence[float], sections: int) -> float:
    """Where a function of one variable is largest: golden sections about the best of ascending points.

    >>> round(largest(lambda x: -((x - 0.3) ** 2), (0.0, 0.5, 1.0), 20), 4)
    0.3
    """
    found = {x: function(x) for x in points}
    k = max(range(len(points)), key=lambda k: found[points[k]])
    low, high = points[max(0, k - 1)], points[min(len(points) - 1, k + 1)]
    left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    for _ in range(sections if low < high else 0):
        for x in (left, right):
            if x not in found:
                found[x] = function(x)
        if found[left] >= found[right]:
            high, right = right, left
            left = high - GOLDEN * (high - low)
        else:
            low, left = left, right
            right = low + GOLDEN * (high - low)
    return max(found, key=lambda x: found[x])
