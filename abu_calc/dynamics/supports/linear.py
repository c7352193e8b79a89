"""Common parts of all linear supports M q'' + C q' + K q = Pᵀ F."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.motion import Array, Motion
from abu_calc.dynamics.parameters import Frame, Geometry, Parameters
from abu_calc.dynamics.race import LARGEST, Balls, Race, finite
from abu_calc.dynamics.support import SmallMotion, Support, Unbalance
from abu_calc.errors import InputError
from abu_calc.frozen import dataclass
from abu_calc.validity import Range

Matrix = tuple[tuple[float, ...], ...]

Pair = tuple[float, float]
"""Along x and along y."""

MASS = Range("support mass", 0, LARGEST, "kg", open_low=True)
STIFFNESS = Range("support stiffness", 0, LARGEST, "N/m")
DAMPING = Range("support damping", 0, LARGEST, "N·s/m")

QUARTERS = np.array((0.0, math.pi / 2, 0.0, math.pi / 2))
"""y is what x is a quarter turn later."""


def rows(matrix: Array) -> Matrix:
    """A matrix as a scene holds it."""
    return tuple(tuple(row) for row in matrix.tolist())


@dataclass(frozen=True)
class LinearGeometry(Geometry):
    """The frame's motion per unit of each coordinate, P, and what turns with the rotor and pulls at the frame."""

    race_map: Array
    turning_imbalances: Array
    """d: m₀e twice, for x and y, and χ(J_t − J_p) likewise."""
    turning_places: Array
    """The angles of whose cosines these are the components."""

    def imbalance(self, m: Motion, p: Parameters) -> tuple[Array, Array | None]:
        """m₀e (Ω² e_r − Ω' e_t) at the centre of mass, and χ(J_t − J_p) likewise on the tilts; its weight when driven.

        The second of these is the couple imbalance, a polar axis of inertia that leans by χ.
        """
        place = self.turning_places + m.turn
        force = self.turning_imbalances * (m.speed * m.speed * m.xp.cos(place))
        return p.rotor.unbalanced(m, force, None, lambda: -self.turning_imbalances * m.xp.sin(place), lambda: 0.0)

    def rates(self, m: Motion, p: Parameters) -> Array:
        """Velocities of the frame."""
        velocities: Array = self.race_map.dot(m.support[p.size :])
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

        def behind(pull: Array) -> tuple[Array, Array]:
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

    def turning(self, unbalance: Unbalance) -> tuple[Array, Array]:
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
