"""Housing of the race: dimensions and mass by rules that are stated here and printed in every report."""

import math
from typing import Final, Literal

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import to_si

Design = Literal["one-piece", "bearing-ring", "light"]

STEEL: Final = 7800.0
ALUMINIUM: Final = 2700.0

HUB_CLEARANCE: Final = to_si(0.5, "mm")
"""Distance between balls and hub [m]."""

GROOVE_CLEARANCE: Final = to_si(0.3, "mm")
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
        to_si(1.5, "mm"),
        to_si(2.5, "mm"),
        0.0,
        STEEL,
    ),
    "bearing-ring": Rules(
        "bearing-ring: race ring, wall as given, pressed into a steel body of 2 mm wall, webs 1.5 mm, hub wall 2.5 mm",
        to_si(1.5, "mm"),
        to_si(2.5, "mm"),
        to_si(2.0, "mm"),
        STEEL,
    ),
    "light": Rules(
        "light: hard steel ring, wall as given, in an aluminium body with 2 mm wall, webs 2 mm, hub wall 3 mm",
        to_si(2.0, "mm"),
        to_si(3.0, "mm"),
        to_si(2.0, "mm"),
        ALUMINIUM,
    ),
}


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


@formula(
    "Dimensions and mass of the housing, from rings and discs",
    where=(
        "The ring is of steel, from R to R plus the wall. Its groove is filled toward the edges; the volume of the "
        "turned circular arc is exact. Body wall, webs and hub are of the body's material. The rules of the design "
        "give their thicknesses. The body's own web reaches its wall, the cover's web fits inside the ring. A race "
        "for rollers is straight, without a groove."
    ),
    assumed="the drawing gives the final dimensions",
    source="own rules",
)
def housing(
    design: Design, race_radius: float, ball_diameter: float, bore_diameter: float, wall: float, grooved: bool = True
) -> Housing:
    rules = RULES[design]
    inner_width, whole_width = ball_diameter + 2 * GROOVE_CLEARANCE, width(design, ball_diameter)
    outer, hub = race_radius + wall, bore_diameter / 2 + rules.hub_wall
    fill = _fill(race_radius, groove_radius(race_radius, ball_diameter / 2), inner_width) if grooved else 0.0
    ring = _ring(race_radius, outer, whole_width - rules.web) + fill
    body = (
        _ring(outer, outer + rules.body_wall, whole_width)
        + _ring(hub, outer, rules.web)
        + _ring(hub, race_radius, rules.web)
        + _ring(bore_diameter / 2, hub, whole_width)
    )
    return Housing(2 * (outer + rules.body_wall), whole_width, STEEL * ring + rules.body_density * body)


def _fill(race_radius: float, groove: float, inner_width: float) -> float:
    """Volume [m³] between the cylinder of the race and its groove: π∫(R² − (c + √(R_g² − x²))²)dx, c = R − R_g."""
    centre, half = race_radius - groove, inner_width / 2
    arc = half * math.sqrt(groove**2 - half**2) + groove**2 * math.asin(half / groove)
    return math.pi * (2 * half * (race_radius**2 - centre**2 - groove**2 + half**2 / 3) - 2 * centre * arc)


def _ring(inner: float, outer: float, length: float) -> float:
    return math.pi * (outer**2 - inner**2) * length
