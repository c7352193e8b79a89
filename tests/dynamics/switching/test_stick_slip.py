"""Which balls stick: those that friction can hold, and no others."""

from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effect import SwitchPoint
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import available, integrate_with
from abu_calc.dynamics.scene import with_parted_balls
from abu_calc.dynamics.switching.stick_slip import AT_REST, Rolling, decided
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.subject import subject_of
from tests.dynamics.scenes import scene_on


def at(friction: float, rates: tuple[float, ...] = (0.0,) * 5) -> SwitchPoint:
    """Five balls of these speeds [rad/s], with this friction per normal force, on a support off its place."""
    equations = assemble(scene_on("planar", DryRollingFrictionEffect(0.1 * friction, 0.1)))
    y = np.array(equations.initial)
    y[:4], y[9:14] = (0.3, -0.2, 0.5, 0.1), rates
    return SwitchPoint(equations, 0.0, y, equations.first_modes, 0)


def test_enough_friction_holds_all_balls_at_rest() -> None:
    point = at(0.9)
    state, mode = decided(point, 0.9)
    assert state is point.y and not mode.direction.any()


def test_with_next_to_no_friction_every_ball_rolls_where_it_is_pulled() -> None:
    point = at(1e-9)
    _, mode = decided(point, 1e-9)
    accelerations = point.solved(mode)[2].balls
    np.testing.assert_array_equal(mode.direction, np.sign(accelerations))
    assert mode.direction.all()


@pytest.mark.parametrize("friction", [0.01, 0.1, 0.2, 0.3])
def test_what_sticks_is_held_and_what_rolls_is_pulled_harder(friction: float) -> None:
    """Coulomb's law, by the forces in the mode that was decided."""
    point = at(friction)
    _, mode = decided(point, friction)
    solved = point.solved(mode)[2]
    sticks, most = mode.direction == 0, friction * np.abs(solved.normal)
    assert np.all(np.abs(solved.left[sticks]) <= most[sticks] * (1 + 1e-6))
    assert np.all(mode.direction[~sticks] * solved.balls[~sticks] >= 0)


def test_balls_that_move_roll_their_way_and_what_is_nearly_at_rest_rests_exactly() -> None:
    slow = 0.5 * AT_REST * at(0.9).equations.scales[9]
    point = at(0.9, (1.0, -1.0, slow, -slow, 0.0))
    state, mode = decided(point, 0.9)
    assert mode.direction.tolist() == [1, -1, 0, 0, 0] and state[9:14].tolist() == [1.0, -1.0, 0, 0, 0]
    assert point.y[11] == slow  # what was given stays


def test_the_very_same_mode_comes_back_where_nothing_changes() -> None:
    point = at(0.2)
    state, mode = decided(point, 0.2)
    again = replace(point, y=state, modes=(mode,))
    assert decided(again, 0.2)[1] is mode and decided(again, 0.2)[0] is state
    assert not mode.like(Rolling(mode.direction, -mode.side, mode.begun))


@pytest.mark.slow
def test_a_chain_of_balls_of_which_one_stops_across_the_race_goes_on() -> None:
    """A face grinder whose runout shakes some balls of a chain loose and others not: chains part and join some dozen
    times, and two ways of integration agree, but for what so many switches make of errors of 1e-8.
    """
    machine = read_machine("avtovaz-707-370").changed({"wheel.axial_runout_mm": 0.002})
    scene, _ = with_parted_balls(replace(subject_of(machine, "grinding").scene, duration=0.25))
    equations = assemble(scene)
    names = available(equations)[0], "scipy-dop853"
    runs = [integrate_with(name, equations, 1e-8, np.array([0.25]), 10**6) for name in names]
    assert runs[0].events == runs[1].events < 150
    assert float(np.abs(runs[0].y - runs[1].y)[4:9].max()) < 5e-6
