"""The declared vibration value of measured runs: operators × runs × handles, three axes each."""

import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from statistics import fmean, stdev
from typing import Annotated, ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.features.declare.measured_checks import Calibrated, Series, measured_checks
from abu_calc.features.declare.read import Recordings, Run, loaded, of_files, remark_in_list, runs_of
from abu_calc.features.levels.octaves import AxisSignal, Filter, acceleration_filter, band_rms, hand_arm_filter, why_not
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, Stage, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.recording import MOST_AXES, Recording
from abu_calc.inputs.recording_columns import QUANTITIES
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result
from abu_calc.standards.type_test import balancing_factor, declared_uncertainty, reproducibility, uncertainty_source

MOST_NAMED: Final = 3


@record
class MeasuredAxis(Record):
    """One axis of a run."""

    name: Annotated[str, Quantity("axis")]
    a_hw_m_per_s2: Annotated[float | None, Quantity("weighted acceleration", "a_h", 4)]
    overload: Annotated[bool, Quantity("stays at its largest value")]


@record
class MeasuredRun(Record):
    """One run at one handle."""

    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    operator: Annotated[str, Quantity("operator")]
    run: Annotated[int, Quantity("run")]
    handle: Annotated[str, Quantity("handle")]
    a_hv_m_per_s2: Annotated[float | None, Quantity("vector total", "a_hv", 4)]
    axes: tuple[MeasuredAxis, ...]
    duration_s: Annotated[float, Quantity("duration", "", 3)]
    overload: Annotated[bool, Quantity("stays at its largest value")]
    why_not: Annotated[str | None, Quantity("why it is not known")]


@record
class MeasuredSeries(Record):
    """The runs of one operator at one handle."""

    operator: Annotated[str, Quantity("operator")]
    handle: Annotated[str, Quantity("handle")]
    runs: Annotated[int, Quantity("runs")]
    mean_m_per_s2: Annotated[float | None, Quantity("mean", "a_hv", 4)]
    standard_deviation_m_per_s2: Annotated[float | None, Quantity("standard deviation", "", 3)]
    coefficient_of_variation: Annotated[float | None, Quantity("coefficient of variation", "", 3)]


@record
class MeasuredHandle(Record):
    """A handle: the mean over its operators."""

    name: Annotated[str, Quantity("handle")]
    a_hv_m_per_s2: Annotated[float | None, Quantity("mean over operators", "a_hv", 4)]
    standard_deviation_m_per_s2: Annotated[
        float | None, Quantity("standard deviation of the operators' means", "s_m", 3)
    ]


@record
class MeasuredChannel(Record):
    """One channel of a calibrator run."""

    file: Annotated[str, Quantity("file")]
    name: Annotated[str, Quantity("channel")]
    acceleration_m_per_s2: Annotated[float | None, Quantity("measured, rms", "", 4)]
    true_m_per_s2: Annotated[float, Quantity("calibrator, rms", "", 4)]
    ratio: Annotated[float | None, Quantity("measured over calibrator", "", 4)]
    overload: Annotated[bool, Quantity("stays at its largest value")]


@record
class MeasuredDeclareResult(Result):
    """A type test evaluated from its recordings."""

    command: ClassVar[str] = "declare"

    a_hd_m_per_s2: Annotated[float | None, Quantity("vibration value", "a_hd", 4, "highest handle, without factor")]
    handle: Annotated[str | None, Quantity("highest handle")]
    factor: Annotated[float, Quantity("factor for automatic balancing", "k_d", 2)]
    declared_m_per_s2: Annotated[float | None, Quantity("declared", "", 4, "the value times the factor")]
    K_m_per_s2: Annotated[float | None, Quantity("uncertainty", "K_d", 3)]
    s_R_m_per_s2: Annotated[float | None, Quantity("standard deviation of reproducibility", "s_R", 3)]
    coefficient_of_variation: Annotated[
        float | None, Quantity("coefficient of variation", "", 3, "largest of the series at the highest handle")
    ]
    handles: tuple[MeasuredHandle, ...]
    series: tuple[MeasuredSeries, ...]
    runs: tuple[MeasuredRun, ...]
    calibration: tuple[MeasuredChannel, ...]


@dataclass(frozen=True, eq=False)
class _Measured:
    """Axes of one handle in one run, from one file or several."""

    operator: str
    number: int
    handle: str
    parts: tuple[Run, ...]
    record: MeasuredRun


@checked
def declare_recordings(
    recordings: Recordings | Sequence[str], *, sensitivity: Sequence[str] = (), automatic_balancing: bool = False,
    progress: Progress = silent,
) -> MeasuredDeclareResult:  # fmt: skip
    """Evaluate the recordings of a type test: a file that lists them, as read, or names of recorded files.

    `sensitivity`: of recorded files in V or mV, for all channels or as CHANNEL=VALUE. `automatic_balancing`: the
    machine balances itself, so that the factor counts; a file may say so, too. Raises InputError with file, line and
    column for what is wrong.
    """
    source = recordings if isinstance(recordings, Recordings) else of_files(recordings, sensitivity)
    with source.located():
        measured = _measured(source, progress)
        channels = tuple(_calibration(source))
    runs = tuple(each.record for each in measured)
    series = tuple(_series(runs))
    handles = tuple(_handles(series))
    highest = max(handles, key=lambda each: each.a_hv_m_per_s2 or 0.0)
    factor = balancing_factor() if automatic_balancing or source.tables.type_test.automatic_balancing else 1.0
    value = highest.a_hv_m_per_s2 if all(each.a_hv_m_per_s2 is not None for each in handles) else None
    declared = None if value is None else factor * value
    spread = None
    if declared is not None:
        spread = reproducibility(declared, factor * (highest.standard_deviation_m_per_s2 or 0.0))
    variation = [each.coefficient_of_variation for each in series if each.handle == highest.name]
    known = [each for each in variation if each is not None]
    provenance = Provenance.of(source) if source.file else Provenance.today(runs_file(measured), None)
    return MeasuredDeclareResult(
        title=source.title,
        checks=measured_checks(
            [Series(each.operator, each.handle, each.runs, each.mean_m_per_s2, each.standard_deviation_m_per_s2)
             for each in series],
            [(_name(run), len(run.axes), run.why_not) for run in runs],
            _overloads(runs, channels), tuple(_doubles(measured)),
            [Calibrated(channel.name, channel.file, channel.ratio) for channel in channels],
        ),
        warnings=(*source.warnings, *_remarks(measured, factor)),
        provenance=provenance,
        a_hd_m_per_s2=value,
        handle=None if value is None else highest.name,
        factor=factor,
        declared_m_per_s2=declared,
        K_m_per_s2=None if spread is None else declared_uncertainty(spread),
        s_R_m_per_s2=spread,
        coefficient_of_variation=max(known, default=None),
        handles=handles,
        series=series,
        runs=runs,
        calibration=channels,
    )  # fmt: skip


def runs_file(measured: "Sequence[_Measured]") -> str | None:
    """The recorded file, if there is a single one."""
    files = {part.recording.file for each in measured for part in each.parts}
    return files.pop() if len(files) == 1 else None


def _measured(source: Recordings, progress: Progress) -> tuple[_Measured, ...]:
    """Runs in the order of the file, axes of one run together."""
    parts: dict[tuple[str, int, str], list[Run]] = {}
    total = len(source.tables.recording)
    for count, run in enumerate(runs_of(source)):
        progress(Stage("reading runs", min(count / total, 1.0)))
        parts.setdefault((run.operator, run.number, run.handle), []).append(run)
    measured = []
    for count, (key, group) in enumerate(parts.items()):
        progress(Stage("weighting runs", count / len(parts)))
        measured.append(_Measured(*key, tuple(group), _record(key, group)))
    return tuple(measured)


def _record(key: tuple[str, int, str], group: Sequence[Run]) -> MeasuredRun:
    """Weighted acceleration of each axis, and their vector total; refused if an axis is there twice."""
    operator, number, handle = key
    names = [name for run in group for name in _axis_names(run)]
    _refuse_doubles(key, group, names)
    weighting = hand_arm_filter()
    values, reasons, overload = list[float | None](), list[str](), list[bool]()
    for run in group:
        for index in run.indices:
            samples = run.recording.samples[index]
            signal = _signal(run.recording, samples)
            reason = why_not(signal, weighting)
            values.append(None if reason else _rms(signal, weighting))
            reasons += [reason] if reason else []
            overload.append(run.recording.names[index] in run.recording.clipped)
    known = [value for value in values if value is not None]
    return MeasuredRun(
        operator=operator,
        run=number,
        handle=handle,
        a_hv_m_per_s2=math.hypot(*known) if len(known) == len(values) else None,
        axes=tuple(
            MeasuredAxis(name=name, a_hw_m_per_s2=value, overload=over)
            for name, value, over in zip(names, values, overload, strict=True)
        ),
        duration_s=min(run.recording.duration for run in group),
        overload=any(overload),
        why_not=reasons[0] if reasons else None,
    )


def _axis_names(run: Run) -> list[str]:
    return [run.axis] if run.axis else [run.recording.names[index] for index in run.indices]


def _refuse_doubles(key: tuple[str, int, str], group: Sequence[Run], names: Sequence[str]) -> None:
    operator, number, handle = key
    doubled = len(group) > 1 and (len(set(names)) < len(names) or any(run.axis is None for run in group))
    if not doubled and len(names) <= MOST_AXES:
        return
    raise InputError(
        "the same run of one operator at one handle twice", place=group[-1].place,
        found=f"operator {operator}, run {number}, handle {handle}: {', '.join(names)}",
        remedy="Number the runs, or name the axis of each file with axis.",
    )  # fmt: skip


def _signal(recording: Recording, samples: NDArray[np.float64]) -> AxisSignal:
    return AxisSignal(samples, recording.rate, 1 - QUANTITIES.index(recording.quantity), 0.0, True)


def _rms(signal: AxisSignal, weighting: Filter) -> float:
    return band_rms(signal, weighting)


def _calibration(source: Recordings) -> Iterator[MeasuredChannel]:
    """Rms acceleration of every channel of the calibrator runs."""
    for index, entry in enumerate(source.tables.calibration):
        recording = loaded(source, entry, Place(source.file or None, key=f"calibration[{index}]"))
        for name, samples in zip(recording.names, recording.samples, strict=True):
            signal, band = _signal(recording, samples), acceleration_filter()
            value = None if why_not(signal, band) else band_rms(signal, band)
            true = entry.acceleration_m_per_s2
            yield MeasuredChannel(
                file=Path(recording.file).name,
                name=name,
                acceleration_m_per_s2=value,
                true_m_per_s2=true,
                ratio=None if value is None else value / true,
                overload=name in recording.clipped,
            )


def _series(runs: Iterable[MeasuredRun]) -> Iterator[MeasuredSeries]:
    groups: dict[tuple[str, str], list[float | None]] = {}
    for run in runs:
        groups.setdefault((run.handle, run.operator), []).append(run.a_hv_m_per_s2)
    for (handle, operator), given in groups.items():
        values = [value for value in given if value is not None]
        whole = len(values) == len(given)
        mean = fmean(values) if whole else None
        deviation = stdev(values) if whole and len(values) > 1 else None
        yield MeasuredSeries(
            operator=operator,
            handle=handle,
            runs=len(given),
            mean_m_per_s2=mean,
            standard_deviation_m_per_s2=deviation,
            coefficient_of_variation=deviation / mean if deviation is not None and mean else None,
        )


def _handles(series: Sequence[MeasuredSeries]) -> Iterator[MeasuredHandle]:
    for name in dict.fromkeys(each.handle for each in series):
        means = [each.mean_m_per_s2 for each in series if each.handle == name]
        known = [mean for mean in means if mean is not None]
        whole = len(known) == len(means)
        yield MeasuredHandle(
            name=name,
            a_hv_m_per_s2=fmean(known) if whole else None,
            standard_deviation_m_per_s2=stdev(known) if whole and len(known) > 1 else None,
        )


def _name(run: MeasuredRun) -> str:
    return f"operator {run.operator}, run {run.run}, {run.handle}"


def _doubles(measured: Sequence[_Measured]) -> Iterator[str]:
    """Runs that hold the same samples as one before them: they count as runs, but were measured once."""
    known: dict[tuple[tuple[str, tuple[int, ...]], ...], MeasuredRun] = {}
    for each in measured:
        samples = tuple((part.recording.sha256, part.indices) for part in each.parts)
        first = known.setdefault(samples, each.record)
        if first is not each.record:
            yield f"{_name(each.record)}: the same recording as {_name(first)}"


def _overloads(runs: Iterable[MeasuredRun], calibration: Iterable[MeasuredChannel]) -> list[str]:
    """Names of the channels that stay at their largest value, of runs and calibrator runs."""
    names = [f"{_name(run)}, {axis.name}" for run in runs for axis in run.axes if axis.overload]
    return names + [f"calibrator run {channel.file}, {channel.name}" for channel in calibration if channel.overload]


def _remarks(measured: Sequence[_Measured], factor: float) -> Iterator[str]:
    """Remarks of the reader once each with the number of files, and where K is from."""
    told: dict[str, dict[str, None]] = {}
    for each in measured:
        for part in each.parts:
            for remark in part.recording.remarks:
                told.setdefault(remark_in_list(remark), {})[Path(part.recording.file).name] = None
    for remark, files in told.items():
        names = list(files)
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        yield f"{', '.join(names[:MOST_NAMED])}{more}: {remark}"
    if factor == 1:
        yield (
            "The factor 1.3 for machines that balance themselves is not included. If the machine has an autobalancer, "
            "set type_test.automatic_balancing = true, or add --automatic-balancing."
        )
    source, status = uncertainty_source()
    yield f"K is by {source}: {status}. The measured part of s_R is the standard deviation of the operators' means."
