"""The report of `abu factory`: one table, and a remark on each row."""

from collections.abc import Sequence

from abu_calc.features.factory.study import FactoryLevel, FactoryResult
from abu_calc.reporting.blocks import Block, Grid, Heading, Paragraph
from abu_calc.reporting.parts import provenance_blocks
from abu_calc.reporting.screen import many

NOTE = (
    "Levels in dB re 5e-8 m/s in the octave: measured without and with autobalancer, each beside the model. Lowered: "
    "without − with. Diff.: measured − model, with autobalancer. Model, idle: median of the start cases at the given "
    "drag rate. Model, loaded: pressed to the workpiece after the balls have settled. –: not published, or no motion "
    "of the model in that octave."
)
ONE_SET = (
    "All four presets assume a friction arm of 0.002 mm, a viscous drag rate of 15 1/s, a race eccentricity of 0.010 "
    "mm and springs of 2.5 Hz. They assume a normal force of 45 N. Some other figures were chosen to match published "
    "results: the comments in the presets mark them."
)


def factory_screen(result: FactoryResult) -> tuple[Block, ...]:
    """The one screen."""
    rows = result.rows
    heading = "machine", "Hz", "without", "model", "with", "model", "diff.", "lowered", "model"
    cells = tuple((f"{k} {row.short}{_state(row)}", *_cells(row)) for k, row in enumerate(rows, 1))
    words = (Paragraph(f"{k} {row.word}{_elsewhere(row)}", hang=2) for k, row in enumerate(rows, 1))
    return (
        Heading(result.title),
        Paragraph(_verdict(rows)),
        Paragraph(""),
        Grid(heading, cells, frozenset(range(1, 9))),
        Paragraph(NOTE),
        Paragraph(""),
        *words,
        Paragraph(f"{ONE_SET} {result.background}"),
    )


def factory_blocks(result: FactoryResult) -> tuple[Block, ...]:
    """The whole report."""
    return (*factory_screen(result), Paragraph(f"Source: {result.source}."), *provenance_blocks(result.provenance))


def _state(level: FactoryLevel) -> str:
    return "" if level.state == "not said" else f" {level.state}"


def _elsewhere(level: FactoryLevel) -> str:
    """Sentence on the octave in which the model is louder than in this one; empty if there is none."""
    if level.louder_octave_hz is None:
        return ""
    return (
        f" Pressed before the balls have settled, the model is loudest at {level.louder_octave_hz:g} Hz, "
        f"{_one(level.louder_octave_db)} dB."
    )


def _cells(level: FactoryLevel) -> tuple[str, ...]:
    return (
        f"{level.octave_hz:g}",
        level.named or _span(level.without_measured_db),
        _one(level.without_predicted_db),
        _span(level.with_measured_db),
        _one(level.with_predicted_db),
        "–" if level.difference_db is None else f"{level.difference_db:+.1f}",
        _span(level.lowered_measured_db),
        _one(level.lowered_predicted_db),
    )


def _span(span: tuple[float, float] | None) -> str:
    return "–" if span is None else f"{span[0]:g}–{span[1]:g}"


def _one(level: float | None) -> str:
    return "–" if level is None else f"{level:.1f}"


def _verdict(rows: Sequence[FactoryLevel]) -> str:
    """Number of predictions within the measured range, and the largest error of the others."""
    known = [row.outside_db for row in rows if row.outside_db is not None]
    within = sum(1 for off in known if off == 0)
    return (
        f"The model predicts {len(known)} of {many(len(rows), 'measurement')}: {within} within the measured range, the "
        f"others up to {max(known, default=0.0):.1f} dB outside it."
    )
