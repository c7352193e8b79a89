"""The declared vibration value of measured runs: operators × runs × handles, three axes each."""

import math
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from statistics import fmean, stdev
from typing import Annotated, ClassVar, Final

from abu_calc.features.declare.read import Recordings, Run, loaded, of_files, remark_in_list, runs_of
from abu_calc.features.levels.octaves import AxisSignal, Filter, acceleration_filter, band_rms, hand_arm_filter, why_not
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Progress, Stage, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.recording import MOST_AXES, Recording
from abu_calc.inputs.recording_columns import QUANTITIES
from abu_calc.simulation.arguments import checked
from abu_calc.simulation.result import Provenance, Result
from abu_calc.standards.vibration import (
    balancing_factor,
    declared_uncertainty,
    reproducibility,
    series_rules,
    uncertainty_source,
)

MOST_NAMED: Final = 3
CALIBRATED: Final = 0.05
"""Share by which a channel may differ from the calibrator."""
AXES: Final = 3


@record
class MeasuredAxis(Record):
    """One axis of a run."""

    name: Annotated[str, Quantity("axis")]
    a_hw_m_per_s2: Annotated[float | None, Quantity("weighted acceleration", "a_h", 4)]
    overload: Annotated[bool, Quantity("stays at its largest value")]


@record
class MeasuredRun(Record):
    """One run at one handle."""

    left_out: ClassVar[frozenset[str]] = frozenset({"parts"})
    optional: ClassVar[frozenset[str]] = frozenset({"why_not"})

    parts: tuple[Run, ...]
    """Axes from one file or several."""
    operator: Annotated[str, Quantity("operator")]
    run: Annotated[int, Quantity("run")]
    handle: Annotated[str, Quantity("handle")]
    a_hv_m_per_s2: Annotated[float | None, Quantity("vector total", "a_hv", 4)]
    axes: tuple[MeasuredAxis, ...]
    duration_s: Annotated[float, Quantity("duration", "", 3)]
    overload: Annotated[bool, Quantity("stays at its largest value")]
    why_not: Annotated[str | None, Quantity("why it is not known")]

    @property
    def name(self) -> str:
        """Operator, number and handle in words."""
        return f"operator {self.operator}, run {self.run}, {self.handle}"


@record
class MeasuredSeries(Record):
    """The runs of one operator at one handle."""

    operator: Annotated[str, Quantity("operator")]
    handle: Annotated[str, Quantity("handle")]
    runs: Annotated[int, Quantity("runs")]
    mean: Annotated[float | None, Quantity("mean", "a_hv", unit="m_per_s2")]
    standard_deviation: Annotated[float | None, Quantity("standard deviation", "", 3, unit="m_per_s2")]
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
        runs = tuple(_measured(source, progress))
        channels = tuple(_calibration(source))
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
    provenance = Provenance.of(source) if source.file else Provenance.today(_only_file(runs), None)
    return MeasuredDeclareResult(
        title=source.title,
        checks=(*_spread(series), _whole(series, runs), *_calibrated(channels), _overload(runs, channels),
                _weighted(runs)),
        warnings=(*source.warnings, *_remarks(runs, factor)),
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


def _only_file(runs: Iterable[MeasuredRun]) -> str | None:
    """The recorded file, if there is a single one."""
    files = {part.recording.file for run in runs for part in run.parts}
    return files.pop() if len(files) == 1 else None


def _measured(source: Recordings, progress: Progress) -> Iterator[MeasuredRun]:
    """Runs in the order of the file, axes of one run together."""
    parts: dict[tuple[str, int, str], list[Run]] = {}
    total = len(source.tables.recording)
    for count, run in enumerate(runs_of(source)):
        progress(Stage("reading runs", min(count / total, 1.0)))
        parts.setdefault((run.operator, run.number, run.handle), []).append(run)
    for count, (key, group) in enumerate(parts.items()):
        progress(Stage("weighting runs", count / len(parts)))
        yield _run(key, group)


def _run(key: tuple[str, int, str], group: Sequence[Run]) -> MeasuredRun:
    """Weighted acceleration of each axis, and their vector total; refused if an axis is there twice."""
    operator, number, handle = key
    names = [name for run in group for name in _axis_names(run)]
    _refuse_doubles(key, group, names)
    weighting = hand_arm_filter()
    axes, reasons = list[MeasuredAxis](), list[str]()
    for run in group:
        for index in run.indices:
            value, reason = _rms(run.recording, index, weighting)
            reasons += [reason] if reason else []
            overload = run.recording.names[index] in run.recording.clipped
            axes.append(MeasuredAxis(name=names[len(axes)], a_hw_m_per_s2=value, overload=overload))
    known = [axis.a_hw_m_per_s2 for axis in axes if axis.a_hw_m_per_s2 is not None]
    return MeasuredRun(
        parts=tuple(group),
        operator=operator,
        run=number,
        handle=handle,
        a_hv_m_per_s2=math.hypot(*known) if len(known) == len(axes) else None,
        axes=tuple(axes),
        duration_s=min(run.recording.duration for run in group),
        overload=any(axis.overload for axis in axes),
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


def _rms(recording: Recording, index: int, band: Filter) -> tuple[float | None, str | None]:
    """Rms of an axis by a filter, or why it is not known."""
    signal = AxisSignal(recording.samples[index], recording.rate, 1 - QUANTITIES.index(recording.quantity), 0.0, True)
    reason = why_not(signal, band)
    return (None if reason else band_rms(signal, band)), reason


def _calibration(source: Recordings) -> Iterator[MeasuredChannel]:
    """Rms acceleration of every channel of the calibrator runs."""
    for index, entry in enumerate(source.tables.calibration):
        recording = loaded(source, entry, Place(source.file or None, key=f"calibration[{index}]"))
        for number, name in enumerate(recording.names):
            value, true = _rms(recording, number, acceleration_filter())[0], entry.acceleration_m_per_s2
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
            mean=mean,
            standard_deviation=deviation,
            coefficient_of_variation=deviation / mean if deviation is not None and mean else None,
        )


def _handles(series: Sequence[MeasuredSeries]) -> Iterator[MeasuredHandle]:
    for name in dict.fromkeys(each.handle for each in series):
        means = [each.mean for each in series if each.handle == name]
        known = [mean for mean in means if mean is not None]
        whole = len(known) == len(means)
        yield MeasuredHandle(
            name=name,
            a_hv_m_per_s2=fmean(known) if whole else None,
            standard_deviation_m_per_s2=stdev(known) if whole and len(known) > 1 else None,
        )


def _remarks(runs: Iterable[MeasuredRun], factor: float) -> Iterator[str]:
    """Remarks of the reader once each with the number of files, and where K is from."""
    told: dict[str, dict[str, None]] = {}
    for run in runs:
        for part in run.parts:
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


def _spread(series: Sequence[MeasuredSeries]) -> Iterator[Check]:
    """One for each handle: the series that scatters most."""
    rules = series_rules()
    for handle in dict.fromkeys(each.handle for each in series):
        known = [each for each in series if each.handle == handle and each.coefficient_of_variation is not None]
        if len(known) < sum(each.handle == handle for each in series):
            reason = "A series has a single run, or a value is not known"
            yield coded("ABU441", "not-done", reason, None, rules.variation, of=handle)
            continue
        failing = [each for each in known if not _scatters_little(each)]
        worst = max(failing or known, key=_variation)
        message = (
            f"Operator {worst.operator}: standard deviation {worst.standard_deviation:.3g} m/s² of {worst.runs} runs, "
            f"mean {worst.mean:.3g} m/s²"
        )
        if not failing and _variation(worst) >= rules.variation:
            message += f". The standard deviation is below {rules.deviation:g} m/s², which suffices"
        yield coded("ABU441", verdict(not failing), message, _variation(worst), rules.variation, of=handle)


def _variation(series: MeasuredSeries) -> float:
    return series.coefficient_of_variation or 0.0


def _scatters_little(series: MeasuredSeries) -> bool:
    rules = series_rules()
    return _variation(series) < rules.variation or (series.standard_deviation or 0.0) < rules.deviation


def _whole(series: Sequence[MeasuredSeries], runs: Sequence[MeasuredRun]) -> Check:
    rules, faults = series_rules(), list[str]()
    for handle in dict.fromkeys(each.handle for each in series):
        operators = [each for each in series if each.handle == handle]
        if len(operators) < rules.operators:
            faults.append(f"{handle}: {len(operators)} of {rules.operators} operators")
        short = [each for each in operators if each.runs < rules.runs]
        faults += [f"{handle}, operator {each.operator}: {each.runs} of {rules.runs} runs" for each in short]
    fewer = [f"{run.name}: {len(run.axes)} of {AXES} axes" for run in runs if len(run.axes) < AXES]
    faults += fewer[:MOST_NAMED] + (
        [f"{len(fewer) - MOST_NAMED} more runs with fewer axes"] if len(fewer) > MOST_NAMED else []
    )
    doubles = list(_doubles(runs))
    faults += [_listed(doubles)] if doubles else []
    message = f"Each handle has {rules.operators} operators or more with {rules.runs} runs or more, three axes each"
    remedy = "Measure what is missing, so that the value is that of a whole type test." if faults else None
    return coded("ABU442", verdict(True, not faults), ". ".join(faults) or message, remedy=remedy)


def _calibrated(channels: Sequence[MeasuredChannel]) -> Iterator[Check]:
    """The channel that is off most; nothing to check without a calibrator run."""
    if not channels:
        message = "No calibrator run is given, so the sensitivities are taken as they are"
        advice = "Record a calibrator with each channel, and list it as [[calibration]]."
        yield coded("ABU443", "warn", message, remedy=advice)
        return
    unknown = [channel for channel in channels if channel.ratio is None]
    if unknown:
        message = f"{unknown[0].file}, {unknown[0].name}: too short, or sampled too slowly"
        yield coded("ABU443", "not-done", message, None, CALIBRATED)
        return
    off = max(channels, key=lambda channel: abs((channel.ratio or 1.0) - 1))
    error = abs((off.ratio or 1.0) - 1)
    message = f"{off.file}, {off.name}: {off.ratio:.4g} times the calibrator's acceleration"
    remedy = None
    if error > CALIBRATED:
        remedy = f"Multiply the sensitivity of this channel by {off.ratio:.4g}, or mend sensor and cable."
    yield coded("ABU443", verdict(error <= CALIBRATED), message, error, CALIBRATED, remedy)


def _overload(runs: Iterable[MeasuredRun], calibration: Iterable[MeasuredChannel]) -> Check:
    """Of runs and calibrator runs."""
    channels = [f"{run.name}, {axis.name}" for run in runs for axis in run.axes if axis.overload]
    channels += [f"calibrator run {channel.file}, {channel.name}" for channel in calibration if channel.overload]
    message = "No recording stays at its largest value"
    if channels:
        message = f"Cut off at the largest value: {_listed(channels)}"
    return coded("ABU444", verdict(not channels), message)


def _weighted(runs: Iterable[MeasuredRun]) -> Check:
    unknown = [run for run in runs if run.why_not]
    if not unknown:
        return coded("ABU445", "pass", "W_h can be applied to every run")
    return coded("ABU445", "not-done", f"{_listed([run.name for run in unknown])}: {unknown[0].why_not}")


def _doubles(runs: Iterable[MeasuredRun]) -> Iterator[str]:
    """Runs that hold the same samples as one before them: they count as runs, but were measured once."""
    known: dict[tuple[tuple[str, tuple[int, ...]], ...], MeasuredRun] = {}
    for run in runs:
        first = known.setdefault(tuple((part.recording.sha256, part.indices) for part in run.parts), run)
        if first is not run:
            yield f"{run.name}: the same recording as {first.name}"


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return "; ".join(names[:MOST_NAMED]) + more
