"""Where balls come to rest, by integration and in closed form."""

import cmath
from dataclasses import replace

from abu_calc.simulation.simulate import simulate
from tests.dynamics.closed_forms import balls_resultant
from tests.dynamics.scenes import dimensionless


def test_three_balls_fix_only_their_sum():
    scene = replace(
        dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5, 4.5), 250.0, inertia_factor=1.4), imbalance_angle=0.7
    )
    final = simulate(scene).response.final
    resultant = sum(cmath.rect(0.02, angle) for angle in final.ball_angles)
    assert abs(resultant - balls_resultant(0.02, 0.7)) < 1e-5
