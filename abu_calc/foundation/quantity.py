"""Records: parts of a result whose fields carry unit, label, symbol, digits and meaning.

    @record
    class Autobalancer(Record):
        ball_diameter_mm: Annotated[float, Quantity("ball diameter", "2r", 5)]

Label, symbol, digits and meaning stand beside the type. A field with a unit beside its type is in SI:

    race_radius: Annotated[float, Quantity("race radius", "R", unit="mm")]

Its entry `race_radius_mm` in results and in Python is made when somebody asks for it; so is all that a record is
written as: text, JSON, CSV and the JSON Schema of results. A field without one is as its name says.
"""

import datetime
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, FrozenInstanceError, dataclass, fields
from inspect import cleandoc, getattr_static
from operator import attrgetter
from types import NoneType
from typing import Any, ClassVar, Final, NamedTuple, Never, Self, TypeVar, dataclass_transform, get_args, get_type_hints

from abu_calc.foundation.rows import Rows, as_rows
from abu_calc.foundation.units import SI_PER_UNIT, UNIT_BY_SUFFIX, quantity_and_unit, unit_of

T = TypeVar("T")

LONGEST: Final = 500
"""Characters of the longest text of a record."""


class Quantity(NamedTuple):
    """Name of a field as shown, its symbol and significant digits, and its meaning."""

    label: str
    symbol: str = ""
    digits: int = 4
    meaning: str = ""
    percent: bool = False
    """Shown in hundredths."""
    unit: str = ""
    """Of its entry, as keys carry it; the field is in SI and its name without one."""


LEVEL_AFTER: Final = Quantity(
    "level after",
    "L",
    4,
    "expected level with the autobalancer, its balls at rest where they balance, with the eccentricity and friction of "
    "manufacture (calculated); dB re 5e-8 m/s, rms; None: the balls cannot balance there. Simulated start cases, whose "
    "median reports call `Idle, with`, are ensemble.level_db",
)
"""The one meaning of `level_after_db`, at whatever place and speed its record names."""


@dataclass_transform(frozen_default=True, kw_only_default=True)
def record(kind: type[T]) -> type[T]:
    """Makes a class a record: a dataclass that cannot be changed, whose fields are given by name.

    Construction, comparison and text are those of `Record`: to write them for each class anew would take a good part
    of a command's start.
    """
    made = dataclass(init=False, eq=False, repr=False, match_args=False)(kind)
    made.__doc__ = _FieldsInDocstring(kind.__dict__.get("__doc__"))  # type: ignore[assignment]
    for name in kind.__annotations__:
        if name.endswith("_") and name not in _units(made):  # type: ignore[arg-type]  # a word of Python, such as with_
            setattr(made, name.removesuffix("_"), property(attrgetter(name)))
    return made


class _FieldsInDocstring:
    """Docstring of a record with its fields, made when somebody asks for it."""

    def __init__(self, text: object) -> None:
        self.text = text if isinstance(text, str) else ""

    def __get__(self, instance: object, kind: "type[Record]") -> str:
        listed = "\n".join(f"    {line}" for line in field_lines(kind))
        return f"{cleandoc(self.text)}\n\nFields:\n{listed}" if listed else self.text


def _entry(kind: "type[Record]", field: str) -> str:
    """Name of a field's entry in the result: with its unit; a field ends with _ if the name is a word of Python."""
    name, unit = field.removesuffix("_"), _units(kind).get(field, "")
    return f"{name}_{unit}" if unit else name


def _units(kind: "type[Record]") -> Mapping[str, str]:
    """Units of the fields that are in SI."""
    if kind not in _UNITS:
        written = any(isinstance(field.type, str) for field in _fields(kind))
        types = get_type_hints(kind, include_extras=True) if written else {}
        beside = (
            (field.name, getattr(types.get(field.name, field.type), "__metadata__", ())) for field in _fields(kind)
        )
        pairs = ((name, note.unit) for name, notes in beside for note in notes if isinstance(note, Quantity))
        _UNITS[kind] = {name: unit for name, unit in pairs if unit}
        if strange := [unit for unit in _UNITS[kind].values() if unit not in UNIT_BY_SUFFIX]:
            raise TypeError(
                f"{kind.__name__}: no conversion of {', '.join(strange)}; abu_calc.foundation.units has all"
            )
    return _UNITS[kind]


@record
class Record:
    """A part of a result. Fields in user units; None: not computed, a check or a warning says why."""

    left_out: ClassVar[frozenset[str]] = frozenset()
    """Fields that are no entries of the result."""
    optional: ClassVar[frozenset[str]] = frozenset()
    """Fields that are entries of the result only where they are not None: other scenes have no such thing."""
    schema_title: ClassVar[str] = ""
    """Name in the JSON Schema of results if it is not that of the class."""
    decimals: ClassVar[Mapping[str, int]] = {}
    """Decimals that `read` keeps of numbers in a unit, so that the rounding of the conversion does not show."""

    def __init__(self, **values: object) -> None:
        known = _fields(type(self))
        for field in known:
            if field.name not in values:
                values[field.name] = _default(type(self), field)
        if len(values) > len(known):
            unknown = values.keys() - {field.name for field in known}
            raise TypeError(f"{type(self).__name__} has no fields {', '.join(sorted(unknown))}")
        self.__dict__.update(values)
        for name, value in values.items():
            if type(value) is tuple and value:
                self.__dict__[name] = as_rows(value)

    def __getattr__(self, name: str) -> Any:
        """The entry of a field that is in SI, in its unit."""
        kind = type(self)
        if kind not in _CONVERSIONS:
            _CONVERSIONS[kind] = {
                _entry(kind, field.name): (field.name, _conversion(kind, field, unit))
                for field in _fields(kind)
                if (unit := _units(kind).get(field.name))
            }
        if name not in _CONVERSIONS[kind]:
            raise AttributeError(f"{kind.__name__} has no {name!r}", name=name, obj=self)
        field, convert = _CONVERSIONS[kind][name]
        value = getattr(self, field)
        return value if convert is None else convert(value)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.entries()})

    def __setattr__(self, name: str, value: object) -> Never:
        raise FrozenInstanceError(f"cannot assign to field {name!r}")

    def __delattr__(self, name: str) -> Never:
        raise FrozenInstanceError(f"cannot delete field {name!r}")

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        names = [field.name for field in fields(self) if field.compare]
        return all(getattr(self, name) == getattr(other, name) for name in names)

    def __hash__(self) -> int:
        return hash(type(self))  # what it holds need not be hashable

    def __repr__(self) -> str:
        values = (f"{field.name}={_short(getattr(self, field.name))}" for field in fields(self) if field.repr)
        text = f"{type(self).__name__}({', '.join(values)})"
        return text if len(text) <= LONGEST else f"{text[: LONGEST - 2]}…)"

    @classmethod
    def read(cls, *sources: object, **given: object) -> Self:
        """Record of what holds its quantities in SI, in the units that its fields name.

        A field is read from the attribute that has its name without the unit: `race_radius_mm` from `race_radius` [m];
        if there is none, from that of its own name, as it is. Tuples are read item by item, records within by their
        own `of` or `read`. A number that is not finite becomes None if the field may be None. Fields that are `given`
        are taken as they are; a field with a default keeps it if no source has its attribute. Raises TypeError if no
        source has the attribute of another, or if two have it.

        >>> from types import SimpleNamespace
        >>> @record
        ... class Race(Record):
        ...     race_radius_mm: float
        ...     ball_mass_g: float
        ...     ball_count: int
        >>> Race.read(SimpleNamespace(race_radius=0.031, ball_mass=0.0165), ball_count=4)
        Race(race_radius_mm=31.0, ball_mass_g=16.5, ball_count=4)
        """
        key = (cls, *map(type, sources), *given)
        if key not in _READERS:
            _READERS[key] = tuple(_readers(cls, sources, given))
        for name, source, attribute, convert in _READERS[key]:
            value = getattr(sources[source], attribute)
            given[name] = value if convert is None else convert(value)
        return cls(**given)

    @classmethod
    def title_in_schema(cls) -> str:
        """Name of the record among the definitions of the JSON Schema of results."""
        return cls.__dict__.get("schema_title") or cls.__name__

    @classmethod
    def entries(cls) -> tuple[str, ...]:
        """Names of the fields that are entries of the result, in order."""
        return tuple(_entry(cls, field.name) for field in _fields(cls) if field.name not in cls.left_out)

    def to_dict(self) -> dict[str, Any]:
        """The entries as JSON has them."""
        values = ((name, getattr(self, name)) for name in self.entries())
        return {name: as_plain(value) for name, value in values if value is not None or name not in self.optional}


def _fields(kind: type[Record]) -> "tuple[Field[Any], ...]":
    if kind not in _FIELDS:
        _FIELDS[kind] = fields(kind)
    return _FIELDS[kind]


def _default(kind: type[Record], field: "Field[object]") -> object:
    if field.default_factory is not MISSING:
        return field.default_factory()
    if field.default is MISSING:
        raise TypeError(f"{kind.__name__} needs its field {field.name}")
    return field.default


class _Reader(NamedTuple):
    """Field of a record, the source and the attribute that it is read from, and the conversion from SI."""

    field: str
    source: int
    attribute: str
    convert: Callable[[Any], object] | None


def _readers(kind: type[Record], sources: tuple[object, ...], given: Mapping[str, object]) -> Iterator[_Reader]:
    for field in _fields(kind):
        if field.name in given:
            continue
        attribute, unit = quantity_and_unit(field.name)
        holding = _holding(sources, attribute)
        if not holding and unit:
            attribute, unit, holding = field.name, "", _holding(sources, field.name)
        if len(holding) == 1:
            yield _Reader(field.name, holding[0], attribute, _conversion(kind, field, unit))
        elif holding or (field.default is MISSING and field.default_factory is MISSING):
            names = ", ".join(type(source).__name__ for source in sources)
            fault = "is ambiguous" if holding else "is missing"
            raise TypeError(f"{kind.__name__}.{field.name}: its attribute {fault} in {names}")


def _holding(sources: tuple[object, ...], attribute: str) -> list[int]:
    """The sources that have an attribute; properties are not computed for that."""
    return [
        index for index, source in enumerate(sources) if getattr_static(source, attribute, _MISSING) is not _MISSING
    ]


def _conversion(kind: type[Record], field: "Field[Any]", unit: str) -> Callable[[Any], object] | None:
    parts = list(parts_of_type(field.type))
    inner = next((part for part in parts if isinstance(part, type) and issubclass(part, Record)), None)
    factor, decimals, optional = SI_PER_UNIT.get(unit, 1.0), kind.decimals.get(unit), NoneType in parts
    if inner is None and factor == 1 and not optional:
        return None

    def converted(value: Any) -> object:
        if isinstance(value, (tuple, Rows)) and not (inner and hasattr(value, "_fields")):
            return tuple(map(converted, value))
        if isinstance(value, Mapping) and factor != 1:
            return {key: converted(each) for key, each in value.items()}
        if inner is not None:
            known = value is None or isinstance(value, Record)
            return value if known else getattr(inner, "of", inner.read)(value)
        if not isinstance(value, (float, int)) or isinstance(value, bool):
            return value
        if factor != 1:
            value = value / factor if decimals is None else round(value / factor, decimals) + 0.0
        return value if math.isfinite(value) or not optional else None

    return converted


def parts_of_type(hint: Any) -> Iterator[Any]:
    """A type and all that it is made of."""
    yield hint
    for part in get_args(hint):
        yield from parts_of_type(part)


def as_plain(value: object) -> Any:
    """Records as dictionaries, tuples as lists, whatever they hold."""
    if value is None or isinstance(value, (str, int, float)):
        return value
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, Mapping):
        return {key: as_plain(inner) for key, inner in value.items()}
    if isinstance(value, (tuple, list, Rows)):
        return [as_plain(inner) for inner in value]
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    return value


def flattened(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every leaf of a result with its path, `autobalancer.ball_count`, `fits.0.fit`."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, (list, tuple)) else None
    if items is None:
        yield path, value
        return
    for key, inner in items:
        yield from flattened(inner, f"{path}.{key}" if path else str(key))


def _short(value: object) -> str:
    """Text of a value inside of a record's: records within are named only."""
    if isinstance(value, Record):
        return f"{type(value).__name__}(…)"
    return repr(value)


def described(name: str, quantity: Quantity) -> str:
    """Label, symbol, unit and meaning of a field in a line.

    >>> described("ball_diameter_mm", Quantity("ball diameter", "2r", 5, "as made"))
    'ball diameter 2r [mm]: as made'
    """
    unit = unit_of(name)
    head = " ".join(part for part in (quantity.label, quantity.symbol, f"[{unit}]" if unit else "") if part)
    return f"{head}: {quantity.meaning}" if quantity.meaning else head


def field_lines(kind: type[Record]) -> Iterator[str]:
    """Each field of a record with label, symbol, unit and meaning, or with the record that it holds."""
    labelled, types = quantities(kind), hints(kind)
    for name in kind.entries():
        parts = (part for part in parts_of_type(types[name]) if isinstance(part, type))
        inner = next((part for part in parts if issubclass(part, Record)), None)
        words = [described(name, labelled[name])] if name in labelled else []
        words += [f"see {inner.__name__}"] if inner is not None else []
        yield f"{name}: {'; '.join(words)}" if words else name


def hints(kind: type[Record]) -> Mapping[str, Any]:
    """The type of each field, with its quantity, in order; of a field in SI that of its entry."""
    own = get_type_hints(kind, include_extras=True)
    entries = {field.name: _entry(kind, field.name) for field in _fields(kind)}
    in_si = _units(kind)
    return {
        known: hint
        for name, hint in own.items()
        for known in ((entries[name],) if name in in_si else (name, entries.get(name, name)))
    }


def quantities(kind: type[Record]) -> Mapping[str, Quantity]:
    """Quantities of a record's fields; fields that hold records have none."""
    if kind not in _QUANTITIES:
        beside = {name: get_args(hint)[1:] for name, hint in hints(kind).items()}
        pairs = (
            (name, next((each for each in notes if isinstance(each, Quantity)), None)) for name, notes in beside.items()
        )
        _QUANTITIES[kind] = {name: quantity for name, quantity in pairs if quantity is not None}
    return _QUANTITIES[kind]


_QUANTITIES: Final[dict[type[Record], Mapping[str, Quantity]]] = {}
_UNITS: Final[dict[type[Record], Mapping[str, str]]] = {}
_CONVERSIONS: Final[dict[type[Record], Mapping[str, tuple[str, Callable[[Any], object] | None]]]] = {}
_FIELDS: "Final[dict[type[Record], tuple[Field[Any], ...]]]" = {}
"""Read from the types once."""
_READERS: Final[dict[tuple[object, ...], tuple[_Reader, ...]]] = {}
"""By record, types of sources and fields given."""
_MISSING: Final = object()
