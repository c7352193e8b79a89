"""Outer rings of self-aligning ball bearings as races: the design "bearing-ring" takes one from the catalogue."""

import math
from functools import cache
from typing import Final

from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import from_si, shown
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import (
    GROOVE_CLEARANCE,
    LEAST_FILLING,
    RULES,
    BearingRing,
    filling_gap,
    groove_depth,
    groove_radius,
    least_race_radius,
)
from abu_calc.standards.self_aligning import self_aligning_bearings

RIM_SHARE: Final = 0.25
"""Height of the ring's rim at its face over the bearing's whole section, (D − D_1)/(D − d) (assumed)."""
RIM_BAND: Final = 0.04
"""Band of that share, either way (assumed)."""


@formula(
    "Radius of the sphere in the outer ring of a self-aligning ball bearing, estimated",
    "√(D_1²/4 + B²/4), D_1 = D_o − 0.25·(D_o − d_B)",
    "m",
    signs="D_1 B D_o d_B",
    where=(
        "The sphere is centred on the axis, in the middle of the width B. It runs out to the faces, where the ring's "
        "opening is D_1. No standard gives D_1: its share 0.25 of the section has a band of ± 0.04, which moves the "
        "radius by about 2 %. Measure the ring before the drawing is released."
    ),
    assumed="share of the rim; chamfers at the opening are neglected",
    source="geometry; estimated share",
)
def sphere_radius(bore: float, outside_diameter: float, width: float, share: float = RIM_SHARE) -> float:
    """
    >>> round(1e3 * sphere_radius(0.030, 0.062, 0.016), 2)
    28.16
    """
    return math.hypot(outside_diameter - share * (outside_diameter - bore), width) / 2


@cache
def bearing_rings() -> tuple[BearingRing, ...]:
    """Outer rings of all bearings of the catalogue, by the radius of their sphere."""
    rings = (
        BearingRing(each.designation, each.outside_diameter, each.width,
                    sphere_radius(each.bore, each.outside_diameter, each.width))
        for each in self_aligning_bearings()
    )  # fmt: skip
    return tuple(sorted(rings, key=lambda ring: ring.sphere_radius))


def sphere_band(ring: BearingRing) -> tuple[float, float]:
    """Least and largest estimate of the sphere's radius [m]."""
    bearing = next(each for each in self_aligning_bearings() if each.designation == ring.designation)
    sizes = bearing.bore, bearing.outside_diameter, bearing.width
    return sphere_radius(*sizes, RIM_SHARE + RIM_BAND), sphere_radius(*sizes, RIM_SHARE - RIM_BAND)


def ring_of(case: Case, race_radius: float) -> BearingRing | None:
    """The ring whose sphere is nearest to a race radius [m]; None for other designs."""
    if case.autobalancer.design != "bearing-ring":
        return None
    inside = [ring for ring in bearing_rings() if _inside(case, ring)] or bearing_rings()
    return min(inside, key=lambda ring: abs(ring.sphere_radius - race_radius))


def race_groove(case: Case, race_radius: float, ball_radius: float) -> float:
    """Radius of the groove [m]: that of the sphere itself in a bearing's ring, else by the rule of the groove."""
    if case.autobalancer.design == "bearing-ring":
        return race_radius
    return groove_radius(race_radius, ball_radius)


def fitting_rings(case: Case, ball_diameter: float) -> tuple[BearingRing, ...]:
    """Rings in the envelope that are wide enough for the balls, let them in, and leave the hub its wall."""
    return tuple(ring for ring in bearing_rings() if _inside(case, ring) and _takes(case, ring, ball_diameter))


def _inside(case: Case, ring: BearingRing) -> bool:
    outer, width = _envelope(ring)
    abu = case.autobalancer
    return bool(outer <= abu.max_outer_diameter + 1e-9 and width <= abu.max_width + 1e-9)


def _envelope(ring: BearingRing) -> tuple[float, float]:
    """Outer diameter and width [m] of the housing round a ring."""
    rules = RULES["bearing-ring"]
    return ring.outside_diameter + 2 * rules.body_wall, ring.width + 2 * rules.web


def _takes(case: Case, ring: BearingRing, ball_diameter: float) -> bool:
    abu, rules = case.autobalancer, RULES["bearing-ring"]
    bore = abu.bore_diameter
    wall = ring.outside_diameter / 2 - ring.sphere_radius + rules.body_wall
    edge = ring.sphere_radius - groove_depth(ring.sphere_radius, ring.width)
    return (
        ring.width >= ball_diameter + 2 * GROOVE_CLEARANCE - 1e-9
        and wall >= abu.min_wall - 1e-9
        and ring.sphere_radius >= least_race_radius("bearing-ring", bore, ball_diameter) - 1e-9
        and filling_gap(edge, ball_diameter, bore / 2 + rules.hub_wall) >= LEAST_FILLING - 1e-9
    )


def nearest_ring(case: Case, ball_diameter: float) -> str:
    """The ring that takes these balls with the least larger envelope, in words; for the refusal of the design."""
    abu = case.autobalancer
    taking = [ring for ring in bearing_rings() if _takes(case, ring, ball_diameter)]
    if not taking:
        return "No ring of the series 12, 13, 22, 23 takes such balls round this bore with this wall."

    def needed(ring: BearingRing) -> tuple[float, float]:
        outer, width = (from_si(length, "mm") for length in _envelope(ring))
        return outer, width

    def excess(ring: BearingRing) -> float:
        outer, width = needed(ring)
        return max(0.0, outer - abu.max_outer_diameter_mm) + max(0.0, width - abu.max_width_mm)

    ring = min(taking, key=excess)
    outer, width = needed(ring)
    return (
        f"The nearest that fits is {ring.designation} (R {shown(ring.sphere_radius, 'mm', '.2f')}): specify "
        f"max_outer_diameter_mm = {outer:g} and max_width_mm = {width:g} at least."
    )


def pinned_ring(case: Case, race_radius: float) -> BearingRing | None:
    """The ring in the envelope whose sphere is nearest to a pinned race radius [m]; None beyond its band."""
    ring = ring_of(case, race_radius)
    if ring is None:
        return None
    low, high = sphere_band(ring)
    return ring if low - 1e-9 <= race_radius <= high + 1e-9 else None


def ring_check(case: Case, race_radius: float) -> tuple[Check, ...]:
    """Warning that the sphere of a bearing's ring is estimated; nothing for other designs."""
    ring = ring_of(case, race_radius)
    if ring is None:
        return ()
    measured = case.autobalancer.race_radius_mm is not None
    known = "as the file gives it; estimated" if measured else "estimated"
    message = (
        f"The race is the outer ring of bearing {ring.designation}, "
        f"Ø{shown((ring.outside_diameter, ring.width), 'mm', 'g', ' × ')}. The radius of its sphere is {known}: "
        f"{shown(sphere_band(ring), 'mm', '.2f')}"
    )
    return (
        coded("ABU312", verdict(True, safe=measured), message, race_radius, remedy=None if measured else
              "Measure the sphere of the ring, and specify it as autobalancer.race_radius_mm."),
    )  # fmt: skip
