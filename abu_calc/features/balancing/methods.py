"""Imbalances behind the readings: by the rig's data, by trial masses, by stored coefficients, or without phase.

    by data            X − W·T = W·Q, W by the rig's data                       formulas.py beside it
    by trials          X = W·(Q + T), W and W·Q by least squares over the runs of each speed, T the masses that were on
    by coefficients    X − W·T = W·Q, W as stored
    without phase      |X| = g·|Q + T| of each sensor                           runs.py beside it

Q is one for all speeds and sensors: it minimises the sum of the squares of the vibration that remains, over all sensors
and speeds, in the quantity that the sensors read. Numbers in SI; imbalances and motions as complex numbers, as in
formulas.py.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.balancing.formulas import (
    Matrix,
    Vector,
    condition_number,
    influence,
    natural_frequencies,
    reading_factor,
)
from abu_calc.features.balancing.runs import (
    ONE_SPEED,
    Balancing,
    Coefficients,
    amplitude_sets,
    solved_without_phase,
    tells_without_phase,
)
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown

Array = NDArray[np.complex128]
Equation = tuple[float, Array, Array]
"""Speed [rad/s], W and X of the readings of a run, or of the runs of a speed."""
Method = Literal["rig data", "trial masses", "runs without phase", "stored coefficients"]

TELLS_APART: Final = 1e-6
"""Least singular value of the trials, over the largest, with which they tell all planes and the rest apart."""
TINY: Final = 1e-12
"""Change of a reading that only rounding makes, relative."""
WORST_CONDITION: Final = 300.0
"""Beyond it errors of a third of a percent are as large as the answer: no number is given."""


@dataclass(frozen=True)
class Solution:
    """Imbalances of the rotor without the masses of the runs [kg m]; the influence of the planes on the sensors at each
    run [m per kg m]; what the runs read less what these make of them [m].
    """

    method: Method
    imbalance: Vector
    influences: tuple[Matrix, ...]
    misfits: tuple[Vector, ...]
    condition: float
    """Condition number of the equations for the imbalance."""
    sensor_imbalances: Vector = ()
    """Imbalance that each sensor tells alone at each speed, without phase [kg m]."""


def method_of(case: Balancing) -> Method:
    """Method of balancing: stored coefficients if they are given, then trial masses if they suffice, since measured
    values rank before assumed ones.

    Raises InputError with what is missing if nothing suffices.
    """
    if case.coefficients is not None:
        _refuse_other_coefficients(case, case.coefficients)
        return "stored coefficients"
    if not case.runs[0].phases:
        tells_without_phase(case)
        return "runs without phase"
    lacking = next((lack for group in case.speed_groups if (lack := lacking_at(case, group))), None)
    if lacking is None:
        return "trial masses"
    if case.roll is not None:
        return "rig data"
    raise lacking


def lacking_at(case: Balancing, group: Sequence[int]) -> InputError | None:
    """Error that says what the trial runs of a speed lack to give influence coefficients; None if they suffice."""
    runs = [case.runs[index] for index in group]
    trials = np.array([[*run.placed, 1.0] for run in runs], dtype=complex)
    scale = np.abs(trials).max(axis=0)
    planes = case.planes
    full = bool(scale.min() > 0) and len(trials) > planes
    apart = np.linalg.svd(trials / np.where(scale > 0, scale, 1.0), compute_uv=False) if full else np.zeros(planes + 1)
    if full and apart[-1] > TELLS_APART * apart[0]:
        return None
    groups = len(case.speed_groups)
    at = f" at {shown(runs[0].speed, 'rpm', '.0f')}" if groups > 1 else ""
    names = ("left", "right") if planes == 2 else ("single",)
    missing = [name for k, name in enumerate(names) if scale[k] == 0]
    found = f"{len(runs)} run{'s' * (len(runs) > 1)}{at}"
    found += f", none with a trial in the {missing[0]} plane" if missing else ""
    if not missing and full:
        found += ", whose trials put the planes in one fixed ratio"
    several = " Influence coefficients belong to one speed." if groups > 1 else ""
    if planes == 1:
        return InputError(
            "the trial runs do not give the influence of the plane", place=Place(key="run"), found=found,
            allowed="two runs at least: one without a trial and one with",
            remedy="add a run with a trial mass: trial = { mass_g, angle_deg }. Stored coefficients do without: "
            f"--coefficients FILE.{several}",
        )  # fmt: skip
    unknown = "" if any(run.weights for run in case.runs) else ": without [rig] the rig is not known"
    return InputError(
        f"the trial runs do not distinguish the planes{unknown}", place=Place(key="run"), found=found,
        allowed="three runs at least: one without a trial and one with a trial in each plane, or others as different"
        f"{', all at one speed' if several else ''}",
        remedy=f"add runs, or [rig] with its data. Stored coefficients do without: --coefficients FILE.{several}",
    )  # fmt: skip


def _refuse_other_coefficients(case: Balancing, stored: Coefficients) -> None:
    for index, run in enumerate(case.runs):
        if stored.at(run.speed) is None:
            raise InputError(
                "no stored coefficients are of this speed", place=Place(key=f"run[{index}].speed_rpm"),
                found=shown(run.speed, "rpm", ".1f"),
                allowed=", ".join(shown(own, "rpm", ".1f") for own in stored.speeds) + f" ± {ONE_SPEED:.0%}",
                remedy="run at a stored speed, or make trial runs at this one",
            )  # fmt: skip
        if not run.phases:
            raise InputError("stored coefficients need phases", place=Place(key=f"run[{index}]"),
                             remedy="add phase_deg to every reading")  # fmt: skip


@formula(
    "Imbalances by influence coefficients, over all speeds and sensors",
    "Σ|c_s·(X_s − ΣW_sp·Q_p)|² → min",
    "kg m",
    where=(
        "X_s − ΣW_sp·Q_p is the vibration that remains. c_s makes its displacement the quantity that the runs name: 1, "
        "Ω or Ω². If the runs name several quantities, velocities are compared. The trial runs of each speed give W_sp "
        "and the readings X_s without trial masses. With stored coefficients or data of the rig each run counts. With "
        "as many equations as planes nothing remains."
    ),
    source="Goodman 1964",
)
def solved(case: Balancing, method: Method, near: Solution | None = None) -> Solution:
    """The imbalances behind the runs; `near`: solution of nearly the same case.

    Raises NotTrustworthyError where the planes can hardly be told apart.
    """
    if method == "runs without phase":
        return _by_amplitudes(case, () if near is None else near.sensor_imbalances)
    return _by_trials(case) if method == "trial masses" else _by_known_influence(case, method)


def _by_trials(case: Balancing) -> Solution:
    matrices, equations = dict[int, Array](), []
    for group in case.speed_groups:
        runs = [case.runs[index] for index in group]
        trials = np.array([[*run.placed, 1.0] for run in runs], dtype=complex)
        motions = np.array([run.motion for run in runs])
        scale = np.abs(trials).max(axis=0)
        coefficients = np.linalg.lstsq(trials / scale, motions, rcond=None)[0] / scale[:, None]
        matrix, bare, largest = coefficients[:-1].T, coefficients[-1], float(np.abs(motions).max())
        _refuse_unseen(matrix, scale[:-1], largest, case)
        matrices.update(dict.fromkeys(group, matrix))
        equations.append((runs[0].speed, matrix, np.where(np.abs(bare) > TINY * largest, bare, 0.0)))
    influences = tuple(_matrix(matrices[index]) for index in range(len(case.runs)))
    return _solution(case, "trial masses", influences, equations)


def _by_amplitudes(case: Balancing, near: Sequence[complex]) -> Solution:
    """Solution without phase: the imbalance that each sensor tells makes up for the phases."""
    sets, equations = amplitude_sets(case), []
    imbalances = solved_without_phase(sets, near)
    gains, motions = (np.zeros((len(case.runs), len(case.runs[0].amplitudes)), kind) for kind in (float, complex))
    for each, Q in zip(sets, imbalances, strict=True):
        runs, gain = list(each.runs), each.gain(Q)
        gains[runs, each.sensor], motions[runs, each.sensor] = gain, each.motions(Q)
        equations.append((each.speed, np.array([[gain]]), np.array([gain * Q])))
    influences = tuple(_matrix(row[:, None] + 0j) for row in gains)
    solution = _solution(case, "runs without phase", influences, equations, motions.tolist())
    return replace(solution, sensor_imbalances=imbalances)


def _by_known_influence(case: Balancing, method: Method) -> Solution:
    """Solution by the rig's data, or by stored coefficients."""
    roll, stored = case.roll, case.coefficients
    if method == "rig data" and roll is not None:
        influences = tuple(influence(roll, run.speed) for run in case.runs)
    elif stored is not None:
        influences = tuple(stored.matrices[stored.at(run.set_speed) or 0] for run in case.runs)
    else:
        raise InputError("the influence of the planes is not known", place=Place(key="run"))
    equations = [
        (run.speed, np.array(rows), np.subtract(run.motion, motion_of(rows, run.placed)))
        for run, rows in zip(case.runs, influences, strict=True)
    ]
    return _solution(case, method, influences, equations)


def _refuse_unseen(matrix: Array, masses: Any, largest: float, case: Balancing) -> None:
    """Raise NotTrustworthyError for trial masses of two planes that change no reading."""
    seen = (np.abs(matrix) * masses).max(axis=0) / (largest or 1.0)
    if case.planes == 1 or not (seen <= TINY).any():
        return
    names = [name for name, share in zip(("left", "right"), seen, strict=True) if share <= TINY]
    raise NotTrustworthyError(
        f"the trial masses in the {' and the '.join(names)} plane do not change the readings.\n"
        "  Heavier trial masses, or another speed."
    )


def _least_squares(case: Balancing, equations: Sequence[Equation]) -> tuple[Array, float]:
    """Solution and condition number of W·Q = X over all equations."""
    matrix, motion = (np.concatenate([each[k] for each in equations]) for k in (1, 2))
    planes = matrix.shape[1]
    if len(matrix) < planes:
        raise InputError(
            "one sensor at one speed cannot distinguish two planes", place=Place(key="run"),
            found="1 reading in each run", allowed="two sensors, or two speeds", remedy="add a sensor",
        )  # fmt: skip
    if len(matrix) > planes:
        shown = np.concatenate([np.full(len(X), abs(reading_factor(case.quantity, at))) for at, _, X in equations])
        matrix, motion = matrix * shown[:, None], motion * shown
    condition = condition_number(_matrix(matrix))
    _refuse_singular(condition, said_of_resonance(case), planes)
    scale = np.abs(matrix).max()
    return np.linalg.lstsq(matrix / scale, motion / scale, rcond=None)[0], condition


def _matrix(values: Array) -> Matrix:
    return tuple(tuple(row) for row in values.tolist())


def _refuse_singular(condition: float, why: str = "", planes: int = 2) -> None:
    if planes == 1 and not condition < math.inf:
        raise NotTrustworthyError(
            "the trial mass does not change the readings.\n  A heavier trial mass, or another speed."
        )
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
    return f" The speed is {100 * near[0]:.2g} % off the natural frequency of {shown(near[1], 'hz', '.2f')}."


def _solution(
    case: Balancing, method: Method, influences: Sequence[Matrix], equations: Sequence[Equation],
    motions: Sequence[Sequence[complex]] | None = None,
) -> Solution:  # fmt: skip
    """`motions`: those of the runs, if their readings do not give them."""
    values, condition = _least_squares(case, equations)
    Q = tuple(complex(value) + 0.0 for value in values)
    misfits, shown = [], motions or [run.motion for run in case.runs]
    room = TINY * np.abs(shown).max()
    for run, matrix, own in zip(case.runs, influences, shown, strict=True):
        misfit = np.subtract(own, motion_of(matrix, tuple(np.add(Q, run.placed).tolist())))
        misfits.append(tuple(np.where(np.abs(misfit) > room, misfit, 0.0).tolist()))
    return Solution(method, Q, tuple(influences), tuple(misfits), condition)


def motion_of(matrix: Matrix, imbalance: Vector) -> Vector:
    """X = W·Q."""
    return tuple(sum((w * q for w, q in zip(row, imbalance, strict=True)), 0j) for row in matrix)
