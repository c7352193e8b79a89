"""Forces and stresses of balls, race and housing."""

import math

from abu_calc.formula import formula
from abu_calc.validity import Range

STEEL_MODULUS = 208e9
STEEL_POISSON = 0.3
CURVATURE_RATIO = Range("ratio of the contact's curvatures", 1.0, 100.0)


@formula(
    "Largest Hertz pressure of a ball in a toroidal groove",
    "p₀ = 3F/(2π·a·b)",
    "Pa",
    where=(
        "Curvature sums 1/r − 1/R and 1/r − 1/R_g; ellipse by k = α^(2/π), 𝓔 = 1 + (π/2 − 1)/α, α their ratio ≥ 1, "
        "b³ = 6·𝓔·F·R'/(π·k·E'), a = k·b, 1/R' the sum of both, E' = E/(1−ν²). F force [N]; radii [m]; steel on steel. "
        "Within 2 % of the elliptic integrals."
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
    "p₀ = √(F·E'/(2π·L·R')), 1/R' = 1/r − 1/R",
    "Pa",
    where="E' = E/(1−ν²), L length of the roller [m].",
    assumed="elastic line contact, edges relieved",
    source="Hertz 1882",
)
def hertz_roller_in_cylinder(force: float, roller_radius: float, race_radius: float, length: float) -> float:
    modulus = STEEL_MODULUS / (1 - STEEL_POISSON**2)
    curvature = 1 / roller_radius - 1 / race_radius
    return math.sqrt(force * modulus * curvature / (2 * math.pi * length))


@formula(
    "Pressure that leaves no dent",
    "p₀ ≤ 1.6·σ_y, σ_y ≈ 3.3·HV [MPa], so 5.2·HV [MPa]",
    "Pa",
    where="HV Vickers hardness. Catalogues' static limits (4200 MPa) allow a dent that would hold the balls.",
    assumed="hardened steel",
    source="assumed, from engineering practice",
)
def permitted_pressure(vickers: float) -> float:
    return 5.2e6 * vickers


@formula(
    "Hoop stress of a spinning free ring",
    "ρ·v², v = Ω·R at its outer radius",
    "Pa",
    assumed="thin ring",
    source="thin ring",
)
def hoop_stress(speed: float, radius: float, density: float) -> float:
    return density * (speed * radius) ** 2


@formula(
    "What two opposite ball forces would add to the diameter of a free ring",
    "0.149·F·R³/(E·I), I = b·h³/12",
    "m",
    where="A web must carry the wall.",
    assumed="thin ring with nothing to hold it",
    source="thin-ring theory (Timoshenko)",
)
def ring_flexure(force: float, radius: float, width: float, wall: float) -> float:
    return 0.149 * force * radius**3 / (STEEL_MODULUS * width * wall**3 / 12)


@formula(
    "Two lobes of a web, an annular plate in its plane, that two opposite forces pull at its edge",
    "2F/(πR)·R/(E·t)·[1 + ν/3 + (8/3)·s(3 + s²)/(1 − s)³], s = (a/R)²",
    "m",
    where="Amplitude of the part in cos 2θ. F force, R outer, a inner radius, t thickness of the web [m].",
    assumed="plane stress, the inner edge free; a = 0 for a hub that the spindle holds, which is stiffer than a disc",
    source="Airy function A·r² + B·r⁴ + C/r² + D; for a near R it is the thin ring",
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
    "Two lobes of a wall between two webs, which two opposite forces push out half-way",
    "2F/(πR)·l³/(48·D), D = E·h³/(12(1−ν²))",
    "m",
    where="Amplitude of the part in cos 2θ. l width between the webs, h wall, R radius [m].",
    assumed="strips of the wall rest on the webs and do not help each other: more than a shell would give",
    source="simply supported beam",
)
def wall_lobes(force: float, radius: float, width: float, wall: float) -> float:
    return 2 * force / (math.pi * radius) * width**3 / (48 * _plate_rigidity(wall))


@formula(
    "Two lobes of a wall that a web holds at one edge only, half-way",
    "2F/(πR)·l·R²/(4·D·[3(l/R)² + (9/2)(1 − ν)])",
    "m",
    where="Amplitude of the part in cos 2θ: the wall opens like a bell. Symbols as between two webs.",
    assumed="bending without extension; the web a hinge, though its own bending stiffens it",
    source="Love's inextensional shell, Rayleigh–Ritz",
)
def hinged_wall_lobes(force: float, radius: float, width: float, wall: float) -> float:
    stiffness = 3 * (width / radius) ** 2 + 4.5 * (1 - STEEL_POISSON)
    return 2 * force / (math.pi * radius) * width * radius**2 / (4 * _plate_rigidity(wall) * stiffness)


def _plate_rigidity(wall: float) -> float:
    return STEEL_MODULUS * wall**3 / (12 * (1 - STEEL_POISSON**2))
