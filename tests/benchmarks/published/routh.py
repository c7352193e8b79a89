"""Stability of two balls by Routh's array of the characteristic polynomial; shares no code with abu-calc.

    X² D D̄ − (N/2)(a⁴ D̄ + ā⁴ D) X + (N/2)² (1 − χ²) a⁴ ā⁴ = 0,   X = s² + h₀ s,  a = s + iΩ,  D = a² + 2ζω a + ω²

N = n m/M_t, χ = |Σ e^{2iθ}|/n at the balanced places, cos θ = −U/(2 m R). Stable systems have
nine numbers of one sign in the first column of the array (Routh 1877).
"""

import itertools
import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.complex128]


def polynomial(speed: float, mass: float, imbalance: float, damping_ratio: float, drag: float) -> NDArray[np.float64]:
    """Coefficients of the eighth power of s and downward, for M = k = R = 1."""
    total = 1 + 2 * mass
    place = math.acos(-imbalance / (2 * mass))
    share, chi = 2 * mass / total, abs(math.cos(2 * place))
    square, lost = 1 / total, 2 * damping_ratio / total

    def powers(sign: int) -> tuple[Array, Array]:
        a = np.array((1.0, sign * 1j * speed))
        whole = np.polyadd(np.polymul(a, a), np.polyadd(lost * a, np.array((square,))))
        return np.asarray(np.polymul(np.polymul(a, a), np.polymul(a, a))), np.asarray(whole)

    (four, D), (other, E) = powers(1), powers(-1)
    X = np.array((1.0, drag, 0.0))
    terms = np.polymul(np.polymul(X, X), np.polymul(D, E))
    terms = np.polysub(terms, share / 2 * np.polymul(X, np.polyadd(np.polymul(four, E), np.polymul(other, D))))
    terms = np.polyadd(terms, (share / 2) ** 2 * (1 - chi**2) * np.polymul(four, other))
    return np.asarray(terms.real)


def first_column(coefficients: NDArray[np.float64]) -> list[float]:
    """First column of Routh's array.

    >>> first_column(np.array((1.0, 2.0, 3.0, 4.0)))
    [1.0, 2.0, 1.0, 4.0]
    """
    width = (len(coefficients) + 1) // 2
    upper, lower = np.zeros(width), np.zeros(width)
    upper[: len(coefficients[::2])], lower[: len(coefficients[1::2])] = coefficients[::2], coefficients[1::2]
    column = [float(upper[0])]
    for _ in range(len(coefficients) - 1):
        column.append(float(lower[0]))
        upper, lower = lower, np.append(upper[1:] - upper[0] / lower[0] * lower[1:], 0.0)
    return column


def stable(*numbers: float) -> bool:
    """True if no sign changes in the first column."""
    return min(first_column(polynomial(*numbers))) > 0


def changes(mass: float, low: float = 1.005, high: float = 2.5) -> list[float]:
    """Speeds at which stability changes, for δ = ζ = β = 0.01."""

    def at(speed: float) -> bool:
        return stable(speed, mass, 0.01, 0.01, 0.01)

    grid = np.linspace(low, high, 400).tolist()
    return [_between(at, a, b) for a, b in itertools.pairwise(grid) if at(a) != at(b)]


def _between(at: Callable[[float], bool], low: float, high: float) -> float:
    """Speed of the change, by halving."""
    first = at(low)
    for _ in range(45):
        middle = (low + high) / 2
        low, high = (middle, high) if at(middle) == first else (low, middle)
    return low


def eigenvalues(*numbers: float) -> list[complex]:
    """Roots above the real axis."""
    return [complex(root) for root in np.roots(polynomial(*numbers)) if root.imag > 1e-9]
