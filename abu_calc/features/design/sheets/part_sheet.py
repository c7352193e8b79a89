"""The sheet of one part: section with dimensions, the race's corner enlarged, notes, title block.

Frame, title block after ISO 7200, notes and lists of a sheet, in mm on paper.
"""

import hashlib
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.features.design.sheets.dimension_plan import DimensionPlan, dimension_plan
from abu_calc.features.design.sheets.manufacture import GENERAL_ROUGHNESS, demanded, grade, part_notes
from abu_calc.features.design.sheets.part_views import detail_surfaces, part_section, race_detail
from abu_calc.foundation.checks import verdict_codes
from abu_calc.reporting.drawings.dimensions import extent, moved, projection_symbol, roughness
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SCALES,
    SMALL,
    Arc,
    Drawing,
    Line,
    Point,
    Shape,
    Solid,
    Text,
    digits,
    fitted,
    fitting_height,
    plain,
    text_width,
)  # fmt: skip
from abu_calc.reporting.parts import replaced_entries
from abu_calc.sizing.parts.housing_parts import TurnedPart

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult
    from abu_calc.simulation.result import Result


WIDE, HIGH = 420.0, 297.0
"""A3 [mm]."""
MARGIN, BINDING = 10.0, 20.0
BLOCK: Final = (180.0, 64.0)
"""Width and height of the title block [mm]; ISO 7200 asks for 180 mm."""
NOTE_ROW: Final = 4.2
ROW: Final = 6.0
LABEL: Final = 1.9
"""Height of the labels in the title block [mm]."""


class TitleBlock(NamedTuple):
    """What the title block says."""

    title: str
    more: str
    number: str
    sheet: int
    sheets: int
    kind: str
    material: str
    mass_g: float
    scale: str
    date: str
    creator: str
    status: str
    file: str
    sha256: str
    checks: str
    roughness: str


def frame() -> Iterator[Shape]:
    """Border, centring marks (ISO 5457)."""
    left, low, right, high = BINDING, MARGIN, WIDE - MARGIN, HIGH - MARGIN
    yield from box(left, low, right, high)
    for start, end in (((WIDE / 2, 0), (WIDE / 2, low)), ((WIDE / 2, HIGH), (WIDE / 2, high)),
                       ((0, HIGH / 2), (left, HIGH / 2)), ((WIDE, HIGH / 2), (right, HIGH / 2))):  # fmt: skip
        yield Line("frame", start, end)


def box(left: float, low: float, right: float, high: float) -> Iterator[Line]:
    """Four lines."""
    corners = (left, low), (right, low), (right, high), (left, high)
    for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        yield Line("frame", start, end)


def title_block(block: TitleBlock) -> Iterator[Shape]:
    """Fields of ISO 7200 with scale, projection, material, mass, general tolerances."""
    left, low = WIDE - MARGIN - BLOCK[0], MARGIN
    yield from box(left, low, left + BLOCK[0], low + BLOCK[1])
    rows: tuple[tuple[tuple[float, str, str], ...], ...] = (
        ((60, "legal owner", ""), (40, "created by", block.creator), (40, "checked by", ""), (40, "approved by", "")),
        ((60, "title", block.title), (37, "document type", block.kind), (18, "status", block.status),
         (41, "identification number", block.number), (12, "rev.", "A"), (12, "lang.", "en")),
        ((180, "machine", block.more),),
        ((90, "material", block.material), (30, "mass", f"{digits(block.mass_g, 1)} g"),
         (30, "scale", f"{block.scale} (mm)"), (30, "projection", "")),
        ((40, "general tolerances", "ISO 2768-mK"), (70, "edges ISO 13715", "outside −0.3, inside +0.3"),
         (70, "general roughness", "")),
        ((180, "file", block.file),),
        ((180, "SHA-256 of the file", block.sha256),),
        ((110, "checks", block.checks), (30, "date of issue", block.date), (16, "paper", "A3"),
         (24, "sheet", f"{block.sheet} / {block.sheets}")),
    )  # fmt: skip
    high = BLOCK[1] / len(rows)
    for index, cells in enumerate(rows):
        y, x = low + BLOCK[1] - high * (index + 1), left
        if index + 1 < len(rows):
            yield Line("frame", (left, y), (left + BLOCK[0], y))
        for wide, label, value in cells:
            if x > left:
                yield Line("frame", (x, y), (x, y + high))
            yield Text((x + 1, y + high - 1 - LABEL), label, LABEL)
            if value:
                yield Text((x + 2, y + 1.2), *fitted(plain(value), wide - 4, 0.8 * HEIGHT))
            x += wide
    yield from projection_symbol((left + 167.5, low + 4 * high + 1.0), 0.65)
    if block.roughness:
        yield from general_roughness((left + 138, low + 3 * high + 1.2), block.roughness)


def general_roughness(corner: tuple[float, float], value: str) -> Iterator[Shape]:
    """The roughness of every surface without a sign of its own, small: √ Ra … (√)."""
    x, y = corner
    size = 0.8 * HEIGHT
    after = x + 6 + text_width(f"{value} (", size) + 1.5
    for at in (x + 2, after):
        yield from (shape for shape in roughness((at, y), "", 2.0) if isinstance(shape, Line))
    yield Text((x + 5.5, y), f"{value} (", size)
    yield Text((after + 3.5, y), ")", size)


def note_lines(notes: Sequence[str], wide: float, height: float = SMALL) -> list[str]:
    """Numbered notes, wrapped to a width on paper [mm]; later lines of a note begin with blanks."""
    signs = int(wide / text_width("0", height))
    lines = list[str]()
    for number, note in enumerate(notes, 1):
        lines += textwrap.wrap(plain(note), signs, initial_indent=f"{number} ", subsequent_indent="    ")
    return lines


def written_notes(head: str, lines: Sequence[str], left: float, low: float) -> Iterator[Text]:
    """Notes from a lower left corner upwards."""
    top = low + NOTE_ROW * len(lines)
    yield Text((left, top + 1.5), head, HEIGHT)
    for index, line in enumerate(lines, 1):
        indent = len(line) - len(line.lstrip())
        yield Text((left + 1.2 * indent, top - NOTE_ROW * index + 1), line.lstrip(), SMALL)


def table(rows: Sequence[Sequence[str]], widths: Sequence[float], left: float, low: float) -> Iterator[Shape]:
    """A table from its lower left corner; the head stands at the bottom, as a parts list above a title block.

    No cell is cut, since it may hold a size; a long one is written smaller.
    """
    right = left + sum(widths)
    for index, row in enumerate(rows):
        y, x = low + ROW * index, left
        yield Line("frame", (left, y + ROW), (right, y + ROW))
        for cell, wide in zip(row, widths, strict=True):
            text, most = plain(cell), SMALL if index == 0 else HEIGHT * 0.85
            yield Text((x + 1.2, y + 1.6), text, fitting_height(text, wide - 2, most))
            x += wide
    for x in (left, *(left + sum(widths[: index + 1]) for index in range(len(widths)))):
        yield Line("frame", (x, low), (x, low + ROW * len(rows)))


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
