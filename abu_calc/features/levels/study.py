"""Octave levels, weighted acceleration and daily exposure, of a recorded signal or of a simulated motion."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Final

from abu_calc.dynamics.scene import Scene
from abu_calc.features.levels.levels import (
    LAST,
    AxisLevel,
    Band,
    PlaceLevels,
    axis_levels,
    axis_place_levels,
    duration_for,
    halves_differ,
    held_levels,
    held_loads,
    largest,
    level,
    level_checks,
    moved_at,
    times_for,
)
from abu_calc.features.levels.octaves import SHARE_OF_NYQUIST, AxisSignal, folded_share, needed_rate, octave_filter
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.rows import Rows
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.inputs.recording import Recording
from abu_calc.inputs.recording_columns import QUANTITIES
from abu_calc.inputs.recording_files import is_recording, read_recording
from abu_calc.simulation.arguments import checked, one_of
from abu_calc.simulation.predicted_level import compared_starts, starts_for_measurement
from abu_calc.simulation.result import Provenance, Result
from abu_calc.simulation.scene_file import SceneDescription, read_any
from abu_calc.simulation.simulate import ACCURACY
from abu_calc.simulation.subject import Subject, simulate_chosen, subject_of
from abu_calc.simulation.vibration_records import MeasuredAfterRecord, measured_place
from abu_calc.sizing.design import Design
from abu_calc.standards.vibration import Octave, ThirdOctave, daily_exposure, octaves


@record
class OctaveLevel(Record):
    """One octave, on the axis where it is loudest; no level where the record does not tell it."""

    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    nominal_hz: Annotated[float, Quantity("octave")]
    low: Annotated[float, Quantity("from", "", 5, unit="hz")]
    high: Annotated[float, Quantity("to", "", 5, unit="hz")]
    limit_db: Annotated[float, Quantity("limit")]
    level_db: Annotated[float | None, Quantity("level", "L")]
    velocity_rms: Annotated[float | None, Quantity("velocity rms", "v", unit="mm_per_s")]
    why_not: Annotated[str | None, Quantity("why it is not known")]


@record
class ThirdOctaveLevel(Record):
    """One third octave, on the axis where it is loudest; no level if the record does not give it."""

    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    nominal_hz: Annotated[float, Quantity("third octave")]
    low: Annotated[float, Quantity("from", "", 5, unit="hz")]
    high: Annotated[float, Quantity("to", "", 5, unit="hz")]
    level_db: Annotated[float | None, Quantity("level", "L")]
    velocity_rms: Annotated[float | None, Quantity("velocity rms", "v", unit="mm_per_s")]
    why_not: Annotated[str | None, Quantity("why it is not known")]


@record
class PlaceLevel(Record):
    """One place: its loudest axis, by octaves, corrected; the vector total of its weighted accelerations."""

    optional: ClassVar[frozenset[str]] = frozenset(
        {"level_before_db", "static_load_without_N", "static_load_N", "daily_exposure_m_per_s2", "third_octaves"}
    )

    name: Annotated[str, Quantity("place")]
    level_db: Annotated[float | None, Quantity("level", "L", 4, "rms of the louder axis")]
    velocity_rms: Annotated[float | None, Quantity("velocity rms", "v", unit="mm_per_s")]
    octaves: tuple[OctaveLevel, ...]
    third_octaves: tuple[ThirdOctaveLevel, ...] | None
    corrected_level_db: Annotated[
        float | None, Quantity("weighted overall level", "L", 4, "of the octaves that are known")
    ]
    displacement_rms: Annotated[float | None, Quantity("displacement rms", "s_v", 3, "of the louder axis", unit="um")]
    acceleration_m_per_s2: Annotated[float | None, Quantity("acceleration", "a", 3, "rms, not weighted, louder axis")]
    weighted_axis_m_per_s2: Annotated[float | None, Quantity("weighted acceleration of one axis", "a_h", 3)]
    weighted_acceleration_m_per_s2: Annotated[
        float | None, Quantity("weighted acceleration", "a_hv", 3, "vector total of the axes that there are")
    ]
    daily_exposure_m_per_s2: Annotated[float | None, Quantity("daily exposure", "A(8)", 3)]
    axes: tuple[AxisLevel, ...]
    level_before_db: Annotated[float | None, Quantity("level without autobalancer", "L")]
    static_load_without_N: Annotated[float | None, Quantity("static load of the hand without autobalancer", "", 3)]
    static_load_N: Annotated[float | None, Quantity("static load of the hand", "", 3)]


SCENES: Final = ("idle", "grinding")
"""Scenes of a machine that is held in the hands."""
MINUTES: Final = Range("minutes a day", 0.0, 1440.0, "min", open_low=True, key="minutes")
START: Final = Range("where means begin", 0.0, unit="s", key="from_s")
FOLDED: Final = 1e-3
"""Share of the power near half the sampling rate, above which faster motion may have been folded into the octaves."""
USUAL_DB: Final = (60, 140)
UNSTEADY_DB: Final = 2.0
"""Largest difference between two halves of a record that gives no remark [dB]."""


@record
class LevelsResult(Result):
    """Levels by octaves; those at the top are of the loudest place."""

    command: ClassVar[str] = "levels"
    optional: ClassVar[frozenset[str]] = frozenset({"scene", "measured_after", "minutes", "daily_exposure_m_per_s2"})

    source: Annotated[str, Quantity("source", "", 4, "recording or simulation")]
    scene: Annotated[str | None, Quantity("scene")]
    quantity: Annotated[str, Quantity("quantity")]
    sampling_rate_hz: Annotated[float, Quantity("sampling rate", "", 6)]
    duration_s: Annotated[float, Quantity("duration")]
    averaged_from_s: Annotated[float, Quantity("averaged from", "", 4, "the time before lets the filters settle")]
    minutes: Annotated[float | None, Quantity("minutes a day")]
    loudest_place: Annotated[str, Quantity("loudest place")]
    level_db: Annotated[float | None, Quantity("level", "L", 4, "rms of the louder axis")]
    velocity_rms: Annotated[float | None, Quantity("velocity rms", "v", unit="mm_per_s")]
    octaves: tuple[OctaveLevel, ...]
    corrected_level_db: Annotated[float | None, Quantity("weighted overall level", "L")]
    weighted_acceleration_m_per_s2: Annotated[float | None, Quantity("weighted acceleration", "a_hv", 3)]
    daily_exposure_m_per_s2: Annotated[float | None, Quantity("daily exposure", "A(8)", 3)]
    places: tuple[PlaceLevel, ...]
    measured_after: MeasuredAfterRecord | None

    @property
    def levels(self) -> Rows[OctaveLevel]:
        """The octaves as a table, at the loudest place; those of each place are `places`."""
        return Rows(self.octaves)


@checked
def levels(
    source: Machine | SceneDescription | Scene | Recording | str | Path,
    scene: str | None = None,
    *,
    quantity: str | None = None,
    scale: float | None = None,
    channels: Sequence[str] = (),
    sensitivity: float | str | Sequence[float | str] | Mapping[str, float | str] | None = None,
    handles: Mapping[str, Sequence[str]] | None = None,
    full_scale_mV: float | None = None,
    third_octaves: bool = False,
    minutes: float | None = None,
    from_s: float | None = None,
    rate_hz: float | None = None,
    time: str | None = None,
    skip: int = 0,
    start: str | None = None,
    accuracy: float = 0.01,
    duration_s: float | None = None,
    progress: Progress = silent,
) -> LevelsResult:
    """Levels of a recorded signal (a CSV or WAV file), or of a machine or scene that is simulated.

    `quantity`, `scale`, `channels`, `sensitivity`, `handles`, `full_scale_mV`, `rate_hz`, `time`, `skip`: how a file is
    to be taken, see `read_recording`; `from_s`: where its means begin. `third_octaves`: levels by them beside octaves.
    `scene`: of a machine, idle or grinding, from the `start` of its balls (bunched); `minutes`: of work a day, for
    A(8). Raises InputError with file, line and column, NotTrustworthyError where a simulation does not reach the
    accuracy.
    """
    if minutes is not None:
        MINUTES.check(minutes)
    if isinstance(source, (str, Path)):
        file = str(source)
        if is_recording(file):
            source = read_recording(
                file, quantity, scale, channels, sensitivity=sensitivity, handles=handles, full_scale_mV=full_scale_mV,
                rate_hz=rate_hz, time=time, skip=skip,
            )  # fmt: skip
            quantity = scale = sensitivity = handles = full_scale_mV = rate_hz = time = None
            channels, skip = (), 0
        else:
            source = read_any(file)
    if isinstance(source, Recording):
        _only_for("a machine", scene=scene, start=start, duration_s=duration_s)
        return _of_recording(source, minutes, from_s, thirds=third_octaves)
    how_read = {"sensitivity": sensitivity, "handles": handles, "full_scale_mV": full_scale_mV, "from_s": from_s,
                "rate_hz": rate_hz, "time": time, "skip": skip or None}  # fmt: skip
    _only_for("a recorded file", quantity=quantity, scale=scale, channels=channels or None, **how_read)
    one_of("scene", scene, SCENES)
    ACCURACY.check(accuracy)
    subject = subject_of(source, scene, start, command="levels")
    return _of_motion(subject, minutes, accuracy, duration_s, progress, thirds=third_octaves)


def _only_for(what: str, **given: object) -> None:
    for name, value in given.items():
        if value is not None:
            raise InputError(f"for {what} only", place=Place(key=name), found=f"{value}", remedy="Leave it out.")


def _of_recording(recorded: Recording, minutes: float | None, from_s: float | None, *, thirds: bool) -> LevelsResult:
    lowest = octave_filter(octaves()[0])
    if lowest.high > SHARE_OF_NYQUIST * math.pi * recorded.rate:
        raise InputError(
            "sampled too slowly for any octave",
            place=Place(recorded.file),
            found=f"{recorded.rate:.4g} samples a second",
            allowed=f"at least {needed_rate(lowest):.3g}",
            remedy="Check the unit of the time column.",
        )
    start, derivative = _start(recorded, from_s), QUANTITIES.index(recorded.quantity)
    signals = [AxisSignal(values, recorded.rate, 1 - derivative, start, from_s is None) for values in recorded.samples]
    axes = [axis_levels(name, signal, thirds=thirds) for name, signal in zip(recorded.names, signals, strict=True)]
    places = tuple(
        PlaceLevels(handle or "file", tuple(axes[k] for k in members))
        for handle, members in recorded.axes_by_handle.items()
    )
    loudest = level(largest(place.velocity for place in places))
    return _result(
        Path(recorded.file).name,
        tuple(_place_level(place, minutes) for place in places),
        checks=level_checks(places, minutes, recorded.assumed),
        warnings=(*recorded.remarks, *_remarks(recorded, signals), *_unusual(loudest)),
        provenance=Provenance.today(recorded.file, recorded.sha256),
        source="recording",
        quantity=recorded.quantity,
        sampling_rate_hz=recorded.rate,
        duration_s=recorded.duration,
        averaged_from_s=start,
        minutes=minutes,
    )


def _start(recorded: Recording, from_s: float | None) -> float:
    """Time at which means begin [s]: of a simulated run as in `abu simulate`, with its last twentieth."""
    if from_s is None:
        return LAST * recorded.duration if recorded.simulated else 0.0
    replace(START, high=recorded.duration).check(from_s)
    return from_s


def _remarks(recorded: Recording, signals: Sequence[AxisSignal]) -> Iterator[str]:
    if recorded.simulated and signals[0].whole:
        yield "The file is a trajectory of a simulation: means are taken over its last twentieth."
    folded = max(map(folded_share, signals))
    if folded > FOLDED:
        yield (
            f"{100 * folded:.2g} % of the signal's power lies near half the sampling rate: faster motion may have been "
            "folded into the octaves. Sample faster, with a filter before the sampling."
        )
    for name, signal in zip(recorded.names, signals, strict=True):
        change = halves_differ(signal)
        if change is not None and abs(change) > UNSTEADY_DB:
            word = "louder" if change > 0 else "quieter"
            yield (
                f"{name}: the second half is {abs(change):.1f} dB {word} than the first. --from S leaves the start out."
            )


def _unusual(level_db: float | None) -> Iterator[str]:
    """A level that hardly any machine has."""
    if level_db is not None and not USUAL_DB[0] <= level_db <= USUAL_DB[1]:
        yield (
            f"{level_db:.0f} dB is unusual, {USUAL_DB[0]} … {USUAL_DB[1]} dB is usual. Check unit and scale of "
            "the file."
        )


def _of_motion(
    subject: Subject,
    minutes: float | None,
    accuracy: float,
    duration_s: float | None,
    progress: Progress,
    *,
    thirds: bool,
) -> LevelsResult:
    design = subject.design
    subject = subject.lasting(duration_for(subject.scene) if duration_s is None else duration_s)
    times = times_for(subject.scene)
    _, run = simulate_chosen(subject.ledger(accuracy), accuracy, times, progress=progress)
    at_axis = axis_place_levels(run, times, "axis", thirds=thirds)
    places = (at_axis,) if design is None else held_levels(design, at_axis)
    idle = subject.scene.name == "idle"
    return _result(
        subject.title,
        _with_design(design, places, minutes, idle=idle),
        checks=level_checks(places, minutes),
        warnings=(*subject.warnings, *run.warnings, *_held_remarks(design, subject.start)),
        provenance=subject.provenance,
        source="simulation",
        scene=subject.scene.name,
        quantity="velocity",
        sampling_rate_hz=(len(times) - 1) / float(times[-1] - times[0]),
        duration_s=subject.scene.duration,
        averaged_from_s=LAST * subject.scene.duration,
        minutes=minutes,
        measured_after=design and _measured(design, at_axis, progress, idle=idle),
    )


def _with_design(
    design: Design | None, places: Sequence[PlaceLevels], minutes: float | None, *, idle: bool
) -> tuple[PlaceLevel, ...]:
    """Levels, with those without autobalancer, idle, and the loads of the hands beside them."""
    before = {place.name: place.levels.before for place in design.idle.places} if design and idle else {}
    loads = held_loads(design) if design else {}
    return tuple(_place_level(place, minutes, before.get(place.name), loads.get(place.name)) for place in places)


def _place_level(
    place: PlaceLevels, minutes: float | None, before: float | None = None,
    loads: tuple[float | None, float | None] | None = None,
) -> PlaceLevel:  # fmt: skip
    """`minutes` of a day, level `before` [dB]; `loads` [N]: without and with the autobalancer."""
    total, (bare, fitted) = place.total, loads or (None, None)
    return PlaceLevel(
        name=place.name,
        level_db=level(place.velocity),
        velocity_rms=place.velocity,
        octaves=tuple(OctaveLevel(limit_db=float(band.octave.limit.level), **_entries(band)) for band in place.loudest),
        third_octaves=tuple(ThirdOctaveLevel(**_entries(band)) for band in place.loudest_thirds) or None,
        corrected_level_db=level(place.corrected),
        displacement_rms=place.louder("displacement_rms"),
        acceleration_m_per_s2=place.louder("acceleration"),
        weighted_axis_m_per_s2=place.louder("weighted_acceleration"),
        weighted_acceleration_m_per_s2=total,
        daily_exposure_m_per_s2=None if minutes is None or total is None else daily_exposure(total, 60 * minutes),
        axes=place.axes,
        level_before_db=before,
        static_load_without_N=bare,
        static_load_N=fitted,
    )


def _entries(band: Band[Octave] | Band[ThirdOctave]) -> dict[str, Any]:
    """Entries that an octave and a third octave have."""
    return {
        "nominal_hz": float(band.octave.nominal), "low": band.octave.low, "high": band.octave.high,
        "level_db": level(band.velocity), "velocity_rms": band.velocity, "why_not": band.reason,
    }  # fmt: skip


def _measured(design: Design, at_axis: PlaceLevels, progress: Progress, *, idle: bool) -> MeasuredAfterRecord | None:
    """[measured_after] against the median of the start cases, with the level of this run at the same place."""
    table = design.case.table.measured_after
    if table is None or table.shown is None:
        return None
    level_db = level(moved_at(design, at_axis, *measured_place(design.case, table.shown)).velocity)
    levels = (None, level_db) if idle else (level_db, None)
    return compared_starts(design, starts_for_measurement(design, progress), *levels)


def _held_remarks(design: Design | None, start: str) -> Iterator[str]:
    """Remarks on what the levels lack."""
    if design is None:
        return
    yield f"One start case is simulated: {start}. Others may be louder: `abu size FILE` simulates many."
    if design.case.background_level is not None:
        yield (
            f"These levels leave out the background of {design.case.background_level:g} dB: its octaves are not known."
        )
    if design.case.handles and not held_loads(design):
        yield (
            "The load on each hand is not known. It requires two handles on a horizontal spindle and the rigid body "
            "(machine.transverse_inertia_kg_m2 and machine.center_of_mass_to_wheel_mm)."
        )


def _result(title: str, places: tuple[PlaceLevel, ...], **others: Any) -> LevelsResult:
    """The loudest place stands at the top."""
    loudest = max(places, key=lambda place: place.level_db or -math.inf)
    others = {"scene": None, "measured_after": None} | others
    same = (
        *("level_db", "velocity_rms", "octaves", "corrected_level_db", "weighted_acceleration_m_per_s2"),
        "daily_exposure_m_per_s2",
    )
    shared = {name: getattr(loudest, name) for name in same}
    return LevelsResult(title=title, loudest_place=loudest.name, places=places, **shared, **others)
