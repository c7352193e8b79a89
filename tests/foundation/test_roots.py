"""Roots of functions of one variable, held against SciPy's."""

import math
import random
from collections.abc import Callable

import pytest
from scipy.optimize import brentq

from abu_calc.foundation.roots import root

FUNCTIONS: tuple[Callable[[float, float], float], ...] = (
    lambda x, a: math.sin(3 * x) + a,
    lambda x, a: x**3 - a,
    lambda x, a: math.atan(50 * (x - a)),
    lambda x, a: math.copysign(1, x - a),
    lambda x, a: 1e-150 * (x - a) ** 9,
)


def test_a_root_is_that_of_scipy_to_the_last_digit() -> None:
    chance, compared = random.Random(1), 0
    for _ in range(2000):
        kind, a, low, high = chance.choice(FUNCTIONS), *(chance.uniform(-2, 2) for _ in range(3))
        xtol, rtol = chance.choice((2e-12, 1e-6, 1e-300)), chance.choice((1e-15, 1e-9))

        def function(x: float, kind: Callable[[float, float], float] = kind, a: float = a) -> float:
            return kind(x, a)

        if function(low) * function(high) < 0:
            try:
                true = brentq(function, low, high, xtol=xtol, rtol=rtol)
            except RuntimeError:  # too many steps
                continue
            assert root(function, low, high, xtol, rtol) == true
            compared += 1
    assert compared > 500


def test_ends_are_roots_too() -> None:
    assert root(lambda x: x, 0, 1) == 0
    assert root(lambda x: x - 1, 0, 1) == 1


@pytest.mark.parametrize("function", [lambda x: 1 + x**2, lambda x: -1 - x**2])
def test_a_function_of_one_sign_has_none(function: Callable[[float], float]) -> None:
    with pytest.raises(ValueError, match="same sign"):
        root(function, -1, 2)
