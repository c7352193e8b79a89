"""Two-lobe ovality that balls cause in their race.

An oval race has two lobes, and these hold balls in their places.
"""

from abu_calc.frozen import dataclass
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, GROOVE_CLEARANCE, RULES, STEEL
from abu_calc.sizing.stress import STEEL_MODULUS, hinged_wall_lobes, ring_flexure, wall_lobes, web_lobes
from abu_calc.units import to_si

MODULUS = {STEEL: STEEL_MODULUS, ALUMINIUM: 70e9}
"""Elastic modulus of the body, by its density [Pa]."""


@dataclass(frozen=True)
class Roundness:
    """Amplitudes [m] of the race's two lobes under two opposite balls at the top of the speed range.

    `lobes`: as drawn, web and cover both carry the wall and the spindle holds the hub. `unaided`: only one web carries
    it, like a hinge, and the hub is free, as a cover fitted with clearance leaves it. `free_ring`: what the diameter
    would gain with no web at all.
    """

    lobes: float
    unaided: float
    free_ring: float


def roundness(case: Case, force: float, race_radius: float, ball_diameter: float) -> Roundness:
    """Roundness of a housing by its rules.

    The webs reach from the hub to the race. The race ring alone is the wall between them.
    """
    abu = case.autobalancer
    rules, wall = RULES[abu.design], to_si(abu.min_wall_mm, "mm")
    hub, between = to_si(abu.bore_diameter_mm, "mm") / 2 + rules.hub_wall, ball_diameter + 2 * GROOVE_CLEARANCE
    modulus = MODULUS[rules.body_density]
    held = web_lobes(force / 2, race_radius, 0.0, rules.web, modulus)
    unheld = web_lobes(force, race_radius, hub, rules.web, modulus)
    free = ring_flexure(force, race_radius, between + 2 * rules.web, wall)
    return Roundness(
        lobes=min(held + wall_lobes(force, race_radius, between, wall), free / 2),
        unaided=min(unheld + hinged_wall_lobes(force, race_radius, between, wall), free / 2),
        free_ring=free,
    )
