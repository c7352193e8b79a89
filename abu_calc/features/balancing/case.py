"""Readings in SI: the roll on its rig, its runs and their errors, with recorded runs evaluated."""

import hashlib
import math
from typing import Final

from abu_calc.features.balancing.errors import Deviations
from abu_calc.features.balancing.formulas import RollOnRig
from abu_calc.features.balancing.read import Readings
from abu_calc.features.balancing.recorded_run import RecordedRun, read_rig_record, recorded_run
from abu_calc.features.balancing.tables import Errors, ReadingsFile, Rotor, Run, Trial
from abu_calc.features.balancing.two_planes import Balancing, RunOnRig, TrialMass
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import SYMBOLS, from_si, to_si

UNITS: Final = {"displacement": "mm", "velocity": "mm_per_s", "acceleration": "m_per_s2"}
"""Units of amplitudes, by quantity."""
PLANES: Final = ("left", "right")

WIDE_PULSE: Final = math.radians(1.0)
UNSURE: Final = math.radians(0.5)
DRIFT: Final = 0.02
CHANGE: Final = 0.05
SHARE: Final = 0.3
"""Thresholds from which a record is warned of.

Two are in rad: width of the pulse, and uncertainty of the angles. Two are relative: drift of the speed, and
of the amplitude. `SHARE` is the least share of the rotation in what a sensor shows.
"""


@dataclass(frozen=True)
class Taken:
    """A run in SI, and the record it comes from."""

    run: RunOnRig
    record: RecordedRun | None = None
    file: str | None = None
    sha256: str | None = None


def unit_of_readings(quantity: str) -> str:
    """The unit of amplitudes as printed.

    >>> unit_of_readings("acceleration")
    'm/s²'
    """
    return SYMBOLS.get(UNITS[quantity], UNITS[quantity])


def taken_runs(readings: Readings) -> tuple[Taken, ...]:
    """Every run; records are read and evaluated. Raises InputError with the place of what is wrong."""
    file = readings.tables
    return tuple(_taken(readings, file, index, run) for index, run in enumerate(file.run))


def _taken(readings: Readings, file: ReadingsFile, index: int, run: Run) -> Taken:
    weights = tuple(_weight(file.rotor, trial) for trial in run.trial)
    sensor = math.radians(run.sensor_to_mark_deg)
    given = None if run.speed_rpm is None else to_si(run.speed_rpm, "rpm")
    if run.file is not None:
        return _recorded(readings, index, run, given, sensor, weights)
    if run.left is None or run.right is None or given is None:
        raise InputError("the run has no readings", place=Place(key=f"run[{index}]"))
    unit = UNITS[run.quantity]
    return Taken(
        RunOnRig(
            given, run.quantity, (to_si(run.left.amplitude, unit), to_si(run.right.amplitude, unit)),
            (math.radians(run.left.phase_deg), math.radians(run.right.phase_deg)), sensor, weights,
        )
    )  # fmt: skip


def _recorded(
    readings: Readings, index: int, run: Run, speed: float | None, sensor: float, weights: tuple[TrialMass, ...]
) -> Taken:
    path, unit = readings.beside(run.file or ""), UNITS[run.quantity]
    samples = read_rig_record(path)
    try:
        record = recorded_run(samples, run.mark_edge, speed)
    except InputError as error:
        raise error.at(Place(str(path))) from None
    tones = (record.left, record.right)
    made = RunOnRig(
        record.speed, run.quantity, (to_si(tones[0].amplitude, unit), to_si(tones[1].amplitude, unit)),
        (tones[0].phase, tones[1].phase), sensor, weights,
        (to_si(tones[0].noise, unit), to_si(tones[1].noise, unit)), record.unsure,
    )  # fmt: skip
    return Taken(made, record, run.file, hashlib.sha256(path.read_bytes()).hexdigest())


def _weight(rotor: Rotor, trial: Trial) -> TrialMass:
    own = rotor.left_correction_radius_mm if trial.plane == "left" else rotor.right_correction_radius_mm
    radius = own if trial.radius_mm is None else trial.radius_mm
    return TrialMass(
        PLANES.index(trial.plane), to_si(trial.mass_g, "g"), to_si(radius, "mm"), math.radians(trial.angle_deg)
    )


def balancing(file: ReadingsFile, runs: tuple[Taken, ...]) -> Balancing:
    """All data that an answer is made of."""
    return Balancing(_roll(file), tuple(taken.run for taken in runs))


def _roll(file: ReadingsFile) -> RollOnRig | None:
    rig, rotor = file.rig, file.rotor
    if rig is None:
        return None
    lengths = (
        rotor.left_end_to_left_plane_m, rotor.left_plane_to_centre_m, rotor.centre_to_right_plane_m,
        rotor.right_plane_to_right_end_m,
    )  # fmt: skip
    a, b, c, d = (length or 0.0 for length in lengths)
    return RollOnRig(
        rig.left_support_mass_kg, rig.right_support_mass_kg, rig.left_stiffness_N_per_m, rig.right_stiffness_N_per_m,
        rig.damping_ratio, rotor.mass_kg or 0.0, rotor.transverse_inertia_kg_m2 or 0.0, a, b, c, d,
    )  # fmt: skip


def deviations(errors: Errors) -> Deviations:
    """The errors of the file in SI."""
    return Deviations(
        errors.amplitude_percent / 100, math.radians(errors.phase_deg), errors.speed_percent / 100,
        errors.support_mass_percent / 100, errors.stiffness_percent / 100, errors.damping_ratio,
        errors.rotor_mass_percent / 100, errors.inertia_percent / 100, to_si(errors.length_mm, "mm"),
        errors.placed_mass_percent / 100, math.radians(errors.placed_angle_deg),
    )  # fmt: skip


def record_warnings(taken: Taken) -> list[str]:
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
            f"mean, {from_si(record.speed, 'rpm'):.1f} rpm."
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
