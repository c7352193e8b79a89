"""The steady response of the support without balls."""

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import LinearSupport, Scene, Support, SwingArm


def receptance(support: Support, speed: float) -> NDArray[np.complex128]:
    """h = P (K − Ω²M + iΩ(C + ΩG))⁻¹ Pᵀ [m/N], d × d: motion of the frame by a unit force e^{iΩt} on it; Ω [rad/s].

    The rotor on a swing arm moves along y only, by l φ.
    """
    if isinstance(support, SwingArm):
        square = support.length**2
        joint = support.stiffness * square - speed**2 * support.inertia + 1j * speed * support.damping * square
        return np.array([[0, 0], [0, square / joint]], dtype=complex)
    P = np.array(support.race_map)
    return np.asarray(P @ np.linalg.solve(dynamic_stiffness(support, speed), P.T), dtype=complex)


def dynamic_stiffness(support: LinearSupport, speed: float) -> NDArray[np.complex128]:
    """K − Ω²M + iΩ(C + ΩG), N × N: forces on the coordinates by a unit motion e^{iΩt} of each; Ω [rad/s]."""
    dynamic = np.array(support.stiffness) - speed**2 * np.array(support.mass) + 1j * speed * np.array(support.damping)
    return np.asarray(
        dynamic + 1j * speed**2 * np.array(support.gyroscopic) if support.gyroscopic else dynamic, dtype=complex
    )


def unbalanced_amplitude(scene: Scene, imbalance: float | None = None) -> float:
    """A₀ [m]: the largest √(x² + y²) of the steady motion of the axis without balls, of the scene's imbalance and couple.

    Or of another imbalance alone [kg m]. The forces (cos, sin)(Ωt + φ) are Re{(1, −i) e^{i(Ωt + φ)}}; the answer
    Re{(X, Y) e^{iΩt}} is an ellipse whose larger semi-axis is (|X + iY| + |X − iY|)/2.
    """
    moments = [scene.imbalance * np.exp(1j * scene.imbalance_angle), scene.couple * np.exp(1j * scene.couple_angle)]
    if imbalance is not None:
        moments = [complex(imbalance), 0j]
    h = receptance(scene.support, scene.speed)
    forces = np.concatenate([moment * np.array((1, -1j)) for moment in moments])[: len(h)]
    X, Y, *_ = (h @ forces * scene.speed**2).tolist()
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2


def reference_moment(scene: Scene) -> float:
    """max(m₀e, 1 % of Σ m R_p) [kg m]: what a residual imbalance is small against."""
    return max(scene.imbalance, 0.01 * scene.static_moment)


def weighing_amplitude(scene: Scene) -> float:
    """1 % of A₀ [m], the least that errors of an amplitude are measured in."""
    return 0.01 * unbalanced_amplitude(scene, reference_moment(scene))
