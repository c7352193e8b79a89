"""Balancing of one plane from amplitudes alone: four runs or more, three of them with trial masses.

Every amplitude is proportional to the imbalance that is on: A_k = g·|Q + T|, with one gain g for each sensor and
speed. The squares are linear in g², g²·Q and g²·|Q|², which gives a start; Newton steps on the amplitudes follow.
"""

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.balancing.runs import Balancing
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

TELLS: Final = 1e-3
"""Least singular value of the layout of trial masses, over the largest, that gives one solution."""
LEAST_RUNS: Final = 4
STEPS: Final = 60
CLOSE: Final = 1e-11
"""Relative step at which the solution is final."""
MOST_DAMPING: Final = 1e8


@dataclass(frozen=True)
class SpeedSet:
    """Runs of one speed: their places, the masses that were on [kg m], amplitudes (runs × sensors) [m]."""

    runs: tuple[int, ...]
    placed: Complexes
    amplitudes: Floats

    @property
    def scale(self) -> float:
        """Largest mass that was on, or 1 [kg m]."""
        return float(np.abs(self.placed).max()) or 1.0

    @property
    def terms(self) -> Floats:
        """Columns of A_k²: 1, 2·Re T, 2·Im T, |T|², masses over their largest."""
        T = self.placed / self.scale
        return np.column_stack([np.ones(len(T)), 2 * T.real, 2 * T.imag, np.abs(T) ** 2])

    @property
    def apart(self) -> float:
        """Least over largest singular value of the layout."""
        if len(self.placed) < LEAST_RUNS:
            return 0.0
        values = np.linalg.svd(self.terms, compute_uv=False)
        return float(values[-1] / values[0])

    def gains(self, Q: complex) -> Floats:
        """Gains of the sensors by least squares at a given imbalance."""
        sizes = np.abs(Q + self.placed)
        whole = float(sizes @ sizes)
        return np.asarray(sizes @ self.amplitudes / whole if whole else np.zeros(self.amplitudes.shape[1]))


def _sets(case: Balancing) -> list[SpeedSet]:
    made = []
    for group in case.speed_groups:
        runs = [case.runs[index] for index in group]
        amplitudes = np.array([[abs(x) for x in run.motion] for run in runs])
        made.append(SpeedSet(group, np.array([run.placed[0] for run in runs]), amplitudes))
    return made


def tells_without_phase(case: Balancing) -> None:
    """Refuse runs whose masses leave two solutions."""
    if case.planes != 1:
        raise InputError("without phase one plane can be balanced, not two", place=Place(key="run"),
                         remedy="add phase_deg = …, or [single_plane]")  # fmt: skip
    sets = _sets(case)
    if max(each.apart for each in sets) > TELLS:
        return
    most = max(len(set(each.placed.tolist())) for each in sets)
    if most < LEAST_RUNS:
        raise InputError(
            "too few runs for balancing without phase", place=Place(key="run"),
            found=f"{most} state{'s' * (most > 1)} of the rotor at one speed",
            allowed="four: one without a trial mass, three with the trial mass at three angles",
            remedy="add a run with the trial mass at another angle, 120° on",
        )  # fmt: skip
    raise InputError(
        "the trial masses lie on one line or on one circle, which leaves two solutions", place=Place(key="run"),
        found=f"{most} states of the rotor at one speed", allowed="trial masses at three angles, 120° apart",
        remedy="move one trial mass to an angle off the line of the others",
    )  # fmt: skip


@formula(
    "Imbalance of one plane without phase",
    "A_k = g_s·|Q + T_trial|",
    "kg m",
    where=(
        "A_k² = g_s²·(|Q|² + 2·Re(Q̄·T_trial) + |T_trial|²) is linear in g_s², g_s²·Q and its size: the start. Least "
        "squares of the amplitudes give the result. Four runs are needed: three leave two solutions. No solution is "
        "unique if zero and all T_trial lie on one line or on one circle."
    ),
    source="the circles of the four-run method as equations",
)
def solved_without_phase(case: Balancing, near: complex | None = None) -> tuple[complex, tuple[tuple[float, ...], ...]]:
    """Imbalance [kg m], and the gain of each sensor at each run [m per kg m].

    `near`: solution of nearly the same case, from which the search starts.
    """
    sets = _sets(case)
    starts = [near] if near is not None else [start for start in _starts(sets) if np.isfinite(start)]
    if not starts:
        raise NotTrustworthyError(
            "the trial masses do not change the readings, so that their gain is not known.\n  Heavier trial masses."
        )
    fits = [_refined(sets, start) for start in starts]
    imbalance = min(fits, key=lambda Q: float(np.sum(_residuals(sets, Q) ** 2)))
    gains: list[tuple[float, ...]] = [()] * len(case.runs)
    for each in sets:
        for index in each.runs:
            gains[index] = tuple(each.gains(imbalance).tolist())
    return imbalance, tuple(gains)


def _starts(sets: Sequence[SpeedSet]) -> Iterator[complex]:
    """Solutions of the linear equations of each sensor and speed whose masses tell one.

    Noise may lead the start to the other side of the circle of the trial masses, so its image in it is one, too.
    """
    for each in sets:
        if each.apart <= TELLS:
            continue
        for readings in each.amplitudes.T:
            _, along, across, gain = np.linalg.lstsq(each.terms, readings**2, rcond=None)[0]
            if gain > 0:
                start = complex(along, across) / gain * each.scale
                yield start
                if start:
                    yield each.scale**2 / start.conjugate()


def _residuals(sets: Sequence[SpeedSet], Q: complex) -> Floats:
    """Misfits of all amplitudes, those of each sensor and speed over their largest."""
    parts = []
    for each in sets:
        off = each.amplitudes - np.abs(Q + each.placed)[:, None] * each.gains(Q)[None, :]
        most = each.amplitudes.max(axis=0)
        parts.append((off / np.where(most > 0, most, 1.0)).ravel())
    return np.concatenate(parts)


def _refined(sets: Sequence[SpeedSet], start: complex) -> complex:
    """Imbalance with the least squares of misfits, by damped Gauss–Newton steps from a start."""
    Q, damping = start, 0.0
    scale = max([abs(start), *(each.scale for each in sets)])
    residuals = _residuals(sets, Q)
    for _ in range(STEPS):
        step = 1e-6 * scale
        columns = np.column_stack([
            (_residuals(sets, Q + turn * step) - _residuals(sets, Q - turn * step)) / (2 * step) for turn in (1, 1j)
        ])  # fmt: skip
        normal = columns.T @ columns
        change = np.linalg.lstsq(normal + damping * np.diag(np.diag(normal)), -columns.T @ residuals, rcond=None)[0]
        moved = Q + complex(change[0], change[1])
        after = _residuals(sets, moved)
        if after @ after <= residuals @ residuals:
            done = abs(moved - Q) <= CLOSE * scale
            Q, residuals, damping = moved, after, damping / 10
            if done:
                break
        else:
            if abs(moved - Q) <= CLOSE * scale or damping > MOST_DAMPING:
                break
            damping = max(10 * damping, 1e-4)
    return Q
