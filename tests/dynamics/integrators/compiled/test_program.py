"""Functions of a structure give what its equations do; balls are numbered round their races."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled.plain import _equations
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS, in_order, places, program
from abu_calc.dynamics.integrators.compiled.run import described
from abu_calc.dynamics.switching.modes import watched
from tests.dynamics.scenes import ROTORS, SUPPORTS, scene_on

EFFECTS = GravityEffect(0.3), BallContactEffect(0.1, 0.5), DryRollingFrictionEffect(0.002, 0.1)


@pytest.mark.parametrize(
    ("support", "rotor"), [("planar", "steady"), ("tilting, axial", "guided"), ("swing arm", "driven")]
)
def test_rates_and_watched_numbers_are_those_of_the_equations(support: str, rotor: str) -> None:
    equations = in_order(assemble(scene_on(support, *ROTORS[rotor], *EFFECTS)))[0]
    wide, _, numbers = described(equations)
    made = program(equations, wide)
    functions = _equations(made)
    assert made.numbers == len(numbers) and set(EQUATIONS) <= functions.keys()
    y = np.array(equations.initial) + 0.01 * np.cos(np.arange(len(equations.initial)))
    par, dy, again = [0.0] * made.parameters, [0.0] * len(y), [0.0] * len(y)
    values = [0.0] * made.values
    functions["setup"](numbers.tolist(), par)
    functions["rates"](0.3, y.tolist(), par, dy)
    functions["watched"](0.3, y.tolist(), par, again, values)
    np.testing.assert_allclose(dy, equations.rhs(np, 0.3, y, wide), rtol=1e-10, atol=1e-12)
    assert again == pytest.approx(dy, rel=1e-12)
    np.testing.assert_allclose(values[: sum(made.watched)], watched(0.3, y, wide), rtol=1e-9, atol=1e-11)
    near = [np.nan] * made.values
    functions["apparent"](0.3, y.tolist(), par, near)
    assert made.apparent and all(near[k] == pytest.approx(values[k], rel=1e-12, abs=1e-15) for k in made.apparent)


def test_places_of_modes_are_counted_from_the_end() -> None:
    modes: tuple[Any, ...] = (None, 1.0, np.zeros(3))
    assert places(modes) == [{}, {"": -4}, {"": -3}]


@pytest.mark.parametrize("support", SUPPORTS)
def test_balls_are_numbered_round_each_race(support: str) -> None:
    """And each state still says where it stood; rates of one order are those of the other."""
    scene = scene_on(support)
    race = replace(scene.races[0], start_angles=(3.0, 0.5 + 2 * np.pi, 1.5))
    equations = assemble(replace(scene, races=(race, scene.races[1])))
    ordered, states = in_order(equations)
    assert ordered.scene.races[0].start_angles == (0.5 + 2 * np.pi, 1.5, 3.0)
    assert sorted(states) == list(range(len(equations.states)))
    np.testing.assert_array_equal(ordered.initial, np.array(equations.initial)[states])
    y = np.array(equations.initial) + 0.1
    rates = ordered.rhs(np, 0.2, y[states], ordered.acting)
    np.testing.assert_allclose(rates, equations.rhs(np, 0.2, y, equations.acting)[states], rtol=1e-10, atol=1e-12)


def test_balls_in_order_stay_as_they_are() -> None:
    equations = assemble(scene_on("planar"))
    assert in_order(equations)[0] is equations
