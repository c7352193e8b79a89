"""The steady response of the support without balls."""

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import LinearSupport, Scene


def receptance(support: LinearSupport, speed: float) -> NDArray[np.complex128]:
    """h = P (K − Ω²M + iΩC)⁻¹ Pᵀ [m/N], 2 × 2: motion of the race centre by a unit force e^{iΩt} on it; Ω [rad/s]."""
    P = np.array(support.race_map)
    dynamic = np.array(support.stiffness) - speed**2 * np.array(support.mass) + 1j * speed * np.array(support.damping)
    return np.asarray(P @ np.linalg.solve(dynamic, P.T), dtype=complex)


def unbalanced_amplitude(scene: Scene, imbalance: float | None = None) -> float:
    """A₀ [m]: the largest √(x² + y²) of the steady motion without balls, of the scene's imbalance or another [kg m].

    The force (cos, sin)(Ωt) is Re{(1, −i) e^{iΩt}}; the answer Re{(X, Y) e^{iΩt}} is an ellipse whose larger
    semi-axis is (|X + iY| + |X − iY|)/2.
    """
    moment = scene.imbalance if imbalance is None else imbalance
    X, Y = (receptance(scene.support, scene.speed) @ np.array((1, -1j)) * moment * scene.speed**2).tolist()
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2
