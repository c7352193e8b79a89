"""Housing of the race: dimensions and mass by rules that are stated here and printed in every report."""

import math
from typing import Final, Literal

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass

Design = Literal["one-piece", "bearing-ring", "light"]

STEEL: Final = 7800.0
ALUMINIUM: Final = 2700.0

HUB_CLEARANCE: Final = 0.5e-3
"""Distance between balls and hub [m]."""

GROOVE_CLEARANCE: Final = 0.3e-3
"""Distance between balls and webs [m], each side."""


@dataclass(frozen=True)
class Rules:
    """Thicknesses [m] and densities [kg/m³] of one design; the wall of the race comes from the file."""

    text: str
    web: float
    hub_wall: float
    body_wall: float
    body_density: float


RULES: Final[dict[Design, Rules]] = {
    "one-piece": Rules(
        "one-piece: steel body with the race ground in it; wall as given, webs 1.5 mm, hub wall 2.5 mm",
        1.5e-3, 2.5e-3, 0.0, STEEL,
    ),
    "bearing-ring": Rules(
        "bearing-ring: race ring, wall as given, pressed into a steel body of 2 mm wall, webs 1.5 mm, hub wall 2.5 mm",
        1.5e-3, 2.5e-3, 2e-3, STEEL,
    ),
    "light": Rules(
        "light: hard steel ring, wall as given, in an aluminium body with 2 mm wall, webs 2 mm, hub wall 3 mm",
        2e-3, 3e-3, 2e-3, ALUMINIUM,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Housing:
    """Outer dimensions [m] and mass [kg] of a housing without balls."""

    outer_diameter: float
    width: float
    mass: float


@formula(
    "Radius of the toroidal groove",
    "R_g = r + (5/7)(R − r), from 5(R−r) = 7(R_g−r)",
    "m",
    where=(
        "With this radius, the ball's natural frequency across the groove equals the speed, whatever the speed is. "
        "Axial runout then shakes out dry friction. If the ball is free to spin about the contact normal, the square "
        "of its frequency is Ω²[(5/7)(R−r)/(R_g−r) + 2/7]. The resonance is then at R_g = R. A real ball lies between "
        "both cases."
    ),
    assumed="a ball that does not spin about the contact normal",
    source="Kladiev 1996, (12); its meaning is derived here",
)
def groove_radius(race_radius: float, ball_radius: float) -> float:
    """
    >>> round(1e3 * groove_radius(30e-3, 8e-3), 3)
    23.714
    """
    return ball_radius + 5 / 7 * (race_radius - ball_radius)


def least_race_radius(design: Design, bore_diameter: float, ball_diameter: float) -> float:
    """Smallest race radius [m] that leaves the hub its wall and the balls their clearance."""
    return bore_diameter / 2 + RULES[design].hub_wall + HUB_CLEARANCE + ball_diameter


def greatest_race_radius(design: Design, outer_diameter: float, wall: float) -> float:
    """Largest race radius [m] inside an outer diameter."""
    return outer_diameter / 2 - wall - RULES[design].body_wall


def width(design: Design, ball_diameter: float) -> float:
    """Width of the housing [m]: ball, clearances, two webs."""
    return ball_diameter + 2 * (GROOVE_CLEARANCE + RULES[design].web)


def groove_depth(groove: float, inner_width: float) -> float:
    """Depth of the groove at the edges of the race [m], s = R_g − √(R_g² − (b/2)²), b width between the webs.

    >>> round(1e3 * groove_depth(24.43e-3, 16.6e-3), 2)
    1.45
    """
    return groove - math.sqrt(groove**2 - inner_width**2 / 4)


@dataclass(frozen=True)
class BearingRing:
    """Outer ring of a self-aligning ball bearing: designation, outside diameter, width, radius of its sphere [m]."""

    designation: str
    outside_diameter: float
    width: float
    sphere_radius: float


@dataclass(frozen=True)
class HousingDimensions:
    """Lengths [m] from which the parts follow; `groove_radius` None: a straight race, for rollers.

    `ring_radius`: outside of the race's own ring, or of the wall that has it. `ring_end`: open end of that ring on the
    axis. `seat_radius`: radius at which the cover is seated.
    """

    bore_radius: float
    hub_radius: float
    race_radius: float
    groove_radius: float | None
    ring_radius: float
    outer_radius: float
    seat_radius: float
    web: float
    inner_width: float
    ring_end: float

    @property
    def width(self) -> float:
        """Width of the housing [m]."""
        return self.inner_width + 2 * self.web

    @property
    def cover_start(self) -> float:
        """Place of the cover's inner face on the axis [m]."""
        return self.web + self.inner_width

    @property
    def middle(self) -> float:
        """Place of the balls' plane on the axis [m]."""
        return self.web + self.inner_width / 2

    @property
    def has_ring(self) -> bool:
        """True if the race is in a ring of its own."""
        return self.outer_radius > self.ring_radius

    @property
    def sagitta(self) -> float:
        """Depth of the groove at the edges of the race [m]."""
        return 0.0 if self.groove_radius is None else groove_depth(self.groove_radius, self.inner_width)

    @property
    def shoulder_radius(self) -> float:
        """Radius of the race at its edges [m]."""
        return self.race_radius - self.sagitta


def dimensions(
    design: Design, race_radius: float, ball_diameter: float, bore_diameter: float, wall: float, grooved: bool = True,
    ring: BearingRing | None = None,
) -> HousingDimensions:  # fmt: skip
    """Lengths of a housing by the rules of its design; `ring`: the bearing's ring that takes the place of the wall."""
    rules = RULES[design]
    groove = groove_radius(race_radius, ball_diameter / 2) if grooved else None
    inner, ring_radius = ball_diameter + 2 * GROOVE_CLEARANCE, race_radius + wall
    ring_end, seat = inner + 2 * rules.web, race_radius
    if ring is not None:
        inner, ring_radius, groove = ring.width, ring.outside_diameter / 2, race_radius
        ring_end, seat = rules.web + inner, ring_radius
    return HousingDimensions(
        bore_radius=bore_diameter / 2, hub_radius=bore_diameter / 2 + rules.hub_wall, race_radius=race_radius,
        groove_radius=groove, ring_radius=ring_radius, outer_radius=ring_radius + rules.body_wall, seat_radius=seat,
        web=rules.web, inner_width=inner, ring_end=ring_end,
    )  # fmt: skip


LEAST_FILLING: Final = 0.1e-3
"""Least gap at which a ball passes between hub and edge of the race [m] (assumed)."""


@formula(
    "Gap through which a ball passes from the open side to its race",
    "R_k − d − R_h",
    "m",
    where=(
        "R_k is the radius of the race at its edge, R_h that of the hub, d the diameter of the balls. The last ball "
        "passes between the others, which are pushed together, if the chord to each of them is at least d."
    ),
    source="geometry",
)
def filling_gap(edge_radius: float, ball_diameter: float, hub_radius: float) -> float:
    """
    >>> round(1e3 * filling_gap(29.6e-3, 15.9e-3, 12.5e-3), 2)
    1.2
    """
    return edge_radius - ball_diameter - hub_radius


def last_ball_passes(size: HousingDimensions, count: int, ball_diameter: float) -> bool:
    """True if the last ball, at the race's edge, passes between the others, pushed together in the race."""
    pitch, entry = size.race_radius - ball_diameter / 2, size.shoulder_radius - ball_diameter / 2
    half = math.pi - math.asin(min(1.0, ball_diameter / 2 / pitch)) * (count - 2)
    if half <= 0:
        return False
    squared = entry**2 + pitch**2 - 2 * entry * pitch * math.cos(min(half, math.pi))
    return math.sqrt(squared) >= ball_diameter * (1 - 1e-9)


def balls_go_in(size: HousingDimensions, count: int, ball_diameter: float) -> bool:
    """True if all balls go in through the open side."""
    gap = filling_gap(size.shoulder_radius, ball_diameter, size.hub_radius)
    return gap >= LEAST_FILLING - 1e-9 and last_ball_passes(size, count, ball_diameter)


@formula(
    "Dimensions and mass of the housing, from rings and discs",
    where=(
        "The ring is of steel, from R to R plus the wall. Its groove is filled toward the edges; the volume of the "
        "turned circular arc is exact. Body wall, webs and hub are of the body's material. The rules of the design "
        "give their thicknesses. The body's own web reaches its wall, the cover's web fits inside the ring. A race "
        "for rollers is straight, without a groove. The ring of a bearing has the width of its designation, and the "
        "cover is seated beside it in the body."
    ),
    assumed="the drawing gives the final dimensions",
    source="own rules",
)
def housing(
    design: Design, race_radius: float, ball_diameter: float, bore_diameter: float, wall: float, grooved: bool = True,
    bearing_ring: BearingRing | None = None,
) -> Housing:  # fmt: skip
    size = dimensions(design, race_radius, ball_diameter, bore_diameter, wall, grooved, bearing_ring)
    outer, hub = size.ring_radius, size.hub_radius
    fill = _fill(race_radius, size.groove_radius, size.inner_width) if size.groove_radius else 0.0
    ring = _ring(race_radius, outer, size.ring_end - size.web) + fill
    body = (
        _ring(outer, size.outer_radius, size.width)
        + _ring(hub, outer, size.web)
        + _ring(hub, size.seat_radius, size.web)
        + _ring(size.bore_radius, hub, size.width)
    )
    return Housing(2 * size.outer_radius, size.width, STEEL * ring + RULES[design].body_density * body)


def _fill(race_radius: float, groove: float, inner_width: float) -> float:
    """Volume [m³] between the cylinder of the race and its groove: π∫(R² − (c + √(R_g² − x²))²)dx, c = R − R_g."""
    centre, half = race_radius - groove, inner_width / 2
    arc = half * math.sqrt(groove**2 - half**2) + groove**2 * math.asin(half / groove)
    return math.pi * (2 * half * (race_radius**2 - centre**2 - groove**2 + half**2 / 3) - 2 * centre * arc)


def _ring(inner: float, outer: float, length: float) -> float:
    return math.pi * (outer**2 - inner**2) * length
