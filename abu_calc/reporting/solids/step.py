"""An assembly of solids as a STEP file: ISO 10303-21 text after AP214 (automotive design), lengths in mm.

The text follows from the assembly alone: equal assemblies give equal files. Its time is that of SOURCE_DATE_EPOCH, or
1970-01-01 if the environment has none; it names no file, folder, user or computer.
"""

import datetime
import os
from typing import Final

from abu_calc.reporting.solids.assembly import PlacedSolid, RevolvedSolid, SolidAssembly
from abu_calc.reporting.solids.boundary import placement, solid_entity
from abu_calc.reporting.solids.entities import DERIVED, Entity, EntityFile, Enumeration, spelled
from abu_calc.version import __version__

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
