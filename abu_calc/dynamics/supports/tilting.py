"""A rigid rotor on bearings, which moves in its plane and tilts, with gyroscopic moments."""

from collections.abc import Sequence

import numpy as np

from abu_calc.dynamics.equations.parameters import Array, Parameters
from abu_calc.dynamics.motion import Levers, Motion
from abu_calc.dynamics.supports.kinds import LARGEST, LinearSupport
from abu_calc.dynamics.supports.linear import DAMPING, MASS, STIFFNESS, Pair, rows, turned
from abu_calc.validity import Range


def tilting(
    mass: float,
    transverse_inertia: float,
    polar_inertia: float,
    positions: Sequence[float],
    stiffness: Sequence[Pair],
    damping: Sequence[Pair],
    axial_inertia: bool = True,
) -> LinearSupport:
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
    return LinearSupport(
        mass=rows(np.diag((MASS.check(mass), mass, transverse_inertia, transverse_inertia))),
        damping=rows(_of_bearings(positions, damping)),
        stiffness=rows(_of_bearings(positions, stiffness)),
        gyroscopic=rows(np.kron(np.diag((0.0, 1.0)), np.array(((0.0, J), (-J, 0.0))))) if J else (),
        race_map=rows(np.eye(4)),
        names=("x", "y", "tilt_x", "tilt_y"),
        axial_inertia=axial_inertia,
        bearings=tuple(positions),
    )


def _of_bearings(positions: Sequence[float], values: Sequence[Pair]) -> Array:
    """Σ over bearings of what acts against the motion of its place, in the four coordinates."""
    pairs = zip(positions, values, strict=True)
    total: Array = sum((np.kron(np.array(((1, z), (z, z * z))), np.diag(pair)) for z, pair in pairs), np.zeros((4, 4)))
    return total


def levers(m: Motion, p: Parameters) -> Levers:
    """A = (x'', y'', Θ''): T = (e_t, z e_t), N = (e_r, z e_r); along the spindle a ball moves by −R_p Θ·e_r."""
    plane: Array = np.array(((m.cos, m.sin), (-m.sin, m.cos)))
    outward, along = np.concatenate([plane, p.places * plane], axis=1)
    found = Levers(along, outward, p.whole_mass)
    if p.tilt_map is not None:
        _add_axial(m, p, found)
    return turned(m, p, found)


def _add_axial(m: Motion, p: Parameters, levers: Levers) -> None:
    """−R_p Θ·e_r along the spindle, its rate −R_p (Θ'·e_r + γ' Θ·e_t), and so on; R_p even off a groove's middle.

    A race that leans is narrower, seen along the spindle: R_p² less the square of that way. So what goes round with it
    flies outward a little less, which makes up for the pull the way along the spindle would have by itself.
    """
    tx, ty, vx, vy = p.tilt_map.dot(m.support)  # type: ignore[union-attr]
    zero = 0.0 * m.cos
    swept = p.radii * (tx * m.sin - ty * m.cos)
    carried = 2 * p.radii * m.swing * (vx * m.sin - vy * m.cos)
    height = -p.radii * (tx * m.cos + ty * m.sin)
    rise = swept * m.swing - p.radii * (vx * m.cos + vy * m.sin)
    lever = [zero, zero, -p.radii * m.cos, -p.radii * m.sin]
    if p.rotor == "guided":
        carried = carried + swept * m.acceleration
    if p.rotor == "driven":
        lever.append(swept)
    levers.axial = (np.array(lever), carried, swept / m.radii)
    levers.height, levers.sunk, levers.sinking = (height, rise), height * height, 2 * m.swing * height * rise
