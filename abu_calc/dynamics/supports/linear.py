"""Linear supports M q'' + C q' + K q = Pᵀ F."""

import sys

from abu_calc.dynamics.scene import LinearSupport
from abu_calc.validity import Range


def planar(mass: float, stiffness: tuple[float, float], damping: tuple[float, float]) -> LinearSupport:
    """A point mass [kg] on springs [N/m] and dampers [N·s/m] along x and y; its coordinates are the race centre itself.

    M x'' + b_x x' + k_x x = F_x, likewise y (Kladiev 1996, eq. (1), with the damping that free motion along the work
    needs to die out). Mass positive, stiffness and damping not negative; raises RangeError.

    >>> planar(6.4, (1580.0, 1580.0), (100.0, 100.0)).names
    ('x', 'y')
    """
    largest = sys.float_info.max
    Range("support mass", 0, largest, "kg", open_low=True).check(mass)
    kx, ky = (Range("support stiffness", 0, largest, "N/m").check(value) for value in stiffness)
    bx, by = (Range("support damping", 0, largest, "N·s/m").check(value) for value in damping)
    return LinearSupport(
        mass=((mass, 0.0), (0.0, mass)),
        damping=((bx, 0.0), (0.0, by)),
        stiffness=((kx, 0.0), (0.0, ky)),
        race_map=((1.0, 0.0), (0.0, 1.0)),
        names=("x", "y"),
    )
