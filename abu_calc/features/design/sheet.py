"""Drawing sheet of the autobalancer: both views, notes from the drawing table, list of parts, title block.

Parts and balls of a design as solids: the assembly that CAD programs open.
"""

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Final

from abu_calc.features.design.section_drawing import assembly_face, ball_size, balls_text, described, section_view
from abu_calc.features.design.sheets.manufacture import BALL_STEEL, SHOWN, assembly_notes, grade, note_of, race_lines
from abu_calc.features.design.sheets.part_sheet import (
    BINDING,
    BLOCK,
    HIGH,
    MARGIN,
    NOTE_ROW,
    ROW,
    WIDE,
    TitleBlock,
    frame,
    note_lines,
    number,
    on_paper,
    origin,
    part_sheets,
    ratio,
    stamp,
    table,
    title_block,
    written_notes,
)
from abu_calc.features.seats.figures import seats_of
from abu_calc.reporting.drawings.dimensions import extent, moved
from abu_calc.reporting.drawings.shapes import SCALES, Drawing, Point, Shape, digits, plain
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


COLUMNS: Final = (10.0, 42.0, 13.0, 18.0, 78.0, 19.0)
"""Widths of the parts list."""
GAP = 12.0
"""Distance between views, and between views and the frame. All lengths are on paper [mm]."""


def section_sheet(result: "SizeResult") -> Drawing:
    """Section and face on an A3 sheet, in the largest standard scale for which there is room."""
    wide = WIDE - MARGIN - BINDING - BLOCK[0] - 12
    notes = note_lines((*assembly_notes(result), *_notes(result)), wide)
    rows = parts_rows(result)
    below = max(BLOCK[1] + ROW * len(rows), NOTE_ROW * len(notes) + 2 * ROW)
    room = WIDE - MARGIN - BINDING - GAP, HIGH - 2 * MARGIN - below - GAP
    items = {row[1]: row[0] for row in rows[1:]} | {balls_text(result.autobalancer): rows[-1][0]}
    scale, views = _views(result, room, items)
    block = TitleBlock(
        title=f"autobalancer, {result.section.design}", more=result.title, number=number(result, 1), sheet=1,
        sheets=1 + len(result.parts.turned), kind="assembly drawing", material="see parts list",
        mass_g=result.autobalancer.mass_g, scale=ratio(scale), roughness="", **origin(result),
    )  # fmt: skip
    paper = (
        *frame(), *title_block(block), *table(rows, COLUMNS, WIDE - MARGIN - BLOCK[0], MARGIN + BLOCK[1]),
        *written_notes("Requirements (engineering practice, assumed)", notes, BINDING + 4, MARGIN + 3), *stamp(result),
    )  # fmt: skip
    title = f"Section of the autobalancer, {plain(result.title)}"
    return on_paper("section", title, described(result), scale, views, paper, below)


def parts_rows(result: "SizeResult") -> list[tuple[str, ...]]:
    """Rows of the parts list from below, its head first: item, part, quantity, material, grade, mass."""
    abu, race = result.autobalancer, result.parts.race_part.name
    rows: list[tuple[str, ...]] = [("item", "part", "number", "material", "grade", "mass, g")]
    for item, (part, made) in enumerate(zip(result.section.parts, result.parts.turned, strict=True), 1):
        named = grade(made, made.name == race).name
        rows.append((str(item), part.name, "1", part.material, named, digits(part.mass_g, 2)))
    rows.append((str(len(rows)), f"{abu.corrector} {ball_size(abu)}", f"{abu.ball_count}",
                 abu.ball_material, BALL_STEEL.name, f"{abu.ball_count} × {digits(abu.ball_mass_g)}"))  # fmt: skip
    return rows


def _views(result: "SizeResult", room: Point, items: Mapping[str, str]) -> tuple[float, tuple[Shape, ...]]:
    """The largest scale for which there is room on paper, and both views beside each other in it."""
    for scale in SCALES:
        face, section = assembly_face(result, scale), section_view(result, scale, 0.0, items)
        (_, beside), (left, _) = extent(face, scale), extent(section, scale)
        views = *face, *(moved(shape, (beside[0] - left[0] + GAP / scale, 0)) for shape in section)
        low, high = extent(views, scale)
        if scale * (high[0] - low[0]) <= room[0] and scale * (high[1] - low[1]) <= room[1]:
            break
    return scale, views


def _notes(result: "SizeResult") -> Iterator[str]:
    """The lines of the drawing table that neither a dimension nor the sheet of the race's part says."""
    told = SHOWN | {line.feature for line in race_lines(result)} | {"housing without balls"}
    yield from (note_of(line) for line in result.drawing if line.feature not in told)


def size_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The assembly, its parts, and sketches of the swing arm and of bearing seats where the machine has them."""
    parts = part_sheets(result, 1 + len(result.parts.turned))
    return section_sheet(result), *parts, *arm_sheets(result), *seats_of(result, result.fits)


def arm_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The sketch of the swing arm, if there is one."""
    if result.swing_arm is None:
        return ()
    from abu_calc.features.swing_arm.view import swing_arm_sketch

    return (swing_arm_sketch(result, result.swing_arm, result.autobalancer.outer_diameter_mm / 2),)


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
