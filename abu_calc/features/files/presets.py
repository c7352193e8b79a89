"""`abu presets [NAME]`: list the presets, or print one."""

from abu_calc.cli.command import Command, Option
from abu_calc.reporting.blocks import Grid, Heading, Paragraph
from abu_calc.reporting.outcome import Outcome


def presets(name: str | None = None) -> Outcome:
    """List of the presets, or the text of one."""
    from abu_calc.inputs.read_machine import read_file
    from abu_calc.inputs.reading.sources import names, text_of

    if name is not None:
        text = text_of(name)
        return Outcome("presets", {"name": name, "text": text}, (), plain=text, plain_suffix=".toml")
    listed = [{"name": each, "machine": read_file(each).title} for each in names()]
    blocks = (
        Heading("Presets"),
        Grid(("name", "machine or roll"), tuple((each["name"], each["machine"]) for each in listed)),
        Paragraph("A preset's name serves wherever a file of its kind is asked for: abu size avtovaz-707-222"),
    )
    return Outcome("presets", {"presets": listed}, blocks)


COMMAND = Command(
    presets,
    (Option("name", str, "NAME", "Print this preset."),),
    formats=(".toml", ".json", ".txt", ".csv and .html (list only)"),
)
