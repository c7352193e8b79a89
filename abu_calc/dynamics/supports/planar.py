"""A rotor whose races are in one plane, and move in it."""

from typing import Any, final

import numpy as np

from abu_calc.dynamics.motion import Array, Levers, Motion
from abu_calc.dynamics.parameters import Geometry, Parameters
from abu_calc.dynamics.support import Unbalance
from abu_calc.dynamics.supports.linear import DAMPING, MASS, STIFFNESS, LinearGeometry, LinearSupport, Pair
from abu_calc.frozen import dataclass

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

    def plane(self, z: Any) -> Array:
        """There is one."""
        return self.race_map

    def forces(self, x: Any, y: Any, z: Any) -> list[Any]:
        """Forces x and y, unchanged."""
        return [x, y]


@final
@dataclass(frozen=True)
class PlanarSupport(LinearSupport):
    """A linear support whose frame has the rows x and y of the race centre, all races in one plane."""

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
