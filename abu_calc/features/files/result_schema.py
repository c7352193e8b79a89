"""The JSON Schema of results, drawn from their types: what `--json` prints, key by key."""

import types
from collections.abc import Mapping
from typing import Annotated, Any, Final, Literal, Union, get_args, get_origin, get_type_hints

from abu_calc.foundation.checks import Check, Status
from abu_calc.foundation.quantity import Record, described, hints, quantities
from abu_calc.inputs.reading.schema import HOME
from abu_calc.registry import VIEWS, imported
from abu_calc.simulation.result import Result

DRAFT: Final = "https://json-schema.org/draft/2020-12/schema"

RESULTS: Final[tuple[type[Result], ...]] = tuple(map(imported, VIEWS))

SIMPLE: Final = {int: "integer", float: "number", str: "string", bool: "boolean", type(None): "null"}

Schema = dict[str, Any]


def result_schema() -> Schema:
    """The schema of the documents that `--json` prints; each command's result under its name among the definitions."""
    definitions: dict[str, Schema] = {}
    results = [_of_command(command, definitions) for command in dict.fromkeys(kind.command for kind in RESULTS)]
    return {
        "$schema": DRAFT,
        "$id": f"{HOME}abu-calc-result.json",
        "title": "abu-calc results",
        "type": "object",
        "properties": _envelope(definitions),
        "required": ["abu", "input", "status", "checks", "result", "model", "warnings"],
        "allOf": results,
        "$defs": definitions,
    }


def _envelope(definitions: dict[str, Schema]) -> Schema:
    """Properties of every document; a document of an error has `error` and no result."""
    text, anything = {"type": "string"}, {"type": "object"}
    source = _object(file={"anyOf": [text, {"type": "null"}]}, sha256=text, overrides=anything, defaults=anything)
    check = {name: _type(hint, definitions) for name, hint in get_type_hints(Check).items()}
    return {
        "abu": _object(version=text, command=text, schema={"type": "integer"}, date=text),
        "input": {"anyOf": [source, {"type": "null"}]},
        "status": _type(Status, definitions),
        "checks": {"type": "array", "items": _object(**check, change={"anyOf": [anything, {"type": "null"}]})},
        "result": {},
        "model": anything,
        "warnings": {"type": "array", "items": text},
        "error": {"type": "object", "properties": {"kind": text, "message": text}, "required": ["kind", "message"]},
    }


def _object(**properties: Schema) -> Schema:
    """An object with all of these."""
    return {"type": "object", "properties": properties, "required": list(properties)}


def _of_command(name: str, definitions: dict[str, Schema]) -> Schema:
    """Schema rule of one command: its documents without an error have this result and this model."""
    command = {"properties": {"abu": {"properties": {"command": {"const": name}}}}}
    kinds = [
        {
            "properties": {
                "result": _type(kind.json_type(), definitions),
                "model": _type(hints(kind)["model"], definitions),
            }
        }
        for kind in RESULTS
        if kind.command == name
    ]
    good = {"not": {"required": ["error"]}}
    return {"if": {"allOf": [command, good]}, "then": kinds[0] if len(kinds) == 1 else {"anyOf": kinds}}


def _record(kind: type[Record], definitions: dict[str, Schema]) -> Schema:
    """A reference to the definition of a record."""
    title = kind.title_in_schema()
    if title not in definitions:
        definitions[title] = {}  # known from here on, should it hold itself
        names, labelled = kind.entries(), quantities(kind)
        properties = {name: _type(hints(kind)[name], definitions) for name in names}
        for name in names:
            if name in labelled:
                properties[name] = {"description": described(name, labelled[name]), **properties[name]}
        definitions[title] = {
            "type": "object",
            "description": (kind.__doc__ or "").split("\n\n")[0].strip(),
            "properties": properties,
            "required": [name for name in names if name not in kind.optional],
        }
    return {"$ref": f"#/$defs/{title}"}


def _type(hint: Any, definitions: dict[str, Schema]) -> Schema:
    """The schema of a type."""
    origin, arguments = get_origin(hint), get_args(hint)
    if isinstance(hint, type) and issubclass(hint, tuple):  # a tuple whose items have names
        origin, arguments = tuple, tuple(get_type_hints(hint).values())
    if hint is Any:
        return {}
    if origin is Annotated:
        return _type(arguments[0], definitions)
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin in (Union, types.UnionType):
        return {"anyOf": [_type(argument, definitions) for argument in arguments]}
    if origin is tuple:
        length = {} if Ellipsis in arguments else {"minItems": len(arguments), "maxItems": len(arguments)}
        return {"type": "array", "items": _items(arguments, definitions), **length}
    if isinstance(origin, type) and issubclass(origin, Mapping):
        return {"type": "object", "additionalProperties": _type(arguments[1], definitions)}
    if isinstance(hint, type) and issubclass(hint, Record):
        return _record(hint, definitions)
    return {"type": SIMPLE[hint]}


def _items(arguments: tuple[Any, ...], definitions: dict[str, Schema]) -> Schema:
    kinds = [argument for argument in dict.fromkeys(arguments) if argument is not Ellipsis]
    return _type(kinds[0], definitions) if len(kinds) == 1 else {"anyOf": [_type(kind, definitions) for kind in kinds]}
