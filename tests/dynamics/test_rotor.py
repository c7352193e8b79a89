"""Ways in which a rotor turns: their states, and what a changing speed does."""

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import motion_of
from abu_calc.dynamics.rotor import DRIVEN, GUIDED, STEADY, Rotation, most_demanding
from tests.dynamics.scenes import ROTORS, scene_on


def test_a_torque_asks_for_more_than_a_given_acceleration_and_that_for_more_than_none() -> None:
    assert most_demanding([]) is STEADY
    assert most_demanding([STEADY, GUIDED, STEADY]) is GUIDED
    assert most_demanding([GUIDED, DRIVEN, STEADY]) is most_demanding([DRIVEN, GUIDED]) is DRIVEN


@pytest.mark.parametrize("rotor", [STEADY, GUIDED, DRIVEN], ids=lambda rotor: type(rotor).__name__)
def test_states_of_a_rotor_start_with_its_speed_and_their_rates_are_speed_and_acceleration(rotor: Rotation) -> None:
    start = np.array(rotor.start(3.0))
    assert len(start) == len(rotor.states)
    assert rotor.turning(0.0, start, 3.0) == (0.0, 3.0)
    assert np.concatenate([*rotor.rates(start, 0.7), []]).tolist() == ([3.0, 0.7] if rotor.states else [])


def test_a_steady_rotor_turns_by_speed_times_time() -> None:
    assert STEADY.turning(2.0, np.zeros(0), 3.0) == (6.0, 3.0)


@pytest.mark.parametrize("way", ["guided", "driven"])
def test_a_race_that_speeds_up_carries_its_balls_along(way: str) -> None:
    """A ball's place is accelerated by R_p Ω' along the race: as given, or as one more row of the frame."""
    equations = assemble(scene_on("planar", *ROTORS[way]))
    p, y = equations.parameters, np.array(equations.initial)
    m = motion_of(np, 0.0, y, p)
    m.acceleration = 0.7
    levers = p.geometry.levers(m, p)
    if way == "guided":
        np.testing.assert_allclose(levers.carried_along, 0.7 * p.radii)
        assert levers.along.shape == (2, 5)
    else:
        np.testing.assert_array_equal(levers.along[-1], p.radii)
        assert levers.carried_along is None and not levers.outward[-1].any()


def test_a_torque_turns_a_driven_rotor_alone() -> None:
    assert DRIVEN.on_frame([1.0, 2.0], 3.0).tolist() == [1.0, 2.0, 3.0]
    assert GUIDED.on_frame([1.0, 2.0], 3.0).tolist() == STEADY.on_frame([1.0, 2.0], 3.0).tolist() == [1.0, 2.0]
