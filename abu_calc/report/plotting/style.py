"""One look for all figures: colors and dashes are those of the page, told once in its style sheet."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import Any, Final

from abu_calc.report.page.beside import beside

SERIES: Final = 4
"""Colors of series; those beyond begin again."""
MARKERS: Final = ("o", "s", "D", "^")
FONT: Final = "DejaVu Sans"
"""Font of the figures; it comes with matplotlib."""
LIKE_IT: Final = f"'{FONT}', Verdana, sans-serif"
"""Texts of SVG files are texts, in the first of these that is there: the second is as wide."""
STYLE: Final[dict[str, Any]] = {
    "font.family": FONT, "font.size": 9.0, "text.parse_math": False, "axes.titlesize": 10.5,
    "axes.titlelocation": "left", "axes.unicode_minus": True, "axes.spines.top": False, "axes.spines.right": False,
    "axes.axisbelow": True, "lines.linewidth": 1.6, "legend.frameon": False, "legend.handlelength": 3.2,
    "savefig.dpi": 200, "svg.fonttype": "none", "svg.hashsalt": "abu-calc", "pdf.fonttype": 42,
}  # fmt: skip


@cache
def colors() -> dict[str, str]:
    """Colours of the page on white, by their names there."""
    first = beside("page.css").split("}", 1)[0]
    return dict(re.findall(r"--(\w+): (#[0-9a-f]{3,8})", first))


@cache
def _dashes() -> dict[int, tuple[float, ...]]:
    """Dashes of lines by series, in widths of a line, which is 2 px wide on the page."""
    rules = re.findall(r"\.line\.s(\d) \{ stroke-dasharray: ([\d ]+);", beside("page.css"))
    return {int(series): tuple(float(part) / 2 for part in parts.split()) for series, parts in rules}


def color_of(series: int) -> str:
    """Colour of a series."""
    return colors()[f"c{(series - 1) % SERIES + 1}"]


def marker_of(series: int) -> str:
    """Marker of a series: round, square, lozenge, triangle."""
    return MARKERS[(series - 1) % len(MARKERS)]


def dashes_of(series: int) -> Any:
    """A style of line."""
    parts = _dashes().get(series)
    return "solid" if parts is None else (0, parts)


@contextmanager
def styled() -> Iterator[None]:
    """Everything as here, nothing as somebody's own settings have it."""
    from matplotlib import style

    with style.context(["default", STYLE]):
        yield
