"""A rigid rotor on bearings, which moves in its plane and tilts, with gyroscopic moments."""

from collections.abc import Sequence
from typing import Any, ClassVar, final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.motion import AnyArray, Axial, Leaning, Levers, Motion
from abu_calc.dynamics.parameters import Geometry, Parameters
from abu_calc.dynamics.race import LARGEST, Race
from abu_calc.dynamics.support import Unbalance
from abu_calc.dynamics.supports.planar import DAMPING, MASS, STIFFNESS, LinearGeometry, LinearSupport, Pair, rows
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range


@final
@dataclass(frozen=True)
class TiltingGeometry(LinearGeometry):
    """A = (x'', y'', Θ''). `tilt_map` (4 × 2N): the tilts and their rates, where balls move axially with them."""

    tilt_map: AnyArray | None

    def levers(self, m: Motion, p: Parameters) -> Levers:
        """T = (e_t, z e_t), N = (e_r, z e_r); along the spindle a ball moves by −R_p Θ·e_r."""
        plane: AnyArray = np.array(((m.cos, m.sin), (-m.sin, m.cos)))
        outward, along = np.concatenate([plane, p.places * plane], axis=1)
        levers = Levers(along, outward, p.frame.whole)
        leaning = None if self.tilt_map is None else self._lean(m, p, self.tilt_map, levers)
        return p.rotor.carry(m, levers, leaning)

    def _lean(self, m: Motion, p: Parameters, tilt_map: AnyArray, levers: Levers) -> AnyArray:
        """−R_p Θ·e_r along the spindle, its rate −R_p (Θ'·e_r + γ' Θ·e_t), and so on; R_p even off a groove's middle.

        A race that leans is narrower, seen along the spindle: R_p² less the square of that way. So what goes round with
        it flies outward a little less, which makes up for the pull the way along the spindle would have by itself.
        Returns the way along the spindle per turn.
        """
        tx, ty, vx, vy = tilt_map.dot(m.support)
        zero = 0.0 * m.cos
        swept: AnyArray = p.radii * (tx * m.sin - ty * m.cos)
        carried = 2 * p.radii * m.swing * (vx * m.sin - vy * m.cos)
        height = -p.radii * (tx * m.cos + ty * m.sin)
        rise = swept * m.swing - p.radii * (vx * m.cos + vy * m.sin)
        lever = np.array([zero, zero, -p.radii * m.cos, -p.radii * m.sin])
        levers.axial, levers.leaning = Axial(lever, carried, swept / m.radii), Leaning(height, rise)
        levers.sunk, levers.sinking = height * height, 2 * m.swing * height * rise
        return swept

    def plane(self, z: Any) -> AnyArray:
        """x + z θ_y and y − z θ_x."""
        displacements: AnyArray = self.race_map[:2] + z * self.race_map[2:]
        return displacements

    def forces(self, x: Any, y: Any, z: Any) -> list[Any]:
        """Forces with their moments about the centre of mass."""
        return [x, y, z * x, z * y]


@final
@dataclass(frozen=True)
class TiltingSupport(LinearSupport):
    """A linear support whose frame has the rows x, y of the centre of mass and the tilts θ_y, −θ_x.

    A race at z moves by (x + z θ_y, y − z θ_x). `axial_inertia`: the balls move axially with a race that tilts.
    """

    couples: ClassVar[bool] = True

    axial_inertia: bool = False
    bearings: tuple[float, ...] = ()

    def geometry(self, unbalance: Unbalance) -> Geometry:
        """Geometry in planes that tilt."""
        P = np.array(self.race_map)
        return TiltingGeometry(P, *self.turning(unbalance), np.kron(np.eye(2), P[2:]) if self.axial_inertia else None)

    def shares(self, races: Sequence[Race]) -> list[float]:
        """The most of axis, races, and balls along the spindle."""
        P = np.array(self.race_map)
        moved = [np.hypot(*P[:2]), *(np.hypot(*(P[:2] + race.plane_offset * P[2:])) for race in races)]
        moved.append(np.hypot(*P[2:]) * max((race.pitch_radius for race in races), default=0.0))
        return [float(value) for value in np.max(moved, axis=0)]

    def plane(self, z: float) -> NDArray[np.float64]:
        """x and y there."""
        return self._at(z)

    def tilt(self, q: NDArray[np.float64]) -> tuple[float, float] | None:
        """θ_y, −θ_x."""
        x, y = (np.array(self.race_map)[2:] @ q).tolist()
        return x, y

    def _at(self, plane: float) -> NDArray[np.float64]:
        P = np.array(self.race_map)
        return np.asarray(P[:2] + plane * P[2:], dtype=float)

    @property
    def description(self) -> str:
        """Description of the support."""
        return "Rigid rotor that moves in its plane and tilts"


def tilting(
    mass: float,
    transverse_inertia: float,
    polar_inertia: float,
    positions: Sequence[float],
    stiffness: Sequence[Pair],
    damping: Sequence[Pair],
    axial_inertia: bool = True,
) -> TiltingSupport:
    """m r'' = F, J_t Θ'' − i J_p Ω Θ' = moment, Θ = θ_y − iθ_x, on bearings at z [m] with r_z = r + z Θ.

    Coordinates x, y, θ_y, −θ_x: tilts small, so that a place at z moves by z Θ. Mass [kg], inertias without balls
    [kg m²], stiffness [N/m] and damping [N·s/m] of each bearing along x and y. `axial_inertia`: balls move along the
    spindle as their race tilts. Raises RangeError where no body has such inertias. Source: Genta 2005, Dynamics of
    Rotating Systems, 2.5 (rigid rotor, four freedoms).

    >>> tilting(1.0, 0.02, 0.01, (0.1,), ((100.0, 200.0),), ((0.0, 0.0),)).stiffness[0]
    (100.0, 0.0, 10.0, 0.0)
    """
    Range("transverse inertia", 0, LARGEST, "kg m²", open_low=True).check(transverse_inertia)
    # That of a flat disc is the largest there is.
    J = Range("polar inertia", 0, 2 * transverse_inertia, "kg m²").check(polar_inertia)
    for limit, pairs in ((STIFFNESS, stiffness), (DAMPING, damping)):
        for value in (value for pair in pairs for value in pair):
            limit.check(value)
    return TiltingSupport(
        mass=rows(np.diag((MASS.check(mass), mass, transverse_inertia, transverse_inertia))),
        damping=rows(_of_bearings(positions, damping)),
        stiffness=rows(_of_bearings(positions, stiffness)),
        gyroscopic=rows(np.kron(np.diag((0.0, 1.0)), np.array(((0.0, J), (-J, 0.0))))) if J else (),
        race_map=rows(np.eye(4)),
        names=("x", "y", "tilt_x", "tilt_y"),
        axial_inertia=axial_inertia,
        bearings=tuple(positions),
    )


def _of_bearings(positions: Sequence[float], values: Sequence[Pair]) -> AnyArray:
    """Σ over bearings of what acts against the motion of its place, in the four coordinates."""
    pairs = zip(positions, values, strict=True)
    total: AnyArray = sum(
        (np.kron(np.array(((1, z), (z, z * z))), np.diag(pair)) for z, pair in pairs), np.zeros((4, 4))
    )
    return total
