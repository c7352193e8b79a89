"""Solution of a file of readings in SI: the correction, its possible error, and the imbalance that it leaves."""

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Final

import numpy as np

from abu_calc.features.balancing.case import RunReadings, balancing, behind_the_mark, making_of, mass_of
from abu_calc.features.balancing.corrections import Making, Share, correction, total, turned
from abu_calc.features.balancing.errors import (
    ROUNDING,
    ErrorContribution,
    Remainder,
    angular,
    changes,
    in_deviations,
    of_planes,
    placing,
    radial,
    remainders,
    size,
)
from abu_calc.features.balancing.formulas import Signed, Vector, influence, natural_frequencies, published_answer
from abu_calc.features.balancing.methods import Array, Method, Solution, method_of, motion_of, said_of_resonance, solved
from abu_calc.features.balancing.run_tables import Errors
from abu_calc.features.balancing.runs import SEEN, Balancing, Coefficients, Floats, TrialMass, imbalance_of
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.features.balancing.tolerance import TolerancePlanes, ToleranceResult, tolerance_of
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record

FARTHER: Final = 1.6
"""Multiple of the highest natural frequency: the speed tried if that of the runs is near one."""
HOPELESS: Final = 1.0
"""Vibration left, of that before, from which on the correction may do more harm than good: no number is given."""
BEYOND_ERRORS: Final = 3.0
"""Misfit in standard deviations beyond which errors do not explain it."""
FINE: Final = 0.1
"""Error of an imbalance over the trial mass, or of what it moves over the vibration now, up to which the imbalance is
measured well.
"""
MUCH: Final = 10.0
"""Such a part whose size is of no interest."""
Spread = Sequence[Vector]
"""Changes of the imbalances by one standard deviation of each number, those of the correction itself among them."""


@record
class PlaneCorrection(Record):
    """One plane: its heavy spot and its correction. Angles count from the zero mark, 0 … 360."""

    mass: Annotated[float, Quantity("mass of the heavy spot", "m_j", 4, "at the correction radius", unit="g")]
    angle: Annotated[float, Quantity("heavy spot at", "φ_j", 5, "from the zero mark, against rotation", unit="deg")]
    mass_uncertainty: Annotated[float, Quantity("uncertainty of the mass", "", 2, "one standard deviation", unit="g")]
    angle_uncertainty: Annotated[
        float, Quantity("uncertainty of the angle", "", 2, "one standard deviation; 180: not known", unit="deg")
    ]
    remove_at: Annotated[
        float, Quantity("remove at", "", 5, "the heavy spot by the angle marks of the rotor", unit="deg")
    ]
    add_at: Annotated[float, Quantity("or add at", "", 5, "opposite, by the angle marks of the rotor", unit="deg")]
    corrections: tuple[Share, ...]
    """Corrections to make, by the metal and the places there are."""
    imbalance: Annotated[float, Quantity("imbalance", "|Q|", 4, "that the correction takes away", unit="g_mm")]
    permitted: Annotated[
        float | None,
        Quantity("permitted imbalance", "U_per", 4, "of the tolerance plane on this side", unit="g_mm"),
    ]
    rest: Annotated[float, Quantity("imbalance to be expected after it", "", 2, "rms over the errors", unit="g_mm")]
    rest_at_most: Annotated[
        float,
        Quantity("imbalance after it, at most", "", 2, "twice that: exceeded less than once in twenty", unit="g_mm"),
    ]
    leftover: Annotated[
        float,
        Quantity(
            "imbalance that limits or stock leave", "", 2, "without any errors; part of the expected one", unit="g_mm"
        ),
    ]
    printed_mass: Annotated[
        float | None, Quantity("mass by the published formula", "", 4, "readings not converted", unit="g")
    ]
    printed_angle: Annotated[float | None, Quantity("angle by the published formula", "", 5, unit="deg")]


@dataclass(frozen=True)
class Found:
    """An answer; `target`: imbalance of each plane that the correction takes away, `leftover`: the part that discrete
    masses cannot take away [kg m].
    """

    case: Balancing
    solution: Solution
    by: Sequence[ErrorContribution]
    below: bool
    """True if the imbalance is below its errors: no correction is proposed."""
    placed: Spread
    """Changes by the errors of the correction itself, mass by mass."""
    spread: Spread
    target: Vector
    leftover: Vector
    remainders: tuple[Remainder, ...]
    """Motions of the sensors at each speed, now and after the correction."""
    rest_share: float
    """Vibration left, rms over the errors, of that before."""
    error_share: float
    """Vibration that errors of the correction leave, of that which it takes away."""
    planes_share: float | None
    """Vibration that the planes alone leave, of that before; None with as many planes as sensors."""
    disagreement: float | None
    tolerance: TolerancePlanes | None
    service_speed: float
    bending_speed: float | None
    planes: tuple[str, ...]
    radii: tuple[float, ...]
    making: Making
    shares: Sequence[Sequence[Share]]
    farther: tuple[float, float] | None
    """A speed farther from the natural frequencies that was tried [rad/s], and what would be left there."""
    printed: tuple[Signed, Signed] | None
    """Result of the formula as published for the first run without trial masses."""

    @property
    def rest(self) -> tuple[float, ...]:
        """Imbalance expected to be left in each correction plane, rms over the errors [kg m]."""
        return tuple(size(each[plane] for each in self.spread) for plane in range(len(self.planes)))

    @property
    def rest_in_tolerance_planes(self) -> tuple[float, ...]:
        """Likewise in each tolerance plane; in the correction planes without a tolerance."""
        return self.rest if self.tolerance is None else self.tolerance.sizes(self.spread)

    @property
    def tolerance_result(self) -> ToleranceResult | None:
        """Permitted imbalance, that now and that expected in the tolerance planes."""
        if self.tolerance is None:
            return None
        return self.tolerance.result(self.planes, self.solution.imbalance, self.rest_in_tolerance_planes)

    def correction(self, plane: int, *, with_rotation: bool) -> PlaneCorrection:
        """Correction in a plane; `with_rotation`: the angle marks of the rotor count so."""
        Q, radius, rest = self.target[plane], self.radii[plane], self.rest[plane]
        deltas, sense = [change.imbalance[plane] for change in self.by], -1 if with_rotation else 1
        heavy_spot = -cmath.phase(Q)
        printed_mass, printed_angle = self.printed[plane] if self.printed else (None, None)
        return PlaneCorrection(
            mass=abs(Q) / radius,
            angle=turned(heavy_spot),
            mass_uncertainty=radial(Q, deltas) / radius,
            angle_uncertainty=angular(Q, deltas),
            remove_at=turned(sense * heavy_spot),
            add_at=turned(sense * heavy_spot + math.pi),
            corrections=tuple(replace(share, angle=turned(sense * share.angle)) for share in self.shares[plane]),
            imbalance=abs(Q),
            permitted=self.tolerance.permitted[plane] if self.tolerance else None,
            rest=rest,
            rest_at_most=2 * rest,
            leftover=abs(self.leftover[plane]),
            printed_mass=printed_mass,
            printed_angle=printed_angle,
        )


def find(file: ReadingsFile, taken: Sequence[RunReadings], coefficients: Coefficients | None = None) -> Found:
    """The answer of a file. Raises InputError, and NotTrustworthyError where errors would be larger than it."""
    case, sigma = balancing(file, tuple(taken), coefficients), file.errors
    fitted = tuple(mass_of(file, mass) for mass in file.correction.fitted)
    replaced = fitted if file.correction.answer == "total" else ()
    answer = _answer(case, method_of(case), sigma, replaced)
    service, making = file.tolerance.service_speed or max(run.speed for run in case.runs), making_of(file)
    radii = file.radii
    shares: list[tuple[Share, ...]] = [
        () if answer.below else _shares(file, making, plane, Q, radii[plane]) for plane, Q in enumerate(answer.target)
    ]
    leftover = tuple(_leftover(*each) for each in zip(answer.target, shares, radii, strict=True))
    placed = placing([_pieces(*each) for each in zip(shares, radii, strict=True)], sigma)
    spread = [*(change.imbalance for change in answer.by), *placed, leftover]
    left = remainders(case, answer.solution, answer.by, placed, leftover)
    planes_share, disagreement = _misfits(case, answer, left)
    return Found(
        case=case,
        solution=answer.solution,
        by=answer.by,
        placed=placed,
        below=answer.below,
        spread=spread,
        target=answer.target,
        leftover=leftover,
        remainders=left,
        rest_share=_worst_share(left, [each.expected for each in left], [each.now for each in left]),
        error_share=_error_share(left),
        planes_share=planes_share,
        disagreement=disagreement,
        tolerance=tolerance_of(file, service),
        service_speed=service,
        bending_speed=file.rotor.first_bending_speed,
        planes=file.planes,
        radii=radii,
        making=making,
        shares=shares,
        farther=_farther(case, answer.solution, sigma),
        printed=_printed(case, radii),
    )


@dataclass(frozen=True)
class _Answer:
    solution: Solution
    target: Vector
    by: Sequence[ErrorContribution]
    below: bool = False


def _finely_measured(case: Balancing, method: Method, by: Sequence[ErrorContribution]) -> bool:
    """Tell whether trial masses measure the imbalance well, so that it is small and not unknown."""
    if method not in ("trial masses", "runs without phase") or case.roll is not None:
        return False
    return all(
        size(change.imbalance[plane] for change in by) <= FINE * max(abs(run.placed[plane]) for run in case.runs)
        for plane in range(case.planes)
    )


def _answer(case: Balancing, method: Method, sigma: Errors, replaced: tuple[TrialMass, ...]) -> _Answer:
    """Answer by this method; by the rig's data if trial masses tell too little and these data are known.

    `replaced`: masses that are fitted and that the correction replaces.
    """
    try:
        solution = solved(case, method)
        known = imbalance_of(replaced, case.planes)
        target = tuple(Q - mass for Q, mass in zip(solution.imbalance, known, strict=True))
        by = [*changes(case, method, sigma), *_of_fitted(case, replaced, sigma)]
        placed = placing([(Q,) for Q in target], sigma)
        left = remainders(case, solution, by, placed, (0j,) * case.planes)
        share = _error_share(left)
        little = _worst_share(left, [each.unsure for each in left], [each.now for each in left]) <= FINE
        if share > HOPELESS and not replaced and (little or _finely_measured(case, method, by)):
            return _Answer(solution, target, by, below=True)
        if share > HOPELESS:
            raise NotTrustworthyError(_hopeless(case, method, share))
    except NotTrustworthyError:
        if method != "trial masses" or case.roll is None:
            raise
        return _answer(case, "rig data", sigma, replaced)
    return _Answer(solution, target, by)


def _of_fitted(case: Balancing, fitted: Sequence[TrialMass], sigma: Errors) -> list[ErrorContribution]:
    """Contributions of the masses that are replaced: the readings hold them as they are, the file as they are said."""
    return [
        ErrorContribution(
            "fitted masses", tuple(mass.imbalance * step if k == mass.plane else 0j for k in range(case.planes)),
            tuple((0j,) * len(run.amplitudes) for run in case.runs),
            tuple(((0j,) * case.planes,) * len(run.amplitudes) for run in case.runs),
        )
        for mass in fitted
        for step in (sigma.placed_mass, 1j * sigma.placed_angle)
    ]  # fmt: skip


def _hopeless(case: Balancing, method: Method, share: float) -> str:
    masses = {"runs without phase": [], "trial masses": ["heavier trial masses"]}.get(method, ["trial masses"])
    *ways, last = ["Another speed", "smaller errors", *masses, *["planes farther apart"] * (case.planes == 2)]
    much = f"{100 * share:.0f}" if share < MUCH else f"over {100 * MUCH:.0f}"
    return (
        f"the errors given would leave {much} % of the vibration that the correction takes away: none can be trusted."
        f"{said_of_resonance(case)}\n  {', '.join(ways)} or {last}. If little can be taken away, leave the "
        "rotor as it is."
    )


def _error_share(left: Sequence[Remainder]) -> float:
    """Vibration that errors of the correction leave, of that which it takes away, at the worst speed."""
    return _worst_share(left, [each.unsure for each in left], [each.now - each.planes for each in left])


def _worst_share(left: Sequence[Remainder], parts: Sequence[Floats], of: Sequence[Array]) -> float:
    """Parts of the vibration over others, at the worst speed; 0 where nothing moves before.

    A speed of little vibration counts from a tenth of the largest on.
    """
    before, after = ([each.scale * size(own) for each, own in zip(left, all_, strict=True)] for all_ in (of, parts))
    least = SEEN * max(before)
    return max(rest / (max(now, least) or math.inf) for rest, now in zip(after, before, strict=True))


def _misfits(case: Balancing, answer: "_Answer", left: Sequence[Remainder]) -> tuple[float | None, float | None]:
    """Vibration that the planes leave over that before, of all speeds, 0 where errors explain it; and the largest
    misfit, in standard deviations, that no further plane could take away. None for what the runs do not tell.
    """
    solution, by = answer.solution, answer.by
    if len(case.runs[0].amplitudes) <= case.planes:
        return None, in_deviations(solution, by, np.array)
    lack = in_deviations(solution, by, lambda misfits: of_planes(case, solution, misfits)) or 0.0
    few = lack > BEYOND_ERRORS
    mean = few or len(case.speed_groups) == 1
    contradiction = in_deviations(
        solution, by, lambda misfits: np.array(misfits) - of_planes(case, solution, misfits, all_speeds=mean)
    )
    sizes = [(each.scale * size(each.planes), each.scale * size(each.now)) for each in left]
    rest, now = (math.hypot(*each) for each in zip(*sizes, strict=True))
    return rest / (now or math.inf) if few else 0.0, contradiction


def _farther(case: Balancing, solution: Solution, sigma: Errors) -> tuple[float, float] | None:
    """The same imbalances read with the same errors at a speed farther from the natural frequencies."""
    if case.roll is None:
        return None
    speed = FARTHER * natural_frequencies(case.roll)[1]
    matrix = influence(case.roll, speed)
    motion = motion_of(matrix, solution.imbalance)
    run = replace(
        case.runs[0], speed=speed, quantity="displacement", sensor=0.0, weights=(), noise=(),
        amplitudes=tuple(abs(phasor) for phasor in motion), phases=tuple(-cmath.phase(phasor) for phasor in motion),
    )  # fmt: skip
    there = replace(case, runs=(run,))
    placed = placing([(Q,) for Q in solution.imbalance], sigma)
    left = remainders(there, solved(there, "rig data"), changes(there, "rig data", sigma), placed, (0j, 0j))
    return speed, _error_share(left)


def _shares(file: ReadingsFile, making: Making, plane: int, Q: complex, radius: float) -> tuple[Share, ...]:
    places = file.places_deg[plane]
    marked = None if places is None else [behind_the_mark(file, place) for place in places]
    return correction(abs(Q) / radius, -cmath.phase(Q), making, marked, radius)


def _pieces(shares: Sequence[Share], radius: float) -> Vector:
    """Imbalance of each mass of a plane [kg m]."""
    return tuple(cmath.rect(share.mass * radius, -share.angle) for share in shares)


def _leftover(Q: complex, shares: Sequence[Share], radius: float) -> complex:
    """Imbalance that shares do not take away [kg m]."""
    left = Q - total(shares).conjugate() * radius
    return left if abs(left) > ROUNDING * abs(Q) else 0j


def _printed(case: Balancing, radii: tuple[float, ...]) -> tuple[Signed, Signed] | None:
    run = next((run for run in case.runs if not run.weights), None)
    if case.roll is None or run is None or len(run.phases) != 2:
        return None
    return published_answer(case.roll, run.speed, run.readings, (radii[0], radii[1]))
