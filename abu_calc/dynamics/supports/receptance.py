"""The steady response of the support without balls."""

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.kinds import LinearSupport, Support, SwingArm
from abu_calc.errors import InputError

RESONANCE = 1e-12
"""Share that stiffness and inertia leave of each other where only rounding tells a speed from an undamped resonance."""


def receptance(support: Support, speed: float) -> NDArray[np.complex128]:
    """h = P (K − Ω²M + iΩ(C + ΩG))⁻¹ Pᵀ [m/N], d × d: motion of the frame by a unit force e^{iΩt} on it; Ω [rad/s].

    The rotor on a swing arm moves along y only, by l φ. Raises InputError at a resonance that nothing damps.
    """
    try:
        if isinstance(support, SwingArm):
            return np.array([[0, 0], [0, support.length**2 / _joint(support, speed)]], dtype=complex)
        P = np.array(support.race_map)
        return np.asarray(P @ np.linalg.solve(dynamic_stiffness(support, speed), P.T), dtype=complex)
    except (ZeroDivisionError, np.linalg.LinAlgError):
        raise _resonant(speed) from None


def _joint(arm: SwingArm, speed: float) -> complex:
    """c l² − Ω²J_O + iΩ b l² [N m]."""
    return complex(arm.stiffness * arm.length**2 - speed**2 * arm.inertia, speed * arm.damping * arm.length**2)


def _resonant(speed: float) -> InputError:
    return InputError(
        "the speed is a natural frequency of the support, which nothing damps: no steady amplitude to compare with",
        found=f"{speed:g} rad/s",
        remedy="give the support some damping, or another speed",
    )


def dynamic_stiffness(support: LinearSupport, speed: float) -> NDArray[np.complex128]:
    """K − Ω²M + iΩ(C + ΩG), N × N: forces on the coordinates by a unit motion e^{iΩt} of each; Ω [rad/s]."""
    dynamic = np.array(support.stiffness) - speed**2 * np.array(support.mass) + 1j * speed * np.array(support.damping)
    return np.asarray(
        dynamic + 1j * speed**2 * np.array(support.gyroscopic) if support.gyroscopic else dynamic, dtype=complex
    )


def unbalanced_amplitude(scene: Scene, imbalance: float | None = None) -> float:
    """A₀ [m]: the largest √(x² + y²) of the axis's steady motion without balls, of the scene's imbalance and couple.

    Or of another imbalance alone [kg m]. The forces (cos, sin)(Ωt + φ) are Re{(1, −i) e^{i(Ωt + φ)}}; the answer
    Re{(X, Y) e^{iΩt}} is an ellipse whose larger semi-axis is (|X + iY| + |X − iY|)/2. Raises InputError at a resonance
    that nothing damps.
    """
    if _left_of_stiffness(scene.support, scene.speed) < RESONANCE:
        raise _resonant(scene.speed)
    moments = [scene.imbalance * np.exp(1j * scene.imbalance_angle), scene.couple * np.exp(1j * scene.couple_angle)]
    if imbalance is not None:
        moments = [complex(imbalance), 0j]
    h = receptance(scene.support, scene.speed)
    forces = np.concatenate([moment * np.array((1, -1j)) for moment in moments])[: len(h)]
    X, Y, *_ = (h @ forces * scene.speed**2).tolist()
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2


def _left_of_stiffness(support: Support, speed: float) -> float:
    """Least stiffness of any motion at this speed, as a share of what springs and inertia have each."""
    if isinstance(support, SwingArm):
        whole = abs(support.stiffness) * support.length**2 + speed**2 * support.inertia
        return abs(_joint(support, speed)) / whole
    size = np.sqrt(np.abs(np.diag(support.stiffness)) + speed**2 * np.diag(support.mass))
    return float(np.linalg.svd(dynamic_stiffness(support, speed) / np.outer(size, size), compute_uv=False).min())


def reference_moment(scene: Scene) -> float:
    """max(m₀e, 1 % of Σ m R_p) [kg m]: what a residual imbalance is small against."""
    return max(scene.imbalance, 0.01 * scene.static_moment)


def weighing_amplitude(scene: Scene) -> float:
    """1 % of A₀ [m], the least that errors of an amplitude are measured in."""
    return 0.01 * unbalanced_amplitude(scene, reference_moment(scene))
