"""Frame, title block after ISO 7200, notes and lists of a sheet, in mm on paper."""

import textwrap
from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from abu_calc.reporting.drawings.callouts import projection_symbol
from abu_calc.reporting.drawings.dimensions import roughness
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    SMALL,
    Line,
    Shape,
    Text,
    digits,
    fitted,
    fitting_height,
    plain,
    text_width,
)  # fmt: skip

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
