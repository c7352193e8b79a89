"""Loads that effects add or own."""

import numpy as np
import pytest

from abu_calc.dynamics.motion import Loads
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
