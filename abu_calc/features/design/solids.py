"""Parts and balls of a design as solids: the assembly that CAD programs open."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from abu_calc.reporting.drawings.shapes import plain
from abu_calc.reporting.solids.assembly import (
    PlacedSolid,
    RevolvedSolid,
    SolidAssembly,
    ball_profile,
    cylinder_profile,
)
from abu_calc.sizing.parts.housing_parts import MATERIALS
from abu_calc.standards.balls import material

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult


def size_solids(result: "SizeResult") -> SolidAssembly:
    """Body, race ring if there is one, cover, and the balls evenly round the race, each touching its bottom.

    The axis is z; the closed web's face lies at z = 0. The first ball lies on x.
    """
    return SolidAssembly(
        "autobalancer", f"Autobalancer of {plain(result.title)}, lengths in mm", tuple(design_items(result))
    )


def design_items(result: "SizeResult") -> Iterator[PlacedSolid]:
    """Parts and balls of one autobalancer."""
    densities = {name: density for density, name in MATERIALS.items()}
    parts = tuple(
        RevolvedSolid(part.name, part.outline_mm, part.material, densities[part.material])
        for part in result.section.parts
    )
    yield from (PlacedSolid(part.name, part) for part in parts)
    yield from _balls(result)


def _balls(result: "SizeResult") -> tuple[PlacedSolid, ...]:
    """Balls, or rollers as long as they are thick."""
    abu = result.autobalancer
    size, pitch, middle = abu.ball_diameter_mm, abu.pitch_radius_mm, abu.width_mm / 2
    profile = ball_profile(size) if abu.corrector == "ball" else cylinder_profile(size, size)
    solid = RevolvedSolid(abu.corrector, profile, abu.ball_material, material(abu.ball_material).density)
    turns = (math.tau * number / abu.ball_count for number in range(abu.ball_count))
    return tuple(
        PlacedSolid(f"{abu.corrector} {number}", solid, (pitch * math.cos(turn), pitch * math.sin(turn), middle))
        for number, turn in enumerate(turns, 1)
    )
