"""Lines of the keys of a TOML text, for texts that a parser has read and for those it refused."""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from abu_calc.frozen import dataclass
from abu_calc.spec.text import BARE_KEY, Part, key_path

_KEY: Final = r"""(?:[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*')"""
_DOTTED: Final = rf"({_KEY}(?:[ \t]*\.[ \t]*{_KEY})*)"
_BLANK: Final = re.compile(r"(?:[ \t\r\n]|#[^\n]*)*")
_HEADER: Final = re.compile(rf"(\[\[?)[ \t]*{_DOTTED}[ \t]*\]")
_ASSIGNMENT: Final = re.compile(rf"{_DOTTED}[ \t]*=")
_REST_OF_LINE: Final = re.compile(r"[^\n]*")
# A value ends at the first line end outside of strings, comments and brackets. Multi-line strings may end in two
# quotes of their own before the closing three. A string that is not closed takes the rest of its line, or of the text:
# to look for its end again and again would take time that grows with the square of its length.
_TOKEN: Final = re.compile(
    r'''"""(?:[^\\]|\\.)*?(?:"{3,5}|\Z)|\'\'\'.*?(?:'{3,5}|\Z)|"(?:[^"\\\n]|\\[^\n])*"?|'[^'\n]*'?'''
    r"""|\#[^\n]*|[\[\]{}\n]|[^"'\#\[\]{}\n]+""",
    re.DOTALL,
)


DEEPEST: Final = 32
"""Steps of the longest path with a line of its own; deeper keys share that of their table (our files go to 5)."""


@dataclass(frozen=True)
class Statement:
    """A table header ("[" or "[[") or an assignment (""): its path, its first and last line (from 1)."""

    path: tuple[Part, ...]
    line: int
    last_line: int
    header: str = ""


def statements(text: str) -> Iterator[Statement]:
    """The statements of a text in their order; a line that is none is passed over."""
    table: tuple[Part, ...] = ()
    last: dict[tuple[Part, ...], int] = {}
    place, line = 0, 1
    while True:
        blank = _BLANK.match(text, place)
        start = blank.end() if blank else place
        line += text.count("\n", place, start)
        if start == len(text):
            return
        if header := _HEADER.match(text, start):
            table = _table_path(_parts(header[2]), last, array=header[1] == "[[")
            end = _end_of_line(text, header.end())
            yield Statement(table, line, line, header[1])
        elif assignment := _ASSIGNMENT.match(text, start):
            end = _end_of_value(text, assignment.end())
            last_line = line + text.count("\n", start, end)
            yield Statement((*table, *_parts(assignment[1])), line, last_line)
            line = last_line
        else:
            end = _end_of_line(text, start)
        place = end


def key_lines(text: str) -> dict[str, int]:
    """Key path → the line it first stands on; what is inside an array or an inline table has no line of its own.

    >>> key_lines('[machine]\\nname = "a"\\n[[bearing]]\\nbore_mm = 17')
    {'machine': 1, 'machine.name': 2, 'bearing': 3, 'bearing[0]': 3, 'bearing[0].bore_mm': 4}
    """
    lines: dict[str, int] = {}
    for statement in statements(text):
        for length in range(1, min(len(statement.path), DEEPEST) + 1):
            lines.setdefault(key_path(statement.path[:length]), statement.line)
    return lines


def line_of(lines: Mapping[str, int], path: Sequence[Part]) -> int | None:
    """The line of a path, or of the nearest table or array around it."""
    around = (lines.get(key_path(path[:length])) for length in range(min(len(path), DEEPEST), 0, -1))
    return next((line for line in around if line is not None), None)


def _parts(dotted: str) -> list[str]:
    """The keys of a dotted key; the parser itself undoes the quoting.

    >>> _parts('expected . "a.b"')
    ['expected', 'a.b']
    """
    plain = [part.strip() for part in dotted.split(".")]
    if all(map(BARE_KEY.fullmatch, plain)):
        return plain
    keys: list[str] = []
    try:
        inner: object = tomllib.loads(f"{dotted} = 0")
    except tomllib.TOMLDecodeError:
        return [dotted]
    while isinstance(inner, dict):
        ((key, inner),) = inner.items()
        keys.append(key)
    return keys


def _table_path(parts: list[str], last: dict[tuple[Part, ...], int], *, array: bool) -> tuple[Part, ...]:
    """The path of a header: on its way it goes into the last element of each array of tables."""
    path: tuple[Part, ...] = ()
    for part in parts[:-1]:
        path = (*path, part)
        if path in last:
            path = (*path, last[path])
    path = (*path, parts[-1])
    if not array:
        return path
    last[path] = last.get(path, -1) + 1
    return (*path, last[path])


def _end_of_line(text: str, place: int) -> int:
    rest = _REST_OF_LINE.match(text, place)
    return rest.end() if rest else place


def _end_of_value(text: str, place: int) -> int:
    depth = 0
    for token in _TOKEN.finditer(text, place):
        if token[0] in "[{":
            depth += 1
        elif token[0] in "]}":
            depth -= 1
        elif token[0] == "\n" and depth <= 0:
            return token.start()
    return len(text)
