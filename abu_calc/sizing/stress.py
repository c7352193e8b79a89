"""Forces and stresses of balls, race and housing."""

import math

from abu_calc.validity import Range

STEEL_MODULUS = 208e9
STEEL_POISSON = 0.3
CURVATURE_RATIO = Range("ratio of the contact's curvatures", 1.0, 100.0)


def hertz_ball_in_toroid(force: float, ball_radius: float, race_radius: float, groove_radius: float) -> float:
    """Largest Hertz pressure [Pa] of a ball in a toroidal groove: p₀ = 3F/(2π·a·b).

    Curvature sums 1/r − 1/R and 1/r − 1/ρ; ellipse by k = α^(2/π), 𝓔 = 1 + (π/2 − 1)/α, α their ratio ≥ 1,
    b³ = 6·𝓔·F·R'/(π·k·E'), a = k·b, 1/R' the sum of both, E' = E/(1−ν²). F force [N]; radii [m]; steel on steel.
    Range: α 1…100, elastic, frictionless; within 2 % of the elliptic integrals. Source: Hamrock & Brewe 1983.

    >>> round(1e-6 * hertz_ball_in_toroid(142, 8e-3, 31e-3, 24.43e-3), -1)
    1410.0
    """
    across, along = 1 / ball_radius - 1 / race_radius, 1 / ball_radius - 1 / groove_radius
    ratio = CURVATURE_RATIO.check(max(across, along) / min(across, along))
    k, integral = ratio ** (2 / math.pi), 1 + (math.pi / 2 - 1) / ratio
    modulus = STEEL_MODULUS / (1 - STEEL_POISSON**2)
    b = (6 * integral * force / ((across + along) * math.pi * k * modulus)) ** (1 / 3)
    return float(3 * force / (2 * math.pi * k * b**2))


def hertz_roller_in_cylinder(force: float, roller_radius: float, race_radius: float, length: float) -> float:
    """Largest Hertz pressure [Pa] of a roller in a cylindrical race: p₀ = √(F·E'/(2π·L·R')), 1/R' = 1/r − 1/R.

    E' = E/(1−ν²). Range: elastic line contact, edges relieved. Source: Hertz 1882.
    """
    modulus = STEEL_MODULUS / (1 - STEEL_POISSON**2)
    curvature = 1 / roller_radius - 1 / race_radius
    return math.sqrt(force * modulus * curvature / (2 * math.pi * length))


def permitted_pressure(vickers: float) -> float:
    """Pressure [Pa] that leaves no dent: p₀ ≤ 1.6·σ_y, σ_y ≈ 3.3·HV, so 5.2·HV [MPa]; HV Vickers hardness.

    Range: hardened steel; the rule is assumed, from engineering practice. Catalogues' static limits (4200 MPa) allow a
    dent that would hold the balls.
    """
    return 5.2e6 * vickers


def hoop_stress(speed: float, radius: float, density: float) -> float:
    """Hoop stress of a spinning free ring [Pa]: ρ·v², v = Ω·R at its outer radius. Source: thin ring."""
    return density * (speed * radius) ** 2


def ring_flexure(force: float, radius: float, width: float, wall: float) -> float:
    """Ovality [m] that two opposite ball forces would give a free ring: 0.149·F·R³/(E·I), I = b·h³/12.

    Range: thin ring with nothing to hold it. Source: thin-ring theory (Timoshenko). A web must carry the wall.
    """
    return 0.149 * force * radius**3 / (STEEL_MODULUS * width * wall**3 / 12)
