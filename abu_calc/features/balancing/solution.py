"""Solution of a file of readings in SI: the correction, its possible error, and the imbalance that it leaves."""

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from abu_calc.features.balancing.case import Taken, balancing, deviations
from abu_calc.features.balancing.errors import (
    Deviations,
    ErrorContribution,
    MassShare,
    changes,
    correction,
    disagreement,
    motions,
    placing,
    size,
)
from abu_calc.features.balancing.formulas import Pair, Signed, influence, natural_frequencies, published_answer
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.features.balancing.two_planes import (
    Balancing,
    Method,
    Solution,
    method_of,
    motion_of,
    said_of_resonance,
    solved,
)
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.standards.vibration import permissible_imbalance

FARTHER: Final = 1.6
"""Multiple of the highest natural frequency: the speed tried if that of the runs is near one."""
HOPELESS: Final = 1.0
"""Vibration left, of that before, from which on the correction may do more harm than good: no number is given."""
Spread = Sequence[Pair]
"""Changes of both imbalances by one standard deviation of each number, the correction's among them."""


@dataclass(frozen=True)
class Found:
    """An answer; `rest`: imbalance expected to be left in each plane and the permitted one [kg m]; `rest_share`:
    vibration left, of that before.
    """

    case: Balancing
    sigma: Deviations
    solution: Solution
    by: Sequence[ErrorContribution]
    spread: Spread
    rest_share: float
    disagreement: float | None
    rest: Sequence[tuple[float, float | None]]
    service_speed: float
    bending_speed: float | None
    radii: tuple[float, float]
    shares: Sequence[Sequence[MassShare]]
    removable: float | None
    farther: tuple[float, float] | None
    """A speed farther from the natural frequencies that was tried [rad/s], and what would be left there."""
    printed: tuple[Signed, Signed] | None
    """Result of the formula as published for the first run without trial masses."""


def find(file: ReadingsFile, taken: Sequence[Taken]) -> Found:
    """The answer of a file. Raises InputError, and NotTrustworthyError where errors would be larger than it."""
    case, sigma = balancing(file, tuple(taken)), deviations(file.errors)
    answer = _answer(case, method_of(case), sigma)
    service, radii = _service_speed(file, case), _radii(file)
    permitted = _permitted(file, service)
    limit = _or_none(file.rotor.max_removable_g, "g")
    return Found(
        case=case,
        sigma=sigma,
        solution=answer.solution,
        by=answer.by,
        spread=answer.spread,
        rest_share=answer.rest_share,
        disagreement=disagreement(answer.solution, answer.by),
        rest=[(size(pair[plane] for pair in answer.spread), permitted[plane]) for plane in (0, 1)],
        service_speed=service,
        bending_speed=_or_none(file.rotor.first_bending_speed_rpm, "rpm"),
        radii=radii,
        shares=[_shares(file, plane, answer.solution.imbalance[plane], radii[plane], limit) for plane in (0, 1)],
        removable=limit,
        farther=_farther(case, answer.solution, sigma),
        printed=_printed(case, radii),
    )


@dataclass(frozen=True)
class _Answer:
    solution: Solution
    by: Sequence[ErrorContribution]
    spread: Spread
    rest_share: float


def _answer(case: Balancing, method: Method, sigma: Deviations) -> _Answer:
    """Answer by this method; by the rig's data if trial masses tell too little and these data are known."""
    try:
        solution = solved(case, method)
        by = changes(case, method, sigma)
        spread = [*(change.imbalance for change in by), *placing(solution.imbalance, sigma)]
        share = _rest_share(solution, spread)
        if share > HOPELESS:
            raise NotTrustworthyError(_hopeless(case, share))
    except NotTrustworthyError:
        if method == "rig data" or case.roll is None:
            raise
        return _answer(case, "rig data", sigma)
    return _Answer(solution, by, spread, share)


def _or_none(value: float | None, unit: str) -> float | None:
    return None if value is None else to_si(value, unit)


def _hopeless(case: Balancing, share: float) -> str:
    return (
        f"the errors given would leave {100 * share:.0f} % of the vibration after the correction: none can be trusted."
        f"{said_of_resonance(case)}\n  Another speed, smaller errors, or trial masses."
    )


def _rest_share(solution: Solution, spread: Spread) -> float:
    """Vibration that is left over that before, at the worst of the runs' speeds; 0 where there is none before."""
    shares = [0.0]
    for matrix in solution.influences:
        before = math.hypot(*map(abs, motion_of(matrix, solution.imbalance)))
        if before > 0:
            shares.append(math.hypot(*motions(matrix, spread)) / before)
    return max(shares)


def _farther(case: Balancing, solution: Solution, sigma: Deviations) -> tuple[float, float] | None:
    """The same imbalances read with the same errors at a speed farther from the natural frequencies."""
    if case.roll is None:
        return None
    speed = FARTHER * natural_frequencies(case.roll)[1]
    matrix = influence(case.roll, speed)
    motion = motion_of(matrix, solution.imbalance)
    amplitudes, phases = [abs(phasor) for phasor in motion], [-cmath.phase(phasor) for phasor in motion]
    run = replace(
        case.runs[0], speed=speed, quantity="displacement", sensor=0.0, weights=(),
        amplitudes=(amplitudes[0], amplitudes[1]), phases=(phases[0], phases[1]),
    )  # fmt: skip
    by = changes(replace(case, runs=(run,)), "rig data", sigma)
    there = replace(solution, influences=(matrix,))
    return speed, _rest_share(there, [*(change.imbalance for change in by), *placing(solution.imbalance, sigma)])


def _service_speed(file: ReadingsFile, case: Balancing) -> float:
    given = file.tolerance.service_speed_rpm
    return max(run.speed for run in case.runs) if given is None else to_si(given, "rpm")


def _permitted(file: ReadingsFile, speed: float) -> tuple[float | None, float | None]:
    """Permitted imbalance of each plane by the grade, shared by the place of the centre of mass.

    If that place is not known, each plane gets half.
    """
    grade, rotor = file.tolerance.balance_grade, file.rotor
    if grade is None or rotor.mass_kg is None:
        return None, None
    whole = permissible_imbalance(grade, rotor.mass_kg, speed)
    b, c = rotor.left_plane_to_centre_m, rotor.centre_to_right_plane_m
    share = 0.5 if b is None or c is None else c / (b + c)
    return share * whole, (1 - share) * whole


def _radii(file: ReadingsFile) -> tuple[float, float]:
    return to_si(file.rotor.left_correction_radius_mm, "mm"), to_si(file.rotor.right_correction_radius_mm, "mm")


def _shares(file: ReadingsFile, plane: int, Q: complex, radius: float, limit: float | None) -> tuple[MassShare, ...]:
    places = (file.rotor.left_places_deg, file.rotor.right_places_deg)[plane]
    turned = None if places is None else [math.radians(place) for place in places]
    return correction(abs(Q) / radius, -cmath.phase(Q), limit, turned)


def _printed(case: Balancing, radii: tuple[float, float]) -> tuple[Signed, Signed] | None:
    run = next((run for run in case.runs if not run.weights), None)
    if case.roll is None or run is None:
        return None
    return published_answer(case.roll, run.speed, run.readings, radii)
