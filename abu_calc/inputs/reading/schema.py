"""JSON Schema of the files, in Draft 4, which TOML editors (Taplo, Even Better TOML) read.

Template of a new file, with every table and key explained, made from the models.
"""

import json
import textwrap
from typing import Any, Final

from pydantic.fields import FieldInfo
from pydantic.json_schema import models_json_schema

from abu_calc.foundation.written_units import written_unit
from abu_calc.inputs.reading.kinds import BY_NAME
from abu_calc.inputs.reading.table import Table, all_tables, is_array, subtable
from abu_calc.inputs.reading.text import FORMAT, KEY, key_path, shown
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


WIDTH: Final = 90
HEAD: Final = (
    "A {kind} file of abu-calc. Put in your own numbers; the unit stands in the key, or behind the number: "
    'mass_kg = 5.6 or mass = "5.6 kg". Keys and tables with a # right before them are optional: take the # away to use '
    "them."
)
ABOUT_FORMAT: Final = "Format of this file. Its number goes up if keys change in later versions."
FIRST: Final = (
    "Values without a # are those of an example. Replace those of [machine], [suspension] and [wheel], and in "
    "[autobalancer] the room: max_outer_diameter_mm, max_width_mm and bore_diameter_mm. Values called assumed may "
    "stay: reports say what they move. A preset may be nearer to your machine: `abu presets` lists them, and "
    "`abu init FILE --preset NAME` copies one."
)


def template_of(kind: str) -> str:
    """Text of a complete file of a kind, made from its model; it reads back without error.

    Required keys carry example values, keys with a default carry it, all others are commented out.
    """
    model = BY_NAME[kind].model
    head = f"{HEAD.format(kind=kind)} {FIRST}" if kind == "machine" else HEAD.format(kind=kind)
    return (
        "\n".join([*_comment(head), "", *_comment(ABOUT_FORMAT), f"{KEY} = {FORMAT}", *_tables(model, (), live=True)])
        + "\n"
    )


def _tables(model: type[Table], path: tuple[str, ...], *, live: bool) -> list[str]:
    rows: list[str] = []
    for key, field in model.model_fields.items():
        inner = subtable(model, key)
        array = is_array(model, key)
        shows = live and (field.is_required() or key in model.shown_in_template or key == "limits")
        if inner and inner.inline:
            continue
        if inner:
            rows += _table(inner, (*path, key), live=shows, array=array)
        elif not path:
            rows += ["", *_comment(field.description or ""), f"#[{key}]"]
    return rows


def _table(model: type[Table], path: tuple[str, ...], *, live: bool, array: bool) -> list[str]:
    name = f"[[{key_path(path)}]]" if array else f"[{key_path(path)}]"
    rows = ["", *_comment(model.__doc__ or ""), _row(name, live)]
    for key, field in model.model_fields.items():
        inner = subtable(model, key)
        if not inner or inner.inline:
            rows += [*_comment(field.description or ""), _key(model, key, field, live=live)]
    return rows + _tables_inside(model, path, live=live)


def _tables_inside(model: type[Table], path: tuple[str, ...], *, live: bool) -> list[str]:
    return _tables(model, path, live=live) if any(subtable(model, key) for key in model.model_fields) else []


def _key(model: type[Table], key: str, field: FieldInfo, *, live: bool) -> str:
    inner = subtable(model, key)
    default = None if field.is_required() or (key in model.shown_in_template and field.examples) else field.default
    given = default if default is not None else (field.examples or [None])[0]
    shows = field.is_required() or (field.default is not None and not inner) or key in model.shown_in_template
    return _row(f"{key} = {_inline(inner, given) if inner else shown(given)}", live and shows)


def _inline(model: type[Table], example: object) -> str:
    """A table in one line: its example, or those of the keys it must have."""
    held = example if isinstance(example, dict) else {}
    keys = held or {
        key: field.examples[0] for key, field in model.model_fields.items() if field.is_required() and field.examples
    }
    return "{ " + ", ".join(f"{key} = {shown(value)}" for key, value in keys.items()) + " }"


def _row(text: str, live: bool) -> str:
    return text if live else f"#{text}"


def _comment(text: str) -> list[str]:
    return [f"# {line}" for line in textwrap.wrap(" ".join(text.split()), WIDTH, break_on_hyphens=False)]
