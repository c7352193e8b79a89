"""The page of a result: a summary that prints alone, details with figures and formulas, and the data to repeat it.

Blocks and figures as elements of a page: the same words and numbers as in a terminal.

A motion is a canvas with a player: button, slider, pace; keys on the canvas too.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from itertools import chain, zip_longest
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from abu_calc.foundation.checks import verdict_word
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Paragraph, Picture
from abu_calc.reporting.charts.chart import SUMMARY, Bars, Cells, Extras, Figure, Plot, RotorMotionFigure
from abu_calc.reporting.drawings.shapes import Drawing
from abu_calc.reporting.drawings.svg import svg_figure
from abu_calc.reporting.page.card import beside, script, text
from abu_calc.reporting.page.chart_svg import bars, cells, plot
from abu_calc.reporting.page.handover import ENTRIES, extras_handed_over, handed_over
from abu_calc.reporting.screen import BEFORE_UNIT, STYLES, TIE, grade_of, section_id, sections

if TYPE_CHECKING:
    from abu_calc.reporting.outcome import Outcome
    from abu_calc.simulation.rotor_view import Array, RotorView


WIDEST: Final = 92
"""Letters that stand side by side on paper."""
COLUMN: Final = 48
"""Letters of words, cells aside, that stand side by side in half of it."""
POINT: Final = "! "
"""Beginning of a warning in a terminal; on a page it is a point of a list."""
KEY: Final = re.compile(r"\b([a-z_]{4,})\.(?=[a-z_]{4})")
"""Table of a key, with its dot."""
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
    if mark == ENTRIES:
        return f'<p class="{ENTRIES}"><code>{text(words)}</code></p>'
    if words.startswith(POINT):
        return f'<p class="point">{_coded(_tied(words.removeprefix(POINT)))}</p>'
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
        "".join(f"<td{_kind(cell) or kind}>{_cell(cell)}</td>" for cell, kind in zip(row, kinds, strict=False))
        for row in grid.rows
    )
    least = sum(
        max(len(word) for cell in column for word in [*cell.replace(".", " ").split(), ""]) for column in _columns(grid)
    )
    body = head + "<tbody>\n" + "".join(f"<tr>{row}</tr>\n" for row in rows) + "</tbody>"
    return _table(title, body, "broad" if least > COLUMN else "")


def _columns(grid: Grid) -> Iterable[tuple[str, ...]]:
    return zip_longest(grid.header, *grid.rows, fillvalue="")


def _coded(words: str) -> str:
    return CODE.sub(r"<code>\1</code>", text(words))


def _tied(words: str) -> str:
    """A number keeps its unit beside it."""
    return BEFORE_UNIT.sub(TIE, words)


def _cell(words: str) -> str:
    """Text of a cell; a key may be broken behind its table."""
    return KEY.sub(r"\1.<wbr>", text(_tied(words)))


def _kind(cell: str) -> str:
    """Class of a cell by its grade, or by its indentation."""
    grade = grade_of(cell)
    return f' class="{grade}"' if grade in STYLES else ' class="inner"' if cell.startswith(" ") else ""


def _table(title: str, rows: str, kind: str = "") -> str:
    """A table in a place of its own, which scrolls, by keys too, where the page is narrower."""
    named = f' class="{kind}"' if kind else ""
    return (
        f'<div class="wide{" broad" * (kind == "broad")}" tabindex="0" role="region" aria-label="{text(title)}">'
        f"<table{named}>\n{rows}\n</table></div>"
    )


PACES = {"1": "as it is", "0.2": "5 × slower", "0.05": "20 × slower", "0.01": "100 × slower"}
USUAL = "0.2"


def player(motion: RotorMotionFigure) -> str:
    """The element, with its data and its script."""
    runs = [(motion.name, motion.view), *motion.others]
    end = float(motion.view.t_s[-1])
    options = "".join(
        f'<option value="{value}"{" selected" if value == USUAL else ""}>{text(name)}</option>'
        for value, name in PACES.items()
    )
    alternative = f"The balls and the axis, seen in the rotor, from 0 to {end:.3g} s; space plays, arrows move in time"
    data = {
        "runs": [_run(view) for _, view in runs], "race": motion.race_mm, "ball": list(motion.balls_mm),
        "pitch": list(motion.view.pitch_radii_mm),
    }  # fmt: skip
    starts = "".join(f'<option value="{index}">{text(name)}</option>' for index, (name, _) in enumerate(runs))
    chosen = f'<select id="motion-start" aria-label="Start">{starts}</select>' if motion.others else ""
    return (
        f'<div class="player"><canvas id="motion" width="640" height="310" tabindex="0" role="img" '
        f'aria-label="{text(alternative)}"></canvas><div class="keys">'
        '<button type="button" id="motion-play">Play</button>'
        f'<input type="range" id="motion-time" min="0" max="{end:.6g}" step="any" value="0" aria-label="Time">'
        f'<select id="motion-pace" aria-label="Pace">{options}</select>{chosen}</div><p id="motion-told"></p></div>'
        + script("motion.js", **data)
    )


def _run(view: "RotorView") -> dict[str, Any]:
    return {
        "t": _rounded(view.t_s, 6), "x": _rounded(view.x_um, 3), "y": _rounded(view.y_um, 3),
        "balls": [_rounded(row, 2) for row in view.ball_angles_deg], "rest": _rounded(view.residual_g_mm, 4),
        "imbalance": view.imbalance_angle_deg,
    }  # fmt: skip


def _rounded(values: "Array", digits: int) -> list[float]:
    return [round(value, digits) for value in values.tolist()]


PIXELS: Final = 3.78
"""Pixels of a screen per millimetre."""
READABLE: Final = 2.11
"""Pixels for a millimetre below which writing is too small."""
NAMESPACE: Final = ' xmlns="http://www.w3.org/2000/svg"'
"""Elements inside a page need none."""


class _Room(NamedTuple):
    """Preferred width of an element, and its least width [px]; if narrower, it scrolls in its place."""

    wide: float
    least: float = 0.0


def figure(figure: Figure) -> str:
    """The element with its caption."""
    room, drawn = _drawn(figure)
    style = f"max-width:{room.wide:.0f}px" + (f";min-width:{room.least:.0f}px" if room.least else "")
    return (
        f'<figure style="max-width:{room.wide:.0f}px"><div class="wide" tabindex="0" role="group" '
        f'aria-label="{text(figure.caption)}"><div style="{style}">{drawn}</div></div>'
        f"<figcaption>{text(figure.caption)}</figcaption></figure>"
    )


def _drawn(figure: Figure) -> tuple[_Room, str]:
    match figure.shown:
        case Plot() as chart:
            return _Room(520.0), plot(figure.name, chart)
        case Bars() as chart:
            return _Room(520.0), bars(figure.name, chart)
        case Cells() as chart:
            return _Room(520.0), cells(figure.name, chart)
        case RotorMotionFigure() as motion:
            return _Room(640.0), player(motion)
        case Drawing() as drawing:
            wide = drawing.size[0]
            return _Room(PIXELS * wide, READABLE * wide), svg_figure(drawing).replace(NAMESPACE, "")


LAST: Final = frozenset({"conventions", "defaults"})
"""Ids of the sections that stand at the end, behind the calculation note."""
SOURCE: Final = "provenance"
"""Id of the section whose blocks stand below `REPEAT`."""
REPEAT: Final = "Origin of this page"
NOTE: Final = "Calculation note"
MAIN: Final = '<main id="main" tabindex="-1">'
SAFE: Final = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:"
"""Security policy of the page: it never asks a network, not even by mistake."""


def page(outcome: "Outcome") -> str:
    """The text of a file in HTML."""
    extras = extras_handed_over(outcome.extras()) if outcome.extras else Extras()
    head, *others = (_for_reader(part) for part in sections(outcome.blocks))
    title = _heading(extras.summary[:1] or head) or outcome.command.capitalize()
    others = [part for part in others if part and section_id(part) not in extras.held]
    front = [part for part in others if section_id(part) not in LAST | {SOURCE}]
    back = [part for part in others if section_id(part) in LAST]
    source = [part for part in others if section_id(part) == SOURCE]
    above = figures_of([Heading("", SUMMARY)], extras.figures) if extras.summary else figures_of(head, extras.figures)
    drawn = [*above, *(illustration for part in front for illustration in figures_of(part, extras.figures))]
    rest = tuple(illustration for illustration in extras.figures if illustration not in drawn)
    named = [_heading(part) for part in front]
    named += ["Figures"] * bool(rest) + [NOTE] * bool(extras.note)
    named += [_heading(part) for part in back] + [REPEAT]
    contents = _contents(named)
    if extras.summary:
        opening: Iterable[str] = chain(_summary(title, extras.summary, above), (contents, MAIN))
    else:
        opening = chain(
            (f"<header><h1>{text(title)}</h1>",),
            elements(_below(head), title),
            ("</header>", contents, MAIN, "<section>", *map(figure, above), "</section>"),
        )
    body = chain(
        opening,
        _sections(front, extras.figures),
        (_opened("Figures"), *map(figure, rest), "</section>") if rest else (),
        _note(extras.note),
        _sections(back, ()),
        (_opened(REPEAT), *_repeat(outcome)),
        chain.from_iterable(elements(_below(part), REPEAT) for part in source),
        ("</section>", "</main>"),
    )
    return framed(f"{verdict_word(outcome.status, outcome.checks)}: {title}", body)


def _for_reader(part: Sequence[Block]) -> Sequence[Block]:
    """A section without commands, nothing if all of it are commands; entries of the file stay as they are."""
    if section_id(part) in {SOURCE, "defaults"}:
        return part
    shown = handed_over(part)
    return shown if len(shown) > 1 or len(part) == len(shown) else []


def _summary(title: str, blocks: Sequence[Block], figures: Sequence[Figure]) -> Iterator[str]:
    """Sheets of their own: title with the verdict, figures, then the rest."""
    head = next((k for k, block in enumerate(blocks) if isinstance(block, Grid)), len(blocks))
    yield f'<header class="summary"><h1>{text(title)}</h1>'
    yield from elements(blocks[1:head], title)
    yield from map(figure, figures)
    yield from elements(blocks[head:], title)
    yield "</header>"


def framed(title: str, body: Iterable[str]) -> str:
    """A whole page with its style."""
    lines = (
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{escape(SAFE)}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<meta name="color-scheme" content="light dark"><link rel="icon" href="data:,">',
        f"<title>{text(title)}</title>",
        f"<style>\n{beside('page.css')}</style></head>",
        '<body><a class="skip" href="#main">To the report</a>',
        *body,
        "</body></html>",
    )
    return "\n".join(line for line in lines if line) + "\n"


def _sections(parts: Sequence[Sequence[Block]], figures: Sequence[Figure]) -> Iterator[str]:
    """Each a heading, its figures, and what stands below it; pictures in characters give way to figures."""
    titles = [_heading(part) for part in parts]
    for index, (title, part) in enumerate(zip(titles, parts, strict=True)):
        drawn = figures_of(part, figures)
        yield _opened(title, linked=title not in titles[:index])
        yield from map(figure, drawn)
        yield from elements((block for block in _below(part) if not (drawn and isinstance(block, Picture))), title)
        yield "</section>"


def figures_of(part: Sequence[Block], figures: Sequence[Figure]) -> list[Figure]:
    """Figures that stand below the heading of a section."""
    return [figure for figure in figures if figure.section and figure.section == section_id(part)]


def _note(blocks: Sequence[Block]) -> Iterator[str]:
    """Formulas behind their heading, which opens them; on paper they are left out."""
    if blocks:
        opened = _opened(NOTE).replace("<h2>", '<details class="note"><summary><h2>')
        yield f"{opened}</summary>"
        yield paragraph(
            "Each step with the numbers of this result put in (→), then what its formulas say of themselves."
        )
        yield from elements(blocks, NOTE, 3)
        yield "</details></section>"


def _repeat(outcome: "Outcome") -> Iterator[str]:
    """Command with its options, and the whole hash of the file, which a terminal has no room for."""
    yield from elements([Facts(tuple((label, "", value) for label, value in outcome.settings))], REPEAT)
    source = outcome.provenance
    if source.sha256:
        yield f'<p>{text(source.file or "")}, SHA-256:</p><pre class="command" tabindex="0">{text(source.sha256)}</pre>'


def _contents(titles: Sequence[str]) -> str:
    """Contents of the page; of sections that share a name, the first."""
    links = "".join(f'<li><a href="#{_place(title)}">{text(title)}</a></li>\n' for title in dict.fromkeys(titles))
    return f'<nav aria-label="Contents"><ul>\n{links}</ul></nav>'


def _opened(title: str, *, linked: bool = True) -> str:
    place = f' id="{_place(title)}"' if linked else ""
    return f"<section{place}><h2>{text(title)}</h2>"


def _place(title: str) -> str:
    """Link name of a section: letters and digits of its title."""
    return "-" + "".join(sign if sign.isalnum() and sign.isascii() else "-" for sign in title.lower())


def _heading(part: Sequence[Block]) -> str:
    return part[0].text.strip() if part and isinstance(part[0], Heading) else ""


def _below(part: Sequence[Block]) -> Sequence[Block]:
    return part[1:] if part and isinstance(part[0], Heading) else part
