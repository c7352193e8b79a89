"""Possible error of a two-plane answer: each input number is moved by its standard deviation.

Δ_i = (answer(p_i + σ_i) − answer(p_i − σ_i))/2, variance Σ Δ_i²; the errors of all numbers are
independent
"""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.analysis.two_planes import Balancing, Method, RunOnRig, Solution, Weight, motion_of, solved
from abu_calc.formulas.two_planes import Matrix, Pair
from abu_calc.frozen import dataclass

LENGTHS: Final = ("a", "b", "c", "d")
UNKNOWN: Final = math.pi
"""The standard deviation of an angle that nothing tells."""


@dataclass(frozen=True)
class Deviations:
    """Standard deviations: relative ones of amplitudes, speed, masses and so on; phase, damping ratio, lengths [m] and
    angles [rad] as they are.
    """

    amplitude: float
    phase: float
    speed: float
    support_mass: float
    stiffness: float
    damping_ratio: float
    rotor_mass: float
    inertia: float
    length: float
    placed_mass: float
    placed_angle: float


@dataclass(frozen=True)
class Change:
    """Change of the answer by one standard deviation of one number, and its cause.

    It holds imbalances [kg m] and misfits of the runs [m].
    """

    cause: str
    imbalance: Pair
    misfits: tuple[Pair, ...]


def changes(case: Balancing, method: Method, sigma: Deviations) -> list[Change]:
    """One for each number that went in."""
    variations, base = [], solved(case, method)
    for cause, up, down in _varied(case, method, sigma):
        high, low = solved(up, method), base if down is None else solved(down, method)
        variations.append(_change(cause, high, low, 1.0 if down is None else 2.0))
    return variations


def _change(cause: str, high: Solution, low: Solution, steps: float) -> Change:
    def half(upper: Pair, other: Pair) -> Pair:
        return (upper[0] - other[0]) / steps, (upper[1] - other[1]) / steps

    misfits = tuple(half(misfit, other) for misfit, other in zip(high.misfits, low.misfits, strict=True))
    return Change(cause, half(high.imbalance, low.imbalance), misfits)


Varied = Iterator[tuple[str, Balancing, Balancing | None]]


def _varied(case: Balancing, method: Method, sigma: Deviations) -> Varied:
    """The case with one number up and down; down None where the number may not fall so far."""
    for index, run in enumerate(case.runs):
        for cause, up, down in _runs(run, sigma):
            yield cause, _with_run(case, index, up), _with_run(case, index, down)
    if method == "rig data" and case.roll is not None:
        yield from _rigs(case, sigma)


def _runs(run: RunOnRig, sigma: Deviations) -> Iterator[tuple[str, RunOnRig, RunOnRig]]:
    (A, B), (alpha, beta) = run.amplitudes, run.phases
    dA, dB = (math.hypot(peak * sigma.amplitude, noise) for peak, noise in zip(run.amplitudes, run.noise, strict=True))
    turn = [
        math.hypot(sigma.phase, noise / peak if peak else 0.0)
        for peak, noise in zip(run.amplitudes, run.noise, strict=True)
    ]
    shift = run.unsure / math.sqrt(3)

    def both(cause: str, moved: Callable[[float], RunOnRig]) -> tuple[str, RunOnRig, RunOnRig]:
        return cause, moved(1.0), moved(-1.0)

    yield both("readings", lambda s: replace(run, amplitudes=(A + s * dA, B)))
    yield both("readings", lambda s: replace(run, amplitudes=(A, B + s * dB)))
    yield both("readings", lambda s: replace(run, phases=(alpha + s * turn[0], beta)))
    yield both("readings", lambda s: replace(run, phases=(alpha, beta + s * turn[1])))
    yield both("readings", lambda s: replace(run, phases=(alpha + s * shift, beta + s * shift)))
    yield both("speed", lambda s: replace(run, speed=run.speed * (1 + s * sigma.speed)))
    for index, weight in enumerate(run.weights):
        for moved in (_heavier(weight, sigma), _turned(weight, sigma)):
            high, low = (_with_weight(run, index, trial_mass) for trial_mass in moved)
            yield "trial masses", high, low


def _heavier(weight: Weight, sigma: Deviations) -> list[Weight]:
    return [replace(weight, mass=weight.mass * (1 + s * sigma.placed_mass)) for s in (1, -1)]


def _turned(weight: Weight, sigma: Deviations) -> list[Weight]:
    return [replace(weight, angle=weight.angle + s * sigma.placed_angle) for s in (1, -1)]


def _with_weight(run: RunOnRig, index: int, weight: Weight) -> RunOnRig:
    return replace(run, weights=(*run.weights[:index], weight, *run.weights[index + 1 :]))


def _with_run(case: Balancing, index: int, run: RunOnRig) -> Balancing:
    return replace(case, runs=(*case.runs[:index], run, *case.runs[index + 1 :]))


def _rigs(case: Balancing, sigma: Deviations) -> Varied:
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


def placing(imbalance: Pair, sigma: Deviations) -> list[Pair]:
    """Residual imbalances by errors of the correction itself, one standard deviation each."""
    left, right = imbalance
    return [
        (left * sigma.placed_mass, 0j), (left * 1j * sigma.placed_angle, 0j),
        (0j, right * sigma.placed_mass), (0j, right * 1j * sigma.placed_angle),
    ]  # fmt: skip


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


def motions(matrix: Matrix, deltas: Iterable[Pair]) -> tuple[float, float]:
    """Amplitudes (rms over the errors) of both sensors that imbalances of this size leave [m]."""
    made = [motion_of(matrix, each) for each in deltas]
    return size(first for first, _ in made), size(other for _, other in made)


def disagreement(solution: Solution, by: Sequence[Change]) -> float | None:
    """The largest misfit over its standard deviation; None where the runs have nothing to disagree about."""
    sizes = []
    for index, pair in enumerate(solution.misfits):
        for k in (0, 1):
            expected = size(change.misfits[index][k] for change in by)
            scale = max(abs(made) for made in motion_of(solution.influences[index], solution.imbalance))
            if expected > 1e-9 * scale:
                sizes.append(abs(pair[k]) / expected)
    return max(sizes, default=None)
