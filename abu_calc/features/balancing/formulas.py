"""Formulas of a roll on two supports that move to and fro: motion from imbalances in two planes, and back.

An imbalance of mass q at radius R, its heavy spot the angle φ behind the zero mark, is the complex number
Q = q·R·e^{−iφ}: it pulls along the sensors with the real part of Q·Ω²·e^{iΩt}, t from the passage of the mark. A motion
A·cos(Ωt − α) is X = A·e^{−iα} likewise.
"""

import cmath
import math
from typing import Final

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass

Vector = tuple[complex, ...]
"""One number for each plane, or for each sensor."""
Matrix = tuple[Vector, ...]
"""Rows: sensors, or sum and moment; columns: planes."""
Pair = Vector
"""Left and right."""
Signed = tuple[float, float]
"""A mass that may be negative, and an angle."""


@dataclass(frozen=True)
class RollOnRig:
    """Numbers of rig and roll in SI, named as in the source: supports M1, M2, C1, C2; roll M3, J3; lengths a, b, c, d
    from left support over left plane, centre of mass and right plane to the right support.
    """

    M1: float
    M2: float
    C1: float
    C2: float
    damping_ratio: float
    M3: float
    J3: float
    a: float
    b: float
    c: float
    d: float

    @property
    def length(self) -> float:
        """Length from support to support [m]."""
        return self.a + self.b + self.c + self.d

    @property
    def masses(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The mass matrix of the two supports' motions [kg]."""
        left, right, turn = (self.c + self.d) / self.length, (self.a + self.b) / self.length, self.J3 / self.length**2
        both = self.M3 * left * right - turn
        return (self.M1 + self.M3 * left**2 + turn, both), (both, self.M2 + self.M3 * right**2 + turn)


@formula(
    "Damping of the two supports",
    "h_j = 2ζ·√(C_j·M_jj)",
    "N s/m",
    signs="M_L M_R M_roll J_roll l₁ l₂ l₃ l₄ L_s",
    where=(
        "M_jj = M_L + M_roll·((l₃+l₄)/L_s)² + J_roll/L_s² on the left, M_R + M_roll·((l₁+l₂)/L_s)² + J_roll/L_s² on "
        "the right."
    ),
    source="derived; Didukh 2010 has no damping",
)
def support_damping(roll: RollOnRig) -> tuple[float, float]:
    masses, twice = roll.masses, 2 * roll.damping_ratio
    return twice * math.sqrt(roll.C1 * masses[0][0]), twice * math.sqrt(roll.C2 * masses[1][1])


@formula(
    "Natural frequencies of roll and supports",
    "det(C_jk − ω²·M_jk) = 0",
    "rad/s",
    shown="hz",
    where="The damping is left out.",
    source="Lagrange's equations",
)
def natural_frequencies(roll: RollOnRig) -> tuple[float, float]:
    """
    >>> rig = RollOnRig(18, 21, 3e5, 3.6e5, 0, 64, 9.5, 0.15, 0.52, 0.61, 0.2)
    >>> [round(each / math.tau, 2) for each in natural_frequencies(rig)]
    [12.54, 17.35]
    """
    (m11, m12), (_, m22) = roll.masses
    first, half = m11 * m22 - m12 * m12, (roll.C1 * m22 + roll.C2 * m11) / 2
    root = math.sqrt(max(half * half - first * roll.C1 * roll.C2, 0.0))
    return math.sqrt(roll.C1 * roll.C2 / (half + root)), math.sqrt((half + root) / first)


@formula(
    "Forces and moments about the centre of mass, per motion of the supports and over Ω²",
    "k₁₁ = −M_roll(l₃+l₄)/L_s − M_L + C_L/Ω², k₁₂ = −M_roll(l₁+l₂)/L_s − M_R + C_R/Ω²",
    "kg, kg m",
    shown="kg, kg·m",
    signs="k₂₁ k₂₂ J_roll C_j h_j",
    where=(
        "k₂₁ = −J_roll/L_s − M_L(l₁+l₂) + C_L(l₁+l₂)/Ω², k₂₂ = J_roll/L_s + M_R(l₃+l₄) − C_R(l₃+l₄)/Ω². With damping, "
        "C_j + iΩ·h_j replaces C_L and C_R."
    ),
    source="Didukh 2010, derived anew by Lagrange's equations",
    published="the line for D1 is missing",
)
def kernels(roll: RollOnRig, speed: float) -> Matrix:
    damping, left, right = support_damping(roll), roll.a + roll.b, roll.c + roll.d
    first = complex(roll.C1 / speed**2 - roll.M1, damping[0] / speed)
    second = complex(roll.C2 / speed**2 - roll.M2, damping[1] / speed)
    turn, whole = roll.J3 / roll.length, roll.M3 / roll.length
    return (first - whole * right, second - whole * left), (first * left - turn, turn - second * right)


@formula(
    "Imbalances in both planes from the displacements of both supports",
    "Q_L = (l₃·S_F + S_M)/(l₂+l₃), Q_R = (l₂·S_F − S_M)/(l₂+l₃)",
    "kg m",
    signs="X_L X_R A_j ψ_j",
    where=(
        "S_F = k₁₁·X_L + k₁₂·X_R and S_M = k₂₁·X_L + k₂₂·X_R; X_j = A_j·e^{−iψ_j} of the displacement. The mass is "
        "|Q| over the radius of its plane. The heavy spot is at −arg Q from the mark, against rotation, in the "
        "quadrant of the complex number."
    ),
    assumed="rigid roll, small motions across the roll in one direction",
    source="Didukh 2010, in complex form",
    published=(
        "the arctan of a quotient loses the quadrant: 200° becomes 20° with a negative mass, and 90° and 270° become "
        "a division by zero"
    ),
)
def imbalances(roll: RollOnRig, speed: float, motion: Pair) -> Pair:
    """
    >>> rig = RollOnRig(18, 21, 3e5, 3.6e5, 0, 64, 9.5, 0.15, 0.52, 0.61, 0.2)
    >>> motion = cmath.rect(0.038109e-3, -math.radians(18.7489)), cmath.rect(0.031642e-3, -math.radians(152.7485))
    >>> left, right = imbalances(rig, 100 * math.pi, motion)
    >>> [round(1e6 * abs(left) / 120, 2), round(1e6 * abs(right) / 150, 2)]
    [12.0, 7.0]
    """
    row, turn = kernels(roll, speed)
    total, moment = row[0] * motion[0] + row[1] * motion[1], turn[0] * motion[0] + turn[1] * motion[1]
    span = roll.b + roll.c
    return (roll.c * total + moment) / span, (roll.b * total - moment) / span


@formula(
    "Influence of the planes on the sensors, from the rig's data",
    "W = k_jk⁻¹·(1 1; l₂ −l₃)",
    "m per kg m",
    signs="X_j Q_L Q_R",
    where="X_j = W·(Q_L, Q_R).",
    source="derived",
)
def influence(roll: RollOnRig, speed: float) -> Matrix:
    (k11, k12), (k21, k22) = kernels(roll, speed)
    whole = k11 * k22 - k12 * k21
    columns = [((k22 - k12 * arm) / whole, (k11 * arm - k21) / whole) for arm in (roll.b, -roll.c)]
    return (columns[0][0], columns[1][0]), (columns[0][1], columns[1][1])


@formula(
    "Displacement of a reading",
    "X_j = A_j·e^{−iψ_j}, velocities divided by iΩ, accelerations by −Ω²",
    "m",
    shown="um",
    where="ψ_j is the phase of A_j·cos(Ωt − ψ_j).",
    source="differentiation",
    published=(
        "Didukh 2010 calls the amplitudes accelerations in (3), and uses them as displacements. The masses become Ω² "
        "times too large and the angles are off by 180°, so that metal would be removed on the wrong side"
    ),
)
def displacement(quantity: str, amplitude: float, phase: float, speed: float) -> complex:
    return cmath.rect(amplitude, -phase) / reading_factor(quantity, speed)


def reading_factor(quantity: str, speed: float) -> complex:
    """A reading over the displacement: 1, iΩ, −Ω²."""
    return complex((1j * speed) ** ORDERS[quantity])


ORDERS: Final = {"displacement": 0, "velocity": 1, "acceleration": 2}
"""Number of times that each quantity is differentiated."""


@formula(
    "Correction by the formula as published, with readings unchanged and the arctan of a quotient",
    "φ_1 = arctan((D2·l₃ + D4)/(D1·l₃ + D3)), m_1 = (D1·l₃ + D3)/(R_1·(l₂+l₃)·cos φ_1)",
    "rad, kg",
    shown="deg, g",
    where=(
        "For plane 2, D1·l₂ − D3 replaces D1·l₃ + D3, and D2·l₂ − D4 replaces D2·l₃ + D4. Reports show this answer "
        "for comparison."
    ),
    source="Didukh 2010, (3)–(6)",
    published="as here; the formulas of displacement and imbalances name its errors",
)
def published_answer(
    roll: RollOnRig, speed: float, readings: Pair, radii: tuple[float, float]
) -> tuple[Signed, Signed]:
    """The angle is not a number where the quotient has no denominator."""
    left, right = (
        _printed(imbalance, radius) for imbalance, radius in zip(imbalances(roll, speed, readings), radii, strict=True)
    )
    return left, right


def _printed(imbalance: complex, radius: float) -> Signed:
    along, across = imbalance.real, -imbalance.imag
    return math.copysign(abs(imbalance), along) / radius, math.atan(across / along) if along else math.nan


@formula(
    "Condition number of the relation between imbalances and readings",
    "σ_max/σ_min of W",
    where="Relative errors of the readings may grow by this factor; 1 is best.",
    source="linear algebra",
)
def condition_number(matrix: Matrix) -> float:
    """
    >>> condition_number(((2, 0), (0, -1j)))
    2.0
    """
    import numpy as np

    values = np.linalg.svd(np.array(matrix, dtype=complex), compute_uv=False)
    return float(values[0] / values[-1]) if values[-1] > TINY * values[0] else math.inf


TINY: Final = 1e-15
"""Ratio of singular values that only rounding makes."""


@formula(
    "Lowest bending speed of a solid steel bar of the roll's mass and length",
    "ω_bar = (π/L_s)²·√(E·I_r·L_s/M_roll), I_r = M_roll²/(4π·ρ²·L_s²)",
    "rad/s",
    where=(
        "E = 206 GPa, ρ = 7850 kg/m³. Both ends are held without moment. A tube of the same mass has a higher bending "
        "speed. A roll has a lower one if much of its mass does not stiffen it."
    ),
    assumed="steel, mass uniform along the roll",
    source="Euler–Bernoulli beam",
)
def bar_bending_speed(mass: float, length: float) -> float:
    second_moment = mass**2 / (4 * math.pi * STEEL_DENSITY**2 * length**2)
    return (math.pi / length) ** 2 * math.sqrt(STEEL_MODULUS * second_moment * length / mass)


STEEL_MODULUS: Final = 206e9
STEEL_DENSITY: Final = 7850.0
