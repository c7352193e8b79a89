"""Both planes as one sees them who stands before the roll's end: the mark on top, what is to be done on the circle."""

import math
from collections.abc import Iterable
from typing import Final

from abu_calc.studies.balance_records import PlaneCorrection

WIDTH: Final = 36
HEIGHT: Final = 13
ACROSS: Final = 11
DOWN: Final = 5
SIGNS: Final = {"remove": "-", "add": "+"}
LEGEND: Final = (
    "- take off, + put on, o the heavy spot, 0 the zero mark. Degrees are laid off from the mark against the arrows of "
    "rotation."
)


def drawing(left: PlaneCorrection, right: PlaneCorrection, turns_from_left: str) -> list[str]:
    """Lines with both planes side by side, the left one seen from the left end, the right one from the right."""
    sense = 1 if turns_from_left == "counterclockwise" else -1
    pictures = [
        _plane("LEFT plane, from the left end", left, sense),
        _plane("RIGHT plane, from the right end", right, -sense),
    ]
    return [f"  {line:<{WIDTH}}  {other}".rstrip() for line, other in zip(*pictures, strict=True)]


def _plane(title: str, plane: PlaneCorrection, sense: int) -> list[str]:
    """`sense`: 1 where the roll turns counterclockwise to the one who looks, so that degrees run clockwise."""
    cells = [[" "] * WIDTH for _ in range(HEIGHT)]
    for degrees in range(0, 360, 3):
        _put(cells, ".", degrees, sense)
    for quarter in (90, 180, 270):
        _put(cells, f"{quarter}", quarter, sense, 1.25)
    for row, arrow in ((-2, "<---" if sense > 0 else "--->"), (2, "--->" if sense > 0 else "<---")):
        _write(cells, arrow, WIDTH // 2, HEIGHT // 2 + row)
    for sign, place in _marks(plane):
        _put(cells, sign, place, sense)
    _put(cells, "0", 0, sense, 1.25)
    return [f"{title:^{WIDTH}}".rstrip(), *("".join(row).rstrip() for row in cells)]


def _marks(plane: PlaneCorrection) -> Iterable[tuple[str, float]]:
    heavy = [("o", plane.angle_deg)] if plane.mass_g else []
    return [*heavy, *((SIGNS[share.action], share.angle_deg) for share in plane.corrections)]


def _put(cells: list[list[str]], text: str, degrees: float, sense: int, out: float = 1.0) -> None:
    """Text at an angle from the mark against rotation, its middle on the circle, or farther out."""
    angle = math.radians(degrees)
    column = WIDTH // 2 + round(ACROSS * out * math.sin(angle) * sense)
    _write(cells, text, column, HEIGHT // 2 - round(DOWN * out * math.cos(angle)))


def _write(cells: list[list[str]], text: str, middle: int, row: int) -> None:
    for offset, letter in enumerate(text):
        cells[row][middle - len(text) // 2 + offset] = letter
