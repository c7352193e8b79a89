"""Imbalances in two planes behind the readings of a rig, by the rig's data or by trial masses.

    by data      Q = mean over the runs of imbalances(X) − T          formulas.py beside it
    by trials    X = H·(Q + T), H and H·Q by least squares over the runs, T the masses that were on

Numbers in SI; imbalances and motions as complex numbers, as in formulas.py beside it.
"""

import cmath
from collections.abc import Sequence
from typing import Final, Literal

import numpy as np

from abu_calc.features.balancing.formulas import (
    Matrix,
    Pair,
    RollOnRig,
    condition_number,
    displacement,
    imbalances,
    influence,
    natural_frequencies,
)
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si

Method = Literal["rig data", "trial masses"]

ONE_SPEED: Final = 0.01
"""Relative difference of speeds up to which influence coefficients are one set."""
TELLS_APART: Final = 1e-6
"""Least singular value of the trials, over the largest, with which they tell both planes and the rest apart."""
WORST_CONDITION: Final = 300.0
"""Beyond it errors of a third of a percent are as large as the answer: no number is given."""


@dataclass(frozen=True)
class TrialMass:
    """A mass that was on: plane (0 left, 1 right), mass [kg], radius [m], angle behind the mark [rad]."""

    plane: int
    mass: float
    radius: float
    angle: float

    @property
    def imbalance(self) -> complex:
        """Imbalance as a complex number [kg m]."""
        return self.mass * self.radius * cmath.exp(-1j * self.angle)


@dataclass(frozen=True)
class RunOnRig:
    """Readings of a run: speed [rad/s], amplitudes (SI) and phases [rad] of both sensors, by the mark's sensor, which
    stands `sensor` [rad] from them in the sense of rotation; the masses that were on.
    """

    speed: float
    quantity: str
    amplitudes: tuple[float, float]
    phases: tuple[float, float]
    sensor: float = 0.0
    weights: tuple[TrialMass, ...] = ()
    noise: tuple[float, float] = (0.0, 0.0)
    """Standard errors of the amplitudes that a record shows of itself (SI)."""
    unsure: float = 0.0
    """Most that all phases of a record may be off together [rad]."""

    @property
    def motion(self) -> Pair:
        """Displacements by the passage of the mark at the vibration sensors [m]."""
        left, right = (
            displacement(self.quantity, amplitude, phase + self.sensor, self.speed)
            for amplitude, phase in zip(self.amplitudes, self.phases, strict=True)
        )
        return left, right

    @property
    def readings(self) -> Pair:
        """The same as if every reading were a displacement, as the printed formula takes it."""
        left, right = (
            displacement("displacement", amplitude, phase + self.sensor, self.speed)
            for amplitude, phase in zip(self.amplitudes, self.phases, strict=True)
        )
        return left, right

    @property
    def placed(self) -> Pair:
        """Imbalance of the masses that were on, of both planes [kg m]."""
        left, right = (sum((w.imbalance for w in self.weights if w.plane == k), 0j) for k in (0, 1))
        return left, right


@dataclass(frozen=True)
class Balancing:
    """Data from which a two-plane answer is computed."""

    roll: RollOnRig | None
    runs: tuple[RunOnRig, ...]


@dataclass(frozen=True)
class Solution:
    """Imbalances of the roll as it is without the masses of the runs [kg m]; the influence of the planes on the sensors
    at each run [m per kg m]; what the runs read less what these make of them [m].
    """

    method: Method
    imbalance: Pair
    influences: tuple[Matrix, ...]
    misfits: tuple[Pair, ...]


def method_of(case: Balancing) -> Method:
    """Method of balancing: trial masses if they suffice, since measured values rank before assumed ones.

    Raises InputError if neither they nor data of the rig suffice.
    """
    speeds = [run.speed for run in case.runs]
    trials = np.array([[*run.placed, 1.0] for run in case.runs], dtype=complex)
    scale = np.abs(trials).max(axis=0)
    full = bool(scale.min() > 0) and len(trials) >= 3
    apart = np.linalg.svd(trials / np.where(scale > 0, scale, 1.0), compute_uv=False) if full else np.zeros(3)
    one_speed = max(speeds) <= min(speeds) * (1 + ONE_SPEED)
    if full and one_speed and apart[-1] > TELLS_APART * apart[0]:
        return "trial masses"
    if case.roll is not None:
        return "rig data"
    if full and not one_speed:
        raise InputError(
            "influence coefficients belong to one speed", place=Place(key="run"),
            found=f"speeds that differ by {max(speeds) / min(speeds) - 1:.1%}", allowed=f"at most {ONE_SPEED:.0%}",
        )  # fmt: skip
    missing = [name for k, name in enumerate(("left", "right")) if scale[k] == 0]
    raise InputError(
        "the trial runs do not distinguish the planes",
        place=Place(key="run"),
        found=f"{len(case.runs)} runs" + (f", none with a trial in the {missing[0]} plane" if missing else ""),
        allowed="three runs at least: one without a trial and one with a trial in each plane, or others as different",
        remedy="add runs, or [rig] with its data",
    )


def solved(case: Balancing, method: Method) -> Solution:
    """The imbalances behind the runs. Raises NotTrustworthyError where the planes can hardly be told apart."""
    if method == "rig data":
        return _by_rig(case)
    return _by_trials(case)


def _by_rig(case: Balancing) -> Solution:
    roll = case.roll
    if roll is None:
        raise InputError("the rig is not known", place=Place(key="rig"))
    influences = tuple(influence(roll, run.speed) for run in case.runs)
    for each in influences:
        _refuse_singular(each, said_of_resonance(case))
    imbalance = np.mean(
        [np.subtract(imbalances(roll, run.speed, run.motion), run.placed) for run in case.runs], axis=0
    )  # fmt: skip
    return _solution("rig data", (complex(imbalance[0]), complex(imbalance[1])), influences, case.runs)


def _by_trials(case: Balancing) -> Solution:
    trials = np.array([[*run.placed, 1.0] for run in case.runs], dtype=complex)
    motions = np.array([run.motion for run in case.runs])
    scale = np.abs(trials).max(axis=0)
    coefficients = np.linalg.lstsq(trials / scale, motions, rcond=None)[0] / scale[:, None]
    matrix = _matrix(coefficients[:2].T)
    _refuse_singular(matrix)
    Q = np.linalg.solve(coefficients[:2].T, coefficients[2])
    return _solution("trial masses", (complex(Q[0]), complex(Q[1])), (matrix,) * len(case.runs), case.runs)


def _matrix(values: "np.ndarray[tuple[int, int], np.dtype[np.complex128]]") -> Matrix:
    (p, q), (r, s) = values.tolist()
    return (p, q), (r, s)


def _refuse_singular(matrix: Matrix, why: str = "") -> None:
    condition = condition_number(matrix)
    if not condition <= WORST_CONDITION:
        raise NotTrustworthyError(
            f"the sensors hardly distinguish the two planes: the condition number is {condition:.3g}, at most "
            f"{WORST_CONDITION:g} is accepted.{why}\n  Another speed, planes farther apart, or other trial masses."
        )


def near_resonance(case: Balancing) -> tuple[float, float] | None:
    """The least relative distance of a run's speed from a natural frequency, and that frequency [rad/s]."""
    if case.roll is None:
        return None
    natural = natural_frequencies(case.roll)
    return min((abs(run.speed / frequency - 1), frequency) for run in case.runs for frequency in natural)


def said_of_resonance(case: Balancing) -> str:
    """The same as a sentence, for messages; empty where the rig is not known."""
    near = near_resonance(case)
    if near is None:
        return ""
    return f" The speed is {100 * near[0]:.2g} % off the natural frequency of {from_si(near[1], 'hz'):.2f} Hz."


def _solution(method: Method, Q: Pair, influences: Sequence[Matrix], runs: Sequence[RunOnRig]) -> Solution:
    misfits = []
    for run, matrix in zip(runs, influences, strict=True):
        on, motion = run.placed, run.motion
        made = motion_of(matrix, (Q[0] + on[0], Q[1] + on[1]))
        misfits.append((motion[0] - made[0], motion[1] - made[1]))
    return Solution(method, Q, tuple(influences), tuple(misfits))


def motion_of(matrix: Matrix, imbalance: Pair) -> Pair:
    """X = H·Q."""
    (p, q), (r, s) = matrix
    return p * imbalance[0] + q * imbalance[1], r * imbalance[0] + s * imbalance[1]
