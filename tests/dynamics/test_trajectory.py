"""Equations at many samples at once, held against one sample after the other."""

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.switching.modes import starting
from abu_calc.dynamics.trajectory import at_samples
from abu_calc.inputs.read_machine import read
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.simulation.subject import chosen
from abu_calc.sizing import size


@pytest.mark.parametrize(
    ("machine", "scene"),
    [("avtovaz-707-222", "grinding"), ("swing-arm-grinder", "swing-arm-cutting"), ("avtovaz-707-305", "idle")],
)
def test_columns_go_through_the_equations_as_numbers_do(machine: str, scene: str) -> None:
    equations = assemble(chosen(scene_of_design(size(read(machine).tables), scene), 0.01).scene)
    state, modes = starting(equations)
    acting = equations.in_mode(modes)
    chance = np.random.default_rng(1)
    times = chance.uniform(0, 1, 7)
    states = state[:, None] + np.array(equations.scales)[:, None] * chance.normal(size=(len(state), 7))

    def rates(t: float, y: np.ndarray) -> np.ndarray:
        return equations.rhs(np, t, y, acting)

    together = at_samples(rates, times, states)
    singly = at_samples(rates, times, states, at_once=False)
    np.testing.assert_allclose(together, singly, rtol=1e-11, atol=1e-11 * np.abs(singly).max())


def test_one_number_is_one_number_a_sample() -> None:
    times = np.array((1.0, 2.0))
    assert at_samples(lambda t: 2**t / (3 - t), times).tolist() == [1.0, 4.0]
    assert at_samples(lambda t: 5.0, times).tolist() == [5.0, 5.0]
