"""Extent of shapes, and the same shapes elsewhere."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from abu_calc.report.drawing.dimensions import primitives
from abu_calc.report.drawing.shapes import Arc, Length, Line, Point, Primitive, Radius, Region, Shape, Solid, Text


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


def _around(points: Iterable[Point]) -> tuple[Point, Point]:
    across, up = zip(*points, strict=True)
    return (min(across), min(up)), (max(across), max(up))
