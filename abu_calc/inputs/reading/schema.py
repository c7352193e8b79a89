"""JSON Schema of the files, in Draft 4, which TOML editors (Taplo, Even Better TOML) read."""

import json
from typing import Any, Final

from pydantic.json_schema import models_json_schema

from abu_calc.foundation.written_units import written_unit
from abu_calc.inputs.reading.format import FORMAT, KEY
from abu_calc.inputs.reading.kinds import BY_NAME
from abu_calc.inputs.reading.table import Table, all_tables
from abu_calc.inputs.reading.values_with_units import canonical_keys

HOME: Final = "https://json.schemastore.org/"
"""Where the public schema store serves schemas; its names are those of the files of the bundle."""
DRAFT: Final = "http://json-schema.org/draft-04/schema#"
NAMES: Final = {"MachineFile": "Machine"}
"""Names by which editors know a model that is called otherwise here."""

_BOUNDS: Final = {"exclusiveMinimum": "minimum", "exclusiveMaximum": "maximum"}
_DROPPED: Final = ("title", "examples", "$defs")


def schema_of(kind: str) -> dict[str, Any]:
    """The schema of a kind of file: of a machine that of a whole machine with one race or two, or of bearings alone."""
    models = BY_NAME[kind].all_models()
    _, schema = models_json_schema([(model, "validation") for model in models])
    _add_values_with_units(schema["$defs"], models)
    for model in models:
        schema["$defs"][model.__name__]["properties"][KEY] = _FORMAT
    definitions = {NAMES.get(name, name): _draft4(body) for name, body in schema["$defs"].items()}
    files = [{"$ref": f"#/definitions/{NAMES.get(model.__name__, model.__name__)}"} for model in models]
    return {
        "$schema": DRAFT,
        "id": f"{HOME}abu-calc-{kind}.json",
        "title": f"abu-calc {kind} file",
        "description": f"A {kind} file of abu-calc, format {FORMAT}.",
        "type": "object",
        "definitions": definitions,
        "allOf" if len(files) == 1 else "anyOf": files,
    }


def _add_values_with_units(definitions: dict[str, Any], models: tuple[type[Table], ...]) -> None:
    """Adds to each key with a unit the key without it, which takes a text of number and unit; never both."""
    kinds = {table.__name__: table for model in models for _, table in (((), model), *all_tables(model))}
    for name, kind in kinds.items():
        body = definitions.get(name, {})
        for stem, key in canonical_keys(kind).items():
            entry = body["properties"][key]
            if not _numeric(entry):
                continue
            body["properties"][stem] = {**_with_unit(entry, key), CANONICAL: key}
            pair = [{"required": [key]}, {"required": [stem]}]
            if key in body.get("required", ()):
                body["required"] = [name for name in body["required"] if name != key]
                rule: dict[str, Any] = {"oneOf": pair}
            else:
                rule = {"not": {"required": [key, stem]}}
            body.setdefault("allOf", []).append(rule)
        if not body.get("required", True):
            del body["required"]


def _numeric(entry: Any) -> bool:
    return '"number"' in json.dumps(entry) or '"integer"' in json.dumps(entry)


def _with_unit(entry: dict[str, Any], key: str) -> dict[str, Any]:
    unit = written_unit(key)
    assert unit is not None
    units = "|".join(_spelled(each) for each in unit.allowed)
    text = {"type": "string", "pattern": rf"^[+-]?[0-9]+(\.[0-9]+)?([eE][+-]?[0-9]+)?({units})$"}
    listed = {"type": "array", "items": {"anyOf": [text, {"type": "array", "items": text}]}}
    kinds = json.dumps(entry)
    takes = {"anyOf": [text, listed]} if '"array"' in kinds else text
    words = f"{key} with its unit: a text of a number and one of {', '.join(unit.allowed)}."
    return {"description": f"{words} {entry.get('description', '')}".strip(), **takes}


_FORMAT: Final = {
    "type": "integer",
    "minimum": 1,
    "maximum": FORMAT,
    "description": f"Format of the file; newest: {FORMAT}. Optional.",
}


def _spelled(unit: str) -> str:
    """A pattern for a unit in all its spellings, with the blank before it."""
    blank = " " if unit[0] == "1" else " ?"
    for sign, spellings in (("·", "[·⋅* ]"), ("²", "(²|\\^?2)"), ("³", "(³|\\^?3)"), ("µ", "[µμu]")):
        unit = unit.replace(sign, spellings)
    return blank + unit


CANONICAL: Final = "x-canonical-key"
"""Word of the schema at a key without its unit: the key that results and other files have."""


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
