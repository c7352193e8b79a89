"""A roll on two supports that move to and fro: what its imbalances in two planes do to them, and back.

An imbalance of mass q at radius R, its heavy spot the angle φ behind the zero mark, is the complex number
Q = q·R·e^{−iφ}: it pulls along the sensors with the real part of Q·Ω²·e^{iΩt}, t from the passage of the mark. A motion
A·cos(Ωt − α) is X = A·e^{−iα} likewise.
"""

import cmath
import math
from dataclasses import dataclass
from typing import Final

from abu_calc.formula import formula

Pair = tuple[complex, complex]
"""Left and right."""
Matrix = tuple[Pair, Pair]
"""Rows: left and right sensor, or sum and moment; columns: left and right."""
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
        """From support to support [m]."""
        return self.a + self.b + self.c + self.d

    @property
    def masses(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """The mass matrix of the two supports' motions [kg]."""
        left, right, turn = (self.c + self.d) / self.length, (self.a + self.b) / self.length, self.J3 / self.length**2
        both = self.M3 * left * right - turn
        return (self.M1 + self.M3 * left**2 + turn, both), (both, self.M2 + self.M3 * right**2 + turn)


@formula(
    "Damping of the two supports",
    "c_j = 2ζ·√(C_j·M_jj)",
    "N s/m",
    where=(
        "M_jj what support j moves while the other is held: M1 + M3·((c+d)/L)² + J3/L² on the left, "
        "M2 + M3·((a+b)/L)² + J3/L² on the right; L = a+b+c+d."
    ),
    source="derived; the source has none",
)
def support_damping(roll: RollOnRig) -> tuple[float, float]:
    masses, twice = roll.masses, 2 * roll.damping_ratio
    return twice * math.sqrt(roll.C1 * masses[0][0]), twice * math.sqrt(roll.C2 * masses[1][1])


@formula(
    "Natural frequencies of roll and supports",
    "det(C − ω²·M) = 0",
    "rad/s",
    where="M the mass matrix of the two supports' motions, the roll between them rigid; undamped.",
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
    "What the supports' motions are worth as forces and moments about the centre of mass",
    "k11 = −M3(c+d)/L − M1 + C1/Ω², k12 = −M3(a+b)/L − M2 + C2/Ω²",
    "kg, kg m",
    where=(
        "k21 = −J3/L − M1(a+b) + C1(a+b)/Ω², k22 = J3/L + M2(c+d) − C2(c+d)/Ω²; with damping C_j + iΩ·c_j in place of "
        "C_j. L = a+b+c+d."
    ),
    source="Didukh 2010, derived anew by Lagrange's equations",
    printed="the line for D1 is missing",
)
def kernels(roll: RollOnRig, speed: float) -> Matrix:
    damping, left, right = support_damping(roll), roll.a + roll.b, roll.c + roll.d
    first = complex(roll.C1 / speed**2 - roll.M1, damping[0] / speed)
    second = complex(roll.C2 / speed**2 - roll.M2, damping[1] / speed)
    turn, whole = roll.J3 / roll.length, roll.M3 / roll.length
    return (first - whole * right, second - whole * left), (first * left - turn, turn - second * right)


@formula(
    "Imbalances in both planes from the displacements of both supports",
    "Q1 = (c·S + G)/(b+c), Q2 = (b·S − G)/(b+c)",
    "kg m",
    where=(
        "S = k11·X1 + k12·X2, G = k21·X1 + k22·X2, X_j = A_j·e^{−iα_j} of the displacement; q_j = |Q_j|/R_j, the heavy "
        "spot φ_j = −arg Q_j from the mark against rotation: the quadrant is that of the complex number."
    ),
    assumed="rigid roll, small motions across the roll in one direction",
    source="Didukh 2010, in complex form",
    printed=(
        "arctan of a quotient, which loses the quadrant (200° comes out as 20° with a negative mass, 90° and 270° as a "
        "division by zero)"
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
    "Influence of the planes on the sensors, by the rig's data",
    "H = k⁻¹·(1 1; b −c)",
    "m per kg m",
    where="X = H·Q; k the matrix of k11 … k22.",
    source="derived",
)
def influence(roll: RollOnRig, speed: float) -> Matrix:
    (k11, k12), (k21, k22) = kernels(roll, speed)
    whole = k11 * k22 - k12 * k21
    columns = [((k22 - k12 * arm) / whole, (k11 * arm - k21) / whole) for arm in (roll.b, -roll.c)]
    return (columns[0][0], columns[1][0]), (columns[0][1], columns[1][1])


@formula(
    "Displacement of a reading",
    "X = A·e^{−iα}, of a velocity /(iΩ), of an acceleration /(−Ω²)",
    "m",
    where="A 0–peak, α the phase of A·cos(Ωt − α).",
    source="differentiation",
    printed=(
        "Didukh 2010 names A accelerations in (3) and puts them where displacements belong: q comes out Ω² times too "
        "large and φ 180° off, so that metal would be taken off on the wrong side"
    ),
)
def displacement(quantity: str, amplitude: float, phase: float, speed: float) -> complex:
    return cmath.rect(amplitude, -phase) / reading_factor(quantity, speed)


def reading_factor(quantity: str, speed: float) -> complex:
    """A reading over the displacement: 1, iΩ, −Ω²."""
    return complex((1j * speed) ** ORDERS[quantity])


ORDERS: Final = {"displacement": 0, "velocity": 1, "acceleration": 2}
"""How many times a quantity is differentiated."""


@formula(
    "The same as printed: readings as they stand, arctan of a quotient",
    "φ1 = arctan((D2·c + D4)/(D1·c + D3)), q1 = (D1·c + D3)/(R1·(b+c)·cos φ1)",
    "rad, kg",
    where=(
        "D1, D3 the sum and the moment of A_j·cos α_j by k11 … k22, D2, D4 those of A_j·sin α_j; plane 2 with b and "
        "minus. For comparison: reports show where it points."
    ),
    source="Didukh 2010, (3)–(6)",
    printed="as here; what is wrong with it stands at the two formulas before",
)
def printed_answer(roll: RollOnRig, speed: float, readings: Pair, radii: tuple[float, float]) -> tuple[Signed, Signed]:
    """The angle is not a number where the quotient has no denominator."""
    left, right = (_printed(one, radius) for one, radius in zip(imbalances(roll, speed, readings), radii, strict=True))
    return left, right


def _printed(imbalance: complex, radius: float) -> Signed:
    along, across = imbalance.real, -imbalance.imag
    return math.copysign(abs(imbalance), along) / radius, math.atan(across / along) if along else math.nan


@formula(
    "Condition number of the way from imbalances to readings",
    "σ_max/σ_min of H",
    where="How much errors of readings may grow, relative to the whole; 1 is best.",
    source="linear algebra",
)
def condition_number(matrix: Matrix) -> float:
    """
    >>> condition_number(((2, 0), (0, -1j)))
    2.0
    """
    (p, q), (r, s) = matrix
    squares, whole = abs(p) ** 2 + abs(q) ** 2 + abs(r) ** 2 + abs(s) ** 2, abs(p * s - q * r)
    if whole == 0:
        return math.inf
    root = math.sqrt(max(squares * squares - 4 * whole * whole, 0.0))
    return (squares + root) / (2 * whole)


@formula(
    "Lowest bending speed of a solid steel bar of the roll's mass and length",
    "ω = (π/L)²·√(E·I·L/m), I = m²/(4π·ρ²·L²)",
    "rad/s",
    where=(
        "E = 206 GPa, ρ = 7850 kg/m³. Held without moment at both ends. A tube of that mass bends later, a roll with "
        "much mass that does not stiffen it earlier."
    ),
    assumed="steel, the mass even along the roll",
    source="Euler and Bernoulli's beam",
)
def bar_bending_speed(mass: float, length: float) -> float:
    second_moment = mass**2 / (4 * math.pi * STEEL_DENSITY**2 * length**2)
    return (math.pi / length) ** 2 * math.sqrt(STEEL_MODULUS * second_moment * length / mass)


STEEL_MODULUS: Final = 206e9
STEEL_DENSITY: Final = 7850.0
