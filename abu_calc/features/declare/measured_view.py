"""The report of `abu declare --recordings`, and its figure."""

from collections.abc import Iterator
from typing import Final

from abu_calc.features.declare.measured import MeasuredDeclareResult, MeasuredHandle, MeasuredSeries
from abu_calc.features.explain.steps import STEPS, step_blocks
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph, number, or_dash
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.parts import check_blocks, notices, provenance_blocks
from abu_calc.reporting.screen import many, one_screen, verdict_line

NTH: Final = ("first axis", "second axis", "third axis")


def measured_blocks(result: MeasuredDeclareResult) -> tuple[Block, ...]:
    """The whole report."""
    return (
        *_head(result),
        Heading("Vibration value", "values"),
        *_values(result),
        *_series(result),
        *_runs(result),
        *_channels(result),
        *check_blocks(result.checks),
        Heading("Conventions", "conventions"),
        Paragraph(
            "a_hv is the W_h-weighted vector total of the axes, rms. The value of a handle is the mean over the runs "
            "of each operator, then over the operators. The highest handle decides."
        ),
        *notices(result),
        *provenance_blocks(result.provenance),
    )


def measured_screen(result: MeasuredDeclareResult) -> tuple[Block, ...]:
    """One screen of it."""
    return one_screen(result, _head(result), [*_values(result), *_series(result), *_channels(result)])


def _head(result: MeasuredDeclareResult) -> tuple[Block, ...]:
    return (Heading(f"{result.title}: declared vibration value, measured"), verdict_line(result))


def _values(result: MeasuredDeclareResult) -> list[Block]:
    runs, operators = len(result.runs), len({each.operator for each in result.series})
    counted = f"{many(operators, 'operator')}, {many(len(result.handles), 'handle')}, {many(runs, 'run')} in all"
    rows = [("recordings", counted), ("highest handle", result.handle or "not known")]
    rows.append(("vibration value a_hd", _unit(result.a_hd_m_per_s2)))
    if result.factor != 1:
        rows.append((f"declared, × {result.factor:g}", _unit(result.declared_m_per_s2)))
    rows.append(("uncertainty K", f"{_unit(result.K_m_per_s2)} = 1.65 × s_R, s_R {_unit(result.s_R_m_per_s2)}"))
    return [Grid(("", ""), tuple(rows))]


def _unit(value: float | None) -> str:
    return "not known" if value is None else f"{number(value, 3)} m/s²"


def _series(result: MeasuredDeclareResult) -> list[Block]:
    """Operators at each handle, and the handle itself."""
    rows = []
    for handle in result.handles:
        rows += [_row(each) for each in result.series if each.handle == handle.name]
        rows.append(_mean(handle))
    header = ("handle", "operator", "runs", "mean, m/s²", "deviation, m/s²", "variation")
    return [Heading("Series", "series"), Grid(header, tuple(rows), frozenset({2, 3, 4, 5}))]


def _row(series: MeasuredSeries) -> tuple[str, ...]:
    variation = series.coefficient_of_variation
    return (
        series.handle, series.operator, str(series.runs), or_dash(series.mean_m_per_s2),
        or_dash(series.standard_deviation_m_per_s2), "–" if variation is None else f"{variation:.3f}",
    )  # fmt: skip


def _mean(handle: MeasuredHandle) -> tuple[str, ...]:
    return (handle.name, "mean of operators", "", or_dash(handle.a_hv_m_per_s2),
            or_dash(handle.standard_deviation_m_per_s2), "")  # fmt: skip


def _runs(result: MeasuredDeclareResult) -> list[Block]:
    axes = max(len(run.axes) for run in result.runs)
    header = ("handle", "operator", "run", *NTH[:axes], "a_hv, m/s²", "s")
    rows = tuple(
        (run.handle, run.operator, str(run.run), *(or_dash(axis.a_hw_m_per_s2) for axis in run.axes),
         *([""] * (axes - len(run.axes))), or_dash(run.a_hv_m_per_s2), number(run.duration_s, 3))
        for run in result.runs
    )  # fmt: skip
    return [Heading("Runs, weighted acceleration of each axis in m/s²", "runs"),
            Grid(header, rows, frozenset(range(2, len(header))), kept=3)]  # fmt: skip


def _channels(result: MeasuredDeclareResult) -> list[Block]:
    if not result.calibration:
        return []
    rows = tuple(
        (channel.file, channel.name, or_dash(channel.acceleration_m_per_s2), or_dash(channel.true_m_per_s2),
         "–" if channel.ratio is None else f"{channel.ratio:.3f}")
        for channel in result.calibration
    )  # fmt: skip
    header = ("calibrator run", "channel", "measured, m/s²", "calibrator, m/s²", "ratio")
    return [Heading("Calibration", "calibration"), Grid(header, rows, frozenset({2, 3, 4}))]


def measured_extras(result: MeasuredDeclareResult) -> Extras:
    """The figure and formulas of the page."""
    return Extras(tuple(_bars(result)), tuple(step_blocks(STEPS["declare"])))


def _bars(result: MeasuredDeclareResult) -> Iterator[Figure]:
    """Mean of each series with one standard deviation on either side."""
    rows = []
    for each in result.series:
        if each.mean_m_per_s2 is None:
            continue
        mean, spread = each.mean_m_per_s2, each.standard_deviation_m_per_s2
        span = None if spread is None else (max(mean - spread, 0.0), mean + spread)
        rows.append(Bar(f"{each.handle}, {each.operator}", mean, f"{number(mean, 3)} m/s²", span=span))
    if not rows:
        return
    ends = [bar.span[1] if bar.span else bar.value for bar in rows]
    axis = Axis.around("weighted acceleration a_hv [m/s²]", ends, zero=True)
    value = result.a_hd_m_per_s2
    limit = None if value is None else (value, f"a_hd {number(value, 3)} m/s²")
    text = "; ".join(f"{bar.name}: {bar.text}" for bar in rows)
    caption = "Mean of each operator at each handle, with one standard deviation of the runs on either side."
    yield Figure("series", "series", Bars("Series", text, axis, rows, limit), caption)
