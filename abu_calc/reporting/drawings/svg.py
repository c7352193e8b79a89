"""A drawing as SVG: a file of its own, true to scale when printed, or a figure inside a page."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from html import escape
from itertools import pairwise

from abu_calc.reporting.drawings.dimensions import primitives
from abu_calc.reporting.drawings.shapes import (
    PENS,
    TALL,
    Arc,
    Drawing,
    Line,
    Point,
    Primitive,
    Region,
    Solid,
    Text,
    plain,
)

FONT = "Arial, 'Liberation Sans', Helvetica, sans-serif"
ANCHORS = {"left": "start", "centre": "middle", "right": "end"}
BETWEEN = 10.0
"""Distance between sheets in one file [mm]."""


def svg_figure(drawing: Drawing) -> str:
    """An `<svg>` element for a page: as wide as its place, in the page's colour of text, with a text alternative."""
    wide, high = drawing.size
    return _element(drawing, f'viewBox="0 0 {_number(wide)} {_number(high)}" style="width:100%;height:auto"', "")


def svg_file(drawings: Sequence[Drawing]) -> str:
    """A file: sheets below one another, in mm, black on white."""
    wide = max(drawing.size[0] for drawing in drawings)
    high = sum(drawing.size[1] for drawing in drawings) + BETWEEN * (len(drawings) - 1)
    parts = [
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_number(wide)}mm" height="{_number(high)}mm" '
        f'viewBox="0 0 {_number(wide)} {_number(high)}" color="#000">\n'
        f'<rect width="{_number(wide)}" height="{_number(high)}" fill="#fff"/>\n'
    ]
    top = 0.0
    for drawing in drawings:
        place = f'y="{_number(top)}" width="{_number(drawing.size[0])}" height="{_number(drawing.size[1])}" '
        parts.append(_element(drawing, place, "") + "\n")
        top += drawing.size[1] + BETWEEN
    return "".join((*parts, "</svg>\n"))


def _element(drawing: Drawing, attributes: str, before: str) -> str:
    name = f"abu-{drawing.name}"
    shapes = list(primitives(drawing.shapes, drawing.scale))
    return "\n".join((
        f'<svg xmlns="http://www.w3.org/2000/svg" {attributes} role="img" aria-labelledby="{name}-title {name}-desc" '
        f'fill="none" stroke="none" font-family="{escape(FONT)}">',
        f'<title id="{name}-title">{_text(drawing.title)}</title>',
        f'<desc id="{name}-desc">{_text(drawing.description)}</desc>{before}',
        *_patterns(shapes, name),
        *(_drawn(shape, drawing, name) for shape in shapes),
        "</svg>",
    ))  # fmt: skip


def _patterns(shapes: Iterable[Primitive], name: str) -> Iterator[str]:
    kinds = dict.fromkeys((shape.angle, shape.spacing) for shape in shapes if isinstance(shape, Region))
    for angle, spacing in kinds:
        # Patterns turn clockwise; lines along their y stand upright.
        yield (
            f'<defs><pattern id="{_pattern(name, angle, spacing)}" width="{_number(spacing)}" height="10" '
            f'patternUnits="userSpaceOnUse" patternTransform="rotate({_number(90 - angle)})">'
            f'<path d="M{_number(spacing / 2)} 0V10" stroke="currentColor" stroke-width="{PENS["hatch"].width}"/>'
            "</pattern></defs>"
        )


def _pattern(name: str, angle: float, spacing: float) -> str:
    return f"{name}-hatch-{_number(angle)}-{_number(spacing).replace('.', '_')}"


def _drawn(shape: Primitive, drawing: Drawing, name: str) -> str:
    """One primitive in mm on paper, y downwards."""
    scale, (left, _), (_, top) = drawing.scale, drawing.low, drawing.high

    def at(point: Point) -> Point:
        return (point[0] - left) * scale, (top - point[1]) * scale

    match shape:
        case Line(layer, start, end):
            return f'<path d="M{_point(at(start))}L{_point(at(end))}" {_stroke(layer)}/>'
        case Arc(layer, centre, radius, start_angle, end_angle):
            return _arc(at(centre), radius * scale, start_angle, end_angle, _stroke(layer))
        case Solid(corners):
            return f'<path d="M{"L".join(_point(at(corner)) for corner in corners)}Z" fill="currentColor"/>'
        case Region():
            kind, fill = shape.name.replace(" ", "-"), _pattern(name, shape.angle, shape.spacing)
            path = _outline(shape, scale, at)
            edge = f" {_stroke('outline')}" if shape.outlined else ""
            return f'<path class="{kind}" d="{path}" fill="url(#{fill})"{edge}/>'
        case Text():
            return _written(shape, at(shape.at))


def _stroke(layer: str) -> str:
    pen = PENS[layer]  # type: ignore[index]
    dashes = f' stroke-dasharray="{" ".join(map(_number, pen.dashes))}"' if pen.dashes else ""
    return f'stroke="currentColor" stroke-width="{_number(pen.width)}"{dashes}'


def _arc(centre: Point, radius: float, start: float, end: float, stroke: str) -> str:
    if end - start >= 360:
        return f'<circle cx="{_number(centre[0])}" cy="{_number(centre[1])}" r="{_number(radius)}" {stroke}/>'
    ends = [(centre[0] + radius * math.cos(math.radians(angle)), centre[1] - radius * math.sin(math.radians(angle)))
            for angle in (start, end)]  # fmt: skip
    large = int((end - start) % 360 > 180)
    arc = f"M{_point(ends[0])}A{_number(radius)} {_number(radius)} 0 {large} 0 {_point(ends[1])}"
    return f'<path d="{arc}" {stroke}/>'


def _outline(region: Region, scale: float, at: Callable[[Point], Point]) -> str:
    """A closed path; arcs by their bulge."""
    first = region.corners[0]
    path = [f"M{_point(at(first[:2]))}"]
    for (x, y, bulge), (x2, y2, _) in pairwise((*region.corners, first)):
        if bulge:
            chord, half = math.hypot(x2 - x, y2 - y) * scale, 2 * math.atan(abs(bulge))
            radius = _number(chord / (2 * math.sin(half)))
            path.append(f"A{radius} {radius} 0 {int(abs(bulge) > 1)} {int(bulge < 0)} {_point(at((x2, y2)))}")
        else:
            path.append(f"L{_point(at((x2, y2)))}")
    return "".join(path) + "Z"


def _written(text: Text, at: Point) -> str:
    turn = f' transform="rotate({_number(-text.angle)} {_point(at)})"' if text.angle else ""
    return (
        f'<text x="{_number(at[0])}" y="{_number(at[1])}" font-size="{_number(TALL * text.height)}" '
        f'text-anchor="{ANCHORS[text.align]}" fill="currentColor"{turn}>{_text(text.text)}</text>'
    )


def _text(text: str) -> str:
    return escape(plain(text), quote=True)


def _point(point: Point) -> str:
    return f"{_number(point[0])} {_number(point[1])}"


def _number(value: float) -> str:
    return f"{round(value, 4) + 0.0:.10g}"
