"""Dimensions of a turned part: each size of its profile once, none from a chain of others.

Lengths are in mm, along the axis from the part's left face. A size that follows from others is a reference and stands
in brackets.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.frozen import dataclass
from abu_calc.reporting.drawings.shapes import digits, toleranced
from abu_calc.sizing.parts.housing_parts import Surface, TurnedPart, drawn

FROM_RIGHT: Final = 0.7
"""Places beyond this share of the length are measured from the right face."""
LABELS: Final = {"race": "race", "cover seat": "seat"}
"""Names of surfaces that stand before their diameters, which may be alike."""
SAME: Final = 1e-6
"""Places closer than this [mm] are one."""


class Edge(NamedTuple):
    """An edge of a profile [mm]: both ends, the name of its surface, its bulge, centre and radius if it is an arc."""

    start: tuple[float, float]
    end: tuple[float, float]
    surface: str
    bulge: float
    centre: tuple[float, float] | None
    radius: float


class Diameter(NamedTuple):
    """A diameter at a place along the axis, as it is written, and the side of the view where its line stands."""

    value: float
    x: float
    text: str
    below: str
    side: Literal["left", "right"]
    reference: bool
    surface: str


class AxialLength(NamedTuple):
    """A length between two places along the axis, as it is written."""

    start: float
    end: float
    text: str


@dataclass(frozen=True)
class DimensionPlan:
    """All dimensions of a part; `radii`: radius, text and edge of each arc."""

    edges: tuple[Edge, ...]
    length: float
    diameters: tuple[Diameter, ...]
    lengths: tuple[AxialLength, ...]
    radii: tuple[tuple[float, str, Edge], ...]


def dimension_plan(part: TurnedPart) -> DimensionPlan:
    """Dimensions of a part: a diameter for each radius, a length for each place, a radius for each arc."""
    edges = part_edges(part)
    length = max(edge.start[0] for edge in edges)
    arcs = tuple(edge for edge in edges if edge.centre is not None and not _sphere(edge))
    return DimensionPlan(
        edges, length, tuple(_diameters(part, edges, length)), tuple(_lengths(part, edges, length)),
        tuple((edge.radius, _groove_text(part.surface(edge.surface), edge), edge) for edge in arcs),
    )  # fmt: skip


def part_edges(part: TurnedPart) -> tuple[Edge, ...]:
    """Edges of a part [mm], its left face at 0."""
    origin = min(segment.start.z for segment in part.profile)

    def place(z: float, r: float) -> tuple[float, float]:
        return drawn(z - origin), drawn(r)

    return tuple(
        Edge(
            place(*each.start), place(*each.end), each.surface, 0.0 if each.straight else each.bulge,
            None if each.straight else place(*each.centre), 0.0 if each.straight else drawn(each.radius),
        )
        for each in part.profile
    )  # fmt: skip


def _sphere(edge: Edge) -> bool:
    """Whether an arc is centred on the axis: its diameter says its radius, too."""
    return edge.centre is not None and abs(edge.centre[1]) < SAME


def size_text(value: float, toleranced: bool) -> str:
    """A size: three decimals only if it has a tolerance of its own.

    >>> size_text(18.4753, True), size_text(18.4753, False)
    ('18.475', '18.48')
    """
    return digits(value, 3 if toleranced else 2)


def limits_text(surface: Surface) -> str:
    """Limit deviations [mm] as a drawing writes them; nothing where they are not tabulated."""
    if surface.limits is None:
        return ""
    low, high = (round(drawn(limit), 4) for limit in surface.limits)
    return f"({_signed(high)} / {_signed(low)})"


def _signed(value: float) -> str:
    return f"{value:+.3f}" if value else "0"


def diameter_text(value: float, surface: Surface | None) -> tuple[str, str]:
    """A diameter with its class or tolerance, and the limits that stand below it."""
    if surface is None:
        return f"Ø{size_text(value, False)}", ""
    if surface.thread:
        return surface.thread, ""
    if surface.tolerance_class:
        return f"Ø{size_text(value, True)} {surface.tolerance_class}", limits_text(surface)
    if surface.limits is not None:
        return f"Ø{size_text(value, True)}", limits_text(surface)
    if surface.plus_minus is not None:
        return f"Ø{toleranced(value, drawn(surface.plus_minus))}", ""
    return f"Ø{size_text(value, False)}", ""


def _groove_text(surface: Surface | None, edge: Edge) -> str:
    """Radius of an arc, with its tolerance."""
    allowed = None if surface is None else surface.groove_plus_minus
    if allowed is None:
        return f"R{size_text(edge.radius, False)}"
    return f"R{toleranced(edge.radius, drawn(allowed))}"


def _diameters(part: TurnedPart, edges: tuple[Edge, ...], length: float) -> Iterator[Diameter]:
    """Each distinct radius once; ends of an arc are references, its bottom is the dimension."""
    own = dict[tuple[float, str], list[Edge]]()
    for edge in edges:
        if edge.centre is None and abs(edge.start[1] - edge.end[1]) < SAME and edge.start[1] > SAME:
            own.setdefault((round(edge.start[1], 6), _size_demand(part, edge)), []).append(edge)
    known = [radius for radius, _ in own]
    for (radius, demand), along in own.items():
        if not demand and known.count(radius) > 1:
            continue  # another stretch of this diameter has the demand
        text, below = diameter_text(2 * along[0].start[1], part.surface(along[0].surface))
        if along[0].surface in LABELS and part.surface("race"):
            text = f"{LABELS[along[0].surface]} {text}"
        yield Diameter(2 * along[0].start[1], *_witness(along, length, text, below, along[0].surface))
    for edge in (edge for edge in edges if edge.centre is not None):
        assert edge.centre is not None
        bottom = edge.centre[1] + (edge.radius if edge.start[1] > edge.centre[1] else -edge.radius)
        text, below = diameter_text(2 * bottom, part.surface(edge.surface))
        text = f"{LABELS['race']} {'S' if _sphere(edge) else ''}{text}"
        yield Diameter(2 * bottom, edge.centre[0], text, below, "right", False, edge.surface)
        for x, radius in dict.fromkeys((edge.start, edge.end)):
            if all(abs(radius - other) > SAME for other in known):
                known.append(radius)
                yield Diameter(2 * radius, x, f"(Ø{size_text(2 * radius, False)})", "", "right", True, edge.surface)
    for before, after in pairwise((*edges, edges[0])):
        # A corner between faces and cones only.
        radius = before.end[1]
        if (
            radius > SAME
            and before.centre is None
            and after.centre is None
            and all(abs(radius - other) > SAME for other in known)
        ):
            known.append(radius)
            yield Diameter(2 * radius, before.end[0], f"Ø{size_text(2 * radius, False)}", "",
                           "left" if before.end[0] < length / 2 else "right", False, before.surface)  # fmt: skip


def _size_demand(part: TurnedPart, edge: Edge) -> str:
    """What is asked of the size of an edge's surface; nothing: the general tolerance."""
    surface = part.surface(edge.surface)
    if surface is None:
        return ""
    words = surface.thread, surface.tolerance_class, surface.limits, surface.plus_minus
    return " ".join(str(word) for word in words if word)


def _witness(
    along: list[Edge], length: float, text: str, below: str, surface: str
) -> tuple[float, str, str, Literal["left", "right"], bool, str]:
    """Place of a diameter's extension line: the face it reaches, the left one first."""
    places = [x for edge in along for x in (edge.start[0], edge.end[0])]
    if min(places) < SAME:
        return 0.0, text, below, "left", False, surface
    right = max(places) > length - SAME or (min(places) + max(places)) / 2 > length / 2
    return (max(places), text, below, "right", False, surface) if right else (
        min(places), text, below, "left", False, surface)  # fmt: skip


def _lengths(part: TurnedPart, edges: tuple[Edge, ...], length: float) -> Iterator[AxialLength]:
    """Each place once, from the nearer face; the middle of a groove from the left one, toleranced.

    Limits of the depth in which another part is seated, and of that part's thickness, keep it from standing out.
    """
    floor = _seat_floor(part, edges)
    yield AxialLength(0.0, length, f"{size_text(length, False)}{UNDER if _seated(part) else ''}")
    places = list[float]()
    for edge in edges:
        if all(abs(edge.start[0] - other) > SAME for other in (0.0, length, *places)):
            places.append(edge.start[0])
    for x in sorted(places):
        if floor is not None and abs(x - floor) < SAME:
            yield AxialLength(x, length, f"{size_text(length - x, False)}{OVER}")
        elif x > FROM_RIGHT * length:
            yield AxialLength(x, length, size_text(length - x, False))
        else:
            yield AxialLength(0.0, x, size_text(x, False))
    for edge in (edge for edge in edges if edge.centre is not None):
        assert edge.centre is not None
        middle = edge.centre[0]
        if all(abs(middle - other) > SAME for other in (0.0, length, *places)):
            places.append(middle)
            yield AxialLength(0.0, middle, toleranced(middle, GROOVE_PLACE))


def _seat_floor(part: TurnedPart, edges: tuple[Edge, ...]) -> float | None:
    """Place of the stop from which ring and cover reach to the open face; none where nothing is seated."""
    for name in ("ring seat", "cover seat"):
        seat = [x for edge in edges if edge.surface == name for x in (edge.start[0], edge.end[0])]
        if seat and part.name != "cover":
            return min(seat)
    return None


def _seated(part: TurnedPart) -> bool:
    """Whether a part that is made lies in the depth of another; a bearing's ring has limits of its own."""
    race = part.surface("race")
    return part.name == "cover" or (part.name == "race ring" and (race is None or race.kind != "sphere"))


UNDER: Final = " 0/-0.1"
OVER: Final = " +0.1/0"
"""Limits of a cover's thickness and of the depth of its seat [mm] (assumed)."""
GROOVE_PLACE: Final = 0.05
"""Tolerance of the groove's middle along the axis [mm]: the balls run in one plane, free of web and cover."""
