"""Where balls come to rest, by integration and in closed form."""

import cmath
import math
from dataclasses import replace

import pytest

from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.simulation.simulate import simulate
from tests.dynamics.closed_forms import balls_resultant, resting_amplitude
from tests.dynamics.scenes import dimensionless


def degrees(angles: tuple[float, ...]) -> list[float]:
    return sorted(math.degrees(angle) % 360 for angle in angles)


def test_two_balls_balance_above_resonance():
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 250.0)
    response = simulate(scene).response
    assert degrees(response.ball_angles) == pytest.approx([120, 240], abs=0.01)
    assert response.axis_amplitude < 1e-3 * response.unbalanced_amplitude
    assert response.residual_imbalance < 1e-3 * scene.imbalance
    assert response.final.ball_speeds == pytest.approx((0, 0), abs=1e-4)


def test_three_balls_fix_only_their_sum():
    scene = replace(
        dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5, 4.5), 250.0, inertia_factor=1.4), imbalance_angle=0.7
    )
    final = simulate(scene).response.final
    resultant = sum(cmath.rect(0.02, angle) for angle in final.ball_angles)
    assert abs(resultant - balls_resultant(0.02, 0.7)) < 1e-5


def merged(scene: Scene, guess: float) -> complex:
    """Axis displacement w in the rotor with all balls at the angle ψ where it pulls no further: Im(w e^{−iψ}) = 0."""
    support, b = scene.support, scene.static_moment
    mass = support.mass[0][0] + sum(scene.ball_masses)
    D = support.stiffness[0][0] - mass * scene.speed**2 + 1j * scene.speed * support.damping[0][0]

    def displacement(psi: float) -> complex:
        return (scene.imbalance + cmath.rect(b, psi)) * scene.speed**2 / D

    low, high = guess - 1.0, guess + 1.0
    side = (displacement(low) * cmath.rect(1, -low)).imag > 0
    for _ in range(60):
        middle = (low + high) / 2
        inside = ((displacement(middle) * cmath.rect(1, -middle)).imag > 0) == side
        low, high = (middle, high) if inside else (low, middle)
    return displacement(low)


@pytest.mark.parametrize(
    ("speed", "imbalance", "moment", "guess"),
    [
        (0.5, 0.02, 0.04, 0.0),  # below resonance: on the heavy side, worse than without
        (3.0, 0.10, -0.04, math.pi),  # above, too little capacity: on the light side
    ],
)
def test_merged_balls(speed, imbalance, moment, guess):
    scene = dimensionless(speed, 0.02, imbalance, 0.05, 0.3, (guess + 0.5, guess - 0.8), 400.0)
    response = simulate(scene).response
    assert response.axis_amplitude == pytest.approx(abs(merged(scene, guess)), rel=1e-3)
    # Without damping in the formula: it is second order in 2ζΩ/|1 − Ω²|, here below 1 %.
    undamped = resting_amplitude(imbalance, moment, speed, 1.04, math.sqrt(1 / 1.04))
    assert response.axis_amplitude == pytest.approx(undamped, rel=0.01)
    assert (response.axis_amplitude > response.unbalanced_amplitude) is (speed < 1)
    assert response.final.ball_speeds == pytest.approx((0, 0), abs=1e-4)


def test_disc_with_a_mass_of_one_kilogram():
    """Disc of 20 kg with 1 kg at 1 m and 45°, two balls of 1 kg started at 55° and 15°: published end 165° and 285°."""
    scene = Scene(
        name="disc",
        support=planar(21.0, (10.0, 10.0), (1.0, 1.0)),
        speed=1.5,
        imbalance=1.0,
        imbalance_angle=math.radians(45),
        races=(Race(1.0, (1.0, 1.0), 0.5, 1.0, (math.radians(55), math.radians(15)), (0.0, 0.0)),),
        duration=300.0,
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
    )
    # Published to whole degrees.
    assert degrees(simulate(scene).response.ball_angles) == pytest.approx([165, 285], abs=0.5)
