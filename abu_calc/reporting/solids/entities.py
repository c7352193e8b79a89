"""Entities of an exchange file after ISO 10303-21: numbered, each written once, values in the format's own spelling."""

import math
from collections.abc import Iterable

Value = "str | float | int | bool | None | Entity | Enumeration | tuple[Value, ...]"


class Entity(int):
    """Number of an entity that was written."""


class Enumeration(str):
    """A value that is written between dots, or a typed value that is written as it stands."""

    __slots__ = ()


DERIVED = Enumeration("*")
"""A value that follows from others."""


class EntityFile:
    """Entities in the order in which they were added; an entity equal to an earlier one is that one."""

    def __init__(self) -> None:
        self._lines: list[str] = []
        self._known: dict[str, Entity] = {}

    def add(self, keyword: str, *values: object) -> Entity:
        """Add an entity unless it is there, and return its number."""
        return self._numbered(f"{keyword}({','.join(map(spelled, values))})")

    def add_complex(self, *parts: tuple[str, tuple[object, ...]]) -> Entity:
        """Add an entity of several types, which the format wants in alphabetical order."""
        body = "".join(f"{keyword}({','.join(map(spelled, values))})" for keyword, values in sorted(parts))
        return self._numbered(f"({body})")

    def own(self, keyword: str, *values: object) -> Entity:
        """Add an entity even if an equal one is there: products and their uses are things, not values."""
        self._lines.append(f"{keyword}({','.join(map(spelled, values))})")
        return Entity(len(self._lines))

    def _numbered(self, line: str) -> Entity:
        if line not in self._known:
            self._lines.append(line)
            self._known[line] = Entity(len(self._lines))
        return self._known[line]

    def lines(self) -> Iterable[str]:
        """Lines of the data section."""
        return (f"#{number}={line};" for number, line in enumerate(self._lines, 1))


def spelled(value: object) -> str:
    """A value as the format writes it.

    >>> spelled(("Ø5", 2.0, None, True, Entity(7), 3))
    "('\\\\X2\\\\00D8\\\\X0\\\\5',2.,$,.T.,#7,3)"
    """
    match value:
        case Entity():
            return f"#{int(value)}"
        case Enumeration():
            return str(value)
        case None:
            return "$"
        case bool():
            return ".T." if value else ".F."
        case int():
            return str(value)
        case float():
            return _real(value)
        case str():
            return f"'{written_string(value)}'"
        case tuple() | list():
            return f"({','.join(map(spelled, value))})"
    raise TypeError(f"no value of an exchange file: {value!r}")


def _real(value: float) -> str:
    """A real number: a point always, a capital E.

    >>> _real(-0.0), _real(1e-7), _real(31.0), _real(15.875)
    ('0.', '1.E-07', '31.', '15.875')
    """
    if not math.isfinite(value):
        raise ValueError("an exchange file holds finite numbers only")
    mantissa, mark, exponent = repr(value + 0.0).partition("e")
    mantissa = mantissa.removesuffix("0") if mantissa.endswith(".0") else mantissa
    return f"{mantissa if '.' in mantissa else mantissa + '.'}{'E' if mark else ''}{exponent}"


def written_string(text: str) -> str:
    """A text by the format's alphabet: apostrophe and all beyond ASCII by code, backslash doubled, no control signs.

    >>> print(written_string("d'Ø\\n") + "|")
    d\\X\\27\\X2\\00D8\\X0\\ |
    """
    pieces, codes = list[str](), ""

    def flush() -> None:
        nonlocal codes
        if codes:
            wide = "4" if len(codes) > 0 and any(len(code) > 4 for code in codes.split()) else "2"
            size = 8 if wide == "4" else 4
            pieces.append(f"\\X{wide}\\" + "".join(code.rjust(size, "0") for code in codes.split()) + "\\X0\\")
            codes = ""

    for sign in text:
        if " " <= sign <= "~":
            flush()
            pieces.append({"'": "\\X\\27", "\\": "\\\\"}.get(sign, sign))
        elif sign.isprintable():
            codes += f" {ord(sign):04X}"
        else:
            flush()
            pieces.append(" ")
    flush()
    return "".join(pieces)
