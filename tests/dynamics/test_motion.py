"""Loads that effects add or own."""

import numpy as np
import pytest

from abu_calc.dynamics.motion import Across, Levers, Loads
from abu_calc.foundation.errors import InputError


def test_forces_add_and_owned_slots_have_one_owner():
    loads = Loads()
    loads.add(pull=1.0, frame=2.0)
    loads.add(pull=0.5)
    assert (loads.pull, loads.press, loads.frame) == (1.5, None, 2.0)
    for slot in ("grip", "free", "hold", "mates", "leads", "across", "bound"):
        loads.own(**{slot: np.zeros(2)})
        with pytest.raises(InputError, match=slot):
            loads.own(**{slot: np.zeros(2)})


def test_what_carries_races_adds_up() -> None:
    levers = Levers(np.zeros((2, 1)), np.zeros((2, 1)), None)
    assert levers.carried_along is None
    for _ in range(2):
        levers.carry(np.array([1.5]), np.array([-0.5]))
    assert (levers.carried_along.tolist(), levers.carried_outward.tolist()) == ([3.0], [-1.0])


def test_a_second_direction_gives_way_by_its_inertia_unless_it_is_held() -> None:
    across = Across(np.zeros((2, 2)), np.array([2.0, 4.0]), np.zeros(2), np.zeros(2))
    assert across.give.tolist() == [0.5, 0.25]
    across.free = np.array([1.0, 0.0])
    assert across.give.tolist() == [0.5, 0.0]
