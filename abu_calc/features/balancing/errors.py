"""Possible error of an answer.

Each input number is moved by its standard deviation:

    Δ_i = (answer(p_i + σ_i) − answer(p_i − σ_i))/2,    variance Σ Δ_i²

The errors of all numbers are independent.
"""

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np

from abu_calc.features.balancing.formulas import Matrix, Vector, reading_factor
from abu_calc.features.balancing.methods import Array, Method, Solution, motion_of, solved
from abu_calc.features.balancing.run_tables import Errors
from abu_calc.features.balancing.runs import Balancing, Coefficients, Floats, RunOnRig
from abu_calc.foundation.frozen import dataclass

LENGTHS: Final = ("a", "b", "c", "d")
ROUNDING: Final = 1e-9
"""Part of an imbalance, or of a motion, that only rounding leaves."""
UNKNOWN: Final = math.pi
"""The standard deviation of an angle that nothing tells."""


@dataclass(frozen=True)
class ErrorContribution:
    """Change of the answer by one standard deviation of one number, and its cause.

    It holds imbalances [kg m], misfits of the runs [m] and influences of the planes at the runs [m per kg m].
    """

    cause: str
    imbalance: Vector
    misfits: tuple[Vector, ...]
    influences: tuple[Matrix, ...] = ()


def changes(case: Balancing, method: Method, sigma: Errors) -> list[ErrorContribution]:
    """One for each number that went in."""
    variations, base = [], solved(case, method)
    for cause, up, down in _varied(case, method, sigma):
        high, low = solved(up, method, base), base if down is None else solved(down, method, base)
        variations.append(_change(cause, high, low, 1.0 if down is None else 2.0))
    return variations


def _change(cause: str, high: Solution, low: Solution, steps: float) -> ErrorContribution:
    names = ("imbalance", "misfits", "influences")
    halves = (np.subtract(getattr(high, name), getattr(low, name)) / steps for name in names)
    return ErrorContribution(cause, *(half.tolist() for half in halves))


Varied = Iterator[tuple[str, Balancing, Balancing | None]]


def _varied(case: Balancing, method: Method, sigma: Errors) -> Varied:
    """The case with one number up and down; down None where the number may not fall so far."""
    for index, run in enumerate(case.runs):
        least = case.least(index) * abs(reading_factor(run.quantity, run.speed))
        for cause, up, down in _runs(run, sigma, least):
            yield cause, _with_run(case, index, up), _with_run(case, index, down)
    if method == "rig data" and case.roll is not None:
        yield from _rigs(case, sigma)
    if method == "stored coefficients" and case.coefficients is not None:
        yield from _coefficients(case, case.coefficients, sigma)


def _runs(run: RunOnRig, sigma: Errors, least: float) -> Iterator[tuple[str, RunOnRig, RunOnRig]]:
    """`least`: reading (SI) below which errors are those of a reading of this size."""

    def both(cause: str, moved: Callable[[float], RunOnRig]) -> tuple[str, RunOnRig, RunOnRig]:
        return cause, moved(1.0), moved(-1.0)

    for k, (peak, noise) in enumerate(zip(run.amplitudes, run.errors, strict=True)):
        arm = max(peak, least)
        size = math.hypot(arm * sigma.amplitude, noise)
        yield both("readings", lambda s, k=k, size=size: _with_reading(run, k, s * size))  # type: ignore[misc]
        if run.phases:
            turn = math.hypot(sigma.phase, noise / arm if arm else 0.0)
            yield both(
                "readings",
                lambda s, k=k, arm=arm, turn=turn: _with_reading(run, k, cmath.rect(arm, s * turn) - arm),  # type: ignore[misc]
            )
    if run.phases:
        shift = run.unsure / math.sqrt(3)
        yield both("readings", lambda s: replace(run, phases=tuple(phase + s * shift for phase in run.phases)))
    yield both("speed", lambda s: replace(run, speed=run.speed * (1 + s * sigma.speed), read_speed=run.set_speed))
    for index, weight in enumerate(run.weights):
        heavier = [replace(weight, mass=weight.mass * (1 + s * sigma.placed_mass)) for s in (1, -1)]
        turned = [replace(weight, angle=weight.angle + s * sigma.placed_angle) for s in (1, -1)]
        for moved in (heavier, turned):
            high, low = (
                replace(run, weights=(*run.weights[:index], each, *run.weights[index + 1 :])) for each in moved
            )
            yield "trial masses", high, low


def _with_reading(run: RunOnRig, sensor: int, change: complex) -> RunOnRig:
    """A run with the phasor of a reading moved; `change`: real along it, imaginary across it, toward smaller phases."""
    amplitudes, phases = list(run.amplitudes), list(run.phases)
    if change.imag:
        amplitudes[sensor], turn = cmath.polar(amplitudes[sensor] + change)
        phases[sensor] -= turn
    else:
        amplitudes[sensor] += change.real
    return replace(run, amplitudes=tuple(amplitudes), phases=tuple(phases))


def _with_run(case: Balancing, index: int, run: RunOnRig) -> Balancing:
    return replace(case, runs=(*case.runs[:index], run, *case.runs[index + 1 :]))


def _rigs(case: Balancing, sigma: Errors) -> Varied:
    roll = case.roll
    if roll is None:
        return
    relative = {
        "M1": sigma.support_mass, "M2": sigma.support_mass, "C1": sigma.stiffness, "C2": sigma.stiffness,
        "M3": sigma.rotor_mass, "J3": sigma.inertia,
    }  # fmt: skip
    steps = {name: getattr(roll, name) * share for name, share in relative.items()}
    steps |= {"damping_ratio": sigma.damping_ratio, **dict.fromkeys(LENGTHS, sigma.length)}
    for name, step in steps.items():
        value = getattr(roll, name)
        up = replace(case, roll=replace(roll, **{name: value + step}))
        down = replace(case, roll=replace(roll, **{name: value - step})) if value > step else None
        yield "rig data", up, down


def _coefficients(case: Balancing, stored: Coefficients, sigma: Errors) -> Varied:
    """Each coefficient along and across itself, by its own error and by the difference of rotors of a kind."""
    for number, (matrix, errors) in enumerate(zip(stored.matrices, stored.errors, strict=True)):
        for i, row in enumerate(matrix):
            for k, value in enumerate(row):
                size = math.hypot(errors[i][k], sigma.coefficient * abs(value) / math.sqrt(2))
                for step in (size, 1j * size):
                    up, down = (
                        replace(case, coefficients=_with_coefficient(stored, number, i, k, sign * step))
                        for sign in (1, -1)
                    )
                    yield "stored coefficients", up, down


def _with_coefficient(stored: Coefficients, number: int, row: int, column: int, change: complex) -> Coefficients:
    values = [[list(each) for each in matrix] for matrix in stored.matrices]
    values[number][row][column] += change
    return replace(stored, matrices=tuple(tuple(tuple(each) for each in matrix) for matrix in values))


def placing(pieces: Sequence[Vector], sigma: Errors) -> list[Vector]:
    """Residual imbalances by errors of the correction itself, one standard deviation each.

    `pieces`: imbalance of each mass of each plane [kg m]. Masses that nearly cancel leave the errors of all.
    """
    planes = range(len(pieces))
    return [
        tuple(piece * step if k == plane else 0j for k in planes)
        for plane in planes
        for piece in pieces[plane]
        for step in (sigma.placed_mass, 1j * sigma.placed_angle)
    ]


def radial(imbalance: complex, deltas: Iterable[complex]) -> float:
    """Standard deviation of the size [kg m]; of one that is zero, of its place."""
    if imbalance == 0:
        return size(deltas)
    return math.sqrt(sum(((each * imbalance.conjugate()).real / abs(imbalance)) ** 2 for each in deltas))


def angular(imbalance: complex, deltas: Iterable[complex]) -> float:
    """Standard deviation of the angle [rad], at most UNKNOWN."""
    if imbalance == 0:
        return UNKNOWN
    across = math.sqrt(sum(((each * imbalance.conjugate()).imag / abs(imbalance)) ** 2 for each in deltas))
    return across / abs(imbalance) if across < abs(imbalance) else UNKNOWN


def size(deltas: Iterable[complex]) -> float:
    """√Σ|Δ|²."""
    return math.sqrt(sum(abs(each) ** 2 for each in deltas))


@dataclass(frozen=True)
class Remainder:
    """Motions of the sensors at a speed [m]: `now` as read without trial masses; after the correction the part that
    the planes cannot take away, the part that limits and stock leave, the rms by which it may differ from these, and
    the rms that errors of the masses leave. `scale`: the quantity that is compared over the displacement.
    """

    speed: float
    scale: float
    now: Array
    planes: Array
    leftover: Array
    errors: Floats
    unsure: Floats

    @property
    def after(self) -> Array:
        """Motions expected without errors."""
        return self.planes + self.leftover

    @property
    def expected(self) -> Floats:
        """Amplitudes expected with errors, rms."""
        return np.hypot(np.abs(self.after), self.errors)

    @property
    def at_most(self) -> Floats:
        """Amplitudes that are exceeded less than once in twenty: errors exceed twice their rms more rarely."""
        return np.asarray(np.abs(self.planes) + 2 * np.hypot(np.abs(self.leftover), self.errors))


def remainders(
    case: Balancing, solution: Solution, by: Sequence[ErrorContribution], placed: Sequence[Vector], leftover: Vector
) -> tuple[Remainder, ...]:
    """One for each speed; `placed`: imbalances that errors of the correction leave.

    An error moves what remains as it moves readings and influences: by W·ΔQ and by the change of the misfit.
    """
    made = []
    for group in case.speed_groups:
        bare = [index for index in group if not any(case.runs[index].placed)] or list(group)
        matrix = np.mean([solution.influences[index] for index in bare], axis=0)

        def misfit(misfits: Sequence[Vector], bare: Sequence[int] = bare) -> Array:
            return np.asarray(np.mean([misfits[index] for index in bare], axis=0))

        planes, made_now = misfit(solution.misfits), matrix @ solution.imbalance
        room = ROUNDING * case.least(group[0])
        planes, now = (np.where(np.abs(each) > room, each, 0.0) for each in (planes, made_now + planes))
        wrong = np.array([matrix @ each for each in (*(change.imbalance for change in by), *placed)])
        moved = [*(misfit(change.misfits) for change in by), *(np.zeros_like(now) for _ in placed)]
        errors, unsure = np.linalg.norm(wrong + moved, axis=0), np.linalg.norm(wrong, axis=0)
        speed = case.runs[bare[0]].speed
        scale = abs(reading_factor(case.quantity, speed))
        made.append(Remainder(speed, scale, now, planes, matrix @ leftover, errors, unsure))
    return tuple(made)


def of_planes(case: Balancing, solution: Solution, misfits: Sequence[Vector], *, all_speeds: bool = False) -> Array:
    """Part of the misfits that further planes could take away: that of the mean of the runs of a speed which no
    imbalance of the planes makes at this speed, or, `all_speeds`, the whole mean.
    """
    part = np.zeros((len(misfits), len(misfits[0])), complex)
    for group in map(list, case.speed_groups):
        matrix, mean = np.array(solution.influences[group[0]]), np.mean([misfits[index] for index in group], axis=0)
        part[group] = mean if all_speeds else mean - matrix @ (np.linalg.pinv(matrix) @ mean)
    return part


def in_deviations(
    solution: Solution, by: Sequence[ErrorContribution], part: Callable[[Sequence[Vector]], Array]
) -> float | None:
    """The largest misfit, or part of one, over its standard deviation; None where nothing can differ."""
    sizes, changes = [], [part(change.misfits) for change in by]
    for index, own in enumerate(part(solution.misfits)):
        scale = max(abs(made) for made in motion_of(solution.influences[index], solution.imbalance))
        for k, misfit in enumerate(own):
            expected = size(change[index][k] for change in changes)
            if expected > ROUNDING * scale:
                sizes.append(float(abs(misfit)) / expected)
    return max(sizes, default=None)
