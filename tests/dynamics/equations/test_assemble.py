"""The states of a scene, exact derivatives of its equations, and what is no mechanical system."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble, jacobian
from abu_calc.dynamics.scene import Scene
from abu_calc.foundation.errors import InputError
from tests.dynamics.equations.test_right_hand_side import GRAVITY, rhs_of
from tests.dynamics.scenes import ROTORS, SUPPORTS, coupled_scene, dimensionless, scene_on


@pytest.mark.parametrize("support", SUPPORTS)
def test_a_scene_has_the_states_of_its_effects_and_no_more(support):
    plain = assemble(scene_on(support))
    names = scene_on(support).support.names
    expected = [
        *names,
        *(f"{name}'" for name in names),
        *(f"θ{k}" for k in range(1, 6)),
        *(f"θ{k}'" for k in range(1, 6)),
    ]
    assert list(plain.states) == expected
    for rotor in ("guided", "driven"):
        equations = assemble(scene_on(support, *ROTORS[rotor], GRAVITY))
        assert equations.states == (*plain.states, "turn", "turn'")
        assert len({len(equations.scales), len(equations.initial), len(equations.relative), len(equations.states)}) == 1


def test_jacobian_is_the_limit_of_differences():
    equations = assemble(coupled_scene())
    y, h = np.linspace(-1, 2, 14), 1e-5
    exact = jacobian(equations, 0.7, y)
    for j in range(14):
        step = h * np.eye(14)[j]
        difference = (rhs_at(equations, y + step) - rhs_at(equations, y - step)) / (2 * h)
        # central differences: h² of the third derivative beside rounding/h
        np.testing.assert_allclose(exact[:, j], difference, rtol=1e-6, atol=1e-7)


def rhs_at(equations, y):
    return equations.rhs(np, 0.7, y, equations.acting)


def rotating_frame_eigenvalues(scene: Scene, angles: tuple[float, float]) -> np.ndarray:
    """Eigenvalues about the balanced state; in the frame that turns with an isotropic rotor nothing depends on time.

    y = B(t) z with q = R(Ωt) q_r, so at t = 0: z' = B⁻¹ (∂rhs B − B') z.
    """
    skew = np.array([[0.0, -1.0], [1.0, 0.0]])
    B = np.eye(8)
    B[2:4, :2] = scene.speed * skew
    turning = np.zeros((8, 8))
    turning[:2, :2] = turning[2:4, 2:4] = scene.speed * skew
    balanced = np.array([0.0] * 4 + [*angles] + [0.0] * 2)
    equations = assemble(scene)
    np.testing.assert_allclose(rhs_of(scene, 0.0, balanced), 0, atol=1e-15)
    return np.linalg.eigvals(np.linalg.solve(B, jacobian(equations, 0.0, balanced) @ B - turning @ B))


def test_published_eigenvalues_of_two_balls():
    """(Ω, μ, δ, ζ, β) = (2, .05, .01, .01, .01), as in Green, Champneys & Lieven 2006."""
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)
    half = math.acos(-0.01 / (2 * 0.05))
    values = rotating_frame_eigenvalues(scene, (half, -half))
    upper = sorted(values[values.imag > 0], key=lambda s: s.imag)
    expected = [-0.004952 + 0.068382j, -0.004087 + 0.744047j, -0.011363 + 1.006468j, -0.009185 + 2.956028j]
    np.testing.assert_allclose(upper, expected, atol=6e-7, rtol=0)


def test_support_that_is_no_mechanical_system_is_refused():
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)
    scene = replace(scene, support=replace(scene.support, mass=((1.0, 2.0), (2.0, 1.0))))
    with pytest.raises(InputError, match="positive definite"):
        assemble(scene)
