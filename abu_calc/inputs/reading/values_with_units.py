"""Values with units in files: `mass = "5.6 kg"` stands for `mass_kg = 5.6`, in every table and list of every file.

The key is that of the table without its unit, the value a text of number and unit, or a list of such texts. What stands
in the file is replaced by the key and the number of the model, before overrides and the model see it. A table that has
no such key costs a look-up for each of its keys.

Values that scripts give, as a TOML file would hold them: numbers of other libraries as Python's own.

`check_nesting` limits the nesting of a TOML text before a parser spends time and memory on it.
"""

import datetime
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from numbers import Integral, Number
from typing import Any, Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.table import Table, subtable, table_at
from abu_calc.inputs.reading.text import Part, key_path, shown, shown_short

LARGE: Final = 15
"""Significant digits of a converted number in messages and reports."""


@dataclass(frozen=True)
class Conversion:
    """A value that was written with its unit: the path as written, that of the model, the text and the number."""

    written: tuple[Part, ...]
    path: tuple[Part, ...]
    text: object
    value: object

    @property
    def key(self) -> str:
        """The path of the model as TOML writes it."""
        return key_path(self.path)

    @property
    def entry(self) -> str:
        """What was written, as TOML has it.

        >>> Conversion(("machine", "mass"), ("machine", "mass_kg"), "5.6 kg", 5.6).entry
        'machine.mass = "5.6 kg"'
        """
        return f"{key_path(self.written)} = {shown(self.text)}"

    @property
    def rounded(self) -> object:
        """The number without the digits that are its rounding."""
        return _short(self.value)

    def __str__(self) -> str:
        return f"{self.entry}: {self.key} = {shown(self.rounded)}"


Where = Callable[[tuple[Part, ...]], Place]
"""The place of a path as written."""


def convert(content: dict[str, object], model: type[Table], where: Where) -> list[Conversion]:
    """Replaces the values with units of a document by the keys and numbers of its model.

    Raises InputError, with the place, for a text that is no number with a unit of its quantity and for a value that
    stands there in both forms; several faults come as SpecErrors.
    """
    done: list[Conversion] = []
    faults: list[InputError] = []
    for path, table, kind in _tables(content, model, ()):
        for key in [key for key in table if key not in kind.model_fields]:
            canonical = canonical_keys(kind).get(key)
            if canonical is None or not _is_written(table[key]):
                continue
            written = (*path, key)
            try:
                if canonical in table:
                    raise _both(where(written), key, canonical)
                value = _converted(table[key], canonical, where(written))
            except InputError as error:
                faults.append(error)
                continue
            done.append(Conversion(written, (*path, canonical), table[key], value))
    if faults:
        from abu_calc.inputs.reading.errors import SpecErrors

        raise faults[0] if len(faults) == 1 else SpecErrors(faults)
    for conversion in done:
        table = _at(content, conversion.path[:-1])
        # In the place of what was written: messages list keys in the order of the file.
        entries = [(_name(conversion.path), conversion.value) if key == conversion.written[-1] else (key, value)
                   for key, value in table.items()]  # fmt: skip
        table.clear()
        table.update(entries)
    return done


def convert_entry(
    path: tuple[Part, ...], value: object, model: type[Table], where: Where
) -> tuple[tuple[Part, ...], object, list[Conversion]]:
    """Path and value of one entry that is set from outside, as the model has it, and what was converted for it."""
    last = max((place for place, part in enumerate(path) if isinstance(part, str)), default=0)
    parent, key, places = path[:last], path[last], path[last + 1 :]
    table = table_at(model, parent)
    if table is None or not isinstance(key, str):
        return path, value, []
    if key not in table.model_fields:
        canonical = canonical_keys(table).get(key)
        if canonical is None or not _is_written(value):
            return path, value, []
        number = _converted(value, canonical, where(path))
        inside = (*parent, canonical, *places)
        return inside, number, [Conversion(path, inside, value, number)]
    inner = subtable(table, key)
    if inner is None or not isinstance(value, (dict, list)):
        return path, value, []
    # A table that is set as a whole: its keys are looked at as those of a file are.
    content: dict[str, object] = {key: value}
    done = convert(content, table, lambda below: where(_around(parent, places, below)))
    return (
        path,
        content[key],
        [
            Conversion(_around(parent, places, each.written), _around(parent, places, each.path), each.text, each.value)
            for each in done
        ],
    )


def canonical_path(path: tuple[Part, ...], model: type[Table]) -> tuple[Part, ...] | None:
    """The path with the model's own key, which ends in its unit; None for a key that the model does not have."""
    last = max((place for place, part in enumerate(path) if isinstance(part, str)), default=0)
    table, key = table_at(model, path[:last]), path[last]
    if table is None or not isinstance(key, str):
        return None
    own = canonical_keys(table).get(key, key)
    return (*path[:last], own, *path[last + 1 :]) if own in table.model_fields else None


def _around(parent: tuple[Part, ...], places: tuple[Part, ...], below: tuple[Part, ...]) -> tuple[Part, ...]:
    """Path of an entry of a table that was set as a whole."""
    return (*parent, below[0], *places, *below[1:])


@cache
def canonical_keys(model: type[Table]) -> Mapping[str, str]:
    """The keys of a table without their unit, and the keys of the model that they stand for."""
    from abu_calc.foundation.written_units import written_unit

    pairs = ((written_unit(key), key) for key in model.model_fields if subtable(model, key) is None)
    return {unit.stem: key for unit, key in pairs if unit is not None and unit.stem not in model.model_fields}


def _tables(
    content: dict[str, object], model: type[Table], path: tuple[Part, ...]
) -> Iterator[tuple[tuple[Part, ...], dict[str, object], type[Table]]]:
    """Each table of a document that has a model, with its path."""
    yield path, content, model
    for key, value in content.items():
        if not isinstance(value, (dict, list)) or key not in model.model_fields:
            continue
        inner = _subtable(model, key)
        if inner is None:
            continue
        if isinstance(value, dict):
            yield from _tables(value, inner, (*path, key))
        else:
            for index, item in enumerate(value):
                if isinstance(item, dict):
                    yield from _tables(item, inner, (*path, key, index))


_subtable = cache(subtable)
"""The model of a table below a table, looked up once."""


def _is_written(value: object) -> bool:
    """True for a text, and for a list that holds one."""
    return isinstance(value, str) or (isinstance(value, list) and any(map(_is_written, value)))


def _converted(value: object, canonical: str, place: Place) -> object:
    """Numbers of a text or of lists of texts, in the unit of the key."""
    from abu_calc.foundation.written_units import WrittenUnitError, written_unit

    unit = written_unit(canonical)
    if isinstance(value, list):
        return [_converted(each, canonical, place) for each in value]
    if unit is None or not isinstance(value, str):
        raise InputError(
            "a number without its unit in a list with units", place=place, found=shown_short(value),
            remedy=f"write each number with its unit, or {canonical} with numbers alone",
        )  # fmt: skip
    try:
        return unit.value(value)
    except WrittenUnitError as error:
        remedy = f"write the number with one of these units, or {canonical} and the number in {unit.unit}"
        raise InputError(
            error.fault, place=place, found=shown_short(value), allowed=error.allowed, remedy=remedy
        ) from None


def _both(place: Place, key: str, canonical: str) -> InputError:
    return InputError(f"the value stands twice, as {key} and as {canonical}", place=place, remedy="keep one of the two")


def _at(content: dict[str, object], path: Sequence[Part]) -> dict[str, object]:
    held: object = content
    for step in path:
        held = held[step]  # type: ignore[index]
    assert isinstance(held, dict)
    return held


def _name(path: Sequence[Part]) -> str:
    """The key of a path, without a place in its list."""
    return next(part for part in reversed(path) if isinstance(part, str))


def _short(value: object) -> object:
    """A converted number without the digits of its rounding."""
    if isinstance(value, list):
        return [_short(each) for each in value]
    return float(f"{value:.{LARGE}g}") if isinstance(value, float) else value


DEEPEST: Final = 32
"""Steps of the longest key path, and brackets within brackets; our files go to 5."""

# Strings and comments as wholes; a chain of keys and points; brackets; runs of anything else.
_TOKEN: Final = re.compile(
    r'''"""(?:[^\\"]|\\.|"(?!""))*(?:"{3,5}|\Z)|\'{3}(?:[^']|'(?!''))*(?:'{3,5}|\Z)|"(?:[^"\\\n]|\\[^\n])*"?'''
    r"""|'[^'\n]*'?|\#[^\n]*|[A-Za-z0-9_-]+|\.|[ \t]+|[\[\]{}]|\n|[^A-Za-z0-9_.\-\s\[\]{}"'\#]+|.""",
    re.DOTALL,
)


def check_nesting(text: str, source: str) -> None:
    """Refuse a text nested more than 32 deep, in time that grows with its length alone."""
    if text.count(".") + text.count("[") + text.count("{") < DEEPEST:
        return
    line, depth, points = 1, 0, 0
    for token_match in _TOKEN.finditer(text):
        token = token_match[0]
        first = token[0]
        if first in "[{":
            depth += 1
        elif first in "]}":
            depth = max(depth - 1, 0)
        if first == ".":
            points += 1
        elif not (first in " \t\"'_-" or first.isalnum()):
            points = 0
        if depth > DEEPEST or points >= DEEPEST:
            raise InputError(
                "the file is nested too deeply",
                place=Place(source, line),
                allowed=f"at most {DEEPEST} keys in a path, and brackets within brackets",
            )
        line += token.count("\n")


ALLOWED: Final = "text, numbers, Python's True and False, dates, and lists, tuples or dictionaries of them"
LONGEST_FOUND: Final = 60


def plain_number(value: object) -> int | float | None:
    """An integer or float of Python's own for any real number, Decimal and NumPy's among them; None for all else.

    >>> plain_number(2), plain_number(2.5), plain_number("2"), plain_number(True), plain_number(2j)
    (2, 2.5, None, None, None)
    """
    if isinstance(value, bool) or not isinstance(value, Number):
        return None
    try:
        return int(value) if isinstance(value, Integral) else float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):  # complex numbers, signalling NaN, fractions beyond all floats
        return None


def plain_value(value: object, key: str, depth: int = 0) -> Any:
    """A copy with lists for tuples. Raises InputError, naming the key, for what no file can hold, such as None."""
    if depth > DEEPEST:
        raise InputError(
            "nested too deeply", place=Place(key=key), allowed=f"at most {DEEPEST} lists or dictionaries in one another"
        )
    number = plain_number(value)
    if number is not None:
        return number
    if isinstance(value, (bool, datetime.date, datetime.time)):
        return value
    if isinstance(value, str):
        return str.__str__(value)  # of a subclass, such as NumPy's, too
    if isinstance(value, (list, tuple)):
        return [plain_value(each, key, depth + 1) for each in value]
    if isinstance(value, Mapping) and all(isinstance(inner, str) for inner in value):
        return {str.__str__(inner): plain_value(each, f"{key}.{inner}", depth + 1) for inner, each in value.items()}
    remedy = "Leave the entry out; to be without what the file has, read a file that does not have it."
    raise InputError(
        "not a value that a file can hold",
        place=Place(key=key),
        found=found_as(value),
        allowed=ALLOWED,
        remedy=remedy if value is None else None,
    )


def found_as(value: object) -> str:
    """Form in which messages show a value of Python, cut if it is long."""
    try:
        text = repr(value)
    except Exception:  # integers of thousands of digits have none, and whatever a script may define
        text = f"a value of type {type(value).__name__}"
    return text if len(text) <= LONGEST_FOUND else text[: LONGEST_FOUND - 1] + "…"
