"""Descriptions of keys, with their bounds and defaults put in.

A description writes {range} ("above 0 … 100, usually 1 … 20"), {most} ("100"), {usual} ("usually 1 … 20")
and {default} where they belong in its sentence.
"""

from collections.abc import Iterator
from typing import Annotated, get_args, get_origin

from pydantic.fields import FieldInfo

from abu_calc.spec.text import shown
from abu_calc.spec.usual import usual_of
from abu_calc.validity import bounded


def described(field: FieldInfo) -> str | None:
    """The description of a key, its own bounds and default put in."""
    text = field.description
    if text is None or "{" not in text:
        return text
    bounds = dict(_bounds(field))
    low = bounded(bounds["ge"]) if "ge" in bounds else f"above {bounded(bounds['gt'])}" if "gt" in bounds else ""
    most = bounded(bounds["le"]) if "le" in bounds else ""
    default = field.default if isinstance(field.default, str) else _default(field.default)
    usual = _usual(field, signed=bounds.get("ge", 0) < 0)
    whole = ", ".join(part for part in (f"{low} … {most}", usual) if part)
    return text.format(range=whole, most=most, usual=usual, default=default)


def _usual(field: FieldInfo, *, signed: bool) -> str:
    usual = usual_of(field)
    return f"usually {usual}{' either way' if signed else ''}" if usual else ""


def _default(value: object) -> str:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return bounded(value) if is_number else shown(value)  # type: ignore[arg-type]


def _bounds(field: FieldInfo) -> Iterator[tuple[str, float]]:
    """Bounds of a number, or of the numbers of a list: name and value."""
    for limit in field.metadata:
        for name in ("ge", "gt", "le"):
            if (value := getattr(limit, name, None)) is not None:
                yield name, value
    yield from _bounds_inside(field.annotation)


def _bounds_inside(annotation: object) -> Iterator[tuple[str, float]]:
    if get_origin(annotation) is Annotated:
        for constraint in get_args(annotation)[1:]:
            if isinstance(constraint, FieldInfo):
                yield from _bounds(constraint)
    for inner in get_args(annotation):
        yield from _bounds_inside(inner)
