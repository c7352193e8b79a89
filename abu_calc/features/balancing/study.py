"""Balancing in one plane or two: from readings of a rotor to corrections, their places and their errors.

The result has user units; functions here convert its parts from SI.
"""

import cmath
import math
import os
from collections.abc import Sequence
from typing import Annotated, ClassVar

from abu_calc.features.balancing.case import Taken, taken_runs
from abu_calc.features.balancing.checks import balance_checks, balance_warnings
from abu_calc.features.balancing.coefficients import Stored, coefficients_of, coefficients_text, read_coefficients
from abu_calc.features.balancing.corrections import MassShare
from abu_calc.features.balancing.errors import Remainder, angular, radial, size
from abu_calc.features.balancing.formulas import Matrix, Vector, natural_frequencies, reading_factor, support_damping
from abu_calc.features.balancing.next_run import proposals
from abu_calc.features.balancing.read import Readings, read_readings
from abu_calc.features.balancing.records import (
    BalanceModel,
    Complex,
    ErrorShare,
    PlaneCorrection,
    Predicted,
    ResidualCheck,
    RunReadings,
    SensorReading,
    SensorVerification,
    Share,
    ToleranceResult,
    TrialMassResult,
    Verification,
)
from abu_calc.features.balancing.runs import Balancing
from abu_calc.features.balancing.solution import Found, find
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


def plane_correction(plane: int, balancing: Found, with_rotation: bool = False) -> PlaneCorrection:
    """Correction in a plane; `with_rotation`: the angle marks of the rotor count so."""
    Q, radius = balancing.target[plane], balancing.radii[plane]
    deltas = [change.imbalance[plane] for change in balancing.by]
    sense, tolerance = (-1.0 if with_rotation else 1.0), balancing.tolerance
    marked = degrees(sense * -cmath.phase(Q))
    rest = from_si(balancing.rest[plane], "g_mm")
    mass, turn = (None, None) if balancing.printed is None else balancing.printed[plane]
    return PlaneCorrection(
        mass_g=from_si(abs(Q) / radius, "g"),
        angle_deg=degrees(-cmath.phase(Q)),
        mass_uncertainty_g=from_si(radial(Q, deltas) / radius, "g"),
        angle_uncertainty_deg=math.degrees(angular(Q, deltas)),
        remove_at_deg=marked,
        add_at_deg=(marked + 180.0) % 360.0,
        corrections=tuple(_share(share, sense) for share in balancing.shares[plane]),
        imbalance_g_mm=from_si(abs(Q), "g_mm"),
        permitted_g_mm=None if tolerance is None else from_si(tolerance.permitted[plane], "g_mm"),
        rest_g_mm=rest,
        rest_at_most_g_mm=2 * rest,
        leftover_g_mm=from_si(abs(balancing.leftover[plane]), "g_mm"),
        printed_mass_g=None if mass is None else from_si(mass, "g"),
        printed_angle_deg=None if turn is None or math.isnan(turn) else math.degrees(turn),
    )


def _share(share: MassShare, sense: float) -> Share:
    return Share(
        action=share.action, mass_g=from_si(share.mass, "g"), angle_deg=degrees(sense * share.angle),
        depth_mm=None if share.depth is None else from_si(share.depth, "mm"),
        weights_g=tuple(round(from_si(weight, "g"), 9) for weight in share.weights) or None,
    )  # fmt: skip


def run_readings(taken: Taken) -> RunReadings:
    """A run as it was taken."""
    run, record = taken.run, taken.record
    sense = -1.0 if taken.phase == "lead" else 1.0
    phases: Sequence[float | None] = run.phases or (None,) * len(run.amplitudes)
    sensors = tuple(
        SensorReading(
            name=name, amplitude=taken.instrument.reading(amplitude),
            phase_deg=None if phase is None else wrapped_deg(sense * phase),
        )
        for name, amplitude, phase in zip(taken.sensors, run.amplitudes, phases, strict=True)
    )  # fmt: skip
    by_name = {sensor.name: sensor for sensor in sensors}
    return RunReadings(
        speed_rpm=from_si(run.speed, "rpm"), quantity=run.quantity, unit=taken.instrument.shown,
        phase=(taken.phase or "lag") if run.phases else None, left=by_name.get("left"), right=by_name.get("right"),
        sensors=sensors, file=taken.file, sha256=taken.sha256,
        revolutions=None if record is None else record.revolutions,
        mark_edge=None if record is None else record.marks.edge, trials=len(run.weights),
    )  # fmt: skip


def residual_check(balancing: Found, taken: Sequence[Taken]) -> ResidualCheck:
    """Residual after the correction."""
    case, solution, tolerance = balancing.case, balancing.solution, balancing.tolerance
    largest = max(abs(phasor) for run in case.runs for phasor in run.motion)
    misfit = max(abs(deviation) for misfits in solution.misfits for deviation in misfits)
    return ResidualCheck(
        permitted_g_mm=None if tolerance is None else from_si(tolerance.whole, "g_mm"),
        rest_share=balancing.rest_share,
        reproduced=misfit / largest if largest else 0.0,
        disagreement=balancing.disagreement,
        verification=tuple(_verification(own, remainder) for own, remainder in _unlike(taken, balancing)),
        planes_share=balancing.planes_share,
        minimised=balancing.case.quantity if balancing.case.overdetermined else None,
    )


def _unlike(taken: Sequence[Taken], balancing: Found) -> list[tuple[Taken, Remainder]]:
    """A run of each speed and unit, with what remains at its speed."""
    kept: dict[tuple[int, str], tuple[Taken, Remainder]] = {}
    for number, (group, remainder) in enumerate(zip(balancing.case.speed_groups, balancing.remainders, strict=True)):
        for index in group:
            kept.setdefault((number, taken[index].instrument.shown), (taken[index], remainder))
    return list(kept.values())


def _verification(taken: Taken, remainder: Remainder) -> Verification:
    run, instrument = taken.run, taken.instrument
    scale = abs(reading_factor(run.quantity, remainder.speed))
    amplitudes = {"before": abs(remainder.now), "after": abs(remainder.after), "expected": remainder.expected,
                  "at_most": remainder.at_most}  # fmt: skip
    sensors = tuple(
        SensorVerification(
            name=name, **{key: instrument.reading(scale * float(own[k])) for key, own in amplitudes.items()}
        )
        for k, name in enumerate(taken.sensors)
    )
    sides = {
        f"{side}_{what}": next((getattr(sensor, what) for sensor in sensors if sensor.name == side), None)
        for side in ("left", "right")
        for what in ("before", "expected", "at_most")
    }
    return Verification(
        speed_rpm=from_si(run.speed, "rpm"), quantity=run.quantity, unit=instrument.shown, sensors=sensors, **sides
    )


def tolerance_result(balancing: Found) -> ToleranceResult | None:
    """Permitted imbalance, that now and that expected in the tolerance planes."""
    tolerance = balancing.tolerance
    if tolerance is None:
        return None
    now = tolerance.transformed(balancing.solution.imbalance)
    values = {
        f"{'single_plane' if name == 'single' else name}{what}_g_mm": from_si(abs(value), "g_mm")
        for what, planes in (("", tolerance.permitted), ("_now", now), ("_rest", balancing.rest_in_tolerance_planes))
        for name, value in zip(balancing.planes, planes, strict=True)
    }
    if tolerance.planes == "correction planes":
        rule = "all in the single plane" if len(now) == 1 else "half in each plane, since the lengths are not known"
    elif tolerance.overhung:
        rule = "lever rule, centre of mass outside the bearings, each share within 0.3 … 1.3 (unverified)"
    else:
        rule = "lever rule, each share within 0.3 … 0.7"
    return ToleranceResult(planes=tolerance.planes, rule=rule, whole_g_mm=from_si(tolerance.whole, "g_mm"), **values)


def trial_masses(readings: Readings, balancing: Found) -> tuple[TrialMassResult, ...]:
    """Trial masses for the next time, by the influence of the planes as found."""
    matrix = max(zip(balancing.case.runs, balancing.solution.influences, strict=True), key=lambda each: each[0].speed)[
        1
    ]
    return tuple(
        TrialMassResult(
            plane=balancing.planes[each.plane], mass_g=from_si(each.mass, "g"), safe_g=from_si(each.safe, "g"),
            visible_g=None if each.visible is None else from_si(each.visible, "g"), force_percent=100 * each.share,
        )
        for each in proposals(readings.tables, balancing.case.runs, matrix)
    )  # fmt: skip


def causes(balancing: Found) -> tuple[ErrorShare, ...]:
    """Each cause's part of the imbalance's uncertainty, that of the correction itself behind those of the answer."""
    Q, groups = balancing.target, dict[str, list[Vector]]()
    for change in balancing.by:
        groups.setdefault(change.cause, []).append(change.imbalance)
    groups["correction"] = list(balancing.placed)
    return tuple(
        ErrorShare(
            cause=cause,
            **{
                f"{'single_plane' if name == 'single' else name}_percent": _percent(Q[k], [each[k] for each in vectors])
                for k, name in enumerate(balancing.planes)
            },
        )
        for cause, vectors in groups.items()
    )


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


def _complexes(values: Vector) -> tuple[Complex, ...]:
    return tuple(map(_complex, values))


def complex_rows(matrix: Matrix) -> tuple[tuple[Complex, ...], ...]:
    """A matrix as real and imaginary parts."""
    return tuple(map(_complexes, matrix))


def balance_model(balancing: Found) -> BalanceModel:
    """The numbers behind it."""
    case, solution = balancing.case, balancing.solution
    return BalanceModel(
        method=solution.method,
        speeds_rad_per_s=tuple(run.speed for run in case.runs),
        displacements_m=tuple(_complexes(run.motion) for run in case.runs),
        placed_kg_m=tuple(_complexes(run.placed) for run in case.runs),
        imbalances_kg_m=_complexes(solution.imbalance),
        influence_m_per_kg_m=complex_rows(solution.influences[0]),
        natural_frequencies_rad_per_s=None if case.roll is None else natural_frequencies(case.roll),
        support_damping_N_s_per_m=None if case.roll is None else support_damping(case.roll),
        service_speed_rad_per_s=balancing.service_speed,
    )


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
    natural_frequencies_hz: Annotated[
        tuple[float, float] | None, Quantity("natural frequencies of the rig", "", 4, "roll on its supports, undamped")
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
    sensor_to_mark_deg: Annotated[float, Quantity("sensor of the mark", "", 4, "from the vibration sensors, first run")]
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
    if stored is not None:
        stored.refuse_others(file.planes, taken[0].sensors)
    with readings.located():
        balancing = find(file, taken, None if stored is None else stored.values)
    with_rotation = file.rotor.angle_marks == "with"
    planes = [plane_correction(plane, balancing, with_rotation) for plane in range(len(file.planes))]
    named = dict(zip(file.planes, planes, strict=True))

    text = None
    if balancing.solution.method == "trial masses":
        values = coefficients_of(balancing.case, balancing.solution, balancing.by)
        text = coefficients_text(file.rotor.name, file.planes, taken[0].sensors, values)
    residual = residual_check(balancing, taken)
    return BalanceResult(
        title=file.rotor.name,
        checks=balance_checks(balancing, taken),
        warnings=(*readings.warnings, *balance_warnings(file, taken, balancing, planes)),
        provenance=Provenance.of(readings),
        model=balance_model(balancing),
        method=balancing.solution.method,
        answer=file.correction.answer,
        fitted=len(file.correction.fitted),
        angle_marks=f"{file.rotor.angle_marks} rotation",
        left=named.get("left"),
        right=named.get("right"),
        single_plane=named.get("single"),
        residual_check=residual,
        tolerance=tolerance_result(balancing),
        runs=tuple(map(run_readings, taken)),
        natural_frequencies_hz=natural_hz(balancing.case),
        influence_coefficients=complex_rows(balancing.solution.influences[0]),
        coefficients_file=None if stored is None else stored.file,
        predicted=tuple(
            Predicted(
                sensor=sensor.name, speed_rpm=run.speed_rpm, measured=sensor.before, after=sensor.after, unit=run.unit
            )
            for run in residual.verification
            for sensor in run.sensors
        ),
        uncertainty_by_cause=causes(balancing),
        trial_masses=trial_masses(readings, balancing),
        sensor_to_mark_deg=math.degrees(taken[0].run.sensor),
        turns_from_left=file.rotor.turns_from_left,
        coefficients_text=text,
    )
