"""Matrices put together of blocks, and the directions that rows span."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def span_of(rows: Array, least: float) -> Array:
    """Orthonormal columns that span the rows of a matrix; less than a share `least` of it is none."""
    if 0 in rows.shape:
        return np.zeros((rows.shape[1], 0))
    _, sizes, directions = np.linalg.svd(rows)
    return np.asarray(directions[: int((sizes > least * np.abs(rows).sum()).sum())].T, dtype=float)


def diagonal(*blocks: Array) -> Array:
    """A matrix of blocks along its diagonal."""
    total = np.zeros((sum(len(block) for block in blocks), sum(block.shape[1] for block in blocks)))
    row = column = 0
    for block in blocks:
        total[row : row + len(block), column : column + block.shape[1]] = block
        row, column = row + len(block), column + block.shape[1]
    return total
