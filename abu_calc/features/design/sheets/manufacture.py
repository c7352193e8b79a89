"""Grades, heat treatment, demands and notes of the parts: engineering practice (assumed) where the design has none."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.units import from_si, to_si
from abu_calc.reporting.drawings.shapes import digits
from abu_calc.sizing.parts.housing_parts import TurnedPart
from abu_calc.sizing.parts.surfaces import GeometricalTolerance, Surface
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits

if TYPE_CHECKING:
    from abu_calc.features.design.records import DrawingLine
    from abu_calc.features.design.study import SizeResult


class Grade(NamedTuple):
    """A material by its names in EN and GOST, and its heat treatment."""

    name: str
    treatment: str


RACE_STEEL: Final = Grade("100Cr6 (1.3505) EN ISO 683-17 / ШХ15 GOST 801", "harden and temper")
STEEL_PART: Final = Grade("C45+N (1.0503) EN ISO 683-1 / 45 GOST 1050", "normalised; no further heat treatment")
ALUMINIUM_PART: Final = Grade("EN AW-6082 T6 EN 573-3 / АД35.Т1 GOST 4784", "T6 as delivered")
BALL_STEEL: Final = Grade("100Cr6, ISO 3290-1 / ШХ15, GOST 3722", "as delivered")
GENERAL_ROUGHNESS: Final = "Ra 3.2"
FACE_RUNOUT: Final = to_si(0.01, "mm")
"""Run-out and perpendicularity of the mounting face."""
SEATS: Final[dict[str, tuple[str, str]]] = {"steel": ("H7", "p6"), "aluminium": ("H7", "r6")}
"""Fit of the cover, and of the ring, in a body of this material."""


def grade(part: TurnedPart, race: bool) -> Grade:
    """Grade of a part; `race`: the balls run in it."""
    if part.material == "aluminium":
        return ALUMINIUM_PART
    return RACE_STEEL if race else STEEL_PART


def demanded(result: "SizeResult", part: TurnedPart) -> TurnedPart:
    """The part with demands on every functional surface: the design's own, and usual ones where it has none."""
    own = {surface.name for surface in part.surfaces}
    sizes = {segment.surface: 2 * segment.start.r for segment in part.profile}
    usual = (surface for surface in _usual(result, part, sizes) if surface.name in sizes and surface.name not in own)
    return replace(part, surfaces=(*part.surfaces, *usual))


def _usual(result: "SizeResult", part: TurnedPart, sizes: dict[str, float]) -> Iterator[Surface]:
    race = result.parts.race_part.name == part.name
    if race:
        yield _race(result)
        yield _seat("cover seat", sizes, SEATS[result.parts.body.material][0], "", frames=_form("run-out", 0.02, "A"))
    if part.name == "body":
        bore = _bore(result)
        round_ = None if bore is None else math.floor(from_si(bore.tolerance, "um") / 2) / 1000
        yield Surface("bore", "cylinder", sizes["bore"], tolerance_class=result.section.bore_class, limits=bore, roughness=to_si(0.4, "um"),
                      geometrical=() if not round_ else _form("cylindricity", round_), datum="A")  # fmt: skip
        across = GeometricalTolerance("perpendicularity", FACE_RUNOUT, "A")
        yield Surface("mounting face", "plane", roughness=to_si(0.8, "um"),
                      geometrical=(across, GeometricalTolerance("run-out", FACE_RUNOUT, "A")), datum="B")  # fmt: skip
        yield Surface("hub end", "plane", roughness=to_si(0.8, "um"), geometrical=_form("parallelism", 0.01, "B"))
        hub = _limits("shaft", "h7", sizes["hub"])
        yield Surface("hub", "cylinder", tolerance_class="h7", limits=hub, roughness=to_si(1.6, "um"))
        yield _seat("ring seat", sizes, SEATS[part.material][0], "", frames=_form("run-out", 0.01, "A"))
    elif part.name == "cover":
        yield _seat("outside", sizes, "", SEATS[part.material][1])
        yield Surface("hole", "cylinder", plus_minus=None, tolerance_class="H8",
                      limits=_limits("housing", "H8", sizes["hole"]))  # fmt: skip
    else:
        yield _seat("outside", sizes, "", SEATS[result.parts.body.material][1], datum="A")
        yield Surface("web face", "plane", roughness=to_si(0.8, "um"),
                      geometrical=_form("perpendicularity", 0.01, "A"))  # fmt: skip


def _bore(result: "SizeResult") -> DeviationLimits | None:
    limits = result.section.bore_limits_um
    return None if limits is None else DeviationLimits(*(to_si(limit, "um") for limit in limits))


def _form(kind: str, value: float, datum: str = "") -> tuple[GeometricalTolerance, ...]:
    return (GeometricalTolerance(kind, to_si(value, "mm"), datum),)  # type: ignore[arg-type]


def _race(result: "SizeResult") -> Surface:
    section = result.section
    return Surface(
        "race", "torus" if result.autobalancer.groove_radius_mm else "cylinder",
        plus_minus=to_si(2 * section.race_tolerance_mm, "mm"), groove_plus_minus=to_si(section.groove_tolerance_mm, "mm"),
        roughness=to_si(section.roughness_Ra_um, "um"), hardness=section.hardness,
        geometrical=(*_form("circularity", section.circularity_um / 1000),
                     *_form("run-out", section.runout_um / 1000, "A")),
    )  # fmt: skip


def _seat(
    name: str, sizes: dict[str, float], hole: str, shaft: str, *, frames: tuple[GeometricalTolerance, ...] = (),
    datum: str = "",
) -> Surface:  # fmt: skip
    size = sizes.get(name, 0.0)
    limits = _limits("housing", hole, size) if hole else _limits("shaft", shaft, size)
    return Surface(name, "cylinder", size, tolerance_class=hole or shaft, limits=limits, roughness=to_si(0.8, "um"),
                   geometrical=frames, datum=datum)  # fmt: skip


def _limits(seat: str, tolerance_class: str, size: float) -> DeviationLimits | None:
    try:
        return part_limits(seat, tolerance_class, size)  # type: ignore[arg-type]
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
    yield f"Material: {made.name}."
    if race:
        yield (f"Heat treatment: {made.treatment} to {result.section.hardness}; hard to a depth of at least "
               f"{digits(result.section.case_depth_mm)} mm below the ground race. No cracks, no grinding burn.")  # fmt: skip
        yield "Grind race, cover seat and bore in one set-up." if part.name == "body" else (
            "Grind race and outside in one set-up.")  # fmt: skip
        yield "No undercut in the race; dents and scratches are not permitted."
        yield from (f"{line.feature}: {line.requirement}" for line in race_lines(result))
    else:
        yield f"Heat treatment: {made.treatment}."
    if any(segment.surface in ("cover seat", "ring seat") for segment in part.profile):
        yield "Undercut at the stop of each seat: DIN 509 E 0.4 × 0.2 / GOST 8820; it stays inside the seat's length."
    yield "Edges by ISO 13715 as in the title block; edges of seats 0.3 × 45° on the side of assembly."
    if part.name == "cover":
        yield "The hole leaves clearance to the hub; the cover is held at its outside alone."
    yield "Sizes without tolerance: ISO 2768-mK / GOST 30893.1-m. Sizes in brackets follow from others."


def assembly_notes(result: "SizeResult") -> Iterator[str]:
    """Closure, fill and balance of the assembly."""
    abu = result.autobalancer
    close = "press on the cover evenly" if result.parts.closure == "pressed" else "screw on the cover"
    yield (f"Assembly: wash and oil the race, lay in {abu.ball_count} {abu.corrector}s of one lot before the cover, fill "
           f"the oil, {close} to its stop; its face is flush with the body.")  # fmt: skip
    yield f"Fits: {'; '.join(_fits(result))}."
    yield from _balance(result)


def _fits(result: "SizeResult") -> Iterator[str]:
    """Fits between the parts by their classes."""
    parts = {part.name: demanded(result, part) for part in result.parts.turned}
    pairs = [("cover", result.parts.race_part.name, "cover seat", "outside"), ("cover", "body", "hub", "hole")]
    if "race ring" in parts:
        pairs.append(("race ring", "body", "ring seat", "outside"))
    for inner, outer, seat, face in pairs:
        hole, shaft = parts[outer].surface(seat), parts[inner].surface(face)
        if seat == "hub":
            hole, shaft = shaft, hole
        if hole is not None and shaft is not None and hole.tolerance_class and shaft.tolerance_class:
            size = max(from_si(2 * e.start.r, "mm") for e in parts[outer].profile if e.surface == seat)
            name = "hole of the cover and hub" if seat == "hub" else inner
            yield f"{name} Ø{digits(size)} {hole.tolerance_class}/{shaft.tolerance_class}"


def _balance(result: "SizeResult") -> Iterator[str]:
    """Data of the unbalance tolerance: condition, speed, mass, plane, grade, permitted value, method (ISO 21940-11)."""
    abu, grade_name = result.autobalancer, result.eccentricity.balance_grade
    speed = max(result.model.speed_range_rad_per_s)
    mass = abu.mass_g - abu.ball_count * abu.ball_mass_g
    permitted = float(grade_name.removeprefix("G")) / speed * mass
    yield (
        f"Balance (ISO 21940-11): assembled, without {abu.corrector}s and oil; mass {digits(mass, 1)} g; highest speed "
        f"{from_si(speed, 'rpm'):.0f} rpm; grade {grade_name}; one tolerance plane, the middle of the race; permissible "
        f"residual imbalance {permitted:.3g} g·mm about the bore (A). Correct by drilling the rim's outside, ≤ 1 mm deep."
    )
