"""Race eccentricity: the races' centres stand off the axis of rotation by Δ at the angle φ in the rotor.

    Δ e_r(turn + φ),    accelerated by Δ (Ω' e_t − Ω² e_r)

The balls centre the race, so the axis keeps a whirl of radius Δ, whatever the speed. Source: derived.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

from abu_calc.dynamics.effects.effect import Effect, Kind, Weight
from abu_calc.dynamics.equations.parameters import Parameters
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.receptance import weighing_amplitude


@dataclass(frozen=True)
class RaceEccentricity(Effect):
    """`magnitude` Δ [m], `angle` φ [rad] from the zero mark; of all races alike."""

    magnitude: float
    angle: float = 0.0

    name: ClassVar[str] = "race_eccentricity"
    kind: ClassVar[Kind] = "driven"
    about: ClassVar[str] = (
        "Race eccentricity: the races' centres stand off the axis of rotation by Δ at the angle φ in the rotor"
    )

    def move(self, m: Motion, mode: Any, own: Any) -> None:
        """The races stand off the axis."""
        place = m.turn + self.angle
        m.offset = (self.magnitude * m.xp.cos(place), self.magnitude * m.xp.sin(place))

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """The races are carried round with the rotor."""
        x, y = m.offset
        square, a = m.speed * m.speed, m.acceleration
        ax, ay = -square * x - a * y, -square * y + a * x
        levers.carry(ay * m.cos - ax * m.sin, ax * m.cos + ay * m.sin)
        along, outward = x * m.cos + y * m.sin, x * m.sin - y * m.cos
        turning = [0] if p.arm_length is not None else []
        for row in [*turning, *([-1] if p.rotor == "driven" else [])]:
            levers.along[row] = levers.along[row] + along
            levers.outward[row] = levers.outward[row] + outward

    def weight(self, scene: Scene) -> Weight:
        """Δ, relative to the axis amplitude without it."""
        return Weight(self.magnitude / weighing_amplitude(scene), "the axis whirls with it, whatever the speed")
