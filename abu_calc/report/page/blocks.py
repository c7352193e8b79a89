"""Blocks as elements of a page: the same words and numbers as in a terminal."""

import re
from collections.abc import Iterable, Iterator
from typing import Final

from abu_calc.report.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.report.page.words import text
from abu_calc.report.text import BEFORE_UNIT, STYLES, TIE, WORDS

WIDEST: Final = 92
"""Letters that stand side by side on paper."""
CODE = re.compile(r"`([^`]+)`")


def elements(blocks: Iterable[Block], title: str, level: int = 2) -> Iterator[str]:
    """Each block as an element; `title`: of the section, by which tables are called; `level`: of its headings."""
    for block in blocks:
        match block:
            case Heading(words):
                title = words.strip()
                deep = level + words.startswith(" ")
                yield f"<h{deep}>{_coded(title)}</h{deep}>"
            case Paragraph(words, mark):
                if words:
                    yield paragraph(words, mark)
            case Facts(rows):
                yield _facts(rows, title)
            case Grid():
                yield from (_grid(grid, title) for grid in block.within(WIDEST))
            case Picture(lines, caption):
                drawn = text("\n".join(lines)).replace("\\n", "\n")
                yield (
                    f'<figure><pre role="img" aria-label="{text(caption)}">{drawn}</pre>'
                    f"<figcaption>{text(caption)}</figcaption></figure>"
                )


def paragraph(words: str, mark: str | None = None) -> str:
    """Running text; what is a command stands as code."""
    kind = f' class="{text(mark)}"' if mark in STYLES else ""
    return f"<p{kind}>{_coded(_tied(words))}</p>"


def _facts(rows: Iterable[tuple[str, str, str]], title: str) -> str:
    lines = "".join(
        f'<tr><th scope="row">{text(label)}</th><td class="sign">{text(sign)}</td><td>{_cell(value)}</td></tr>\n'
        for label, sign, value in rows
    )
    return _table(title, f"<tbody>\n{lines}</tbody>", "facts") if lines else ""


def _grid(grid: Grid, title: str) -> str:
    kinds = [' class="number"' if index in grid.right else "" for index in range(len(grid.header))]
    names = "".join(f'<th scope="col"{kind}>{text(name)}</th>' for name, kind in zip(grid.header, kinds, strict=True))
    head = f"<thead><tr>{names}</tr></thead>\n" if any(grid.header) else ""
    rows = (
        "".join(f"<td{_graded(cell) or kind}>{_cell(cell)}</td>" for cell, kind in zip(row, kinds, strict=False))
        for row in grid.rows
    )
    return _table(title, head + "<tbody>\n" + "".join(f"<tr>{row}</tr>\n" for row in rows) + "</tbody>")


def _coded(words: str) -> str:
    return CODE.sub(r"<code>\1</code>", text(words))


def _tied(words: str) -> str:
    """A number keeps its unit beside it."""
    return BEFORE_UNIT.sub(TIE, words)


def _cell(words: str) -> str:
    return text(_tied(words))


def _graded(cell: str) -> str:
    grade = WORDS.get(cell, cell)
    return f' class="{grade}"' if grade in STYLES else ""


def _table(title: str, rows: str, kind: str = "") -> str:
    """A table in a place of its own, which scrolls, by keys too, where the page is narrower."""
    named = f' class="{kind}"' if kind else ""
    return (
        f'<div class="wide" tabindex="0" role="region" aria-label="{text(title)}">'
        f"<table{named}>\n{rows}\n</table></div>"
    )
