"""The interface of effects: what one does that says nothing, and a state at which modes are decided."""

from typing import ClassVar

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, Kind, SwitchPoint
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.rotor import STEADY
from abu_calc.foundation.frozen import dataclass
from tests.dynamics.scenes import SUPPORTS, scene_on


@dataclass(frozen=True)
class Nothing(Effect):
    """An effect that says nothing of itself."""

    name: ClassVar[str] = "nothing"
    kind: ClassVar[Kind] = "conservative"


@pytest.mark.parametrize("support", SUPPORTS)
def test_an_effect_that_says_nothing_changes_nothing(support: str) -> None:
    plain, equations = assemble(scene_on(support)), assemble(scene_on(support, Nothing()))
    assert (equations.states, equations.breaks, equations.scene.rotor) == (plain.states, (), STEADY)
    y = np.array(plain.initial) + 0.1
    np.testing.assert_array_equal(equations.rhs(np, 0.7, y, equations.acting), plain.rhs(np, 0.7, y, plain.acting))
    assert Nothing().weight(equations.scene).value is None


def switch_point(index: int) -> SwitchPoint:
    """Balls that stick, and move across their race with a spin, at a state of ascending numbers."""
    effects = TransverseMotionEffect(0.7, 0.1, free_spin=True), DryRollingFrictionEffect(0.02, 0.1)
    equations = assemble(scene_on("planar", *effects))
    y = np.arange(len(equations.states)) / 10
    return SwitchPoint(equations, 0.0, y, equations.first_modes, index)


def test_an_effect_sees_its_own_states_alone() -> None:
    first = switch_point(0)
    names = [name.rstrip("0123456789") for name in first.equations.scene.ball_states for _ in range(5)]
    start = 2 * 2 + 2 * 5
    np.testing.assert_array_equal(first.own, first.y[start : start + len(names)])
    assert len(first.own) == len(first.y) - start and switch_point(1).own is None


def test_accelerations_in_another_mode_leave_the_modes_as_they_are() -> None:
    from dataclasses import replace

    at = switch_point(1)
    free = replace(at.mode, direction=np.ones(5))
    stuck, rolling = at.solved(at.mode)[2].balls, at.solved(free)[2].balls
    assert not stuck.any() and rolling.all()
    other = replace(at, modes=(at.modes[0], free))
    np.testing.assert_array_equal(other.solved(other.mode)[2].balls, rolling)
    assert not at.mode.direction.any()
