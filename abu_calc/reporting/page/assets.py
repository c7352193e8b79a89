"""Files that lie beside the page's modules (style, scripts), and text that a page may hold."""

import json
from html import escape
from pathlib import Path
from typing import Any

from abu_calc.foundation.escaping import escaped


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
