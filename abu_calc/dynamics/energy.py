"""Mass matrix, energy and power of a scene: the Lagrangian side of the equations, which holds them to account.

Nothing here is used by `equations`; a sign lost on either side breaks the symmetry or the balance of energy.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene


def mass_matrix(scene: Scene, gamma: NDArray[np.float64]) -> NDArray[np.float64]:
    """The symmetric, positive definite matrix of the kinetic energy ½ vᵀ M v, v = (q', γ') [kg, kg m, kg m²].

    T = ½ q'ᵀ M q' + Σ ½ m |r' + R_p γ' (−sin γ, cos γ)|² + Σ ½ (J − 1) m R_p² γ'². The last term is a ball's rolling:
    its spin relative to the turning race, less a total derivative (Kladiev 1996, eq. (12), uses the same 7/5).
    """
    return _mass_matrix(scene, np.asarray(gamma, dtype=float))


def _mass_matrix(scene: Scene, gamma: NDArray[Any]) -> NDArray[Any]:
    race = scene.race
    P = np.array(scene.support.race_map)
    masses = np.array(race.ball_masses, dtype=float)
    moments = masses * race.pitch_radius
    own = np.array(scene.support.mass) + masses.sum() * P.T @ P
    coupling = P.T @ np.array((-moments * np.sin(gamma), moments * np.cos(gamma)))
    return np.block([[own, coupling], [coupling.T, np.diag(race.inertia_factor * moments * race.pitch_radius)]])


def _split(scene: Scene, t: float, y: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any], NDArray[Any], NDArray[Any]]:
    """(q, q', γ, γ') of a state."""
    size, balls = len(scene.support.names), len(scene.race.ball_masses)
    q, velocity, theta, rate = np.split(y, [size, 2 * size, 2 * size + balls])
    return q, velocity, theta + scene.speed * t, rate + scene.speed


def energy(scene: Scene, t: float, y: NDArray[Any]) -> Any:
    """E = ½ vᵀ M v + ½ qᵀ K q [J]; real for real states, complex for the complex step."""
    q, velocity, gamma, gamma_rate = _split(scene, t, y)
    v = np.concatenate([velocity, gamma_rate])
    return (v @ _mass_matrix(scene, gamma) @ v + q @ np.array(scene.support.stiffness) @ q) / 2


def power(scene: Scene, t: float, y: NDArray[Any]) -> Any:
    """dE/dt [W]: the imbalance's work, less damping, and the drag's work Σ m R_p² h₀ (Ω − γ') γ'.

    The drag's part is what the drive puts in, m R_p² h₀ Ω(Ω − γ'), less what turns to heat, m R_p² h₀ (Ω − γ')².
    """
    race = scene.race
    _, velocity, _, gamma_rate = _split(scene, t, y)
    phase = scene.speed * t + scene.imbalance_angle
    force = scene.imbalance * scene.speed**2 * np.array((np.cos(phase), np.sin(phase)))
    inertias = np.array(race.ball_masses, dtype=float) * race.pitch_radius**2
    return (
        force @ (np.array(scene.support.race_map) @ velocity)
        - velocity @ np.array(scene.support.damping) @ velocity
        + (inertias * race.drag * (scene.speed - gamma_rate)) @ gamma_rate
    )
