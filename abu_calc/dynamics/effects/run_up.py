"""Run-up and run-down: the rotor's speed rises from 0 to Ω at an even pace, and falls to 0 at the end.

    Ω' = Ω/T_up for t < T_up,   0,   −Ω/T_down for t > duration − T_down

After the run-up the speed may be reduced for a while: it falls to a lower one, stays there, and rises again.

A rolling ball is turned by the race that accelerates: (J − 1) r Ω'/R_p on θ''. Source: derived from the rolling energy
½ (J − 1) m (r·turn' − R_p θ')². In a steady ramp a ball lags by θ' = −(1 − (J − 1) r/R_p) Ω'/h₀. What drives the
rotor stands on what carries it: a swing arm feels −J_r Ω', J_r the rotor's inertia. With a motor the rotor starts from
rest, its torque sets the pace, and in the run-down it is switched off.

    parameter  unit   range                 default   source
    up         s      ≥ 0; 0: none          required  measured
    down       s      ≥ 0; 0: none          0         measured
    inertia    kg m²  ≥ 0; 0: not known     0         data sheet, all that turns
    low        rad/s  ≥ 0                   0         chosen: speed of the reduction
    fall       s      ≥ 0; 0: no reduction  0         chosen
    pause      s      ≥ 0                   0         chosen
    rise       s      ≥ 0                   0         chosen
"""

from typing import Any, ClassVar, Self

import numpy as np
from pydantic import model_validator

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind, Laws
from abu_calc.dynamics.motion import Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import GUIDED, Parameters, Rotation
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.trajectory import Samples
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.reading.table import Table, entry, problem


class SceneRunUp(Table):
    """A speed that rises from 0 to speed_rpm, or falls from it to 0, at an even pace."""

    time_s: float | None = entry(None, gt=0, le=3600, example=1.0).means(
        "Time from standstill to speed_rpm [s]; {range}."
    )
    run_down_s: float | None = entry(None, gt=0, le=3600, example=3.0).means(
        "Time from speed_rpm to standstill, at the end of the run [s]; {range}."
    )
    rotor_inertia_kg_m2: float | None = entry(None, gt=0, le=1e6, example=2e-3).means(
        "Moment of inertia of all that turns, reduced to the spindle [kg·m²]; {range}. With it a swing arm feels what "
        "the change of speed takes; a motor has its own."
    )

    @model_validator(mode="after")
    def _up_or_down(self) -> Self:
        if self.time_s is None and self.run_down_s is None:
            raise problem(
                "the run-up has no time", "time_s", allowed="time_s, run_down_s or both", remedy="add time_s = 1.0"
            )
        return self


@dataclass(frozen=True)
class RunUpEffect(Effect):
    """`up`, `down` [s]: times from standstill to the scene's speed and back; 0 for none.

    `inertia` J_r of the rotor [kg m²], 0 where it is not known: then a swing arm lacks the torque that drives it.
    `fall`, `pause`, `rise` [s]: times of a dip to `low` [rad/s]; `fall` 0 for none.
    """

    up: float
    down: float = 0.0
    inertia: float = 0.0
    low: float = 0.0
    fall: float = 0.0
    pause: float = 0.0
    rise: float = 0.0

    name: ClassVar[str] = "run_up"
    keys = SceneRunUp
    kind: ClassVar[Kind] = "driven"
    stage = "rotor"
    about: ClassVar[str] = (
        "Run-up and run-down: the rotor's speed rises evenly from 0 to Ω, or falls evenly to 0 at the end of the run"
    )

    @classmethod
    def of(cls, table: SceneRunUp) -> Self:
        """Run-up of a scene file."""
        return cls(table.time_s or 0.0, table.run_down_s or 0.0, table.rotor_inertia_kg_m2 or 0.0)

    @property
    def rotor(self) -> Rotation:
        """Guided rotor: its speed is given."""
        return GUIDED

    @property
    def from_rest(self) -> bool:
        """True if the scene has a run-up."""
        return bool(self.up)

    @property
    def run_down(self) -> float:
        """Duration of the run-down at the end."""
        return self.down

    @property
    def least_duration(self) -> float:
        """All together."""
        return self.at_speed + self.down

    @property
    def at_speed(self) -> float:
        """Time from which the rotor stays at full speed [s]."""
        return self._parts[-1] if self.fall else self.up

    def move(self, m: Motion, mode: Any, own: Any) -> None:
        """The rotor accelerates evenly."""
        m.acceleration = mode

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Apply the reaction of the drive to whatever carries the rotor, if that can turn.

        A motor's effect accounts for its own reaction.
        """
        if self.inertia and _reacts(p):
            unit = np.zeros(len(p.frame.mass))
            unit[list(p.frame.turning)] = 1.0
            loads.add(frame=-self.inertia * mode * unit)

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """−J_r Ω' φ' [W] on an arm that turns by φ."""
        return -self.inertia * mode * (m.speed - m.own_speed) if self.inertia and _reacts(p) else 0.0

    def breaks(self, scene: Circumstances) -> tuple[float, ...]:
        """Ends of the run-up and of each part of a dip, begin of the run-down."""
        if self.least_duration > scene.duration:
            raise InputError(
                "the run ends before the run-up and the run-down do",
                found=f"{scene.duration:g} s",
                allowed=f"at least {self.least_duration:g} s",
                remedy="a longer duration",
            )
        down = scene.duration - self.down if self.down else 0.0
        return tuple(sorted({end for end in (self.up, *self._parts, down) if 0 < end < scene.duration}))

    @property
    def _parts(self) -> tuple[float, ...]:
        """Ends of the parts of a dip [s]: down, between, up again."""
        low = self.up + self.fall
        return (low, low + self.pause, low + self.pause + self.rise) if self.fall else ()

    def mode_at(self, scene: Circumstances, t: float, mode: Any) -> Any:
        """Ω' [rad/s²] from t on; nothing is given where a motor drives."""
        if not scene.rotor.given:
            return 0.0
        if t < self.up:
            return scene.speed / self.up
        if t < self.at_speed:
            fallen, paused, _ = self._parts
            change = scene.speed - self.low
            return -change / self.fall if t < fallen else 0.0 if t < paused else change / self.rise
        if self.down and t >= scene.duration - self.down:
            return -scene.speed / self.down
        return 0.0

    def first_mode(self, scene: Circumstances) -> Any:
        """Ω' at t = 0."""
        return self.mode_at(scene, 0.0, None)

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """Remark that an arm lacks the reaction torque if the inertia is not known, and how much that is."""
        scene = equations.scene
        if self.inertia or not _reacts(equations.parameters):
            return ()
        fastest = max(abs(self.mode_at(scene, t, None)) for t in (0.0, *self.breaks(scene)))
        return (
            "run_up: the arm lacks the wheel's reaction torque −J·Ω', since run_up.rotor_inertia_kg_m2 is not given; "
            f"Ω' = {fastest:.4g} rad/s² takes {fastest * 1e-3:.3g} N·m for each 0.001 kg·m²",
        )

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Influence without an estimate: the run-up is the scene itself."""
        return EffectInfluence(None, "the speed itself: without it there is no run-up")


def _reacts(p: Parameters) -> bool:
    """True if whatever carries the rotor turns, and no other effect accounts for its drive."""
    return p.rotor.given and bool(p.frame.turning)
