"""`abu schema [machine|scene|readings|recordings|result]`: JSON Schema of files, for editors, or of results."""

from typing import Any

from abu_calc.cli.command import Command, Option
from abu_calc.foundation.errors import InputError
from abu_calc.reporting.outcome import Outcome, to_json

KINDS = ("machine", "scene", "readings", "recordings", "result")


def schema(kind: str = "machine") -> Outcome:
    """JSON Schema of a kind of files or of results."""
    if kind not in KINDS:
        raise InputError("no schema of this kind", found=kind, allowed=", ".join(KINDS))
    json_schema = _schema(kind)
    return Outcome("schema", json_schema, (), plain=to_json(json_schema) + "\n")


def _schema(kind: str) -> dict[str, Any]:
    if kind == "result":
        from abu_calc.features.files.result_schema import result_schema

        return result_schema()
    from abu_calc.inputs.reading.kinds import BY_NAME

    json_schema: dict[str, Any] = BY_NAME[kind].call("schema")
    return json_schema


COMMAND = Command(
    schema,
    (Option("kind", str, "|".join(KINDS), "Kind of file, or result for the output of --json.", default="machine"),),
    "Schemas of files are of draft 4, which editors read; that of results is of 2020-12.",
    formats=(".json", ".txt"),
)
