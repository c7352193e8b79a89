"""Template of a new file, with every table and key explained, made from the models."""

import textwrap
from typing import Final

from pydantic.fields import FieldInfo

from abu_calc.inputs.reading.format import FORMAT, KEY
from abu_calc.inputs.reading.kinds import BY_NAME
from abu_calc.inputs.reading.table import Table, is_array, subtable
from abu_calc.inputs.reading.text import key_path, shown

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
