"""A section in characters for a terminal: the axis stands upright, so that the long side lies along the lines."""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise

from abu_calc.report.drawing.shapes import Corner, Point
from abu_calc.studies.design_records import Autobalancer
from abu_calc.studies.section_records import Section

COLUMNS = 60
"""Most columns from rim to rim."""
ASPECT = 2.0
"""Height of a character over its width."""
LEAST_ROWS = 4
SIGNS = {"body": "#", "race ring": "%", "cover": "="}
BALL, AXIS, NOTHING = "o", "|", " "
SLICES = 6
"""Cuts through each line of characters."""
ENOUGH = 0.3
"""Share of a cell from which a part fills it; at the rim and the faces less will do, where thin walls are."""


def section_lines(abu: Autobalancer, section: Section, rows: int) -> list[str]:
    """The section in at most so many lines, the cover on top; none where so few lines cannot show it."""
    if rows < LEAST_ROWS:
        return []
    across, along = abu.outer_diameter_mm / 2, abu.width_mm
    column = max(2 * across / COLUMNS, along / rows / ASPECT)
    half, down = round(across / column), round(along / column / ASPECT)
    if half < 2 * LEAST_ROWS:
        return []
    down = max(down, LEAST_ROWS)
    flat = [(SIGNS[part.name], tuple(flattened(part.outline_mm))) for part in section.parts]
    return [_line(abu, flat, (row + 0.5) / down, 0.5 / down, half, row in (0, down - 1)) for row in range(down)]


def _line(
    abu: Autobalancer, parts: Sequence[tuple[str, Sequence[Point]]], middle: float, reach: float, half: int, face: bool
) -> str:
    """One line, mirrored; left of the axis without a ball where there is none opposite."""
    shares = [dict[str, float]() for _ in range(half)]
    cell = abu.outer_diameter_mm / 2 / half
    for index in range(SLICES):
        # The outermost cuts run close to the faces, where webs are, however thin.
        x = abu.width_mm * (1 - middle - 0.999 * reach * (2 * index / (SLICES - 1) - 1))
        for sign, low, high in _slice(abu, parts, x):
            for place in range(max(int(low / cell), 0), min(math.ceil(high / cell), half)):
                covered = min(high, cell * (place + 1)) - max(low, cell * place)
                shares[place][sign] = shares[place].get(sign, 0.0) + covered / cell / SLICES
    right = "".join(_cell(share, edge=face or place == half - 1) for place, share in enumerate(shares))
    left = right if abu.ball_count % 2 == 0 else right.replace(BALL, NOTHING)
    return f"{left[::-1]}{AXIS}{right}".rstrip()


def _cell(share: dict[str, float], *, edge: bool) -> str:
    """Character that fills a cell: a part before a ball before nothing."""
    parts = {sign: covered for sign, covered in share.items() if sign != BALL}
    most = max(parts, key=lambda sign: parts[sign], default=NOTHING)
    if parts and (parts[most] >= ENOUGH or (edge and parts[most] > 0.01)):
        return most
    return BALL if share.get(BALL, 0.0) >= 0.5 else NOTHING


def _slice(
    abu: Autobalancer, parts: Sequence[tuple[str, Sequence[Point]]], x: float
) -> Iterator[tuple[str, float, float]]:
    """Parts that a line across the axis meets above it: sign, nearer end, farther end."""
    for sign, outline in parts:
        crossings = sorted(
            a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])
            for a, b in pairwise((*outline, outline[0]))
            if (a[0] <= x) != (b[0] <= x)
        )
        yield from ((sign, low, high) for low, high in zip(crossings[::2], crossings[1::2], strict=True))
    radius, aside = abu.ball_diameter_mm / 2, x - abu.width_mm / 2
    if abs(aside) < radius:
        reach = math.sqrt(radius**2 - aside**2) if abu.corrector == "ball" else radius
        yield BALL, abu.pitch_radius_mm - reach, abu.pitch_radius_mm + reach


def flattened(corners: Sequence[Corner], pieces: int = 12) -> Iterator[Point]:
    """An outline with its arcs as chords."""
    for (x, y, bulge), (x2, y2, _) in pairwise((*corners, corners[0])):
        yield x, y
        if not bulge:
            continue
        # The centre lies on the left of the chord where the arc runs counter-clockwise.
        turn, height = 4 * math.atan(bulge), (1 - bulge**2) / (4 * bulge)
        centre = (x + x2) / 2 - height * (y2 - y), (y + y2) / 2 + height * (x2 - x)
        for index in range(1, pieces):
            angle = turn * index / pieces
            dx, dy = x - centre[0], y - centre[1]
            yield (centre[0] + dx * math.cos(angle) - dy * math.sin(angle),
                   centre[1] + dx * math.sin(angle) + dy * math.cos(angle))  # fmt: skip


def legend(section: Section) -> str:
    """Legend of the characters."""
    return ", ".join(f"{SIGNS[part.name]} {part.name}" for part in section.parts) + f", {BALL} ball, {AXIS} axis"
