"""Root of a function of one variable between two places, without the import of SciPy's optimisation."""

import math
import sys
from collections.abc import Callable
from typing import Final

ITERATIONS: Final = 100


def root(
    function: Callable[[float], float], low: float, high: float, xtol: float = 2e-12,
    rtol: float = 4 * sys.float_info.epsilon,
) -> float:  # fmt: skip
    """Place between `low` and `high` where a continuous function changes its sign, to `xtol` and `rtol` of itself.

    Brent's method: secant or inverse quadratic steps where these shrink the bracket fast enough, bisection elsewhere.
    Steps and result are those of `scipy.optimize.brentq`. Raises ValueError if both ends have the same sign.
    Source: R. P. Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4.

    >>> root(lambda x: x**2 - 2, 0, 2)
    1.4142135623731364
    """
    before, now = float(low), float(high)
    f_before, f_now = float(function(before)), float(function(now))
    if f_before == 0:
        return before
    if f_now == 0:
        return now
    if (f_before < 0) == (f_now < 0):
        raise ValueError("the function has the same sign at both ends")
    other, f_other = before, f_before  # the far end of the bracket
    last = step = now - before
    for _ in range(ITERATIONS):
        if f_now != 0 and (f_before < 0) != (f_now < 0):
            other, f_other = before, f_before
            last = step = now - before
        if abs(f_other) < abs(f_now):
            before, now, other = now, other, now
            f_before, f_now, f_other = f_now, f_other, f_now
        near, half = (xtol + rtol * abs(now)) / 2, (other - now) / 2
        if f_now == 0 or abs(half) < near:
            return now
        bisect = True
        if abs(last) > near and abs(f_now) < abs(f_before):
            if before == other:
                top, bottom = now - before, f_now - f_before
            else:
                a, b = (f_before - f_now) / (before - now), (f_other - f_now) / (other - now)
                top, bottom = f_other * b - f_before * a, b * a * (f_other - f_before)
            tried = -f_now * top / bottom if bottom else math.inf
            bisect = 2 * abs(tried) >= min(abs(last), 3 * abs(half) - near)
        last, step = (half, half) if bisect else (step, tried)
        before, f_before = now, f_now
        now += step if abs(step) > near else math.copysign(near, half)
        f_now = float(function(now))
    raise ValueError(f"no root to this accuracy in {ITERATIONS} steps")
