"""Faults of a file in words: findings of the models as errors with line, key and action."""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import Any, Final

from pydantic import ValidationError

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.suggestions import header, meant_key, meant_table, nearest, nearest_numbered
from abu_calc.inputs.reading.table import RULE, Table, is_array, subtable, table_at, usual_of
from abu_calc.inputs.reading.text import Part, is_number, key_path, quoted, shown, shown_short, unit_symbol
from abu_calc.inputs.reading.toml_text import line_of, with_unit_converted, without_comma

MOST_LISTED: Final = 10
MOST_EXPLAINED: Final = 40
"""Unknown keys that are asked what they were meant to be; the library lists all errors."""
MUCH: Final = 1e12
"""No unit makes more of it a usual number."""


class SpecErrors(InputError):  # noqa: N818 - it is several
    """All that is wrong with one file, in the order of its lines; itself the first of them."""

    def __init__(self, errors: Sequence[InputError]) -> None:
        first = errors[0]
        super().__init__(
            first.message, place=first.place, found=first.found, allowed=first.allowed, remedy=first.remedy
        )
        self.errors = tuple(errors)

    def at(self, place: Place, more: str = "") -> InputError:
        """The first error, at another place."""
        return self.errors[0].at(place, more)

    def __str__(self) -> str:
        listed = [str(error) for error in self.errors[:MOST_LISTED]]
        rest = len(self.errors) - len(listed)
        return "\n".join(listed + ([f"and {rest} more"] if rest else []))


@dataclass(frozen=True)
class Origin:
    """Origin of a document, which finds the place of its keys."""

    file: str
    document: Mapping[str, object]
    lines: Mapping[str, int]
    overrides: Mapping[tuple[Part, ...], str]
    """Path → the option that set it."""
    model: type[Table]
    written: Mapping[tuple[Part, ...], str] = field(default_factory=dict)
    """Path → what was written for it, of values with units."""

    def place(self, path: tuple[Part, ...]) -> Place:
        """The line of a path, or the option that set it."""
        for length in range(len(path), 0, -1):
            if option := self.overrides.get(path[:length]):
                return Place(key=option if length == len(path) else f"{option}: {key_path(path)}")
        line = line_of(self.lines, path)
        if line is None and path:
            made = next((option for given, option in self.overrides.items() if given[0] == path[0]), None)
            if made:
                return Place(key=made)
        return Place(self.file, line, key_path(path) or None)


@dataclass(frozen=True)
class _Finding:
    """One error of pydantic: its path as written, the value, and the details."""

    path: tuple[Part, ...]
    value: Any
    facts: Mapping[str, Any]
    table: type[Table]
    root: type[Table]

    @property
    def key(self) -> str:
        """The key, without a place in its list."""
        return next((part for part in reversed(self.path) if isinstance(part, str)), "")


_Words = tuple[str, str | None, str | None]
"""Message, what is allowed, remedy."""


def input_error(error: ValidationError, origin: Origin) -> InputError:
    """The findings of the models in words: one error, or all of them in one."""
    errors: list[InputError] = []
    strays = 0
    meant: set[tuple[Part, ...]] = set()
    missing: list[tuple[tuple[Part, ...], InputError]] = []
    for detail in error.errors(include_url=False):
        kind, facts = detail["type"], detail.get("ctx", {})
        path = _written(tuple(detail["loc"]) + (tuple(facts["key"]) if kind == RULE else ()), origin.document)
        table = _table_of(path, origin.model)
        finding = _Finding(path, detail["input"], facts, table, origin.model)
        if kind == "too_short" and len(detail["input"]) >= facts["min_length"]:
            continue  # Long enough; what is wrong with its values has errors of its own.
        if kind == "extra_forbidden":
            strays += 1
            # What a key was meant to be takes long to find, and more than the first ones are not listed.
            key, remedy = _stray(finding) if strays <= MOST_EXPLAINED else (None, None)
            meant |= {(*path[:-1], key)} if key else set()
            message = "unknown table" if len(path) == 1 and isinstance(finding.value, (dict, list)) else "unknown key"
            errors.append(InputError(message, place=origin.place(path), remedy=remedy))
        elif kind == "missing":
            missing.append((path, _absent(finding, origin)))
        else:
            errors.append(_wrong(kind, finding, origin))
    # A key that is only misspelt is not missing too.
    errors += [absent for path, absent in missing if path not in meant]
    errors.sort(key=lambda problem: (problem.place.line is None, problem.place.line or 0))
    return errors[0] if len(errors) == 1 else SpecErrors(errors)


def _written(path: tuple[Part, ...], whole: object) -> tuple[Part, ...]:
    """The path without a place in a list where the file has a single value, which stands for a list of one.

    Keys of a single table follow it. Names of forms that a value may have are left out.
    """
    document = whole
    for place, part in enumerate(path):
        if isinstance(part, int) and isinstance(document, dict):
            return _written(path[:place] + path[place + 1 :], whole)
        if (isinstance(part, int) and not isinstance(document, list)) or not isinstance(document, (dict, list)):
            return path[:place]
        if isinstance(part, str) and part.endswith("]") and part not in document:  # pydantic's name of a form
            return _written(path[:place] + path[place + 1 :], whole)
        if isinstance(document, dict):
            document = document.get(part)
        elif isinstance(document, list) and isinstance(part, int):
            document = document[part] if part < len(document) else None
    return path


def _table_of(path: tuple[Part, ...], root: type[Table]) -> type[Table]:
    """The table a path's last key stands in, however deep in lists its value is."""
    keys = [place for place, part in enumerate(path) if isinstance(part, str)]
    return table_at(root, path[: keys[-1]] if keys else ()) or root


def _stray(finding: _Finding) -> tuple[str | None, str | None]:
    if len(finding.path) == 1:
        return meant_table(finding.root, finding.key, finding.value)
    return meant_key(finding.root, finding.path[:-1], finding.table, finding.key)


def _absent(finding: _Finding, origin: Origin) -> InputError:
    if len(finding.path) == 1:
        name = header(finding.root, finding.path)
        remedy = "`abu init FILE` writes a file with every table"
        return InputError(f"the table {name} is missing", place=Place(origin.file, None, finding.key), remedy=remedy)
    if subtable(finding.table, finding.key):
        name = header(finding.root, finding.path)
        return InputError(f"the table {name} is missing", place=origin.place(finding.path), remedy=f"add {name}")
    examples = finding.table.model_fields[finding.key].examples
    remedy = f"add {finding.key} = …, such as {shown(examples[0])}" if examples else f"add {finding.key} = …"
    return InputError("the key is missing", place=origin.place(finding.path), remedy=remedy)


def _wrong(kind: str, finding: _Finding, origin: Origin) -> InputError:
    facts, place = finding.facts, origin.place(finding.path)
    if kind == RULE:
        return InputError(
            facts["message"], place=place, found=facts["found"], allowed=facts["allowed"], remedy=facts["remedy"]
        )
    message, allowed, remedy = _WORDS.get(kind, _other)(finding)
    found = shown_short(finding.value)
    keys = [place for place, part in enumerate(finding.path) if isinstance(part, str)]
    if keys and (entry := origin.written.get(finding.path[: keys[-1] + 1])):
        found += f" by {entry}"
    return InputError(message, place=place, found=found, allowed=allowed, remedy=remedy)


def _other(finding: _Finding) -> _Words:
    return "the value is wrong", None, None


def _no_number(what: str) -> Callable[[_Finding], _Words]:
    def no_number(finding: _Finding) -> _Words:
        value = finding.value
        if isinstance(value, str):
            if written := without_comma(value.strip()):
                return what, None, f"{written}, without quotes"
            number = value.strip()
            if leading := re.match(r"[+-]?\d+(\.\d+)?([eE][+-]?\d+)?", number):
                written = None if leading[0] == number else with_unit_converted(finding.key, number)
                return what, None, written or f"write {leading[0]} without quotes"
        if isinstance(value, float) and value.is_integer():
            return what, None, f"write {int(value)}"
        return what, None, "write one number, not a list" if isinstance(value, list) else None

    return no_number


def _no_text(finding: _Finding) -> _Words:
    remedy = f"write {quoted(shown(finding.value))} in quotes" if is_number(finding.value) else None
    return "text is expected", None, remedy


def _no_bool(finding: _Finding) -> _Words:
    return "true or false is expected", None, "write true or false, without quotes"


def _not_finite(finding: _Finding) -> _Words:
    return "a finite number is expected", None, None


def _bound(words: str, fact: str) -> Callable[[_Finding], _Words]:
    def out_of_bounds(finding: _Finding) -> _Words:
        return "out of range", f"{words} {finding.facts[fact]:g}{unit_symbol(finding.key)}", _other_unit(finding)

    return out_of_bounds


def _other_unit(finding: _Finding) -> str | None:
    """The units in which a number out of range would be usual."""
    usual = usual_of(finding.table.model_fields[finding.key])
    if usual is None or not 0 < finding.value < MUCH:
        return None
    from abu_calc.inputs.reading.suggestions import guesses, meant_in

    words = meant_in(guesses(finding.key, [finding.value], usual), unit_symbol(finding.key))
    return f"{words}?" if words else None


def _no_literal(finding: _Finding) -> _Words:
    expected = str(finding.facts["expected"]).replace("'", '"')
    words, value = re.findall(r'"([^"]*)"', expected), finding.value
    if is_number(value) and shown(value) in words:
        return "text is expected", expected, f'write "{value}" in quotes'
    plain = shown(value).strip('"').replace(" ", "").replace(",", ".")
    close = nearest_numbered(plain, words) or nearest(plain, words)
    return "not one of the known words", expected, f'the nearest is "{close}"' if close else None


def _no_pattern(finding: _Finding) -> _Words:
    field = finding.table.model_fields[finding.key]
    example = next(iter(field.examples or ()), field.default)
    swapped = str(finding.value).strip().swapcase()
    right = re.fullmatch(finding.facts["pattern"], swapped)
    remedy = f'shafts take small letters, housings capitals: write "{swapped}"' if right else None
    return "not a tolerance class", f'letters and a number, such as "{example}"', remedy


def _empty_text(finding: _Finding) -> _Words:
    return "the text is empty", "at least one letter", None


def _too_few(finding: _Finding) -> _Words:
    return "too few values in the list", f"at least {finding.facts['min_length']}", None


def _too_many(finding: _Finding) -> _Words:
    allowed = f"at most {finding.facts['max_length']}"
    if subtable(finding.table, finding.key):
        return f"too many tables, {len(finding.value)} of them", allowed, "share them out among several files"
    return "too many values in the list", allowed, "the decimal sign is a point; the comma parts the numbers"


def _no_list(finding: _Finding) -> _Words:
    if subtable(finding.table, finding.key):
        name = key_path(part for part in finding.path if isinstance(part, str))
        return "an array of tables is expected", None, f"write [[{name}]], with two brackets"
    examples = finding.table.model_fields[finding.key].examples
    return "a list is expected", None, f"write it as {finding.key} = {shown(examples[0])}" if examples else None


def _no_table(finding: _Finding) -> _Words:
    if not finding.key:
        return "a table is expected", None, None
    name = header(finding.root, finding.path)
    single = not is_array(finding.table, finding.key)
    if single and isinstance(finding.value, list):
        return "a single table is expected", None, f"write {name}, with one bracket, and only once"
    return "a table is expected", None, f"write {name} on a line of its own, and its keys below"


_WORDS: Final[Mapping[str, Callable[[_Finding], _Words]]] = {
    "float_type": _no_number("a number is expected"),
    "int_type": _no_number("a whole number is expected"),
    "int_from_float": _no_number("a whole number is expected"),
    "string_type": _no_text,
    "bool_type": _no_bool,
    "finite_number": _not_finite,
    "greater_than": _bound("above", "gt"),
    "greater_than_equal": _bound("at least", "ge"),
    "less_than": _bound("below", "lt"),
    "less_than_equal": _bound("at most", "le"),
    "literal_error": _no_literal,
    "string_pattern_mismatch": _no_pattern,
    "string_too_short": _empty_text,
    "too_short": _too_few,
    "too_long": _too_many,
    "tuple_type": _no_list,
    "model_type": _no_table,
    "dict_type": _no_table,
}
"""The findings of pydantic that a TOML file can cause."""
