"""The house in numbers, each beside what it should be.

    python -m tests.house.numbers

Lines of code are those without docstrings, comments and blanks. Functions and files executed are those of one
`abu size` in this process; modules and classes themselves do not count. A call goes back if its function stands in a
later layer than its caller.
"""

import ast
import contextlib
import io
import re
import sys
from collections.abc import Iterator
from inspect import CO_OPTIMIZED
from types import FrameType
from typing import Final, NamedTuple

from tests.house.structure import ROOT, files
from tests.house.test_rooms import layer

SIZED: Final = "avtovaz-707-222"
TO_COME: Final = {
    "pictures and a page that follows the file": 700,
    "seats at work": 450,
    "recordings of any logger": 300,
}
"""Lines of code that what is built next may add."""


class Number(NamedTuple):
    """A number of the house: what it counts, its value, and the most it should be."""

    what: str
    now: int
    most: int


def numbers() -> Iterator[Number]:
    """All numbers, in the order of the table."""
    texts = [path.read_text(encoding="utf-8") for path in files().values()]
    rows = [line for text in texts for line in text.splitlines()]

    def lines(pattern: str) -> int:
        return sum(bool(re.search(pattern, row)) for row in rows)

    functions, executed, back = called()
    yield Number("lines of the package", len(rows), 70_000)
    yield Number("lines of code", sum(map(code, texts)), 50_000 + sum(TO_COME.values()))
    yield Number("files", len(texts), 320)
    yield Number("classes", lines(r"^class "), 480)
    yield Number("records", lines(r"^@record"), 70)
    yield Number("lines that convert units", lines(r"(to_si|from_si)\("), 100)
    yield Number("files that name two races", sum("two_race" in text or "TwoRace" in text for text in texts), 8)
    yield Number("lines with a code of a check, not where it is made",
                 sum(bool(re.search(r"ABU\d{3}", row)) and "coded(" not in row for row in rows), 20)  # fmt: skip
    yield Number(f"functions executed by abu size {SIZED}", functions, 1100)
    yield Number(f"files executed by abu size {SIZED}", executed, 120)
    yield Number("calls that go back to a later layer", back, 30)
    tests = [path.read_text(encoding="utf-8") for path in (ROOT / "tests").rglob("*.py")]
    yield Number("lines of tests", sum(len(text.splitlines()) for text in tests), 45_000)


def code(text: str) -> int:
    """Lines of code."""
    documents = set[int]()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            documents |= set(range(node.lineno, (node.end_lineno or 0) + 1))
    kept = (row.strip() for number, row in enumerate(text.splitlines(), 1) if number not in documents)
    return sum(bool(row) and not row.startswith("#") for row in kept)


def called() -> tuple[int, int, int]:
    """Functions and files of the package that `abu size` executes, and pairs of functions of which one calls back."""
    from abu_calc.cli.app import main as abu

    seen, back = set[tuple[str, str, int]](), set[tuple[str, str]]()

    def watch(frame: FrameType, event: str, _: object) -> None:
        own, before = frame.f_globals.get("__name__", ""), frame.f_back
        named = frame.f_code.co_flags & CO_OPTIMIZED and not frame.f_code.co_name.startswith("<")
        if event != "call" or not own.startswith("abu_calc.") or not named:
            return
        seen.add((own, frame.f_code.co_qualname, frame.f_code.co_firstlineno))
        caller = before.f_globals.get("__name__", "") if before else ""
        if before and 0 <= layer(caller) < layer(own):
            back.add((f"{caller}.{before.f_code.co_qualname}", f"{own}.{frame.f_code.co_qualname}"))

    sys.argv[1:] = ["size", SIZED]
    sys.setprofile(watch)
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.suppress(SystemExit):
            abu()
    finally:
        sys.setprofile(None)
    return len(seen), len({name for name, *_ in seen}), len(back)


if __name__ == "__main__":
    for number in numbers():
        print(f"{number.what:62} {number.now:7} {number.most:7}  {'' if number.now <= number.most else 'above'}")
