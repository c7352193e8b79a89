"""Needed resultants of balls at rest in the rotor (Kladiev 1996, eq. (4), in the right quadrant).

Imbalances are complex numbers U e^{iφ} [kg m], φ from the zero mark. The rotor is idle and freely
suspended.
"""

import cmath
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.receptance import receptance
from abu_calc.errors import NotTrustworthyError

SAME: Final = 1e-12
"""Relative; what differs by less is the same but for rounding."""

Complex = NDArray[np.complex128]


class NotKnownError(NotTrustworthyError):
    """The balls may have a state of rest, but no formula here gives it."""


def needed_resultants(scene: Scene) -> dict[float, complex]:
    """V [kg m] by the place z [m] of each plane with balls: what the balls of its races must add up to.

    In one plane V = −m₀e e^{iφ}. On a support that tilts, force and couple must vanish: Σ V = −U, Σ zV = −W, U and W
    the imbalance at the centre of mass and the couple χ(J_t − J_p); of more than two planes the split is that with the
    least Σ |V|²/Σm R_p. One plane elsewhere than the imbalance balances nothing, but its balls can hold their race
    still, V = −h(z; U, W)/h(z; 1, z), h its motion by forces and couples: known on isotropic supports. Range: small
    tilts. Raises NotKnownError on others. Source: derived.
    """
    own = -cmath.rect(scene.imbalance, scene.imbalance_angle)
    planes = {race.plane_offset: 0.0 for race in scene.races if race.ball_masses}
    if not planes:
        return {}
    couple = -cmath.rect(scene.couple, scene.couple_angle)
    for race in scene.races:
        if race.ball_masses:
            planes[race.plane_offset] += race.static_moment
    if len(planes) == 1:
        (place,) = planes
        if still_axis(scene):
            return {place: own}
        lever = np.array((1, place)) @ _forward(scene.support, scene.speed)
        return {place: complex(lever @ (own, couple) / (lever @ (1, place)))}
    places, capacities = np.array(list(planes)), np.array(list(planes.values()))
    unit = float(np.abs(places).max(initial=0.0)) or 1.0
    rows = np.array((np.ones_like(places), places / unit))
    # Weighed by capacity, the smallest solution of two equations.
    shares = capacities[:, None] * rows.T @ np.linalg.pinv(rows * capacities @ rows.T)
    return dict(zip(planes, (shares @ (own, couple / unit)).tolist(), strict=True))


def still_axis(scene: Scene) -> bool:
    """True if balls can leave no imbalance and no couple at all: force and couple vanish together."""
    planes = {race.plane_offset for race in scene.races if race.ball_masses}
    if len(planes) > 1:
        return True
    U = cmath.rect(scene.imbalance, scene.imbalance_angle)
    W = cmath.rect(scene.couple, scene.couple_angle)
    if not planes:
        return not (U or W)
    couple = U * next(iter(planes))
    return abs(W - couple) <= SAME * (abs(W) + abs(couple))


def _forward(support: Support, speed: float) -> Complex:
    """x + iy and θ_y − iθ_x, rotating with the rotor, by a force and a couple that rotate with it: 2 × 2."""
    h = receptance(support, speed)
    straight, crossed = h[::2, ::2], h[::2, 1::2]
    mirrored = np.abs(h[1::2, 1::2] - straight).max() + np.abs(h[1::2, ::2] + crossed).max()
    if mirrored > 1e-9 * np.abs(h).max():
        raise NotKnownError(
            "one race elsewhere than the imbalance, on a support that differs along x and y: its balls cannot come "
            "to rest, they swing twice per turn about a place that is not computed"
        )
    return np.asarray(straight - 1j * crossed, dtype=complex)
