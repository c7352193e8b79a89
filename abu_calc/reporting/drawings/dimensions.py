"""Dimensions, leaders and signs of drawings as lines, arrows and texts, alike in every format; extent of shapes.

Signs follow ISO 129, ISO 1101 and ISO 1302. `sketch` adds the common parts of sketches: the line that names the object,
and their extent.

Callouts: what is asked of a surface, on a shelf at the end of a leader, in columns beside a view.

Signs follow ISO 1101 (frames), ISO 5459 (datums), ISO 1302 (roughness).
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Final, Literal, NamedTuple

from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SMALL,
    Align,
    Arc,
    Drawing,
    Length,
    Line,
    Point,
    Primitive,
    Radius,
    Region,
    Shape,
    Solid,
    Text,
    ToleranceFrame,
    fitted,
    plain,
    text_width,
)
from abu_calc.simulation.result import Result

ARROW = 3.0
HALF_ARROW = 0.5
BEYOND = 1.5
"""Overhang of an extension line past its arrow, on paper [mm]."""
ABOVE = 1.0
"""Distance between a line and the text on it. All lengths are on paper [mm]."""


def primitives(shapes: Iterable[Shape], scale: float) -> Iterator[Primitive]:
    """Shapes with every dimension as its picture."""
    for shape in shapes:
        if isinstance(shape, Length | Radius | ToleranceFrame):
            yield from picture(shape, scale)
        else:
            yield shape


def picture(dimension: Length | Radius | ToleranceFrame, scale: float) -> tuple[Primitive, ...]:
    """Primitives that draw a dimension or a frame."""
    if isinstance(dimension, ToleranceFrame):
        return tolerance_frame(dimension.corner, dimension.cells, scale)
    return _length(dimension, scale) if isinstance(dimension, Length) else _radius(dimension, scale)


def fits(value: float, text: str, scale: float) -> bool:
    """True if a text has room on the line of a dimension, between its arrows' lines."""
    return value * scale >= max(text_width(text, HEIGHT) + 1, 3 * ARROW)


def _length(length: Length, scale: float) -> tuple[Primitive, ...]:
    """Described along x, turned where it stands upright."""
    axis, unit = (1 if length.upright else 0), 1 / scale
    first, last = sorted((length.start, length.end), key=lambda point: point[axis])
    low, high = first[axis], last[axis]

    def at(along: float, across: float) -> Point:
        return (across, along) if length.upright else (along, across)

    shapes = list[Primitive]()
    for point in (first, last):
        side = math.copysign(unit, length.at - point[1 - axis])
        ends = point[1 - axis] + side, length.at + BEYOND * side
        shapes.append(Line("dimension", *(at(point[axis], end) for end in ends)))
    if length.value * scale >= 3 * ARROW:
        shapes += _arrow(at(low, length.at), at(1, 0), unit), _arrow(at(high, length.at), at(-1, 0), unit)
    else:
        shapes += (_stroke(at(end, length.at), unit) for end in (low, high))
    (start, align), reach = _place(length, (low, high), unit)
    shapes.append(Line("dimension", at(reach[0], length.at), at(reach[1], length.at)))
    # Upright texts are read from the right: above is left of their line.
    above, turn = (-unit, 90.0) if length.upright else (unit, 0.0)
    shapes.append(Text(at(start, length.at + ABOVE * above), length.text, HEIGHT, align, turn))
    if length.below:
        shapes.append(Text(at(start, length.at - (ABOVE + HEIGHT) * above), length.below, HEIGHT, align, turn))
    return tuple(shapes)


def _stroke(middle: Point, unit: float) -> Line:
    """Stroke in place of an arrow for which there is no room."""
    (x, y), half = middle, ARROW / 2 * unit
    return Line("dimension", (x - half, y - half), (x + half, y + half))


def _place(length: Length, ends: Point, unit: float) -> tuple[tuple[float, Align], Point]:
    """Place and alignment of a dimension's text, and the ends of its line."""
    (low, high), long = ends, text_width(max(length.text, length.below, key=len), HEIGHT) * unit
    if fits(length.value, max(length.text, length.below, key=len), 1 / unit):
        # Away from the middle as far as the text stays between the arrows.
        half = (long + 2 * ARROW * unit) / 2
        middle = max(low + half, min(low + length.along * (high - low), high - half))
        return (middle if length.along != 0.5 else (low + high) / 2, "centre"), ends
    gap = ARROW * unit + length.clear
    if length.beyond == "start":
        return (low - gap - long, "left"), (low - gap - long, high)
    return (high + gap, "left"), (low, high + gap + long)


def _arrow(tip: Point, away: Point, unit: float) -> Solid:
    """An arrow head that points against `away`, a direction."""
    size = math.hypot(*away)
    x, y = away[0] / size * unit, away[1] / size * unit
    back = tip[0] + ARROW * x, tip[1] + ARROW * y
    return Solid((tip, (back[0] - HALF_ARROW * y, back[1] + HALF_ARROW * x),
                  (back[0] + HALF_ARROW * y, back[1] - HALF_ARROW * x)))  # fmt: skip


def _radius(radius: Radius, scale: float) -> tuple[Primitive, ...]:
    return leader(radius.touch, radius.shelf, radius.text, scale)


def leader(
    tip: Point, shelf: Point, text: str, scale: float, *, pointed: bool = True, more: float = 0.0
) -> tuple[Primitive, ...]:
    """A line from a text on a shelf to what it tells about, with an arrow, or a dot inside a part.

    The shelf begins at `shelf` and runs away from the tip, `more` beyond the text [mm on paper].
    """
    unit = 1 / scale
    long, right = (text_width(text, HEIGHT) + more) * unit, shelf[0] >= tip[0]
    end = shelf[0] + (long if right else -long), shelf[1]
    away = shelf[0] - tip[0], shelf[1] - tip[1]
    head: Primitive = _arrow(tip, away, unit) if pointed else Arc("dimension", tip, 0.5 * unit)
    left = min(shelf[0], end[0])
    return (Line("dimension", tip, shelf), Line("dimension", shelf, end), head,
            Text((left, shelf[1] + ABOVE * unit), text))  # fmt: skip


def arrow(tip: Point, tail: Point, scale: float) -> tuple[Primitive, ...]:
    """A line with a head."""
    return Line("dimension", tail, tip), _arrow(tip, (tail[0] - tip[0], tail[1] - tip[1]), 1 / scale)


def tolerance_frame(corner: Point, cells: Sequence[str], scale: float) -> tuple[Primitive, ...]:
    """A frame after ISO 1101; `corner` its upper left one; the first cell names the characteristic (`SIGNS`)."""
    unit, (x, top) = 1 / scale, corner
    low, shapes, left = top - 2 * HEIGHT * unit, list[Primitive](), x
    for index, cell in enumerate(cells):
        wide = (2 * HEIGHT if index == 0 else max(2 * HEIGHT, text_width(cell, HEIGHT) + 2)) * unit
        middle = left + wide / 2
        if index == 0:
            shapes += _sign(cell, (middle, (low + top) / 2), unit)
        else:
            shapes.append(Text((middle, low + HEIGHT / 2 * unit), cell, align="centre"))
        left += wide
        shapes.append(Line("dimension", (left, low), (left, top)))
    return (*shapes, Line("dimension", (x, low), (x, top)), Line("dimension", (x, top), (left, top)),
            Line("dimension", (x, low), (left, low)))  # fmt: skip


SIGNS: Final = {
    "circularity": "e", "cylindricity": "g", "flatness": "c", "perpendicularity": "b", "parallelism": "f",
    "runout": "h", "total runout": "t",
}  # fmt: skip
"""Characteristics of ISO 1101, each with its letter in the font of signs that CAD programs have (gdt)."""


def _sign(name: str, middle: Point, unit: float) -> tuple[Primitive, ...]:
    """Sign of a characteristic about a point, as high as a text."""
    x, y = middle
    reach = HEIGHT / 2 * unit

    def line(*ends: float) -> Line:
        x1, y1, x2, y2 = ends
        return Line("dimension", (x + x1 * reach, y + y1 * reach), (x + x2 * reach, y + y2 * reach))

    match name:
        case "circularity":
            return (Arc("dimension", middle, reach),)
        case "cylindricity":
            return Arc("dimension", middle, 0.6 * reach), line(-1.2, -1, -0.4, 1), line(0.4, -1, 1.2, 1)
        case "flatness":
            return line(-1.2, -0.6, 0.6, -0.6), line(-0.6, 0.6, 1.2, 0.6), line(-1.2, -0.6, -0.6, 0.6), line(
                0.6, -0.6, 1.2, 0.6)  # fmt: skip
        case "perpendicularity":
            return line(-1, -1, 1, -1), line(0, -1, 0, 1)
        case "parallelism":
            return line(-0.9, -1, 0.1, 1), line(-0.1, -1, 0.9, 1)
        case "total runout":
            tips = ((x + (0.4 + 1.2 * index) * reach, y + reach) for index in (0, 1))
            arrows = (arrow(tip, (tip[0] - 1.6 * reach, y - reach), 1 / unit) for tip in tips)
            return (line(-1.2, -1, 0.2, -1), *(shape for both in arrows for shape in both))
        case "runout":
            return arrow((x + reach, y + reach), (x - reach, y - reach), 1 / unit)
    raise ValueError(f"no characteristic of ISO 1101: {name}")


def datum(point: Point, letter: str, scale: float, *, upwards: bool = False) -> tuple[Primitive, ...]:
    """The triangle of a datum below a point, or above it, and its letter in a box."""
    unit, (x, y) = 1 / scale, point
    half, away = HEIGHT * unit, unit if upwards else -unit
    base, near = y + 3 * away, y + 6 * away
    low = near if upwards else near - 2 * half
    box = ((x - half, low), (x + half, low), (x + half, low + 2 * half), (x - half, low + 2 * half))
    edges = (Line("dimension", a, b) for a, b in zip(box, (*box[1:], box[0]), strict=True))
    triangle = Solid(((x - 1.8 * unit, y), (x + 1.8 * unit, y), (x, base)))
    return (triangle, Line("dimension", (x, base), (x, near)), *edges,
            Text((x, low + 0.5 * half), letter, align="centre"))  # fmt: skip


def roughness(point: Point, value: str, scale: float) -> tuple[Primitive, ...]:
    """The sign for a machined surface above a point, its value right of it (ISO 1302)."""
    unit, (x, y) = HEIGHT / scale, point
    left, right = (x - 0.8 * unit, y + 1.4 * unit), (x + 1.6 * unit, y + 2.8 * unit)
    return (Line("dimension", point, left), Line("dimension", left, (x + 0.8 * unit, y + 1.4 * unit)),
            Line("dimension", point, right),
            Line("dimension", right, (right[0] + text_width(value, HEIGHT) / scale, right[1])),
            Text((right[0], right[1] - 1.35 * unit), value))  # fmt: skip


def extent(shapes: Sequence[Shape], scale: float) -> tuple[Point, Point]:
    """Lower left and upper right corner of all that is drawn."""
    boxes = [box(primitive, scale) for primitive in primitives(shapes, scale)]
    return ((min(low[0] for low, _ in boxes), min(low[1] for low, _ in boxes)),
            (max(high[0] for _, high in boxes), max(high[1] for _, high in boxes)))  # fmt: skip


def box(shape: Primitive, scale: float) -> tuple[Point, Point]:
    """Extent of one primitive: lower left and upper right corner."""
    match shape:
        case Text():
            return shape.box(scale)
        case Arc(_, (x, y), radius, start, end):
            quarters = (90.0 * turn for turn in range(math.ceil(start / 90), math.floor(end / 90) + 1))
            turns = [math.radians(angle) for angle in (start, end, *quarters)]
            return _around((x + radius * math.cos(turn), y + radius * math.sin(turn)) for turn in turns)
        case Line(_, start, end):
            return _around((start, end))
        case Solid(corners):
            return _around(corners)
        case Region(corners):
            return _around((x, y) for x, y, _ in corners)


def moved(shape: Shape, by: Point) -> Shape:
    """The same shape elsewhere."""

    def to(point: Point) -> Point:
        return point[0] + by[0], point[1] + by[1]

    match shape:
        case Text():
            return replace(shape, at=to(shape.at))
        case Arc():
            return replace(shape, centre=to(shape.centre))
        case Line():
            return replace(shape, start=to(shape.start), end=to(shape.end))
        case Solid((first, second, third)):
            return Solid((to(first), to(second), to(third)))
        case Region():
            return replace(shape, corners=tuple((x + by[0], y + by[1], bulge) for x, y, bulge in shape.corners))
        case Length():
            return replace(shape, start=to(shape.start), end=to(shape.end), at=shape.at + by[0 if shape.upright else 1])
        case Radius():
            return replace(shape, centre=to(shape.centre), shelf=to(shape.shelf))
        case ToleranceFrame():
            return replace(shape, corner=to(shape.corner))


def _around(points: Iterable[Point]) -> tuple[Point, Point]:
    across, up = zip(*points, strict=True)
    return (min(across), min(up)), (max(across), max(up))


ROOM = 220.0
"""Room for the object on paper [mm]."""
MARGIN = 8.0


def scale_for(length: float, scales: Sequence[float]) -> float:
    """The largest scale at which a length [mm] has room."""
    return next((scale for scale in scales if scale * length <= ROOM), scales[-1])


def sketch(name: str, title: str, description: str, result: Result, shapes: Sequence[Shape], scale: float) -> Drawing:
    """A drawing without frame: title above, machine, file's hash and date below."""
    unit, source = 1 / scale, result.provenance
    low, high = extent(shapes, scale)
    wide = (high[0] - low[0]) * scale
    imprint = f"{plain(result.title)}, {source.date}, abu-calc {source.version}"
    below = (
        *((f"SHA-256 {source.sha256}",) if source.sha256 else ()),
        "Sketch: what has no dimension is not to scale.",
    )
    lines = [Text((low[0], high[1] + 8 * unit), *fitted(title, wide, 1.4 * HEIGHT))]
    for index, line in enumerate((imprint, *below), 1):
        lines.append(Text((low[0], low[1] - (4 + 4.5 * index) * unit), *fitted(line, wide, SMALL)))
    every = (*shapes, *lines)
    low, high = extent(every, scale)
    margin = MARGIN * unit
    corners = (low[0] - margin, low[1] - margin), (high[0] + margin, high[1] + margin)
    return Drawing(name, title, description, scale, *corners, every)


PLAIN_ROW: Final = 6.0
ROUGH_ROW: Final = 11.5
FRAME_ROW: Final = 7.0
DATUM_ROW: Final = 14.5
BETWEEN: Final = 3.0
"""Heights of a callout's rows and the distance to the next one, on paper [mm]."""
RISE: Final = 6.0
"""Height of a shelf above its tip, so that no leader lies in a surface, on paper [mm]."""
SIGN: Final = 9.0
"""Width of the sign of roughness without its value, on paper [mm]."""


class Callout(NamedTuple):
    """Demands on a surface at a point: a text, one below it, roughness as written, frames, the letter of a datum."""

    tip: Point
    text: str = ""
    rough: str = ""
    frames: tuple[tuple[str, ...], ...] = ()
    datum: str = ""
    pointed: bool = True
    below: str = ""

    @property
    def above(self) -> float:
        """Height above its shelf on paper [mm]."""
        return ROUGH_ROW if self.rough else PLAIN_ROW

    @property
    def height(self) -> float:
        """Height on paper [mm]."""
        hanging = (PLAIN_ROW if self.below else 0.0) + (DATUM_ROW if self.datum else 0.0)
        return self.above + hanging + FRAME_ROW * len(self.frames)

    @property
    def width(self) -> float:
        """Width on paper [mm]."""
        sign = SIGN + text_width(self.rough, HEIGHT) if self.rough else 0.0
        rows = [text_width(self.text, HEIGHT) + sign + 1, text_width(self.below, HEIGHT) + 1]
        rows += [2 * HEIGHT + sum(max(2 * HEIGHT, text_width(cell, HEIGHT) + 2) for cell in cells[1:])
                 for cells in self.frames]  # fmt: skip
        return max(rows)


Side = Literal["left", "right"]


def column(callouts: Sequence[Callout], x: float, top: float, side: Side, scale: float) -> Iterator[Shape]:
    """Callouts below one another from `top` [mm of the object], in the order of their tips; shelves begin at `x`."""
    y = top
    for callout in sorted(callouts, key=lambda each: -each.tip[1]):
        y = min(y, callout.tip[1] + callout.height / scale)
        yield from _drawn(callout, x, y, side, scale)
        y -= (callout.height + BETWEEN) / scale


def rising_column(callouts: Sequence[Callout], x: float, limit: float, side: Side, scale: float) -> Iterator[Shape]:
    """Callouts above one another, no shelf below its tip unless all have to go down to stay below `limit`."""
    low, shelves = -math.inf, list[tuple[Callout, float]]()
    for callout in sorted(callouts, key=lambda each: each.tip[1]):
        hanging = callout.height - callout.above
        shelf = max(callout.tip[1] + RISE / scale, low + (BETWEEN + hanging) / scale)
        shelves.append((callout, shelf))
        low = shelf + callout.above / scale
    down = max(low - limit, 0.0) if shelves else 0.0
    for callout, shelf in shelves:
        yield from _drawn(callout, x, shelf - down + callout.above / scale, side, scale)


def _drawn(callout: Callout, x: float, top: float, side: str, scale: float) -> Iterator[Shape]:
    unit = 1 / scale
    shelf = top - callout.above * unit
    left = x if side == "right" else x - callout.width * unit
    line = leader(callout.tip, (x, shelf), "", scale, more=callout.width, pointed=callout.pointed)
    yield from (shape for shape in line if not isinstance(shape, Text))
    if callout.text:
        yield Text((left + 0.5 * unit, shelf + ABOVE * unit), callout.text)
    if callout.rough:
        at = left + (text_width(callout.text, HEIGHT) + 4) * unit
        yield from roughness((at, shelf), callout.rough, scale)
    y = shelf
    if callout.below:
        y -= PLAIN_ROW * unit
        yield Text((left + 0.5 * unit, y + ABOVE * unit), callout.below)
    for cells in callout.frames:
        yield ToleranceFrame((left, y), cells)
        y -= FRAME_ROW * unit
    if callout.datum:
        yield from datum((left + 6 * unit, y), callout.datum, scale)


def balloon(tip: Point, centre: Point, number: str, scale: float) -> Iterator[Shape]:
    """The number of an item in a circle, with a line that ends in a dot inside the part (ISO 6433)."""
    unit, radius = 1 / scale, 5.0 / scale
    across, up = tip[0] - centre[0], tip[1] - centre[1]
    far = max((across**2 + up**2) ** 0.5, 1e-9)
    edge = centre[0] + radius * across / far, centre[1] + radius * up / far
    yield Line("dimension", edge, tip)
    yield Arc("dimension", tip, 0.5 * unit)
    yield Arc("dimension", centre, radius)
    yield Text((centre[0], centre[1] - HEIGHT / 2 * unit), number, HEIGHT, "centre")


def projection_symbol(corner: Point, unit: float) -> Iterator[Shape]:
    """The sign of first-angle projection (ISO 5456-2), 16 by 8 mm on paper, from its lower left corner."""
    x, y = corner[0], corner[1] + 4 * unit

    def line(layer: Literal["outline", "centre"], *ends: float) -> Line:
        x1, y1, x2, y2 = ends
        return Line(layer, (x + x1 * unit, y + y1 * unit), (x + x2 * unit, y + y2 * unit))

    yield from (line("outline", 0, -1.5, 0, 1.5), line("outline", 6, -3, 6, 3), line("outline", 0, 1.5, 6, 3),
                line("outline", 0, -1.5, 6, -3), line("centre", -1, 0, 7, 0), line("centre", 8.5, 0, 16.5, 0),
                line("centre", 12.5, -4, 12.5, 4))  # fmt: skip
    for radius in (1.5, 3.0):
        yield Arc("outline", (x + 12.5 * unit, y), radius * unit)
