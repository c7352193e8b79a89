"""Records: the parts a result is made of, whose fields say what they are.

    class Autobalancer(Record):
        ball_diameter_mm: Annotated[float, Quantity("ball diameter", "2r", 5)]

The unit stands in the name of a field; label, symbol, digits and meaning beside its type. Text, JSON, CSV and the JSON
Schema of results are made of that.
"""

from collections.abc import Iterator, Mapping
from dataclasses import FrozenInstanceError
from inspect import get_annotations
from typing import Any, ClassVar, Final, NamedTuple, dataclass_transform, get_args, get_origin, get_type_hints


class Quantity(NamedTuple):
    """What a field is called where it is shown, its symbol and significant digits, and what it means."""

    label: str
    symbol: str = ""
    digits: int = 4
    meaning: str = ""
    percent: bool = False
    """Shown in hundredths."""


_CLASS_VAR: Final[object] = ClassVar


@dataclass_transform(frozen_default=True, kw_only_default=True)
class Record:
    """A part of a result: frozen, its fields given by name, in user units; None: not computed, a check says why.

    A class below this one is for a type checker what a dataclass is. What dataclasses write for each class anew stands
    here once, since writing it would take a good part of a command's start.
    """

    left_out: ClassVar[frozenset[str]] = frozenset()
    """Fields that are no entries of the result."""
    optional: ClassVar[frozenset[str]] = frozenset()
    """Fields that are entries of the result only where they are not None: other scenes have no such thing."""
    behind: ClassVar[frozenset[str]] = frozenset()
    """Fields that hold what the result was read from, and are not compared."""
    fields: ClassVar[tuple[str, ...]] = ()
    """Names of all fields, those of bases first."""

    def __init_subclass__(cls) -> None:
        own = (name for name, hint in get_annotations(cls).items() if get_origin(hint) is not _CLASS_VAR)
        before = (name for base in reversed(cls.__mro__[1:]) if issubclass(base, Record) for name in base.fields)
        cls.fields = tuple(dict.fromkeys((*before, *own)))

    def __init__(self, **values: Any) -> None:
        strange = values.keys() - set(self.fields)
        missing = [name for name in self.fields if name not in values and not hasattr(type(self), name)]
        if strange or missing:
            raise TypeError(f"{type(self).__name__}: unknown fields {sorted(strange)}, missing fields {missing}")
        self.__dict__.update({name: getattr(type(self), name) for name in self.fields if name not in values}, **values)

    def __setattr__(self, name: str, value: object) -> None:
        raise FrozenInstanceError(f"{type(self).__name__} is frozen: {name} cannot be set")

    def __delattr__(self, name: str) -> None:
        raise FrozenInstanceError(f"{type(self).__name__} is frozen: {name} cannot be deleted")

    def __eq__(self, other: object) -> bool:
        if type(self) is not type(other):
            return NotImplemented
        return all(getattr(self, name) == getattr(other, name) for name in self.fields if name not in self.behind)

    def __hash__(self) -> int:
        return hash(type(self))  # what it holds need not be hashable

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!r}' for name in self.entries())})"

    @classmethod
    def entries(cls) -> tuple[str, ...]:
        """Names of the fields that are entries of the result, in order."""
        return tuple(name for name in cls.fields if name not in cls.left_out)

    def to_dict(self) -> dict[str, Any]:
        """The entries as JSON has them."""
        values = ((name, getattr(self, name)) for name in self.entries())
        return {name: as_plain(value) for name, value in values if value is not None or name not in self.optional}


def as_plain(value: object) -> Any:
    """Records as dictionaries, tuples as lists, whatever they hold."""
    if isinstance(value, Record):
        return value.to_dict()
    if isinstance(value, Mapping):
        return {key: as_plain(inner) for key, inner in value.items()}
    if isinstance(value, (tuple, list)):
        return [as_plain(inner) for inner in value]
    return value


def flattened(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every leaf of a result with its path, `autobalancer.ball_count`, `fits.0.fit`."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, (list, tuple)) else None
    if items is None:
        yield path, value
        return
    for key, inner in items:
        yield from flattened(inner, f"{path}.{key}" if path else str(key))


def hints(kind: type[Record]) -> Mapping[str, Any]:
    """The type of each field, with what is said beside it."""
    return get_type_hints(kind, include_extras=True)


def quantities(kind: type[Record]) -> Mapping[str, Quantity]:
    """What the fields of a record say of themselves; those that hold records say nothing."""
    if kind not in _QUANTITIES:
        beside = {name: get_args(hint)[1:] for name, hint in hints(kind).items()}
        found = (
            (name, next((each for each in one if isinstance(each, Quantity)), None)) for name, one in beside.items()
        )
        _QUANTITIES[kind] = {name: quantity for name, quantity in found if quantity is not None}
    return _QUANTITIES[kind]


_QUANTITIES: Final[dict[type[Record], Mapping[str, Quantity]]] = {}
"""Read from the types once."""
