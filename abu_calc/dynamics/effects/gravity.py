"""Gravity on the balls of a horizontal spindle, toward −y.

    V = Σ m g (R_p sin γ + y of the race off the axis) + m₀e g sin(turn + φ),    g = 9.80665 m/s² (ISO 80000-3:2019)

The support's own weight and that of the balls in the middle are held by its springs: the axis is counted from static
equilibrium. Source: Kladiev 1996, (1), the term −(g/R) cos γ.

    parameter     unit  range  default  source
    acceleration  m/s²  any    9.80665  ISO 80000-3:2019
"""

from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind, Laws
from abu_calc.dynamics.motion import Levers, Loads, Motion
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.trajectory import Samples
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import GRAVITY
from abu_calc.inputs.reading.table import Table

SHAKES = 0.1
"""Share of what dry friction holds from which gravity is taken to help balls loose: they are pulled otherwise, too."""


class Gravity(Table):
    """Weight of the balls, toward -y; the axis is counted from static equilibrium. No keys."""


@dataclass(frozen=True)
class GravityEffect(Effect):
    """Weight of balls and imbalance; `acceleration` g [m/s²]."""

    acceleration: float = GRAVITY

    name: ClassVar[str] = "gravity"
    keys = Gravity
    kind: ClassVar[Kind] = "conservative"
    about: ClassVar[str] = "Gravity on the balls of a horizontal spindle, toward −y"
    averaged: ClassVar[bool] = True

    @property
    def falling(self) -> float:
        """g."""
        return self.acceleration

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """−g along y on each ball, and its moment about the rotor where that turns freely."""
        g = self.acceleration
        loads.add(pull=-g * m.cos, press=-g * m.sin)
        if p.frame.turning:
            aside = m.static_moments.dot(m.cos) + p.imbalance * m.xp.cos(m.turn + p.imbalance_angle)
            if m.offset is not None:
                aside = aside + p.masses.sum() * m.offset[0]
            rows = np.zeros(len(p.frame.mass))
            rows[list(p.frame.turning)] = -1.0
            loads.add(frame=rows * (g * aside))

    def energy(self, m: Motion, own: Any, p: Parameters) -> Any:
        """V [J]."""
        height = m.static_moments.dot(m.sin) + p.imbalance * m.xp.sin(m.turn + p.imbalance_angle)
        if m.offset is not None:
            height = height + p.masses.sum() * m.offset[1]
        return self.acceleration * height

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """A warning when a ball would fall off its race: R_p γ'² < g sin γ. The equations hold it there."""
        scene = equations.scene
        first, balls = 2 * len(scene.support.names), len(scene.ball_masses)
        places, rates = samples.y[first : first + balls], samples.y[first + balls : first + 2 * balls]
        turn, speed = scene.rotor.turning(samples.t, samples.y, scene.speed)
        carried = equations.parameters.geometry.turning(samples.y[:first])
        if carried is not None:
            turn, speed = turn + carried[0], speed + carried[1]
        radii = np.array([[race.pitch_radius] for race in scene.races for _ in race.ball_masses])
        falls = radii * (rates + speed) ** 2 < self.acceleration * np.sin(places + turn) if balls else np.zeros((0, 1))
        if not falls.any():
            return ()
        sample = int(falls.any(axis=0).argmax())
        ball = 1 + int(falls[:, sample].argmax())
        return (
            f"gravity: ball {ball} would fall off its race at t = {samples.t[sample]:.4g} s, where it is pulled "
            "harder than it is pressed; here it is held",
        )

    def _shakes(self, scene: Circumstances, friction: float) -> bool:
        held = [friction * race.pitch_radius * scene.speed**2 for race in scene.races]
        return any(self.acceleration > SHAKES * hold for hold in held)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Estimated influence of gravity.

        If gravity pulls harder than dry friction holds, f R_p Ω², it also releases all balls that friction
        holds.
        """
        own = self._swings(scene)
        if own.value is None or (holding := scene.holding) is None or not self._shakes(scene, holding.friction):
            return own
        if holding.weight is not None and holding.weight <= own.value:
            return own
        return EffectInfluence(holding.weight, "shakes balls that stick by dry friction loose in every turn")

    def _swings(self, scene: Circumstances) -> EffectInfluence:
        """Balls swing by a = g/(J R_p Ω²) [rad] once per turn, and the axis with them, driven by Σ m R_p a/2 at 2Ω.

        m R_p e^{i(γ + a cos γ)} has the part i (a/2) m R_p e^{2iγ}, which adds up where balls are in one line. A ball
        that starts at rest is also pushed off at up to a Ω, and drag stops it after a Ω J/h₀; where nothing brings it
        back, among more than two balls, it stays there.
        """
        if not scene.ball_masses:
            if scene.rotor.rows:
                return EffectInfluence(None, "turns the rotor by its imbalance")
            return EffectInfluence(0.0, "no balls")
        why = "swings the balls once per turn, and the spindle twice"
        if scene.support.turns:
            return EffectInfluence(None, f"{why}; on a swing arm not estimated")
        aside, pushed = 0.0, 0.0
        for race in scene.races:
            swing = self.acceleration / (race.inertia_factor * race.pitch_radius * scene.speed**2)
            aside += swing / 2 * sum(race.ball_masses) * race.pitch_radius
            if not race.drag:
                return EffectInfluence(None, f"{why}; without drag they drift")
            pushed = max(pushed, swing, swing * scene.speed * race.inertia_factor / race.drag)
        try:
            driven = unbalanced_amplitude(replace(scene, speed=2 * scene.speed), aside)
        except InputError:
            return EffectInfluence(None, f"{why}, which meets a resonance that nothing damps")
        return EffectInfluence(max(pushed, driven / weighing_amplitude(scene)), why)
