"""Readings in SI: the rotor on its rig, its runs and their errors, with recorded runs evaluated."""

import hashlib
import math
from collections.abc import Sequence
from typing import Annotated, ClassVar, Final

from abu_calc.features.balancing.corrections import Drill, Making
from abu_calc.features.balancing.formulas import RollOnRig
from abu_calc.features.balancing.read import Readings
from abu_calc.features.balancing.recorded_run import RecordedRun, read_rig_record, recorded_run
from abu_calc.features.balancing.run_tables import Instrument
from abu_calc.features.balancing.runs import Balancing, Coefficients, RunOnRig, TrialMass
from abu_calc.features.balancing.tables import PLANES, ReadingsFile, Run, Trial
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown, wrapped_deg

WIDE_PULSE: Final = math.radians(1.0)
UNSURE: Final = math.radians(0.5)
DRIFT: Final = 0.02
CHANGE: Final = 0.05
SHARE: Final = 0.3
"""Thresholds from which a record is warned of.

Two are in rad: width of the pulse, and uncertainty of the angles. Two are relative: drift of the speed, and
of the amplitude. `SHARE` is the least share of the rotation in what a sensor shows.
"""


@record
class SensorReading(Record):
    """Reading of a sensor, in the unit of the run."""

    name: Annotated[str, Quantity("sensor")]
    amplitude: Annotated[float, Quantity("amplitude", "A_j", 5, "in the unit of the run")]
    phase_deg: Annotated[float | None, Quantity("phase", "ψ_j", 5, "by the convention of the run, −180 … 180")]


@record
class RunReadings(Record):
    """A run as it was taken; of a recorded one the data of its marks."""

    left_out: ClassVar[frozenset[str]] = frozenset({"run", "instrument", "convention", "record"})
    optional: ClassVar[frozenset[str]] = frozenset({"left", "right"})

    run: RunOnRig
    instrument: Instrument
    convention: str | None
    """Convention of the phases as the file names it."""
    record: RecordedRun | None
    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    quantity: Annotated[str, Quantity("quantity", "", 4, "displacement, velocity or acceleration")]
    unit: Annotated[str, Quantity("unit of amplitudes", "", 4, "0–peak if it names no kind of amplitude")]
    phase: Annotated[str | None, Quantity("phases", "", 4, "lag: A·cos(ωt − phase), lead: A·cos(ωt + phase)")]
    left: SensorReading | None
    right: SensorReading | None
    sensors: tuple[SensorReading, ...]
    file: Annotated[str | None, Quantity("recorded in")]
    sha256: Annotated[str | None, Quantity("SHA-256 of the record")]
    revolutions: Annotated[int | None, Quantity("revolutions evaluated")]
    mark_edge: Annotated[
        str | None, Quantity("passage of the mark by", "", 4, "leading, middle or trailing of a pulse")
    ]
    trials: Annotated[int, Quantity("known masses that were on")]


def taken_runs(readings: Readings) -> tuple[RunReadings, ...]:
    """Every run; records are read and evaluated. Raises InputError with the place of what is wrong."""
    file = readings.tables
    return tuple(_taken(readings, file, index, run) for index, run in enumerate(file.run))


def _taken(readings: Readings, file: ReadingsFile, index: int, run: Run) -> RunReadings:
    weights = tuple(mass_of(file, trial) for trial in run.trial)
    sensor = math.radians(run.sensor_to_mark_deg)
    given = run.speed
    if run.file is not None:
        return _recorded(readings, run, given, sensor, weights, len(file.planes))
    if given is None:
        raise InputError("the run has no speed", place=Place(key=f"run[{index}]"))
    instrument, sense = run.instrument, -1.0 if run.phase == "lead" else 1.0
    values = [reading for _, reading in run.sensors]
    amplitudes = tuple(instrument.amplitude(reading.amplitude) for reading in values)
    phases = tuple(sense * math.radians(each.phase_deg) for each in values if each.phase_deg is not None)
    names = tuple(name for name, _ in run.sensors)
    made = RunOnRig(given, instrument.quantity, amplitudes, phases, sensor, weights, planes=len(file.planes))
    return _as_taken(made, instrument, names, convention=run.phase)


def _recorded(
    readings: Readings, run: Run, speed: float | None, sensor: float, weights: tuple[TrialMass, ...], planes: int
) -> RunReadings:
    path, instrument = readings.beside(run.file or ""), run.instrument
    samples = read_rig_record(path)
    try:
        record = recorded_run(samples, run.mark_edge, speed)
    except InputError as error:
        raise error.at(Place(str(path))) from None
    tones = (record.left, record.right)
    made = RunOnRig(
        record.speed, instrument.quantity, tuple(instrument.amplitude(tone.amplitude) for tone in tones),
        tuple(tone.phase for tone in tones), sensor, weights,
        tuple(instrument.amplitude(tone.noise) for tone in tones), record.unsure, planes,
    )  # fmt: skip
    sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
    return _as_taken(made, instrument, PLANES, record=record, file=run.file, sha256=sha256)


def _as_taken(
    run: RunOnRig, instrument: Instrument, names: Sequence[str], *, convention: str | None = None,
    record: RecordedRun | None = None, file: str | None = None, sha256: str | None = None,
) -> RunReadings:  # fmt: skip
    sense = -1.0 if convention == "lead" else 1.0
    phases = [None if phase is None else wrapped_deg(sense * phase) for phase in run.phases or [None] * len(names)]
    sensors = {
        name: SensorReading(name=name, amplitude=instrument.reading(amplitude), phase_deg=phase)
        for name, amplitude, phase in zip(names, run.amplitudes, phases, strict=True)
    }
    return RunReadings(
        run=run, instrument=instrument, convention=convention, record=record, speed=run.speed, quantity=run.quantity,
        unit=instrument.shown, phase=(convention or "lag") if run.phases else None, left=sensors.get("left"),
        right=sensors.get("right"), sensors=tuple(sensors.values()), file=file, sha256=sha256,
        revolutions=record.revolutions if record else None, mark_edge=record.marks.edge if record else None,
        trials=len(run.weights),
    )  # fmt: skip


def mass_of(file: ReadingsFile, trial: Trial) -> TrialMass:
    """A trial mass, or one that is fitted, in SI; its angle behind the mark."""
    plane = 0 if trial.plane is None else PLANES.index(trial.plane)
    radius = file.radii[plane] if trial.radius is None else trial.radius
    angle = behind_the_mark(file, trial.angle_deg)
    return TrialMass(plane, trial.mass, radius, angle)


def behind_the_mark(file: ReadingsFile, angle_deg: float) -> float:
    """An angle on the rotor's marks [degrees] as the angle against rotation from the zero mark [rad]."""
    return math.radians(angle_deg) * (1 if file.rotor.angle_marks == "against" else -1)


def making_of(file: ReadingsFile) -> Making:
    """Limits, stock and drill of the corrections in SI."""
    how, drill = file.correction, None
    if how.drill_diameter_mm is not None:
        drill = Drill(
            how.drill_diameter, how.density, how.drill_direction == "radial", how.drill_point or math.pi,
            how.max_hole_depth,
        )  # fmt: skip
    return Making(
        file.rotor.max_removable, how.max_added, how.max_per_place, tuple(sorted(how.stock_weights or ())), drill,
        how.hole_spacing,
    )  # fmt: skip


def balancing(file: ReadingsFile, runs: tuple[RunReadings, ...], coefficients: Coefficients | None = None) -> Balancing:
    """All data that an answer is made of."""
    return Balancing(_roll(file), tuple(taken.run for taken in runs), coefficients)


def _roll(file: ReadingsFile) -> RollOnRig | None:
    rig, rotor = file.rig, file.rotor
    if rig is None:
        return None
    a, b, c, d = rotor.lengths or (0.0,) * 4
    return RollOnRig(
        rig.left_support_mass_kg, rig.right_support_mass_kg, rig.left_stiffness_N_per_m, rig.right_stiffness_N_per_m,
        rig.damping_ratio, rotor.mass_kg or 0.0, rotor.transverse_inertia_kg_m2 or 0.0, a, b, c, d,
    )  # fmt: skip


def record_warnings(taken: RunReadings) -> list[str]:
    """Warnings about a record."""
    record, file = taken.record, taken.file
    if record is None:
        return []
    lines = []
    pulse, edge = math.degrees(record.pulse), record.marks.edge
    if record.pulse > WIDE_PULSE:
        other, turn = ("its middle", pulse / 2) if edge == "leading" else ("its leading edge", pulse / 2)
        shape = "square" if record.marks.square else "rounded"
        lines.append(
            f"{file}: a pulse of the mark lasts {pulse:.1f}°, {shape}; its {_edge(edge)} counts as the passage. By "
            f"{other} every angle would differ by {turn:.1f}°. Specify run.mark_edge."
        )
    if record.unsure > UNSURE:
        lines.append(
            f"{file}: the samples go in step with the rotation, so the passage of the mark and every angle are "
            f"known to {math.degrees(record.unsure):.1f}° only. Sample faster."
        )
    if abs(record.drift) > DRIFT:
        lines.append(
            f"{file}: the speed drifts by {100 * record.drift:+.1f} % over the record; the readings are those of its "
            f"mean, {shown(record.speed, 'rpm', '.1f')}."
        )
    for name, tone in (("left", record.left), ("right", record.right)):
        if abs(tone.change) > CHANGE:
            lines.append(
                f"{file}: amplitude and phase on the {name} change by {100 * tone.change:.0f} % over the record: "
                "something else may turn at nearly this speed, or the run was not steady."
            )
        if tone.share < SHARE:
            lines.append(
                f"{file}: of what the {name} sensor shows only {100 * tone.share:.0f} % turns with the rotor; its "
                f"amplitude is sure to {100 * tone.noise / tone.amplitude if tone.amplitude else 100:.2g} %."
            )
    return lines


def _edge(edge: str) -> str:
    return edge if edge == "middle" else f"{edge} edge"
