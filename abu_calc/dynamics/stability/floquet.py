"""Floquet theory: growth of a linear system over one period of its matrix, and a swing arm's instability edge.

Averaging gives that edge for a small imbalance only. The arm's free motion over one revolution:

    (1 + 2κ cos t) z'' + 2κ (kσ − sin t) z' + k² z = 0

Source: Kovalenko 2010, (17), κσ = h/ω₀, k = ω₀/ω.
"""

import math
from collections.abc import Callable
from functools import reduce
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.roots import root

Array = NDArray[np.float64]


Matrices = Callable[[Array], Array]

FIRST_STEPS, MOST_STEPS = 32, 16384
SERIES: Final = tuple(tuple(1 / math.factorial(4 * k + order) for order in range(4)) for k in range(4))
"""Coefficients of e^A to the degree 15, in powers of A⁴: 2^−16/16! is less than rounding."""

ALIKE: Final = 0.95
"""Share of the norms of a row and a column; another unit that leaves more of them is not worth it."""

LARGEST_UNIT: Final = 2.0**900
"""Beyond, numbers may leave the range of a computer's."""

SETTLED: Final = 1e-8
"""A growth or a map that changes by less, in logarithms and in shares of its size, when the steps are halved is found;
what is left of its error is a fifteenth of that."""


def multipliers(matrices: Matrices, end: float, after: Array) -> NDArray[np.complex128]:
    """Eigenvalues of `after` · Φ, Φ the map z(0) → z(end) of z' = A(t) z; `matrices` gives A at many times, stacked.

    Φ by `magnus`, its steps halved until the largest multiplier settles, or the map itself where two multipliers all
    but agree and rounding parts them. Raises NotTrustworthyError when it does not, or is no finite number.

    >>> float(multipliers(lambda t: -t[:, None, None], 2.0, np.eye(1))[0].real.round(9))
    0.135335283
    """
    steps, matrix = FIRST_STEPS, magnus(matrices, end, FIRST_STEPS)
    while steps < MOST_STEPS:
        steps, before, matrix = 2 * steps, matrix, magnus(matrices, end, 2 * steps)
        if not (np.isfinite(matrix).all() and np.isfinite(before).all()):
            continue
        if abs(_growth(after @ before) - _growth(after @ matrix)) <= SETTLED or _distance(before, matrix) <= SETTLED:
            return np.asarray(np.linalg.eigvals(after @ matrix), dtype=complex)
    reason = "its map over a period does not settle" if np.isfinite(matrix).all() else "it grows beyond any number"
    raise NotTrustworthyError(
        f"the linear motion cannot be judged: {reason}\n"
        "  ask for a speed nearer to the natural frequencies, or for less drag"
    )


def magnus(matrices: Matrices, end: float, steps: int) -> Array:
    """The map over equal steps h, each exp{½h(A₁ + A₂) − (√3/12)h²[A₁, A₂]}, A₁ and A₂ at its two Gauss points.

    Exact where A does not change: motions that are fast against its changes, stiff or not, cost nothing. Error O(h⁴).
    Source: Blanes, Casas, Oteo & Ros 2009, Physics Reports 470, 5.4.
    """
    blocks = np.split(end / steps * (np.arange(steps) + 0.5), max(1, steps // FIRST_STEPS))
    with np.errstate(all="ignore"):
        return reduce(lambda before, after: after @ before, (_over(matrices, block, end / steps) for block in blocks))


def _over(matrices: Matrices, middles: Array, step: float) -> Array:
    """The map over steps with these middles, a power of two of them: few enough that a processor's cache holds them."""
    apart = step * np.sqrt(3) / 6
    first, two = np.split(matrices(np.concatenate([middles - apart, middles + apart])), 2)
    maps = _exponentials(step / 2 * (first + two) - step * apart / 2 * (first @ two - two @ first))
    while len(maps) > 1:
        maps = maps[1::2] @ maps[::2]
    return np.asarray(maps[0], dtype=float)


def _exponentials(stack: Array) -> Array:
    """e^A of each A, by scaling, Taylor's series to the degree 15 in six products, and squaring.

    All at once, by products alone: a loop over small matrices, each factorised, waits for threads most of the time.
    Sources: Moler & Van Loan 2003, SIAM Review 45(1), methods 1 and 3; Paterson & Stockmeyer 1973, SIAM Journal on
    Computing 2(1), for the products.
    """
    norm = float(np.abs(stack).sum(axis=2).max(initial=0.0))
    squarings = max(0, math.frexp(norm)[1] + 1) if math.isfinite(norm) else 0
    first, unit = stack / 2.0**squarings, np.eye(stack.shape[-1])
    second = first @ first
    third, fourth = second @ first, second @ second
    parts = [a * unit + b * first + c * second + d * third for a, b, c, d in SERIES]
    total = parts.pop()
    while parts:
        total = total @ fourth + parts.pop()
    for _ in range(squarings):
        total = total @ total
    return np.asarray(total, dtype=float)


def _growth(matrix: Array) -> float:
    """Logarithm of a map's largest multiplier; of what has died out to nothing, that of the smallest number."""
    return float(np.log(max(np.abs(np.linalg.eigvals(matrix)).max(initial=0.0), np.finfo(float).tiny)))


def _distance(matrix: Array, other: Array) -> float:
    """Largest difference of two maps relative to their size, in units that balance rows and columns."""
    units = balancing_units(other)
    size = float(np.abs(other * units / units[:, None]).max(initial=0.0))
    return float(np.abs((matrix - other) * units / units[:, None]).max()) / size if size else 0.0


def balancing_units(matrix: Array) -> Array:
    """Powers of two u with which rows and columns of a_ij u_j/u_i have norms that are alike.

    Those of `scipy.linalg.matrix_balance` without permutation, which takes longer to import than most answers.
    Source: James, Langou & Lowery 2014, arXiv:1401.5766, algorithm 3.

    >>> balancing_units(np.array(((1.0, 1024.0), (1.0, 1.0)))).tolist()
    [32.0, 1.0]
    """
    balanced, units = np.array(matrix, dtype=float), np.ones(len(matrix))
    changed = True
    while changed:
        changed = False
        for k in range(len(units)):
            column, row = float(np.linalg.norm(balanced[:, k])), float(np.linalg.norm(balanced[k]))
            if column == 0 or row == 0:
                continue
            factor, together = 1.0, column + row
            while column < row / 2 and factor < LARGEST_UNIT:
                factor, column, row = 2 * factor, 2 * column, row / 2
            while column / 2 >= row and factor > 1 / LARGEST_UNIT:
                factor, column, row = factor / 2, column / 2, 2 * row
            if column + row < ALIKE * together and 1 / LARGEST_UNIT < units[k] * factor < LARGEST_UNIT:
                units[k], changed = units[k] * factor, True
                balanced[k] /= factor
                balanced[:, k] *= factor
    return units


MOST: Final = 1.0
"""Twice what any σ_c of the tongue is at leading order."""


def arm_growth(kappa: float, ratio: float, sigma: float) -> float:
    """Growth per radian of rotation, ln|μ|/2π, of the arm's free motion; κ < 1/2.

    Raises NotTrustworthyError when the multipliers do not settle.

    >>> round(arm_growth(0.02, 0.5, 0.0), 6)  # κ/4 to leading order
    0.005001
    """

    def matrices(t: Array) -> Array:
        """Matrices of z and p = (1 + 2κ cos t) z', scaled to k z."""
        matrix = np.zeros((len(t), 2, 2))
        weight = 1 + 2 * kappa * np.cos(t)
        matrix[:, 0, 1], matrix[:, 1, 0], matrix[:, 1, 1] = ratio / weight, -ratio, -2 * kappa * sigma * ratio / weight
        return matrix

    largest = np.abs(multipliers(matrices, 2 * math.pi, np.eye(2))).max()
    return math.log(largest) / (2 * math.pi)


def floquet_edge(kappa: float, ratio: float) -> float:
    """σ_c at k: the damping above which the arm's free motion does not grow, 0 where it does not without any.

    >>> round(floquet_edge(0.1, 0.5), 5)
    0.49461
    """
    small = 1e-3  # undamped, outside the tongue, |μ| = 1: rounding would decide there
    if arm_growth(kappa, ratio, small) <= 0:
        return 0.0
    return root(lambda sigma: arm_growth(kappa, ratio, sigma), small, MOST, xtol=1e-6)
