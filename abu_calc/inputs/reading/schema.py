"""JSON Schema of the files, in Draft 4, which TOML editors (Taplo, Even Better TOML) read."""

from typing import Any, Final

from pydantic.json_schema import models_json_schema

from abu_calc.inputs.machine import BearingFile, MachineFile
from abu_calc.inputs.reading.table import Table
from abu_calc.inputs.scene import SceneFile
from abu_calc.inputs.two_races import TwoRaceFile

DRAFT: Final = "http://json-schema.org/draft-04/schema#"
MACHINE: Final = "Machine"
"""Name by which editors know a whole machine's file."""

_BOUNDS: Final = {"exclusiveMinimum": "minimum", "exclusiveMaximum": "maximum"}
_DROPPED: Final = ("title", "examples", "$defs")


def machine_schema() -> dict[str, Any]:
    """The schema of machine files: a whole machine with one race or two, or bearings alone."""
    kinds = [{"$ref": f"#/definitions/{name}"} for name in (MACHINE, TwoRaceFile.__name__, BearingFile.__name__)]
    return schema_of("machine", MachineFile, TwoRaceFile, BearingFile) | {"anyOf": kinds}


def scene_schema() -> dict[str, Any]:
    """The schema of scene files."""
    return schema_of("scene", SceneFile) | {"allOf": [{"$ref": f"#/definitions/{SceneFile.__name__}"}]}


def schema_of(kind: str, *models: type[Table]) -> dict[str, Any]:
    """Head and definitions of the schema of a kind of file."""
    _, schema = models_json_schema([(model, "validation") for model in models])
    bodies = {MACHINE if name == MachineFile.__name__ else name: body for name, body in schema["$defs"].items()}
    definitions = {name: _draft4(body) for name, body in bodies.items()}
    return {"$schema": DRAFT, "title": f"abu-calc {kind} file", "definitions": definitions}


def _draft4(node: Any) -> Any:
    """A schema of Draft 2020-12 as pydantic writes it, in the words of Draft 4."""
    if isinstance(node, list):
        return [_draft4(item) for item in node]
    if not isinstance(node, dict):
        return node
    old: dict[str, Any] = {}
    for word, value in node.items():
        if word in _BOUNDS:
            old |= {_BOUNDS[word]: value, word: True}
        elif word == "properties":
            old[word] = {name: _draft4(body) for name, body in value.items()}
        elif word == "const":
            old["enum"] = [value]
        elif word == "$ref":
            old[word] = value.replace("#/$defs/", "#/definitions/")
        elif word == "default":
            # What is absent has no default in TOML, and tables are described by their own keys.
            old |= {} if value is None or isinstance(value, (dict, list)) else {word: value}
        elif word not in _DROPPED:
            old[word] = _draft4(value)
    return _without_null(old)


def _without_null(node: dict[str, Any]) -> dict[str, Any]:
    """TOML has no null: a key that may be absent is simply not required."""
    kinds = [kind for kind in node.get("anyOf", []) if kind != {"type": "null"}]
    if len(kinds) == 1:
        rest = {word: value for word, value in node.items() if word != "anyOf"}
        return {**kinds[0], **rest}
    return {**node, "anyOf": kinds} if kinds else node
