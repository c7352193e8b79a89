"""Possible error of a two-plane answer, and corrections in a plane as masses at places.

Each input number is moved by its standard deviation:

    Δ_i = (answer(p_i + σ_i) − answer(p_i − σ_i))/2,    variance Σ Δ_i²

The errors of all numbers are independent. A correction removes metal at the heavy spot, or adds it opposite, or is
split over given places.
"""

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Final, Literal

from abu_calc.features.balancing.formulas import Matrix, Pair
from abu_calc.features.balancing.two_planes import Balancing, Method, RunOnRig, Solution, TrialMass, motion_of, solved
from abu_calc.foundation.frozen import dataclass

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
class ErrorContribution:
    """Change of the answer by one standard deviation of one number, and its cause.

    It holds imbalances [kg m] and misfits of the runs [m].
    """

    cause: str
    imbalance: Pair
    misfits: tuple[Pair, ...]


def changes(case: Balancing, method: Method, sigma: Deviations) -> list[ErrorContribution]:
    """One for each number that went in."""
    variations, base = [], solved(case, method)
    for cause, up, down in _varied(case, method, sigma):
        high, low = solved(up, method), base if down is None else solved(down, method)
        variations.append(_change(cause, high, low, 1.0 if down is None else 2.0))
    return variations


def _change(cause: str, high: Solution, low: Solution, steps: float) -> ErrorContribution:
    def half(upper: Pair, other: Pair) -> Pair:
        return (upper[0] - other[0]) / steps, (upper[1] - other[1]) / steps

    misfits = tuple(half(misfit, other) for misfit, other in zip(high.misfits, low.misfits, strict=True))
    return ErrorContribution(cause, half(high.imbalance, low.imbalance), misfits)


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


def _heavier(weight: TrialMass, sigma: Deviations) -> list[TrialMass]:
    return [replace(weight, mass=weight.mass * (1 + s * sigma.placed_mass)) for s in (1, -1)]


def _turned(weight: TrialMass, sigma: Deviations) -> list[TrialMass]:
    return [replace(weight, angle=weight.angle + s * sigma.placed_angle) for s in (1, -1)]


def _with_weight(run: RunOnRig, index: int, weight: TrialMass) -> RunOnRig:
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


def disagreement(solution: Solution, by: Sequence[ErrorContribution]) -> float | None:
    """The largest misfit over its standard deviation; None where the runs have nothing to disagree about."""
    sizes = []
    for index, pair in enumerate(solution.misfits):
        for k in (0, 1):
            expected = size(change.misfits[index][k] for change in by)
            scale = max(abs(made) for made in motion_of(solution.influences[index], solution.imbalance))
            if expected > 1e-9 * scale:
                sizes.append(abs(pair[k]) / expected)
    return max(sizes, default=None)


Action = Literal["remove", "add"]

NOTHING: Final = 1e-9
"""Part of the whole below which a share is none."""


@dataclass(frozen=True)
class MassShare:
    """A mass [kg] to take off or put on at an angle behind the mark [rad]."""

    action: Action
    mass: float
    angle: float


def correction(
    mass: float, angle: float, removable: float | None, places: Sequence[float] | None
) -> tuple[MassShare, ...]:
    """The shares that balance a heavy spot of this mass at this angle.

    Metal is taken off where there is enough (`removable`, of the plane), else put on opposite. With places, two of them
    carry it: the pair that takes off no more than may be, puts on as little as may be, and takes the least in all.
    """
    if mass == 0:
        return ()
    if places is None:
        if removable is None or mass <= removable:
            return (MassShare("remove", mass, turned(angle)),)
        return (MassShare("add", mass, turned(angle + math.pi)),)
    options = [split for pair in combinations(places, 2) if (split := _split(mass, angle, *pair)) is not None]

    def worth(shares: tuple[MassShare, ...]) -> tuple[bool, bool, float]:
        off = removed(shares)
        return (
            removable is not None and off > removable,
            off < sum(share.mass for share in shares),
            sum(share.mass for share in shares),
        )

    return min(options, key=worth)


def turned(angle: float) -> float:
    """An angle from 0 to 2π, the latter not reached.

    >>> turned(-1e-70), turned(7.0) < 1
    (0.0, True)
    """
    remainder = angle % math.tau
    return 0.0 if remainder == math.tau else remainder


def removed(shares: Sequence[MassShare]) -> float:
    """Mass that is taken off in all [kg]."""
    return sum(share.mass for share in shares if share.action == "remove")


def _split(mass: float, angle: float, first: float, second: float) -> tuple[MassShare, ...] | None:
    """m1·e^{iψ1} + m2·e^{iψ2} = m·e^{iφ}; what comes out negative is put on. None for places on one line."""
    across = math.sin(second - first)
    if abs(across) < NOTHING:
        return None
    parts = mass * math.sin(second - angle) / across, mass * math.sin(angle - first) / across
    shares = [
        MassShare("remove" if part > 0 else "add", abs(part), turned(place))
        for part, place in zip(parts, (first, second), strict=True)
        if abs(part) > NOTHING * mass
    ]
    return tuple(shares)


def total(shares: Sequence[MassShare]) -> complex:
    """Sum of the masses that the shares remove, as mass·e^{iψ} [kg].

    Removed metal counts where it was, added metal opposite.
    """
    return sum(((1 if share.action == "remove" else -1) * cmath.rect(share.mass, share.angle) for share in shares), 0j)
