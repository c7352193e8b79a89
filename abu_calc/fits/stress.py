"""Stress in a ring pressed on a shaft or into a housing, by Lamé."""

from typing import Final, NamedTuple

from abu_calc.fits.ranges import SEAT_DIAMETER, TUBE_RATIO
from abu_calc.formula import formula
from abu_calc.standards.balls import Material

PERMITTED_RING_STRESS: Final = 400e6
"""Hoop stress [Pa] permitted in a ring of bearing steel: handbook value quoted by Afanasiev 2015, unverified."""

SECTION_SHARE: Final = 0.28
"""Share of the section height (D − d) that a ring has as a plain tube: mean diameter of the race, assumed.

It gives d/d₁ = 0.826 for the 80 × 140 mm bearing of Afanasiev 2015.
"""


class Tube(NamedTuple):
    """One part of a joint: ratio of its inner to its outer diameter (0: solid shaft, endless housing), material."""

    ratio: float
    material: Material

    @property
    def hoop_at_bore(self) -> float:
        """Hoop stress at the bore per pressure inside: (1+q²)/(1−q²)."""
        return (1 + TUBE_RATIO.check(self.ratio) ** 2) / (1 - self.ratio**2)

    @property
    def hoop_under_pressure_outside(self) -> float:
        """Magnitude of the (compressive) hoop stress at the bore per pressure outside: 2/(1−q²)."""
        return 2 / (1 - TUBE_RATIO.check(self.ratio) ** 2)


def inner_ring_diameter(bore: float, outer: float) -> float:
    """Outer diameter [m] of the inner ring as a plain tube: d₁ = d + 0.28·(D − d).

    Range: usual sections of ball and roller bearings; assumed.

    >>> round(0.080 / inner_ring_diameter(0.080, 0.140), 3)
    0.826
    """
    return bore + SECTION_SHARE * (outer - bore)


def outer_ring_diameter(bore: float, outer: float) -> float:
    """Inner diameter [m] of the outer ring as a plain tube: D₁ = D − 0.28·(D − d). Range as for the inner ring."""
    return outer - SECTION_SHARE * (outer - bore)


@formula(
    "Pressure between two pressed tubes",
    "p = (δ/d)/{[(1+q₂²)/(1−q₂²) + ν₂]/E₂ + [(1+q₁²)/(1−q₁²) − ν₁]/E₁}",
    "Pa",
    where=("No pressure without interference."),
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="elastic, long tubes of equal length",
    source="Lamé; DIN 7190-1:2017",
)
def contact_pressure(interference: float, diameter: float, male: Tube, female: Tube) -> float:
    around = (female.hoop_at_bore + female.material.poisson_ratio) / female.material.youngs_modulus
    inside = (male.hoop_at_bore - male.material.poisson_ratio) / male.material.youngs_modulus
    return max(interference, 0.0) / SEAT_DIAMETER.check(diameter) / (around + inside)


@formula(
    "Largest hoop stress in an inner ring, tension at its bore",
    "p·(1+q²)/(1−q²)",
    "Pa",
    signs="E δ d",
    where="On a solid shaft of the same steel E·δ·(1+q²)/(2d).",
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="as of the contact pressure",
    source="Lamé",
)
def inner_ring_stress(interference: float, diameter: float, shaft: Tube, ring: Tube) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> round(1e-6 * inner_ring_stress(45e-6, 0.080, Tube(0.0, steel), Tube(80 / 96.8, steel)), 1)
    97.5
    """
    return contact_pressure(interference, diameter, shaft, ring) * ring.hoop_at_bore


@formula(
    "Change of the diameter of a ring's raceway under the pressure of its seat",
    "2·p·q·d/[(1−q²)·E]",
    "m",
    shown="um",
    signs="δ",
    where=(
        "An inner ring grows outside, an outer one shrinks inside, by the same formula. On a solid shaft of the "
        "ring's steel that is q·δ."
    ),
    checked=(TUBE_RATIO,),
    assumed="as of the contact pressure",
    source="Lamé",
)
def raceway_change(pressure: float, diameter: float, ring: Tube) -> float:
    """
    >>> steel = Material("steel", 7800.0, 206e9, 0.3, 12e-6)
    >>> ring = Tube(0.8, steel)
    >>> round(1e6 * raceway_change(contact_pressure(10e-6, 0.080, Tube(0.0, steel), ring), 0.080, ring), 6)
    8.0
    """
    return pressure * ring.hoop_under_pressure_outside * ring.ratio * diameter / ring.material.youngs_modulus


@formula(
    "Magnitude of the largest hoop stress in an outer ring, compression at its bore",
    "2p/(1−q²)",
    "Pa",
    checked=(TUBE_RATIO, SEAT_DIAMETER),
    assumed="as of the contact pressure",
    source="Lamé",
)
def outer_ring_stress(interference: float, diameter: float, ring: Tube, housing: Tube) -> float:
    return contact_pressure(interference, diameter, ring, housing) * ring.hoop_under_pressure_outside
