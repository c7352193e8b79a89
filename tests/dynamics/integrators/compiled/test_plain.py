"""Equations as plain Python: those of the scene, and no number where Python would raise."""

import math

import numpy as np

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import plain, run
from abu_calc.dynamics.integrators.compiled.program import Program
from tests.dynamics.scenes import scene_on

TEXT = """\
def setup(numbers: Reals, par: Reals) -> None:
 par[0] = 1 / numbers[0]
def rates(t: float, y: Reals, par: Reals, dy: Reals) -> None:
 dy[0] = sqrt(y[0]) / par[0]
 dy[1] = 2.0
 return
def watched(t: float, y: Reals, par: Reals, dy: Reals, w: Reals) -> None:
 dy[0] = sin(y[0])
 w[0] = y[0]
 return
def apparent(t: float, y: Reals, par: Reals, w: Reals) -> None:
 w[0] = y[0]
 return
"""


def test_rates_that_python_cannot_compute_are_no_numbers() -> None:
    """As compiled code has them: the loop then shortens its step."""
    functions = plain._equations(Program(TEXT, 1, 1, (1,), (0,), {}))
    for y, par in ((-1.0, 1.0), (1.0, 0.0), (math.inf, math.inf)):
        dy = [0.0, 0.0]
        functions["rates"](0.0, [y], [par], dy)
        assert math.isnan(dy[0])
    dy = [0.0, 0.0]
    functions["rates"](0.0, [9.0], [2.0], dy)
    assert dy == [1.5, 2.0]


def test_loops_of_two_structures_do_not_share_their_equations() -> None:
    first, second = (plain._loop(Program(TEXT.replace("2.0", number), 1, 1, (1,), (0,), {}), "rk45") for number in "34")
    for loop, number in ((first, 3), (second, 4)):
        dy = [0.0, 0.0]
        loop.__globals__["rates"](0.0, [1.0], [1.0], dy)
        assert dy[1] == number


def test_a_run_in_plain_python_starts_at_the_start_and_counts_its_work() -> None:
    effects = BallContactEffect(0.1, 0.5), DryRollingFrictionEffect(0.002, 0.1)
    equations = assemble(scene_on("planar", *effects))
    trajectory = run.integrate(equations, 1e-4, [0.0, 0.5], compiled=False)
    np.testing.assert_array_equal(trajectory.y[:, 0], equations.initial)
    assert trajectory.integrator.startswith("plain-") and trajectory.evaluations > 6 * trajectory.steps > 0
