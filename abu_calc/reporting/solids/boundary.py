"""Boundary of a solid of revolution as entities of a STEP file: planes, cylinders, cones, spheres and tori.

Each edge of the profile sweeps one face. Planes are whole rings; other surfaces are cut in two along the half planes
at 0° and 180°, so that no face closes on itself and every edge has two ends. A corner on the axis is one vertex; an
edge on the axis sweeps nothing.
"""

import math
from typing import Final

from abu_calc.reporting.solids.assembly import SAME, ProfileCorner, RevolvedSolid, arc_of
from abu_calc.reporting.solids.entities import DERIVED, Entity, EntityFile

HALVES: Final = (1.0, -1.0)
"""Cosines of the half planes at 0° and 180°."""


def solid_entity(file: EntityFile, solid: RevolvedSolid) -> Entity:
    """Write a solid and return its MANIFOLD_SOLID_BREP."""
    boundary = _Boundary(file, solid)
    faces = tuple(face for index in range(len(solid.profile)) for face in boundary.faces(index))
    return file.own("MANIFOLD_SOLID_BREP", solid.name, file.own("CLOSED_SHELL", solid.name, faces))


def placement(file: EntityFile, at: tuple[float, float, float], axis: tuple[float, float, float],
              across: tuple[float, float, float]) -> Entity:  # fmt: skip
    """An axis through a point, and a direction across it."""
    return file.add("AXIS2_PLACEMENT_3D", "", _point(file, at), _direction(file, axis), _direction(file, across))


def _point(file: EntityFile, at: tuple[float, ...]) -> Entity:
    return file.add("CARTESIAN_POINT", "", tuple(map(float, at)))


def _direction(file: EntityFile, along: tuple[float, ...]) -> Entity:
    size = math.hypot(*along)
    return file.add("DIRECTION", "", tuple(part / size for part in along))


class _Boundary:
    """Vertices, edges and faces of one solid; its axis is z."""

    def __init__(self, file: EntityFile, solid: RevolvedSolid) -> None:
        self.file, self.solid = file, solid
        self.corners = solid.profile
        self.known: dict[int, tuple[Entity, Entity]] = {}
        self.circles = [self._circle_pair(index) for index in range(len(self.corners))]

    def faces(self, index: int) -> tuple[Entity, ...]:
        """Faces that an edge of the profile sweeps."""
        here, there = self.solid.edges[index]
        if max(here[1], there[1]) < SAME and not here[2]:
            return ()
        if not here[2] and abs(here[0] - there[0]) < SAME:
            return (self._ring(index),)
        surface, same = self._surface(here, there)
        meridians = self._meridians(index)
        return tuple(self._half(index, half, meridians, surface, same) for half in (0, 1))

    def _next(self, index: int) -> int:
        return (index + 1) % len(self.corners)

    def _vertices(self, index: int) -> tuple[Entity, Entity]:
        """Vertices of a corner at 0° and 180°; one for both on the axis. They are written where an edge needs them."""
        if index not in self.known:
            self.known[index] = self._vertex_pair(*self.corners[index][:2])
        return self.known[index]

    def _vertex_pair(self, x: float, r: float) -> tuple[Entity, Entity]:
        if r < SAME:
            pole = self.file.own("VERTEX_POINT", "", _point(self.file, (0.0, 0.0, x)))
            return pole, pole
        first, second = (self.file.own("VERTEX_POINT", "", _point(self.file, (side * r, 0.0, x))) for side in HALVES)
        return first, second

    def _circle_pair(self, index: int) -> tuple[Entity, Entity] | None:
        """Half circles of a corner from 0° to 180°, and on to 360°; none on the axis."""
        x, r, _ = self.corners[index]
        if r < SAME:
            return None
        circle = self.file.add("CIRCLE", "", placement(self.file, (0.0, 0.0, x), (0, 0, 1), (1, 0, 0)), float(r))
        first, second = self._vertices(index)
        return (self.file.own("EDGE_CURVE", "", first, second, circle, True),
                self.file.own("EDGE_CURVE", "", second, first, circle, True))  # fmt: skip

    def _meridians(self, index: int) -> tuple[Entity, Entity]:
        """The profile's edge itself at 0° and 180°."""
        first, second = (self._meridian(index, half) for half in (0, 1))
        return first, second

    def _meridian(self, index: int, half: int) -> Entity:
        (x, r, bulge), there = self.solid.edges[index]
        side = HALVES[half]
        start, end = self._vertices(index)[half], self._vertices(self._next(index))[half]
        if bulge:
            (cx, cr), radius, _, _ = arc_of((x, r, bulge), there)
            # Counter-clockwise with x to the right and r up is a turn about the circumference's direction.
            about = (0.0, math.copysign(side, side * bulge), 0.0)
            at = placement(self.file, (side * cr, 0.0, cx), about, (side * (r - cr), 0.0, x - cx))
            curve = self.file.add("CIRCLE", "", at, float(radius))
        else:
            along = _direction(self.file, (side * (there[1] - r), 0.0, there[0] - x))
            vector = self.file.add("VECTOR", "", along, 1.0)
            curve = self.file.add("LINE", "", _point(self.file, (side * r, 0.0, x)), vector)
        return self.file.own("EDGE_CURVE", "", start, end, curve, True)

    def _surface(self, here: ProfileCorner, there: ProfileCorner) -> tuple[Entity, bool]:
        """The surface that an edge sweeps, and whether its own normal points out of the solid."""
        if here[2]:
            return self._turned_arc(here, there)
        # The solid lies left of the edge, so out of it is (dr, -dx): away from the axis if the edge runs back.
        outward = there[0] < here[0]
        if abs(here[1] - there[1]) < SAME:
            at = placement(self.file, (0.0, 0.0, here[0]), (0, 0, 1), (1, 0, 0))
            return self.file.add("CYLINDRICAL_SURFACE", "", at, float(here[1])), outward
        low, high = sorted((here, there), key=lambda corner: corner[1])
        along = math.copysign(1.0, high[0] - low[0])
        at = placement(self.file, (0.0, 0.0, low[0]), (0, 0, along), (1, 0, 0))
        angle = math.atan2(high[1] - low[1], abs(high[0] - low[0]))
        return self.file.add("CONICAL_SURFACE", "", at, float(max(low[1], 0.0)), angle), outward

    def _turned_arc(self, here: ProfileCorner, there: ProfileCorner) -> tuple[Entity, bool]:
        """A sphere if the arc's centre lies on the axis; else a torus, of which only the outer part may be used."""
        (x, r), radius, _, _ = arc_of(here, there)
        at = placement(self.file, (0.0, 0.0, x), (0, 0, 1), (1, 0, 0))
        # The centre of a counter-clockwise arc lies on the solid's side.
        outward = here[2] > 0
        if abs(r) < SAME:
            return self.file.add("SPHERICAL_SURFACE", "", at, float(radius)), outward
        if r < 0:
            raise ValueError(f"{self.solid.name}: an arc has its centre below the axis")
        if radius > r:
            return self.file.add("DEGENERATE_TOROIDAL_SURFACE", "", at, float(r), float(radius), True), outward
        return self.file.add("TOROIDAL_SURFACE", "", at, float(r), float(radius)), outward

    def _half(self, index: int, half: int, meridians: tuple[Entity, Entity], surface: Entity, same: bool) -> Entity:
        """Face over one half turn: along the edge, round at its end, back on the other half plane, round again."""
        ends = self.circles[self._next(index)], self.circles[index]
        loop = [(meridians[half], True)]
        if ends[0] is not None:
            loop.append((ends[0][half], True))
        loop.append((meridians[1 - half], False))
        if ends[1] is not None:
            loop.append((ends[1][half], False))
        bound = self.file.own("FACE_OUTER_BOUND", "", self._loop(loop), True)
        return self.file.own("ADVANCED_FACE", "", (bound,), surface, same)

    def _ring(self, index: int) -> Entity:
        """A plane face between two circles, or inside one."""
        (x, r, _), (_, r2, _) = self.solid.edges[index]
        last = self._next(index)
        bounds = list[tuple[float, Entity]]()
        circles = self.circles[last], self.circles[index]
        if circles[0] is not None:
            bounds.append((r2, self._loop([(circles[0][0], True), (circles[0][1], True)])))
        if circles[1] is not None:
            bounds.append((r, self._loop([(circles[1][1], False), (circles[1][0], False)])))
        bounds.sort(key=lambda bound: -bound[0])
        kinds = ("FACE_OUTER_BOUND", "FACE_BOUND")
        entities = tuple(self.file.own(kind, "", loop, True) for kind, (_, loop) in zip(kinds, bounds, strict=False))
        at = placement(self.file, (0.0, 0.0, x), (0, 0, math.copysign(1.0, r2 - r)), (1, 0, 0))
        return self.file.own("ADVANCED_FACE", "", entities, self.file.add("PLANE", "", at), True)

    def _loop(self, edges: list[tuple[Entity, bool]]) -> Entity:
        oriented = tuple(self.file.own("ORIENTED_EDGE", "", DERIVED, DERIVED, edge, same) for edge, same in edges)
        return self.file.own("EDGE_LOOP", "", oriented)
