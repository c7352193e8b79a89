"""A result in a notebook: title, verdict, drawing of the section and checks, in a few lines of HTML without scripts.

Files that lie beside the page's modules (style, scripts), and text that a page may hold.
"""

import json
from collections.abc import Iterator
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from abu_calc.foundation.checks import WORDS, Check, verdict_words
from abu_calc.foundation.errors import escaped

if TYPE_CHECKING:
    from abu_calc.reporting.outcome import Outcome
    from abu_calc.simulation.result import Result


def text(words: str) -> str:
    """Nothing in them is an element, or acts."""
    return escape(escaped(words), quote=True)


def beside(name: str) -> str:
    """The text of a file here."""
    return (Path(__file__).parent / name).read_text(encoding="utf-8")


def script(name: str, **data: Any) -> str:
    """A script of the page with its data, in which nothing can end the element."""
    given = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return f"<script>\n(() => {{\nconst data = {given};\n{beside(name)}}})();\n</script>"


COLOURS: Final = {"pass": "#1a7f37", "warn": "#9a6700", "fail": "#cf222e", "not-done": "#8250df"}
WIDEST: Final = 720
"""Width of the drawing [px]."""
MOST_NOTES: Final = 5


def card(outcome: "Outcome") -> str:
    """The element of a result that Jupyter shows; all text is escaped, nothing in it acts."""
    result: Result = outcome.content  # type: ignore[assignment]
    warned = result.status == "pass" and any(check.status == "warn" for check in result.checks)
    verdict = text(verdict_words(result.status, result.checks))
    parts = [
        f"<strong>{text(result.title)}</strong>",
        f'<div style="{_coloured("warn" if warned else result.status)}">{verdict}</div>',
        *_drawing(outcome),
        *_checks(result.checks),
        *_notes(result.warnings),
    ]
    return f'<div class="abu-result" style="max-width:60em">{"".join(parts)}</div>'


def _drawing(outcome: "Outcome") -> Iterator[str]:
    """The first sheet, if the result has one."""
    sheets = outcome.drawings() if outcome.drawings else ()
    if sheets:
        from abu_calc.reporting.drawings.svg import svg_figure

        style = f"max-width:{WIDEST}px;background:#fff;color:#000;margin:.5em 0"
        yield f'<div style="{style}">{svg_figure(sheets[0])}</div>'


def _coloured(grade: str) -> str:
    return f"color:{COLOURS[grade]};font-weight:600"


def _checks(checks: tuple[Check, ...]) -> Iterator[str]:
    if not checks:
        return
    yield "<table><thead><tr><th>Check</th><th></th><th></th><th>value</th><th>limit</th></tr></thead><tbody>"
    for check in checks:
        unit = f" {check.unit}" if check.unit else ""
        value, limit = (("" if number is None else f"{number:.4g}{unit}") for number in (check.value, check.limit))
        yield (
            f'<tr title="{text(check.message)}"><td>{check.code}</td>'
            f'<td style="text-align:left">{text(check.name)}</td>'
            f'<td style="{_coloured(check.status)}">{WORDS[check.status]}</td>'
            f"<td>{text(value)}</td><td>{text(limit)}</td></tr>"
        )
    yield "</tbody></table>"


def _notes(warnings: tuple[str, ...]) -> Iterator[str]:
    if warnings:
        left = len(warnings) - MOST_NOTES
        items = "".join(f"<li>{text(warning)}</li>" for warning in warnings[:MOST_NOTES])
        more = f"<li>and {left} more: result.warnings</li>" if left > 0 else ""
        count = f"{len(warnings)} note{'s' if len(warnings) > 1 else ''}"
        yield f"<details><summary>{count}</summary><ul>{items}{more}</ul></details>"
