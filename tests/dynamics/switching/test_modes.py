"""Modes that effects settle in turn, until all agree or it is clear that they never will."""

from typing import Any, ClassVar

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, Kind, SwitchPoint
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.switching.modes import at_break, settled, starting, watched, watches
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from tests.dynamics.scenes import scene_on


@dataclass(frozen=True)
class Follower(Effect):
    """A toy whose mode is that of another effect plus `more`, up to `most`."""

    other: int
    more: int
    most: int

    name: ClassVar[str] = "follower"
    kind: ClassVar[Kind] = "dissipative"
    switches: ClassVar[bool] = True

    def first_mode(self, scene: Any) -> int:
        """None yet."""
        return 0

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """The other's mode and more."""
        wanted = min(at.modes[self.other] + self.more, self.most)
        return at.y, at.mode if wanted == at.mode else wanted


def test_effects_decide_in_turn_until_all_agree() -> None:
    """The second follows the first, whose bound ends the rise."""
    equations = assemble(scene_on("planar", Follower(1, 1, 7), Follower(0, 0, 100)))
    y = np.array(equations.initial)
    state, modes = settled(equations, 0.0, y, equations.first_modes)
    assert modes == (7, 7) and state is y


def test_effects_that_never_agree_are_told_with_the_time() -> None:
    equations = assemble(scene_on("planar", Follower(1, 1, 10**9), Follower(0, 1, 10**9)))
    with pytest.raises(NotTrustworthyError, match=r"t = 2\.5 s .* contradict"):
        settled(equations, 2.5, np.array(equations.initial), equations.first_modes)


def test_without_effects_that_switch_nothing_is_decided() -> None:
    equations = assemble(scene_on("planar", GravityEffect(0.3)))
    y = np.array(equations.initial)
    assert settled(equations, 0.0, y, (None,)) == (y, (None,)) and not watches(equations)
    assert watched(0.0, y, equations.acting) == []
    np.testing.assert_array_equal(starting(equations)[0], y)


def test_at_the_start_no_watched_number_has_fallen() -> None:
    equations = assemble(scene_on("planar", GravityEffect(0.3), DryRollingFrictionEffect(0.02, 0.1)))
    state, modes = starting(equations)
    values = watched(0.0, state, equations.in_mode(modes))
    assert watches(equations) and len(values) == 3 * 5 and min(values) >= 0


def test_a_run_up_is_over_at_its_break() -> None:
    """Ω' = Ω/t up to the end of it, then none."""
    equations = assemble(scene_on("planar", RunUpEffect(4.0)))
    assert equations.breaks == (4.0,)
    (rising,), (steady,) = (at_break(equations, t, equations.first_modes) for t in (0.0, 4.0))
    assert (rising, steady) == (pytest.approx(1.7 / 4.0), 0.0)
