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


def drawn(figure: Figure) -> "Drawn":
    """Charts, drawings to scale, of a motion the courses of the balls; without a screen."""
    check_matplotlib()
    from abu_calc.report.plotting.bars import barred, celled
    from abu_calc.report.plotting.plots import plotted
    from abu_calc.report.plotting.sheets import sheet

    with styled():
        match figure.shown:
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


def figure_file(illustration: Figure, suffix: str) -> str | bytes:
    """Content of a figure's file with this suffix: the same for the same figure.

    It has a title, and says what is to be seen.
    """
    if suffix == ".svg" and isinstance(illustration.shown, Drawing):
        from abu_calc.report.drawing.svg import svg_file

        return svg_file((illustration.shown,))
    figure, buffer = drawn(illustration), io.BytesIO()
    with styled(), warnings.catch_warnings():
        # Signs that the font has not: the file is written all the same.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure.savefig(buffer, format=suffix[1:], metadata=_metadata(illustration, suffix))
    data = buffer.getvalue()
    return data.decode().replace(f"font-family: '{FONT}'", f"font-family: {LIKE_IT}") if suffix == ".svg" else data


def _metadata(figure: Figure, suffix: str) -> dict[str, Any]:
    """Metadata of a figure's file, without a date."""
    shown = figure.shown
    match shown:
        case Motion():
            title, description = "Angles of the balls", figure.caption
        case Drawing():
            title, description = shown.title, f"{shown.description} {figure.caption}"
        case _:
            title, description = shown.title, f"{figure.caption} {shown.told}"
    title, description = escaped(title), escaped(description)
    if suffix == ".pdf":
        return {"Title": title, "Subject": description, "CreationDate": None}
    return {"Title": title, "Description": description} | ({"Date": None} if suffix == ".svg" else {})
