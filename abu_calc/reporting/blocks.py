"""Building blocks of a report, and numbers as text: the same for every command and every format of text."""

import re
from typing import Final, NamedTuple

from abu_calc.foundation.quantity import Quantity, Record, quantities
from abu_calc.foundation.units import unit_of


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits, never in exponents between 1e-4 and 1e7.

    >>> number(1135.91, 4), number(0.0412345, 3), number(2.0, 3), number(1957172.0, 5), number(3.2e-9, 2)
    ('1136', '0.0412', '2.00', '1957200', '3.2e-09')
    """
    if value == 0:
        return "0"
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.{digits - 1}e}"
    rounded = float(f"{value:.{digits - 1}e}")
    whole = len(str(int(abs(rounded)))) if abs(rounded) >= 1 else 0
    if whole:
        return f"{rounded:.{max(0, digits - whole)}f}"
    return f"{rounded:#.{digits}g}"


def or_dash(value: float | None, digits: int = 3) -> str:
    """A number, or a dash if there is none.

    >>> or_dash(2.0), or_dash(None)
    ('2.00', '–')
    """
    return "–" if value is None else number(value, digits)


def capitalised(text: str) -> str:
    """A text that begins a line."""
    return text[:1].upper() + text[1:]


def uncapitalised(text: str) -> str:
    """A sentence that goes on after other words; an abbreviation or a symbol keeps its capital.

    >>> uncapitalised("At 154 rpm"), uncapitalised("ISO 281"), uncapitalised("A small one")
    ('at 154 rpm', 'ISO 281', 'a small one')
    """
    return text[:1].lower() + text[1:] if re.match(r"[A-Z][a-z]*\b", text) else text


NOISE: Final = {
    "mm": (1e-6, "0.001 µm"),
    "µm": (1e-3, "0.001 µm"),
    "mm/s": (1e-4, "0.0001 mm/s"),
    "g·mm": (1e-3, "0.001 g·mm"),
    "°": (1e-3, "0.001°"),
}
"""Values below which only rounding and integration errors stand, by unit, and how a report writes that bound."""


SHORTEST: Final = 1e-4
"""Length [mm] below which a report writes micrometres."""


def with_unit(value: float, unit: str, digits: int = 4) -> str:
    """A number with its unit; of one below the noise only the bound.

    >>> with_unit(2.14e-11, "mm"), with_unit(9.25e-5, "mm", 3), with_unit(0.0411, "mm", 3), with_unit(0.0, "mm")
    ('< 0.001 µm', '0.0925 µm', '0.0411 mm', '0 mm')
    """
    least, bound = NOISE.get(unit, (0.0, ""))
    if 0 < abs(value) < least:
        return f"< {bound}"
    if unit == "mm" and 0 < abs(value) < SHORTEST:
        return f"{number(1e3 * value, digits)} µm"
    return f"{number(value, digits)} {unit}".rstrip()


def level_text(level: float, digits: int = 4) -> str:
    """A velocity level with its unit; below 0 dB (0.05 µm/s) only the bound.

    >>> level_text(108.04), level_text(-103.3)
    ('108.0 dB', '< 0 dB')
    """
    return f"{number(level, digits)} dB" if level >= 0 else "< 0 dB"


def shown(kind: type[Record], name: str, value: object) -> str:
    """A value of a field of a record with its unit, as text."""
    return shown_as(quantities(kind)[name], unit_of(name), value)


def shown_as(quantity: Quantity, unit: str, value: object) -> str:
    """A value with its unit, to the digits of its quantity."""
    if value is None:
        return "not computed"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if quantity.percent and isinstance(value, float):
        return f"{number(100 * value, quantity.digits)} %"
    if isinstance(value, (list, tuple)):
        text = ", ".join(number(float(each), quantity.digits) for each in value)
    elif isinstance(value, float) and unit == "dB" and quantity.symbol == "L":
        return level_text(value, quantity.digits)
    elif isinstance(value, float):
        return with_unit(value, unit, quantity.digits)
    else:
        text = str(value)
    return f"{text} {unit}".rstrip()


class Heading(NamedTuple):
    """Start of a section.

    `id`: the name by which figures, pages and screens find the section, whatever its text says; unique in a report,
    empty if nothing refers to it.
    """

    text: str
    id: str = ""


class Paragraph(NamedTuple):
    """Running text, wrapped to the width there is; `mark` sets it off (pass, warn, fail, not-done, warning).

    `hang`: by how much lines but the first are indented more; `whole`: a command on one line, however long it is.
    """

    text: str
    mark: str | None = None
    indent: int = 2
    hang: int = 0
    whole: bool = False


class Facts(NamedTuple):
    """Rows of label, symbol, value with unit."""

    rows: tuple[tuple[str, str, str], ...]


class Grid(NamedTuple):
    """A table with a header; `right` names the columns with numbers.

    `kept`: where not all columns stand side by side, there are several tables, each of which begins with so many of the
    first; 0: it is not parted.
    """

    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    right: frozenset[int] = frozenset()
    kept: int = 0

    def within(self, width: int, margin: int = 2) -> "list[Grid]":
        """Tables that have room in so many letters, if this one may be parted; `margin`: beside each column."""
        lines, first = (self.header, *self.rows), range(self.kept)
        widths = [max(len(line[k]) for line in lines) + margin for k in range(len(self.header))]
        if not self.kept or sum(widths) <= width:
            return [self]
        groups: list[list[int]] = [[]]
        for k in range(self.kept, len(widths)):
            if groups[-1] and sum(widths[column] for column in (*first, *groups[-1], k)) > width:
                groups.append([])
            groups[-1].append(k)
        return [self._only((*first, *group)) for group in groups]

    def _only(self, columns: tuple[int, ...]) -> "Grid":
        header, *rows = (tuple(line[k] for k in columns) for line in (self.header, *self.rows))
        return Grid(header, tuple(rows), frozenset(new for new, old in enumerate(columns) if old in self.right))


class Picture(NamedTuple):
    """Drawn in characters, with a caption that says what to see; left out where lines are shorter than it is wide."""

    lines: tuple[str, ...]
    caption: str
    indent: int = 8


Block = Heading | Paragraph | Facts | Grid | Picture
