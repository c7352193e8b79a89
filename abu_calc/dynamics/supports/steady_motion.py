"""Steady motion of a support without balls, and the amplitudes with which errors are compared."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.support import Circumstances, Support, undamped_resonance
from abu_calc.formulas.motion import HARDLY

RESONANCE = 1e-12
"""Share that stiffness and inertia leave of each other where only rounding parts a speed from an undamped resonance."""


def receptance(support: Support, speed: float) -> NDArray[np.complex128]:
    """h = P (K − Ω²M + iΩ(C + ΩG))⁻¹ Pᵀ [m/N], d × d: motion of the frame by a unit force e^{iΩt} on it; Ω [rad/s].

    Raises InputError at a resonance that nothing damps.
    """
    return support.small_motion(speed).receptance(speed)


def unbalanced_amplitude(scene: Circumstances, imbalance: float | None = None) -> float:
    """A₀ [m]: the largest √(x² + y²) of the axis's steady motion without balls, of the scene's imbalance and couple.

    Or of another imbalance alone [kg m]. The forces (cos, sin)(Ωt + φ) are Re{(1, −i) e^{i(Ωt + φ)}}; the answer
    Re{(X, Y) e^{iΩt}} is an ellipse whose larger semi-axis is (|X + iY| + |X − iY|)/2. Raises InputError at a resonance
    that nothing damps.
    """
    h = _damped(scene.support, scene.speed)
    imbalances = [scene.imbalance * np.exp(1j * scene.imbalance_angle), scene.couple * np.exp(1j * scene.couple_angle)]
    if imbalance is not None:
        imbalances = [complex(imbalance), 0j]
    forces = np.concatenate([each * np.array((1, -1j)) for each in imbalances])[: len(h)]
    X, Y, *_ = (h @ forces * scene.speed**2).tolist()
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2


@lru_cache(maxsize=64)
def _damped(support: Support, speed: float) -> NDArray[np.complex128]:
    """`receptance`, not even near such a resonance; many scenes of a machine have the same."""
    motion = support.small_motion(speed)
    if motion.left_of_stiffness(speed) < RESONANCE:
        raise undamped_resonance(speed)
    h = motion.receptance(speed)
    h.flags.writeable = False
    return h


def reference_imbalance(scene: Circumstances) -> float:
    """max(m₀e, 1 % of Σ m R_p) [kg m], m₀e of the machine: what a residual imbalance is small against."""
    return max(scene.imbalance, scene.largest_imbalance, HARDLY * scene.static_moment)


def weighing_amplitude(scene: Circumstances) -> float:
    """1 % of A₀ [m], the least that errors of an amplitude are measured in."""
    return 0.01 * unbalanced_amplitude(scene, reference_imbalance(scene))
