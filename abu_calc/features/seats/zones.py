"""Tolerance zones of both seats of a bearing as textbooks draw them, in plain characters that every console has."""

import math
from typing import Final

from abu_calc.features.seats.interference import Pair
from abu_calc.features.seats.seats import SeatResult

ROWS_WANTED: Final = 14
STEPS: Final = (1, 2, 5, 10, 20, 50, 100, 200, 500)
RING, PART = "/", "#"
WIDTH: Final = 26
"""Columns of one seat: with the scale both take 60."""


def zone_lines(shaft: SeatResult, housing: SeatResult) -> list[str]:
    """Zero line, ring zone and part zone of both seats over one scale in µm; a row is a step of the scale."""
    seats = [(each.ring_limits_um, each.part_limits_um, each.fit) for each in (shaft, housing)]
    deviations = [0.0, *(limit for ring, part, _ in seats for limit in (*ring, *part))]
    low, high = min(deviations), max(deviations)
    step = next((division for division in STEPS if (high - low) / division <= ROWS_WANTED), STEPS[-1])
    top, bottom = math.ceil(high / step), math.floor(low / step)
    lines = [f"{'um':>5} |{'shaft':^{WIDTH}}{'housing':^{WIDTH}}".rstrip()]
    for row in range(top - 1, bottom - 1, -1):
        cells = "".join(_zone_cell(row, step, *seat) for seat in seats)
        label = row + 1 if row >= 0 else row
        lines.append(f"{label * step:+5} |{cells}".rstrip())
        if row == 0 or (row == top - 1 and top == 0):
            lines.append(f"{0:5} +{'-' * (2 * WIDTH - 2)}")
    if top == 0:
        lines.insert(1, lines.pop(2))
    return lines


def legend() -> str:
    """Legend of the characters."""
    return (
        f"{RING * 3} zone of the ring, {PART * 3} zone of the shaft or housing, --- zero line (nominal size); "
        "deviations in µm, upper limit above, lower below. Interference: the shaft zone is above its ring zone, the "
        "housing zone below."
    )


def _zone_cell(row: int, step: int, ring: Pair, part: Pair, fit: str) -> str:
    """One row of one seat: both zones side by side, each with its limits and its name."""
    return f"  {_zone(row, step, ring, RING, 'ring')}{_zone(row, step, part, PART, fit)}".ljust(WIDTH)


def _zone(row: int, step: int, limits: Pair, mark: str, name: str) -> str:
    lower, upper = limits
    rows = [
        tick for tick in range(math.floor(lower / step), math.ceil(upper / step)) if lower < (tick + 0.5) * step < upper
    ]
    rows = rows or [math.floor((lower + upper) / 2 / step)]
    bar = mark * 5
    if len(rows) > 2 and row == rows[len(rows) // 2]:
        bar = name[:5].center(5, mark)
    limit = f"{upper:+g}" if row == rows[-1] else f"{lower:+g}" if row == rows[0] else ""
    if len(rows) == 1:
        limit = f"{lower:+g}{upper:+g}"
    return f"{bar if row in rows else '':5} {limit if row in rows else '':6}"
