"""Files that lie beside the page's modules: style, scripts."""

import json
from pathlib import Path
from typing import Any


def beside(name: str) -> str:
    """The text of a file here."""
    return (Path(__file__).parent / name).read_text(encoding="utf-8")


def script(name: str, **data: Any) -> str:
    """A script of the page with its data, in which nothing can end the element."""
    given = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    return f"<script>\n(() => {{\nconst data = {given};\n{beside(name)}}})();\n</script>"
