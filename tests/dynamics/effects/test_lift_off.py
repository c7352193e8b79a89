"""A disk on a swing arm leaves its work and comes back: by closed form, and beside an arm whose work pulls."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from abu_calc import simulate
from abu_calc.dynamics.effects.lift_off import LiftOffEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport, cutting_arm
from abu_calc.dynamics.switching.modes import starting
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.formulas.swing_arm import Arm
from abu_calc.foundation.errors import InputError
from abu_calc.simulation.scene_file import read_scene
from abu_calc.simulation.scene_of_file import scene_from
from tests.dynamics.scenes import scene_on

LENGTH, INERTIA, WORK, TOUCH, MOMENT, GAP = 0.35, 0.62, 1e6, 0.035, 20.0, 2e-4
"""Of an arm that nothing but its work and a constant moment holds [SI, rad]."""

PULLED = Path(__file__).parents[2] / "machines" / "arm-pulls-on-work.toml"


def bouncing(gap: float = GAP, effects: tuple[LiftOffEffect, ...] | None = None) -> Scene:
    """The arm alone, at rest off its work by a gap [rad], for three bounces."""
    square, depth = LENGTH**2, MOMENT / (WORK * LENGTH**2)
    support = SwingArmSupport(LENGTH, INERTIA, WORK, 0.0, MOMENT + WORK * square * TOUCH)
    own = (LiftOffEffect(WORK, LENGTH, TOUCH, depth),) if effects is None else effects
    return Scene("arm", support, 600.0, 0.0, 0.0, (), 3 * period(gap), (TOUCH - gap,), (0.0,), effects=own)


def period(gap: float) -> float:
    """From rest at a gap to rest there again: free fall to the work, its half wave about the place of rest, and back.

    φ'' = M/J up to φ₀, reached with v² = 2 M a/J; then x = s + A sin(ωt − δ), ω = l√(c/J), s = M/(c l²),
    A² = s² + (v/ω)², sin δ = s/A, for (π + 2δ)/ω.
    """
    fall, speed = math.sqrt(2 * gap * INERTIA / MOMENT), math.sqrt(2 * MOMENT * gap / INERTIA)
    natural, rest = LENGTH * math.sqrt(WORK / INERTIA), MOMENT / (WORK * LENGTH**2)
    swing = math.hypot(rest, speed / natural)
    return 2 * fall + (math.pi + 2 * math.asin(rest / swing)) / natural


def through(scene: Scene, integrator: str, tolerance: float = 1e-9) -> Trajectory:
    """The motion at a hundred moments."""
    equations = assemble(scene)
    times = np.linspace(0, scene.duration, 101)
    return choose(equations, integrator, tolerance).integrate(equations, tolerance, times, 10**6)


@pytest.mark.few(2)
@pytest.mark.parametrize("integrator", ["compiled", "plain", "scipy"])
@pytest.mark.parametrize("gap", [2e-6, GAP, 5e-3])
def test_an_arm_bounces_as_by_hand(integrator: str, gap: float) -> None:
    """After three bounces it is back where it was let go, having met and left its work three times."""
    found = through(bouncing(gap), integrator)
    assert found.events == 6
    assert found.y[0, -1] == pytest.approx(TOUCH - gap, abs=1e-6 * gap)
    assert abs(found.y[1, -1]) < 1e-5 * math.sqrt(2 * MOMENT * gap / INERTIA)


def test_work_that_pulls_would_never_let_go() -> None:
    """Without the effect the arm swings about its place of rest, as a spring that pulls makes it."""
    scene = bouncing(effects=())
    natural, rest = LENGTH * math.sqrt(WORK / INERTIA), TOUCH + MOMENT / (WORK * LENGTH**2)
    found = through(scene, "compiled")
    expected = rest + (TOUCH - GAP - rest) * np.cos(natural * found.t)
    assert found.y[0] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(
    ("angle", "rate", "mode"),
    [(1e-4, 0.0, 1.0), (-1e-4, 0.0, 0.0), (0.0, 1.0, 1.0), (0.0, -1.0, 0.0), (0.0, 0.0, 1.0)],
)
@pytest.mark.parametrize("side", [1, -1])
def test_whether_it_touches_at_first(angle: float, rate: float, mode: float, side: int) -> None:
    """By where the disk is; at the surface by where it goes, or where the moment pushes it. On either side."""
    scene = bouncing()
    (effect,) = scene.effects
    assert isinstance(effect, LiftOffEffect)
    turned = replace(effect, touch_angle=side * effect.touch_angle, depth=side * effect.depth)
    support = replace(scene.support, torque=side * scene.support.torque)  # type: ignore[type-var]
    place = (side * (TOUCH + angle),), (side * rate,)
    there = replace(scene, support=support, effects=(turned,), start_position=place[0], start_velocity=place[1])
    assert starting(assemble(there))[1] == (mode,)


def test_an_arm_that_stays_pressed_moves_as_the_linear_one() -> None:
    """To the last bit: the effect adds nothing while they touch."""
    arm = cutting_arm(Arm(LENGTH, INERTIA, 2000.0, 40.0, WORK, 0.4, 0.115, 1.4, 0.02, 900.0))
    (rest,) = arm.resting_position()
    scene = replace(
        scene_on("swing arm"), support=arm, speed=600.0, imbalance=1e-5, races=(), duration=0.2,
        start_position=(rest,), start_velocity=(0.0,),
    )  # fmt: skip
    effect = LiftOffEffect(arm.stiffness - 2000.0, LENGTH, 0.02, rest - 0.02)
    pressed = through(replace(scene, effects=(effect,)), "compiled")
    assert pressed.events == 0
    assert pressed.y == pytest.approx(through(scene, "compiled").y, rel=1e-9, abs=1e-12)


def test_a_cutting_arm_of_a_file_lifts_off() -> None:
    """The work of the file stands in it: c_n g(Z) at 90° with f = 0.45 and R/l = 115/350."""
    scene = scene_from(read_scene(str(PULLED)).scene)
    effect = scene.effect("lift_off")
    assert isinstance(effect, LiftOffEffect)
    assert effect.stiffness == pytest.approx(1e6 * (1 + 0.45 * 115 / 350), rel=1e-12)
    assert effect.touch_angle == pytest.approx(math.radians(2))
    # (M_p − c_sh l² φ₀)/(l²(c_sh + c_n g)): what the moment presses beyond the joint that holds it.
    expected = (20 - 2000 * 0.35**2 * math.radians(2)) / (0.35**2 * (2000 + effect.stiffness))
    assert effect.depth == pytest.approx(expected, rel=1e-9)


@pytest.mark.slow
def test_balls_balance_where_the_work_does_not_pull() -> None:
    """Pulled back by the work they stall at −2123 rpm and 142.6 dB; pressed alone they come to rest and balance."""
    machine = read_scene(str(PULLED))
    found = simulate(machine)
    assert max(map(abs, found.final.ball_speeds_rpm)) < 5
    assert found.level_db < 120
    assert found.residual_imbalance_g_mm < 100
    (check,) = (check for check in found.checks if check.code == "ABU801")
    if check.status == "fail":
        assert "chaotic" in check.message and any("every run" in warning for warning in found.warnings)
    pulled = simulate(machine, without_effects=["lift_off"])
    assert min(pulled.final.ball_speeds_rpm) < -2000 and pulled.level_db == pytest.approx(142.6, abs=0.5)


def test_numbers_outside_its_range_are_refused() -> None:
    for numbers in ((WORK, 0.0, TOUCH, 1e-4), (WORK, LENGTH, TOUCH, 0.0), (WORK, LENGTH, TOUCH, math.nan)):
        with pytest.raises(InputError):
            LiftOffEffect(*numbers)
