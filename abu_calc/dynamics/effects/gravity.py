"""Gravity on the balls of a horizontal spindle, toward −y.

    V = Σ m g (R_p sin γ + y of the race off the axis) + m₀e g sin(turn + φ),    g = 9.80665 m/s² (ISO 80000-3:2019)

The support's own weight and that of the balls in the middle are held by its springs: the axis is counted from static
equilibrium. Source: Kladiev 1996, (1), the term −(g/R) cos γ.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from abu_calc.dynamics.effects.effect import Effect, Kind, Weight
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.parameters import Parameters
from abu_calc.dynamics.scene import Scene, SwingArm
from abu_calc.units import GRAVITY


SHAKES = 0.1
"""Share of what dry friction holds from which gravity is taken to help balls loose: they are pulled otherwise, too."""


@dataclass(frozen=True)
class Gravity(Effect):
    """Weight of balls and imbalance; `acceleration` g [m/s²]."""

    acceleration: float = GRAVITY

    name: ClassVar[str] = "gravity"
    kind: ClassVar[Kind] = "conservative"

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """−g along y on each ball, and its moment about the rotor where that turns freely."""
        g = self.acceleration
        loads.add(pull=-g * m.cos, press=-g * m.sin)
        turning = [0] if p.arm_length is not None else []
        turning += [-1] if p.rotor == "driven" else []
        if turning:
            moment = m.moments.dot(m.cos) + p.imbalance * m.xp.cos(m.turn + p.imbalance_angle)
            if m.offset is not None:
                moment = moment + p.masses.sum() * m.offset[0]
            rows = np.zeros(len(p.frame_mass))
            rows[turning] = -1.0
            loads.add(frame=rows * (g * moment))

    def energy(self, m: Motion, own: Any, p: Parameters) -> Any:
        """V [J]."""
        height = m.moments.dot(m.sin) + p.imbalance * m.xp.sin(m.turn + p.imbalance_angle)
        if m.offset is not None:
            height = height + p.masses.sum() * m.offset[1]
        return self.acceleration * height

    def _shakes(self, scene: Scene, friction: float) -> bool:
        held = [friction * race.pitch_radius * scene.speed**2 for race in scene.races]
        return any(self.acceleration > SHAKES * hold for hold in held)

    def weight(self, scene: Scene) -> Weight:
        """g/(J R_p Ω²) [rad]: it swings the balls so far, once per turn.

        Where it pulls harder than dry friction holds, f R_p Ω², it shakes out all that friction does.
        """
        friction = scene.effect("dry_rolling_friction")
        if friction is not None and self._shakes(scene, getattr(friction, "coefficient", 0.0)):
            return Weight(friction.weight(scene).value, "shakes balls that stick by dry friction loose in every turn")
        slowest = max((1 / (race.inertia_factor * race.pitch_radius) for race in scene.races), default=0.0)
        why = "swings the balls once per turn"
        if isinstance(scene.support, SwingArm):
            return Weight(None, f"{why}; on a swing arm not estimated")
        return Weight(self.acceleration * slowest / scene.speed**2, why)
