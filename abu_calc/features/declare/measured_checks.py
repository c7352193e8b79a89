"""Checks of measured type tests: spread of each series, completeness, calibration, overload."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.standards.type_test import series_rules

CALIBRATED: Final = 0.05
"""Share by which a channel may differ from the calibrator."""
AXES: Final = 3
MOST_NAMED: Final = 3


class Series(NamedTuple):
    """Runs of one operator at one handle: how many, mean and standard deviation [m/s²], None: not known."""

    operator: str
    handle: str
    runs: int
    mean: float | None
    deviation: float | None


class Calibrated(NamedTuple):
    """A channel of a calibrator run: measured acceleration over that of the calibrator; None: not known."""

    name: str
    file: str
    ratio: float | None


def measured_checks(
    series: Sequence[Series],
    runs: Sequence[tuple[str, int, str | None]],
    overloads: Sequence[str],
    doubles: Sequence[str],
    channels: Sequence[Calibrated],
) -> tuple[Check, ...]:
    """`runs`: name, number of axes, and why the value is not known, of each run; `overloads`: names of channels;
    `doubles`: runs that repeat a recording."""
    return (
        *_spread(series), _whole(series, [(name, axes) for name, axes, _ in runs], doubles), *_calibration(channels),
        _overload(overloads),
        _weighted([(name, reason) for name, _, reason in runs if reason]),
    )  # fmt: skip


def _spread(series: Sequence[Series]) -> Iterator[Check]:
    """ABU441, one for each handle: the series that scatters most."""
    rules = series_rules()
    for handle in dict.fromkeys(each.handle for each in series):
        known = [each for each in series if each.handle == handle and each.deviation is not None and each.mean]
        if len(known) < sum(each.handle == handle for each in series):
            reason = "A series has a single run, or a value is not known"
            yield coded("ABU441", "not-done", reason, None, rules.variation, "", of=handle)
            continue
        failing = [each for each in known if not _scatters_little(each)]
        worst = max(failing or known, key=_variation)
        message = (
            f"Operator {worst.operator}: standard deviation {worst.deviation:.3g} m/s² of {worst.runs} runs, mean "
            f"{worst.mean:.3g} m/s²"
        )
        if not failing and _variation(worst) >= rules.variation:
            message += f". The standard deviation is below {rules.deviation:g} m/s², which suffices"
        yield coded("ABU441", verdict(not failing), message, _variation(worst), rules.variation, "", of=handle)


def _variation(series: Series) -> float:
    return (series.deviation or 0.0) / (series.mean or 1.0)


def _scatters_little(series: Series) -> bool:
    rules = series_rules()
    return _variation(series) < rules.variation or (series.deviation or 0.0) < rules.deviation


def _whole(series: Sequence[Series], axes: Sequence[tuple[str, int]], doubles: Sequence[str]) -> Check:
    """ABU442."""
    rules, faults = series_rules(), list[str]()
    for handle in dict.fromkeys(each.handle for each in series):
        operators = [each for each in series if each.handle == handle]
        if len(operators) < rules.operators:
            faults.append(f"{handle}: {len(operators)} of {rules.operators} operators")
        short = [each for each in operators if each.runs < rules.runs]
        faults += [f"{handle}, operator {each.operator}: {each.runs} of {rules.runs} runs" for each in short]
    fewer = [f"{name}: {count} of {AXES} axes" for name, count in axes if count < AXES]
    faults += fewer[:MOST_NAMED] + (
        [f"{len(fewer) - MOST_NAMED} more runs with fewer axes"] if len(fewer) > MOST_NAMED else []
    )
    faults += [_listed(doubles)] if doubles else []
    message = f"Each handle has {rules.operators} operators or more with {rules.runs} runs or more, three axes each"
    remedy = "Measure what is missing, so that the value is that of a whole type test." if faults else None
    return coded("ABU442", verdict(True, not faults), ". ".join(faults) or message, remedy=remedy)


def _calibration(channels: Sequence[Calibrated]) -> Iterator[Check]:
    """ABU443: the channel that is off most; nothing to check without a calibrator run."""
    if not channels:
        message = "No calibrator run is given, so the sensitivities are taken as they are"
        advice = "Record a calibrator with each channel, and list it as [[calibration]]."
        yield coded("ABU443", "warn", message, remedy=advice)
        return
    unknown = [channel for channel in channels if channel.ratio is None]
    if unknown:
        message = f"{unknown[0].file}, {unknown[0].name}: too short, or sampled too slowly"
        yield coded("ABU443", "not-done", message, None, 100 * CALIBRATED, "%")
        return
    off = max(channels, key=lambda channel: abs((channel.ratio or 1.0) - 1))
    error = abs((off.ratio or 1.0) - 1)
    message = f"{off.file}, {off.name}: {off.ratio:.4g} times the calibrator's acceleration"
    remedy = None
    if error > CALIBRATED:
        remedy = f"Multiply the sensitivity of this channel by {off.ratio:.4g}, or mend sensor and cable."
    yield coded("ABU443", verdict(error <= CALIBRATED), message, 100 * error, 100 * CALIBRATED, "%", remedy)


def _overload(channels: Sequence[str]) -> Check:
    """ABU444."""
    message = "No recording stays at its largest value"
    if channels:
        message = f"Cut off at the largest value: {_listed(channels)}"
    return coded("ABU444", verdict(not channels), message)


def _weighted(runs: Sequence[tuple[str, str]]) -> Check:
    """ABU445."""
    if not runs:
        return coded("ABU445", "pass", "W_h can be applied to every run")
    message = f"{_listed([name for name, _ in runs])}: {runs[0][1]}"
    return coded("ABU445", "not-done", message)


def _listed(names: Sequence[str]) -> str:
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return "; ".join(names[:MOST_NAMED]) + more
