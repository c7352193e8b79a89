"""A motor of limited power, whose torque falls linearly from stall to its no-load speed.

    M = M_stall (1 − Ω/Ω₀),    J_r Ω' = M − (what balls and imbalance take)

With too little torque the speed sticks at a resonance (Sommerfeld 1902): the power goes into the vibration. Source:
Blekhman 1988, Synchronization in Science and Technology, ch. 6. The rotor starts at the scene's speed, or from rest in
a run-up.

    parameter  unit   range  default   source
    inertia    kg m²  > 0    required  data sheet, all that turns
"""

from typing import Any, ClassVar, Self

import numpy as np

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import DRIVEN, Parameters, Rotation
from abu_calc.dynamics.support import Circumstances
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.duty import Motor


@dataclass(frozen=True)
class MotorEffect(Effect):
    """`stall_torque` [N m], `no_load_speed` [rad/s], `inertia` of the rotor [kg m²]."""

    stall_torque: float
    no_load_speed: float
    inertia: float

    name: ClassVar[str] = "motor"
    keys = Motor
    kind: ClassVar[Kind] = "driven"
    stage = "rotor"
    about: ClassVar[str] = "Motor of limited power: its torque falls linearly from standstill to the no-load speed"

    @classmethod
    def of(cls, table: Motor) -> Self:
        """Motor of a table of a machine or of a scene."""
        return cls(table.stall_torque, table.no_load_speed, table.rotor_inertia)

    @property
    def rotor(self) -> Rotation:
        """Driven rotor: its torque is given."""
        return DRIVEN

    @property
    def rotor_inertia(self) -> float:
        """Inertia of the rotor [kg m²]."""
        return self.inertia

    def torque(self, m: Motion, mode: Any, p: Parameters) -> Any:
        """M [N m] at the present speed against what carries it; `mode` is 0 where it is switched off."""
        return mode * self.stall_torque * (1 - m.own_speed / self.no_load_speed)

    def first_mode(self, scene: Circumstances) -> Any:
        """Switched on."""
        return 1.0

    def mode_at(self, scene: Circumstances, t: float, mode: Any) -> Any:
        """Switched off in a run-down."""
        return 0.0 if scene.run_down and t >= scene.duration - scene.run_down else 1.0

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """The torque turns the rotor."""
        unit = np.zeros(len(p.frame.mass))
        unit[-1] = 1.0
        loads.add(frame=unit * self.torque(m, mode, p))

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """M Ω [W]."""
        return self.torque(m, mode, p) * m.own_speed

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Influence without an estimate: capture at a resonance is all or nothing."""
        return EffectInfluence(None, "the speed may stall at a resonance")
