"""Balancing in two planes: from readings of a roll on a rig to what to take off or put on, where, and how sure."""

import cmath
import math
import os
from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, ClassVar, Final

from abu_calc.analysis.splitting import Share as ShareInSI
from abu_calc.analysis.splitting import correction
from abu_calc.analysis.two_plane_errors import (
    Change,
    Deviations,
    angular,
    changes,
    disagreement,
    motions,
    placing,
    radial,
    size,
)
from abu_calc.analysis.two_planes import (
    ONE_SPEED,
    Balancing,
    RunOnRig,
    Solution,
    method_of,
    motion_of,
    said_of_resonance,
    solved,
)
from abu_calc.errors import NotTrustworthyError
from abu_calc.formulas.two_planes import (
    Matrix,
    Pair,
    influence,
    natural_frequencies,
    printed_answer,
    reading_factor,
    support_damping,
)
from abu_calc.spec.read_readings import Readings, read_readings
from abu_calc.spec.readings import ReadingsFile
from abu_calc.standards.balance import permissible_imbalance
from abu_calc.studies.balance_case import UNITS, Taken, balancing, deviations, taken_runs, unit_of_readings
from abu_calc.studies.balance_checks import HOPELESS, Found, balance_checks
from abu_calc.studies.balance_records import (
    BalanceModel,
    Complex,
    ErrorShare,
    PlaneCorrection,
    ResidualCheck,
    RunReadings,
    SensorReading,
    Share,
    Verification,
)
from abu_calc.studies.balance_warnings import balance_warnings
from abu_calc.studies.quantity import Quantity, record
from abu_calc.studies.result import Provenance, Result
from abu_calc.units import from_si, to_si, wrapped_deg

FARTHER: Final = 1.6
"""Of the highest natural frequency: the speed that is tried where that of the runs is near one."""
Spread = Sequence[Pair]


@record
class BalanceResult(Result):
    """What to do in both planes, and what the verification run will show."""

    command: ClassVar[str] = "balance"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"turns_from_left"}

    model: BalanceModel
    method: Annotated[str, Quantity("found by", "", 4, "rig data or trial masses (influence coefficients)")]
    left: PlaneCorrection
    right: PlaneCorrection
    residual_check: ResidualCheck
    runs: tuple[RunReadings, ...]
    natural_frequencies_hz: Annotated[
        tuple[float, float] | None, Quantity("natural frequencies of the rig", "", 4, "roll on its supports, undamped")
    ]
    influence_coefficients: Annotated[
        tuple[tuple[Complex, Complex], tuple[Complex, Complex]],
        Quantity(
            "influence of the planes on the sensors", "H", 5,
            "µm of displacement per g·mm at the speed of the first run, real and imaginary part; rows: left and right "
            "sensor, columns: left and right plane",
        ),
    ]  # fmt: skip
    uncertainty_by_cause: tuple[ErrorShare, ...]
    turns_from_left: str
    """How the roll turns to one at its left end: for the drawing."""


def balance(source: Readings | str | os.PathLike[str]) -> BalanceResult:
    """Balance a roll by readings that were read, or by the name of their file.

    Raises InputError for what is wrong in the file, NotTrustworthyError where errors would be larger than the answer.
    """
    readings = source if isinstance(source, Readings) else read_readings(source)
    file, taken = readings.tables, taken_runs(readings)
    case, sigma = balancing(file, taken), deviations(file.errors)
    with readings.located():
        solution = solved(case, method_of(case))
        by = changes(case, solution.method, sigma)
    spread = [*(change.imbalance for change in by), *placing(solution.imbalance, sigma)]
    share = _rest_share(solution, spread)
    if share > HOPELESS:
        raise NotTrustworthyError(_hopeless(case, share))
    service = _service_speed(file, case)
    permitted = _permitted(file, service)
    radii, removable = _radii(file), file.rotor.max_removable_g
    limit = None if removable is None else to_si(removable, "g")
    shares = [_shares(file, plane, solution.imbalance[plane], radii[plane], limit) for plane in (0, 1)]
    rest = [(size(pair[plane] for pair in spread), permitted[plane]) for plane in (0, 1)]
    apart = disagreement(solution, by)
    bending = file.rotor.first_bending_speed_rpm
    found = Found(
        case, solution, share, apart, rest, service, None if bending is None else to_si(bending, "rpm"), shares, limit,
        _farther(case, solution, sigma),
    )  # fmt: skip
    planes = [_plane(plane, found, by, radii, _printed(case, radii)) for plane in (0, 1)]
    return BalanceResult(
        title=file.rotor.name,
        checks=balance_checks(found),
        warnings=(*readings.warnings, *balance_warnings(file, taken, found, planes)),
        provenance=Provenance.of(readings),
        model=_model(case, solution, service),
        method=solution.method,
        left=planes[0],
        right=planes[1],
        residual_check=_residual(case, solution, spread, permitted, share, apart),
        runs=tuple(map(_run, taken)),
        natural_frequencies_hz=_natural(case),
        influence_coefficients=_complex_rows(solution.influences[0]),
        uncertainty_by_cause=_causes(solution.imbalance, by, sigma),
        turns_from_left=file.rotor.turns_from_left,
    )


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
    amplitudes, phases = [abs(one) for one in motion], [-cmath.phase(one) for one in motion]
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
    """By the grade, shared between the planes by the place of the centre of mass; by halves where that is not known."""
    grade, rotor = file.tolerance.balance_grade, file.rotor
    if grade is None or rotor.mass_kg is None:
        return None, None
    whole = permissible_imbalance(grade, rotor.mass_kg, speed)
    b, c = rotor.left_plane_to_centre_m, rotor.centre_to_right_plane_m
    share = 0.5 if b is None or c is None else c / (b + c)
    return share * whole, (1 - share) * whole


def _radii(file: ReadingsFile) -> tuple[float, float]:
    return to_si(file.rotor.left_correction_radius_mm, "mm"), to_si(file.rotor.right_correction_radius_mm, "mm")


def _shares(file: ReadingsFile, plane: int, Q: complex, radius: float, limit: float | None) -> tuple[ShareInSI, ...]:
    places = (file.rotor.left_places_deg, file.rotor.right_places_deg)[plane]
    turned = None if places is None else [math.radians(place) for place in places]
    return correction(abs(Q) / radius, -cmath.phase(Q), limit, turned)


def _printed(case: Balancing, radii: tuple[float, float]) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """What the formula as printed makes of the first run without trial masses."""
    run = next((run for run in case.runs if not run.weights), None)
    if case.roll is None or run is None:
        return None
    return printed_answer(case.roll, run.speed, run.readings, radii)


def degrees(angle: float) -> float:
    """An angle [rad] in degrees, 0 … 360, the latter not reached.

    >>> degrees(-math.pi / 2)
    270.0
    """
    found = math.degrees(angle) % 360.0
    return 0.0 if found == 360.0 else found


def _plane(
    plane: int, found: Found, by: Sequence[Change], radii: tuple[float, float],
    printed: tuple[tuple[float, float], tuple[float, float]] | None,
) -> PlaneCorrection:  # fmt: skip
    Q, radius = found.solution.imbalance[plane], radii[plane]
    deltas = [change.imbalance[plane] for change in by]
    angle = degrees(-cmath.phase(Q))
    rest, permitted = found.rest[plane]
    mass, turn = (None, None) if printed is None else printed[plane]
    return PlaneCorrection(
        mass_g=from_si(abs(Q) / radius, "g"),
        angle_deg=angle,
        mass_uncertainty_g=from_si(radial(Q, deltas) / radius, "g"),
        angle_uncertainty_deg=math.degrees(angular(Q, deltas)),
        remove_at_deg=angle,
        add_at_deg=(angle + 180.0) % 360.0,
        corrections=tuple(
            Share(action=one.action, mass_g=from_si(one.mass, "g"), angle_deg=degrees(one.angle))
            for one in found.shares[plane]
        ),
        imbalance_g_mm=from_si(abs(Q), "g_mm"),
        permitted_g_mm=None if permitted is None else from_si(permitted, "g_mm"),
        rest_g_mm=from_si(rest, "g_mm"),
        printed_mass_g=None if mass is None else from_si(mass, "g"),
        printed_angle_deg=None if turn is None or math.isnan(turn) else math.degrees(turn),
    )


def _run(taken: Taken) -> RunReadings:
    run, found = taken.run, taken.record
    unit = UNITS[run.quantity]
    left, right = (
        SensorReading(amplitude=from_si(amplitude, unit), phase_deg=wrapped_deg(phase))
        for amplitude, phase in zip(run.amplitudes, run.phases, strict=True)
    )
    return RunReadings(
        speed_rpm=from_si(run.speed, "rpm"), quantity=run.quantity, unit=unit_of_readings(run.quantity), left=left,
        right=right, file=taken.file, sha256=taken.sha256, revolutions=None if found is None else found.revolutions,
        mark_edge=None if found is None else found.marks.edge, trials=len(run.weights),
    )  # fmt: skip


def _residual(
    case: Balancing, solution: Solution, spread: Spread, permitted: tuple[float | None, float | None], share: float,
    apart: float | None,
) -> ResidualCheck:  # fmt: skip
    largest = max(abs(one) for run in case.runs for one in run.motion)
    misfit = max(abs(one) for pair in solution.misfits for one in pair)
    whole = None if permitted[0] is None or permitted[1] is None else from_si(permitted[0] + permitted[1], "g_mm")
    return ResidualCheck(
        permitted_g_mm=whole,
        rest_share=share,
        reproduced=misfit / largest if largest else 0.0,
        disagreement=apart,
        verification=tuple(
            _verification(solution, spread, run.speed, run.quantity, matrix) for run, matrix in _unlike(case, solution)
        ),
    )


def _unlike(case: Balancing, solution: Solution) -> list[tuple[RunOnRig, Matrix]]:
    """Runs of other speeds or quantities than those before."""
    found: list[tuple[RunOnRig, Matrix]] = []
    for run, matrix in zip(case.runs, solution.influences, strict=True):
        alike = [
            one for one, _ in found if one.quantity == run.quantity and abs(one.speed / run.speed - 1) <= ONE_SPEED
        ]
        if not alike:
            found.append((run, matrix))
    return found


def _verification(solution: Solution, spread: Spread, speed: float, quantity: str, matrix: Matrix) -> Verification:
    scale = abs(reading_factor(quantity, speed))
    before = [from_si(abs(one) * scale, UNITS[quantity]) for one in motion_of(matrix, solution.imbalance)]
    after = [from_si(one * scale, UNITS[quantity]) for one in motions(matrix, spread)]
    return Verification(
        speed_rpm=from_si(speed, "rpm"), quantity=quantity, unit=unit_of_readings(quantity), left_before=before[0],
        right_before=before[1], left_expected=after[0], right_expected=after[1], left_at_most=2 * after[0],
        right_at_most=2 * after[1],
    )  # fmt: skip


def _causes(Q: Pair, by: Sequence[Change], sigma: Deviations) -> tuple[ErrorShare, ...]:
    """Each cause's part of the imbalance's uncertainty, that of the correction itself behind those of the answer."""
    groups: dict[str, list[Pair]] = {}
    for change in by:
        groups.setdefault(change.cause, []).append(change.imbalance)
    groups["correction"] = placing(Q, sigma)
    return tuple(
        ErrorShare(
            cause=cause, left_percent=_percent(Q[0], [left for left, _ in pairs]),
            right_percent=_percent(Q[1], [right for _, right in pairs]),
        )
        for cause, pairs in groups.items()
    )  # fmt: skip


def _percent(Q: complex, deltas: Sequence[complex]) -> float:
    return 100 * size(deltas) / abs(Q) if Q else 0.0


def _natural(case: Balancing) -> tuple[float, float] | None:
    if case.roll is None:
        return None
    low, high = natural_frequencies(case.roll)
    return from_si(low, "hz"), from_si(high, "hz")


def _complex(value: complex) -> Complex:
    return value.real, value.imag


def _complex_pair(values: Pair) -> tuple[Complex, Complex]:
    return _complex(values[0]), _complex(values[1])


def _complex_rows(matrix: Matrix) -> tuple[tuple[Complex, Complex], tuple[Complex, Complex]]:
    return _complex_pair(matrix[0]), _complex_pair(matrix[1])


def _model(case: Balancing, solution: Solution, service: float) -> BalanceModel:
    return BalanceModel(
        method=solution.method,
        speeds_rad_per_s=tuple(run.speed for run in case.runs),
        displacements_m=tuple(_complex_pair(run.motion) for run in case.runs),
        placed_kg_m=tuple(_complex_pair(run.placed) for run in case.runs),
        imbalances_kg_m=_complex_pair(solution.imbalance),
        influence_m_per_kg_m=_complex_rows(solution.influences[0]),
        natural_frequencies_rad_per_s=None if case.roll is None else natural_frequencies(case.roll),
        support_damping_N_s_per_m=None if case.roll is None else support_damping(case.roll),
        service_speed_rad_per_s=service,
    )
