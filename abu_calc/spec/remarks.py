"""Warnings about a file that reads without error.

They concern unusual numbers, numbers that do not go together, and defaults that are another machine's.
"""

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, reduce
from typing import TYPE_CHECKING, cast

from abu_calc.frozen import dataclass
from abu_calc.spec.table import Table
from abu_calc.spec.text import Part, is_number, key_path, unit_suffix, unit_symbol
from abu_calc.spec.usual import Usual, usual_of
from abu_calc.validity import bounded

if TYPE_CHECKING:
    from abu_calc.spec.overrides import Override


@dataclass(frozen=True)
class Source:
    """Where the entries of a file come from: its text, or an override."""

    text: str
    overrides: "Sequence[Override]" = ()

    @cached_property
    def _lines(self) -> Mapping[str, int]:
        from abu_calc.spec.lines import key_lines

        return key_lines(self.text)

    def of(self, path: tuple[Part, ...]) -> str:
        """Line, or option, in brackets; empty where there is neither."""
        given = [override for override in self.overrides if path[: len(override.path)] == override.path]
        if given:
            return f" ({given[-1].option.removesuffix(given[-1].key).strip() or 'changed'})"
        from abu_calc.spec.lines import line_of

        line = line_of(self._lines, path)
        return f" (line {line})" if line else ""


def remarks(root: Table, source: Source) -> Iterator[str]:
    """The warnings of a file, each with its key and where that stands."""
    for path, table in root.tables():
        for name, usual, values in unusual(table):
            yield f"{_entry(table, path, (name,), source)} is unusual, {_asked(root, name, usual, values)}"
    for path, table in root.tables():
        for below, words in table.contradictions():
            yield f"{_entry(table, path, below, source)} {words}"
        if borrowed := table.borrowed():
            yield _borrowed(table, path, borrowed, source)


def unusual(table: Table) -> Iterator[tuple[str, Usual, list[float]]]:
    """Keys of a table with numbers outside their usual range, and these numbers."""
    given = table.model_fields_set - table.unused()
    for key in type(table).model_fields:
        if key not in given or not (usual := usual_of(type(table).model_fields[key])):
            continue
        silent = unit_suffix(key) == "db"  # a level of zero is not none
        odd = [value for value in _numbers(getattr(table, key)) if not usual.holds(value) or (silent and value == 0)]
        if odd:
            yield key, usual, odd


def _numbers(value: object) -> Iterator[float]:
    if isinstance(value, tuple):
        for each in value:
            yield from _numbers(each)
    elif isinstance(value, (int, float)) and is_number(value):
        yield value


def _entry(table: Table, path: tuple[Part, ...], below: tuple[str, ...], source: Source) -> str:
    """An entry below a table of the file, and where it stands: "machine.speed_rpm = 97 (line 5)"."""
    whole, value = (*path, *below), reduce(getattr, below, cast("object", table))
    return f"{key_path(whole)} = {said(value)}{source.of(whole)}"


def _asked(root: Table, key: str, usual: Usual, values: list[float]) -> str:
    from abu_calc.spec.mistaken_units import guesses, meant_in

    unit, speed = unit_symbol(key), getattr(getattr(root, "machine", None), "speed_rpm", None)
    meant = meant_in(guesses(key, values, usual, speed), unit)
    return f"{usual}{unit} is usual." + (f" M{meant[1:]}?" if meant else "")


def _borrowed(table: Table, path: tuple[Part, ...], keys: Sequence[str], source: Source) -> str:
    taken = ", ".join(f"{key} = {said(getattr(table, key))}" for key in keys)
    return (
        f"[{key_path(path)}]{source.of(path)} takes example data, not your machine's: {taken}. What rests on it holds "
        "for the example: give your own."
    )


def said(value: object) -> str:
    """A number, or a list of numbers, as messages say it.

    >>> said((2.5, 250.0)), said(2e5), said((6.5,))
    ('[2.5, 250]', '200000', '6.5')
    """
    if isinstance(value, tuple):
        inner = [said(each) for each in value]
        return inner[0] if len(inner) == 1 else f"[{', '.join(inner)}]"
    return bounded(value) if isinstance(value, (int, float)) else str(value)
