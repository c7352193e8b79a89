"""Callouts: what is asked of a surface, on a shelf at the end of a leader, in columns beside a view.

Signs follow ISO 1101 (frames), ISO 5459 (datums), ISO 1302 (roughness).
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final, Literal, NamedTuple

from abu_calc.reporting.drawings.dimensions import ABOVE, datum, leader, roughness
from abu_calc.reporting.drawings.shapes import HEIGHT, Arc, Line, Point, Shape, Text, ToleranceFrame, text_width

PLAIN_ROW: Final = 6.0
ROUGH_ROW: Final = 11.5
FRAME_ROW: Final = 7.0
DATUM_ROW: Final = 14.5
BETWEEN: Final = 3.0
"""Heights of a callout's rows and the distance to the next one, on paper [mm]."""
RISE: Final = 6.0
"""Height of a shelf above its tip, so that no leader lies in a surface, on paper [mm]."""
SIGN: Final = 9.0
"""Width of the sign of roughness without its value, on paper [mm]."""


class Callout(NamedTuple):
    """Demands on a surface at a point: a text, one below it, roughness as written, frames, the letter of a datum."""

    tip: Point
    text: str = ""
    rough: str = ""
    frames: tuple[tuple[str, ...], ...] = ()
    datum: str = ""
    pointed: bool = True
    below: str = ""

    @property
    def above(self) -> float:
        """Height above its shelf on paper [mm]."""
        return ROUGH_ROW if self.rough else PLAIN_ROW

    @property
    def height(self) -> float:
        """Height on paper [mm]."""
        hanging = (PLAIN_ROW if self.below else 0.0) + (DATUM_ROW if self.datum else 0.0)
        return self.above + hanging + FRAME_ROW * len(self.frames)

    @property
    def width(self) -> float:
        """Width on paper [mm]."""
        sign = SIGN + text_width(self.rough, HEIGHT) if self.rough else 0.0
        rows = [text_width(self.text, HEIGHT) + sign + 1, text_width(self.below, HEIGHT) + 1]
        rows += [2 * HEIGHT + sum(max(2 * HEIGHT, text_width(cell, HEIGHT) + 2) for cell in cells[1:])
                 for cells in self.frames]  # fmt: skip
        return max(rows)


Side = Literal["left", "right"]


def column(callouts: Sequence[Callout], x: float, top: float, side: Side, scale: float) -> Iterator[Shape]:
    """Callouts below one another from `top` [mm of the object], in the order of their tips; shelves begin at `x`."""
    y = top
    for callout in sorted(callouts, key=lambda each: -each.tip[1]):
        y = min(y, callout.tip[1] + callout.height / scale)
        yield from _drawn(callout, x, y, side, scale)
        y -= (callout.height + BETWEEN) / scale


def rising_column(callouts: Sequence[Callout], x: float, limit: float, side: Side, scale: float) -> Iterator[Shape]:
    """Callouts above one another, no shelf below its tip unless all have to go down to stay below `limit`."""
    low, shelves = -math.inf, list[tuple[Callout, float]]()
    for callout in sorted(callouts, key=lambda each: each.tip[1]):
        hanging = callout.height - callout.above
        shelf = max(callout.tip[1] + RISE / scale, low + (BETWEEN + hanging) / scale)
        shelves.append((callout, shelf))
        low = shelf + callout.above / scale
    down = max(low - limit, 0.0) if shelves else 0.0
    for callout, shelf in shelves:
        yield from _drawn(callout, x, shelf - down + callout.above / scale, side, scale)


def _drawn(callout: Callout, x: float, top: float, side: str, scale: float) -> Iterator[Shape]:
    unit = 1 / scale
    shelf = top - callout.above * unit
    left = x if side == "right" else x - callout.width * unit
    line = leader(callout.tip, (x, shelf), "", scale, more=callout.width, pointed=callout.pointed)
    yield from (shape for shape in line if not isinstance(shape, Text))
    if callout.text:
        yield Text((left + 0.5 * unit, shelf + ABOVE * unit), callout.text)
    if callout.rough:
        at = left + (text_width(callout.text, HEIGHT) + 4) * unit
        yield from roughness((at, shelf), callout.rough, scale)
    y = shelf
    if callout.below:
        y -= PLAIN_ROW * unit
        yield Text((left + 0.5 * unit, y + ABOVE * unit), callout.below)
    for cells in callout.frames:
        yield ToleranceFrame((left, y), cells)
        y -= FRAME_ROW * unit
    if callout.datum:
        yield from datum((left + 6 * unit, y), callout.datum, scale)


def balloon(tip: Point, centre: Point, number: str, scale: float) -> Iterator[Shape]:
    """The number of an item in a circle, with a line that ends in a dot inside the part (ISO 6433)."""
    unit, radius = 1 / scale, 5.0 / scale
    across, up = tip[0] - centre[0], tip[1] - centre[1]
    far = max((across**2 + up**2) ** 0.5, 1e-9)
    edge = centre[0] + radius * across / far, centre[1] + radius * up / far
    yield Line("dimension", edge, tip)
    yield Arc("dimension", tip, 0.5 * unit)
    yield Arc("dimension", centre, radius)
    yield Text((centre[0], centre[1] - HEIGHT / 2 * unit), number, HEIGHT, "centre")


def projection_symbol(corner: Point, unit: float) -> Iterator[Shape]:
    """The sign of first-angle projection (ISO 5456-2), 16 by 8 mm on paper, from its lower left corner."""
    x, y = corner[0], corner[1] + 4 * unit

    def line(layer: Literal["outline", "centre"], *ends: float) -> Line:
        x1, y1, x2, y2 = ends
        return Line(layer, (x + x1 * unit, y + y1 * unit), (x + x2 * unit, y + y2 * unit))

    yield from (line("outline", 0, -1.5, 0, 1.5), line("outline", 6, -3, 6, 3), line("outline", 0, 1.5, 6, 3),
                line("outline", 0, -1.5, 6, -3), line("centre", -1, 0, 7, 0), line("centre", 8.5, 0, 16.5, 0),
                line("centre", 12.5, -4, 12.5, 4))  # fmt: skip
    for radius in (1.5, 3.0):
        yield Arc("outline", (x + 12.5 * unit, y), radius * unit)
