"""Small linear systems by plain arithmetic, so that numbers, complex numbers and symbols are all solved alike."""

from collections.abc import Sequence
from typing import Any


def solve(matrix: Sequence[Sequence[Any]], right: Sequence[Any]) -> list[Any]:
    """x from matrix · x = right; no pivoting, for matrices that are positive definite or nearly so.

    >>> solve([[2.0, 1.0], [1.0, 3.0]], [3.0, 4.0])
    [1.0, 1.0]
    """
    size = len(right)
    if size == 1:
        return [right[0] / matrix[0][0]]
    if size == 2:
        (a, b), (c, d) = matrix
        e, f = right
        determinant = a * d - b * c
        return [(d * e - b * f) / determinant, (a * f - c * e) / determinant]
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(size):
        for i in range(k + 1, size):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [0.0 if j <= k else rows[i][j] - factor * rows[k][j] for j in range(size + 1)]
    x: list[Any] = [0.0] * size
    for k in reversed(range(size)):
        x[k] = (rows[k][size] - sum((rows[k][j] * x[j] for j in range(k + 1, size)), 0.0)) / rows[k][k]
    return x
