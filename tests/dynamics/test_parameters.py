"""The numbers that the equations read, from those of a scene."""

from typing import ClassVar

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, Kind
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.foundation.frozen import dataclass
from tests.dynamics.scenes import SUPPORTS, scene_on


@dataclass(frozen=True)
class Branching(Effect):
    """An effect that decides by values."""

    name: ClassVar[str] = "branching"
    kind: ClassVar[Kind] = "driven"
    traceable: ClassVar[bool] = False


def test_numbers_of_balls_are_those_of_their_races() -> None:
    """R_p h₀, 1/J, m/J and (J − 1) r: 0.8·0.7 and 0.6·0.5; 1.4 and 1.5; 0.4·0.15 and 0.5·0.1."""
    p = assemble(scene_on("planar")).parameters
    assert (p.size, p.balls, len(p.effects)) == (2, 5, 0)
    np.testing.assert_allclose(p.drags, [0.56] * 3 + [0.3] * 2)
    np.testing.assert_array_equal(p.braking, -p.drags)
    np.testing.assert_allclose(p.mobilities * p.inertia_factors, 1.0)
    np.testing.assert_allclose(p.reduced_masses, np.array((0.2, 0.05, 0.1, 0.15, 0.25)) / p.inertia_factors)
    np.testing.assert_allclose(p.spins, [0.06] * 3 + [0.05] * 2)


@pytest.mark.parametrize("support", SUPPORTS)
def test_only_a_support_that_turns_its_rotor_has_a_turn_of_its_own(support: str) -> None:
    p = assemble(scene_on(support)).parameters
    carried = p.geometry.turning(np.arange(1.0, 2 * p.size + 1))
    assert (carried is None) == (not SUPPORTS[support].turns) == (p.frame.turning == ())
    assert (p.spin_inertia is None) == (carried is None)


def test_equations_are_traced_if_all_effects_are_plain_arithmetic() -> None:
    for effects, traceable in (((), True), ((GravityEffect(),), True), ((GravityEffect(), Branching()), False)):
        assert assemble(scene_on("planar", *effects)).parameters.traceable is traceable
