"""The section of a sized autobalancer as results hold it: every length that its drawing shows, and the outlines."""

from typing import TYPE_CHECKING, Annotated, Self

from abu_calc.sizing.drawing import (
    BORE,
    CASE_DEPTH,
    GROOVE_TOLERANCE,
    HARDNESS,
    OVALITY,
    RACE_TOLERANCE,
    ROUGHNESS,
    bore_limits,
)
from abu_calc.sizing.section import section
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.sizing.design import Design
    from abu_calc.sizing.section import Part


@record
class SectionPart(Record):
    """One part of the housing.

    `outline_mm`: half section, counter-clockwise, of each corner the place along the axis from the closed web's face,
    the distance from the axis, and the bulge of the edge that leaves it (tangent of a quarter of its arc).
    """

    name: Annotated[str, Quantity("part")]
    material: Annotated[str, Quantity("material")]
    mass_g: Annotated[float, Quantity("mass")]
    section_area_mm2: Annotated[float, Quantity("area of the half section")]
    outline_mm: Annotated[tuple[tuple[float, float, float], ...], Quantity("outline of the half section")]

    @classmethod
    def of(cls, part: "Part") -> Self:
        """Record in user units."""
        return cls(
            name=part.name,
            material=part.material,
            mass_g=from_si(part.mass, "g"),
            section_area_mm2=1e6 * part.area,
            outline_mm=tuple((_mm(v.x), _mm(v.r), v.bulge) for v in part.outline),
        )


@record
class Section(Record):
    """Lengths, tolerances and parts of the housing, as its drawing shows them; requirements are assumed practice."""

    design: Annotated[str, Quantity("kind of housing")]
    bore_diameter_mm: Annotated[float, Quantity("bore", "", 5)]
    bore_class: Annotated[str, Quantity("tolerance class of the bore")]
    bore_limits_um: Annotated[tuple[float, float] | None, Quantity("limits of the bore")]
    hub_diameter_mm: Annotated[float, Quantity("hub", "", 5)]
    race_diameter_mm: Annotated[float, Quantity("race", "2R", 5)]
    race_tolerance_mm: Annotated[float, Quantity("tolerance of the race's radius", "±")]
    shoulder_diameter_mm: Annotated[float, Quantity("race at the webs", "", 5)]
    groove_tolerance_mm: Annotated[float, Quantity("tolerance of the groove's radius", "±")]
    ring_diameter_mm: Annotated[float, Quantity("outside of the race ring", "", 5)]
    wall_mm: Annotated[float, Quantity("wall outside the race")]
    web_mm: Annotated[float, Quantity("web and cover")]
    inner_width_mm: Annotated[float, Quantity("between web and cover")]
    runout_um: Annotated[float, Quantity("runout race to bore, all in", "TIR")]
    circularity_um: Annotated[float, Quantity("circularity of the race")]
    roughness_Ra_um: Annotated[float, Quantity("roughness of the race", "Ra")]
    hardness: Annotated[str, Quantity("hardness of the race")]
    case_depth_mm: Annotated[float, Quantity("depth of the hard case, at least")]
    parts: tuple[SectionPart, ...]

    @classmethod
    def of(cls, design: "Design") -> Self:
        """Record of a design."""
        cut = section(design.case, design.autobalancer)
        limits = bore_limits(2 * cut.bore_radius)
        return cls(
            design=design.case.autobalancer.design,
            bore_diameter_mm=_mm(2 * cut.bore_radius),
            bore_class=BORE,
            bore_limits_um=None if limits is None else (_um(limits.lower), _um(limits.upper)),
            hub_diameter_mm=_mm(2 * cut.hub_radius),
            race_diameter_mm=_mm(2 * cut.race_radius),
            race_tolerance_mm=_mm(RACE_TOLERANCE),
            shoulder_diameter_mm=_mm(2 * cut.shoulder_radius),
            groove_tolerance_mm=_mm(GROOVE_TOLERANCE),
            ring_diameter_mm=_mm(2 * cut.ring_radius),
            wall_mm=_mm(cut.ring_radius - cut.race_radius),
            web_mm=_mm(cut.web),
            inner_width_mm=_mm(cut.inner_width),
            runout_um=_um(2 * design.case.race_eccentricity),
            circularity_um=_um(OVALITY),
            roughness_Ra_um=_um(ROUGHNESS),
            hardness=HARDNESS,
            case_depth_mm=_mm(CASE_DEPTH),
            parts=tuple(map(SectionPart.of, cut.parts)),
        )


def _mm(length: float) -> float:
    """Millimetres, freed of the rounding of the conversion."""
    return round(from_si(length, "mm"), 9)


def _um(length: float) -> float:
    return round(from_si(length, "um"), 6)
