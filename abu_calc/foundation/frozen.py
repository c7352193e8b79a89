"""`dataclass` for classes that cannot be changed, as in the standard library, but quicker to make.

The library writes and compiles six methods for each class, a tenth of the time of a short command. Here text and
the refusal of changes are the same functions for all classes, and only construction is written for each.
"""

import dataclasses
from collections.abc import Callable
from dataclasses import MISSING, FrozenInstanceError
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Never, TypeVar

T = TypeVar("T")

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
else:

    def dataclass(*, frozen: bool, eq: bool = True) -> Callable[[type[T]], type[T]]:
        """Makes a class a frozen dataclass; `eq`: objects with equal fields are equal, else each only to itself."""
        if not frozen:
            raise TypeError("of the standard library are those that can be changed")

        def made(kind: type[T]) -> type[T]:
            # The library derives frozen classes from frozen ones alone: so it is told what this one is.
            derived = any(dataclasses.is_dataclass(base) for base in kind.__mro__[1:])
            dataclasses.dataclass(init=False, repr=False, eq=False, frozen=derived)(kind)
            kind.__dataclass_params__.frozen = True
            methods = {"__repr__": _text, "__setattr__": _no_change, "__delattr__": _no_deletion}
            for name, method in (methods | (_by_value(kind) if eq else {})).items():
                if name not in kind.__dict__:
                    setattr(kind, name, method)
            if "__init__" not in kind.__dict__:
                kind.__init__ = _construction(kind)
            return kind

        return made


def _construction(kind: type) -> Any:
    """A function that takes the fields as arguments and keeps them."""
    known: dict[str, object] = {"_missing_": MISSING}
    before: list[str] = []
    by_name: list[str] = []
    kept: list[str] = []
    for field in dataclasses.fields(kind):
        argument, value = field.name, field.name
        if field.default is not MISSING:
            known[f"default_{field.name}"] = field.default
            argument += f"=default_{field.name}"
        elif field.default_factory is not MISSING:
            known[f"new_{field.name}"] = field.default_factory
            argument += "=_missing_"
            value = f"new_{field.name}() if {field.name} is _missing_ else {field.name}"
        if field.init:
            (by_name if field.kw_only else before).append(argument)
        elif field.default is not MISSING:
            value = f"default_{field.name}"
        else:
            continue
        kept.append(f"    _values_[{field.name!r}] = {value}")
    arguments = ", ".join(["self", *before, *(["*", *by_name] if by_name else [])])
    after = ["    self.__post_init__()"] if hasattr(kind, "__post_init__") else []
    exec("\n".join([f"def __init__({arguments}):", "    _values_ = self.__dict__", *kept, *after]), known)
    written: Any = known["__init__"]
    written.__qualname__, written.__module__ = f"{kind.__qualname__}.__init__", kind.__module__
    written.__annotations__ = {field.name: field.type for field in dataclasses.fields(kind) if field.init}
    return written


def _by_value(kind: Any) -> dict[str, Callable[..., Any]]:
    """Equality and hash by the fields that are compared."""
    names = [field.name for field in dataclasses.fields(kind) if field.compare]
    values: Callable[[object], object] = attrgetter(*names) if names else bool

    def equal(kept: object, other: object) -> bool:
        return values(kept) == values(other) if type(other) is type(kept) else NotImplemented

    def hashed(kept: object) -> int:
        return hash(values(kept))

    return {"__eq__": equal, "__hash__": hashed}


def _text(kept: Any) -> str:
    shown = (f"{field.name}={getattr(kept, field.name)!r}" for field in dataclasses.fields(kept) if field.repr)
    return f"{type(kept).__qualname__}({', '.join(shown)})"


def _no_change(_: object, name: str, __: object) -> Never:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _no_deletion(_: object, name: str) -> Never:
    raise FrozenInstanceError(f"cannot delete field {name!r}")
