"""Levels as instruments show them, and what was measured beside what is predicted, for every report of levels."""

from collections.abc import Sequence

from abu_calc.report.blocks import Block, Grid, Heading, Paragraph
from abu_calc.report.numbers import number
from abu_calc.studies.shown import MeasuredAfter, Readings


def readings_grid(rows: Sequence[tuple[str, Readings]]) -> Grid:
    """Places and states against what instruments show of them."""
    header = ("", "mm/s", "µm", "m/s²", "a_h W_h", "a_hv W_h")
    cells = tuple(
        (name, *map(_short, (one.velocity_mm_per_s, one.displacement_um, one.acceleration_m_per_s2,
                             one.weighted_m_per_s2, one.total_m_per_s2)))
        for name, one in rows
    )  # fmt: skip
    return Grid(header, cells, frozenset(range(1, 6)))


def _short(value: float | None) -> str:
    return "–" if value is None else number(value, 3)


def measured_after_line(one: MeasuredAfter) -> str:
    """Measured, predicted, the difference in words."""
    measured = f"Measured with the autobalancer, idle, {one.place}: {one.measured}"
    if one.unit != "dB":
        measured += f", that is {one.measured_level_db:.1f} dB"
    loaded = "" if one.predicted_loaded_db is None else f"; {one.predicted_loaded_db:.1f} dB under load"
    if one.predicted_level_db is None or one.difference_db is None:
        return f"{measured}; no idle level is predicted{loaded}."
    predicted = f"{one.predicted_level_db:.1f} dB"
    if one.unit != "dB" and one.predicted_value is not None:
        predicted += f" ({number(one.predicted_value, 3)} {one.unit} on that instrument)"
    word = "above" if one.difference_db >= 0 else "below"
    return f"{measured}: {abs(one.difference_db):.1f} dB {word} what is predicted, {predicted}{loaded}."


def measured_after_blocks(one: MeasuredAfter | None) -> list[Block]:
    """A line, where something was measured."""
    return [] if one is None else [Paragraph(measured_after_line(one))]


def shown_blocks(rows: Sequence[tuple[str, Readings]]) -> list[Block]:
    """The table with its heading, where there is a level."""
    return [Heading("As instruments show it, rms"), readings_grid(rows)] if rows else []
