"""A report on one screen: verdict, subject, failed checks with actions, main numbers, next commands.

Parts without room are counted, never left out in silence.

Blocks as text in a terminal or a file.
"""

import io
import os
import re
import shutil
import sys
import textwrap
from bisect import bisect_right
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise
from typing import Any, Final

from rich.console import Console
from rich.table import Table
from rich.text import Text

from abu_calc.foundation.checks import verdict_words
from abu_calc.foundation.errors import escaped
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.parts import not_requested, told, unlike, warning_lines, without_entries
from abu_calc.simulation.result import Result

STYLES = {
    "pass": "bold green",
    "warn": "bold yellow",
    "fail": "bold red",
    "not-done": "bold magenta",
    "warning": "yellow",
}
WORDS = {"WARN": "warn", "FAIL": "fail", "NOT EVALUATED": "not-done", "LOUDER THAN WITHOUT": "warn"}
"""Cells of tables that are styled as these marks are."""
WIDEST = 100
MARGIN = 2
"""Blanks before each column of a table, and before running text."""
HEADING_HANG = 6
"""Blanks before further lines of a heading, so that no word of a long name stands where verdicts do."""
FACT_WIDTHS = (35, 17)
"""Label and symbol: the same in every block, so that values stand in one column; they take the rest of the line."""

BEFORE_UNIT = re.compile(r"(?<=[±≤≥]) |(?<=\bR) (?=\d)|(?<=\d) (?=±|(?:g·mm|1/s|mm|Hz|rpm|dB|µm|MPa|kg|[sNgW%])(?!\w))")
"""Blanks at which no line is broken."""
TIE = "\u00a0"

NARROW = 72
"""Line width below which the symbols are left out."""


def show(blocks: Iterable[Block], *, color: bool = True) -> None:
    """Print blocks one after another, as wide as the terminal is but never wider than reads well."""
    width = min(shutil.get_terminal_size().columns, WIDEST)
    if not (color and (sys.stdout.isatty() or os.environ.get("FORCE_COLOR"))):
        print(as_text(blocks, width), end="")
        return
    out = console(width)
    for part in _parts(blocks, width):
        out.print(Text(*part) if isinstance(part, tuple) else part, soft_wrap=isinstance(part, tuple))


def console(width: int, **how: Any) -> Console:
    """A console of so many columns: Rich does not bear everything that COLUMNS and LINES may be."""
    plain = {name: value for name, value in os.environ.items() if name not in ("COLUMNS", "LINES")}
    return Console(width=width, markup=False, highlight=False, emoji=False, _environ=plain, **how)


def as_text(blocks: Iterable[Block], width: int = 80) -> str:
    """Blocks as plain text for a file or a pipe, no blanks at the ends of lines."""
    buffer = io.StringIO()
    out = console(width, file=buffer, color_system=None)
    for part in _parts(blocks, width):
        if isinstance(part, tuple):
            buffer.write(part[0] + "\n")
        else:
            out.print(part)
    return "\n".join(line.rstrip() for line in buffer.getvalue().splitlines()) + "\n"


def _parts(blocks: Iterable[Block], width: int) -> Iterator[tuple[str, str] | Table]:
    """Lines that are wrapped already, each with its style, and tables."""
    for index, block in enumerate(blocks):
        if index and isinstance(block, Heading):
            yield "", ""
        match block:
            case Heading(text):
                yield fill(escaped(text), width, 0, HEADING_HANG), "bold"
            case Paragraph(text, whole=True):
                yield " " * block.indent + escaped(text), ""
            case Paragraph(text, mark, indent, hang):
                style = STYLES.get(mark or "", "")
                yield fill(escaped(text), width, indent, hang), style.removeprefix("bold ") if hang else style
            case Facts(rows):
                yield _facts(rows, width)
            case Grid():
                yield from map(_grid, block.within(width, MARGIN))
            case Picture(lines, caption, indent):
                shown = [" " * indent + escaped(line) for line in lines]
                if max(map(len, shown)) <= width:
                    yield "\n".join(shown), ""
                    yield fill(escaped(caption), width, MARGIN), ""


def height(blocks: Sequence[Block], width: int = 80) -> int:
    """Number of lines that blocks take."""
    return len(as_text(blocks, width).splitlines()) if blocks else 0


def fill(text: str, width: int, indent: int, hang: int = 0) -> str:
    """Text wrapped to a width, every line indented, those but the first by `hang` more; long words keep whole."""
    together = BEFORE_UNIT.sub(TIE, text)
    return textwrap.fill(
        together, width, initial_indent=" " * indent, subsequent_indent=" " * (indent + hang), break_long_words=False,
        break_on_hyphens=False,
    ).replace(TIE, " ")  # fmt: skip


def _facts(rows: tuple[tuple[str, str, str], ...], width: int) -> Table:
    table = Table(box=None, show_header=False, padding=(0, 0, 0, MARGIN))
    label, symbol = FACT_WIDTHS
    rest = width - label - 2 * MARGIN
    for column in (label, rest) if width < NARROW else (label, symbol, rest - symbol - MARGIN):
        table.add_column(width=column, overflow="fold")
    for name, sign, value in rows:
        table.add_row(*map(escaped, (name, value) if width < NARROW else (name, sign, value)))
    return table


def grade_of(cell: str) -> str:
    """Grade that a cell of a table shows, with or without the number of its action.

    >>> grade_of("WARN 2"), grade_of("pass, tightest")
    ('warn', 'pass')
    """
    word = cell.rstrip("0123456789 ").removesuffix(", tightest")
    return WORDS.get(word, word)


def _grid(grid: Grid) -> Table:
    table = Table(box=None, padding=(0, 0, 0, MARGIN), header_style="dim", show_header=any(grid.header))
    for index, title in enumerate(grid.header):
        table.add_column(escaped(title), justify="right" if index in grid.right else "left", overflow="fold")
    for row in grid.rows:
        table.add_row(*(Text(escaped(cell), style=STYLES.get(grade_of(cell), "")) for cell in row))
    return table


LINES: Final = 40
"""Lines of one screen, at 80 columns."""
LEAST: Final = 8
"""Lines kept for the warnings and for the body, where others ask for all."""
BLANK: Final[Block] = Paragraph("")
MORE_ROWS: Final = re.compile(r"And \d+ more rows?: ")
ELSEWHERE: Final = frozenset({"checks", "warnings", "defaults", "conventions", "provenance"})
"""Ids of the sections of a whole report that a screen words in its own way, or leaves to it."""


def one_screen(
    result: Result,
    about: Sequence[Block],
    body: Sequence[Block] = (),
    more: Sequence[str] = (),
    picture: Callable[[int], Sequence[Block]] | None = None,
) -> tuple[Block, ...]:
    """`about`: title, verdict, the thing in a line; `body`: its numbers; `more`: further places to look.

    First come the checks that did not pass, then the body, then the warnings; each as far as there is room. In the
    lines that are left then, `picture` draws what it can, below the body.
    """
    verdict = [block._replace(text=_once_more(block.text)) for block in about[1:2]
               if isinstance(block, Paragraph) and result.checks]  # fmt: skip
    last: list[Block] = [BLANK, *verdict, Paragraph(_next(result, more))]
    optional = not_requested(result.checks)
    if LINES - height([*about, *optional, *last]) >= 2 * LEAST:  # else the whole report alone lists them
        last[1:1] = optional
    warnings, groups = warning_lines(result.warnings), unlike(result.checks)
    room = LINES - height([*about, *last])
    kept = min(2 + taken_by(warnings), LEAST) if warnings else 0
    taken = room - kept - min(1 + taken_by(body), LEAST)
    reasons = told(groups)
    if taken_by(reasons) > min(taken, room - kept - 1 - taken_by(body)):  # entries of actions stand in the report, too
        codes = [[check.code for check in alike] for alike in groups]
        reasons = fitted(without_entries(groups), codes, taken)
    room -= height(reasons)
    shown = cut(body, room - kept - 1)
    parted = [BLANK, *shown] if shown and len(about) > 1 and not isinstance(shown[0], Heading) else shown
    rest = fitted(warnings, [], room - height([BLANK, *shown]) - 2)
    below: list[Block] = [Heading("Notes", "warnings"), *rest] if rest else []
    drawn = picture(LINES - height([*about, *reasons, *parted, BLANK, *below, *last])) if picture else ()
    return (*about, *reasons, *parted, *([BLANK, *drawn] if drawn else ()), *below, *last)


def _once_more(verdict: str) -> str:
    """A verdict as it stands once more at the end: its first sentence, without what is in brackets or explains a word.

    >>> _once_more("90 % of 10 machines meet the limits (95 % confidence: 55 % to 100 %). 1 of 10 does not.")
    '90 % of 10 machines meet the limits.'
    >>> _once_more("STABLE at 5800.00 rpm: nothing grows."), _once_more("FAIL: 2 of 3 checks pass, 1 fails")
    ('STABLE at 5800.00 rpm.', 'FAIL: 2 of 3 checks pass, 1 fails.')
    """
    first = re.sub(r" \([^)]*\)", "", verdict).split(". ")[0].rstrip(".")
    beginning, _, rest = first.partition(": ")
    explained = beginning[:2].isupper() and rest and not re.search(r"checks? pass|no checks", rest)
    return f"{beginning if explained else first}."


def fitted(lines: Sequence[Paragraph], codes: Sequence[Sequence[str]], room: int) -> list[Paragraph]:
    """Lines that there is room for, and the rest as a count.

    `codes`: codes of the checks that each line reports; empty if the lines are warnings.
    """
    if taken_by(lines) <= room:
        return list(lines)
    fit = max(bisect_right(range(min(len(lines), LINES)), room - 1, key=lambda count: height(lines[:count])) - 1, 0)
    left = [code for each in codes[fit:] for code in each]
    more = many(len(left), "more check") if codes else many(len(lines) - fit, "more note")
    named = f" ({', '.join(dict.fromkeys(left))})" if left else ""
    return [*lines[:fit], Paragraph(f"And {more}{named}: --full.")] if lines else []


def taken_by(blocks: Sequence[Block]) -> int:
    """Number of lines that blocks take.

    Blocks taller than a screen are laid out only as far as is needed to show that they are taller.
    """
    tall = LINES + 1
    seen = [part._replace(rows=part.rows[:tall]) if isinstance(part, Grid) else part for part in blocks[: 2 * tall]]
    return height(seen)


def cut(blocks: Sequence[Block], room: int) -> list[Block]:
    """Blocks as far as there is room for them, of tables the first rows; then a line that says so.

    What stands below a heading that does not fit is left out with it.
    """
    if taken_by(blocks) <= room:
        return list(blocks)
    kept: list[Block] = []
    headless = False
    for block in blocks:
        part = [] if headless and not isinstance(block, Heading) else _what_fits(block, kept, room - 1)
        headless = not part and (headless or isinstance(block, Heading))
        kept += part
    ended: list[Block] = [*kept, Heading("")]
    empty = [isinstance(above, Heading) and isinstance(below, Heading) for above, below in pairwise(ended)]
    shown = [piece for piece, bare in zip(kept, empty, strict=True) if not bare]
    while shown and shown[-1] == BLANK:
        shown.pop()
    counted = shown and MORE_ROWS.match(getattr(shown[-1], "text", ""))
    return shown if counted else [*shown, Paragraph("And more: --full.")]


def _what_fits(block: Block, above: Sequence[Block], room: int) -> list[Block]:
    """A block, the first rows of a table, or nothing; a heading where some lines fit below it."""
    lines = [BLANK] * 3 if isinstance(block, Heading) else []
    if taken_by([*above, block, *lines]) <= room:
        return [block]
    if not isinstance(block, Grid):
        return []
    parts = [block._replace(rows=block.rows[:count]) for count in range(min(len(block.rows), LINES))]
    fitting = bisect_right(parts, room - 1, key=lambda part: height([*above, part]))
    more = many(len(block.rows) - fitting + 1, "more row")
    return [parts[fitting - 1], Paragraph(f"And {more}: --full.")] if fitting > 1 else []


def verdict_line(result: Result, unjudged: str | None = None) -> Paragraph:
    """Verdict with the counts of checks by grade.

    `unjudged`: text in place of PASS if no check judged what the word could stand for.
    """
    grades = {check.status for check in result.checks if check.requested}
    warned = result.status == "pass" and "warn" in grades
    if unjudged and result.status == "pass":
        return Paragraph(unjudged, "warn" if warned else None)
    return Paragraph(verdict_words(result.status, result.checks), "warn" if warned else result.status)


def many(count: int, name: str, plural: str | None = None) -> str:
    """Count with its noun, singular or plural.

    >>> many(1, "check"), many(2, "entry", "entries")
    ('1 check', '2 entries')
    """
    return f"{count} {name if count == 1 else plural or f'{name}s'}"


def _next(result: Result, more: Sequence[str]) -> str:
    """Last line of a screen: commands for more, with the defaults, replaced and converted entries of the result."""
    source, codes = result.provenance, [check.code for check in result.checks if check.status != "pass"]
    codes = codes or [check.code for check in result.checks]
    asked = [f"`abu explain {codes[0]}`, what a check asks"] if codes else []
    defaults = [f"{many(len(source.defaults), 'default')} used"] if source.defaults else []
    replaced = [f"{many(len(source.overrides), 'entry', 'entries')} replaced"] if source.overrides else []
    converted = [f"{many(len(source.converted), 'value')} converted"] if source.converted else []
    within = f" ({', '.join([*defaults, *replaced, *converted])})" if defaults or replaced or converted else ""
    return f"More: {'; '.join([f'--full, the whole report{within}', *more, *asked])}."


def shortened(
    result: Result, whole: Sequence[Block], *left_out: str, head: int = 2, more: Sequence[str] = ()
) -> tuple[Block, ...]:
    """A whole report on one screen: its title and verdict, and the sections that are not worded in another way here.

    `left_out`: ids of further sections that are left to the whole report; `head`: blocks that are never cut.
    """
    first, *others = sections(whole)
    kept = [part for part in others if section_id(part) not in ELSEWHERE | set(left_out)]
    return one_screen(result, first[:head], [*first[head:], *(block for part in kept for block in part)], more)


def sections(blocks: Iterable[Block]) -> list[list[Block]]:
    """A heading with what stands below it, one after another."""
    parts: list[list[Block]] = []
    for block in blocks:
        if isinstance(block, Heading) or not parts:
            parts.append([])
        parts[-1].append(block)
    return parts


def section_id(part: Sequence[Block]) -> str:
    """Id of the heading with which a section begins; empty if it has none."""
    return part[0].id if part and isinstance(part[0], Heading) else ""
