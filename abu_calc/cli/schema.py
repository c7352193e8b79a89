"""`abu schema [machine|scene]`: the JSON Schema of the files, for editors."""

from typing import Annotated

import typer

from abu_calc.cli.command import add_command
from abu_calc.errors import InputError
from abu_calc.report.outcome import Outcome, to_json

KINDS = ("machine", "scene")


def schema(
    kind: Annotated[str, typer.Argument(metavar="[machine|scene]", help="Which kind of file.")] = "machine",
) -> Outcome:
    """Print the JSON Schema (draft 4) of machine or scene files, as the editor plugin Even Better TOML takes it."""
    from abu_calc.spec.schema import machine_schema, scene_schema

    if kind not in KINDS:
        raise InputError("no schema of this kind", found=kind, allowed=", ".join(KINDS))
    found = scene_schema() if kind == "scene" else machine_schema()
    return Outcome("schema", found, (), plain=to_json(found) + "\n")


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "schema", schema)
