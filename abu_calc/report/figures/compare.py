"""Figures of `abu compare`: the main numbers of each machine as bars."""

from collections.abc import Iterator, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.report.figures.chart import Axis, Bar, Bars
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.numbers import number
from abu_calc.spec.text import is_number
from abu_calc.studies.compare import CompareResult
from abu_calc.studies.side_by_side import Difference

SERIES: Final = {"before": 2, "worst": 3, "measured": 3}


class _Compared(NamedTuple):
    """A figure: paths of designs with what they are called, and a check whose limit is drawn."""

    name: str
    title: str
    axis: str
    paths: dict[str, str]
    caption: str
    code: str = ""


FIGURES: Final = (
    _Compared(
        "levels", "Levels of the machines", "velocity level, idle [dB]",
        {"vibration.level_before_db": "before", "vibration.level_after_db": "after",
         "measured_after.measured_level_db": "measured"},
        "Velocity level without (square) and with (round) the autobalancer, lozenge: measured; 0 dB = 5e-8 m/s rms.",
        "ABU401",
    ),
    _Compared(
        "residual", "Residuals of the machines", "residual, 0–peak [µm]", {"accuracy_budget.residual_um": ""},
        "What the balls leave at the wheel, expected: shorter is better.",
    ),
    _Compared(
        "mass", "Masses of the autobalancers", "mass with balls [g]", {"autobalancer.mass_g": ""},
        "What each autobalancer adds to its machine.",
    ),
    _Compared(
        "settling", "Settling times of the machines", "settling time [s]",
        {"ensemble.settling_time_s.typical": "median", "ensemble.settling_time_s.worst": "worst"},
        "How long the balls take over many starts, median and worst; a machine without a bar does not always settle.",
        "ABU702",
    ),
)  # fmt: skip


def compare_extras(result: CompareResult) -> Extras:
    """Figures of what more than one machine has."""
    rows = {row.path: row for row in (*result.differences, *result.alike) if row.part == "design"}
    return Extras(tuple(figure for quantity in FIGURES for figure in _figure(result, quantity, rows)))


def _figure(result: CompareResult, quantity: _Compared, rows: dict[str, Difference]) -> Iterator[Figure]:
    unit = quantity.axis.partition("[")[2].rstrip("]")
    words = list(quantity.paths.values())
    bars = [
        Bar(f"{file.letter}  {file.title}{f', {words[k]}' if words[k] else ''}", value, _told(value, unit),
            SERIES.get(words[k], 1))
        for index, file in enumerate(result.files)
        for k, path in enumerate(quantity.paths)
        if path in rows and is_number(value := rows[path].values[index])
    ]  # fmt: skip
    if len({bar.name[0] for bar in bars}) < 2:  # of one machine alone there is nothing to compare
        return
    limit = _limit(result, quantity.code, unit)
    values = [*(bar.value for bar in bars), *([limit[0]] if limit else [])]
    axis = Axis.around(quantity.axis, values) if unit == "dB" else Axis(quantity.axis, 0.0, max(values) or 1.0)
    text = "; ".join(f"{bar.name} {bar.told}" for bar in bars) + (f"; {limit[1]}" if limit else "")
    yield Figure(quantity.name, result.title, Bars(quantity.title, text, axis, bars, limit), quantity.caption)


def _told(value: Any, unit: str) -> str:
    return f"{value:.1f} dB" if unit == "dB" else f"{number(value, 3)} {unit}"


def _limit(result: CompareResult, code: str, unit: str) -> tuple[float, str] | None:
    """Limit of a check with its text; None unless all machines have the same limit."""
    limits: Sequence[float | None] = list({check.limit for check in result.checks if check.code == code})
    if len(limits) != 1 or limits[0] is None:
        return None
    return limits[0], f"limit {number(limits[0])} {unit}"
