"""Forces and stresses of balls, race and housing at the highest speed, and the two-lobe ovality of the race.

The lobes of the race hold balls in their places.
"""

import math

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, GROOVE_CLEARANCE, RULES, STEEL
from abu_calc.sizing.manufacture.bearing_ring import race_groove, ring_of
from abu_calc.standards.balls import vickers

STEEL_MODULUS = 208e9
STEEL_POISSON = 0.3
CURVATURE_RATIO = Range("ratio of the contact's curvatures", 1.0, 100.0)


@formula(
    "Largest Hertz pressure of a ball in a toroidal groove",
    "p₀ = 3F/(2π·a_e·b_e)",
    "Pa",
    signs="r R R_g r_c R_e E_e E ν",
    where=(
        "The curvature sums are 1/r − 1/R and 1/r − 1/R_g; a_e/b_e = r_c^(2/π), b_e³ = 6·(1 + (π/2 − "
        "1)/r_c)·F·R_e/(π·r_c^(2/π)·E_e). Ball and race are of steel. The result is within 2 % of the elliptic "
        "integrals."
    ),
    checked=(CURVATURE_RATIO,),
    assumed="elastic, frictionless",
    source="Hamrock & Brewe 1983",
)
def hertz_ball_in_toroid(force: float, ball_radius: float, race_radius: float, groove_radius: float) -> float:
    """
    >>> round(1e-6 * hertz_ball_in_toroid(142, 8e-3, 31e-3, 24.43e-3), -1)
    1410.0
    """
    across, along = 1 / ball_radius - 1 / race_radius, 1 / ball_radius - 1 / groove_radius
    ratio = CURVATURE_RATIO.check(max(across, along) / min(across, along))
    k, integral = ratio ** (2 / math.pi), 1 + (math.pi / 2 - 1) / ratio
    modulus = STEEL_MODULUS / (1 - STEEL_POISSON**2)
    b = (6 * integral * force / ((across + along) * math.pi * k * modulus)) ** (1 / 3)
    return float(3 * force / (2 * math.pi * k * b**2))


@formula(
    "Largest Hertz pressure of a roller in a cylindrical race",
    "p₀ = √(F·E_e/(2π·L_r·R_e)), 1/R_e = 1/r − 1/R",
    "Pa",
    signs="E ν",
    assumed="elastic line contact, edges relieved",
    source="Hertz 1882",
)
def hertz_roller_in_cylinder(force: float, roller_radius: float, race_radius: float, length: float) -> float:
    modulus = STEEL_MODULUS / (1 - STEEL_POISSON**2)
    curvature = 1 / roller_radius - 1 / race_radius
    return math.sqrt(force * modulus * curvature / (2 * math.pi * length))


@formula(
    "Pressure that leaves no dent",
    "p₀ ≤ 1.6·σ_y, σ_y ≈ 3.25·HV MPa, so 5.2·HV MPa",
    "Pa",
    where="The static limit of catalogues (4200 MPa) allows a dent that would hold the balls.",
    assumed="hardened steel",
    source="assumed, from engineering practice",
)
def permitted_pressure(vickers: float) -> float:
    return 5.2e6 * vickers


@formula(
    "Hoop stress of a spinning free ring",
    "ρ·(Ω·R_o)²",
    "Pa",
    assumed="thin ring",
    source="thin-ring theory",
)
def hoop_stress(speed: float, radius: float, density: float) -> float:
    return density * (speed * radius) ** 2


@formula(
    "Growth of the diameter of a free ring under two opposite ball forces",
    "0.149·F·R_o³/(E·I_r), I_r = b_r·h_w³/12",
    "m",
    shown="um",
    where="This growth shows why a web must carry the wall.",
    assumed="thin ring without support",
    source="thin-ring theory (Timoshenko)",
)
def ring_flexure(force: float, radius: float, width: float, wall: float) -> float:
    return 0.149 * force * radius**3 / (STEEL_MODULUS * width * wall**3 / 12)


@formula(
    "Amplitude of the two lobes of a web, an annular plate that two opposite forces pull at its edge in its plane",
    "2F/(π·R_o)·R_o/(E·t_w)·[1 + ν/3 + (8/3)·x_i(3 + x_i²)/(1 − x_i)³], x_i = (R_i/R_o)²",
    "m",
    shown="um",
    assumed="plane stress, free inner edge; R_i = 0 for a hub that the spindle holds, which is stiffer than a disc",
    source="Airy function of an annulus; for R_i near R_o it becomes the thin ring",
)
def web_lobes(force: float, radius: float, inner_radius: float, thickness: float, modulus: float) -> float:
    """
    >>> thin = web_lobes(100, 0.1, 0.098, 0.01, STEEL_MODULUS)
    >>> round(thin / ring_flexure(100, 0.099, 0.01, 0.002), 2)
    0.47
    """
    s = (inner_radius / radius) ** 2
    shape = 1 + STEEL_POISSON / 3 + 8 / 3 * s * (3 + s**2) / (1 - s) ** 3
    return 2 * force / math.pi / (modulus * thickness) * shape


@formula(
    "Amplitude of the two lobes of a wall between two webs, which two opposite forces push out half-way",
    "2F/(π·R_o)·l_w³/(48·D_w), D_w = E·h_w³/(12(1−ν²))",
    "m",
    shown="um",
    assumed="strips of the wall rest on the webs and do not support each other, which gives more than a shell",
    source="simply supported beam",
)
def wall_lobes(force: float, radius: float, width: float, wall: float) -> float:
    return 2 * force / (math.pi * radius) * width**3 / (48 * _plate_rigidity(wall))


@formula(
    "Amplitude of the two lobes, half-way, of a wall that a web holds at one edge only",
    "2F/(π·R_o)·l_w·R_o²/(4·D_w·[3(l_w/R_o)² + (9/2)(1 − ν)])",
    "m",
    shown="um",
    where="The wall opens like a bell.",
    assumed="bending without extension; the web acts as a hinge, although its own bending stiffens the wall",
    source="Love's inextensional shell, Rayleigh–Ritz",
)
def hinged_wall_lobes(force: float, radius: float, width: float, wall: float) -> float:
    stiffness = 3 * (width / radius) ** 2 + 4.5 * (1 - STEEL_POISSON)
    return 2 * force / (math.pi * radius) * width * radius**2 / (4 * _plate_rigidity(wall) * stiffness)


def _plate_rigidity(wall: float) -> float:
    return STEEL_MODULUS * wall**3 / (12 * (1 - STEEL_POISSON**2))


HOOP_LIMIT = {STEEL: 200e6, ALUMINIUM: 80e6}
"""Assumed: a third of the yield strength of plain steel and of wrought aluminium."""


@dataclass(frozen=True)
class Strength:
    """Force of a ball [N], pressures and stresses [Pa] at the top of the speed range, with what is permitted."""

    ball_force: float
    contact_pressure: float
    permitted_pressure: float
    hoop_stress: float
    permitted_hoop: float

    @property
    def enough(self) -> bool:
        """True if both stresses are permitted."""
        return self.contact_pressure <= self.permitted_pressure and self.hoop_stress <= self.permitted_hoop


def strength(case: Case, ball_mass: float, diameter: float, race_radius: float, outer_diameter: float) -> Strength:
    """Force m·R_p·Ω² of one ball, its Hertz pressure in the groove, and the hoop stress of the rim."""
    abu, top, radius = case.autobalancer, case.speed_range[1], diameter / 2
    force = ball_mass * (race_radius - radius) * top**2
    if abu.corrector == "ball":
        pressure = hertz_ball_in_toroid(force, radius, race_radius, race_groove(case, race_radius, radius))
    else:
        pressure = hertz_roller_in_cylinder(force, radius, race_radius, diameter)
    rim = ALUMINIUM if abu.design == "light" else STEEL
    return Strength(
        ball_force=force,
        contact_pressure=pressure,
        permitted_pressure=permitted_pressure(vickers(abu.race_hardness_HRC)),
        hoop_stress=hoop_stress(top, outer_diameter / 2, rim),
        permitted_hoop=HOOP_LIMIT[rim],
    )


MODULUS = {STEEL: STEEL_MODULUS, ALUMINIUM: 70e9}
"""Elastic modulus of the body, by its density [Pa]."""


@dataclass(frozen=True)
class Roundness:
    """Amplitudes [m] of the race's two lobes under two opposite balls at the top of the speed range.

    `lobes`: as drawn, web and pressed cover both carry the wall and the spindle holds the hub; a screwed cover has
    clearance in its thread and carries nothing. `unaided`: only one web carries
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
    rules, wall = RULES[abu.design], abu.min_wall
    hub, between = abu.bore_diameter / 2 + rules.hub_wall, ball_diameter + 2 * GROOVE_CLEARANCE
    ring = ring_of(case, race_radius)
    if ring is not None:
        wall, between = ring.outside_diameter / 2 - race_radius, ring.width
    modulus = MODULUS[rules.body_density]
    held = web_lobes(force / 2, race_radius, 0.0, rules.web, modulus)
    unheld = web_lobes(force, race_radius, hub, rules.web, modulus)
    free = ring_flexure(force, race_radius, between + 2 * rules.web, wall)
    unaided = min(unheld + hinged_wall_lobes(force, race_radius, between, wall), free / 2)
    lobes = min(held + wall_lobes(force, race_radius, between, wall), free / 2)
    return Roundness(
        lobes=lobes if abu.closure == "pressed" else unaided,
        unaided=unaided,
        free_ring=free,
    )
