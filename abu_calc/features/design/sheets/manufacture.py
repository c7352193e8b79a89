"""Grades, heat treatment, demands and notes of the parts: engineering practice (assumed) where the design has none."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.features.design.sheets.dimension_plan import limits_text
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.units import shown
from abu_calc.reporting.drawings.shapes import digits
from abu_calc.sizing.manufacture.cover import seat_growth
from abu_calc.sizing.parts.housing_parts import GeometricalTolerance, HousingParts, Surface, TurnedPart, drawn
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits

if TYPE_CHECKING:
    from abu_calc.features.design.study import SizeResult
    from abu_calc.sizing.drawing_requirements import DrawingLine


class Grade(NamedTuple):
    """A material by its names in EN and GOST, and its heat treatment."""

    name: str
    treatment: str


RACE_STEEL: Final = Grade("100Cr6 (1.3505) EN ISO 683-17 / ШХ15 GOST 801", "harden and temper")
STEEL_PART: Final = Grade("C45+N (1.0503) EN ISO 683-1 / 45 GOST 1050", "normalised; no further heat treatment")
ALUMINIUM_PART: Final = Grade("EN AW-6082 T6 EN 573-3 / АД35.Т1 GOST 4784", "T6 as delivered")
BALL_STEEL: Final = Grade("100Cr6, ISO 3290-1 / ШХ15, GOST 3722", "as delivered")
GENERAL_ROUGHNESS: Final = "Ra 3.2"
FACE_RUNOUT: Final = 0.01e-3
"""Run-out and perpendicularity of the mounting face."""
HUB: Final = "h7"
HOLE: Final = "F8"
"""Tolerance classes of the hub and of the hole in the cover, which closes by micrometres as the cover is pressed in."""


def grade(part: TurnedPart, race: bool) -> Grade:
    """Grade of a part; `race`: the balls run in it."""
    if part.material == "aluminium":
        return ALUMINIUM_PART
    return RACE_STEEL if race else STEEL_PART


def demanded(part: TurnedPart) -> TurnedPart:
    """The part with the design's demands on its surfaces, and usual ones on functional surfaces that have none."""
    sizes = {segment.surface: 2 * segment.start.r for segment in part.profile}
    own = tuple(_with_run_out(_with_datum(part, surface)) for surface in part.surfaces)
    names = {surface.name for surface in own}
    usual = (surface for surface in _usual(part, sizes) if surface.name in sizes and surface.name not in names)
    return replace(part, surfaces=(*own, *usual))


def _with_datum(part: TurnedPart, surface: Surface) -> Surface:
    """On the sheet of a ring its outside is datum A, for the body's bore is not there."""
    return replace(surface, datum="A") if part.name == "race ring" and surface.name == "outside" else surface


def _with_run_out(surface: Surface) -> Surface:
    """The mounting face runs true to the bore as well as being square to it."""
    if surface.name != "mounting face" or any(each.kind == "run-out" for each in surface.geometrical):
        return surface
    value = next((each.value for each in surface.geometrical if each.datum), FACE_RUNOUT)
    return replace(surface, geometrical=(*surface.geometrical, GeometricalTolerance("run-out", value, "A")))


def _usual(part: TurnedPart, sizes: dict[str, float]) -> Iterator[Surface]:
    """Hub and the cover's hole, which guide the cover, and the faces of a ring."""
    if part.name == "body":
        yield Surface("hub", "cylinder", tolerance_class=HUB, limits=_limits("shaft", HUB, sizes["hub"]),
                      roughness=1.6e-6)  # fmt: skip
    elif part.name == "cover":
        yield Surface("hole", "cylinder", tolerance_class=HOLE, limits=_limits("housing", HOLE, sizes["hole"]))
    else:
        yield Surface("web face", "plane", roughness=0.8e-6,
                      geometrical=(GeometricalTolerance("perpendicularity", FACE_RUNOUT, "A"),))  # fmt: skip


def _limits(seat: str, tolerance_class: str, size: float) -> DeviationLimits | None:
    try:
        return part_limits(seat, tolerance_class, size)
    except AbuError:
        return None


SHOWN: Final = frozenset({"race", "groove", "race circularity", "race surface", "race hardness", "race run-out",
                          "rolling friction"})  # fmt: skip
"""Lines of the drawing table that dimensions and signs say themselves."""


def race_lines(result: "SizeResult") -> "tuple[DrawingLine, ...]":
    """Lines of the drawing table about the race that no sign says."""
    return tuple(line for line in result.drawing if line.feature.startswith("race ") and line.feature not in SHOWN)


def part_notes(result: "SizeResult", part: TurnedPart) -> Iterator[str]:
    """Notes of a part's sheet."""
    race = result.parts.race_part.name == part.name
    made = grade(part, race)
    bought = result.section.bearing_ring
    if part.name == "race ring" and bought is not None:
        yield f"Buy: outer ring of the self-aligning ball bearing {bought}, ISO 15 / GOST 28428; no machining."
        yield "The radius of its sphere is estimated: measure the ring before the drawing is released."
        return
    yield f"Material: {made.name}."
    if race:
        yield f"Heat treatment: {made.treatment} to {result.section.hardness}; no cracks, no burn."
        yield "Grind race, cover seat and bore in one set-up." if part.name == "body" else (
            "Grind race and outside in one set-up.")  # fmt: skip
        yield "No undercut in the race; dents and scratches are not permitted."
        yield from (note_of(line) for line in race_lines(result))
        yield from _pressed_beside(result, part)
    else:
        yield f"Heat treatment: {made.treatment}."
    yield from _stops(result, part)
    yield "Edges by ISO 13715" + (
        " as in the title block." if part.name == "cover" else "; bore and seats 0.3 × 45° on the side of assembly."
    )
    if part.name == "cover":
        yield "The hole leaves clearance to the hub; the cover is held at its outside alone."
    yield "Sizes without tolerance: ISO 2768-mK / GOST 30893.1-m. Sizes in brackets: reference."


def note_of(line: "DrawingLine") -> str:
    """A line of the drawing table as a note: it begins with a capital and ends with a stop."""
    return f"{line.feature[:1].upper()}{line.feature[1:]}: {line.requirement.rstrip('.')}."


UNDERCUT: Final = 2e-3
"""Width of the undercut DIN 509 E 0.4 × 0.2 (HEIDENHAIN CNC PILOT 4290, user's manual: depth 0.2, width 2 mm)."""
SEAT_LEFT: Final = 3
"""A seat is at least so many undercuts long, or it has none."""
CHAMFERS_MM: Final = (0.3, 0.2, 0.1)


def corner_relief(parts: HousingParts) -> tuple[float, float] | None:
    """Chamfer of the cover and largest radius [mm] of the corner in which it stops; None: an undercut, or no corner.

    The chamfer takes half of the stop's height at most, and clears the radius, which is half of it.
    """
    size = parts.dimensions
    if size.ring_end <= size.cover_start or size.web >= SEAT_LEFT * UNDERCUT:
        return None
    stop = drawn(size.seat_radius - size.shoulder_radius)
    chamfer = next((each for each in CHAMFERS_MM if each <= stop / 2 + 1e-9), CHAMFERS_MM[-1])
    return chamfer, chamfer / 2


def _stops(result: "SizeResult", part: TurnedPart) -> Iterator[str]:
    """Corners at the stops of seats: an undercut where there is room, else a small radius and a chamfer."""
    names, relief = {edge.surface for edge in part.profile}, corner_relief(result.parts)
    threaded = result.parts.closure == "screwed"
    if part.name == "cover":
        if threaded:
            yield "Turn the first turn of the thread, at the inner face, down to the core diameter."
        elif relief:
            yield (f"Chamfer {digits(relief[0])} × 45° between outside and inner face: it clears the corner of the "
                   "seat.")  # fmt: skip
        return
    if "shoulder" in names and threaded:
        yield "Thread up to one turn before the stop; no undercut."
    elif "shoulder" in names and relief:
        yield (f"Corner at the stop of the cover seat: radius {digits(relief[1])} at most, no undercut: the seat is "
               f"{digits(drawn(result.parts.dimensions.web))} mm long; the cover's chamfer "
               f"{digits(relief[0])} × 45° clears it.")  # fmt: skip
    elif "shoulder" in names:
        yield "Undercut at the stop of the cover seat: DIN 509 E 0.4 × 0.2 / GOST 8820, within the seat's length."
    if "ring seat" in names:
        yield "Undercut at the stop of the ring seat: DIN 509 E 0.4 × 0.2 / GOST 8820, within the seat's length."


def _pressed_beside(result: "SizeResult", part: TurnedPart) -> Iterator[str]:
    """When the race's limits hold, and by how much a cover that is pressed in beside it widens it."""
    seat, rim = part.surface("cover seat"), result.parts.cover.surface("outside")
    if seat is None or rim is None or seat.limits is None or rim.limits is None:
        return
    growth = shown(seat_growth(result.parts, rim.limits.upper - seat.limits.lower), "um", ".2g")
    yield (f"Measure size, circularity and run-out of the race before the cover is pressed in: the fit widens its "
           f"edge by up to {growth} in diameter (free ring), alike all round if seat and cover are as round as "
           "asked.")  # fmt: skip


DEEPEST_FLAT_MM: Final = 1.0


def _correction(result: "SizeResult") -> str:
    """How the imbalance is corrected: hard steel is ground; the depth leaves two thirds of the wall."""
    size, hard = result.parts.dimensions, result.parts.race_part.name == "body"
    wall = drawn(size.outer_radius - (size.race_radius if hard else size.ring_radius))
    depth = digits(max(0.1, min(DEEPEST_FLAT_MM, math.floor(10 * wall / 3 + 1e-9) / 10)))
    if hard:
        return f"Correct by grinding a flat at the rim's outside, {depth} mm deep at most; do not drill the hard body"
    return f"Correct by drilling the rim's outside, {depth} mm deep at most"


def assembly_notes(result: "SizeResult") -> Iterator[str]:
    """Closure, fill and balance of the assembly."""
    abu = result.autobalancer
    close = "press on the cover evenly" if result.parts.closure == "pressed" else "screw on the cover"
    yield (f"Assembly: wash and oil the race, lay in {abu.ball_count} {abu.corrector}s of one lot before the cover, "
           f"fill the oil, {close} to its stop; its face never stands out of the body's.")  # fmt: skip
    yield f"Fits: {'; '.join(_fits(result))}."
    yield from _balance(result)


def _fits(result: "SizeResult") -> Iterator[str]:
    """Fits between the parts by their classes."""
    parts = {part.name: demanded(part) for part in result.parts.turned}
    pairs = [("cover", holder, "cover seat", "outside")
             for holder in parts if any(edge.surface == "cover seat" for edge in parts[holder].profile)]  # fmt: skip
    if "race ring" in parts:
        pairs.append(("race ring", "body", "ring seat", "outside"))
    for inner, outer, seat, face in (*pairs, ("cover", "body", "hub", "hole")):
        hole, shaft = parts[outer].surface(seat), parts[inner].surface(face)
        size = max(drawn(2 * edge.start.r) for edge in parts[outer].profile if edge.surface == seat)
        if hole is None or shaft is None:
            continue
        if seat == "hub":
            yield f"hole of the cover and hub Ø{digits(size)} {_size(shaft)}/{_size(hole)}"
        elif hole.thread:
            yield f"{inner} {hole.thread}"
        else:
            yield f"{inner} Ø{digits(size)} {_size(hole)}/{_size(shaft)}"


def _size(surface: Surface) -> str:
    """Tolerance class of a surface, or its limits."""
    return surface.tolerance_class or limits_text(surface) or "ISO 2768-m"


def _balance(result: "SizeResult") -> Iterator[str]:
    """Data of the unbalance tolerance: condition, speed, mass, plane, grade, permitted value, method (ISO 21940-11)."""
    abu, grade_name = result.autobalancer, result.eccentricity.balance_grade
    speed = max(result.model.speed_range_rad_per_s)
    mass = abu.mass_g - abu.ball_count * abu.ball_mass_g
    permitted = float(grade_name.removeprefix("G")) / speed * mass
    yield (
        f"Balance (ISO 21940-11): assembled, without {abu.corrector}s and oil; mass {digits(mass, 1)} g; highest speed "
        f"{shown(speed, 'rpm', '.0f')}; grade {grade_name}; one tolerance plane, the middle of the race; "
        f"permissible residual imbalance {permitted:.3g} g·mm about the bore (A). {_correction(result)}."
    )
