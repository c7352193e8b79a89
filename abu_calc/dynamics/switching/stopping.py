"""Cutting on a rotor that a motor drives: the wheel slides over the work one way or the other, or stands on it.

    |T| ≤ f N on a wheel that stands,    T = −f N v/|v| on one that slides,    v = x_w' + Ω (R_w − ε sin(turn + φ₀))

v is the speed of the wheel's surface over the work. Standing is exact: v is 0, and an event ends it. Source: Coulomb's
friction, as for balls in `sticking`.
"""

from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from abu_calc.dynamics.effect import SwitchPoint
from abu_calc.dynamics.motion import Array, Motion
from abu_calc.dynamics.parameters import Parameters
from abu_calc.dynamics.switching.sticking import AT_REST, HOLD
from abu_calc.errors import NotTrustworthyError


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
    """How the wheel's surface moves over the work: `speed` v [m/s], v' = `row` · A − `turned`; `lever` dv/dΩ [m]."""

    speed: Any
    row: Array
    turned: Any
    lever: Any


class Contact(Protocol):
    """What is asked of a contact that can stop its rotor."""

    @property
    def stands(self) -> bool:
        """Whether the wheel can stand on the work; a constraint normal to it leaves no room for another."""

    def slip(self, m: Motion, p: Parameters) -> Slip:
        """How the wheel's surface moves over the work."""

    def most(self, m: Motion, mode: Any, p: Parameters) -> Any:
        """f N [N]."""


def goes_on(mode: Cutting, speed: Any, spare: Any) -> Any:
    """What stays at or above zero as long as the wheel slides on, or stands: relative numbers; 1 while apart."""
    slides, stands = mode.touching * mode.slides * mode.slides, mode.stands
    return slides * mode.slides * speed + stands * (spare + HOLD) + (1 - slides - stands)


def decided(at: SwitchPoint, mode: Cutting, contact: Contact) -> tuple[Array, Cutting]:
    """State and mode with which the rotor can go on; a wheel that comes to rest gets v = 0 exactly.

    Raises NotTrustworthyError where it comes to rest and the contact cannot hold it.
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


def _from_rest(at: SwitchPoint, mode: Cutting, contact: Contact) -> Cutting:
    """Whether a wheel at rest stands, or which way it starts: the way in which it then goes."""
    if contact.stands:
        still = replace(mode, slides=0.0)
        m, _, solved = at.solved(still)
        if abs(solved.reaction) <= (1 + HOLD / 4) * contact.most(m, still, at.parameters):
            return still
    for slides in (1.0, -1.0):
        starts = replace(mode, slides=slides)
        m, _, solved = at.solved(starts)
        slip = contact.slip(m, at.parameters)
        if slides * at.parameters.speed * (slip.row.dot(solved.frame) - slip.turned) > 0:
            return starts
    raise NotTrustworthyError(
        f"the rotor comes to rest on the work at t = {at.t:.6g} s, where a rigid contact does not say what holds it\n"
        "  give the contact a stiffness, a stronger motor, or a shorter run"
    )
