"""The text of a TOML file: lines of its keys, and the parser's messages turned into instructions.

Lines are given for texts that a parser has read and for those it refused.
"""

import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.text import BARE_KEY, Part, key_path, quoted

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
    """The line of a path, or of the nearest table or array around it; an array of one table is read as that table."""
    lengths = range(min(len(path), DEEPEST), 0, -1)
    around = (key_path(way) for length in lengths for way in (path[:length], (path[0], 0, *path[1:length])))
    return next((lines[way] for way in around if way in lines), None)


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


_WHERE: Final = re.compile(r"\s*\(at (?:line (\d+), column \d+|end of document)\)")
_NUMBER: Final = r"[+-]?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?"
_DIGITS: Final = re.compile(r"\d(?:_?\d){4300}")
"""Number with more digits than Python spends time on; its error gives no line."""
DECIMAL_COMMA: Final = re.compile(r"([+-]?\d+),(\d+)")


def without_comma(text: str) -> str | None:
    """What to write for a number with a comma, which may be a decimal comma or group thousands; None for others.

    >>> without_comma("5,6"), without_comma("0,125"), without_comma("5.6")
    ('write 5.6 (the decimal sign is a point)', 'write 0.125 (the decimal sign is a point)', None)
    >>> without_comma("11,000")
    'write 11000 if the comma groups thousands, 11.000 if it is a decimal comma'
    """
    if not (comma := DECIMAL_COMMA.fullmatch(text)):
        return None
    whole, rest = comma.groups()
    if re.fullmatch(r"[+-]?[1-9]\d{0,2}", whole) and len(rest) == 3:
        return f"write {whole}{rest} if the comma groups thousands, {whole}.{rest} if it is a decimal comma"
    return f"write {whole}.{rest} (the decimal sign is a point)"


def with_unit_converted(key: str, text: str) -> str | None:
    """What to write for a number with its unit under a key that names a unit; None for other keys.

    >>> with_unit_converted("mass_kg", "1900 g")
    'write mass_kg = 1.9, or mass = "1900 g"'
    """
    from abu_calc.foundation.written_units import WrittenUnitError, written_unit  # loaded for such files alone

    if (unit := written_unit(key)) is None:
        return None
    try:
        value = unit.value(text)
    except WrittenUnitError as error:
        return f'write {key} = …, a number in {unit.unit}, or {unit.stem} = "…", {error.allowed}'
    return f"write {key} = {value:.12g}, or {unit.stem} = {quoted(text)}"


_WORDS: Final = {"True": "true", "False": "false", "TRUE": "true", "FALSE": "false"}
_NOTHING: Final = ("none", "null", "nil", "-")

# What the value of a refused line looks like, and what to write instead ({0} the whole, {1} … the groups).
_VALUES: Final = (
    (re.compile(rf"({_NUMBER})\s*[^\W\d_][\w/·²]*"), "more than a number", "this number has no unit: write {1} alone"),
    (re.compile(r"([+-]?)(\.\d+)"), "a number without its zero", "write {1}0{2}"),
    (re.compile(r"([+-]?\d+)\."), "a number that ends in a point", "write {1}.0"),
    (re.compile(r"([+-]?)0+(\d+(?:\.\d+)?)"), "a number with leading zeros", "write {1}{2}"),
    (re.compile(r"([+-]?\d{1,3})((?:[ ']\d{3})+)"), "a number with gaps", "write its digits without gaps"),
)


def reworded(text: str, file: str, error: ValueError | RecursionError) -> InputError:
    """The parser's error on a TOML text as one with the line, the key and the remedy."""
    if isinstance(error, RecursionError):
        return InputError("the file is nested too deeply", place=Place(file))
    if "integer string conversion" in str(error) and (long := _DIGITS.search(text)):
        line = text.count("\n", 0, long.start()) + 1
        key = next((key_path(entry.path) for entry in statements(text) if entry.line <= line <= entry.last_line), None)
        place = Place(file, line, key)
        return InputError("not TOML: a number of thousands of digits", place=place, remedy="write a shorter number")
    message = str(error)
    where = _WHERE.search(message)
    rows = text.split("\n")
    # An error at the end of the document has its cause in the last statement.
    line = int(where[1]) if where and where[1] else max(1, len(text.rstrip().split("\n")))
    known = [statement for statement in statements(text) if statement.line <= line]
    twice = _first_of_two(known, line)
    key = None
    if known and known[-1].last_line >= line:
        # Within a value of several lines the fault is seen late: named is the line where the value begins.
        line, key = known[-1].line, key_path(known[-1].path)
    place = Place(file, line, key)
    if twice:
        kind = "table" if twice.header else "key"
        remedy = "merge the two" if kind == "table" else "keep one of the two"
        if twice.path in (("wheel",), ("autobalancer",)):
            remedy = f"merge the two; for several on one spindle write [[{twice.path[0]}]] each time, with plane_mm"
        return InputError(f"the {kind} stands twice, first in line {twice.line}", place=place, remedy=remedy)
    excerpt, fault, change = _seen(rows[line - 1].strip() if line <= len(rows) else "")
    plain = _WHERE.sub("", message).strip() or "not TOML"
    return InputError(f"not TOML: {fault or plain[0].lower() + plain[1:]}", place=place, found=excerpt, remedy=change)


def _first_of_two(known: list[Statement], line: int) -> Statement | None:
    """The earlier statement of the path that stands again in a line."""
    for again in (statement for statement in known if statement.line == line):
        for first in known:
            if first.path == again.path and first.line < line:
                return first
    return None


def _seen(row: str) -> tuple[str | None, str | None, str | None]:
    """Text of a refused line, its fault, and the action; each as far as it is known."""
    if row.startswith("["):
        return row, None, "a table's name stands alone on its line: [wheel], or [[bearing]] for one of several"
    key, equals, value = (part.strip() for part in row.partition("="))
    if not equals:
        colon = re.match(r"([A-Za-z0-9_-]+)\s*:\s*(.+)", row)
        return row or None, None, f"write {colon[1]} = {colon[2]}" if colon else "write key = value"
    value = re.sub(r"\s+#[^\"']*$", "", value)
    if not value or value.startswith("#"):
        return row, "the value is missing", f"write {key} = …, or leave the key out"
    return value, *_value_seen(key, value)


def _value_seen(key: str, value: str) -> tuple[str | None, str | None]:
    if written := without_comma(value):
        return "a comma in a number", written
    if re.fullmatch(rf"{_NUMBER}\s*[^\W\d_][\w/·²]*", value) and (written := with_unit_converted(key, value)):
        return "a number with its unit", written
    for pattern, fault, remedy in _VALUES:
        if seen := pattern.fullmatch(value):
            return fault, remedy.format(seen[0], *seen.groups())
    if value in _WORDS:
        return "an unknown word", f"write {_WORDS[value]}"
    if value.lower() in _NOTHING:
        return "an empty value", "leave the key out"
    if value[0] in "\"'":
        if "\\" in value:
            return "a backslash in the text", "write it twice (\\\\), or put the text in single quotes"
        if len(value) == 1 or value[-1] != value[0]:
            return "text whose closing quote is missing", f"close it with {value[0]}"
        return None, None
    if value[0] in "[{":
        return None, "close every bracket; numbers have a decimal point, and commas between them; text stands in quotes"
    if re.match(r"[^\W\d]", value):
        return "text without quotes", f"write {quoted(value.rstrip(chr(34)))}"
    return None, "text stands in quotes, numbers have a decimal point and no unit"
