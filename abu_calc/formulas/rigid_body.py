"""Rigid body in space: accelerations that rotating forces cause, and the mass that balls on its spindle feel.

Places are vectors [m] from the centre of mass; z runs along the spindle from the machine toward the wheel, x from the
body toward the spindle. Rotation is from +x to +y. A rotating force of amplitude P is P·(1, −i, 0)·e^{iΩt}.

Rigid body of a machine of which nobody knows the inertias: an estimate from mass, layout and lengths, with a band.

The estimate is an assumption of this program, not a measurement. Its band holds what the shapes of such machines differ
by; every number that follows from the body has a band of its own, found by `BodyEstimate.band`.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import Any, Final, Literal

from abu_calc.foundation.errors import InputError, Place, RangeError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.standards.tables import toml_table

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


Layout = Literal["straight", "face", "angle"]
LENGTHS: Final[Mapping[Layout, tuple[str, ...]]] = {"straight": ("L",), "angle": ("L", "H"), "face": ("H",)}
"""Lengths that the estimate of a layout needs: L machine.length_mm, H machine.height_mm."""
KEYS: Final = {"L": "machine.length_mm", "H": "machine.height_mm"}
HEIGHT: Final = Range("height over length of an angle grinder", 0.02, 0.5, key="machine.height_mm")
_SHAPE: Final = ("k_x", "k_y", "k_z", "product")
_PLACE: Final = ("across", "along")


@dataclass(frozen=True)
class PlacedBody:
    """A body and the place of its wheel's centre from the centre of mass [m]."""

    body: RigidBody
    wheel: Vector


@dataclass(frozen=True)
class BodyEstimate:
    """The nominal body, and for each uncertain parameter the bodies at the ends of its 95 % band."""

    nominal: PlacedBody
    ends: tuple[tuple[PlacedBody, PlacedBody], ...]

    @formula(
        "Band of a quantity of an estimated body, 95 %",
        where=(
            "Each uncertain parameter is set to both ends of its band in turn. The deviations of the quantity from its "
            "nominal value are combined as the root of the sum of squares, upward and downward apart."
        ),
        assumed="independent parameters",
        source="propagation of uncertainty by finite changes, JCGM 100:2008, 5.1.3",
    )
    def band(self, quantity: Callable[[PlacedBody], float]) -> tuple[float, float]:
        """
        >>> estimate = estimated_body("straight", 6.2, {"L": 0.45})
        >>> low, high = estimate.band(lambda placed: placed.body.effective_mass(placed.wheel) / 6.2)
        >>> round(low, 2), round(high, 2)
        (0.23, 0.36)
        """
        return self.bands(lambda placed: (quantity(placed),))[0]

    def bands(self, quantities: Callable[[PlacedBody], Sequence[float]]) -> tuple[tuple[float, float], ...]:
        """Bands of several quantities, each as `band` finds it."""
        nominal = quantities(self.nominal)
        down, up = [0.0] * len(nominal), [0.0] * len(nominal)
        for pair in self.ends:
            for place, values in enumerate(zip(*map(quantities, pair), strict=True)):
                changes = [value - nominal[place] for value in values]
                down[place] = math.hypot(down[place], min(*changes, 0.0))
                up[place] = math.hypot(up[place], max(*changes, 0.0))
        return tuple((value - low, value + high) for value, low, high in zip(nominal, down, up, strict=True))


HAND_GRINDERS: Final = (0.5, 15.0)
"""Masses [kg] of hand grinders, for which usual lengths are assumed."""


def usual_lengths(layout: Layout, mass: float) -> dict[str, float]:
    """Lengths [mm] by their keys that a hand grinder of this mass [kg] usually has; nothing for other machines.

    >>> usual_lengths("straight", 5.6), usual_lengths("angle", 2.2), usual_lengths("face", 400.0)
    ({'machine.length_mm': 440.0}, {'machine.length_mm': 330.0, 'machine.height_mm': 75.0}, {})
    """
    low, high = HAND_GRINDERS
    if not low <= mass <= high:
        return {}
    table, grid = toml_table("body_estimates")[layout], {"L": ("usual_length", 10), "H": ("usual_height", 5)}
    return {
        KEYS[length]: float(step * round(table[usual] * mass ** (1 / 3) / step))
        for length, (usual, step) in grid.items() if length in LENGTHS[layout]
    }  # fmt: skip


def estimate_source() -> str:
    """Source of the shapes, in words."""
    table = toml_table("body_estimates")
    return f"{table['source']}; {table['edition']}, not measured"


@formula(
    "Rigid body of a hand grinder by its layout, mass and lengths",
    "J_i = M·k_i²",
    "kg m²",
    where=(
        "L is machine.length_mm, H is machine.height_mm. Straight: L runs from the wheel plane to the rear end; a "
        "is 0.44 L (0.39 … 0.50), k_x = k_y = 0.284 L (0.26 … 0.31), k_z = 0.06 L (0.05 … 0.07). Angle: L runs "
        "from the spindle axis to the rear end, H from the body's axis to the wheel plane; b is 0.29 L (0.25 … "
        "0.34), a is 0.80 H (0.70 … 0.90), without H 0.176 L (0.137 … 0.229), k_x = 0.136 L (0.12 … 0.15), k_y = "
        "0.29 L (0.265 … 0.315), k_z = 0.295 L (0.27 … 0.32), J_xz is −0.2 (−0.30 … −0.13) times M·a·b. Face: H "
        "runs from the wheel plane to the top; a is 0.43 H (0.38 … 0.49), b is 0 (±0.03 H), k_x = 0.37 H (0.33 … "
        "0.42), k_y = 0.285 H (0.255 … 0.315), k_z = 0.29 H (0.25 … 0.35). "
        "a is the distance from the centre of mass to the wheel plane, b that to the spindle axis. In brackets: 95 % "
        "of such assemblies. The rotor's polar inertia is ½·m·R_w² of the wheel unless the file gives it."
    ),
    signs="M",
    checked=(HEIGHT,),
    assumed="usual shares of mass of wheel, motor, gear and handles",
    source="4000 random assemblies of cylinders per layout; assumed, not measured",
)
def estimated_body(
    layout: Layout,
    mass: float,
    lengths: Mapping[str, float],
    polar: float = 0.0,
    center_of_mass_to_wheel: Vector | None = None,
) -> BodyEstimate:
    """`lengths` [m] by their names L and H; a known place of the wheel leaves the moments alone uncertain.

    >>> estimated_body("straight", 6.2, {"L": 0.45}).nominal.wheel
    (0.0, 0.0, 0.198)
    """
    table: dict[str, Any] = dict(toml_table("body_estimates")[layout])
    if not lengths.get("H") and "along_without_height" in table:
        table["along"] = table["along_without_height"]
    needed = {row[0] for name, row in table.items() if name in (*_SHAPE, *_PLACE) and name != "product"}
    if center_of_mass_to_wheel is not None:
        needed = {table[name][0] for name in _SHAPE[:3] if name in table}
    for length in sorted(needed):
        if not lengths.get(length, 0.0) > 0:
            raise InputError(
                f'layout = "{layout}" is estimated from this length too, which is missing',
                place=Place(key=KEYS[length]),
                remedy=f"add {KEYS[length].partition('.')[2]}, or give the inertia itself",
            )
    if layout == "angle" and "H" in needed:
        HEIGHT.check(lengths["H"] / lengths["L"])
    uncertain = {name: row for name, row in table.items() if name in (*_SHAPE, *_PLACE) and row[-1] != row[-2]}
    if center_of_mass_to_wheel is not None:
        uncertain = {name: row for name, row in uncertain.items() if name not in _PLACE}

    def body(changed: str = "", end: int = -3) -> PlacedBody:
        def value(name: str) -> float:
            row = table[name]
            ratio = float(row[end if name == changed else -3])
            return ratio * lengths[row[0]] if isinstance(row[0], str) else ratio

        wheel = center_of_mass_to_wheel or (value("across"), 0.0, value("along"))
        kx = value("k_x")
        ky = value("k_y") if "k_y" in table else kx
        product = value("product") * mass * math.hypot(wheel[0], wheel[1]) * wheel[2]
        inertia = Inertia(mass * kx**2, mass * ky**2, mass * value("k_z") ** 2, product)
        return PlacedBody(RigidBody(mass, inertia, polar), wheel)

    return BodyEstimate(body(), tuple((body(name, -2), body(name, -1)) for name in uncertain))
