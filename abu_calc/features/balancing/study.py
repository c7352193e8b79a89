"""Balancing in two planes: from readings of a roll on a rig to corrections, their places and their errors.

The result has user units; functions here convert its parts from SI.
"""

import cmath
import math
import os
from collections.abc import Sequence
from typing import Annotated, ClassVar

from abu_calc.features.balancing.case import UNITS, Taken, taken_runs, unit_of_readings
from abu_calc.features.balancing.checks import balance_checks, balance_warnings
from abu_calc.features.balancing.errors import angular, motions, placing, radial, size
from abu_calc.features.balancing.formulas import Matrix, Pair, natural_frequencies, reading_factor, support_damping
from abu_calc.features.balancing.read import Readings, read_readings
from abu_calc.features.balancing.records import (
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
from abu_calc.features.balancing.solution import Found, find
from abu_calc.features.balancing.two_planes import ONE_SPEED, Balancing, RunOnRig, Solution, motion_of
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.units import from_si, wrapped_deg
from abu_calc.simulation.result import Provenance, Result


def degrees(angle: float) -> float:
    """An angle [rad] in degrees, 0 … 360, the latter not reached.

    >>> degrees(-math.pi / 2)
    270.0
    """
    angle_deg = math.degrees(angle) % 360.0
    return 0.0 if angle_deg == 360.0 else angle_deg


def plane_correction(plane: int, balancing: Found) -> PlaneCorrection:
    """Correction in a plane (0 left, 1 right)."""
    Q, radius = balancing.solution.imbalance[plane], balancing.radii[plane]
    deltas = [change.imbalance[plane] for change in balancing.by]
    angle = degrees(-cmath.phase(Q))
    rest, permitted = balancing.rest[plane]
    mass, turn = (None, None) if balancing.printed is None else balancing.printed[plane]
    return PlaneCorrection(
        mass_g=from_si(abs(Q) / radius, "g"),
        angle_deg=angle,
        mass_uncertainty_g=from_si(radial(Q, deltas) / radius, "g"),
        angle_uncertainty_deg=math.degrees(angular(Q, deltas)),
        remove_at_deg=angle,
        add_at_deg=(angle + 180.0) % 360.0,
        corrections=tuple(
            Share(action=share.action, mass_g=from_si(share.mass, "g"), angle_deg=degrees(share.angle))
            for share in balancing.shares[plane]
        ),
        imbalance_g_mm=from_si(abs(Q), "g_mm"),
        permitted_g_mm=None if permitted is None else from_si(permitted, "g_mm"),
        rest_g_mm=from_si(rest, "g_mm"),
        printed_mass_g=None if mass is None else from_si(mass, "g"),
        printed_angle_deg=None if turn is None or math.isnan(turn) else math.degrees(turn),
    )


def run_readings(taken: Taken) -> RunReadings:
    """A run as it was taken."""
    run, record = taken.run, taken.record
    unit = UNITS[run.quantity]
    left, right = (
        SensorReading(amplitude=from_si(amplitude, unit), phase_deg=wrapped_deg(phase))
        for amplitude, phase in zip(run.amplitudes, run.phases, strict=True)
    )
    return RunReadings(
        speed_rpm=from_si(run.speed, "rpm"), quantity=run.quantity, unit=unit_of_readings(run.quantity), left=left,
        right=right, file=taken.file, sha256=taken.sha256, revolutions=None if record is None else record.revolutions,
        mark_edge=None if record is None else record.marks.edge, trials=len(run.weights),
    )  # fmt: skip


def residual_check(balancing: Found) -> ResidualCheck:
    """Residual after the correction."""
    case, solution = balancing.case, balancing.solution
    largest = max(abs(phasor) for run in case.runs for phasor in run.motion)
    misfit = max(abs(deviation) for pair in solution.misfits for deviation in pair)
    permitted = [limit for _, limit in balancing.rest if limit is not None]
    return ResidualCheck(
        permitted_g_mm=from_si(sum(permitted), "g_mm") if permitted else None,
        rest_share=balancing.rest_share,
        reproduced=misfit / largest if largest else 0.0,
        disagreement=balancing.disagreement,
        verification=tuple(_verification(balancing, run, matrix) for run, matrix in _unlike(case, solution)),
    )


def _unlike(case: Balancing, solution: Solution) -> list[tuple[RunOnRig, Matrix]]:
    """Runs of other speeds or quantities than those before."""
    kept: list[tuple[RunOnRig, Matrix]] = []
    for run, matrix in zip(case.runs, solution.influences, strict=True):
        alike = [
            peer for peer, _ in kept if peer.quantity == run.quantity and abs(peer.speed / run.speed - 1) <= ONE_SPEED
        ]
        if not alike:
            kept.append((run, matrix))
    return kept


def _verification(balancing: Found, run: RunOnRig, matrix: Matrix) -> Verification:
    speed, quantity = run.speed, run.quantity
    scale = abs(reading_factor(quantity, speed))
    before = [from_si(abs(value) * scale, UNITS[quantity]) for value in motion_of(matrix, balancing.solution.imbalance)]
    after = [from_si(amplitude * scale, UNITS[quantity]) for amplitude in motions(matrix, balancing.spread)]
    return Verification(
        speed_rpm=from_si(speed, "rpm"), quantity=quantity, unit=unit_of_readings(quantity), left_before=before[0],
        right_before=before[1], left_expected=after[0], right_expected=after[1], left_at_most=2 * after[0],
        right_at_most=2 * after[1],
    )  # fmt: skip


def causes(balancing: Found) -> tuple[ErrorShare, ...]:
    """Each cause's part of the imbalance's uncertainty, that of the correction itself behind those of the answer."""
    Q, groups = balancing.solution.imbalance, dict[str, list[Pair]]()
    for change in balancing.by:
        groups.setdefault(change.cause, []).append(change.imbalance)
    groups["correction"] = placing(Q, balancing.sigma)
    return tuple(
        ErrorShare(
            cause=cause, left_percent=_percent(Q[0], [left for left, _ in pairs]),
            right_percent=_percent(Q[1], [right for _, right in pairs]),
        )
        for cause, pairs in groups.items()
    )  # fmt: skip


def _percent(Q: complex, deltas: Sequence[complex]) -> float:
    return 100 * size(deltas) / abs(Q) if Q else 0.0


def natural_hz(case: Balancing) -> tuple[float, float] | None:
    """Natural frequencies [Hz], where the rig is known."""
    if case.roll is None:
        return None
    low, high = natural_frequencies(case.roll)
    return from_si(low, "hz"), from_si(high, "hz")


def _complex(value: complex) -> Complex:
    return value.real, value.imag


def _complex_pair(values: Pair) -> tuple[Complex, Complex]:
    return _complex(values[0]), _complex(values[1])


def complex_rows(matrix: Matrix) -> tuple[tuple[Complex, Complex], tuple[Complex, Complex]]:
    """A matrix as real and imaginary parts."""
    return _complex_pair(matrix[0]), _complex_pair(matrix[1])


def balance_model(balancing: Found) -> BalanceModel:
    """The numbers behind it."""
    case, solution = balancing.case, balancing.solution
    return BalanceModel(
        method=solution.method,
        speeds_rad_per_s=tuple(run.speed for run in case.runs),
        displacements_m=tuple(_complex_pair(run.motion) for run in case.runs),
        placed_kg_m=tuple(_complex_pair(run.placed) for run in case.runs),
        imbalances_kg_m=_complex_pair(solution.imbalance),
        influence_m_per_kg_m=complex_rows(solution.influences[0]),
        natural_frequencies_rad_per_s=None if case.roll is None else natural_frequencies(case.roll),
        support_damping_N_s_per_m=None if case.roll is None else support_damping(case.roll),
        service_speed_rad_per_s=balancing.service_speed,
    )


@record
class BalanceResult(Result):
    """Correction to make in both planes, and the vibration that the verification run will show."""

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
            "influence of the planes on the sensors", "W", 5,
            "µm of displacement per g·mm at the speed of the first run, real and imaginary part; rows: left and right "
            "sensor, columns: left and right plane",
        ),
    ]  # fmt: skip
    uncertainty_by_cause: tuple[ErrorShare, ...]
    turns_from_left: str
    """Sense of rotation of the roll, seen from its left end: for the drawing."""


def balance(source: Readings | str | os.PathLike[str]) -> BalanceResult:
    """Balance a roll by readings that were read, or by the name of their file.

    Raises InputError for what is wrong in the file, NotTrustworthyError where errors would be larger than the answer.
    """
    readings = source if isinstance(source, Readings) else read_readings(source)
    file, taken = readings.tables, taken_runs(readings)
    with readings.located():
        balancing = find(file, taken)
    planes = [plane_correction(plane, balancing) for plane in (0, 1)]
    return BalanceResult(
        title=file.rotor.name,
        checks=balance_checks(balancing),
        warnings=(*readings.warnings, *balance_warnings(file, taken, balancing, planes)),
        provenance=Provenance.of(readings),
        model=balance_model(balancing),
        method=balancing.solution.method,
        left=planes[0],
        right=planes[1],
        residual_check=residual_check(balancing),
        runs=tuple(map(run_readings, taken)),
        natural_frequencies_hz=natural_hz(balancing.case),
        influence_coefficients=complex_rows(balancing.solution.influences[0]),
        uncertainty_by_cause=causes(balancing),
        turns_from_left=file.rotor.turns_from_left,
    )
