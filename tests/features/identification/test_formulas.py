"""Friction that gravity shakes: theory 1.16 by hand."""

import math

import pytest

from abu_calc.features.identification.formulas import equivalent_drag
from abu_calc.formulas.shaken_friction import friction_number


def test_by_hand() -> None:
    speed = 5800 * 2 * math.pi / 60
    assert friction_number(1e-6, 24e-3, 8e-3, speed) == pytest.approx(1e-6 * 24e-3 * speed**2 / (8e-3 * 9.80665))
    # h_eq = (2/π)·J·Λ·Ω: the friction number times the speed.
    number = friction_number(1e-6, 24e-3, 8e-3, speed)
    assert equivalent_drag(1e-6, 24e-3, 8e-3, speed, 1.4) == pytest.approx(2 / math.pi * 1.4 * number * speed)
