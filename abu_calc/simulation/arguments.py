"""Checks of a study's arguments before anything is computed; the key of such an error is the argument's name."""

import sys
from collections.abc import Callable, Collection, Mapping, Sequence
from functools import cache, wraps
from inspect import signature
from types import NoneType, UnionType
from typing import Any, Final, ParamSpec, TypeVar, Union, get_args, get_origin, get_type_hints

from abu_calc.foundation.errors import InputError, Place
from abu_calc.inputs.reading.values_with_units import found_as, plain_number

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")

WORDS: Final = {
    "float": "a number",
    "int": "a whole number",
    "bool": "True or False",
    "str": "text",
    "NoneType": "None",
    "Callable": "a function",
    "Machine": "a machine that was read",
    "Reading": "a file that was read",
    "SceneDescription": "a scene file that was read",
    "Scene": "an abu_calc.Scene",
    "Recording": "a recording that was read",
    "Mapping": "a dictionary by key",
    "Executor": "an executor of concurrent.futures",
    "Path": "a path",
}
"""Values that an argument of each type takes."""

REMEDIES: Final = {
    "Machine": 'abu_calc.read("machine.toml") returns one.',
    "Sequence": "A single one, too, stands in a list.",
}

LARGEST: Final = int(sys.float_info.max)


def checked(study: Callable[Arguments, Answer]) -> Callable[Arguments, Answer]:
    """A study that refuses, by their names, arguments of other types than its signature states.

    Numbers of other libraries (NumPy, Decimal) come to it as Python's own; True and False are no numbers.
    """

    @wraps(study)
    def with_checked_arguments(*args: Arguments.args, **named: Arguments.kwargs) -> Answer:
        hints = _hints(study)
        # Too many arguments, or unknown ones, are Python's to refuse.
        placed = [(name, hints[name]) for name in _placed(study)]
        first = [_taken(name, value, hint) for (name, hint), value in zip(placed, args, strict=False)]
        others = {name: _taken(name, value, hints[name]) if name in hints else value for name, value in named.items()}
        return study(*first, *args[len(first) :], **others)  # type: ignore[arg-type]

    return with_checked_arguments


@cache
def _placed(study: Callable[..., object]) -> tuple[str, ...]:
    """Arguments that may be given without their names, in their order."""
    parameters = signature(study).parameters.values()
    return tuple(each.name for each in parameters if each.kind is not each.KEYWORD_ONLY)


@cache
def _hints(study: Callable[..., object]) -> dict[str, Any]:
    """The types of the arguments, in their order."""
    return {name: hint for name, hint in get_type_hints(study).items() if name != "return"}


def _taken(argument: str, value: object, hint: Any) -> Any:
    """The value as one of the types that an argument takes."""
    kinds = get_args(hint) if get_origin(hint) in (Union, UnionType) else (hint,)
    if value is None and NoneType in kinds:
        return None
    for kind in kinds:
        if (converted := _as(kind, value)) is not None:
            return converted
    raise InputError(
        "not what this argument takes",
        place=Place(key=argument),
        found=found_as(value),
        allowed=" or ".join(map(_words, kinds)),
        remedy=next((REMEDIES[_name(kind)] for kind in kinds if _name(kind) in REMEDIES), None),
    )


def _as(kind: Any, value: Any) -> Any:
    """The value as this type, or None."""
    origin, inner = get_origin(kind), get_args(kind)
    if kind in (float, int):
        number = plain_number(value)
        return kind(number) if isinstance(number, (int, kind)) and not _huge(number) else None
    if origin is Callable:
        return value if callable(value) else None
    if origin is Mapping:
        return value if isinstance(value, Mapping) else None
    if origin not in (tuple, Sequence):
        return value if isinstance(value, kind) else None
    if isinstance(value, str) or not isinstance(value, Sequence):
        return None
    elements = tuple(_as(inner[0], each) for each in value)
    return elements if None not in elements and (origin is Sequence or len(elements) == len(inner)) else None


def _huge(number: float) -> bool:
    """True if the number is an integer beyond all floats."""
    return isinstance(number, int) and abs(number) > LARGEST


def _name(kind: Any) -> str:
    name: str = (get_origin(kind) or kind).__name__
    return name


def _words(kind: Any) -> str:
    """Name of a type in a message."""
    if get_origin(kind) is tuple:
        return f"({', '.join(map(_words, get_args(kind)))})"
    if get_origin(kind) is Sequence:
        return f"a list, each of it {_words(get_args(kind)[0])}"
    return WORDS[_name(kind)]


def one_of(argument: str, value: str | None, allowed: Collection[str]) -> None:
    """Refuse a word that is not allowed; None asks for what is usual."""
    if value is None or value in allowed:
        return
    from abu_calc.inputs.reading.suggestions import nearest

    close = nearest(value, allowed)
    remedy = f'The nearest is "{close}".' if close else None
    raise InputError(
        "not one of the known words", place=Place(key=argument), found=value, allowed=", ".join(allowed), remedy=remedy
    )


NEEDED: Final = {
    "gravity": 'machine.spindle_axis = "horizontal".',
    "grinding_contact": "the scene grinding, and a table [grinding] whose contact is compliant or rigid.",
    "run_up": "the scene run-up, and a table [run_up].",
    "motor": "the scene run-up, and the tables [run_up] and [motor].",
    "transverse_motion": 'the scene grinding, grinding.contact = "face", wheel.axial_runout_mm above 0, and balls.',
}
"""Needs of an effect in a machine file; the other effects are there always."""


def check_effects(
    present: Sequence[str], with_effects: Sequence[str], without_effects: Sequence[str], *, machine: bool = False
) -> None:
    """Refuse effects nobody knows, those there is no data for, and those asked both in and out."""
    from abu_calc.dynamics.effects.registry import REGISTRY

    known = [name for name, _ in REGISTRY]
    for argument, names in (("with_effects", with_effects), ("without_effects", without_effects)):
        for name in names:
            one_of(argument, name, known)
    for name in with_effects:
        if name not in present:
            raise InputError(
                "the file has no data for this effect",
                place=Place(key="with_effects"),
                found=name,
                allowed=", ".join(present) or "none",
                remedy=f"It needs {NEEDED[name]}" if machine and name in NEEDED else "Write its table into the file.",
            )
        if name in without_effects:
            raise InputError("an effect cannot be both in and out", place=Place(key="without_effects"), found=name)
