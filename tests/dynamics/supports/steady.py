"""A rotor without balls on a support, and the check that a steady motion solves its equations."""

import cmath
from dataclasses import replace

import numpy as np

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import LinearSupport

EMPTY = Race(0.03, (), 0.0, 1.0, (), ())
MASS, TRANSVERSE, POLAR, PLACES = 0.8, 0.0138, 0.00124, (0.110, -0.150)
SPEED = 314.0


def scene_on(support: LinearSupport, **changes) -> Scene:
    """A rotor without balls on a support."""
    still = (0.0,) * len(support.names)
    scene = Scene("test", support, SPEED, 5e-5, 0.3, (EMPTY,), 1.0, still, still)
    return replace(scene, **changes)


def acceleration(scene: Scene, position: np.ndarray, velocity: np.ndarray, t: float = 0.0) -> np.ndarray:
    """q'' of a scene, with balls at rest at their start angles."""
    equations = assemble(scene)
    balls, size = len(scene.ball_masses), len(position)
    y = np.concatenate([position, velocity, scene.start_angles, np.zeros(balls)])
    return equations.rhs(np, t, y, equations.acting)[size : 2 * size]


def assert_steady(scene: Scene, phasors: np.ndarray, frequency: float | None = None) -> None:
    """Re(phasors e^{iωt}) solves the equations of the scene at any moment."""
    omega = scene.speed if frequency is None else frequency
    for t in (0.0, 0.37 / omega, 2.5 / omega):
        turning = phasors * cmath.exp(1j * omega * t)
        computed = acceleration(scene, turning.real, (1j * omega * turning).real, t)
        np.testing.assert_allclose(computed, -(omega**2) * turning.real, rtol=1e-9, atol=1e-12 * omega**2)
