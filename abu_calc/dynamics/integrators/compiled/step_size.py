"""The factor on the next step, by the error of the last and the order of the method.

Source: Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, II.4.
"""

from abu_calc.dynamics.integrators.compiled.rk45 import EXPONENT

LEAST_FACTOR, MOST_FACTOR, SAFETY = 0.2, 10.0, 0.9


def shorter(off: float) -> float:
    """Factor on a step whose error is too large, or no number."""
    if off < 1e10:
        factor: float = SAFETY * off**EXPONENT
        return max(LEAST_FACTOR, factor)
    return LEAST_FACTOR


def longer(off: float) -> float:
    """Factor on the next step."""
    if off > 1e-10:
        factor: float = SAFETY * off**EXPONENT
        return min(MOST_FACTOR, factor)
    return MOST_FACTOR
