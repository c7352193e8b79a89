"""Wheel and workpiece: whether they touch, and whether a driven rotor slides over the workpiece or stands on it.

    |T| ≤ f N on a wheel that stands,    T = −f N v/|v| on one that slides,    v = x_w' + Ω (R_w − ε sin(turn + φ₀))

v is the speed of the wheel's surface over the workpiece. Standing is exact: v is 0, and an event ends it. Source:
Coulomb's friction, as for balls in `stick_slip`.
"""

from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from abu_calc.dynamics.effect import SwitchPoint
from abu_calc.dynamics.motion import AnyArray, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.switching.stick_slip import AT_REST, HOLD
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

RUNAWAY = 1e3
"""Balls this many times as fast as the rotor run away: they go on to infinite speed, in a moment."""


@dataclass(frozen=True)
class Cutting:
    """Mode of a contact that can stop its rotor: `touching` 1 or 0; `slides` 1 with the rotation, −1 back, 0 not."""

    touching: float = 1.0
    slides: float = 1.0

    @property
    def stands(self) -> Any:
        """1 while the wheel stands on the work, else 0."""
        return self.touching * (1 - self.slides * self.slides)


@dataclass(frozen=True)
class Slip:
    """Motion of the wheel's surface over the workpiece.

    `speed` v [m/s], v' = `row` · A − `turned`; `lever` dv/dΩ [m].
    """

    speed: Any
    row: AnyArray
    turned: Any
    lever: Any


class StoppingContact(Protocol):
    """Interface of a contact that can stop its rotor."""

    def slip(self, m: Motion, p: Parameters) -> Slip:
        """Motion of the wheel's surface over the workpiece."""

    def held(self, m: Motion, mode: Cutting, solved: Solved, p: Parameters) -> tuple[Any, Any]:
        """T with which the work holds a wheel that stands, and the most it can, f N [N]."""


def goes_on(mode: Cutting, speed: Any, held: Any, most: Any) -> list[Any]:
    """Watched values that stay at or above zero as long as the wheel slides on, or stands.

    They are relative numbers; 1 while apart.
    """
    slides, stands = mode.touching * mode.slides * mode.slides, mode.stands
    apart, most = 1 - slides - stands, (1 + HOLD) * most
    return [
        slides * mode.slides * speed + stands * (most - held) + apart,
        stands * (most + held) + slides + apart,
    ]


def decided(at: SwitchPoint, mode: Cutting, contact: StoppingContact) -> tuple[AnyArray, Cutting]:
    """State and mode with which the rotor can go on; a wheel that comes to rest gets v = 0 exactly.

    Raises NotTrustworthyError where neither standing nor sliding is consistent.
    """
    if not mode.touching:
        return at.y, replace(mode, slides=1.0)
    p = at.parameters
    slip = contact.slip(at.solved(mode)[0], p)
    if abs(slip.speed) > AT_REST * at.equations.scales[-1] * slip.lever:
        return at.y, replace(mode, slides=float(np.sign(slip.speed * p.speed)))
    if slip.speed:
        y = at.y.copy()
        y[-1] -= slip.speed / slip.lever
        at = replace(at, y=y)
    return at.y, _from_rest(at, mode, contact)


def _from_rest(at: SwitchPoint, mode: Cutting, contact: StoppingContact) -> Cutting:
    """Mode of a wheel at rest: it stands, or slides in the direction in which it starts."""
    still = replace(mode, slides=0.0)
    m, _, solved = at.solved(still)
    held, most = contact.held(m, still, solved, at.parameters)
    if abs(held) <= (1 + HOLD / 4) * most:
        return still
    for slides in (1.0, -1.0):
        starts = replace(mode, slides=slides)
        m, _, solved = at.solved(starts)
        slip = contact.slip(m, at.parameters)
        if slides * at.parameters.speed * (slip.row.dot(solved.frame) - slip.turned) > 0:
            return starts
    raise NotTrustworthyError(
        f"at t = {at.t:.6g} s a wheel at rest can neither stand on the work nor slide: the rigid contact pulls\n"
        "  give the contact a stiffness, or press harder"
    )


def inside(depth: float, deeper: float, ever: float, near: float) -> bool:
    """True if depth + deeper t + ½ ever t² counts as inside.

    The sign of the depth decides; if the depth is nothing, what follows decides. An excursion that stays
    nothing is none, so that a graze is not entered.
    """
    if abs(depth) > near:
        return depth > 0
    if deeper * ever < 0:
        return (depth - deeper**2 / (2 * ever) > near) if deeper > 0 else (depth - deeper**2 / (2 * ever) > -near)
    return (deeper or ever) >= 0


def check_speeds(at: SwitchPoint) -> None:
    """Refuse balls that run away."""
    p, first = at.parameters, 2 * at.parameters.size + at.parameters.balls
    fast = np.abs(at.y[first : first + p.balls]) / p.speed
    if np.linalg.norm(fast) > 0.999 * RUNAWAY:
        raise NotTrustworthyError(
            f"ball {int(fast.argmax()) + 1} runs away at t = {at.t:.6g} s: a rigid contact cannot part, and its "
            "cutting force T = f N feeds the balls\n"
            "  give the race more drag or the contact a stiffness, or lower the cutting coefficient"
        )
