"""Lift-off: the workpiece presses the disk of a swing arm away and never pulls it.

The stiffness of the workpiece stands in the support, see `swing_arm.cutting_arm`, whose linear theory is that of an arm
that stays on its workpiece. If the arm has left it, the effect takes that moment back:

    touching    φ beyond φ₀     nothing to add
    apart       φ before φ₀     + c l² (φ − φ₀),    c = c_n g(Z)

With N = c_n l (φ − φ₀) sin Z the disk leaves the work where N would be negative, and comes back at φ₀. Nothing damps
the contact but the joint. Source: derived; Kovalenko 2010, (3), takes a contact that never parts.

    parameter    unit  range  default   source
    stiffness    N/m   any    required  c_n g(Z), Kovalenko 2010, (3)
    length       m     > 0    required  geometry of the arm
    touch_angle  rad   any    required  geometry of the arm
    depth        rad   not 0  required  standing arm under its load
"""

import math
from typing import Any, ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind, Laws, Rule, SwitchPoint
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.switching.contact_stop import inside
from abu_calc.dynamics.trajectory import Samples
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

TOUCHING, APART = 1.0, 0.0

NEAR = 1e-9
"""Distance, relative to the depth of the contact, within which the motion decides about contact.

So near, the motion tells whether disk and workpiece touch.
"""

LATE = 0.95
"""Share of the duration after which events count as lasting."""

LEAST_DEPTH: Final = 1e-9
"""Least angle [rad] by which an arm is pressed in: one that hangs on its workpiece just touches it."""


@dataclass(frozen=True)
class LiftOffEffect(Effect):
    """`stiffness` c [N/m] of the work reduced to the end of the arm, `length` l [m], `touch_angle` φ₀ [rad], and
    `depth` [rad]: how far beyond φ₀ the arm is pressed when it stands; negative where the work is on the other side.
    """

    stiffness: float
    length: float
    touch_angle: float
    depth: float

    name: ClassVar[str] = "lift_off"
    kind: ClassVar[Kind] = "conservative"
    about: ClassVar[str] = "Lift-off: the workpiece can push the disk of a swing arm away, but not pull it"
    table: ClassVar[str] = "scene.swing_arm"
    switches: ClassVar[bool] = True
    whole_run: ClassVar[bool] = True

    def __post_init__(self) -> None:
        Range("arm length", 0, math.inf, "m", open_low=True).check(self.length)
        if not (math.isfinite(self.depth) and self.depth):
            raise InputError("depth of the contact", found=str(self.depth), allowed="a number that is not 0")

    def check(self, scene: Circumstances) -> None:
        """Raise InputError on a support that is no swing arm."""
        if scene.support.standing_arm(scene.balls) is None:
            raise InputError("only a swing arm lifts off its work", remedy="describe the contact as grinding_contact")

    def first_mode(self, scene: Circumstances) -> float:
        """Touching."""
        return TOUCHING

    def _beyond(self, m: Motion) -> Any:
        """φ − φ₀."""
        return m.support[0] - self.touch_angle

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Take back the contact moment of the support while nothing touches."""
        moment = (1 - mode) * (self.stiffness * self.length * self.length) * self._beyond(m)
        loads.add(frame=p.rotor.on_frame(np.array([moment]), 0.0))

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Depth of the disk in the workpiece while touching, gap while apart, relative to the depth at rest."""
        return [(2 * mode - 1) * self._beyond(m) / self.depth]

    def rule(self, mode: Any) -> Rule:
        """Disk and work part and meet."""
        return Rule("one-sided contact")

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """Touching where the disk is in the work; at its very surface, where it is about to be."""
        m, _, solved = at.solved(APART)
        deep, deeper, ever = (
            float(value) / self.depth for value in (self._beyond(m), m.support[at.parameters.size], solved.frame[0])
        )
        mode = TOUCHING if inside(deep, deeper, ever, NEAR) else APART
        return at.y, at.mode if at.mode == mode else mode

    def energy(self, m: Motion, own: Any, p: Parameters) -> Any:
        """−c (l (φ − φ₀))²/2 where they are apart [J]: what the spring of the support holds too much there."""
        gap = self._beyond(m)
        return -self.stiffness * (self.length * gap) ** 2 / 2 if gap.real / self.depth < 0 else 0.0

    def _apart(self, samples: Samples) -> NDArray[np.bool_]:
        return np.asarray((samples.y[0] - self.touch_angle) / self.depth < 0)

    def share_apart(self, samples: Samples) -> float:
        """Share of the last twentieth of a run in which disk and work are apart, by the arm's angle."""
        late = samples.t >= LATE * samples.t[-1]
        return float(self._apart(samples)[late].mean())

    def last_apart(self, samples: Samples) -> float | None:
        """Last time at which they were apart [s], by the samples; None: never."""
        apart = samples.t[self._apart(samples)]
        return float(apart[-1]) if len(apart) else None

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """Remark that the disk lifts off its workpiece at the end of the run, or has done so before."""
        share = self.share_apart(samples)
        if share:
            return (
                f"The disk leaves its workpiece again and again, for {100 * share:.2g} % of the time at the end. The "
                "bounds on the arm hold while it is pressed. Press with a larger moment, or balance the wheel better",
            )
        last = self.last_apart(samples)
        return () if last is None else (f"The disk leaves its workpiece until t = {last:.3g} s, then it stays on it",)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Influence without a closed estimate: the effect decides whether a disk bounces."""
        return EffectInfluence(None, "the disk leaves its work where the arm swings farther than it is pressed in")


def lift_off(arm: SwingArmSupport, joint_stiffness: float, touch_angle: float) -> tuple[LiftOffEffect, ...]:
    """Lift-off of an arm whose own pivot has a stiffness [N/m]; none if the workpiece has no stiffness."""
    work = arm.stiffness - joint_stiffness
    if not work:
        return ()
    (angle,) = arm.resting_position()
    return (LiftOffEffect(work, arm.length, touch_angle, max(angle - touch_angle, LEAST_DEPTH)),)
