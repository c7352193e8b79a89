"""Steady motion of a rigid body in space on its suspension: the balls' resultant, the motion and levels of places.

The suspension holds all six degrees of freedom: springs, or hands at handles. Conventions are those of `rigid_body`.
"""

import math
from collections.abc import Hashable, Iterable, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Protocol

from abu_calc.formulas.rigid_body import ROTATING, Motion, RigidBody, Vector
from abu_calc.formulas.suspension import handle_reaction
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.standards.vibration import Hand, hand_arm_weight

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Matrix6 = NDArray[np.complex128]


@dataclass(frozen=True)
class Load:
    """Force at a place that turns with the spindle, over Ω² [kg m]: amplitudes along x, y and z."""

    place: Vector
    amplitude: Motion


def imbalance_at(place: Vector, imbalance: complex) -> Load:
    """Load of an imbalance [kg m], complex in the rotor."""
    return Load(place, (imbalance, -1j * imbalance, 0))


@dataclass(frozen=True)
class SettledBalls:
    """Balls that still the forward whirl of their race: their resultant V [kg m] and all loads that act with it."""

    resultant: complex
    loads: tuple[Load, ...]


class BodySuspension(Hashable, Protocol):
    """Reaction of a suspension to motion of the body's six degrees of freedom."""

    def factor(self, speed: float) -> complex | None:
        """Displacement per displacement of the free body, if one number says it for all six; else None."""
        ...

    def stiffness(self, body: RigidBody, speed: complex) -> "Matrix6":
        """Dynamic stiffness, 6 × 6 (x, y, z and turns about them, at the centre of mass), at Ω [rad/s].

        A complex speed Ω − is is that of a motion that grows with e^{st}.
        """
        ...


@dataclass(frozen=True)
class BodySprings:
    """Springs by natural frequencies [rad/s] and damping ratios along x and y, of all six degrees of freedom.

    K = D·diag(M, J)·D, D = diag(ω_x, ω_y, ω_z, ω_y, ω_x, ω_z): a turn that moves the wheel along x has the frequency
    of x. Along and about z there is the geometric mean, which is assumed. One frequency gives K = ω²·diag(M, J).
    """

    frequencies: tuple[float, float]
    dampings: tuple[float, float]
    mass: float | None = None
    """Mass [kg] with which the frequencies are meant, if the body carries more: the stiffness is kept."""

    def factor(self, speed: float) -> complex | None:
        """Ω²/(Ω² − ω² − 2iζωΩ) for springs of one frequency of the body as it is."""
        (wx, wy), (zx, zy) = self.frequencies, self.dampings
        if (wx, zx) != (wy, zy) or self.mass is not None:
            return None
        left = speed**2 - wx**2 - 2j * zx * wx * speed
        if left == 0:
            raise _undamped(speed)
        return speed**2 / left

    def stiffness(self, body: RigidBody, speed: complex) -> "Matrix6":
        """K + iΩC."""
        import numpy as np

        (wx, wy), (zx, zy) = self.frequencies, self.dampings
        wz, zz = math.sqrt(wx * wy), math.sqrt(zx * zy)
        w = np.array([wx, wy, wz, wy, wx, wz])
        d = np.sqrt(w * np.array([zx, zy, zz, zy, zx, zz]))
        inertia = _masses(body)
        if self.mass is not None:
            inertia[:3, :3] *= self.mass / body.mass
        stiffness: Matrix6 = np.outer(w, w) * inertia + 2j * speed * np.outer(d, d) * inertia
        return stiffness


@dataclass(frozen=True)
class HandsOnHandles:
    """One hand on each of these handles, by its data along the body's x, y and z."""

    places: tuple[Vector, ...]
    axes: tuple[Hand, Hand, Hand]

    def factor(self, speed: float) -> complex | None:
        """None: hands turn and bend the motion."""
        return None

    def stiffness(self, body: RigidBody, speed: complex) -> "Matrix6":
        """Σ TᵀDT of the handles, D the reaction of one hand per axis; two hands hold no turn about their line."""
        import numpy as np

        one_hand = np.diag([handle_reaction(axis, speed) / 2 for axis in self.axes])
        ways = [_way(place) for place in self.places]
        stiffness: Matrix6 = sum((way.T @ one_hand @ way for way in ways), np.zeros((6, 6), complex))
        return stiffness


@dataclass(frozen=True)
class BodyMotion:
    """A body that imbalances shake at the speed Ω [rad/s]; `suspension` None: free, as far above the suspension."""

    body: RigidBody
    speed: float
    suspension: BodySuspension | None = None

    def response(self, at: Vector, force_at: Vector, direction: Motion = ROTATING) -> Motion:
        """Displacement at a place per load at another [1/kg]: Ω²·H_pq·(1, −i, 0), free −A_pq·(1, −i, 0)."""
        if self.suspension is None:
            factor: complex | None = 1.0
        else:
            factor = None if self.body.rotor_polar_inertia else self.suspension.factor(self.speed)
        if factor is not None:
            x, y, z = self.body.acceleration(at, force_at, direction)
            return -factor * x, -factor * y, -factor * z
        x, y, z = (self.speed**2 * (self._receptance(at, force_at) @ direction)).tolist()
        return x, y, z

    @formula(
        "Receptance of a body on its suspension: displacement at one place per force at another",
        "H_pq = T_p·(K_b + iΩ·(C_b + C_g) − Ω²·M_b)⁻¹·T_qᵀ",
        "m/N",
        where=(
            "T_p takes the six motions of the centre of mass to the place p. M_b holds mass and inertia tensor, K_b "
            "and C_b hold springs and dampers, or hands at their handles. C_g holds ±J_p·Ω in the places of the turns "
            "about x and y. On springs of one frequency without J_p it is A_pq/(ω² − Ω² + 2iζωΩ)."
        ),
        signs="J_p A_pq ω ζ",
        assumed="small motion; a rotor of constant speed",
        source="Newton–Euler; checked by integration of six degrees of freedom",
    )
    def receptance(self, at: Vector, force_at: Vector) -> "NDArray[np.complex128]":
        matrix: NDArray[np.complex128] = self._receptance(at, force_at)
        return matrix

    def _receptance(self, at: Vector, force_at: Vector) -> Any:
        return _way(at) @ _flexibility(self.body, self.suspension, self.speed, self.speed) @ _way(force_at).T

    def forward(self, at: Vector, force_at: Vector) -> complex:
        """Forward whirl X + iY at a place per imbalance at another [1/kg], free −g_pq."""
        x, y, _ = self.response(at, force_at)
        return x + 1j * y

    def effective_mass(self, race: Vector) -> float:
        """m_F [kg] at the race, as the suspension leaves it at this speed: |2/(forward whirl per imbalance)|."""
        return 2 / abs(self.forward(race, race))

    @formula(
        "Imbalance of the balls that stills the race",
        "V = −U·g_rw/g_rr + m_F·Δ",
        "kg m",
        where=(
            "g_rw is the forward whirl of the race per rotating force at the wheel, g_rr that per force at the race. "
            "On a suspension the receptance H_pq takes their place: V = −(g_rw·U + 2Δ/Ω²)/g_rr. Required capacity: "
            "|g_rw/g_rr|·U + m_F·Δ."
        ),
        signs="Ω H_pq",
        assumed="speed above the suspension; the balls' own mass changes V by about 0.02 %",
        source="derived by averaging; checked by integration of six degrees of freedom with balls",
    )
    def ball_resultant(self, imbalance: complex, wheel: Vector, race: Vector, eccentricity: complex = 0.0) -> complex:
        """
        >>> from abu_calc.formulas.rigid_body import Inertia
        >>> body = RigidBody(6.0, Inertia(0.022, 0.130, 0.125, -0.010), 0.0032)
        >>> wheel, race = (0.135, 0.0, 0.075), (0.135, 0.0, 0.050)
        >>> V = BodyMotion(body, 6500 * math.pi / 30).ball_resultant(152e-6, wheel, race)
        >>> round(1e6 * V.real, 1)
        -167.5
        """
        here = self.forward(race, race)
        if here == 0:
            raise NotTrustworthyError("balls at a node of the body feel no imbalance: choose another race plane")
        return -(self.forward(race, wheel) * imbalance + 2 * eccentricity) / here

    def settled_balls(
        self,
        imbalance: complex,
        wheel: Vector,
        race: Vector,
        eccentricity: complex = 0.0,
        ball_mass: float = 0.0,
        inertia_factor: float = 7 / 5,
    ) -> SettledBalls:
        """Balls where they settle, with the small forces of their own mass n·m [kg] in the rest of the race's motion.

        That rest is a backward whirl B, in which balls swing at 2Ω and act as a mass n·m(1 − 1/(8J)), and motion Z
        along the spindle, in which they act as n·m. To 1e-5 of the integrated motion; without their mass 0.1 … 1.5 %
        of the motion that remains is missing.
        """
        wheel_load = imbalance_at(wheel, imbalance)
        if not ball_mass:
            V = self.ball_resultant(imbalance, wheel, race, eccentricity)
            return SettledBalls(V, (wheel_load, imbalance_at(race, V)))
        import numpy as np

        swinging = ball_mass * (1 - 1 / (8 * inertia_factor))
        backward: Motion = (swinging, 1j * swinging, 0)
        columns = [self.response(race, race, direction) for direction in (ROTATING, backward, (0, 0, ball_mass))]
        parts = np.array([[x + 1j * y, (x - 1j * y) / 2, z] for x, y, z in columns]).T
        x, y, z = self.displacement(race, (wheel_load,))
        left = parts - np.diag([0, 1, 1])
        V, B, Z = np.linalg.solve(left, -np.array([x + 1j * y + 2 * eccentricity, (x - 1j * y) / 2, z])).tolist()
        own = Load(race, (B * backward[0], B * backward[1], Z * ball_mass))
        return SettledBalls(V, (wheel_load, imbalance_at(race, V), own))

    def displacement(self, at: Vector, loads: Iterable[Load]) -> Motion:
        """Complex amplitudes along x, y, z at a place [m] that loads cause together."""
        total: list[complex] = [0, 0, 0]
        for load in loads:
            for axis, part in enumerate(self.response(at, load.place, load.amplitude)):
                total[axis] += part
        return total[0], total[1], total[2]


def velocity_rms(displacement: Motion, speed: float) -> Vector:
    """Rms velocity along x, y, z [m/s] of complex amplitudes [m] at Ω [rad/s]: Ω·|X|/√2."""
    x, y, z = (speed * abs(axis) / math.sqrt(2) for axis in displacement)
    return x, y, z


@formula(
    "Weighted acceleration of one axis",
    "a_h = W_h·Ω·v",
    "m/s²",
    where="v is the velocity of this axis, all of it at the speed of rotation.",
    source="ISO 5349-1:2001",
)
def weighted_acceleration(velocity: float, speed: float) -> float:
    """
    >>> round(weighted_acceleration(14.09e-3, 5800 * math.pi / 30), 3)
    1.419
    """
    return hand_arm_weight(speed) * speed * velocity


@formula(
    "Vector total of the weighted accelerations of three axes",
    "a_hv = √(Σ a_h²)",
    "m/s²",
    source="ISO 5349-1:2001, 4.5",
)
def vector_total(accelerations: Sequence[float]) -> float:
    """
    >>> vector_total((2.0, 3.0, 6.0))
    7.0
    """
    return math.hypot(*accelerations)


def whirl_receptances(
    motion: BodyMotion, race: Vector, growth: complex, ball_mass: float = 0.0
) -> tuple[complex, complex]:
    """Receptances [m/N] of forward and backward whirl at the race, h at σ = s + iΩ and h* at σ = s − iΩ.

    h = ½(H_xx + H_yy + i(H_yx − H_xy)), h* with −i; `growth` s [1/s], `ball_mass` n·m [kg] moves with the race. Both
    enter the equation of small motions of balls that balance, X² − (n·m/2)(p + p̄)X + (n·m/2)²(1 − χ²)p·p̄ = 0 with
    X = J·s² + h₀·s, p = σ⁴h, p̄ = σ⁴h*, χ = |Σe^{2iθ}|/n. Source: derived; its boundaries of stability agree with
    Floquet multipliers of six degrees of freedom within 0.04 %.
    """
    import numpy as np

    way, whirls = _way(race), []
    for sign in (1, -1):
        sigma = growth + sign * 1j * motion.speed
        flexibility = _flexibility(motion.body, motion.suspension, -1j * sigma, motion.speed)
        H = np.linalg.inv(np.linalg.inv(way @ flexibility @ way.T) + sigma**2 * ball_mass * np.eye(3))
        whirls.append(complex(H[0, 0] + H[1, 1] + sign * 1j * (H[1, 0] - H[0, 1])) / 2)
    return whirls[0], whirls[1]


def _way(place: Vector) -> Any:
    """T_p = [I, −[p]]: displacement of a place by the six motions of the centre of mass."""
    import numpy as np

    x, y, z = place
    return np.array([[1, 0, 0, 0, z, -y], [0, 1, 0, -z, 0, x], [0, 0, 1, y, -x, 0]], float)


def _masses(body: RigidBody) -> Any:
    """diag(M·I, J)."""
    import numpy as np

    if body.inertia is None:
        raise InputError("a point mass has no motion in space", place=Place(key="machine.inertia_kg_m2"))
    masses = np.zeros((6, 6))
    masses[:3, :3] = body.mass * np.eye(3)
    masses[3:, 3:] = body.inertia.rows
    return masses


@lru_cache(maxsize=256)
def _flexibility(body: RigidBody, suspension: BodySuspension | None, frequency: complex, spin: float) -> Any:
    """Z⁻¹, Z = K + iν(C + Γ) − ν²·diag(M, J) at the frequency ν of the motion, the rotor spinning at Ω; 6 × 6."""
    import numpy as np

    Z = -(frequency**2) * _masses(body).astype(complex)
    if suspension is not None:
        Z += suspension.stiffness(body, frequency)
    gyroscopic = 1j * frequency * body.rotor_polar_inertia * spin
    Z[3, 4] += gyroscopic
    Z[4, 3] -= gyroscopic
    try:
        inverse = np.linalg.inv(Z)
    except np.linalg.LinAlgError:
        raise _undamped(abs(frequency)) from None
    inverse.flags.writeable = False
    return inverse


def _undamped(speed: float) -> InputError:
    return InputError(
        "the speed is a natural frequency, which nothing damps: vibration grows without bound",
        place=Place(key="suspension.damping_ratios"),
        found=f"{speed:g} rad/s",
        remedy="give the suspension some damping, or hold the machine more softly",
    )
