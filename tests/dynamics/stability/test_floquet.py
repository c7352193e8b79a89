"""Units that balance a map, held against LAPACK's."""

import numpy as np
from scipy.linalg import matrix_balance

from abu_calc.dynamics.stability.floquet import balancing_units


def test_units_are_those_of_lapack() -> None:
    chance = np.random.default_rng(3)
    for _ in range(400):
        size, spread = chance.integers(1, 17), chance.uniform(0, 8)
        matrix = chance.normal(size=(size, size)) * 10.0 ** chance.uniform(-spread, spread, (size, size))
        matrix *= chance.random((size, size)) < chance.choice((0.6, 1.0))
        _, (units, _) = matrix_balance(matrix, permute=False, separate=True)
        np.testing.assert_array_equal(balancing_units(matrix), units)
