"""Views of a turned part: the section with its dimensions, and the race's corner enlarged."""

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import Final

from abu_calc.features.design.section_drawing import HATCHES, OVERHANG, STACK, STEP, flattened
from abu_calc.features.design.sheets.dimension_plan import Diameter, DimensionPlan, Edge
from abu_calc.foundation.units import from_si
from abu_calc.reporting.drawings.dimensions import RISE, Callout, column, extent, rising_column
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    Arc,
    Length,
    Line,
    Point,
    Region,
    Shape,
    Text,
    digits,
    text_width,
)
from abu_calc.sizing.parts.housing_parts import Surface, TurnedPart, drawn

GAP: Final = 8.0
"""Distance from the last dimension to the callouts, on paper [mm]."""
CUT: Final = 0.35
"""Depth of the detail below the shoulder of the race, as a share of its height above it."""
THIN: Final = 0.7
"""A part whose bore is so large a share of its outside is a ring: its whole section is enlarged."""
MARK: Final = 2.0
"""Distance from the race's corner to the line about it, on paper [mm]."""
NEAR: Final = 1e-5
"""A step [mm] to either side of a place."""
Words = dict[tuple[str, bool], tuple[str, str]]
"""Texts of diameters without room, by surface and whether they are references: text, and what stands below."""
NAMES: Final = {"run-out": "runout"}


def part_section(part: TurnedPart, plan: DimensionPlan, scale: float, detailed: frozenset[str]) -> tuple[Shape, ...]:
    """The section, its axis along y = 0 and its left face at x = 0; `detailed`: surfaces of the detail."""
    unit, outer = 1 / scale, max(edge.start[1] for edge in plan.edges)
    mark = tuple(detail_mark(plan, scale)) if detailed else ()
    highest = extent(mark, scale)[1][1] if mark else outer
    shapes = [
        *_cut(part.name, plan.edges),
        *_behind(plan.edges),
        Line("centre", (-OVERHANG * unit, 0), (plan.length + OVERHANG * unit, 0)),
        *_lengths(plan, outer, max(highest - outer, 0.0), unit),
        *mark,
    ]
    lines, wordy = _diameter_lines(plan, unit)
    shapes += lines
    (left, _), (right, top) = extent(shapes, scale)
    for side in ("left", "right"):
        own = [each for each in _demands(part, plan.edges, frozenset(), detailed, wordy, _same)
               if (each.tip[0] < plan.length * 0.25) == (side == "left")]  # fmt: skip
        x = left - GAP * unit if side == "left" else right + GAP * unit
        shapes += rising_column(own, x, top, side, scale)
    return tuple(shapes)


def _same(point: Point) -> Point:
    return point


def _cut(name: str, edges: Sequence[Edge]) -> Iterator[Region]:
    """Both halves."""
    angle, spacing = HATCHES[name]
    for side in (1, -1):
        yield Region(tuple((*_mirrored(edge.start, side), side * edge.bulge) for edge in edges), name, angle, spacing)


def _mirrored(point: Point, side: int) -> Point:
    return point[0], side * point[1]


def _behind(edges: Sequence[Edge]) -> Iterator[Line]:
    """Edges behind the plane of the section: from each corner toward the axis, as far as nothing hides them."""
    outline = list(flattened([(*edge.start, edge.bulge) for edge in edges], 48))
    seen = set[tuple[float, float]]()
    for x, r in {edge.start for edge in edges}:
        walls = [wall for place in (x - NEAR, x + NEAR) for wall in _walls(outline, place)]
        if any(low < r - NEAR < high for low, high in walls):
            continue
        floor = max((high for _, high in walls if high < r - NEAR), default=-r)
        if (x, floor) not in seen:
            seen.add((x, floor))
            for side in (1, -1) if floor > 0 else (1,):
                yield Line("outline", (x, side * floor), (x, side * r))


def _walls(outline: Sequence[Point], x: float) -> Iterator[Point]:
    """Material that a line across the axis meets: nearer and farther end of each stretch."""
    crossings = sorted(
        a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
        for a, b in pairwise((*outline, outline[0]))
        if (a[0] <= x) != (b[0] <= x)
    )
    yield from zip(crossings[::2], crossings[1::2], strict=True)


def _lengths(plan: DimensionPlan, outer: float, higher: float, unit: float) -> Iterator[Shape]:
    """Lengths from the left face above, from the right one below; the shortest nearest to the part."""
    above = sorted((each for each in plan.lengths if each.start < 1e-9), key=lambda each: each.end)
    below = sorted((each for each in plan.lengths if each.start >= 1e-9), key=lambda each: -each.start)
    for row, each in enumerate(above):
        start, end = (0.0, _top(plan.edges, 0.0)), (each.end, _top(plan.edges, each.end))
        yield Length(start, end, outer + higher + (STACK + STEP * row) * unit, each.text, beyond="start")
    for row, each in enumerate(below):
        start, end = (each.start, -_top(plan.edges, each.start)), (each.end, -_top(plan.edges, each.end))
        yield Length(start, end, -outer - (STACK + STEP * row) * unit, each.text, beyond="end")


def _top(edges: Sequence[Edge], x: float) -> float:
    """The corner farthest from the axis at a place; at the middle of an arc its bottom."""
    corners = [edge.start[1] for edge in edges if abs(edge.start[0] - x) < 1e-6]
    arcs = [edge.centre[1] + edge.radius for edge in edges if edge.centre and abs(edge.centre[0] - x) < 1e-6]
    return max(corners or arcs)


def _diameter_lines(plan: DimensionPlan, unit: float) -> tuple[list[Shape], Words]:
    """Lines of diameters on both sides, the smallest nearest; texts without room, by their surface."""
    shapes, wordy = list[Shape](), Words()
    for side in ("left", "right"):
        own = sorted((each for each in plan.diameters if each.side == side), key=lambda each: each.value)
        rows, least = 0.0, min(edge.start[1] for edge in plan.edges)
        for each in own:
            text = max(each.text, each.below, key=len)
            # A text stands below the leaders, which start at the bore or farther from the axis.
            if (each.value + least) / 2 / unit < text_width(text, HEIGHT) + RISE:
                wordy[each.surface, each.reference] = each.text, each.below
                continue
            rows += 0.6 if each.below and side == "left" else 0.0
            away = (STACK + STEP * rows) * unit
            rows += 1.6 if each.below and side == "right" else 1.0
            shapes.append(_upright(each, -away if side == "left" else plan.length + away))
    return shapes, wordy


def _upright(each: Diameter, at: float) -> Length:
    half = each.value / 2
    return Length((each.x, -half), (each.x, half), at, each.text, True, below=each.below, along=0.22)


def _demands(
    part: TurnedPart, edges: Sequence[Edge], only: frozenset[str], but: frozenset[str], wordy: Words,
    place: Callable[[Point], Point],
) -> Iterator[Callout]:  # fmt: skip
    """Demands on the surfaces of a view, each at a point of its longest edge; `wordy`: sizes told beside them."""
    for name in dict.fromkeys(edge.surface for edge in edges):
        along = [edge for edge in edges if edge.surface == name]
        if name in but or (only and name not in only):
            continue
        longest = max(along, key=lambda edge: math.dist(edge.start, edge.end))
        surface = part.surface(name)
        tip = place(edge_point(longest, 0.2))
        callout = Callout(tip) if surface is None else surface_callout(surface, tip)
        text, below = wordy.get((name, False), ("cover seat" if only and name == "cover seat" else "", ""))
        callout = callout._replace(text=" ".join(filter(None, (text, callout.text))), below=below)
        if callout.text or callout.rough or callout.frames or callout.datum:
            yield callout


def surface_callout(surface: Surface, tip: Point) -> Callout:
    """Roughness, hardness, form and place of a surface; its size stands with the dimensions."""
    rough = "" if surface.roughness is None else f"Ra {digits(from_si(surface.roughness, 'um'), 2)}"
    frames = tuple(
        tuple(filter(None, (NAMES.get(each.kind, each.kind), digits(drawn(each.value), 4), each.datum)))
        for each in surface.geometrical
    )
    return Callout(tip, surface.hardness, rough, frames, surface.datum)


def edge_point(edge: Edge, share: float) -> Point:
    """A point on an edge, `share` of the way along it."""
    (x, y), (x2, y2) = edge.start, edge.end
    if edge.centre is None:
        return x + share * (x2 - x), y + share * (y2 - y)
    turn = 4 * math.atan(edge.bulge) * share
    dx, dy = x - edge.centre[0], y - edge.centre[1]
    return (edge.centre[0] + dx * math.cos(turn) - dy * math.sin(turn),
            edge.centre[1] + dx * math.sin(turn) + dy * math.cos(turn))  # fmt: skip


def detail_surfaces(edges: Sequence[Edge]) -> frozenset[str]:
    """Surfaces of the race's corner: those about its arc, or about its bore where rollers run."""
    floor = _floor(edges)
    return frozenset(edge.surface for edge in edges if min(edge.start[1], edge.end[1]) > floor)


def _race(edges: Sequence[Edge]) -> Edge | None:
    return next((edge for edge in edges if edge.surface == "race"), None)


def _floor(edges: Sequence[Edge]) -> float:
    race, outer = _race(edges), max(edge.start[1] for edge in edges)
    if race is None:
        return math.inf
    shoulder, least = min(race.start[1], race.end[1]), min(edge.start[1] for edge in edges)
    if least > THIN * outer:
        return least - 1.0
    return max(shoulder - CUT * (outer - shoulder), min(edge.start[1] for edge in edges) - 1.0)


def race_detail(part: TurnedPart, plan: DimensionPlan, scale: float, enlarged: float) -> tuple[Shape, ...]:
    """The race's corner, so many times as large as the section, cut off below by a thin line."""
    race, floor = _race(plan.edges), _floor(plan.edges)
    if race is None:
        return ()
    factor = enlarged / scale

    def place(point: Point) -> Point:
        return point[0] * factor, (point[1] - floor) * factor

    angle, spacing = HATCHES[part.name]
    shapes = list[Shape]()
    outline = list(_above(list(flattened([(*e.start, e.bulge) for e in plan.edges], 48)), floor))
    shapes.append(Region(tuple((*place(point), 0.0) for point in outline), part.name, angle, spacing, outlined=False))
    for here, there in pairwise((*outline, outline[0])):
        cut = abs(here[1] - floor) < 1e-9 and abs(there[1] - floor) < 1e-9
        shapes.append(Line("dimension" if cut else "outline", place(here), place(there)))
    if race.centre is not None:
        x, low = race.centre[0], max(floor, race.centre[1])
        top = max(edge.start[1] for edge in plan.edges)
        shapes.append(Line("centre", place((x, low)), place((x, top + 2 / enlarged))))
    (_, _), (right, high) = extent(shapes, scale)
    told = detail_surfaces(plan.edges)
    wordy = _diameter_lines(plan, 1 / scale)[1]
    callouts = [*_radii(plan, place), *_demands(part, plan.edges, told, frozenset(), wordy, place)]
    left = [each for each in callouts if each.tip[0] < 0.02 * plan.length * factor]
    shapes += column(left, -10 / scale, high, "left", scale)
    shapes += column([each for each in callouts if each not in left], right + 10 / scale, high, "right", scale)
    at = plan.length * factor / 2, high + 5 / scale
    shapes.append(Text(at, f"Z ({_ratio(enlarged)})", 1.4 * HEIGHT, "centre"))
    return tuple(shapes)


def _ratio(scale: float) -> str:
    return f"{digits(scale)}:1" if scale >= 1 else f"1:{digits(1 / scale)}"


def _radii(plan: DimensionPlan, place: Callable[[Point], Point]) -> Iterator[Callout]:
    for _, text, edge in plan.radii:
        yield Callout(place(edge_point(edge, 0.6)), text)


def _above(points: Sequence[Point], floor: float) -> Iterator[Point]:
    """An outline cut off below a height (Sutherland & Hodgman)."""
    for here, there in pairwise((*points, points[0])):
        if here[1] >= floor:
            yield here
        if (here[1] >= floor) != (there[1] >= floor):
            share = (floor - here[1]) / (there[1] - here[1])
            yield here[0] + share * (there[0] - here[0]), floor


def detail_mark(plan: DimensionPlan, scale: float) -> Iterator[Shape]:
    """The line about the race's corner in the upper half, which lies as the detail does, and its letter."""
    race = _race(plan.edges)
    if race is None:
        return
    top, low = max(edge.start[1] for edge in plan.edges), min(race.start[1], race.end[1])
    middle, half = (top + low) / 2, (top - low) / 2
    radius = half + MARK / scale
    inset = math.sqrt(radius**2 - half**2)
    if plan.length <= 2 * inset:
        radius = math.hypot(plan.length / 2, half) + MARK / scale
        yield Arc("dimension", (plan.length / 2, middle), radius)
    else:
        right = plan.length - inset
        yield Arc("dimension", (inset, middle), radius, 90.0, 270.0)
        yield Arc("dimension", (right, middle), radius, 270.0, 450.0)
        for y in (middle + radius, middle - radius):
            yield Line("dimension", (inset, y), (right, y))
    yield Text((plan.length + MARK / scale, middle + radius + 1 / scale), "Z", 1.4 * HEIGHT)
