"""An assembly of solids as a STEP file: ISO 10303-21 text after AP214 (automotive design), lengths in mm.

The text follows from the assembly alone: equal assemblies give equal files. Its time is that of SOURCE_DATE_EPOCH, or
1970-01-01 if the environment has none; it names no file, folder, user or computer.

Entities of an exchange file after ISO 10303-21: numbered, each written once, values in the format's own spelling.

Boundary of a solid of revolution as entities of a STEP file: planes, cylinders, cones, spheres and tori.

Each edge of the profile sweeps one face. Planes are whole rings; other surfaces are cut in two along the half planes
at 0° and 180°, so that no face closes on itself and every edge has two ends. A corner on the axis is one vertex; an
edge on the axis sweeps nothing.
"""

import datetime
import math
import os
from collections.abc import Iterable
from typing import Final

from abu_calc.reporting.solids.assembly import SAME, PlacedSolid, ProfileCorner, RevolvedSolid, SolidAssembly, arc_of
from abu_calc.version import __version__

Value = "str | float | int | bool | None | Entity | Enumeration | tuple[Value, ...]"


class Entity(int):
    """Number of an entity that was written."""


class Enumeration(str):
    """A value that is written between dots, or a typed value that is written as it stands."""

    __slots__ = ()


DERIVED = Enumeration("*")
"""A value that follows from others."""


class EntityFile:
    """Entities in the order in which they were added; an entity equal to an earlier one is that one."""

    def __init__(self) -> None:
        self._lines: list[str] = []
        self._known: dict[str, Entity] = {}

    def add(self, keyword: str, *values: object) -> Entity:
        """Add an entity unless it is there, and return its number."""
        return self._numbered(f"{keyword}({','.join(map(spelled, values))})")

    def add_complex(self, *parts: tuple[str, tuple[object, ...]]) -> Entity:
        """Add an entity of several types, which the format wants in alphabetical order."""
        body = "".join(f"{keyword}({','.join(map(spelled, values))})" for keyword, values in sorted(parts))
        return self._numbered(f"({body})")

    def own(self, keyword: str, *values: object) -> Entity:
        """Add an entity even if an equal one is there: products and their uses are things, not values."""
        self._lines.append(f"{keyword}({','.join(map(spelled, values))})")
        return Entity(len(self._lines))

    def _numbered(self, line: str) -> Entity:
        if line not in self._known:
            self._lines.append(line)
            self._known[line] = Entity(len(self._lines))
        return self._known[line]

    def lines(self) -> Iterable[str]:
        """Lines of the data section."""
        return (f"#{number}={line};" for number, line in enumerate(self._lines, 1))


def spelled(value: object) -> str:
    """A value as the format writes it.

    >>> spelled(("Ø5", 2.0, None, True, Entity(7), 3))
    "('\\\\X2\\\\00D8\\\\X0\\\\5',2.,$,.T.,#7,3)"
    """
    match value:
        case Entity():
            return f"#{int(value)}"
        case Enumeration():
            return str(value)
        case None:
            return "$"
        case bool():
            return ".T." if value else ".F."
        case int():
            return str(value)
        case float():
            return _real(value)
        case str():
            return f"'{written_string(value)}'"
        case tuple() | list():
            return f"({','.join(map(spelled, value))})"
    raise TypeError(f"no value of an exchange file: {value!r}")


def _real(value: float) -> str:
    """A real number: a point always, a capital E.

    >>> _real(-0.0), _real(1e-7), _real(31.0), _real(15.875)
    ('0.', '1.E-07', '31.', '15.875')
    """
    if not math.isfinite(value):
        raise ValueError("an exchange file holds finite numbers only")
    mantissa, mark, exponent = repr(value + 0.0).partition("e")
    mantissa = mantissa.removesuffix("0") if mantissa.endswith(".0") else mantissa
    return f"{mantissa if '.' in mantissa else mantissa + '.'}{'E' if mark else ''}{exponent}"


def written_string(text: str) -> str:
    """A text by the format's alphabet: apostrophe and all beyond ASCII by code, backslash doubled, no control signs.

    >>> print(written_string("d'Ø\\n") + "|")
    d\\X\\27\\X2\\00D8\\X0\\ |
    """
    pieces, codes = list[str](), ""

    def flush() -> None:
        nonlocal codes
        if codes:
            wide = "4" if len(codes) > 0 and any(len(code) > 4 for code in codes.split()) else "2"
            size = 8 if wide == "4" else 4
            pieces.append(f"\\X{wide}\\" + "".join(code.rjust(size, "0") for code in codes.split()) + "\\X0\\")
            codes = ""

    for sign in text:
        if " " <= sign <= "~":
            flush()
            pieces.append({"'": "\\X\\27", "\\": "\\\\"}.get(sign, sign))
        elif sign.isprintable():
            codes += f" {ord(sign):04X}"
        else:
            flush()
            pieces.append(" ")
    flush()
    return "".join(pieces)


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


SCHEMA: Final = "AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }"
COLOURS: Final = {"steel": (0.62, 0.65, 0.68), "aluminium": (0.82, 0.84, 0.86), "ball": (0.45, 0.55, 0.75)}
"""Red, green and blue of what is made of a material; balls stand out."""
ACCURACY: Final = 1e-7
"""Lengths [mm] that the file calls equal."""


def step_text(assembly: SolidAssembly) -> str:
    """Text of the STEP file of an assembly."""
    file = EntityFile()
    _Structure(file).write(assembly)
    return "".join(f"{line}\n" for line in (
        "ISO-10303-21;", "HEADER;",
        f"FILE_DESCRIPTION({spelled((assembly.description,))},'2;1');",
        f"FILE_NAME({spelled(assembly.name)},{spelled(_time())},(''),(''),"
        f"{spelled(f'abu-calc {__version__}')},{spelled(f'abu-calc {__version__}')},'');",
        f"FILE_SCHEMA({spelled((SCHEMA,))});",
        "ENDSEC;", "DATA;", *file.lines(), "ENDSEC;", "END-ISO-10303-21;",
    ))  # fmt: skip


def _time() -> str:
    """SOURCE_DATE_EPOCH as a time of the format; the epoch itself if there is none or it is no number."""
    given = os.environ.get("SOURCE_DATE_EPOCH", "")
    seconds = int(given) if given.isascii() and given.isdigit() and len(given) < 12 else 0
    return datetime.datetime.fromtimestamp(seconds, datetime.UTC).strftime("%Y-%m-%dT%H:%M:%S")


class _Structure:
    """Products, their shapes, and how they stand in the assembly."""

    def __init__(self, file: EntityFile) -> None:
        self.file = file
        self.application = file.add("APPLICATION_CONTEXT", "core data for automotive mechanical design processes")
        file.add("APPLICATION_PROTOCOL_DEFINITION", "international standard", "automotive_design", 2000,
                 self.application)  # fmt: skip
        self.context = self._units()
        self.origin = placement(file, (0.0, 0.0, 0.0), (0, 0, 1), (1, 0, 0))

    def write(self, assembly: SolidAssembly) -> None:
        """Write every solid once, then each item as a use of it."""
        parts = {solid: self._part(solid) for solid in assembly.solids}
        whole = self._product(assembly.name, assembly.description)
        places = tuple(placement(self.file, item.shift, (0, 0, 1), (1, 0, 0)) for item in assembly.items)
        items = tuple(dict.fromkeys((self.origin, *places)))
        shape = self.file.own("SHAPE_REPRESENTATION", assembly.name, items, self.context)
        self._defines(whole, shape)
        for number, (item, place) in enumerate(zip(assembly.items, places, strict=True), 1):
            self._use(number, item, whole, shape, parts[item.solid], place)

    def _units(self) -> Entity:
        """Context of all shapes: mm, rad, sr, and the accuracy."""
        add, derived = self.file.add_complex, (DERIVED,)
        length = add(("LENGTH_UNIT", ()), ("NAMED_UNIT", derived),
                     ("SI_UNIT", (Enumeration(".MILLI."), Enumeration(".METRE."))))  # fmt: skip
        angle = add(("NAMED_UNIT", derived), ("PLANE_ANGLE_UNIT", ()), ("SI_UNIT", (None, Enumeration(".RADIAN."))))
        solid = add(("NAMED_UNIT", derived), ("SI_UNIT", (None, Enumeration(".STERADIAN."))), ("SOLID_ANGLE_UNIT", ()))
        self.length = length
        equal = self.file.add("UNCERTAINTY_MEASURE_WITH_UNIT", Enumeration(f"LENGTH_MEASURE({spelled(ACCURACY)})"),
                              length, "distance_accuracy_value", "lengths that are equal")  # fmt: skip
        return add(("GEOMETRIC_REPRESENTATION_CONTEXT", (3,)), ("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT", ((equal,),)),
                   ("GLOBAL_UNIT_ASSIGNED_CONTEXT", ((length, angle, solid),)),
                   ("REPRESENTATION_CONTEXT", ("", "3D")))  # fmt: skip

    def _product(self, name: str, description: str) -> Entity:
        """A product by name, and its definition."""
        own = self.file.own
        context = self.file.add("PRODUCT_CONTEXT", "", self.application, "mechanical")
        product = own("PRODUCT", name, name, description, (context,))
        own("PRODUCT_RELATED_PRODUCT_CATEGORY", "part", None, (product,))
        formation = own("PRODUCT_DEFINITION_FORMATION", "", "", product)
        stage = self.file.add("PRODUCT_DEFINITION_CONTEXT", "part definition", self.application, "design")
        return own("PRODUCT_DEFINITION", "design", "", formation, stage)

    def _defines(self, definition: Entity, shape: Entity) -> None:
        held = self.file.own("PRODUCT_DEFINITION_SHAPE", "", "", definition)
        self.file.own("SHAPE_DEFINITION_REPRESENTATION", held, shape)

    def _part(self, solid: RevolvedSolid) -> tuple[Entity, Entity]:
        """A solid as a product of its own: its definition and its shape."""
        definition = self._product(solid.name, solid.material)
        brep = solid_entity(self.file, solid)
        shape = self.file.own("ADVANCED_BREP_SHAPE_REPRESENTATION", solid.name, (self.origin, brep), self.context)
        self._defines(definition, shape)
        self._coloured(solid, brep)
        self._of_material(solid, definition)
        return definition, shape

    def _coloured(self, solid: RevolvedSolid, brep: Entity) -> None:
        add = self.file.add
        kind = "ball" if "ball" in solid.name or "roller" in solid.name else solid.material.split()[-1]
        colour = add("COLOUR_RGB", "", *COLOURS.get(kind, COLOURS["steel"]))
        filled = add("FILL_AREA_STYLE", "", (add("FILL_AREA_STYLE_COLOUR", "", colour),))
        side = add("SURFACE_SIDE_STYLE", "", (add("SURFACE_STYLE_FILL_AREA", filled),))
        style = add("PRESENTATION_STYLE_ASSIGNMENT", (add("SURFACE_STYLE_USAGE", Enumeration(".BOTH."), side),))
        styled = self.file.own("STYLED_ITEM", "colour", (style,), brep)
        self.file.own("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION", "", (styled,), self.context)

    def _of_material(self, solid: RevolvedSolid, definition: Entity) -> None:
        """Material in words, and its density in kg/m³."""
        own = self.file.own
        word = own("DESCRIPTIVE_REPRESENTATION_ITEM", solid.material, solid.material)
        self._property(definition, "material name", word)
        add = self.file.add_complex
        kilogram = add(("MASS_UNIT", ()), ("NAMED_UNIT", (DERIVED,)),
                       ("SI_UNIT", (Enumeration(".KILO."), Enumeration(".GRAM."))))  # fmt: skip
        metre = add(("LENGTH_UNIT", ()), ("NAMED_UNIT", (DERIVED,)), ("SI_UNIT", (None, Enumeration(".METRE."))))
        unit = self.file.add("DERIVED_UNIT", (self.file.add("DERIVED_UNIT_ELEMENT", kilogram, 1.0),
                                              self.file.add("DERIVED_UNIT_ELEMENT", metre, -3.0)))  # fmt: skip
        density = self.file.own("MEASURE_REPRESENTATION_ITEM", "density measure",
                                Enumeration(f"POSITIVE_RATIO_MEASURE({spelled(solid.density)})"), unit)  # fmt: skip
        self._property(definition, "density", density)

    def _property(self, definition: Entity, name: str, item: Entity) -> None:
        held = self.file.own("PROPERTY_DEFINITION", "material property", name, definition)
        shown = self.file.own("REPRESENTATION", name, (item,), self.context)
        self.file.own("PROPERTY_DEFINITION_REPRESENTATION", held, shown)

    def _use(self, number: int, item: PlacedSolid, whole: Entity, shape: Entity, part: tuple[Entity, Entity],
             place: Entity) -> None:  # fmt: skip
        """One item: the use of a part in the whole, and the place of its shape."""
        own = self.file.own
        use = own("NEXT_ASSEMBLY_USAGE_OCCURRENCE", str(number), item.name, item.name, whole, part[0], None)
        held = own("PRODUCT_DEFINITION_SHAPE", "Placement", f"Placement of {item.name}", use)
        turned = own("ITEM_DEFINED_TRANSFORMATION", "", "", self.origin, place)
        related = self.file.add_complex(
            ("REPRESENTATION_RELATIONSHIP", ("", "", part[1], shape)),
            ("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION", (turned,)),
            ("SHAPE_REPRESENTATION_RELATIONSHIP", ()),
        )
        own("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION", related, held)
