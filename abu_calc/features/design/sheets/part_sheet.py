"""The sheet of one part: section with dimensions, the race's corner enlarged, notes, title block."""

import hashlib
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Final

from abu_calc.features.design.sheets.dimension_plan import DimensionPlan, dimension_plan
from abu_calc.features.design.sheets.frame import (
    BINDING,
    BLOCK,
    HIGH,
    MARGIN,
    NOTE_ROW,
    WIDE,
    TitleBlock,
    frame,
    note_lines,
    title_block,
    written_notes,
)
from abu_calc.features.design.sheets.manufacture import GENERAL_ROUGHNESS, demanded, grade, part_notes
from abu_calc.features.design.sheets.part_views import detail_surfaces, part_section, race_detail
from abu_calc.foundation.checks import verdict_codes
from abu_calc.reporting.drawings.dimensions import extent, moved
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SCALES,
    Arc,
    Drawing,
    Line,
    Point,
    Shape,
    Solid,
    Text,
    digits,
    fitted,
    plain,
)
from abu_calc.reporting.parts import replaced_entries
from abu_calc.sizing.parts.housing_parts import TurnedPart

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult
    from abu_calc.simulation.result import Result

GAP: Final = 8.0
"""Distance between views, and between views and the frame, on paper [mm]."""
CHANGED: Final = 70
"""Most letters of replaced entries in the title block."""
TWICE: Final = 1.9
"""The detail is drawn if it is so much larger than the section."""


def part_sheet(result: "SizeResult", part: TurnedPart, sheet: int, sheets: int) -> Drawing:
    """Sheet of one part on A3, in the largest standard scale for which there is room."""
    part = demanded(part)
    plan = dimension_plan(part)
    race = result.parts.race_part.name == part.name
    notes = note_lines(tuple(part_notes(result, part)), WIDE - MARGIN - BINDING - BLOCK[0] - 12)
    below = max(BLOCK[1], NOTE_ROW * len(notes) + 10)
    room = WIDE - MARGIN - BINDING - 2 * GAP, HIGH - 2 * MARGIN - below - 2 * GAP
    scale, views = _views(part, plan, room)
    block = TitleBlock(
        title=f"{part.name} of the autobalancer", more=result.title, number=number(result, sheet), sheet=sheet,
        sheets=sheets, kind="part drawing", material=grade(part, race).name, mass_g=1e3 * part.mass,
        scale=ratio(scale), roughness=GENERAL_ROUGHNESS, **origin(result),
    )  # fmt: skip
    paper = (*frame(), *title_block(block), *written_notes("Requirements (engineering practice, assumed)", notes,
                                                             BINDING + 4, MARGIN + 3))  # fmt: skip
    described = f"Sheet {sheet} of {sheets}: {part.name}, {grade(part, race).name}, {digits(1e3 * part.mass, 1)} g."
    paper = (*paper, *stamp(result))
    name = part.name.replace(" ", "-")
    title = f"{part.name} of the autobalancer, {plain(result.title)}"
    return on_paper(name, title, described, scale, views, paper, below)


def number(result: "SizeResult", sheet: int) -> str:
    """Identification number: by the hash of the file and of replaced entries, so another design has another.

    00 is the assembly.
    """
    source = result.provenance
    sign = source.sha256 or "0" * 8
    if source.overrides:
        changed = "\n".join(sorted(replaced_entries(source)))
        sign = hashlib.sha256(f"{sign}\n{changed}".encode()).hexdigest()
    return f"ABU-{sign[:8].upper()}-{sheet - 1:02d}"


def origin(result: "SizeResult") -> dict[str, str]:
    """Fields of the title block that say what the sheet stands on."""
    source = result.provenance
    name = PurePath(source.file.replace("\\", "/")).name if source.file else "no file"
    return {"date": source.date, "creator": f"abu-calc {source.version}", "status": "design",
            "file": f"{name}{_changed(replaced_entries(source))}", "sha256": source.sha256 or "–",
            "checks": verdict(result)}  # fmt: skip


def stamp(result: "Result") -> Iterator[Shape]:
    """Words across a sheet whose design does not pass: nobody is to make it."""
    if result.status != "pass":
        words = f"NOT FOR MANUFACTURE: {verdict(result)}"
        yield Text((BINDING + 6, HIGH - MARGIN - 10), *fitted(words, WIDE - MARGIN - BINDING - 12, 2 * HEIGHT))


def _changed(entries: Sequence[str]) -> str:
    """Replaced entries as the title block names them; of many, the first for which there is room."""
    if not entries:
        return ""
    shown = next((count for count in range(len(entries), 1, -1) if len(", ".join(entries[:count])) <= CHANGED), 1)
    more = f", … ({len(entries)} in all)" if shown < len(entries) else ""
    return f", changed: {', '.join(entries[:shown])}{more}"


def verdict(result: "Result") -> str:
    """Verdict in words, with the codes of the checks that decide it."""
    return verdict_codes(result.status, result.checks)


def ratio(scale: float) -> str:
    """A scale as it is written.

    >>> ratio(2.0), ratio(0.2)
    ('2:1', '1:5')
    """
    return f"{digits(scale)}:1" if scale >= 1 else f"1:{digits(1 / scale)}"


def _views(part: TurnedPart, plan: DimensionPlan, room: Point) -> tuple[float, tuple[Shape, ...]]:
    """The section in the largest scale that leaves room, and beside it the detail in the largest that fits."""
    for scale in SCALES:
        detail = _detail(part, plan, scale, room)
        told = detail_surfaces(plan.edges) if detail else frozenset()
        views = part_section(part, plan, scale, told)
        size = _size(views, scale)
        if size[0] > room[0] or size[1] > room[1]:
            continue
        if not detail:
            return scale, views
        for enlarged in SCALES:
            if enlarged < TWICE * scale:
                break
            shapes = race_detail(part, plan, scale, enlarged)
            wide, high = _size(shapes, scale)
            if size[0] + GAP + wide <= room[0] and high <= room[1]:
                (_, low), (right, top) = extent(views, scale)
                (left, under), (_, over) = extent(shapes, scale)
                at = right - left + GAP / scale, (low + top) / 2 - (under + over) / 2
                return scale, (*views, *(moved(shape, at) for shape in shapes))
    return SCALES[-1], part_section(part, plan, SCALES[-1], frozenset())


def _detail(part: TurnedPart, plan: DimensionPlan, scale: float, room: Point) -> bool:
    """Whether the part has a race."""
    return bool(race_detail(part, plan, scale, scale))


def _size(shapes: Sequence[Shape], scale: float) -> Point:
    low, high = extent(shapes, scale)
    return scale * (high[0] - low[0]), scale * (high[1] - low[1])


def on_paper(
    name: str, title: str, description: str, scale: float, views: Sequence[Shape], paper: Sequence[Shape], below: float
) -> Drawing:
    """A sheet with its views in the middle of what the title block and notes leave."""
    unit, (low, high) = 1 / scale, extent(views, scale)
    corner = ((low[0] + high[0] - (WIDE + BINDING - MARGIN) * unit) / 2,
              (low[1] + high[1] - (HIGH + below) * unit) / 2)  # fmt: skip
    return Drawing(
        name, title, description, scale, corner, (corner[0] + WIDE * unit, corner[1] + HIGH * unit),
        (*views, *(placed(shape, corner, unit) for shape in paper)),
    )  # fmt: skip


def placed(shape: Shape, corner: Point, unit: float) -> Shape:
    """Convert a shape from mm on paper to mm of the object, placed at a corner."""

    def to(point: Point) -> Point:
        return corner[0] + unit * point[0], corner[1] + unit * point[1]

    match shape:
        case Line():
            return Line(shape.layer, to(shape.start), to(shape.end))
        case Text():
            return Text(to(shape.at), shape.text, shape.height, shape.align, shape.angle)
        case Arc():
            return Arc(shape.layer, to(shape.centre), shape.radius * unit, shape.start, shape.end)
        case Solid((first, second, third)):
            return Solid((to(first), to(second), to(third)))
    raise TypeError(f"not drawn on paper: {shape!r}")


def part_sheets(result: "SizeResult", sheets: int) -> Iterator[Drawing]:
    """Sheets of all parts that are made, after that of the assembly."""
    for index, part in enumerate(result.parts.turned, 2):
        yield part_sheet(result, part, index, sheets)
