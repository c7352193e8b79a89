"""Linear supports M q'' + C q' + K q = Pᵀ F, and those whose races are in one plane and move in it.

planar       a point mass on springs and dampers
with_body    a further body on it, such as a casing or a handle that gives
in_hands     a machine held in two hands, whose masses move on their own
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Any, Self, final

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from abu_calc.dynamics.motion import AnyArray, Levers, Motion
from abu_calc.dynamics.rotor import LARGEST, Balls, Frame, Geometry, Parameters, Race, finite
from abu_calc.dynamics.support import SmallMotion, Support, Unbalance
from abu_calc.formulas.suspension import hand_masses, joined
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Table, entry
from abu_calc.standards.vibration import Hand

Matrix = tuple[tuple[float, ...], ...]

Pair = tuple[float, float]
"""Along x and along y."""

MASS = Range("support mass", 0, LARGEST, "kg", open_low=True)
STIFFNESS = Range("support stiffness", 0, LARGEST, "N/m")
DAMPING = Range("support damping", 0, LARGEST, "N·s/m")

QUARTERS = np.array((0.0, math.pi / 2, 0.0, math.pi / 2))
"""y is what x is a quarter turn later."""

Stiffness = Annotated[float, Field(ge=0, le=1e15)]
Damping = Annotated[float, Field(ge=0, le=1e12)]
StiffnessPair = Annotated[tuple[Stiffness, ...], Field(strict=False, min_length=2, max_length=2)]
DampingPair = Annotated[tuple[Damping, ...], Field(strict=False, min_length=2, max_length=2)]


class Body(Table):
    """Planar support: a further body on the rotor by a spring and a damper, such as a casing or a handle. It starts
    at rest at its place.
    """

    mass_kg: float = Field(description="Mass of the body [kg]; {range}.", examples=[0.5], gt=0, le=1e9)
    stiffness_N_per_m: StiffnessPair = entry(example=[20000.0, 20000.0]).means(
        "Stiffness between rotor and body along x and y [N/m]; {range}."
    )
    damping_N_s_per_m: DampingPair = entry(example=[5.0, 5.0]).means(
        "Damping between rotor and body along x and y [N·s/m]; {range}."
    )


def rows(matrix: AnyArray) -> Matrix:
    """A matrix as a scene holds it."""
    return tuple(tuple(row) for row in matrix.tolist())


@dataclass(frozen=True)
class LinearGeometry(Geometry):
    """The frame's motion per unit of each coordinate, P, and what turns with the rotor and pulls at the frame."""

    race_map: AnyArray
    turning_imbalances: AnyArray
    """d: m₀e twice, for x and y, and χ(J_t − J_p) likewise."""
    turning_places: AnyArray
    """The angles of whose cosines these are the components."""

    def imbalance(self, m: Motion, p: Parameters) -> tuple[AnyArray, AnyArray | None]:
        """m₀e (Ω² e_r − Ω' e_t) at the centre of mass, and χ(J_t − J_p) likewise on the tilts; its weight when driven.

        The second of these is the couple imbalance, a polar axis of inertia that leans by χ.
        """
        place = self.turning_places + m.turn
        force = self.turning_imbalances * (m.speed * m.speed * m.xp.cos(place))
        return p.rotor.unbalanced(m, force, None, lambda: -self.turning_imbalances * m.xp.sin(place), lambda: 0.0)

    def rates(self, m: Motion, p: Parameters) -> AnyArray:
        """Velocities of the frame."""
        velocities: AnyArray = self.race_map.dot(m.support[p.size :])
        return velocities


@dataclass(frozen=True)
class LinearSupport(Support):
    """M q'' + (C + Ω G) q' + K q = Pᵀ F in N coordinates q; the frame P q is what the balls feel, F acts on it.

    The mass M is what moves with the rotor WITHOUT balls; it must be symmetric and positive definite, which `frame`
    verifies; the gyroscopic matrix G (none where empty) is antisymmetric, Ω the speed of the rotor. Units: coordinates
    in m (then kg, N·s/m, N/m) unless their name says otherwise.
    """

    mass: Matrix
    damping: Matrix
    stiffness: Matrix
    race_map: Matrix
    names: tuple[str, ...]
    gyroscopic: Matrix = ()

    def __post_init__(self) -> None:
        size, axes = len(self.names), 4 if self.couples else 2
        for name, matrix, count in (
            ("support mass", self.mass, size),
            ("support damping", self.damping, size),
            ("support stiffness", self.stiffness, size),
            ("gyroscopic matrix", self.gyroscopic, size if self.gyroscopic else 0),
            ("race map", self.race_map, axes),
        ):
            if len(matrix) != count or any(len(row) != size for row in matrix):
                raise InputError(f"{name}: must be {count} × {size}")
            for row in matrix:
                finite(name, row)

    def frame(self, balls: Balls) -> Frame:
        """(P M⁻¹ Pᵀ)⁻¹ and the forces of springs and dampers as the frame feels them; what the support does behind it.

        Raises InputError when the support's mass is not symmetric and positive definite.
        """
        M, P = np.array(self.mass), np.array(self.race_map)
        if not (np.allclose(M, M.T, rtol=1e-9, atol=0) and np.all(np.linalg.eigvalsh(M) > 0)):
            raise InputError("the support's mass matrix must be symmetric and positive definite", found=str(self.mass))
        forces = -np.hstack([self.stiffness, self.damping])
        spinning = np.hstack([np.zeros_like(M), -np.array(self.gyroscopic)]) if self.gyroscopic else None
        if np.array_equal(P, np.eye(*P.shape)) and len(P) == len(M):
            return Frame(M, forces, whole=M + balls.mass(len(P)), held_spinning=spinning)
        push = np.linalg.solve(M, P.T)
        mass = np.linalg.inv(P @ push)
        carry = push @ mass

        def behind(pull: AnyArray) -> tuple[AnyArray, AnyArray]:
            """Force on the frame, and what accelerates the support beside the frame."""
            free = np.linalg.solve(M, pull)
            return carry.T @ pull, free - carry @ (P @ free)

        held, rest = behind(forces)
        held_spinning, rest_spinning = behind(spinning) if spinning is not None else (None, None)
        return Frame(
            mass=mass,
            held=held,
            whole=mass + balls.mass(len(P)),
            held_spinning=held_spinning,
            rest=rest,
            carry=carry,
            rest_spinning=rest_spinning,
        )

    def turning(self, unbalance: Unbalance) -> tuple[AnyArray, AnyArray]:
        """Imbalance and couple that turn with the rotor and pull at the frame, as in `LinearGeometry`."""
        axes = len(self.race_map)
        angles = np.repeat((unbalance.angle, unbalance.couple_angle), 2)
        return np.repeat((unbalance.static, unbalance.couple), 2)[:axes], angles[:axes] - QUARTERS[:axes]

    @property
    def felt_mass(self) -> float:
        """Mean of x and y."""
        P = np.array(self.race_map)
        compliance = P @ np.linalg.solve(np.array(self.mass), P.T)
        return 2 / float(compliance[0, 0] + compliance[1, 1])

    def shares(self, races: Sequence[Race]) -> list[float]:
        """Displacement of the axis by a unit of each coordinate."""
        return [float(value) for value in np.hypot(*np.array(self.race_map)[:2])]

    def small_motion(self, speed: float) -> SmallMotion:
        """The very same, for any motion."""
        turning = speed * np.array(self.gyroscopic) if self.gyroscopic else 0.0
        return SmallMotion(
            np.array(self.mass), np.array(self.damping) + turning, np.array(self.stiffness), np.array(self.race_map)
        )

    def holding(self, balls: Balls) -> Self:
        """Support with the balls' mass at the centres of their races."""
        P = np.array(self.race_map)
        return replace(self, mass=rows(np.array(self.mass) + P.T @ balls.mass(len(P)) @ P))

    def resonances(self, balls: Balls) -> list[float]:
        """Speeds that are natural frequencies while the rotor turns as fast."""
        mass = np.array(self.holding(balls).mass)
        spinning = np.array(self.gyroscopic) if self.gyroscopic else 0.0
        # Of e^{iΩt} at the speed Ω itself; what is negative is a motion that turns backward, or none.
        squares = np.linalg.eigvals(np.linalg.solve(mass - 1j * spinning, np.array(self.stiffness))).real
        return [float(value) for value in np.sqrt(np.maximum(squares, 0.0))]

    def resting_position(self, force: tuple[float, float] = (0.0, 0.0)) -> tuple[float, ...]:
        """Position at the middle of the springs, or where they hold the force."""
        if not any(force):
            return (0.0,) * len(self.names)
        pulled = np.array(self.race_map)[:2].T @ force
        return tuple(np.linalg.solve(np.array(self.stiffness), pulled).tolist())

    def plane(self, z: float) -> NDArray[np.float64]:
        """x and y of the axis, everywhere alike. Raises InputError for a place along the spindle."""
        if z:
            raise InputError("only a support that tilts knows where along the spindle the wheel is")
        return np.array(self.race_map)

    def axis(self, q: NDArray[np.float64], plane: float = 0.0) -> NDArray[np.float64]:
        """Linear in the coordinates."""
        return np.asarray(self._at(plane) @ q, dtype=float)

    def axis_velocity(self, q: NDArray[np.float64], rates: NDArray[np.float64]) -> NDArray[np.float64]:
        """Likewise in their rates."""
        return np.asarray(self._at(0.0) @ rates, dtype=float)

    def _at(self, plane: float) -> NDArray[np.float64]:
        """x and y of the axis there."""
        return np.array(self.race_map)

    def model(self) -> dict[str, Any]:
        """Matrices of the support."""
        return {
            "mass_kg": [list(row) for row in self.mass],
            "damping_N_s_per_m": [list(row) for row in self.damping],
            "stiffness_N_per_m": [list(row) for row in self.stiffness],
            "gyroscopic_kg_m2": [list(row) for row in self.gyroscopic],
            "race_map": [list(row) for row in self.race_map],
        }


AHEAD = np.array(((-1.0,), (1.0,)))
"""(−sin γ, cos γ) from (sin γ, cos γ)."""


@final
@dataclass(frozen=True)
class PlanarGeometry(LinearGeometry):
    """A = (x'', y'')."""

    def levers(self, m: Motion, p: Parameters) -> Levers:
        """T = (−sin γ, cos γ) and N = (cos γ, sin γ); one row more if driven."""
        outward = np.array((m.cos, m.sin))
        return p.rotor.carry(m, Levers(AHEAD * outward[::-1], outward, p.frame.whole))

    def plane(self, z: Any) -> AnyArray:
        """There is one."""
        return self.race_map

    def forces(self, x: Any, y: Any, z: Any) -> list[Any]:
        """Forces x and y, unchanged."""
        return [x, y]


@final
@dataclass(frozen=True)
class PlanarSupport(LinearSupport):
    """A linear support whose frame has the rows x and y of the race centre, all races in one plane."""

    kind, about = "planar", "springs along x and y"
    needs = ("mass_kg", "stiffness_N_per_m", "damping_N_s_per_m")
    keys = {"body": Body}  # noqa: RUF012

    @classmethod
    def of(cls, scene: Any) -> "PlanarSupport":
        """Support on springs, with a further body if the file has one."""
        own = scene.mass_kg, scene.stiffness_N_per_m, scene.damping_N_s_per_m
        hung = scene.body
        return with_body(*own, hung.mass_kg, hung.stiffness_N_per_m, hung.damping_N_s_per_m) if hung else planar(*own)

    def geometry(self, unbalance: Unbalance) -> Geometry:
        """Geometry in one plane."""
        return PlanarGeometry(np.array(self.race_map), *self.turning(unbalance))

    @property
    def description(self) -> str:
        """Description with the number of coordinates besides those of the axis."""
        more = len(self.names) - 2
        return "Planar support" + (f" with {more} more coordinates" if more else "")


def planar(mass: float, stiffness: Pair, damping: Pair) -> PlanarSupport:
    """A point mass [kg] on springs [N/m] and dampers [N·s/m] along x and y; its coordinates are the race centre itself.

    M x'' + b_x x' + k_x x = F_x, likewise y (Kladiev 1996, eq. (1), with the damping that free motion along the work
    needs to die out). Mass positive, stiffness and damping not negative; raises RangeError.

    >>> planar(6.4, (1580.0, 1580.0), (100.0, 100.0)).names
    ('x', 'y')
    """
    MASS.check(mass)
    kx, ky = map(STIFFNESS.check, stiffness)
    bx, by = map(DAMPING.check, damping)
    return PlanarSupport(
        mass=((mass, 0.0), (0.0, mass)),
        damping=((bx, 0.0), (0.0, by)),
        stiffness=((kx, 0.0), (0.0, ky)),
        race_map=((1.0, 0.0), (0.0, 1.0)),
        names=("x", "y"),
    )


ROTOR, BETWEEN = np.array(((1.0, 0.0), (0.0, 0.0))), np.array(((1.0, -1.0), (-1.0, 1.0)))
"""Matrices of an element's action on rotor and body.

The element acts from the rotor to the ground, or between the two.
"""


def with_body(
    mass: float, stiffness: Pair, damping: Pair, body_mass: float, body_stiffness: Pair, body_damping: Pair
) -> PlanarSupport:
    """M x'' + b x' + k x = F + R, m_b x_b'' = −R, R = k_b (x_b − x) + b_b (x_b' − x'); likewise y.

    A rotor on springs to the ground, the body on the rotor: masses [kg], stiffness [N/m] and damping [N·s/m] along x
    and y. Masses positive, the rest not negative; raises RangeError.
    Source: Den Hartog 1956, Mechanical Vibrations, 3.2.

    >>> with_body(1.0, (5.0, 6.0), (0.0, 0.0), 0.5, (2.0, 3.0), (0.0, 0.0)).stiffness[1]
    (0.0, 9.0, 0.0, -3.0)
    """
    own, hung = MASS.check(mass), MASS.check(body_mass)
    return PlanarSupport(
        mass=rows(np.diag((own, own, hung, hung))),
        damping=rows(_joined([DAMPING.check(b) for b in damping], [DAMPING.check(b) for b in body_damping])),
        stiffness=rows(_joined([STIFFNESS.check(k) for k in stiffness], [STIFFNESS.check(k) for k in body_stiffness])),
        race_map=rows(np.eye(2, 4)),
        names=("x", "y", "body_x", "body_y"),
    )


def _joined(ground: list[float], link: list[float]) -> AnyArray:
    """Matrix that acts against the motion of rotor and body.

    Its order is x, y of the rotor, x, y of the body.
    """
    return np.kron(ROTOR, np.diag(ground)) + np.kron(BETWEEN, np.diag(link))


def in_hands(mass: float, axes: tuple[Hand, Hand]) -> PlanarSupport:
    """A point mass [kg] in two hands that move alike, `axes` the hand along x and along y; see `formulas.suspension`.

    Its receptance is 1/(`handle_reaction` − mΩ²). Mass positive; raises RangeError.

    >>> from abu_calc.standards.vibration import hand
    >>> in_hands(5.0, (hand("x"), hand("z"))).names
    ('x', 'y', 'palm_x', 'palm_y', 'fingers_x', 'fingers_y')
    """
    own = np.array((MASS.check(mass), 0.0, 0.0))
    return PlanarSupport(
        mass=rows(_both([np.diag(own + hand_masses(hand)) for hand in axes])),
        damping=rows(_both([np.array(joined(hand.damping)) for hand in axes])),
        stiffness=rows(_both([np.array(joined(hand.stiffness)) for hand in axes])),
        race_map=rows(np.eye(2, 6)),
        names=("x", "y", "palm_x", "palm_y", "fingers_x", "fingers_y"),
    )


def _both(along: list[AnyArray]) -> AnyArray:
    """x and y side by side, coordinate by coordinate."""
    x, y = along
    return np.kron(x, np.diag((1.0, 0.0))) + np.kron(y, np.diag((0.0, 1.0)))
