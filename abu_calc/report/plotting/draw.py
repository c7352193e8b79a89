"""A figure drawn by matplotlib, and as the contents of a file."""

import importlib.util
import io
import warnings
from typing import TYPE_CHECKING, Any, Final

from abu_calc.errors import OutputError
from abu_calc.escapes import escaped
from abu_calc.report.drawing.shapes import Drawing
from abu_calc.report.figures.chart import Bars, Cells, Plot
from abu_calc.report.figures.figure import Figure
from abu_calc.report.figures.motion import Motion, angles
from abu_calc.report.plotting.style import FONT, LIKE_IT, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawn

SUFFIXES: Final = (".svg", ".png", ".pdf")


def check_matplotlib(wanted: str = "figures") -> None:
    """Raises OutputError where matplotlib is not installed, with the command that installs it."""
    if importlib.util.find_spec("matplotlib") is None:
        raise OutputError(
            f"{wanted} need the package matplotlib, which is not installed",
            remedy='Install it: pip install "abu-calc[report]"',
        )


def drawn(one: Figure) -> "Drawn":
    """Charts, drawings to scale, of a motion the courses of the balls; without a screen."""
    check_matplotlib()
    from abu_calc.report.plotting.bars import barred, celled
    from abu_calc.report.plotting.plots import plotted
    from abu_calc.report.plotting.sheets import sheet

    with styled():
        match one.shown:
            case Plot() as chart:
                return plotted(chart)
            case Bars() as chart:
                return barred(chart)
            case Cells() as chart:
                return celled(chart)
            case Motion() as motion:
                return plotted(angles(motion.view))
            case Drawing() as drawing:
                return sheet(drawing)


def figure_file(one: Figure, suffix: str) -> str | bytes:
    """What a file of this suffix holds: alike for alike figures, with a title and what is to be seen."""
    if suffix == ".svg" and isinstance(one.shown, Drawing):
        from abu_calc.report.drawing.svg import svg_file

        return svg_file((one.shown,))
    figure, buffer = drawn(one), io.BytesIO()
    with styled(), warnings.catch_warnings():
        # Signs that the font has not: the file is written all the same.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure.savefig(buffer, format=suffix[1:], metadata=_metadata(one, suffix))
    found = buffer.getvalue()
    return found.decode().replace(f"font-family: '{FONT}'", f"font-family: {LIKE_IT}") if suffix == ".svg" else found


def _metadata(one: Figure, suffix: str) -> dict[str, Any]:
    """Without a date."""
    shown = one.shown
    match shown:
        case Motion():
            title, told = "Angles of the balls", one.caption
        case Drawing():
            title, told = shown.title, f"{shown.description} {one.caption}"
        case _:
            title, told = shown.title, f"{one.caption} {shown.told}"
    title, told = escaped(title), escaped(told)
    if suffix == ".pdf":
        return {"Title": title, "Subject": told, "CreationDate": None}
    return {"Title": title, "Description": told} | ({"Date": None} if suffix == ".svg" else {})
