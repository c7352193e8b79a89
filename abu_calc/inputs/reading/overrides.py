"""Overrides: entries of a file replaced by `--set table.key=value` or `changed({"table.key": value})`."""

import copy
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field, replace
from typing import Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.table import Table, table_at
from abu_calc.inputs.reading.text import Part, key_path
from abu_calc.inputs.reading.values_with_units import Conversion, convert_entry, found_as, plain_value

_STEP: Final = re.compile(
    r"""\.?(?:([A-Za-z_][A-Za-z0-9_-]*)|\[(\d{1,6})\]|(?<=\.)(\d{1,6})(?![\w-])|"([^"]*)"|'([^']*)')"""
)
CHANGED: Final = "{}"
"""Name in messages of an override that Python gave: its key alone."""
EXAMPLE: Final = "--set machine.mass_kg=5.6"
VARIANT: Final = "--variant"
_KEY_FOLLOWS: Final = re.compile(r"""\s*(?:[\w.\[\]-]|"[^"]*"|'[^']*')+\s*=""")


@dataclass(frozen=True)
class Override:
    """One entry replaced: the path and the value, typed as TOML; `given_as`: what gave it, {} the path."""

    path: tuple[Part, ...]
    value: object
    given_as: str = "--set {}"
    converted: tuple[Conversion, ...] = field(default=(), repr=False, compare=False)
    """Values that were given with their units, and stand in `value` in the units of their keys."""

    @property
    def key(self) -> str:
        """The path as TOML writes it."""
        return key_path(self.path)

    @property
    def option(self) -> str:
        """Name of the override in messages."""
        return self.given_as.format(self.key)

    def blamed(self, error: InputError) -> InputError:
        """An error about an entry that stands in the file no more, or never did: this set it."""
        inner = (error.place.key or "").removeprefix(self.key)
        if self.given_as == CHANGED:
            return error.at(Place(key=f"{self.key}{inner}"), ", in a value that replaces the file's")
        return error.at(Place(key=f"{self.option}: {error.place.key}" if inner else self.option))


def overrides_of(values: Mapping[str, object]) -> list[Override]:
    """Overrides by key path, as Python gives them; copies, as a file would hold them.

    Raises InputError for what is no path, and for what is no value of a file.
    """
    if not isinstance(values, Mapping) or not all(isinstance(key, str) for key in values):
        raise InputError(
            "key paths with their values are expected",
            place=Place(key="changed"),
            found=found_as(values),
            allowed='{"wheel.mass_kg": 0.5}',
        )
    return [
        Override(_path(key.strip(), "changed"), plain_value(value, key.strip()), CHANGED)
        for key, value in values.items()
    ]


def following(earlier: Sequence[Override], later: Sequence[Override], model: type[Table]) -> tuple[Override, ...]:
    """Earlier overrides and later ones, without those earlier ones whose place a later one takes."""
    later = in_key_units(later, model)
    gone = {override.path for override in later}
    for override in later:
        gone.update(_displaced(override, model))
    return (*(override for override in earlier if override.path not in gone), *later)


def in_key_units(overrides: Sequence[Override], model: type[Table]) -> tuple[Override, ...]:
    """Overrides with values that were given with their units in the units of the keys.

    Raises InputError for a wrong unit, and for two overrides that give one value in both forms.
    """
    entries: dict[tuple[Part, ...], Override] = {}
    taken: list[Override] = []
    for override in overrides:
        option = override.given_as

        def where(path: tuple[Part, ...], option: str = option) -> Place:
            return Place(key=option.format(key_path(path)))

        path, value, converted = convert_entry(override.path, copy.deepcopy(override.value), model, where)
        if converted:
            override = replace(override, path=path, value=value, converted=tuple(converted))
        earlier = entries.setdefault(path, override)
        if earlier is not override and bool(earlier.converted) != bool(override.converted):
            raise InputError(
                "the value is given twice, with its unit and without", place=Place(key=override.option),
                remedy="keep one of the two",
            )  # fmt: skip
        taken.append(override)
    return tuple(taken)


def parse_overrides(texts: Sequence[str]) -> tuple[Override, ...]:
    """Overrides as written on the command line, a list of them."""
    if isinstance(texts, (list, tuple)) and all(isinstance(text, str) for text in texts):
        return tuple(map(parse_override, texts))
    place = Place(key="overrides")
    raise InputError("not a list of overrides", place=place, found=found_as(texts), allowed=f'["{EXAMPLE[6:]}"]')


def parse_variant(text: str) -> tuple[Override, ...]:
    """The overrides of a variant, "key=value,key=value"; commas inside of values divide nothing.

    >>> [override.key for override in parse_variant("machine.name=a,b, wheel.mass_kg=0.5")]
    ['machine.name', 'wheel.mass_kg']
    """
    return tuple(parse_override(part, VARIANT) for part in _parted(text))


def _parted(text: str) -> list[str]:
    """Divided at the commas outside of quotes and brackets behind which a further key begins."""
    parts, depth, quote = [""], 0, ""
    for index, sign in enumerate(text):
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "\"'":
            quote = sign
        else:
            depth += (sign in "[{") - (sign in "]}")
            if sign == "," and depth <= 0 and _KEY_FOLLOWS.match(text, index + 1):
                parts.append("")
                continue
        parts[-1] += sign
    return parts


def parse_override(text: str, option: str = "--set") -> Override:
    """An override as written on the command line; a bare word is text, since shells strip quotes.

    >>> parse_override("bearing.0.shaft_fit=m6")
    Override(path=('bearing', 0, 'shaft_fit'), value='m6', given_as='--set {}')
    """
    key, equals, value = _split(text)
    if not equals or not key.strip():
        raise InputError("not an override", place=Place(key=option), found=text, allowed=option + EXAMPLE[5:])
    path = _path(key.strip(), option)
    return Override(path, _value(value.strip(), Place(key=f"{option} {key_path(path)}")), f"{option} {{}}")


def apply(document: dict[str, object], overrides: Sequence[Override], model: type[Table]) -> list[str]:
    """Puts overrides into a document; returns a note for each entry that one of them took the place of."""
    for override in overrides:
        _put(document, override)
    notes = []
    paths = {override.path for override in overrides}
    for override in overrides:
        for *parent, other in _displaced(override, model):
            held = value_at(document, parent)
            if isinstance(held, dict) and other in held and (*parent, other) not in paths:
                del held[other]
                notes.append(f"{override.option} takes the place of {key_path((*parent, other))}")
    return notes


def _displaced(override: Override, model: type[Table]) -> Iterator[tuple[Part, ...]]:
    """Paths whose place an override takes."""
    *parent, key = override.path
    table = table_at(model, tuple(parent))
    if table is not None and isinstance(key, str):
        for other in table.displaced_by(key, override.value):
            yield tuple(other.split(".")) if "." in other else (*parent, other)


def _split(text: str) -> tuple[str, str, str]:
    """Key, "=" and value; a quoted key may hold "=" itself."""
    parted = re.match(r"""((?:"[^"]*"|'[^']*'|[^="'])*)(=?)(.*)""", text, re.DOTALL)
    return (parted[1], parted[2], parted[3]) if parted else (text, "", "")


def _path(key: str, given_by: str = "--set") -> tuple[Part, ...]:
    path: list[Part] = []
    place = 0
    while place < len(key) or not path:
        step = _STEP.match(key, place)
        if step is None or (place == 0 and key[0] in ".["):
            raise InputError(
                "not a key path", place=Place(key=given_by), found=key, allowed="machine.mass_kg, bearing[0].name"
            )
        word, index, dotted_index, double, single = step.groups()
        number = index or dotted_index
        path.append(int(number) if number is not None else next(w for w in (word, double, single) if w is not None))
        place = step.end()
    return tuple(path)


def _value(text: str, place: Place) -> object:
    from abu_calc.inputs.reading.toml_text import without_comma

    if not text:
        raise InputError("the value is missing", place=place, remedy=f"write {place.key}=…")
    if written := without_comma(text):
        raise InputError("a comma in a number", place=place, found=text, remedy=written)
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        if text[0] in "[{\"'":
            raise InputError(
                "not a TOML value", place=place, found=text, remedy="close every quote and bracket"
            ) from None
        return text
    return parsed["value"] if len(parsed) == 1 else text


def _put(document: dict[str, object], override: Override) -> None:
    """Sets one entry; a missing table is made, a missing element of an array is not."""
    held: object = document
    for step, following in zip(override.path, (*override.path[1:], None), strict=True):
        place = Place(key=override.option)
        if isinstance(step, int):
            if not isinstance(held, list):
                raise InputError("not an array", place=place, found=f"[{step}]", remedy="name the key without a number")
            if step >= len(held):
                raise InputError(
                    "no such element", place=place, allowed=f"the file has {len(held)} of them, counted from 0"
                )
            if following is None:
                held[step] = copy.deepcopy(override.value)
            held = held[step]
        elif not isinstance(held, dict):
            remedy = f"say which one: {step} of element [0]" if isinstance(held, list) else f"set {EXAMPLE[6:]} alike"
            raise InputError(f'"{step}" is below a key that is no table', place=place, remedy=remedy)
        elif following is None:
            held[step] = copy.deepcopy(override.value)
        else:
            held = held.setdefault(step, [] if isinstance(following, int) else {})


def value_at(content: object, path: Sequence[Part]) -> object:
    """Value at a path, or None."""
    held = content
    for step in path:
        if isinstance(held, dict) and isinstance(step, str):
            held = held.get(step)
        elif isinstance(held, list) and isinstance(step, int) and step < len(held):
            held = held[step]
        else:
            return None
    return held
