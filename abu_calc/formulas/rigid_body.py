"""Rigid body in space: accelerations that rotating forces cause, and the mass that balls on its spindle feel.

Places are vectors [m] from the centre of mass; z runs along the spindle from the machine toward the wheel, x from the
body toward the spindle. Rotation is from +x to +y. A rotating force of amplitude P is P·(1, −i, 0)·e^{iΩt}.
"""

import math
from functools import cached_property
from typing import Final

from abu_calc.foundation.errors import Place, RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

Vector = tuple[float, float, float]
Motion = tuple[complex, complex, complex]
"""Complex amplitudes along x, y and z."""
Matrix = tuple[Motion, Motion, Motion]

ROTATING: Final[Motion] = (1, -1j, 0)
"""Force of unit amplitude that rotates with the spindle."""
_MASS = Range("mass of the body", 0.0, 1e6, "kg", open_low=True, key="machine.mass_kg")
_POLAR = Range("polar inertia of the rotor", 0.0, 1e6, "kg·m²", key="machine.rotor_polar_inertia_kg_m2")
_ROUNDING: Final = 1e-9
MEASURED: Final = 1.05
"""A principal moment may exceed the sum of the others by this factor: moments are measured to some per cent."""


@dataclass(frozen=True)
class Inertia:
    """Inertia tensor about the centre of mass [kg m²]; off the diagonal tensor entries, J_xz = −∫xz dm.

    Refused unless the principal moments are positive.
    """

    xx: float
    yy: float
    zz: float
    xz: float = 0.0

    def __post_init__(self) -> None:
        moments = self.principal
        if not (all(map(math.isfinite, moments)) and min(moments) > 0):
            raise RangeError(
                "the moments of inertia are those of no body: a principal moment is not positive",
                found=_listed(moments),
                allowed="three principal moments above zero",
                remedy="Correct the moments, or the product J_xz: its square must be below J_x·J_z.",
            )

    @property
    def principal(self) -> Vector:
        """Principal moments [kg m²]."""
        middle, half = (self.xx + self.zz) / 2, math.hypot((self.xx - self.zz) / 2, self.xz)
        return middle - half, self.yy, middle + half

    def checked(self) -> "Inertia":
        """The same, refused if a principal moment exceeds the sum of the others by more than errors of measurement."""
        moments = self.principal
        most = sum(moments) - max(moments)
        if max(moments) > MEASURED * most:
            raise RangeError(
                "the moments of inertia are those of no body: a principal moment exceeds the sum of the others",
                found=_listed(moments),
                allowed=f"none above {most:.4g} kg·m²",
                remedy="Correct the moments: each is about an axis through the centre of mass.",
            )
        return self

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        """The symmetric matrix J."""
        return (self.xx, 0.0, self.xz), (0.0, self.yy, 0.0), (self.xz, 0.0, self.zz)

    def inverse(self, polar: float = 0.0) -> Matrix:
        """J_g⁻¹, J_g = J + J_p·[[0, −i, 0], [i, 0, 0], [0, 0, 0]] [1/(kg m²)]."""
        gyro = 1j * polar if polar else 0.0
        (a, _, c), (_, e, _), (_, _, i) = self.rows
        determinant = (a * i - c * c) * e + gyro * gyro * i
        return (
            (e * i / determinant, gyro * i / determinant, -c * e / determinant),
            (-gyro * i / determinant, (a * i - c * c) / determinant, gyro * c / determinant),
            (-c * e / determinant, -gyro * c / determinant, (a * e + gyro * gyro) / determinant),
        )


def _listed(moments: Vector) -> str:
    return ", ".join(f"{moment:.4g}" for moment in moments) + " kg·m²"


@dataclass(frozen=True)
class RigidBody:
    """Machine with wheel and autobalancer, without balls; `inertia` None: a point mass, whose every place moves alike.

    `rotor_polar_inertia` J_p [kg m²] of what spins with the spindle; zero leaves gyroscopic moments out. The inertia
    about z holds the rotor's mass at its place, without J_p: the rotor keeps its speed.
    """

    mass: float
    inertia: Inertia | None = None
    rotor_polar_inertia: float = 0.0

    def __post_init__(self) -> None:
        _MASS.check(self.mass)
        polar = _POLAR.check(self.rotor_polar_inertia)
        if self.inertia is not None and polar**2 >= self.inertia.xx * self.inertia.yy * (1 - _ROUNDING):
            raise RangeError(
                "the rotor's polar inertia is that of no part of this body",
                place=Place(key="machine.rotor_polar_inertia_kg_m2"),
                found=f"{polar:g} kg·m²",
                allowed=f"below √(J_x·J_y) = {math.sqrt(self.inertia.xx * self.inertia.yy):.4g} kg·m²",
                remedy="Give the polar inertia of wheel, flange and spindle alone.",
            )

    @cached_property
    def _compliance(self) -> Matrix | None:
        return None if self.inertia is None else self.inertia.inverse(self.rotor_polar_inertia)

    @cached_property
    def _whirls(self) -> dict[tuple[Vector, Vector], complex]:
        return {}

    def _whirl_by_turning(self, at: Vector, force_at: Vector) -> complex:
        """The part of the forward whirl by which the body turns [1/kg]: no mass that it carries changes it."""
        if (at, force_at) not in self._whirls:
            x, y, _ = self.acceleration(at, force_at, added=math.inf)
            self._whirls[at, force_at] = x + 1j * y
        return self._whirls[at, force_at]

    def acceleration(self, at: Vector, force_at: Vector, force: Motion = ROTATING, added: float = 0.0) -> Motion:
        """Acceleration at a place by a force at another [per unit force, 1/kg]: A_pq·force.

        `added` [kg] is carried with the mass; centre of mass and inertia are those of the machine with it.

        >>> body = RigidBody(6.4, Inertia(0.10, 0.10, 0.10))
        >>> [round(abs(a), 3) for a in body.acceleration((0, 0, 0.2), (0, 0, 0.2))]
        [0.556, 0.556, 0.0]
        """
        mass = self.mass + added
        direct = force[0] / mass, force[1] / mass, force[2] / mass
        compliance = self._compliance
        if compliance is None:
            return direct
        moment = _cross(force_at, force)
        turn = tuple(row[0] * moment[0] + row[1] * moment[1] + row[2] * moment[2] for row in compliance)
        x, y, z = _cross((turn[0], turn[1], turn[2]), at)
        return direct[0] + x, direct[1] + y, direct[2] + z

    @formula(
        "Acceleration at one place per force at another, a matrix of x, y, z",
        "A_pq = 1/M − [r_p]·J_g⁻¹·[r_q]",
        "1/kg",
        where=(
            "[r] is the matrix of the cross product with r. J_g is the inertia tensor J_b about the centre of mass "
            "with ∓i·J_p in its places xy and yx, which is exact for a rotor of constant speed."
        ),
        signs="J_b J_p",
        assumed="frequencies well above those of the suspension",
        source="Newton–Euler of a free rigid body; checked by integration of six degrees of freedom",
    )
    def inertance(self, at: Vector, force_at: Vector) -> Matrix:
        """
        >>> body = RigidBody(2.4, Inertia(0.0040, 0.0200, 0.0190, -0.0015))
        >>> wheel = (0.095, 0.0, 0.048)
        >>> [round((1 / body.inertance(wheel, wheel)[i][i]).real, 4) for i in (0, 1)]
        [1.8802, 0.7609]
        """
        columns = [self.acceleration(at, force_at, unit) for unit in ((1, 0, 0), (0, 1, 0), (0, 0, 1))]
        rows = [(columns[0][i], columns[1][i], columns[2][i]) for i in range(3)]
        return rows[0], rows[1], rows[2]

    @formula(
        "Forward whirl at one place per rotating force at another",
        "g_pq = A_xx + A_yy + i(A_yx − A_xy)",
        "1/kg",
        where="The entries are those of the inertance matrix of the two places.",
        assumed="as for the inertance",
        source="derived by averaging: a backward whirl does not move the balls",
    )
    def forward(self, at: Vector, force_at: Vector, added: float = 0.0) -> complex:
        return 2 / (self.mass + added) + self._whirl_by_turning(at, force_at)

    @formula(
        "Effective mass that balls feel at a place of the spindle",
        "m_F = 2/g_rr",
        "kg",
        where=(
            "g_rr is the forward whirl at the place per rotating force there. m_F is the harmonic mean of the "
            "effective masses along x and y. It replaces M in required capacity, slow motion, friction band, "
            "stability and stall. With the centre of mass on the spindle and J_x = J_y it is 1/(1/M + a_p²/J_c)."
        ),
        signs="M a_p J_c",
        assumed="as for the inertance",
        source="derived; checked by integration of six degrees of freedom",
    )
    def effective_mass(self, place: Vector, added: float = 0.0) -> float:
        """
        >>> body = RigidBody(2.4, Inertia(0.0040, 0.0200, 0.0190, -0.0015))
        >>> round(body.effective_mass((0.095, 0.0, 0.048)), 5)
        1.08336
        """
        return 2 / self.forward(place, place, added).real


def _cross(a: Motion | Vector, b: Motion | Vector) -> Motion:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
