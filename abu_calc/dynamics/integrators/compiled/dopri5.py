"""A step of Dormand and Prince's method of order 5 with its error, and the motion within it.

Source: Dormand & Prince 1980, Journal of Computational and Applied Mathematics 6(1), 19; its dense output of order 4 as
in Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, II.6 (contd5).
"""

from math import sqrt

from abu_calc.dynamics.integrators.compiled.arrays import Reals, Step, rates, watched

METHOD_ORDER = 5
EXPONENT = -1 / 5
"""Exponent of the error in the factor on the next step."""
STAGES, EXTRA = 6, 0
"""Evaluations of a step, and of its dense output."""
KEPT, LAST, BETWEEN = 7, 6, 4
"""Rows of rates, which of them is that at the end, and rows of the dense output."""


def stages(step: Step, w: Reals) -> None:
    """Compute one step from y, whose rates are the first of k, to the end: seven rates.

    The last rates come with the watched numbers there.
    """
    t, h, n, y, par, end, k = step.t, step.h, step.n, step.y, step.par, step.end, step.k
    a, b, c, d, e, f = k, k[n:], k[2 * n :], k[3 * n :], k[4 * n :], k[5 * n :]
    for i in range(n):
        end[i] = y[i] + h * (1 / 5 * a[i])
    rates(t + h / 5, end, par, b)
    for i in range(n):
        end[i] = y[i] + h * (3 / 40 * a[i] + 9 / 40 * b[i])
    rates(t + 3 * h / 10, end, par, c)
    for i in range(n):
        end[i] = y[i] + h * (44 / 45 * a[i] - 56 / 15 * b[i] + 32 / 9 * c[i])
    rates(t + 4 * h / 5, end, par, d)
    for i in range(n):
        more = 19372 / 6561 * a[i] - 25360 / 2187 * b[i] + 64448 / 6561 * c[i] - 212 / 729 * d[i]
        end[i] = y[i] + h * more
    rates(t + 8 * h / 9, end, par, e)
    for i in range(n):
        more = 9017 / 3168 * a[i] - 355 / 33 * b[i] + 46732 / 5247 * c[i] + 49 / 176 * d[i] - 5103 / 18656 * e[i]
        end[i] = y[i] + h * more
    rates(t + h, end, par, f)
    for i in range(n):
        more = 35 / 384 * a[i] + 500 / 1113 * c[i] + 125 / 192 * d[i] - 2187 / 6784 * e[i] + 11 / 84 * f[i]
        end[i] = y[i] + h * more
    watched(t + h, end, par, k[LAST * n :], w)


def error(step: Step, absolute: Reals, relative: Reals) -> float:
    """The estimated error of a step in units of what is allowed, root mean square."""
    h, n, y, end, k = step.h, step.n, step.y, step.end, step.k
    c, d, e, f, g = k[2 * n :], k[3 * n :], k[4 * n :], k[5 * n :], k[6 * n :]
    total = 0.0
    for i in range(n):
        off = 71 / 57600 * k[i] - 71 / 16695 * c[i] + 71 / 1920 * d[i]
        off += 22 / 525 * f[i] - 17253 / 339200 * e[i] - 1 / 40 * g[i]
        off = h * off / (absolute[i] + relative[i] * max(abs(y[i]), abs(end[i])))
        total += off * off
    return sqrt(total / n)


def prepared(step: Step) -> None:
    """Prepare the dense output of a step."""
    h, n, y, end, k, between = step.h, step.n, step.y, step.end, step.k, step.between
    c, d, e, f, g = k[2 * n :], k[3 * n :], k[4 * n :], k[5 * n :], k[6 * n :]
    second, third, fourth = between[n:], between[2 * n :], between[3 * n :]
    for i in range(n):
        way, first, last = end[i] - y[i], k[i], g[i]
        bend = h * first - way
        between[i] = way
        second[i] = bend
        third[i] = way - h * last - bend
        more = -12715105075 / 11282082432 * first + 87487479700 / 32700410799 * c[i]
        more += 701980252875 / 199316789632 * e[i] - 10690763975 / 1880347072 * d[i]
        more += 69997945 / 29380423 * last - 1453857185 / 822651844 * f[i]
        fourth[i] = h * more


def dense(x: float, n: int, y: Reals, between: Reals, state: Reals) -> None:
    """The state at a share x of a step."""
    z = 1.0 - x
    second, third, fourth = between[n:], between[2 * n :], between[3 * n :]
    for i in range(n):
        state[i] = y[i] + x * (between[i] + z * (second[i] + x * (third[i] + z * fourth[i])))


def within(i: int, x: float, n: int, y: Reals, between: Reals) -> float:
    """One of its numbers."""
    more = between[n + i] + x * (between[2 * n + i] + (1.0 - x) * between[3 * n + i])
    return y[i] + x * (between[i] + (1.0 - x) * more)
