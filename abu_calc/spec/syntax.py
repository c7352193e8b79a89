"""Faults in the TOML of a file: the parser's messages turned into instructions on what to change."""

import re
from typing import Final

from abu_calc.errors import InputError, Place
from abu_calc.spec.lines import Statement, statements
from abu_calc.spec.text import key_path, quoted

_WHERE: Final = re.compile(r"\s*\(at (?:line (\d+), column \d+|end of document)\)")
_NUMBER: Final = r"[+-]?\d[\d_]*(?:\.\d+)?(?:[eE][+-]?\d+)?"
_DIGITS: Final = re.compile(r"\d(?:_?\d){4300}")
"""Number with more digits than Python spends time on; its error gives no line."""
DECIMAL_COMMA: Final = re.compile(r"([+-]?\d+),(\d+)")
_WORDS: Final = {"True": "true", "False": "false", "TRUE": "true", "FALSE": "false"}
_NOTHING: Final = ("none", "null", "nil", "-")

# What the value of a refused line looks like, and what to write instead ({0} the whole, {1} … the groups).
_VALUES: Final = (
    (re.compile(r"([+-]?\d+),(\d+)"), "a decimal comma", "the decimal sign is a point: write {1}.{2}"),
    (
        re.compile(rf"({_NUMBER})\s*[^\W\d_][\w/·²]*"),
        "more than a number",
        "the unit stands in the key: write {1} alone",
    ),
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
    return value, *_value_seen(value)


def _value_seen(value: str) -> tuple[str | None, str | None]:
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
