"""Section through the axis: outlines of the parts that make the housing, by the rules of its design.

Outlines lie in the half plane above the axis: x along it [m], from the closed web's face, r from it [m]. A vertex
carries the bulge of the edge that leaves it, the tangent of a quarter of its arc, positive counter-clockwise.
"""

import math
from dataclasses import replace
from itertools import pairwise
from typing import NamedTuple

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, GROOVE_CLEARANCE, RULES, STEEL, groove_depth, groove_radius

MATERIALS = {STEEL: "steel", ALUMINIUM: "aluminium"}


class Vertex(NamedTuple):
    """A corner of an outline."""

    x: float
    r: float
    bulge: float = 0.0


Outline = tuple[Vertex, ...]
"""Closed, counter-clockwise."""


@dataclass(frozen=True)
class TurnedPart:
    """A turned part: its name, density [kg/m³], and half section."""

    name: str
    density: float
    outline: Outline

    @property
    def area(self) -> float:
        """Area of the half section [m²]."""
        return _moments(self.outline)[0]

    @property
    def mass(self) -> float:
        """Mass of the part [kg]."""
        return self.density * volume_of_revolution(self.outline)

    @property
    def material(self) -> str:
        """Material in a word."""
        return MATERIALS[self.density]


@dataclass(frozen=True)
class HousingSection:
    """Lengths [m] of a housing and its parts; `groove_radius` None: a straight race, for rollers.

    `shoulder_radius`: where the groove meets its webs; `ring_radius`: outside of the wall of the race.
    """

    bore_radius: float
    hub_radius: float
    race_radius: float
    shoulder_radius: float
    groove_radius: float | None
    ring_radius: float
    outer_radius: float
    web: float
    inner_width: float
    width: float
    parts: tuple[TurnedPart, ...]


def section(case: Case, candidate: Candidate) -> HousingSection:
    """The section of a candidate: body, cover, and the race ring of those designs that have one."""
    abu = case.autobalancer
    rules, bore, wall = RULES[abu.design], to_si(abu.bore_diameter_mm, "mm") / 2, to_si(abu.min_wall_mm, "mm")
    inner, race = candidate.ball_diameter + 2 * GROOVE_CLEARANCE, candidate.race_radius
    groove = groove_radius(race, candidate.ball_diameter / 2) if abu.corrector == "ball" else None
    depth = 0.0 if groove is None else groove_depth(groove, inner)
    cut = HousingSection(
        bore, bore + rules.hub_wall, race, race - depth, groove, race + wall, race + wall + rules.body_wall, rules.web,
        inner, inner + 2 * rules.web, (),
    )  # fmt: skip
    return replace(cut, parts=_parts(cut, rules.body_density))


def _parts(cut: HousingSection, density: float) -> tuple[TurnedPart, ...]:
    """One piece has the race in its body; else a ring is pressed in as far as the closed web."""
    cover = TurnedPart("cover", density, _box(cut.width - cut.web, cut.width, cut.hub_radius, cut.race_radius))
    hub = Vertex(0, cut.bore_radius), Vertex(cut.width, cut.bore_radius), Vertex(cut.width, cut.hub_radius)
    web, rim = Vertex(cut.web, cut.hub_radius), (Vertex(cut.width, cut.outer_radius), Vertex(0, cut.outer_radius))
    # The body goes round counter-clockwise: along the bore, up the hub, back to the web, up it, out along the wall.
    race = _race(cut)
    if cut.outer_radius == cut.ring_radius:
        return TurnedPart("body", density, (*hub, web, *race, *rim)), cover
    seat = Vertex(cut.web, cut.ring_radius), Vertex(cut.width, cut.ring_radius)
    ring = *race, Vertex(cut.width, cut.ring_radius), Vertex(cut.web, cut.ring_radius)
    return TurnedPart("body", density, (*hub, web, *seat, *rim)), TurnedPart("race ring", STEEL, ring), cover


def _race(cut: HousingSection) -> Outline:
    """Outline from the closed web along the groove, and out to the open face along the seat of the cover."""
    left, right = cut.web, cut.width - cut.web
    sagitta = cut.race_radius - cut.shoulder_radius
    start = Vertex(left, cut.shoulder_radius, -2 * sagitta / cut.inner_width)
    step = (Vertex(right, cut.race_radius),) if sagitta else ()
    return start, Vertex(right, cut.shoulder_radius), *step, Vertex(cut.width, cut.race_radius)


def _box(left: float, right: float, inner: float, outer: float) -> Outline:
    return Vertex(left, inner), Vertex(right, inner), Vertex(right, outer), Vertex(left, outer)


def volume_of_revolution(outline: Outline) -> float:
    """Volume of an outline turned round the axis [m³], 2π·∫r dA (Pappus–Guldin).

    The polygon by Green's theorem; each arc adds its segment at its centroid.
    """
    return 2 * math.pi * _moments(outline)[1]


def _moments(outline: Outline) -> tuple[float, float]:
    """Area and ∫r dA."""
    area = moment = 0.0
    for here, there in pairwise((*outline, outline[0])):
        cross = here.x * there.r - there.x * here.r
        segment, centroid = _segment(here, there)
        area += cross / 2 + segment
        moment += cross * (here.r + there.r) / 6 + segment * centroid
    return area, moment


def _segment(here: Vertex, there: Vertex) -> tuple[float, float]:
    """Area between chord and arc, positive where it adds to what lies on the left, and r of its centroid."""
    if not here.bulge:
        return 0.0, 0.0
    angle, chord = 4 * math.atan(here.bulge), math.hypot(there.x - here.x, there.r - here.r)
    radius = chord / (2 * math.sin(abs(angle) / 2))
    area = radius**2 / 2 * (abs(angle) - math.sin(abs(angle)))
    # Seen along the chord a counter-clockwise arc bulges to the right.
    from_chord = (4 * radius * math.sin(abs(angle) / 2) ** 3 / (3 * (abs(angle) - math.sin(abs(angle))))
                  - radius * math.cos(angle / 2))  # fmt: skip
    side = math.copysign(1.0, angle)
    return side * area, (here.r + there.r) / 2 - side * from_chord * (there.x - here.x) / chord
