"""Balancing in one plane or two: from readings of a rotor to corrections, their places and their errors."""

import os
from collections.abc import Sequence
from typing import Annotated, ClassVar, TypeAlias

from abu_calc.features.balancing.case import RunReadings, taken_runs
from abu_calc.features.balancing.checks import balance_checks, balance_warnings
from abu_calc.features.balancing.coefficients import Stored, coefficients_of, coefficients_text, read_coefficients
from abu_calc.features.balancing.errors import Remainder, size
from abu_calc.features.balancing.formulas import Vector, natural_frequencies, reading_factor, support_damping
from abu_calc.features.balancing.read import Readings, read_readings
from abu_calc.features.balancing.solution import Found, PlaneCorrection, find
from abu_calc.features.balancing.tolerance import ToleranceResult, TrialMassResult, proposals
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.simulation.result import Provenance, Result

Complex: TypeAlias = tuple[float, float]
"""Real and imaginary part."""


@record
class SensorVerification(Record):
    """Readings of a sensor, in the unit of the run."""

    name: Annotated[str, Quantity("sensor")]
    before: Annotated[float, Quantity("as measured", "", 4)]
    after: Annotated[float, Quantity("predicted", "", 3, "without errors")]
    expected: Annotated[float, Quantity("expected", "", 2, "rms over the errors")]
    at_most: Annotated[float, Quantity("at most", "", 2, "twice the rms errors: exceeded less than once in twenty")]


@record
class Predicted(Record):
    """Reading of a sensor at a speed, measured and predicted after the correction, in the unit of the run."""

    sensor: Annotated[str, Quantity("sensor")]
    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    measured: Annotated[float, Quantity("measured", "|X_s|", 4, "without trial masses")]
    after: Annotated[float, Quantity("predicted after the correction", "", 3, "without errors")]
    unit: Annotated[str, Quantity("unit of amplitudes")]


@record
class Verification(Record):
    """The run after the correction, as it is to be expected at the speed of a run, in its unit."""

    optional: ClassVar[frozenset[str]] = frozenset(
        f"{side}_{what}" for side in ("left", "right") for what in ("before", "expected", "at_most")
    )

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    quantity: Annotated[str, Quantity("quantity")]
    unit: Annotated[str, Quantity("unit of amplitudes")]
    left_before: Annotated[float | None, Quantity("left, as it is", "", 4)]
    right_before: Annotated[float | None, Quantity("right, as it is", "", 4)]
    left_expected: Annotated[float | None, Quantity("left, expected", "", 2, "rms over the errors")]
    right_expected: Annotated[float | None, Quantity("right, expected", "", 2, "rms over the errors")]
    left_at_most: Annotated[
        float | None, Quantity("left, at most", "", 2, "twice that: exceeded less than once in twenty")
    ]
    right_at_most: Annotated[float | None, Quantity("right, at most", "", 2, "likewise")]
    sensors: tuple[SensorVerification, ...]


@record
class ResidualCheck(Record):
    """Residual after the correction, by the errors of readings, rig and correction."""

    permitted: Annotated[float | None, Quantity("permitted imbalance of the roll", "U_per", unit="g_mm")]
    rest_share: Annotated[float, Quantity("vibration expected to be left", "", 2, "of that before, rms", percent=True)]
    reproduced: Annotated[
        float, Quantity("misfit of the runs", "", 2, "largest, of the answer put back, over the largest reading")
    ]
    disagreement: Annotated[float | None, Quantity("misfit in standard deviations", "", 2)]
    planes_share: Annotated[
        float | None,
        Quantity("vibration that the planes leave", "", 2, "of that before; more sensors than planes", percent=True),
    ]
    minimised: Annotated[
        str | None, Quantity("quantity whose sum of squares is the least", "", 4, "if something remains")
    ]
    verification: tuple[Verification, ...]
    """Verifications for each speed and quantity of the runs."""


@record
class ErrorShare(Record):
    """Share of one cause in the uncertainty; null for the planes there are not."""

    optional: ClassVar[frozenset[str]] = frozenset({"left_percent", "right_percent", "single_plane_percent"})

    cause: Annotated[str, Quantity("cause")]
    left: Annotated[
        float | None, Quantity("left", "", 2, "of the left imbalance, one standard deviation, %", unit="percent")
    ] = None
    right: Annotated[float | None, Quantity("right", "", 2, "of the right imbalance, %", unit="percent")] = None
    single_plane: Annotated[float | None, Quantity("single plane", "", 2, "of its imbalance, %", unit="percent")] = None


@record
class BalanceModel(Record):
    """Numbers of the balancing in SI; complex numbers as real and imaginary part, imbalances q·R·e^{−iφ}."""

    method: str
    speeds_rad_per_s: tuple[float, ...]
    displacements_m: tuple[tuple[Complex, ...], ...]
    placed_kg_m: tuple[tuple[Complex, ...], ...]
    imbalances_kg_m: tuple[Complex, ...]
    influence_m_per_kg_m: tuple[tuple[Complex, ...], ...]
    natural_frequencies_rad_per_s: tuple[float, float] | None
    support_damping_N_s_per_m: tuple[float, float] | None
    service_speed_rad_per_s: float


@record
class BalanceResult(Result):
    """Correction to make, and the vibration that the verification run will show."""

    command: ClassVar[str] = "balance"
    left_out: ClassVar[frozenset[str]] = Result.left_out | {"turns_from_left", "coefficients_text"}
    optional: ClassVar[frozenset[str]] = frozenset({"left", "right", "single_plane", "coefficients_file"})

    model: BalanceModel
    method: Annotated[
        str,
        Quantity("found by", "", 4, "rig data, trial masses (influence coefficients), runs without phase or stored "
                 "coefficients"),
    ]  # fmt: skip
    answer: Annotated[str, Quantity("answer", "", 4, "trim: added to fitted masses, total: in their place")]
    fitted: Annotated[int, Quantity("masses that were fitted in all runs")]
    angle_marks: Annotated[str, Quantity("angle marks count", "", 4, "against rotation, or with it")]
    left: PlaneCorrection | None
    right: PlaneCorrection | None
    single_plane: PlaneCorrection | None
    residual_check: ResidualCheck
    tolerance: ToleranceResult | None
    runs: tuple[RunReadings, ...]
    natural_frequencies: Annotated[
        tuple[float, float] | None,
        Quantity("natural frequencies of the rig", "", 4, "roll on its supports, undamped", unit="hz"),
    ]
    influence_coefficients: Annotated[
        tuple[tuple[Complex, ...], ...],
        Quantity(
            "influence of the planes on the sensors", "W", 5,
            "µm of displacement per g·mm at the speed of the first run, real and imaginary part; rows: sensors, "
            "columns: planes. Without phase: its magnitude",
        ),
    ]  # fmt: skip
    coefficients_file: Annotated[str | None, Quantity("stored coefficients of")]
    predicted: tuple[Predicted, ...]
    """Readings measured, and those predicted after the correction."""
    uncertainty_by_cause: tuple[ErrorShare, ...]
    trial_masses: tuple[TrialMassResult, ...]
    sensor_to_mark: Annotated[
        float, Quantity("sensor of the mark", "", 4, "from the vibration sensors, first run", unit="deg")
    ]
    turns_from_left: str
    """Sense of rotation of the rotor, seen from its left end: for the drawing."""
    coefficients_text: str | None
    """Text of a file of the influence coefficients; None if no trial masses gave them."""

    @property
    def planes(self) -> tuple[tuple[str, PlaneCorrection], ...]:
        """Planes by their names."""
        named = (("left", self.left), ("right", self.right), ("single", self.single_plane))
        return tuple((name, plane) for name, plane in named if plane is not None)


def balance(
    source: Readings | str | os.PathLike[str], coefficients: "Stored | str | os.PathLike[str] | None" = None
) -> BalanceResult:
    """Balance a rotor by readings that were read, or by the name of their file.

    `coefficients`: a file of stored influence coefficients, used in place of trial masses. Raises InputError for what
    is wrong in the files, NotTrustworthyError where errors would be larger than the answer.
    """
    readings = source if isinstance(source, Readings) else read_readings(source)
    stored = (
        coefficients if coefficients is None or isinstance(coefficients, Stored) else read_coefficients(coefficients)
    )
    file, taken = readings.tables, taken_runs(readings)
    sensors = [sensor.name for sensor in taken[0].sensors]
    if stored is not None:
        stored.refuse_others(file.planes, sensors)
    with readings.located():
        balancing = find(file, taken, None if stored is None else stored.values)
    case, solution = balancing.case, balancing.solution
    with_rotation = file.rotor.angle_marks == "with"
    planes = [balancing.correction(plane, with_rotation=with_rotation) for plane in range(case.planes)]
    named = dict(zip(file.planes, planes, strict=True))
    fastest = max(range(len(case.runs)), key=lambda index: case.runs[index].speed)
    residual = _residual_check(balancing, taken)
    text = None
    if solution.method == "trial masses":
        text = coefficients_text(file.rotor.name, file.planes, sensors, coefficients_of(case, solution, balancing.by))
    return BalanceResult(
        title=file.rotor.name,
        checks=balance_checks(balancing, taken),
        warnings=(*readings.warnings, *balance_warnings(file, taken, balancing, planes)),
        provenance=Provenance.of(readings),
        model=_model(balancing),
        method=solution.method,
        answer=file.correction.answer,
        fitted=len(file.correction.fitted),
        angle_marks=f"{file.rotor.angle_marks} rotation",
        left=named.get("left"),
        right=named.get("right"),
        single_plane=named.get("single"),
        residual_check=residual,
        tolerance=balancing.tolerance_result,
        runs=taken,
        natural_frequencies=natural_frequencies(case.roll) if case.roll else None,
        influence_coefficients=tuple(map(_pairs, solution.influences[0])),
        coefficients_file=None if stored is None else stored.file,
        predicted=tuple(
            Predicted(sensor=sensor.name, speed=run.speed, measured=sensor.before, after=sensor.after, unit=run.unit)
            for run in residual.verification
            for sensor in run.sensors
        ),
        uncertainty_by_cause=_causes(balancing),
        trial_masses=proposals(file, case.runs, solution.influences[fastest]),
        sensor_to_mark=case.runs[0].sensor,
        turns_from_left=file.rotor.turns_from_left,
        coefficients_text=text,
    )


def _residual_check(balancing: Found, taken: Sequence[RunReadings]) -> ResidualCheck:
    case, tolerance = balancing.case, balancing.tolerance
    largest = max(abs(phasor) for run in case.runs for phasor in run.motion)
    misfit = max(abs(deviation) for misfits in balancing.solution.misfits for deviation in misfits)
    return ResidualCheck(
        permitted=tolerance.whole if tolerance else None,
        rest_share=balancing.rest_share,
        reproduced=misfit / largest if largest else 0.0,
        disagreement=balancing.disagreement,
        verification=tuple(_verification(own, remainder) for own, remainder in _unlike(taken, balancing)),
        planes_share=balancing.planes_share,
        minimised=case.quantity if case.overdetermined else None,
    )


def _unlike(taken: Sequence[RunReadings], balancing: Found) -> list[tuple[RunReadings, Remainder]]:
    """A run of each speed and unit, with what remains at its speed."""
    kept: dict[tuple[int, str], tuple[RunReadings, Remainder]] = {}
    for number, (group, remainder) in enumerate(zip(balancing.case.speed_groups, balancing.remainders, strict=True)):
        for index in group:
            kept.setdefault((number, taken[index].unit), (taken[index], remainder))
    return list(kept.values())


def _verification(run: RunReadings, remainder: Remainder) -> Verification:
    scale = abs(reading_factor(run.quantity, remainder.speed))
    amplitudes = {"before": abs(remainder.now), "after": abs(remainder.after), "expected": remainder.expected,
                  "at_most": remainder.at_most}  # fmt: skip
    sensors = {
        sensor.name: SensorVerification(
            name=sensor.name,
            **{key: run.instrument.reading(scale * float(own[k])) for key, own in amplitudes.items()},
        )
        for k, sensor in enumerate(run.sensors)
    }
    sides = {
        f"{side}_{what}": getattr(sensors.get(side), what, None)
        for side in ("left", "right")
        for what in ("before", "expected", "at_most")
    }
    return Verification(speed=run.speed, quantity=run.quantity, unit=run.unit, sensors=tuple(sensors.values()), **sides)


def _causes(balancing: Found) -> tuple[ErrorShare, ...]:
    """Each cause's part of the imbalance's uncertainty, that of the correction itself behind those of the answer."""
    groups = dict[str, list[Vector]]()
    for change in balancing.by:
        groups.setdefault(change.cause, []).append(change.imbalance)
    groups["correction"] = list(balancing.placed)
    return tuple(
        ErrorShare(
            cause=cause,
            **{
                "single_plane" if name == "single" else name: size(each[k] for each in vectors) / abs(Q) if Q else 0.0
                for k, (name, Q) in enumerate(zip(balancing.planes, balancing.target, strict=True))
            },
        )
        for cause, vectors in groups.items()
    )


def _model(balancing: Found) -> BalanceModel:
    case, solution = balancing.case, balancing.solution
    return BalanceModel(
        method=solution.method,
        speeds_rad_per_s=tuple(run.speed for run in case.runs),
        displacements_m=tuple(_pairs(run.motion) for run in case.runs),
        placed_kg_m=tuple(_pairs(run.placed) for run in case.runs),
        imbalances_kg_m=_pairs(solution.imbalance),
        influence_m_per_kg_m=tuple(map(_pairs, solution.influences[0])),
        natural_frequencies_rad_per_s=natural_frequencies(case.roll) if case.roll else None,
        support_damping_N_s_per_m=support_damping(case.roll) if case.roll else None,
        service_speed_rad_per_s=balancing.service_speed,
    )


def _pairs(values: Vector) -> tuple[Complex, ...]:
    return tuple((value.real, value.imag) for value in values)
