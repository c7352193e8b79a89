"""Grease that balls churn: a drag that grows with the third power of their speed along the race.

    J θ'' = −c θ'³,    so that alone θ' = ω₀/√s and θ = θ₀ + J (√s − 1)/(c ω₀), with s = 1 + 2 c ω₀² t/J

Source: separation of variables.
"""

from dataclasses import dataclass
from typing import Any, ClassVar

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances
from abu_calc.inputs.reading.table import Table, entry


class GreaseChurning(Table):
    """Grease that balls churn: a drag that grows with the third power of their speed along the race."""

    coefficient_s: float = entry(ge=0, le=1e6, example=0.1).means("Torque over m·R_p²·speed³ [s]; {range}.")


@dataclass(frozen=True)
class Churning(Effect):
    """`coefficient` c [s]: the torque on a ball is −m R_p² c θ'³."""

    coefficient: float

    name: ClassVar[str] = "churning"
    keys = GreaseChurning
    kind: ClassVar[Kind] = "dissipative"
    about: ClassVar[str] = "Grease that balls churn: a drag by the third power of their speed along the race"

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """−R_p c θ'³ on each ball, per mass."""
        loads.add(pull=-self.coefficient * m.radii * m.rate * m.rate * m.rate)

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """−Σ m R_p² c θ'⁴."""
        return -self.coefficient * (m.static_moments * m.radii).dot(m.rate**4)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Not estimated."""
        return EffectInfluence(None, "slows fast balls more than slow ones")
