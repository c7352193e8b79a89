"""Levels as instruments show them, and what was measured beside what is predicted, for every report of levels."""

from collections.abc import Sequence

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.studies.shown import MeasuredAfter, Readings


def readings_grid(rows: Sequence[tuple[str, Readings]]) -> Grid:
    """Places and states against what instruments show of them."""
    header = ("", "mm/s", "µm", "m/s²", "a_h W_h", "a_hv W_h")
    cells = tuple(
        (name, *map(_short, (reading.velocity_mm_per_s, reading.displacement_um, reading.acceleration_m_per_s2,
                             reading.weighted_m_per_s2, reading.total_m_per_s2)))
        for name, reading in rows
    )  # fmt: skip
    return Grid(header, cells, frozenset(range(1, 6)))


def _short(value: float | None) -> str:
    return "–" if value is None else number(value, 3)


def measured_after_line(comparison: MeasuredAfter) -> str:
    """Measured, predicted, the difference in words."""
    measured = f"Measured with the autobalancer, idle, {comparison.place}: {comparison.measured}"
    if comparison.unit != "dB":
        measured += f", that is {comparison.measured_level_db:.1f} dB"
    loaded = "" if comparison.predicted_loaded_db is None else f"; {comparison.predicted_loaded_db:.1f} dB under load"
    if comparison.predicted_level_db is None or comparison.difference_db is None:
        return f"{measured}; no idle level is predicted{loaded}."
    predicted = f"{comparison.predicted_level_db:.1f} dB"
    if comparison.unit != "dB" and comparison.predicted_value is not None:
        predicted += f" ({number(comparison.predicted_value, 3)} {comparison.unit} on that instrument)"
    word = "above" if comparison.difference_db >= 0 else "below"
    return f"{measured}: {abs(comparison.difference_db):.1f} dB {word} what is predicted, {predicted}{loaded}."


def measured_after_blocks(comparison: MeasuredAfter | None) -> list[Block]:
    """A line, where something was measured."""
    return [] if comparison is None else [Paragraph(measured_after_line(comparison))]


def shown_blocks(rows: Sequence[tuple[str, Readings]]) -> list[Block]:
    """The table with its heading, where there is a level."""
    return [Heading("As instruments show it, rms"), readings_grid(rows)] if rows else []
