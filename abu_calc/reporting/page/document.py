"""The page of a result: a summary that prints alone, details with figures and formulas, and the data to repeat it."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape
from itertools import chain
from typing import TYPE_CHECKING, Final

from abu_calc.foundation.checks import verdict_word
from abu_calc.reporting.blocks import Block, Facts, Grid, Heading, Picture
from abu_calc.reporting.charts.figure import SUMMARY, Extras, Figure
from abu_calc.reporting.page.assets import beside, text
from abu_calc.reporting.page.elements import elements, figure, paragraph
from abu_calc.reporting.page.handover import extras_handed_over, handed_over
from abu_calc.reporting.screen import section_id, sections

if TYPE_CHECKING:
    from abu_calc.reporting.outcome import Outcome

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
