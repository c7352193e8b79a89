"""Common parts of all tables of a file: strictness, the defaults in force, the rules between keys.

A key's usual range is data beside its field: narrower than the permitted range, wide if practice is wide. A number
outside is read and warned of: most such numbers are in the wrong unit. Zero is not, it says "none" (of levels it does
not); of a negative number the size counts.

A key with a unit is read in SI by the name of its quantity: `wheel.diameter` [m] is `wheel.diameter_mm`.

A description writes {range} ("above 0 … 100, usually 1 … 20"), {most} ("100"), {usual} ("usually 1 … 20")
and {default} where they belong in its sentence; the key's bounds and defaults are put in.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from typing import Annotated, Any, ClassVar, Final, NamedTuple, Self, TypeVar, cast, get_args, get_origin

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, model_validator
from pydantic.config import JsonDict
from pydantic.fields import FieldInfo
from pydantic_core import PydanticCustomError, PydanticKnownError

from abu_calc.foundation.errors import LINE_BREAKS
from abu_calc.foundation.units import SI_PER_UNIT, quantity_and_unit
from abu_calc.foundation.validity import bounded
from abu_calc.inputs.reading.text import Part, shown, shown_short

T = TypeVar("T")
Many = Annotated[tuple[T, ...], Field(strict=False)]
"""A list of a file; `entry` says how long it may be."""

WORD: Final = "x-usual"
"""The word of the schema: [lowest, highest]."""


class Usual(NamedTuple):
    """A usual range, in the unit of its key."""

    low: float
    high: float

    def holds(self, value: float) -> bool:
        """True if a number is zero or within the usual range, so that no question arises.

        >>> usual = Usual(1, 1000)
        >>> [usual.holds(value) for value in (0, 0.1, -200, 2000)]
        [True, False, True, False]
        """
        return value == 0 or self.low <= abs(value) <= self.high

    def __str__(self) -> str:
        return f"{bounded(self.low)} … {bounded(self.high)}"


def usual(low: float, high: float) -> JsonDict:
    """A field's usual range, for its `json_schema_extra`."""
    return {WORD: [low, high]}


class entry:  # noqa: N801 - written like a function, beside each key
    """Field of a key, declared in one line, its meaning below.

    >>> class Wheel(Table):
    ...     mass_kg: float = entry(0.5, gt=0, le=50, usual=(0.1, 5)).means("Mass [kg]; {range}. Default: {default}.")
    >>> Wheel.model_fields["mass_kg"].description
    'Mass [kg]; above 0 … 50, usually 0.1 … 5. Default: 0.5.'
    """

    def __init__(
        self, default: object = ..., *, usual: tuple[float, float] | None = None, example: object = None, **limits: Any
    ) -> None:
        """A key without a default must be given; `limits`: bounds, lengths and pattern, named as pydantic does."""
        has_default = {} if default is ... else {"default": default}
        has_usual = {} if usual is None else {"json_schema_extra": {WORD: [*usual]}}
        has_example = {} if example is None else {"examples": [example]}
        self.given: dict[str, Any] = has_default | limits | has_usual | has_example

    def means(self, text: str) -> Any:
        """Field with its description."""
        return Field(description=text, **self.given)


def usual_of(field: FieldInfo) -> Usual | None:
    """The usual range of a field, where it has one."""
    extra = field.json_schema_extra
    if not isinstance(extra, dict) or WORD not in extra:
        return None
    return Usual(*cast("list[float]", extra[WORD]))


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


RULE = "rule"
"""Type of the errors that `problem` makes, among those of pydantic."""

LEAST: Final = 1e-12
"""Least magnitude of a number that is not zero, in the unit of its key: squares of smaller ones are lost in rounding,
and those of the smallest are zero, by which formulas divide."""


class Table(BaseModel):
    """A table of a file: strict (no text for a number), frozen, every number finite, unknown keys refused.

    A number is zero or of a magnitude that can be computed with, see LEAST.
    """

    # Built when first used: a file with bearings alone does not pay for the machine.
    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False, defer_build=True)

    shown_in_template: ClassVar[frozenset[str]] = frozenset()
    """Keys without a default that a new file should nevertheless show live."""

    inline: ClassVar[bool] = False
    """True if a new file writes the table in one line, `key = { … }`."""

    example_defaults: ClassVar[frozenset[str]] = frozenset()
    """Keys whose default is an example's, or a guess, and never that of the machine at hand."""

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: object) -> None:
        """Bounds and defaults stand in the fields alone: their descriptions are made of them."""
        for field in cls.model_fields.values():
            field.description = described(field)

    @model_validator(mode="after")
    def _magnitudes(self) -> Self:
        for key in type(self).model_fields:
            for number in numbers_in(getattr(self, key)):
                if 0 < abs(number) < LEAST:
                    raise problem(
                        "too small to compute with",
                        key,
                        found=f"{number:g}",
                        allowed=f"0 or a magnitude of at least {LEAST:g}, in the range of the key",
                        remedy="correct the number; its unit stands in the key",
                    )
        return self

    def __getattr__(self, name: str) -> Any:
        """The value of a key in SI, by the name of its quantity.

        >>> class Wheel(Table):
        ...     radius_mm: float = 50.0
        >>> Wheel().radius
        0.05
        """
        key, size = in_si(type(self)).get(name, (None, 1.0))
        return super().__getattr__(name) if key is None else _times(getattr(self, key), size)  # type: ignore[misc]

    @classmethod
    def displaced_by(cls, key: str, value: object) -> tuple[str, ...]:
        """The keys that make no sense beside `key = value`: an override of one takes the others' place.

        Those of other tables with their table: "autobalancer.rolling_drag_per_s".
        """
        return ()

    def unused(self) -> frozenset[str]:
        """Keys that play no part, given the other keys: not listed as defaults in force, warned of where given."""
        return frozenset()

    def borrowed(self) -> tuple[str, ...]:
        """Keys left out, though their default is example data and plays a part."""
        silent = self.model_fields_set | self.unused()
        return tuple(key for key in type(self).model_fields if key in self.example_defaults and key not in silent)

    def contradictions(self) -> Iterator[tuple[tuple[str, ...], str]]:
        """Numbers that are unusual together, though each may stand alone.

        Each item is a path below this table, and words on it.
        """
        return iter(())

    def in_si(self) -> dict[str, Any]:
        """Values in SI by the names of their quantities, of all keys that have one and play a part.

        >>> class Wheel(Table):
        ...     radius_mm: float = 50.0
        ...     width_mm: float | None = None
        >>> Wheel().in_si()
        {'radius': 0.05}
        """
        silent = self.unused()
        values = ((name, getattr(self, name)) for name, (key, _) in in_si(type(self)).items() if key not in silent)
        return {name: value for name, value in values if value is not None}

    def own_defaults(self) -> dict[str, object]:
        """The defaults in force in this table, in the order of its keys."""
        silent = self.model_fields_set | self.unused()
        return {
            key: value
            for key, value in ((key, getattr(self, key)) for key in type(self).model_fields)
            if key not in silent and value is not None and not isinstance(value, (Table, dict)) and value != ()
        }

    def defaults(self) -> Iterator[tuple[tuple[Part, ...], object]]:
        """The defaults in force in this table and those inside it, with their paths."""
        for path, table in self.tables():
            for key, value in table.own_defaults().items():
                yield (*path, key), value

    def given_in_vain(self) -> Iterator[tuple[Part, ...]]:
        """Paths of the keys that were given and play no part, given the others."""
        for path, table in self.tables():
            for key in sorted(table.unused() & table.model_fields_set):
                yield (*path, key)

    def tables(self, path: tuple[Part, ...] = ()) -> "Iterator[tuple[tuple[Part, ...], Table]]":
        """Table itself and those inside it, with their paths."""
        yield path, self
        for key in type(self).model_fields:
            value = getattr(self, key)
            if isinstance(value, Table):
                yield from value.tables((*path, key))
            elif isinstance(value, tuple):
                for index, item in enumerate(value):
                    if isinstance(item, Table):
                        yield from item.tables((*path, key, index))


@cache
def in_si(model: type[Table]) -> Mapping[str, tuple[str, float]]:
    """The keys of a table by the names of their quantities, and the SI value of one unit of each."""
    named = ((key, *quantity_and_unit(key)) for key in model.model_fields)
    return {name: (key, SI_PER_UNIT.get(unit, 1.0)) for key, name, unit in named}


def _times(value: Any, factor: float) -> Any:
    """A number, or those of a list, times a factor; anything else as it is."""
    if factor == 1 or not isinstance(value, (int, float, tuple)):
        return value
    return tuple(_times(inner, factor) for inner in value) if isinstance(value, tuple) else value * factor


def numbers_in(value: object) -> Iterator[float]:
    """The number that a key has, or those of its lists."""
    if isinstance(value, tuple):
        for inner in value:
            yield from numbers_in(inner)
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield value


def subtable(model: type[Table], key: str) -> type[Table] | None:
    """The model of the table or array of tables under a key of a model, if it is one."""
    field = model.model_fields.get(key)
    return _table_in(field.annotation) if field else None


def _table_in(annotation: object) -> type[Table] | None:
    if isinstance(annotation, type) and issubclass(annotation, Table):
        return annotation
    return next((table for table in map(_table_in, get_args(annotation)) if table), None)


def is_array(model: type[Table], key: str) -> bool:
    """True if a key of a model takes an array (of tables, or of numbers)."""
    return "tuple" in str(model.model_fields[key].annotation)


def table_at(model: type[Table], path: tuple[Part, ...]) -> type[Table] | None:
    """The model of the table at a path below `model`."""
    table: type[Table] | None = model
    for part in path:
        if isinstance(part, str) and table is not None:
            table = subtable(table, part)
    return table


def all_tables(model: type[Table], path: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], type[Table]]]:
    """Every table below a model, with its path."""
    for key in model.model_fields:
        if inner := subtable(model, key):
            yield (*path, key), inner
            yield from all_tables(inner, (*path, key))


def problem(
    message: str, *key: Part, found: str | None = None, allowed: str | None = None, remedy: str | None = None
) -> PydanticCustomError:
    """A broken rule between keys, placed at `key` (a path below the table that raises it)."""
    facts = {"message": message, "key": key, "found": found, "allowed": allowed, "remedy": remedy}
    return PydanticCustomError(RULE, "{message}", facts)


def one_line(text: str) -> str:
    """A name as it is, refused where it has lines: reports print it, and it may not begin one of its own."""
    if any(sign in LINE_BREAKS for sign in text):
        raise problem("a name stands on one line", found=shown_short(text), remedy="write it without line breaks")
    return text


Name = Annotated[str, AfterValidator(one_line)]
"""Name that people give to a thing, as reports show it."""


def boxed(value: object) -> object:
    """A single value as a list of one, for keys that take either."""
    return value if isinstance(value, (list, tuple, dict)) else [value]


def whole(value: object) -> object:
    """The value itself unless it is true or false, which Python takes for 1 and 0."""
    if isinstance(value, bool):
        raise PydanticKnownError("int_type")
    return value
