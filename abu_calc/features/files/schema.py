"""`abu schema [machine|scene|readings|recordings|result]`: JSON Schema of files, for editors, or of results."""

from typing import Annotated, Any

import typer

from abu_calc.cli.command import add_command
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.outcome import Outcome, to_json

KINDS = ("machine", "scene", "readings", "recordings", "result")


def schema(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="machine|scene|readings|recordings|result",
            help="Kind of file, or result for the output of --json.",
        ),
    ] = "machine",
) -> Outcome:
    """Print the JSON Schema of a kind of files or of results.

    Schemas of files are of draft 4, which editors read; that of results is of 2020-12.
    """
    if kind not in KINDS:
        raise InputError("no schema of this kind", found=kind, allowed=", ".join(KINDS))
    json_schema = _schema(kind)
    return Outcome("schema", json_schema, (), plain=to_json(json_schema) + "\n")


def _schema(kind: str) -> dict[str, Any]:
    if kind == "result":
        from abu_calc.features.files.result_schema import result_schema

        return result_schema()
    from abu_calc.inputs.reading.schema import schema_of

    return schema_of(kind)


def register(app: typer.Typer) -> None:
    """Add the command."""
    add_command(app, "schema", schema, formats=(".json", ".txt"))
