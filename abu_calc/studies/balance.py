"""Balancing in two planes: from readings of a roll on a rig to what to take off or put on, where, and how sure."""

import os
from typing import Annotated, ClassVar

from abu_calc.spec.read_readings import Readings, read_readings
from abu_calc.studies.balance_case import taken_runs
from abu_calc.studies.balance_checks import balance_checks
from abu_calc.studies.balance_found import find
from abu_calc.studies.balance_parts import (
    balance_model,
    causes,
    complex_rows,
    natural_hz,
    plane_correction,
    residual_check,
    run_readings,
)
from abu_calc.studies.balance_records import (
    BalanceModel,
    Complex,
    ErrorShare,
    PlaneCorrection,
    ResidualCheck,
    RunReadings,
)
from abu_calc.studies.balance_warnings import balance_warnings
from abu_calc.studies.quantity import Quantity, record
from abu_calc.studies.result import Provenance, Result


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
