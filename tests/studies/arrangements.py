"""Boundaries of stability on anisotropic supports, against a search of random arrangements by other equations.

    python -m tests.studies.arrangements [scenes] [first]

Axis q = (x, y), balls at θ_i + ε_i/√m_i in the rotor, t_i the unit tangent at θ_i + Ωt, M_t the mass with balls:

    M_t q'' + C q' + K q + (B ε)'' = 0,     J R² ε'' + h₀ R² ε' + Bᵀ q'' = 0,     B = R (√m_i t_i)

Only the two combinations of ε in the row space of B meet the support: B = Rot(Ωt) (B₀B₀ᵀ)^½. Half a turn later B has
the other sign, so the multipliers of a turn are those of half a turn, squared. Runge–Kutta's method, in fixed axes.

A boundary is missed by the share by which the highest speed at which a random arrangement grows lies above the highest
boundary that abu-calc finds. A speed of the grid is missed if an arrangement grows there, abu-calc calls it stable, and
no boundary is within half a percent.
"""

import json
import math
import sys
import time
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.stability.boundaries import StabilityBoundary, boundaries
from abu_calc.dynamics.supports.planar import planar
from tests.benchmarks.measuring import keep, machine

Array = NDArray[np.float64]

ARRANGEMENTS, SPEEDS, HALVINGS, STEPS = 200, 24, 9, 96
GROWS = 1e-6
"""Growth per radian of rotation, above the error of the integration."""
ALLOWED = 0.005
DRAWS = 400_000


@dataclass(frozen=True)
class Case:
    """A scene in units of its mass, pitch radius and frequency along x; `half_angle` [rad] of touching balls."""

    seed: int
    stiffness: float
    damping: tuple[float, float]
    masses: tuple[float, ...]
    share: float
    drag: float
    inertia_factor: float
    half_angle: float

    @property
    def scene(self) -> Scene:
        """The same for abu-calc."""
        count = len(self.masses)
        angles = tuple(map(float, range(count)))
        return Scene(
            name=f"anisotropic {self.seed}",
            support=planar(1.0, (1.0, self.stiffness), self.damping),
            speed=2.0,
            imbalance=self.imbalance,
            imbalance_angle=0.0,
            races=(Race(1.0, self.masses, self.drag, self.inertia_factor, angles, (0.0,) * count),),
            duration=100.0,
            start_position=(0.0, 0.0),
            start_velocity=(0.0, 0.0),
        )  # fmt: skip

    @property
    def imbalance(self) -> float:
        """A share of what the balls carry side by side."""
        steps = 2 * self.half_angle * (np.arange(len(self.masses)) - (len(self.masses) - 1) / 2)
        return self.share * abs(complex(np.array(self.masses) @ np.exp(1j * steps)))

    @property
    def speeds(self) -> tuple[float, float]:
        """From below the lower natural frequency to well above the higher one."""
        low, high = sorted((1.0, math.sqrt(self.stiffness)))
        return 0.7 * low, 4.0 * high


def case_of(seed: int) -> Case:
    """Always the same for a seed: 3–6 balls, in one of four scenes unequal, in every other one with size."""
    rng = np.random.default_rng(seed)

    def log(low: float, high: float) -> float:
        return float(np.exp(rng.uniform(math.log(low), math.log(high))))

    count, total = int(rng.integers(3, 7)), log(0.003, 0.05)
    weights = 1 + (0.3 * rng.uniform(-1, 1, count) if rng.random() < 0.25 else np.zeros(count))
    ratio = log(1.1, 3.0)
    return Case(
        seed=seed,
        stiffness=ratio if rng.random() < 0.5 else 1 / ratio,
        damping=(2 * log(0.003, 0.2), 2 * log(0.003, 0.2)),
        masses=tuple((total * weights / weights.sum()).tolist()),
        share=float(rng.uniform(0, 0.85)),
        drag=log(0.003, 0.3),
        inertia_factor=1.4 if rng.random() < 0.5 else 1.0,
        half_angle=float(rng.uniform(0.02, 0.2)) if rng.random() < 0.5 else 0.0,
    )


def arrangements(case: Case, count: int = ARRANGEMENTS) -> Array:
    """Random sets of angles that balance, a row each: n − 2 at random, two close the sum; none overlap."""
    rng, m = np.random.default_rng(case.seed + 10_000), np.array(case.masses)
    rows_kept: list[Array] = []
    for _ in range(DRAWS // 4000):
        free = rng.uniform(0, 2 * math.pi, (4000, len(m) - 2))
        rest = -case.imbalance - np.exp(1j * free) @ m[2:]
        length, (a, b) = np.abs(rest), m[:2]
        closes = (length < a + b) & (length > abs(a - b)) & (length > 0)
        free, rest, length = free[closes], rest[closes], length[closes]
        side = np.where(rng.random(len(rest)) < 0.5, 1, -1)
        first = np.angle(rest) + side * np.arccos(np.clip((length**2 + a * a - b * b) / (2 * length * a), -1, 1))
        second = np.angle(rest - a * np.exp(1j * first))
        rows = np.column_stack([first, second, free])
        places = np.sort(rows % (2 * math.pi), axis=1)
        gaps = np.diff(np.column_stack([places, places[:, 0] + 2 * math.pi]), axis=1).min(axis=1)
        rows_kept.append(rows[gaps >= 2 * case.half_angle])
        if sum(map(len, rows_kept)) >= count:
            break
    return np.concatenate(rows_kept)[:count]


def growth(case: Case, angles: Array, speed: float) -> Array:
    """The largest growth per radian of rotation of each arrangement."""
    m = np.array(case.masses)
    t = np.sqrt(m) * np.stack([-np.sin(angles), np.cos(angles)], axis=1)
    values, vectors = np.linalg.eigh(t @ t.transpose(0, 2, 1))
    root = vectors * np.sqrt(np.maximum(values, 0))[:, None, :] @ vectors.transpose(0, 2, 1)
    mass, J, h = 1.0 + m.sum(), case.inertia_factor, case.drag
    K, C = np.diag((1.0, case.stiffness)), np.diag(case.damping)
    step = math.pi / speed / STEPS

    def matrix(time: float) -> Array:
        """A of (q, ε, q', ε')' = A (q, ε, q', ε')."""
        c, s = math.cos(speed * time), math.sin(speed * time)
        turned = np.array(((c, -s), (s, c)))
        B, slope = turned @ root, speed * np.array(((-s, -c), (c, -s))) @ root
        inertia = np.zeros((len(angles), 4, 4))
        inertia[:, :2, :2], inertia[:, 2:, 2:] = mass * np.eye(2), J * np.eye(2)
        inertia[:, :2, 2:], inertia[:, 2:, :2] = B, B.transpose(0, 2, 1)
        force = np.zeros((len(angles), 4, 8))
        force[:, :2, :2], force[:, :2, 4:6] = -K, -C
        force[:, :2, 2:4], force[:, :2, 6:] = speed**2 * B, -2 * slope
        force[:, 2:, 6:] = -h * np.eye(2)
        whole = np.zeros((len(angles), 8, 8))
        whole[:, :4, 4:] = np.eye(4)
        whole[:, 4:] = np.linalg.solve(inertia, force)
        return whole

    state, after = np.broadcast_to(np.eye(8), (len(angles), 8, 8)), matrix(0.0)
    for k in range(STEPS):
        before, middle, after = after, matrix((k + 0.5) * step), matrix((k + 1) * step)
        first = before @ state
        two = middle @ (state + step / 2 * first)
        three = middle @ (state + step / 2 * two)
        four = after @ (state + step * three)
        state = state + step / 6 * (first + 2 * two + 2 * three + four)
    mirrored = np.diag((1.0, 1.0, -1.0, -1.0, 1.0, 1.0, -1.0, -1.0)) @ state
    largest = np.abs(np.linalg.eigvals(mirrored)).max(axis=1)
    return np.asarray(np.log(largest) / math.pi, dtype=float)


@dataclass(frozen=True)
class Comparison:
    """The highest speeds at which an arrangement grows, by the random ones and by abu-calc; `missed`: see above."""

    seed: int
    balls: int
    tried: int
    highest_random: float | None
    highest: float | None
    missed: float
    speeds_missed: int
    seconds: float


def compared(seed: int, count: int = ARRANGEMENTS) -> Comparison:
    """One scene."""
    case = case_of(seed)
    low, high = case.speeds
    started = time.perf_counter()
    limits = boundaries(case.scene, low, high, case.half_angle)
    seconds, rows = time.perf_counter() - started, arrangements(case, count)
    grid = np.geomspace(low, high, SPEEDS).tolist()
    rates = [growth(case, rows, speed) for speed in grid]
    unstable = [k for k, rate in enumerate(rates) if rate.max() > GROWS]
    missed = sum(grows_unseen(limits, grid[k], low, case) for k in unstable)
    top = _highest(case, rows, grid, rates, unstable)
    own = _unstable_up_to(limits, low, high, case)
    lack = 0.0 if top is None else (1.0 if own is None else max(0.0, top / own - 1))
    return Comparison(seed, len(case.masses), len(rows), top, own, lack, missed, seconds)


def _highest(case: Case, rows: Array, grid: list[float], rates: list[Array], unstable: list[int]) -> float | None:
    """The highest speed at which one grows, by halving above the last of the grid where one does."""
    if not unstable:
        return None
    k = unstable[-1]
    if k == len(grid) - 1:
        return grid[k]
    low, high = grid[k], grid[k + 1]
    worst = rows[np.argsort(rates[k])[-20:]]
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if growth(case, worst, middle).max() > GROWS else (low, middle)
    return low


def stable_at(limits: tuple[StabilityBoundary, ...], speed: float, first: bool) -> bool:
    """Whether abu-calc calls a speed stable; `first`: whether the lowest speed is."""
    below = [limit for limit in limits if limit.speed <= speed]
    return below[-1].stable_above if below else first


def _first(limits: tuple[StabilityBoundary, ...], case: Case) -> bool:
    if limits:
        return not limits[0].stable_above
    from abu_calc.dynamics.stability.verdict import stability

    return bool(stability(case.scene, case.half_angle).stable)


def grows_unseen(limits: tuple[StabilityBoundary, ...], speed: float, low: float, case: Case) -> bool:
    """Whether abu-calc calls a speed stable, and none of its boundaries is near."""
    near = any(abs(limit.speed / speed - 1) <= ALLOWED for limit in limits)
    return stable_at(limits, speed, _first(limits, case)) and not near and speed > low


def _unstable_up_to(limits: tuple[StabilityBoundary, ...], low: float, high: float, case: Case) -> float | None:
    if not stable_at(limits, high, _first(limits, case)):
        return high
    return limits[-1].speed if limits else None


def summary(comparisons: list[Comparison]) -> dict[str, Any]:
    """How many were missed, and the worst ones."""
    worst = sorted(comparisons, key=lambda each: -each.missed)[:5]
    return {
        "scenes": len(comparisons),
        "missed": sum(each.missed > ALLOWED for each in comparisons),
        "speeds_missed": sum(each.speeds_missed for each in comparisons),
        "worst": max((each.missed for each in comparisons), default=0.0),
        "above_random": sum((each.highest or 0) > 1.005 * (each.highest_random or math.inf) for each in comparisons),
        "seconds": sum(each.seconds for each in comparisons),
        "worst_scenes": [asdict(each) for each in worst],
    }  # fmt: skip


def main() -> None:
    """Print each scene, and keep the record."""
    count, first = (int(sys.argv[k]) if len(sys.argv) > k else value for k, value in ((1, 60), (2, 0)))
    comparisons = []
    for seed in range(first, first + count):
        comparisons.append(compared(seed))
        print(json.dumps(asdict(comparisons[-1])), flush=True)
    cases = {"summary": summary(comparisons)}
    print(cases["summary"])
    what = "highest speeds at which an arrangement grows, against 200 random arrangements by other equations"
    print(keep("arrangements", what, "python -m tests.studies.arrangements", machine("1 thread"), first, cases))


if __name__ == "__main__":
    main()
