"""Texts of a page for readers without the program."""

import pytest

from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.charts.chart import Axis, Bar, Bars, Extras, Figure
from abu_calc.reporting.page.handover import ENTRIES, extras_handed_over, handed_over, without_commands


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("The disk stays on. `abu grinding FILE` simulates more.", "The disk stays on."),
        ("Leave the forbidden speeds (--speeds finds them, Python: speeds_rpm=), or add damping.",
         "Leave the forbidden speeds, or add damping."),
        ("Not simulated, since each takes long (--patience 300 allows 300 s). All listed pass.",
         "Not simulated, since each takes long. All listed pass."),
        ("Step: abu explain simulation", ""),
        ("To scale: --output section.svg.", ""),
        ("abu-calc is a well-known tool (see below).", "abu-calc is a well-known tool (see below)."),
        ("", ""),
    ],
)  # fmt: skip
def test_sentences_and_asides_with_commands_are_left_out(text: str, kept: str) -> None:
    assert without_commands(text) == kept


def test_lines_to_paste_become_entries_of_the_file() -> None:
    lines = (
        Paragraph("Reduce the friction.", "warn"),
        Paragraph("--set autobalancer.ball_count=4 \\", indent=4),
        Paragraph("--set 'machine.name=My grinder' --set bearing.0.shaft_fit=m6", indent=4),
        Paragraph("`abu size FILE` judges it."),
        Paragraph("Last."),
    )
    assert [(line.text, line.mark) for line in handed_over(lines) if isinstance(line, Paragraph)] == [
        ("Reduce the friction.", "warn"), ("[autobalancer]  ball_count = 4", ENTRIES),
        ('[machine]  name = "My grinder"', ENTRIES), ('[[bearing]] number 1:  shaft_fit = "m6"', ENTRIES),
        ("Last.", None),
    ]  # fmt: skip


def test_tables_headings_and_captions_lose_commands_but_are_never_emptied() -> None:
    blocks: list[Block] = [
        Heading("Balancing (`abu balance`)", "id"),
        Heading("grinder --fast"),
        Facts((("mass", "m", "5 kg (--set)"),)),
        Grid(("name",), (("`abu size`",),)),
        Picture(("o",), "A ball. `abu size FILE` draws it."),
    ]
    assert handed_over(blocks) == [
        Heading("Balancing", "id"), Heading("grinder --fast"), Facts((("mass", "m", "5 kg"),)),
        Grid(("name",), (("`abu size`",),)), Picture(("o",), "A ball."),
    ]  # fmt: skip


def test_figures_note_and_summary_lose_commands() -> None:
    chart = Bars("A", "told", Axis("x [dB]", 0.0, 1.0), [Bar("a", 1.0, "1")])
    advice = Paragraph("See `abu explain ABU401`.")
    extras = Extras((Figure("a", "", chart, "Levels. Ask: --full."),), (advice,), (Heading("Grinder"), advice))
    shown = extras_handed_over(extras)
    assert (shown.figures[0].caption, shown.note, shown.summary) == ("Levels.", (), (Heading("Grinder"),))
