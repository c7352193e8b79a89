"""Linear supports M q'' + C q' + K q = Pᵀ F."""

import numpy as np

from abu_calc.dynamics.equations.parameters import Array, Parameters
from abu_calc.dynamics.motion import Levers, Motion
from abu_calc.dynamics.supports.kinds import LARGEST, LinearSupport, Matrix
from abu_calc.validity import Range

Pair = tuple[float, float]
"""Along x and along y."""

MASS = Range("support mass", 0, LARGEST, "kg", open_low=True)
STIFFNESS = Range("support stiffness", 0, LARGEST, "N/m")
DAMPING = Range("support damping", 0, LARGEST, "N·s/m")


def planar(mass: float, stiffness: Pair, damping: Pair) -> LinearSupport:
    """A point mass [kg] on springs [N/m] and dampers [N·s/m] along x and y; its coordinates are the race centre itself.

    M x'' + b_x x' + k_x x = F_x, likewise y (Kladiev 1996, eq. (1), with the damping that free motion along the work
    needs to die out). Mass positive, stiffness and damping not negative; raises RangeError.

    >>> planar(6.4, (1580.0, 1580.0), (100.0, 100.0)).names
    ('x', 'y')
    """
    MASS.check(mass)
    kx, ky = map(STIFFNESS.check, stiffness)
    bx, by = map(DAMPING.check, damping)
    return LinearSupport(
        mass=((mass, 0.0), (0.0, mass)),
        damping=((bx, 0.0), (0.0, by)),
        stiffness=((kx, 0.0), (0.0, ky)),
        race_map=((1.0, 0.0), (0.0, 1.0)),
        names=("x", "y"),
    )


AHEAD = np.array(((-1.0,), (1.0,)))
"""(−sin γ, cos γ) from (sin γ, cos γ)."""


def rows(matrix: Array) -> Matrix:
    """A matrix as a scene holds it."""
    return tuple(tuple(row) for row in matrix.tolist())


def levers(m: Motion, p: Parameters) -> Levers:
    """Races in one plane: A = (x'', y''), so T = (−sin γ, cos γ) and N = (cos γ, sin γ); one row more if driven."""
    outward = np.array((m.cos, m.sin))
    found = Levers(AHEAD * outward[::-1], outward, p.whole_mass)
    return found if p.rotor == "steady" else turned(m, p, found)


def turned(m: Motion, p: Parameters, levers: Levers) -> Levers:
    """The levers with what a changing speed of the rotor does: carried along where it is given, one row if driven."""
    if p.rotor == "guided":
        levers.carry(m.radii * m.acceleration, 0.0 * m.radii)
    elif p.rotor == "driven":
        levers.along = np.vstack([levers.along, m.radii])
        levers.outward = np.vstack([levers.outward, 0.0 * m.radii])
        levers.mass = None
    return levers


def imbalance(m: Motion, p: Parameters) -> tuple[Array, Array | None]:
    """m₀e (Ω² e_r − Ω' e_t) at the centre of mass, and χ(J_t − J_p) likewise on the tilts; what it weighs when driven.

    The second of these is the couple imbalance, a polar axis of inertia that leans by χ.
    """
    place = p.turning_places + m.turn
    force = p.turning_moments * (m.speed * m.speed * m.xp.cos(place))
    if p.rotor == "steady":
        return force, None
    beside = p.turning_moments * m.xp.sin(place)
    if p.rotor == "guided":
        return force + m.acceleration * beside, None
    size = len(p.frame_mass)
    weight = np.zeros((size, size), dtype=object if m.xp is not np else m.support.dtype)
    weight[-1, :-1] = weight[:-1, -1] = -beside
    return np.append(force, 0.0), weight
