"""Two modes of balanced balls, by the characteristic equation and by the motion of every ball."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.two_modes import TwoModes, two_modes
from tests.dynamics.scenes import coupled_scene, dimensionless, scene_on

ZETA, DRAG, FACTOR, BALL = 0.1, 0.07, 1.4, 0.02
FAN = (0.0, 1.3, math.pi, math.pi + 1.3)
SCENE = dimensionless(2.0, BALL, 0.0, ZETA, DRAG, FAN, 10.0, inertia_factor=FACTOR)


def modes(scene: Scene = SCENE) -> TwoModes:
    """Those of a scene whose balls stand where they start."""
    two = two_modes(BalancedMotion(scene, FAN))
    assert two is not None
    return two


def equation(s: complex, speed: float) -> complex:
    """X² D(a)D(b) − (N/2)(a⁴D(b) + b⁴D(a)) X + (N/2)²(1 − χ²) a⁴b⁴ with χ = |Σ e^{2iθ}|/4 = cos 1.3 here."""
    mass = 1 + 4 * BALL
    chi, half = abs(math.cos(1.3)), 2 * BALL / mass
    a, b = s + 1j * speed, s - 1j * speed
    X, Da, Db = FACTOR * s * s + DRAG * s, *(z * z + (2 * ZETA * z + 1) / mass for z in (a, b))
    return X * X * Da * Db - half * (a**4 * Db + b**4 * Da) * X + half**2 * (1 - chi**2) * a**4 * b**4


@pytest.mark.parametrize("speed", [0.7, 1.3, 2.0, 5.0])
def test_eigenvalues_obey_the_characteristic_equation(speed: float) -> None:
    """The equation is divided by what it is two per cent beside the root."""
    two = modes()
    x = speed / two.unit
    L = two.polynomial()
    values = np.linalg.eigvals(L[0] + L[1] * x + L[2] * x * x) * two.unit
    assert [two.growing(speed, least) for least in (-9, 1e-6, 9)] == [
        (values.real > least).sum() for least in (-9, 1e-6, 9)
    ]
    for value in values:
        if abs(value) > 1e-6:
            assert abs(equation(value, speed)) < 1e-6 * abs(equation(1.02 * value + 0.001, speed))
    assert two.likeness == pytest.approx(abs(math.cos(1.3)))


def test_balls_on_one_line_have_one_mode() -> None:
    on_line = replace(modes(), likeness=1.0)
    assert len(on_line.shares) == 1 and len(modes().shares) == 2
    assert sum(share**2 for share in modes().shares) == pytest.approx(4.0)  # n, shared out by χ
    nearly = replace(modes(), likeness=1 - 1e-6)
    assert nearly.on_one_line.likeness == 1.0 and modes().on_one_line.likeness == modes().likeness


def test_scenes_without_such_modes_have_none() -> None:
    for scene in (coupled_scene(), scene_on("planar"), scene_on("swing arm"), scene_on("tilting")):
        assert two_modes(BalancedMotion(scene, scene.start_angles)) is None
    assert two_modes(BalancedMotion(SCENE, FAN, (0.1, 0.1j))) is None
    assert modes(replace(SCENE, effects=(GravityEffect(),))).growth(2.0) == modes().growth(2.0)
