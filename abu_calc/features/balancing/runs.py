"""Runs in SI: what the sensors read, and the masses that were on.

Imbalances and motions are complex numbers, as in formulas.py beside it. All runs of a file have the same sensors.

Balancing of one plane from amplitudes alone: four runs or more, three of them with trial masses.

Every amplitude is proportional to the imbalance that is on: A_k = g·|Q + T|, with one gain g and one imbalance Q for
each sensor and speed. The squares are linear in g², g²·Q and g²·|Q|², which gives a start; Newton steps on the
amplitudes follow.
"""

import cmath
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.balancing.formulas import Matrix, RollOnRig, Vector, displacement
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass

ONE_SPEED: Final = 0.01
"""Relative difference of speeds up to which influence coefficients are one set."""
SEEN: Final = 0.1
"""Part of the largest reading at a speed below which a reading is too small to be a measure.

Smaller readings have the errors of one of this size.
"""


@dataclass(frozen=True)
class TrialMass:
    """A mass that was on: plane (0 left or single, 1 right), mass [kg], radius [m], angle behind the mark [rad]."""

    plane: int
    mass: float
    radius: float
    angle: float

    @property
    def imbalance(self) -> complex:
        """Imbalance as a complex number [kg m]."""
        return self.mass * self.radius * cmath.exp(-1j * self.angle)


def imbalance_of(masses: tuple[TrialMass, ...], planes: int) -> Vector:
    """Imbalance of masses in each plane [kg m]."""
    return tuple(sum((mass.imbalance for mass in masses if mass.plane == k), 0j) for k in range(planes))


@dataclass(frozen=True)
class RunOnRig:
    """Readings of a run: speed [rad/s], amplitudes (SI) and phases [rad] of its sensors, by the mark's sensor, which
    stands `sensor` [rad] from them in the sense of rotation; the masses that were on. No phases: amplitudes alone.
    """

    speed: float
    quantity: str
    amplitudes: tuple[float, ...]
    phases: tuple[float, ...]
    sensor: float = 0.0
    weights: tuple[TrialMass, ...] = ()
    noise: tuple[float, ...] = ()
    """Standard errors of the amplitudes that a record shows of itself (SI)."""
    unsure: float = 0.0
    """Most that all phases of a record may be off together [rad]."""
    planes: int = 2
    """Number of correction planes."""
    read_speed: float | None = None
    """Speed that decides to which set of coefficients the run belongs [rad/s], if its speed is varied."""

    @property
    def set_speed(self) -> float:
        """Speed by which the run belongs to a set of coefficients [rad/s]: an error of the speed changes no set."""
        return self.speed if self.read_speed is None else self.read_speed

    @property
    def motion(self) -> Vector:
        """Displacements by the passage of the mark at the vibration sensors [m]; without phases their amplitudes."""
        phases = self.phases or (0.0,) * len(self.amplitudes)
        quantity = self.quantity if self.phases else "displacement"
        scale = 1.0 if self.phases else abs(displacement(self.quantity, 1.0, 0.0, self.speed))
        return tuple(
            displacement(quantity, amplitude * scale, phase + (self.sensor if self.phases else 0.0), self.speed)
            for amplitude, phase in zip(self.amplitudes, phases, strict=True)
        )

    @property
    def readings(self) -> Vector:
        """The same as if every reading were a displacement, as the published formula takes it."""
        return tuple(
            displacement("displacement", amplitude, phase + self.sensor, self.speed)
            for amplitude, phase in zip(self.amplitudes, self.phases, strict=True)
        )

    @property
    def errors(self) -> tuple[float, ...]:
        """Standard errors of the amplitudes that a record shows (SI); zero without a record."""
        return self.noise or (0.0,) * len(self.amplitudes)

    @property
    def placed(self) -> Vector:
        """Imbalance of the masses that were on, of each plane [kg m]."""
        return imbalance_of(self.weights, self.planes)


@dataclass(frozen=True)
class Coefficients:
    """Influence coefficients at some speeds [m per kg m], with a standard error of each."""

    speeds: tuple[float, ...]
    matrices: tuple[Matrix, ...]
    errors: tuple[tuple[tuple[float, ...], ...], ...]

    def at(self, speed: float) -> int | None:
        """Place of the set at a speed; None if there is none."""
        near = [k for k, own in enumerate(self.speeds) if abs(speed / own - 1) <= ONE_SPEED]
        return min(near, key=lambda k: abs(speed / self.speeds[k] - 1)) if near else None


@dataclass(frozen=True)
class Balancing:
    """Data from which an answer is computed."""

    roll: RollOnRig | None
    runs: tuple[RunOnRig, ...]
    coefficients: Coefficients | None = None

    @property
    def planes(self) -> int:
        """Number of correction planes."""
        return self.runs[0].planes

    @property
    def quantity(self) -> str:
        """Quantity in which the vibration of all sensors is compared: that of the runs, velocity if they differ."""
        named = {run.quantity for run in self.runs}
        return named.pop() if len(named) == 1 else "velocity"

    @property
    def overdetermined(self) -> bool:
        """Tell whether the sensors at all speeds are more than the planes."""
        return len(self.speed_groups) * len(self.runs[0].amplitudes) > self.planes

    def least(self, index: int) -> float:
        """Displacement below which readings of a run are too small to be a measure [m]."""
        (group,) = (group for group in self.speed_groups if index in group)
        return SEEN * max(abs(phasor) for own in group for phasor in self.runs[own].motion)

    @property
    def speed_groups(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the runs at each speed, in the order of their first runs."""
        groups: list[list[int]] = []
        for index, run in enumerate(self.runs):
            for group in groups:
                if abs(run.set_speed / self.runs[group[0]].set_speed - 1) <= ONE_SPEED:
                    group.append(index)
                    break
            else:
                groups.append([index])
        return tuple(map(tuple, groups))


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
class AmplitudeSet:
    """Amplitudes of a sensor in the runs of one speed [m], and the masses that were on [kg m]."""

    speed: float
    runs: tuple[int, ...]
    sensor: int
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

    def gain(self, Q: complex) -> float:
        """Gain by least squares at a given imbalance [m per kg m]."""
        sizes = np.abs(Q + self.placed)
        return float(sizes @ self.amplitudes / (sizes @ sizes or 1.0))

    def motions(self, Q: complex) -> Complexes:
        """Amplitudes with the directions of the imbalances that are on."""
        return np.asarray(self.amplitudes * np.exp(1j * np.angle(Q + self.placed)))


def amplitude_sets(case: Balancing) -> list[AmplitudeSet]:
    """One for each sensor at each speed."""
    made = []
    for group in case.speed_groups:
        runs = [case.runs[index] for index in group]
        placed = np.array([run.placed[0] for run in runs])
        for sensor, readings in enumerate(zip(*(run.motion for run in runs), strict=True)):
            made.append(AmplitudeSet(runs[0].speed, group, sensor, placed, np.abs(readings)))
    return made


def tells_without_phase(case: Balancing) -> None:
    """Refuse runs whose masses leave two solutions."""
    if case.planes != 1:
        raise InputError("without phase one plane can be balanced, not two", place=Place(key="run"),
                         remedy="add phase_deg = …, or [single_plane]")  # fmt: skip
    sets = amplitude_sets(case)
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
        "squares of the amplitudes of each sensor give its result. Four runs are needed: three leave two solutions. No "
        "solution is unique if zero and all T_trial lie on one line or on one circle."
    ),
    source="the circles of the four-run method as equations",
)
def solved_without_phase(sets: Sequence[AmplitudeSet], near: Sequence[complex] = ()) -> tuple[complex, ...]:
    """Imbalance that each sensor tells at each speed [kg m]; at a speed of too few runs that of another speed.

    `near`: solution of nearly the same case, from which the search starts.
    """
    told = dict[int, complex]()
    for index, each in enumerate(sets):
        starts = [near[index]] if near else [start for start in _starts(each) if np.isfinite(start)]
        if starts and each.apart > TELLS:
            fits = [_refined(each, start) for start in starts]
            told[index] = min(fits, key=lambda Q: float(np.sum(_residuals(each, Q) ** 2)))
    if not told:
        raise NotTrustworthyError(
            "the trial masses do not change the readings, so that their gain is not known.\n  Heavier trial masses."
        )
    alike = {sets[index].sensor: Q for index, Q in told.items()}
    other = next(iter(told.values()))
    return tuple(told.get(index, alike.get(each.sensor, other)) for index, each in enumerate(sets))


def _starts(each: AmplitudeSet) -> Iterator[complex]:
    """Solution of the linear equations.

    Noise may lead the start to the other side of the circle of the trial masses, so its image in it is one, too.
    """
    _, along, across, gain = np.linalg.lstsq(each.terms, each.amplitudes**2, rcond=None)[0]
    if gain > 0:
        start = complex(along, across) / gain * each.scale
        yield start
        if start:
            yield each.scale**2 / start.conjugate()


def _residuals(each: AmplitudeSet, Q: complex) -> Floats:
    """Misfits of the amplitudes over their largest."""
    off = each.amplitudes - each.gain(Q) * np.abs(Q + each.placed)
    return np.asarray(off / (each.amplitudes.max() or 1.0))


def _refined(each: AmplitudeSet, start: complex) -> complex:
    """Imbalance with the least squares of misfits, by damped Gauss–Newton steps from a start."""
    Q, damping = start, 0.0
    scale = max(abs(start), each.scale)
    residuals = _residuals(each, Q)
    for _ in range(STEPS):
        step = 1e-6 * scale
        columns = np.column_stack([
            (_residuals(each, Q + turn * step) - _residuals(each, Q - turn * step)) / (2 * step) for turn in (1, 1j)
        ])  # fmt: skip
        normal = columns.T @ columns
        change = np.linalg.lstsq(normal + damping * np.diag(np.diag(normal)), -columns.T @ residuals, rcond=None)[0]
        moved = Q + complex(change[0], change[1])
        after = _residuals(each, moved)
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
