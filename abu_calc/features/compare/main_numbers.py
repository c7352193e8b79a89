"""The numbers that decide a comparison: levels and quiet times, case by case, one column for each machine."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final, NamedTuple

from abu_calc.features.compare.study import CompareResult, checks_named
from abu_calc.inputs.reading.text import is_number
from abu_calc.reporting.blocks import Block, Grid, level_text, number

DECIBELS: Final = (
    ("vibration.level_before_db", "Idle, without autobalancer"),
    ("ensemble.predicted_level_db", "Idle, with: median of the start cases"),
    ("vibration.level_after_db", "  expected, manufacture and friction"),
    ("ensemble.level_db.worst", "  loudest listed start case"),
    ("vibration.worst_arrangement.level_after_db", "  bound of friction"),
    ("measured_after.measured_level_db", "  measured"),
)
"""Levels of the idle machine, by their paths in the results; labels as on the screen of `abu size`."""
LOADED: Final = (
    ("vibration_loaded.level_before_db", "Grinding, without autobalancer"),
    ("vibration_loaded.level_after_db", "Grinding, with: pressed after settling"),
    ("vibration_loaded.level_at_once_db", "  pressed earlier"),
    ("vibration_loaded.starts.worst_db", "  loudest start case"),
)
"""Levels at the workpiece."""
STARTS: Final = "ensemble.settling_by_start"
MEDIAN: Final = "ensemble.quiet_time_s.typical"
SLOWEST: Final = "ensemble.quiet_time_s.worst"
DRAG: Final = "autobalancer.rolling_drag_per_s"
"""Key of the files: the drag rate in force: as given, or its default."""
COUNT: Final = "ensemble.members"
BOUND: Final = "vibration_loaded.bound.lower_bound"

Designs = Mapping[str, Sequence[Any]]
"""Path → the values of all machines."""


class _NumbersLine(NamedTuple):
    """A case and its cell for each machine."""

    label: str
    cells: tuple[str, ...]


def main_blocks(result: CompareResult) -> list[Block]:
    """Levels and quiet times, those that are equal too; nothing if no machine has an autobalancer."""
    rows = (*result.differences, *result.alike)
    designs = {row.path: row.values for row in rows if row.part == "design" or row.path == DRAG}
    titles = (
        (f"Vibration, dB re 5e-8 m/s{_one_limit(result, 'idle_level')}", _levels(result, designs)),
        (f"Quiet time, s{_one_limit(result, 'quiet_time')}", _settling(result, designs)),
    )
    letters = tuple(file.letter for file in result.files)
    right = frozenset(range(1, len(letters) + 1))
    return [
        Grid((title, *letters), tuple((line.label, *line.cells) for line in lines), right, kept=2)
        for title, lines in titles
        if lines
    ]


def _levels(result: CompareResult, designs: Designs) -> list[_NumbersLine]:
    lines = [
        _NumbersLine(label, tuple(map(_level, designs[path]))) for path, label in DECIBELS if _known(designs, path)
    ]
    if lines:
        lines += _limit(result, "idle_level")
    bounds = designs.get(BOUND, [None] * len(result.files))
    for path, label in LOADED:
        if _known(designs, path):
            values = zip(designs[path], bounds, strict=True)
            at_least = path == "vibration_loaded.level_after_db"
            lines.append(
                _NumbersLine(label, tuple(f"≥ {_level(v)}" if at_least and low and v is not None else _level(v)
                                   for v, low in values))
            )  # fmt: skip
    return lines


def _settling(result: CompareResult, designs: Designs) -> list[_NumbersLine]:
    machines = range(len(result.files))
    simulated = [designs.get(COUNT, [None] * len(result.files))[k] is not None for k in machines]
    if not any(simulated):
        return []

    def line(label: str, values: Sequence[float | None]) -> _NumbersLine:
        """A line of times [s]; “–” for a design without simulated start cases."""
        return _NumbersLine(label, tuple(_time(value) if simulated[k] else "–" for k, value in enumerate(values)))

    given = [_slowest_as_given(designs, k) for k in machines]
    return [
        line("Median of the start cases", designs[MEDIAN]),
        line("Slowest start case, drag rate in force", given),
        line("Slowest listed start case, any oil", designs[SLOWEST]),
        *_limit(result, "quiet_time"),
    ]


def _slowest_as_given(designs: Designs, machine: int) -> float | None:
    """Longest quiet time [s] of one machine at its own drag rate; None: a start case is never quiet."""
    times = list[float]()
    drags = {path: values[machine] for path, values in designs.items()
             if path.startswith(STARTS) and path.endswith(".drag_per_s")}  # fmt: skip
    for path, drag in drags.items():
        if drag is not None and drag == designs[DRAG][machine]:
            time = designs[path.replace(".drag_per_s", ".quiet_time_s")][machine]
            times.append(math.inf if time is None else time)
    longest = max(times, default=math.inf)
    return None if math.isinf(longest) else longest


def _limits(result: CompareResult, key: str) -> list[float | None]:
    return [None if check is None else check.limit for check in checks_named(result, key)]


def _one_limit(result: CompareResult, key: str) -> str:
    """Limit that all machines have, for the head of a table."""
    limits = set(_limits(result, key)) - {None}
    return f" (limit {number(limit, 3)})" if len(limits) == 1 and (limit := limits.pop()) is not None else ""


def _limit(result: CompareResult, key: str) -> list[_NumbersLine]:
    """Limits that differ, as a line of the table."""
    limits = _limits(result, key)
    if len(set(limits) - {None}) <= 1:
        return []
    return [_NumbersLine("  limit", tuple("–" if limit is None else number(limit, 3) for limit in limits))]


def _known(designs: Designs, path: str) -> bool:
    return any(is_number(value) for value in designs.get(path, ()))


def _level(value: float | None) -> str:
    return "–" if value is None else level_text(value, 4 if value >= 100 else 3).removesuffix(" dB")


def _time(value: float | None) -> str:
    return "never" if value is None else number(value, 3 if value >= 1 else 2)
