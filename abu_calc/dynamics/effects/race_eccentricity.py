"""Race eccentricity: the races' centres stand off the axis of rotation by Δ at the angle φ in the rotor.

    Δ e_r(turn + φ),    accelerated by Δ (Ω' e_t − Ω² e_r)

The balls centre the race, so the axis keeps a whirl of radius Δ, whatever the speed. Source: derived.
"""

import cmath
from typing import Any, ClassVar

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.supports.steady_motion import weighing_amplitude
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.table import Table, entry


class RaceEccentricity(Table):
    """The race's centre stands off the axis of rotation."""

    magnitude_mm: float = entry(ge=0, le=100, example=0.01).means(
        "Distance of the race's centre from the axis of rotation [mm]; {range}, usually 0.005 … 0.020."
    )
    angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle of the centre of the race from the zero mark [degrees]; {range}. Default: {default}."
    )


@dataclass(frozen=True)
class RaceEccentricityEffect(Effect):
    """`magnitude` Δ [m], `angle` φ [rad] from the zero mark; of all races alike."""

    magnitude: float
    angle: float = 0.0

    name: ClassVar[str] = "race_eccentricity"
    keys = RaceEccentricity
    kind: ClassVar[Kind] = "driven"
    stage = "races"
    about: ClassVar[str] = (
        "Race eccentricity: the centres of the races are off the axis of rotation by Δ, at the angle φ in the rotor"
    )
    averaged: ClassVar[bool] = True

    @property
    def offset(self) -> complex:
        """Δ e^{iφ}."""
        return self.magnitude * cmath.exp(1j * self.angle)

    def move(self, m: Motion, mode: Any, own: Any) -> None:
        """The races stand off the axis."""
        x, y = self._direction(m)
        m.offset = (self.magnitude * x, self.magnitude * y)

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """The races are carried round with the rotor."""
        x, y = self._direction(m)  # Δ comes last, once for all balls
        along, outward = x * m.cos + y * m.sin, x * m.sin - y * m.cos
        steady, growing = self.magnitude * (m.speed * m.speed), self.magnitude * m.acceleration
        levers.carry(steady * outward + growing * along, growing * outward - steady * along)
        for row in p.frame.turning:
            levers.along[row] = levers.along[row] + self.magnitude * along
            levers.outward[row] = levers.outward[row] + self.magnitude * outward

    def _direction(self, m: Motion) -> tuple[Any, Any]:
        """Direction from the axis to the races' centres."""
        place = m.turn + self.angle
        return m.xp.cos(place), m.xp.sin(place)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Δ, relative to the axis amplitude without it."""
        return EffectInfluence(self.magnitude / weighing_amplitude(scene), "the spindle whirls by it at any speed")
