"""Press fits of two rings: interference warm and at speed, contact pressure (Lamé), stresses, forces and torques."""

import math
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass

ASSEMBLY_TEMPERATURE: Final = 20.0
"""Temperature at which limits of size hold [°C] (ISO 1)."""
FRICTION: Final = 0.12
"""Coefficient of friction of a dry press fit and of clamped faces, steel or aluminium (assumed, low; DIN 7190-1)."""
SMOOTHING: Final = 2.5e-6
"""Interference that is lost when ground surfaces are pressed together [m]: 0.8·(Rz + Rz), Rz 1.6 µm (DIN 7190-1)."""


@dataclass(frozen=True)
class RingMaterial:
    """Elastic constants, density, expansion [SI] and yield strength [Pa] of usual grades."""

    name: str
    modulus: float
    poisson: float
    density: float
    expansion: float
    strength: float


STEEL_RING: Final = RingMaterial("steel", 206e9, 0.3, 7800.0, 12e-6, 600e6)
ALUMINIUM_RING: Final = RingMaterial("aluminium", 70e9, 0.33, 2700.0, 23.5e-6, 240e6)
"""Strengths are three times the permitted hoop stress of a rim: quenched steel, 6082-T6 (assumed, low)."""
MATERIALS: Final = {material.density: material for material in (STEEL_RING, ALUMINIUM_RING)}


@dataclass(frozen=True)
class Ring:
    """A ring from an inner to an outer radius [m]; an inner radius of 0 is a solid disc."""

    inner: float
    outer: float
    material: RingMaterial


@formula(
    "Largest hoop stress of a spinning disc with a hole, at the hole",
    "ρ·Ω²/4·[(3 + ν)·R_o² + (1 − ν)·R_i²]",
    "Pa",
    assumed="plane stress, constant thickness",
    source="Timoshenko, Theory of Elasticity",
)
def spin_stress(ring: Ring, speed: float) -> float:
    """
    >>> round(1e-6 * spin_stress(Ring(10e-3, 33.5e-3, STEEL_RING), 607.4), 2)
    2.71
    """
    nu = ring.material.poisson
    return ring.material.density * speed**2 / 4 * ((3 + nu) * ring.outer**2 + (1 - nu) * ring.inner**2)


def spin_growth(ring: Ring, speed: float, at_outside: bool) -> float:
    """Radial growth [m] of a spinning ring at its hole or outside: r·σ_θ/E, no radial stress there."""
    nu = ring.material.poisson
    if at_outside:
        stress = ring.material.density * speed**2 / 4 * ((1 - nu) * ring.outer**2 + (3 + nu) * ring.inner**2)
        return ring.outer * stress / ring.material.modulus
    return ring.inner * spin_stress(ring, speed) / ring.material.modulus


@formula(
    "Interference left, in diameter, warm and at speed",
    "I_0 − I_z − (α_o − α_i)·D_f·ΔT_f − 2·(u_o − u_i)",
    "m",
    shown="um",
    where=(
        "I_0 is the interference of the sizes at 20 °C. I_z is lost by smoothing of the surfaces. The temperature is "
        "ΔT_f above 20 °C. Both rings grow by their own rotation, by u_o and u_i in radius."
    ),
    assumed="both rings at one temperature",
    source="thermal expansion; Timoshenko; DIN 7190-1 (smoothing)",
)
def interference_left(interference: float, inside: Ring, outside: Ring, temperature: float, speed: float) -> float:
    """
    >>> outer = Ring(39.5e-3, 41.5e-3, ALUMINIUM_RING)
    >>> round(1e6 * interference_left(60e-6, Ring(37e-3, 39.5e-3, STEEL_RING), outer, 60.0, 0.0), 1)
    21.2
    """
    diameter, warmer = 2 * outside.inner, temperature - ASSEMBLY_TEMPERATURE
    thermal = (outside.material.expansion - inside.material.expansion) * diameter * warmer
    spun = 2 * (spin_growth(outside, speed, False) - spin_growth(inside, speed, True))
    return interference - SMOOTHING - thermal - spun


@formula(
    "Contact pressure of two rings by their interference",
    "p_f = I_f/D_f/[((r_f² + R_i²)/(r_f² − R_i²) − ν_i)/E_i + ((R_o² + r_f²)/(R_o² − r_f²) + ν_a)/E_a]",
    "Pa",
    signs="I_f D_f r_f R_i R_o ν_i ν_a E_i E_a",
    where="The result is 0 if there is clearance.",
    assumed="elastic rings of one width",
    source="Lamé",
)
def contact_pressure(interference: float, inside: Ring, outside: Ring) -> float:
    """
    >>> thick = Ring(20e-3, 40e-3, STEEL_RING)
    >>> round(1e-6 * contact_pressure(40e-6, Ring(0.0, 20e-3, STEEL_RING), thick), 2)
    77.25
    """
    r, a, b = outside.inner, inside.inner, outside.outer
    inner = ((r**2 + a**2) / (r**2 - a**2) - inside.material.poisson) / inside.material.modulus
    outer = ((b**2 + r**2) / (b**2 - r**2) + outside.material.poisson) / outside.material.modulus
    return max(0.0, interference) / (2 * r) / (inner + outer)


def outer_hoop(pressure: float, outside: Ring) -> float:
    """Largest hoop stress [Pa] of the outer ring, at its hole, by Lamé."""
    return pressure * (outside.outer**2 + outside.inner**2) / (outside.outer**2 - outside.inner**2)


def inner_hoop(pressure: float, inside: Ring) -> float:
    """Largest compressive hoop stress [Pa] of the inner ring, at its hole, by Lamé."""
    return 2 * pressure * inside.outer**2 / (inside.outer**2 - inside.inner**2)


@formula(
    "Torque that a press fit carries",
    "μ_f·p_f·2π·r_f²·l_f",
    "N m",
    source="Coulomb friction",
)
def fit_torque(pressure: float, radius: float, length: float) -> float:
    return FRICTION * pressure * 2 * math.pi * radius**2 * length


@formula(
    "Axial force that a press fit carries",
    "μ_f·p_f·2π·r_f·l_f",
    "N",
    source="Coulomb friction",
)
def fit_force(pressure: float, radius: float, length: float) -> float:
    return FRICTION * pressure * 2 * math.pi * radius * length
