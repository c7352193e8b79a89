"""Drawing sheet of the autobalancer: both views, notes from the drawing table, list of parts, title block."""

import textwrap
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING, Final

from abu_calc.features.design.section_drawing import bore_limits, described, face_view, section_view
from abu_calc.features.seats.figures import seats_of
from abu_calc.reporting.drawings.dimensions import extent, fits, moved
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SCALES,
    SMALL,
    Drawing,
    Line,
    Point,
    Shape,
    Text,
    digits,
    fitted,
    plain,
    text_width,
)
from abu_calc.reporting.screen import many

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult
    from abu_calc.simulation.result import Result

WIDE, HIGH = 420.0, 297.0
"""A3 [mm]."""
MARGIN, BINDING = 10.0, 20.0
BLOCK: Final = (190.0, 50.0)
"""Width and height of the title block, on paper [mm]."""
ROW = 6.0
NOTE_ROW = 4.2
GAP = 12.0
"""Distance between views, and between views and the frame. All lengths are on paper [mm]."""
SHOWN: Final = frozenset({"race", "groove", "race circularity", "race surface", "rolling friction"})
"""Lines of the drawing table that the views say themselves."""


def section_sheet(result: "SizeResult") -> Drawing:
    """Section and face on an A3 sheet, in the largest standard scale for which there is room."""
    notes = tuple(_notes(result))
    below = max(BLOCK[1] + ROW * (len(result.section.parts) + 2), NOTE_ROW * len(notes) + 2 * ROW)
    room = WIDE - MARGIN - BINDING - GAP, HIGH - 2 * MARGIN - below - GAP
    scale, views = _views(result, room)
    unit, (low, high) = 1 / scale, extent(views, scale)
    bore = result.section.bore_diameter_mm, bore_limits(result.section)
    if bore[1] and not fits(*bore, scale):
        notes = (f"Ø{digits(bore[0])} {result.section.bore_class}: {bore[1]} mm", *notes)
    # The views stand in the middle of what is left of the sheet.
    corner = ((low[0] + high[0] - (WIDE + BINDING - MARGIN) * unit) / 2,
              (low[1] + high[1] - (HIGH + below) * unit) / 2)  # fmt: skip
    paper = (*_frame(), *_title_block(result, scale), *_parts_list(result), *_written(notes))
    return Drawing(
        "section", f"Section of the autobalancer, {plain(result.title)}", described(result), scale, corner,
        (corner[0] + WIDE * unit, corner[1] + HIGH * unit),
        (*views, *(_placed(shape, corner, unit) for shape in paper)),
    )  # fmt: skip


def _views(result: "SizeResult", room: Point) -> tuple[float, tuple[Shape, ...]]:
    """The largest scale for which there is room on paper, and both views beside each other in it."""
    for scale in SCALES:
        face, section = face_view(result, scale), section_view(result, scale)
        (_, beside), (left, _) = extent(face, scale), extent(section, scale)
        views = *face, *(moved(shape, (beside[0] - left[0] + GAP / scale, 0)) for shape in section)
        low, high = extent(views, scale)
        if scale * (high[0] - low[0]) <= room[0] and scale * (high[1] - low[1]) <= room[1]:
            break
    return scale, views


def _placed(shape: Line | Text, corner: Point, unit: float) -> Shape:
    """Convert a shape from mm on paper to mm of the object, placed at a corner."""

    def to(point: Point) -> Point:
        return corner[0] + unit * point[0], corner[1] + unit * point[1]

    if isinstance(shape, Line):
        return Line(shape.layer, to(shape.start), to(shape.end))
    return Text(to(shape.at), shape.text, shape.height, shape.align, shape.angle)


def _box(left: float, low: float, right: float, high: float) -> Iterator[Line]:
    corners = (left, low), (right, low), (right, high), (left, high)
    for start, end in zip(corners, (*corners[1:], corners[0]), strict=True):
        yield Line("frame", start, end)


def _frame() -> Iterator[Line]:
    yield from _box(BINDING, MARGIN, WIDE - MARGIN, HIGH - MARGIN)


def _title_block(result: "SizeResult", scale: float) -> Iterator[Line | Text]:
    """Machine, file with hash, date, version, scale, mass, verdict."""
    left, low, right, high = WIDE - MARGIN - BLOCK[0], MARGIN, WIDE - MARGIN, MARGIN + BLOCK[1]
    source, middle = result.provenance, left + 0.62 * BLOCK[0]
    yield from _box(left, low, right, high)
    rows = [high - 10 - 8 * index for index in range(6)]
    for y in rows[:-1]:
        yield Line("frame", (left, y), (right, y))
    yield Line("frame", (middle, rows[0]), (middle, rows[2]))
    yield Line("frame", (middle, rows[3]), (middle, low))
    name = PurePath(source.file.replace("\\", "/")).name if source.file else "no file"
    replaced = f", {many(len(source.overrides), 'entry', 'entries')} replaced" if source.overrides else ""
    cells = (
        (left, right, rows[0], "machine", result.title, 1.4 * HEIGHT),
        (left, middle, rows[1], "drawing", f"autobalancer, {result.section.design}", HEIGHT),
        (middle, right, rows[1], "scale", f"{ratio(scale)}    mm    A3    first angle", HEIGHT),
        (left, middle, rows[2], "file", f"{name}{replaced}", HEIGHT),
        (middle, right, rows[2], "mass with balls", f"{digits(result.autobalancer.mass_g, 1)} g", HEIGHT),
        (left, right, rows[3], "SHA-256 of the file", source.sha256 or "–", HEIGHT),
        (left, middle, rows[4], "checks", verdict(result), HEIGHT),
        (middle, right, rows[4], "date", source.date, HEIGHT),
        (left, middle, low, "general tolerances (assumed)", "ISO 2768-mK", HEIGHT),
        (middle, right, low, "made by", f"abu-calc {source.version}", HEIGHT),
    )
    for start, end, y, label, value, height in cells:
        yield Text((start + 1.5, y + 1.8), label, SMALL * 0.8)
        first = start + 2.5 + text_width(label, SMALL * 0.8) + 1.5
        text, size = fitted(plain(value), end - first - 2, height)
        yield Text((first, y + 1.8), text, size)


def ratio(scale: float) -> str:
    """A scale as it is written.

    >>> ratio(2.0), ratio(0.2)
    ('2:1', '1:5')
    """
    return f"{digits(scale)}:1" if scale >= 1 else f"1:{digits(1 / scale)}"


def verdict(result: "Result") -> str:
    """Verdict in a word, with the codes of the checks that stand in the way."""
    if result.status == "pass":
        return "PASS"
    codes = dict.fromkeys(check.code for check in result.checks if check.status == result.status)
    return f"{'FAIL' if result.status == 'fail' else 'NOT EVALUATED'}: {' '.join(codes)}"


def _parts_list(result: "SizeResult") -> Iterator[Line | Text]:
    """Parts list above the title block, from below: the parts of the autobalancer."""
    abu, low = result.autobalancer, MARGIN + BLOCK[1]
    left, right = WIDE - MARGIN - BLOCK[0], WIDE - MARGIN
    columns = left, left + 25, left + 90, left + 150, right
    rows = [
        ("number", "part", "material", "mass, g"),
        *(("1", part.name, part.material, digits(part.mass_g, 2)) for part in result.section.parts),
        (f"{abu.ball_count}", f"{abu.corrector} Ø{digits(abu.ball_diameter_mm)}", abu.ball_material,
         f"{abu.ball_count} × {digits(abu.ball_mass_g)}"),
    ]  # fmt: skip
    for index, row in enumerate(reversed(rows)):
        y = low + ROW * index
        yield Line("frame", (left, y + ROW), (right, y + ROW))
        for x, cell in zip(columns, row, strict=False):
            yield Text((x + 1.5, y + 1.4), cell, HEIGHT if index + 1 < len(rows) else SMALL)
    for x in columns:
        yield Line("frame", (x, low), (x, low + ROW * len(rows)))


def _notes(result: "SizeResult") -> Iterator[str]:
    """The lines of the drawing table that no dimension says, wrapped."""
    width = int((WIDE - MARGIN - BINDING - BLOCK[0] - 14) / text_width("0", SMALL))
    lines = [f"{line.feature}: {line.requirement}" for line in result.drawing if line.feature not in SHOWN]
    for number, line in enumerate(lines, 1):
        yield from textwrap.wrap(plain(line), width, initial_indent=f"{number} ", subsequent_indent="    ")


def _written(notes: Sequence[str]) -> Iterator[Text]:
    """Notes in the frame's lower left corner, written from there upwards."""
    top = MARGIN + 4 + NOTE_ROW * len(notes)
    yield Text((BINDING + 4, top), "Requirements (engineering practice, assumed)", HEIGHT)
    for index, line in enumerate(notes, 1):
        indent = len(line) - len(line.lstrip())
        yield Text((BINDING + 4 + 1.2 * indent, top - NOTE_ROW * index), line.lstrip(), SMALL)


def size_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The section, and sketches of the swing arm and of bearing seats where the machine has them."""
    return section_sheet(result), *arm_sheets(result), *seats_of(result, result.fits)


def arm_sheets(result: "SizeResult") -> tuple[Drawing, ...]:
    """The sketch of the swing arm, if there is one."""
    if result.swing_arm is None:
        return ()
    from abu_calc.features.swing_arm.drawing import swing_arm_sketch

    return (swing_arm_sketch(result, result.swing_arm, result.autobalancer.outer_diameter_mm / 2),)
