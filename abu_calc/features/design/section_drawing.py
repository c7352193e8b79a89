"""Drawings of the autobalancer: section through its axis, face with the cover off, section in characters.

The drawings are to scale with dimensions. In characters, for a terminal, the axis stands upright, so that the long side
lies along the lines.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from abu_calc.features.design.records import AutobalancerRecord, Section
from abu_calc.reporting.drawings.dimensions import (
    arrow,
    balloon,
    datum,
    extent,
    fits,
    leader,
    moved,
    roughness,
    tolerance_frame,
)
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    Arc,
    Corner,
    Drawing,
    Length,
    Line,
    Point,
    Radius,
    Region,
    Shape,
    Text,
    digits,
    text_width,
    toleranced,
)
from abu_calc.standards.balls import inch_size

if TYPE_CHECKING:
    from abu_calc.features.design.records import SectionPart
    from abu_calc.features.design.study import SizeResult

HATCHES = {"body": (45.0, 2.5), "race ring": (135.0, 2.5), "cover": (135.0, 1.5)}
STACK = 10.0
"""Distance from the part to its first dimension; `STEP`: from one to the next. On paper [mm]."""
STEP = 9.0
COLUMN = 14.0
"""Distance from the part to the texts right of it, on paper [mm]."""
DATUM = 15.0
"""Space that the datum sign takes below the bore, on paper [mm]."""
OVERHANG = 4.0
"""Overhang of centre lines, on paper [mm]."""


def section_view(
    result: "SizeResult", scale: float, right: float = 0.0, items: Mapping[str, str] | None = None
) -> tuple[Shape, ...]:
    """The section, the axis along y = 0; its closed web stands at x = `right`. `items`: numbers instead of names."""
    abu, unit = result.autobalancer, 1 / scale
    outer = abu.outer_diameter_mm / 2
    shapes = (
        *_cut(result.section.parts),
        *_seen_behind(result),
        *_balls_cut(result),
        Line("centre", (-OVERHANG * unit, 0), (abu.width_mm + OVERHANG * unit, 0)),
        *_diameters(result, unit),
        *_widths(result, unit),
        *(() if items else _race_notes(result, scale)),
        *_part_names(result, scale, items or {}),
        Text((abu.width_mm / 2, outer + (STACK + 2 * STEP) * unit), "A–A", 1.4 * HEIGHT, "centre"),
    )
    told = (_on_other_sheets(result, shape) for shape in shapes) if items else shapes
    return tuple(moved(shape, (right, 0.0)) for shape in told)


def _on_other_sheets(result: "SizeResult", shape: Shape) -> Shape:
    """A dimension that the sheet of a part gives, in brackets and without its tolerance; others as they are."""
    if not isinstance(shape, Length | Radius) or shape.text.startswith("("):
        return shape
    own = result.autobalancer.outer_diameter_mm, result.autobalancer.width_mm, result.section.bore_diameter_mm
    if isinstance(shape, Length) and any(abs(shape.value - size) < 1e-9 for size in own):
        return shape
    size = shape.text.partition(" ")[0]
    sign, number = ("", size) if size[:1].isdigit() else (size[:1], size[1:])
    return replace(shape, text=f"({sign}{digits(float(number))})")


def assembly_face(result: "SizeResult", scale: float) -> tuple[Shape, ...]:
    """The face as the assembly's sheet shows it: what parts' sheets dimension stands in brackets."""
    return tuple(_on_other_sheets(result, shape) for shape in face_view(result, scale))


def face_view(result: "SizeResult", scale: float) -> tuple[Shape, ...]:
    """The face seen on the open side, its centre at the origin, balls evenly round the race."""
    abu, section, unit = result.autobalancer, result.section, 1 / scale
    outer, pitch = abu.outer_diameter_mm / 2, abu.pitch_radius_mm
    seen = {round(diameter, 6) for diameter in (
        section.bore_diameter_mm, section.hub_diameter_mm, section.shoulder_diameter_mm, section.race_diameter_mm,
        section.ring_diameter_mm, abu.outer_diameter_mm,
    )}  # fmt: skip
    reach = outer + OVERHANG * unit
    return (
        *(Arc("outline", (0, 0), diameter / 2) for diameter in sorted(seen)),
        Arc("centre", (0, 0), pitch),
        Line("centre", (-reach, 0), (reach, 0)),
        *_cutting_plane(outer, scale),
        *_balls_seen(result),
        *(Radius((0, 0), radius, angle, _outside(outer, angle, unit), text, True) for (radius, text), angle in zip((
            (abu.race_radius_mm, f"Ø{toleranced(2 * abu.race_radius_mm, 2 * section.race_tolerance_mm)}"),
            (pitch, f"(Ø{digits(2 * pitch)})"),
            (section.hub_diameter_mm / 2, f"Ø{digits(section.hub_diameter_mm)}"),
        ), _clear_of_balls(abu), strict=True)),
        Text((0, outer + (STACK + 2 * STEP) * unit), "cover off", HEIGHT, "centre"),
    )  # fmt: skip


def _clear_of_balls(abu: "AutobalancerRecord") -> tuple[float, ...]:
    """Angles for three radii in different corners, each between two balls if there is a gap near."""
    part, half = 360 / abu.ball_count, math.degrees(math.asin(abu.ball_diameter_mm / 2 / abu.pitch_radius_mm))
    angles = list[float]()
    for wanted in (135.0, 225.0, 315.0):
        gap = 90 + (round((wanted - 90) / part - 0.5) + 0.5) * part
        crossed = abs((wanted - 90 + part / 2) % part - part / 2) < half
        angles.append(gap if crossed and abs(gap - wanted) < 40 else wanted)
    return tuple(angles)


def section_drawing(result: "SizeResult", scale: float) -> Drawing:
    """The section alone, as a report shows it."""
    title, shapes = f"Section of the autobalancer, {result.title}", section_view(result, scale)
    return alone("section", title, described(result), shapes, scale)


def face_drawing(result: "SizeResult", scale: float) -> Drawing:
    """The face alone, as a report shows it."""
    title, shapes = f"Face of the autobalancer, {result.title}", face_view(result, scale)
    return alone("face", title, described(result), shapes, scale)


def alone(name: str, title: str, words: str, shapes: Sequence[Shape], scale: float) -> Drawing:
    """Shapes as a report shows them, without a frame."""
    low, high = extent(shapes, scale)
    margin = 3 / scale
    return Drawing(
        name, title, words, scale, (low[0] - margin, low[1] - margin),
        (high[0] + margin, high[1] + margin), tuple(shapes),
    )  # fmt: skip


def described(result: "SizeResult") -> str:
    """The drawing in words, for those who cannot see it."""
    abu, section = result.autobalancer, result.section
    groove = "straight across" if abu.groove_radius_mm is None else f"groove radius {digits(abu.groove_radius_mm)} mm"
    return (
        f"Autobalancer of {digits(abu.outer_diameter_mm)} mm outer diameter and {digits(abu.width_mm)} mm width on a "
        f"bore of {digits(section.bore_diameter_mm)} mm {section.bore_class}. {abu.ball_count} {abu.corrector}s of "
        f"{digits(abu.ball_diameter_mm)} mm run in a race of radius {digits(abu.race_radius_mm)} mm, {groove}, between "
        f"a web and a cover of {digits(section.web_mm)} mm. Parts: "
        + ", ".join(f"{part.name} of {part.material}" for part in section.parts)
        + "."
    )


def _cut(parts: "Sequence[SectionPart]") -> Iterator[Region]:
    """Both halves of each part."""
    for part in parts:
        angle, spacing = HATCHES[part.name]
        for side in (1, -1):
            corners: tuple[Corner, ...] = tuple((x, side * r, side * bulge) for x, r, bulge in part.outline_mm)
            yield Region(corners, part.name, angle, spacing)


def _seen_behind(result: "SizeResult") -> Iterator[Line]:
    """The edges of the bore behind the plane of the section."""
    bore = result.section.bore_diameter_mm / 2
    for x in (0.0, result.autobalancer.width_mm):
        yield Line("outline", (x, -bore), (x, bore))


def _balls_cut(result: "SizeResult") -> Iterator[Shape]:
    """The ball at the top, and that at the bottom where there is one; rollers seen from the side."""
    abu = result.autobalancer
    radius, middle, reach = abu.ball_diameter_mm / 2, abu.width_mm / 2, 0.62 * abu.ball_diameter_mm
    for side in (1, -1) if abu.ball_count % 2 == 0 else (1,):
        y = side * abu.pitch_radius_mm
        if abu.corrector == "ball":
            yield Arc("outline", (middle, y), radius)
        else:
            box = [(middle - radius, y - radius), (middle + radius, y - radius),
                   (middle + radius, y + radius), (middle - radius, y + radius)]  # fmt: skip
            yield from (Line("outline", a, b) for a, b in zip(box, (*box[1:], box[0]), strict=True))
        yield Line("centre", (middle - reach, y), (middle + reach, y))
    top = abu.race_radius_mm
    yield Line("centre", (middle, abu.pitch_radius_mm - reach), (middle, min(top, abu.pitch_radius_mm + reach)))


def _diameters(result: "SizeResult", unit: float) -> Iterator[Shape]:
    """Left of the closed web, the smallest nearest to it."""
    abu, section = result.autobalancer, result.section
    bore, limits = f"Ø{digits(section.bore_diameter_mm)} {section.bore_class}".strip(), bore_limits(section)
    if not fits(section.bore_diameter_mm, limits, 1 / unit):
        limits = ""
    rows = [(section.bore_diameter_mm, bore, 0.0)]
    if any(part.name == "race ring" for part in section.parts):
        rows.append((section.ring_diameter_mm, f"Ø{digits(section.ring_diameter_mm)}", section.web_mm))
    rows.append((abu.outer_diameter_mm, f"Ø{digits(abu.outer_diameter_mm)}", 0.0))
    for index, (diameter, text, x) in enumerate(rows):
        at = -(STACK + STEP * index) * unit
        yield Length((x, -diameter / 2), (x, diameter / 2), at, text, True, below=limits if index == 0 else "")
    half = section.bore_diameter_mm / 2
    if abu.outer_diameter_mm / 2 - half > DATUM * unit:
        yield from datum((-STACK * unit, -half), "A", 1 / unit)
    else:
        right = abu.width_mm
        yield Line("dimension", (right + unit, -half), (right + 9 * unit, -half))
        yield from datum((right + 6 * unit, -half), "A", 1 / unit, upwards=True)


def bore_limits(section: "Section") -> str:
    """Limits of the bore [mm] as a drawing writes them; nothing where they are not tabulated."""
    if section.bore_limits_um is None:
        return ""
    low, high = (digits(limit / 1000, 4) for limit in section.bore_limits_um)
    return f"(+{high} / {low})"


def _widths(result: "SizeResult", unit: float) -> Iterator[Length]:
    """Dimensions of the widths: between web and cover, the cover, and all above; the web below."""
    abu, section = result.autobalancer, result.section
    outer, right = abu.outer_diameter_mm / 2, abu.width_mm
    web, shoulder = section.web_mm, section.shoulder_diameter_mm / 2
    top = outer + STACK * unit
    inner = digits(section.inner_width_mm, 2)
    yield Length((web, shoulder), (right - web, shoulder), top, inner, beyond="start", clear=web)
    yield Length((right - web, shoulder), (right, outer), top, digits(web))
    yield Length((0, outer), (right, outer), top + STEP * unit, digits(right, 2))
    yield Length((0, -outer), (web, -shoulder), -outer - STACK * unit, digits(web), beyond="start")


def _race_notes(result: "SizeResult", scale: float) -> Iterator[Shape]:
    """Requirements of the race: form, runout, surface, hardness above; the groove's radius below."""
    abu, section, unit = result.autobalancer, result.section, 1 / scale
    outer, right = abu.outer_diameter_mm / 2, abu.width_mm + COLUMN * unit
    tip = _on_race(result, 0.7)
    shelf = right, outer - HEIGHT * unit
    size = f"Ø{toleranced(section.race_diameter_mm, 2 * section.race_tolerance_mm)}"
    hard, rough = f"race {size}, {section.hardness}", f"Ra {digits(section.roughness_Ra_um)}"
    yield from leader(tip, shelf, hard, scale, more=6)
    end = right + (text_width(hard, HEIGHT) + 5) * unit
    yield from roughness((end, shelf[1]), rough, scale)
    runout = "runout", digits(section.runout_um / 1000, 4), "A"
    yield from tolerance_frame((right, shelf[1]), ("circularity", digits(section.circularity_um / 1000, 4)), scale)
    yield from tolerance_frame((right, shelf[1] - 2 * HEIGHT * unit), runout, scale)
    if abu.groove_radius_mm is not None:
        centre = abu.width_mm / 2, -(abu.race_radius_mm - abu.groove_radius_mm)
        text = f"R{toleranced(abu.groove_radius_mm, section.groove_tolerance_mm)}"
        angle = -90 + math.degrees(math.asin(section.inner_width_mm / 2 / abu.groove_radius_mm)) / 3
        lowest = min(y for _, _, _, y in _named(result, unit))
        shelf = right, min(-outer - STACK * unit, lowest - 2.2 * HEIGHT * unit)
        yield Radius(centre, abu.groove_radius_mm, angle, shelf, text)


def _on_race(result: "SizeResult", share: float) -> Point:
    """A point on the race, so far from its middle to the cover."""
    abu, section = result.autobalancer, result.section
    x = share * section.inner_width_mm / 2
    drop = 0.0
    if abu.groove_radius_mm is not None:
        drop = abu.groove_radius_mm - math.sqrt(abu.groove_radius_mm**2 - x**2)
    return abu.width_mm / 2 + x, abu.race_radius_mm - drop


def _part_names(result: "SizeResult", scale: float, items: Mapping[str, str]) -> Iterator[Shape]:
    """Balls and parts by name right of the section, or by their numbers in balloons."""
    column = result.autobalancer.width_mm + COLUMN / scale
    for tip, text, pointed, y in _named(result, 1 / scale):
        if text in items:
            yield from balloon(tip, (column + 6 / scale, y), items[text], scale)
        else:
            yield from leader(tip, (column, y), text, scale, pointed=pointed)


def balls_text(abu: AutobalancerRecord) -> str:
    """Count and diameter of the balls, as the section names them."""
    return f"{abu.ball_count} × {ball_size(abu)}"


def ball_size(abu: AutobalancerRecord) -> str:
    """Diameter of a ball, with the fraction of an inch by which it is ordered."""
    inch = inch_size(abu.ball_diameter) if abu.corrector == "ball" else ""
    return f"Ø{digits(abu.ball_diameter_mm)}{f' ({inch})' if inch else ''}"


def _named(result: "SizeResult", unit: float) -> Iterator[tuple[Point, str, bool, float]]:
    """Point, name, whether an arrow or a dot stands at the point, height of the text: one below the other."""
    abu, section = result.autobalancer, result.section
    x, radius = abu.width_mm - section.web_mm / 2, abu.ball_diameter_mm / 2
    hub, race, ring = section.hub_diameter_mm / 2, section.race_diameter_mm / 2, section.ring_diameter_mm / 2
    edge = math.sqrt(0.5) * radius
    ball = (edge, edge) if abu.corrector == "ball" else (radius, 0.0)
    tips = {"body": (x, -(hub + section.bore_diameter_mm / 2) / 2), "cover": (x, -(hub + race) / 2),
            "race ring": (x, -(race + ring) / 2)}  # fmt: skip
    named = [((abu.width_mm / 2 + ball[0], abu.pitch_radius_mm - ball[1]),
              balls_text(abu), True)]  # fmt: skip
    named += [(tips[part.name], part.name, False) for part in section.parts]
    top = abu.outer_diameter_mm / 2 - 7.2 * HEIGHT * unit
    for tip, text, pointed in sorted(named, key=lambda row: -row[0][1]):
        top = min(top, tip[1])
        yield tip, text, pointed, top
        top -= 3.2 * HEIGHT * unit


def _cutting_plane(outer: float, scale: float) -> Iterator[Shape]:
    """The plane of the section with its arrows, and the vertical centre line."""
    unit = 1 / scale
    reach = outer + STACK * unit
    yield Line("centre", (0, -reach), (0, reach))
    for side in (1, -1):
        y = side * reach
        yield Line("outline", (0, y), (0, y - side * 5 * unit))
        yield from arrow((8 * unit, y), (0, y), scale)
        yield Text((-3 * unit, y - (HEIGHT * unit if side > 0 else 0)), "A", 1.4 * HEIGHT, "right")


def _balls_seen(result: "SizeResult") -> Iterator[Shape]:
    """Circles, and their part behind the edge of the groove as hidden lines."""
    abu = result.autobalancer
    pitch, radius, edge = abu.pitch_radius_mm, abu.ball_diameter_mm / 2, result.section.shoulder_diameter_mm / 2
    cosine = (edge**2 - pitch**2 - radius**2) / (2 * pitch * radius)
    for number in range(abu.ball_count):
        turn = 90 + 360 * number / abu.ball_count
        centre = pitch * math.cos(math.radians(turn)), pitch * math.sin(math.radians(turn))
        if cosine >= 1:
            yield Arc("outline", centre, radius)
            continue
        hidden = math.degrees(math.acos(max(cosine, -1.0)))
        yield Arc("outline", centre, radius, turn + hidden, turn - hidden + 360)
        yield Arc("hidden", centre, radius, turn - hidden, turn + hidden)


def _outside(outer: float, angle: float, unit: float) -> Point:
    """Place of a radius's text: outside the part, at an angle."""
    turn, reach = math.radians(angle), outer + 8 * unit
    return reach * math.cos(turn), reach * math.sin(turn)


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


def section_lines(abu: AutobalancerRecord, section: Section, rows: int) -> list[str]:
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
    abu: AutobalancerRecord,
    parts: Sequence[tuple[str, Sequence[Point]]],
    middle: float,
    reach: float,
    half: int,
    face: bool,
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
    abu: AutobalancerRecord, parts: Sequence[tuple[str, Sequence[Point]]], x: float
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
