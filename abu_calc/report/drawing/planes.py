"""Both planes of a roll as one stands before its ends: zero mark on top, the heavy spot, what is to be done."""

import math
from collections.abc import Iterator
from typing import Final

from abu_calc.report.drawing.extent import extent
from abu_calc.report.drawing.shapes import Arc, Drawing, Line, Point, Shape, Solid, Text, fitted
from abu_calc.report.numbers import number
from abu_calc.studies.balance_records import PlaneCorrection, Share

RADIUS, APART = 20.0, 58.0
LETTERS: Final = 3.0
SIGNS: Final = {"remove": "−", "add": "+"}
DO: Final = {"remove": "take off", "add": "put on"}


def planes_drawing(left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str) -> Drawing:
    """Degrees are laid off against rotation, whose sense the arrows show."""
    sense = 1 if turns_from_left == "counterclockwise" else -1
    shapes = (*_plane("left", left, sense, 0.0), *_plane("right", right, -sense, APART))
    low, high = extent(shapes, 1.0)
    description = f"left: {', '.join(_orders(left))}; right: {', '.join(_orders(right))}"
    corners = (low[0] - 2, low[1] - 2), (high[0] + 2, high[1] + 2)
    return Drawing("planes", "What to do in both planes", description, 1.0, *corners, tuple(shapes))


def _plane(side: str, plane: PlaneCorrection, sense: int, middle: float) -> Iterator[Shape]:
    """`sense`: 1 where the roll turns counterclockwise to the one who looks, so that degrees run clockwise."""

    def at(degrees: float, out: float) -> Point:
        angle = math.radians(degrees)
        return middle + out * RADIUS * math.sin(angle) * sense, out * RADIUS * math.cos(angle)

    for row, line in enumerate((f"{side} plane", f"seen from the {side} end")):
        yield Text((middle, 1.55 * RADIUS + 5 * (1 - row)), line, LETTERS, "centre")
    yield Arc("outline", (middle, 0.0), RADIUS)
    for degrees in range(0, 360, 30):
        yield Line("dimension", at(degrees, 0.94), at(degrees, 1.0))
    for quarter in range(0, 360, 90):
        x, y = at(quarter, 0.66)
        yield Text((x, y - LETTERS / 2), f"{quarter}°", LETTERS, "centre")
    yield from _turning(middle, sense)
    if plane.mass_g:
        yield Arc("outline", at(plane.angle_deg, 1.0), 1.6)
        yield Line("hidden", (middle, 0.0), at(plane.angle_deg, 0.9))
    for share in plane.corrections if plane.mass_g else ():
        x, y = at(share.angle_deg, 1.26)
        yield Text((x, y - 2.2), SIGNS[share.action], 1.5 * LETTERS, "centre")
    for row, line in enumerate(_orders(plane, short=True)):
        yield Text((middle, -1.55 * RADIUS - 5 * row), *fitted(line, APART - 2, LETTERS), "centre")


def _turning(middle: float, sense: int) -> Iterator[Shape]:
    """An arc with an arrow: the sense in which the roll turns."""
    out = 0.36 * RADIUS
    yield Arc("dimension", (middle, 0.0), out, 30.0, 150.0)
    end = math.radians(150.0 if sense > 0 else 30.0)
    x, y = middle + out * math.cos(end), out * math.sin(end)
    along, across = (-sense * math.sin(end), sense * math.cos(end)), (math.cos(end), math.sin(end))
    tip = x + 2.5 * along[0], y + 2.5 * along[1]
    yield Solid((tip, (x + 0.8 * across[0], y + 0.8 * across[1]), (x - 0.8 * across[0], y - 0.8 * across[1])))


def _orders(plane: PlaneCorrection, *, short: bool = False) -> list[str]:
    """`short`: by signs."""
    if not plane.mass_g or not plane.corrections:
        return ["leave it as it is"]
    return [_order(SIGNS[share.action] if short else DO[share.action], share) for share in plane.corrections]


def _order(what: str, share: Share) -> str:
    return f"{what} {number(share.mass_g)} g at {round(share.angle_deg, 1) % 360:.1f}°"
