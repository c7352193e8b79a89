"""The unknowns that make recorded starts likely: features of tracks, their distribution by regression, intervals.

Features of a start are regressed over a bank: their means by polynomials of degree four in a wide box, of degree three
in a narrow one, the logarithms of their variances by degree two. A multivariate Student likelihood (ν = 6) of all
starts is maximised; the profile of the likelihood gives intervals, whose drop is calibrated by sets of starts that are
simulated at the estimate (parametric bootstrap).
"""

import math
from functools import cache
from itertools import combinations_with_replacement
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.identification.bank import WIDE, Array, Bank, Box, Points, Track
from abu_calc.foundation.frozen import dataclass

LEVELS: Final = (0.5, 0.25, 0.12)
"""Shares of the amplitude without balls below which times are taken."""
FLOOR, NOISES = 0.04, 6.0
"""Distances from the end that count as none: this share of the amplitude without balls, or so many times the noise."""
FREEDOM: Final = 6.0
"""ν of the Student likelihood."""
REWEIGHTED: Final = 6
"""Rounds of a weighted fit, which far values hardly move."""
SHRUNK: Final = 0.2
"""Share by which the correlation is drawn to none: differences of features that hardly scatter at one place of a box
do so about another mean at the next, which the regression does not follow.
"""
PRIOR_UM: Final = 12.0
"""Standard deviation of a component of Δ before anything is measured."""
NARROWEST_UM, WIDEST_UM = 10.0, 30.0
"""Half widths of a narrow box along a component of the eccentricity [µm]."""
ENDS: Final = 9.0
"""Standard errors of the mean end in half of a box: friction moves the mean of ten ends by up to three times their
scatter."""
END: Final = 0.09
"""Share of the windows whose mean is the end: the last 15 % of the time."""
DECAY: Final = 4
"""Index of the feature that follows the decay best: the integral of the distance from the end."""

Features = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class TrackReading:
    """How tracks are read: the windows' centres [s], the end of the run-up [s], amplitude A₀ and noise [m], mark.

    `phase_error` [rad]: the largest of the phase that a start has.
    """

    centres: Array
    begin: float
    amplitude: float
    noise: float
    marked: bool
    phase_error: float = 0.0

    def features(self, track: Track) -> Features:
        """Logarithms of times and integrals of the decay, the end [µm], the amplitude at the start over A₀."""
        end = end_of(track)
        away = np.abs(track - end) if self.marked else np.abs(np.abs(track) - abs(end))
        floor = max(FLOOR * self.amplitude, NOISES * self.noise)
        felt = np.where(away < floor, 0.0, away)
        # A single window may be far off by noise; the last time would follow it.
        steady = np.median(np.stack([away, np.append(away[1:], away[-1:]), np.append(away[:1], away[:-1])]), axis=0)
        times = [self._last_above(steady, max(level * self.amplitude, floor)) for level in (*LEVELS, 0.0)]
        shares = felt / self.amplitude
        least = (self.centres[1] - self.centres[0]) / 4
        integrals = [float(np.trapezoid(shares**power, self.centres)) + least for power in (1, 2)]
        ends = (end.real * 1e6, end.imag * 1e6) if self.marked else (abs(end) * 1e6,)
        logs = [math.log(value) for value in (*times, *integrals)]
        return np.array([*logs, *ends, abs(track[0]) / self.amplitude])

    def _last_above(self, away: Array, level: float) -> float:
        """Last time [s] after the run-up at which the distance is above a level, interpolated."""
        least, above = float(self.centres[1] - self.centres[0]), np.flatnonzero(away > level)
        if not len(above):
            return least
        last = int(above[-1])
        time = float(self.centres[last])
        if last + 1 < len(away):
            share = float((away[last] - level) / max(away[last] - away[last + 1], 1e-12))
            time += share * float(self.centres[last + 1] - time)
        return max(time - self.begin, least)

    def noisy(self, tracks: NDArray[np.complex128], seed: int) -> NDArray[np.complex128]:
        """Tracks with the noise that was measured, and an error of the phase each."""
        rng = np.random.default_rng(seed)
        noise = rng.normal(size=tracks.shape) + 1j * rng.normal(size=tracks.shape)
        turned = np.exp(1j * rng.uniform(-self.phase_error, self.phase_error, (len(tracks), 1)))
        return np.asarray(tracks * turned + self.noise * noise)


def end_of(track: Track) -> complex:
    """Mean of the last part of a track."""
    return complex(np.mean(track[int((1 - END) * len(track)) :]))


@cache
def _plan(count: int, degree: int) -> tuple[tuple[int, int], ...]:
    """Each product of components up to a degree, after the one of degree zero: an earlier product, and a component."""
    chosen = [each for k in range(degree + 1) for each in combinations_with_replacement(range(count), k)]
    places = {each: place for place, each in enumerate(chosen)}
    return tuple((places[each[:-1]], each[-1]) for each in chosen[1:])


def _terms(points: Points, degree: int) -> Points:
    """Products of the components up to a degree, for points [point, component]."""
    components = points.T
    products = [np.ones(len(points))]
    for earlier, component in _plan(points.shape[1], degree):
        products.append(products[earlier] * components[component])
    return np.stack(products, axis=1)


def _student_scale(rest: Features) -> Array:
    """Scale of each column by a Student distribution, which far values hardly widen."""
    scale = np.median(np.abs(rest), axis=0) * 1.5 + 1e-12
    for _ in range(REWEIGHTED):
        scale = np.sqrt(np.mean((FREEDOM + 1) / (FREEDOM + (rest / scale) ** 2) * rest**2, axis=0)) + 1e-12
    return np.asarray(scale)


def _inverse_correlation(standard: Features) -> Array:
    """Inverse of the correlation of the features, far values clipped and the correlation shrunk by `SHRUNK`."""
    kept = np.clip(standard, -4, 4)
    kept = kept - kept.mean(axis=0)
    size = np.sqrt(np.mean(kept**2, axis=0)) + 1e-12  # a feature at its floor in every start has none
    correlation = (kept / size).T @ (kept / size) / len(kept)
    return np.asarray(np.linalg.inv((1 - SHRUNK) * correlation + SHRUNK * np.eye(len(size))))


class Regression:
    """Distribution of the features over a box; `degree`: of the polynomials of the means."""

    def __init__(self, bank: Bank, reading: TrackReading, degree: int = 3, seed: int = 3) -> None:
        self.box, self.degree = bank.box, degree
        features = np.array([reading.features(track) for track in reading.noisy(bank.tracks, seed)])
        scaled = bank.box.scaled(bank.points)
        terms, few = _terms(scaled, degree), _terms(scaled, 2)
        self.means = np.linalg.lstsq(terms, features, rcond=None)[0]
        # Balls that friction holds end far away now and then: unweighted, such starts would bend the means.
        for _ in range(REWEIGHTED):
            rest = features - terms @ self.means
            self.variances = np.linalg.lstsq(few, np.log(rest**2 + 1e-10), rcond=None)[0]
            deviations = np.exp(few @ self.variances / 2)
            self.scale = _student_scale(rest / deviations)
            standard = rest / (deviations * self.scale)
            roots = 1 / (np.sqrt(FREEDOM + standard**2) * deviations)
            self.means = np.stack(
                [
                    np.linalg.lstsq(terms * root[:, None], column * root, rcond=None)[0]
                    for column, root in zip(features.T, roots.T, strict=True)
                ],
                axis=1,
            )
        self.inverse = _inverse_correlation(standard)

    def distribution(self, points: Points) -> tuple[Features, Features]:
        """Means and standard deviations of the features at points."""
        scaled = self.box.scaled(np.atleast_2d(points))
        deviations = np.exp(_terms(scaled, 2) @ self.variances / 2) * self.scale
        return _terms(scaled, self.degree) @ self.means, deviations

    def distances(self, point: Points, features: Features) -> Array:
        """Squared distance of each start from the mean at a point, in the scatter there."""
        means, deviations = self.distribution(point)
        standard = (features - means) / deviations
        return np.asarray(np.sum((standard @ self.inverse) * standard, axis=1))

    def likelihood(self, points: Points, features: Features) -> Array:
        """Logarithm of the likelihood of all starts at points, with the prior of Δ."""
        points = np.atleast_2d(points)
        means, deviations = self.distribution(points)
        total = -0.5 * np.sum(points[:, 2:] ** 2, axis=1) / PRIOR_UM**2
        standard = (features[:, None, :] - means) / deviations
        distance = np.sum((standard @ self.inverse) * standard, axis=2)
        total -= 0.5 * (FREEDOM + features.shape[1]) * np.log1p(distance / FREEDOM).sum(axis=0)
        return np.asarray(total - len(features) * np.log(deviations).sum(axis=1))

    def best(
        self,
        features: Features,
        held: tuple[int, float] | None = None,
        begin: Points | None = None,
        part: Box | None = None,
    ) -> "Best":
        """The likeliest point of the box, or of a `part` of it.

        `held`: a component that keeps a value; `begin`: where to look alone.
        """
        from scipy.optimize import minimize

        box = part or self.box
        bounds = list(zip(box.low, box.high, strict=True))
        if held:
            bounds[held[0]] = (held[1], held[1])
        limits = [(float(low), float(high)) for low, high in bounds]
        steps = np.diag(1e-6 * (self.box.high - self.box.low))

        def downhill(point: Points) -> tuple[float, Points]:
            here, *moved = -self.likelihood(np.vstack([point, point + steps]), features)
            return float(here), (np.array(moved) - here) / np.diag(steps)

        if begin is None:
            tried = box.low + (box.high - box.low) * np.random.default_rng(1).random((12_000, 4))
            begins = tried[np.argsort(self.likelihood(tried, features))[-4:]]
        else:
            begins = begin[None]
        ends = []
        for point in begins:
            point = np.clip(np.asarray(point, dtype=float), *np.array(limits).T)
            result = minimize(downhill, point, jac=True, method="L-BFGS-B", bounds=limits)
            ends.append(Best(np.asarray(result.x), -float(result.fun)))
        return max(ends, key=lambda each: each.value)

    def interval(self, features: Features, best: "Best", part: int, drop: float) -> tuple[float, float]:
        """Where the profile of the likelihood has fallen by `drop` on both sides; a bound of `WIDE` if it has not."""
        ends = []
        for bound, sign in ((self.box.low[part], -1), (self.box.high[part], 1)):
            step = sign * (self.box.high[part] - self.box.low[part]) / 50
            point, before, value = best.point, best.value, float(best.point[part])
            while True:
                after = value + step
                if (after - bound) * sign > 0:
                    ends.append(float((WIDE.low if sign < 0 else WIDE.high)[part]))
                    break
                held = self.best(features, (part, after), point)
                if held.value < best.value - drop:
                    ends.append(value + step * (before - best.value + drop) / (before - held.value))
                    break
                point, before, value = held.point, held.value, after
        return ends[0], ends[1]


@dataclass(frozen=True, eq=False)
class Best:
    """A likeliest point and the logarithm of its likelihood."""

    point: Points
    value: float


def narrowed(best: Best, end_error: float, end: complex | None = None) -> Box:
    """A box round an estimate; `end_error`: standard error of the mean end [µm], by friction.

    `end`: the mean end [µm]. The eccentricity is opposite to it but for friction, so that the box need not move in
    search of it: where friction scatters the ends, little else holds it.
    """
    offset = min(max(ENDS * end_error, NARROWEST_UM), WIDEST_UM)
    middle = best.point.copy()
    if end is not None:
        middle[2:] = -end.real, -end.imag
    half = np.array([0.55, 1.0, offset, offset])
    return Box(middle - half, middle + half)


def inside(best: Best, box: Box) -> bool:
    """True if drag rate and lever arm of an estimate lie well inside a box."""
    place = box.place(best.point)[:2]
    return bool(np.all(place > 0.1) and np.all(place < 0.9))
