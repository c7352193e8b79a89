"""Presets and JSON Schemas, as `abu presets` and `abu schema` print them: schemas for editors, or of results."""

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_file
from abu_calc.inputs.reading.schema import schema_of
from abu_calc.inputs.reading.sources import names, text_of
from abu_calc.reporting.blocks import Grid, Heading, Paragraph
from abu_calc.reporting.outcome import Outcome, to_json

KINDS = ("machine", "scene", "readings", "recordings", "result")


def presets(name: str | None = None) -> Outcome:
    """List of the presets, or the text of one."""
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


def schema(kind: str = "machine") -> Outcome:
    """JSON Schema of a kind of files or of results."""
    if kind not in KINDS:
        raise InputError("no schema of this kind", found=kind, allowed=", ".join(KINDS))
    if kind == "result":
        from abu_calc.features.files.result_schema import result_schema  # loads all features

        json_schema = result_schema()
    else:
        json_schema = schema_of(kind)
    return Outcome("schema", json_schema, (), plain=to_json(json_schema) + "\n")
