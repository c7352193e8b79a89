"""Figures drawn by matplotlib, charts or drawings to scale, and as the contents of a file.

In drawings to scale a millimetre of paper is one.
"""

import importlib.util
import io
import math
import warnings
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, Final

from abu_calc.foundation.errors import OutputError, escaped
from abu_calc.reporting.charts.chart import Bars, Cells, Figure, Plot, RotorMotionFigure, angles
from abu_calc.reporting.charts.matplotlib_charts import FONT, LIKE_IT, styled
from abu_calc.reporting.drawings.dimensions import primitives
from abu_calc.reporting.drawings.shapes import PENS, TALL, Arc, Drawing, Layer, Line, Point, Region, Solid, Text, plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure as Drawn

INCH: Final = 25.4
POINTS: Final = 72 / INCH
"""Points per millimetre."""
INK: Final = "black"
STEPS: Final = 24
"""Chords of an arc of an outline."""


def sheet(drawing: Drawing) -> "Drawn":
    """Sheet as large as it is on paper."""
    from matplotlib.figure import Figure as Drawn

    wide, high = drawing.size
    figure = Drawn((wide / INCH, high / INCH))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_xlim(0, wide)
    axes.set_ylim(0, high)
    axes.set_axis_off()
    for shape in primitives(drawing.shapes, drawing.scale):
        _draw(axes, drawing, shape)
    return figure


def _draw(axes: "Axes", drawing: Drawing, shape: Any) -> None:
    from matplotlib.patches import Arc as Curve
    from matplotlib.patches import Polygon

    scale, (left, low) = drawing.scale, drawing.low

    def at(point: Point) -> Point:
        return (point[0] - left) * scale, (point[1] - low) * scale

    match shape:
        case Line(layer, start, end):
            axes.plot(*zip(at(start), at(end), strict=True), **_pen(layer))
        case Arc(layer, centre, radius, start_angle, end_angle):
            wide = 2 * radius * scale
            axes.add_patch(Curve(at(centre), wide, wide, theta1=start_angle, theta2=end_angle, **_pen(layer)))
        case Solid(corners):
            axes.add_patch(Polygon([at(corner) for corner in corners], facecolor=INK, edgecolor="none"))
        case Region():
            outline = Polygon(
                [at(point) for point in _outline(shape)], fill=False, joinstyle="miter",
                **(_pen("outline") if shape.outlined else {"linewidth": 0.0}),
            )  # fmt: skip
            axes.add_patch(outline)
            _hatch(axes, shape, outline)
        case Text():
            axes.text(
                *at(shape.at), plain(shape.text), fontsize=TALL * shape.height * POINTS, rotation=shape.angle,
                ha={"left": "left", "centre": "center", "right": "right"}[shape.align], va="baseline",
                rotation_mode="anchor", color=INK,
            )  # fmt: skip


def _pen(layer: Layer) -> dict[str, Any]:
    """Dashes are told in widths of the line."""
    pen = PENS[layer]
    style = (0, tuple(part / pen.width for part in pen.dashes)) if pen.dashes else "solid"
    return {"color": INK, "linewidth": pen.width * POINTS, "linestyle": style}


def _outline(region: Region) -> Iterator[Point]:
    """Corners, and points of the arcs between them."""
    for (x, y, bulge), (x2, y2, _) in pairwise((*region.corners, region.corners[0])):
        yield x, y
        if bulge:
            sweep = 4 * math.atan(bulge)
            start, end = complex(x, y), complex(x2, y2)
            centre = (start + end) / 2 + 1j * (end - start) / (2 * math.tan(sweep / 2))
            for k in range(1, STEPS):
                turned = (start - centre) * complex(math.cos(sweep * k / STEPS), math.sin(sweep * k / STEPS))
                yield (centre + turned).real, (centre + turned).imag


def _hatch(axes: "Axes", region: Region, outline: Any) -> None:
    """Lines across the part, cut off at its outline."""
    from matplotlib.collections import LineCollection

    turn = math.radians(region.angle)
    along, beside = (math.cos(turn), math.sin(turn)), (-math.sin(turn), math.cos(turn))
    corners = outline.get_xy()
    ends = [[x * way[0] + y * way[1] for x, y in corners] for way in (along, beside)]
    (first, last), (near, far) = ((min(each), max(each)) for each in ends)
    count = range(math.ceil(near / region.spacing), math.floor(far / region.spacing) + 1)
    lines = [
        [(t * along[0] + k * region.spacing * beside[0], t * along[1] + k * region.spacing * beside[1])
         for t in (first, last)]
        for k in count
    ]  # fmt: skip
    width = PENS["hatch"].width * POINTS
    hatch = axes.add_collection(LineCollection(lines, colors=INK, linewidths=width), autolim=False)
    hatch.set_clip_path(outline)


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
    from abu_calc.reporting.charts.matplotlib_charts import barred, celled, plotted

    with styled():
        match figure.shown:
            case Plot() as chart:
                return plotted(chart)
            case Bars() as chart:
                return barred(chart)
            case Cells() as chart:
                return celled(chart)
            case RotorMotionFigure() as motion:
                return plotted(angles(motion.view))
            case Drawing() as drawing:
                return sheet(drawing)


def figure_file(illustration: Figure, suffix: str) -> str | bytes:
    """Content of a figure's file with this suffix: the same for the same figure.

    It has a title, and says what is to be seen.
    """
    if suffix == ".svg" and isinstance(illustration.shown, Drawing):
        from abu_calc.reporting.drawings.svg import svg_file

        return svg_file((illustration.shown,))
    figure, buffer = drawn(illustration), io.BytesIO()
    with styled(), warnings.catch_warnings():
        # Signs that the font has not: the file is written all the same.
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        figure.savefig(buffer, format=suffix[1:], metadata=_metadata(illustration, suffix))
    data = buffer.getvalue()
    return data.decode().replace(f"font-family: '{FONT}'", f"font-family: {LIKE_IT}") if suffix == ".svg" else data


def drawings_pdf(drawings: Sequence[Drawing]) -> bytes:
    """Drawings as one PDF, each on a page of its own size; the same bytes for the same drawings."""
    from matplotlib.backends.backend_pdf import PdfPages

    buffer = io.BytesIO()
    about = {"Title": escaped(drawings[0].title), "Subject": escaped(drawings[0].description), "CreationDate": None}
    with styled(), warnings.catch_warnings(), PdfPages(buffer, metadata=about) as pages:
        warnings.filterwarnings("ignore", message="Glyph .* missing from")
        for drawing in drawings:
            pages.savefig(sheet(drawing))
    return buffer.getvalue()


def _metadata(figure: Figure, suffix: str) -> dict[str, Any]:
    """Metadata of a figure's file, without a date."""
    shown = figure.shown
    match shown:
        case RotorMotionFigure():
            title, description = "Angles of the balls", figure.caption
        case Drawing():
            title, description = shown.title, f"{shown.description} {figure.caption}"
        case _:
            title, description = shown.title, f"{figure.caption} {shown.summary}"
    title, description = escaped(title), escaped(description)
    if suffix == ".pdf":
        return {"Title": title, "Subject": description, "CreationDate": None}
    return {"Title": title, "Description": description} | ({"Date": None} if suffix == ".svg" else {})
