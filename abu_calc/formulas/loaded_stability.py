"""Stability of balls of finite mass under load: growing roots of the characteristic equation, counted.

The balls' slow motion is no longer slow if a natural frequency of the machine on its contact is near the
speed. The whirl then follows with its own dynamics, G at Ω − is instead of Ω.
"""

import cmath
import math
from collections.abc import Callable
from typing import Final

from abu_calc.errors import NotTrustworthyError
from abu_calc.formula import formula

TURN: Final = 0.7
"""Largest step of the phase [rad] between neighbours on the imaginary axis."""
FAR: Final = 30.0
"""Bound in multiples of the speed, from which the equation is as good as its highest power."""
MOST: Final = 100_000
"""Points that are looked at."""


@formula(
    "Characteristic equation of balls of finite mass under load",
    "Λ² + n(P_λ + P̄_λ)Λ + (n² − |Σe^{2iθ}|²)·P_λ·P̄_λ = 0, Λ = J λ² + h₀ λ",
    "",
    signs="m G Ω",
    where=(
        "P_λ = −(m/2)(Ω − iλ)²·G(Ω − iλ), P̄_λ its conjugate at the conjugate λ. A root right of zero lets balls "
        "leave their places: flutter by cutting friction, or a natural frequency on the contact too near the speed "
        "for their mass."
    ),
    assumed="no separation; what turns at 2Ω averaged out",
    source="derived; idle, on equal axes it is exact",
    printed="Kladiev 1996, (7), asks for Ω > ω alone",
)
def characteristic(
    whirl: Callable[[complex], complex], ball_mass: float, speed: float, count: int, doubled: float,
    inertia_factor: float, drag: float, s: complex,
) -> complex:  # fmt: skip
    """`whirl`: G by the complex speed; `doubled`: |Σe^{2iΘ}|."""

    def pull(root: complex) -> complex:
        at = speed - 1j * root
        return -ball_mass / 2 * at**2 * whirl(at)

    p, q = pull(s), pull(s.conjugate()).conjugate()
    inertia = inertia_factor * s**2 + drag * s
    return inertia**2 + count * (p + q) * inertia + (count**2 - doubled**2) * p * q


def growing_roots(value: Callable[[complex], complex], speed: float) -> int:
    """Number of roots of an equation that grow by more than a millionth of the speed.

    The equation is of fourth order, real for real s. The count follows the principle of the argument, on a grid
    of a two-hundredth of the speed up to four speeds. Two roots that turn the phase right round within one step
    of the grid may be missed. No term of the equation may be infinite there. Raises NotTrustworthyError if a
    root lies so near that edge that the roots cannot be counted.
    """
    far, small = FAR * speed, 1e-6 * speed
    grid = [0.0, *(small * (far / small) ** (k / 160) for k in range(161))]
    grid += [k / 200 * speed for k in range(1, 800)]
    edge = small
    points = [(w, value(edge + 1j * w)) for w in sorted(set(grid))]
    turned, looked = 0.0, 0
    stack = points[::-1]
    at, before = stack.pop()
    while stack:
        after, next_value = stack[-1]
        step = cmath.phase(next_value / before) if before else math.inf
        if abs(step) <= TURN:
            turned, (at, before) = turned + step, stack.pop()
            continue
        middle, looked = (at + after) / 2, looked + 1
        if looked > MOST or middle in (at, after):
            raise NotTrustworthyError("whether balls stand still under load is decided by less than rounding")
        stack.append((middle, value(edge + 1j * middle)))
    # From 0 to far the phase of a stable equation of fourth order turns by 2π; what lies beyond adds next to nothing.
    return round(2 - turned / math.pi)
