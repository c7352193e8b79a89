"""A motor of limited power, whose torque falls linearly from stall to its no-load speed.

    M = M_stall (1 − Ω/Ω₀),    J_r Ω' = M − (what balls and imbalance take)

With too little torque the speed sticks at a resonance (Sommerfeld 1902): the power goes into the vibration. Source:
Blekhman 1988, Synchronization in Science and Technology, ch. 6. The rotor starts at the scene's speed, or from rest in
a run-up.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from abu_calc.dynamics.effects.effect import Effect, Kind, Weight
from abu_calc.dynamics.equations.parameters import Parameters, Rotor
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.scene import Scene


@dataclass(frozen=True)
class Motor(Effect):
    """`stall_torque` [N m], `no_load_speed` [rad/s], `inertia` of the rotor [kg m²]."""

    stall_torque: float
    no_load_speed: float
    inertia: float

    name: ClassVar[str] = "motor"
    kind: ClassVar[Kind] = "driven"
    about: ClassVar[str] = "A motor of limited power, whose torque falls linearly from stall to its no-load speed"

    @property
    def rotor(self) -> Rotor:
        """Its torque is given."""
        return "driven"

    @property
    def rotor_inertia(self) -> float:
        """That of the rotor [kg m²]."""
        return self.inertia

    def torque(self, m: Motion, mode: Any, p: Parameters) -> Any:
        """M [N m] at the speed of the moment, relative to the arm on an arm; `mode` is 0 where it is switched off."""
        speed = m.speed if p.arm_length is None else m.speed - m.support[1]
        return mode * self.stall_torque * (1 - speed / self.no_load_speed)

    def first_mode(self, scene: Scene) -> Any:
        """Switched on."""
        return 1.0

    def mode_at(self, scene: Scene, t: float, mode: Any) -> Any:
        """Switched off in a run-down."""
        run_up = scene.effect("run_up")
        down = getattr(run_up, "down", 0.0)
        return 0.0 if down and t >= scene.duration - down else 1.0

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """The torque turns the rotor."""
        unit = np.zeros(len(p.frame_mass))
        unit[-1] = 1.0
        loads.add(frame=unit * self.torque(m, mode, p))

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """M Ω [W]."""
        speed = m.speed if p.arm_length is None else m.speed - m.support[1]
        return self.torque(m, mode, p) * speed

    def weight(self, scene: Scene) -> Weight:
        """Not estimated: capture at a resonance is all or nothing."""
        return Weight(None, "the speed itself may differ: it can stick at a resonance")
