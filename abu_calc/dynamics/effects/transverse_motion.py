"""Transverse motion: balls also roll across the race, in its groove, by w along the spindle.

Geometry, to second order in w/b, b = R_g − r the radius of the curve of the balls' centres across a groove of R_g:

    R = R_p − w²/2b,    R' = −w w'/b,    place R e_r + (w + a_z cos turn) ẑ,    tangent ∂place/∂w = ẑ − (w/b) e_r

Along the race that adds the acceleration 2 R' γ', outward −(w w'' + w'²)/b. Across it, per ball mass,

    (J + (w/b)²) w'' = −(w/b) (R γ'² + w'²/b) − h₀ w' + a_z (turn'² cos turn + turn'' sin turn) − frame's acceleration
                       − (J − 1) γ' (R θ' w/b + ν),        ν' = w' (γ' − R θ'/b)
    J R θ''          = … − 2 R' γ' − (J − 1) (R' θ' + R' γ' − ν w'/b)

The terms of J − 1 are the turning of a ball that rolls without slip both ways, its spin I ω' = r n × friction resolved
in the contact's frame; ν = r × (spin about the contact's normal, relative to the race) where that is free, 0 where the
contact locks it. They take nothing from the energy ½ (J − 1) m [(R θ')² + w'² + ν²] of rolling in the race. So

    ω_t² = (1/J) Ω² R_p/b,    with free spin Ω² [(1/J) R_p/b + (J − 1)/J]

Locked, J = 7/5: ω_t = Ω at 5 (R − r) = 7 (R_g − r), at every speed (Kladiev 1996, eq. (12), R that of the raceway):
then an axial runout "shakes out" dry friction. In print the locked spin is not mentioned; with free spin it is at
R_g = R. The axial runout is a motion of the machine along the spindle, once per turn: a swash of the race itself stands
still in the rotor. Left out: w Θ in the plane where races tilt by Θ, and w/b times the rotor's acceleration in ν'.
"""

import math
import sys
from typing import Any, ClassVar, Self

import numpy as np
from pydantic import model_validator

from abu_calc.dynamics.effect import ACROSS, ACROSS_RATE, BallRadius, Effect, EffectInfluence, Kind, SwitchPoint
from abu_calc.dynamics.motion import Across, AnyArray, Axial, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters, Race
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude, weighing_amplitude
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.reading.table import Table, entry, problem

_LARGEST = sys.float_info.max
_EDGE = 1e-9
"""Share of the groove that is left at a located event."""


class TransverseMotion(Table):
    """Balls also move across the race, in its toroidal groove (Kladiev 1996, eq. (12))."""

    groove_radius_mm: float = entry(gt=0, le=1e4, example=24.4).means(
        "Radius of the groove across the race [mm]; above ball_radius_mm, up to {most}."
    )
    ball_radius_mm: BallRadius
    axial_runout_mm: float = entry(0.0, ge=0, le=10).means(
        "Axial runout of the race, 0-peak [mm]; {range}. Default: {default}."
    )
    free_spin: bool = entry(False).means(
        "Whether balls spin freely about the contact's normal: true or false. Default: {default}."
    )

    @model_validator(mode="after")
    def _groove_holds_the_ball(self) -> Self:
        if self.groove_radius_mm <= self.ball_radius_mm:
            raise problem(
                "the ball does not fit into the groove",
                "groove_radius_mm",
                found=f"{self.groove_radius_mm:g} mm",
                allowed=f"above ball_radius_mm, {self.ball_radius_mm:g} mm",
            )
        return self


@dataclass(frozen=True)
class TransverseMotionEffect(Effect):
    """`groove_radius` R_g, `ball_radius` r, `axial_runout` a_z [m]; `free_spin`: about the contact's normal."""

    groove_radius: float
    ball_radius: float
    axial_runout: float = 0.0
    free_spin: bool = False

    name: ClassVar[str] = "transverse_motion"
    keys = TransverseMotion
    kind: ClassVar[Kind] = "driven"
    stage = "across"
    about: ClassVar[str] = "Transverse motion: balls also roll across the race, in its groove, by w along the spindle"
    switches: ClassVar[bool] = True

    def __post_init__(self) -> None:
        Range("ball radius", 0, _LARGEST, "m", open_low=True).check(self.ball_radius)
        Range("groove radius", self.ball_radius, _LARGEST, "m", open_low=True).check(self.groove_radius)
        Range("axial runout", 0, _LARGEST, "m").check(self.axial_runout)

    @property
    def ball_states(self) -> tuple[str, ...]:  # type: ignore[override]
        """w, w' and, where it is free, ν."""
        return (ACROSS, ACROSS_RATE, "spin") if self.free_spin else (ACROSS, ACROSS_RATE)

    @property
    def bend(self) -> float:
        """b = R_g − r [m]."""
        return self.groove_radius - self.ball_radius

    def _split(self, own: Any) -> tuple[AnyArray, AnyArray, Any]:
        """w, w', ν of all balls."""
        parts = (np.zeros(0) if own is None else own).reshape(len(self.ball_states), -1)
        return parts[0], parts[1], parts[2] if self.free_spin else 0.0

    def move(self, m: Motion, mode: Any, own: Any) -> None:
        """Balls off the middle stand nearer to the axis."""
        w, rolled, _ = self._split(own)
        radii = m.radii - w * w / (2 * self.bend)
        m.static_moments = m.static_moments * (radii / m.radii)
        m.radii, m.rolled = radii, rolled

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Coriolis and rolling along the race, and the direction across."""
        w, v, spin = self._split(own)
        lean, rolling = w / self.bend, p.inertia_factors - 1
        lever, nearer, curved = -lean * levers.outward, -lean * v, v * v / self.bend
        drive = -lean * (m.radii * m.swing * m.swing + curved) - p.drags / p.radii * v
        drive = drive - rolling * m.swing * (m.radii * m.rate * lean + spin)
        if levers.carried_outward is not None:
            drive = drive + lean * levers.carried_outward
        if levers.leaning is not None:
            self._lean(m, w, v, levers, loads, p)
        if self.axial_runout:
            self._shake(m, levers, loads, p)
        if levers.axial is not None:
            lever, drive = lever + levers.axial.lever, drive - levers.axial.carried
        levers.carry(2 * nearer * m.swing, -curved)
        loads.add(pull=-rolling * (nearer * (m.rate + m.swing) - spin * v / self.bend))
        if p.frame.turning:  # what turns the rotor turns the balls
            rows = np.zeros(len(p.frame.mass))
            rows[list(p.frame.turning)] = 1.0
            loads.add(frame=rows * (p.masses * p.spins).dot(nearer * m.rate))
        loads.own(across=Across(lever, p.inertia_factors + lean * lean, drive, -lean))

    def _lean(self, m: Motion, w: AnyArray, v: AnyArray, levers: Levers, loads: Loads, p: Parameters) -> None:
        """Add the forces of a race that leans: −½ m γ'² 2 w w_t.

        A ball off the plane of such a race is nearer to the axis or further from it.
        """
        leaning, axial = levers.leaning, levers.axial
        assert leaning is not None and axial is not None
        outward = m.swing * m.swing * w
        loads.add(pull=-axial.slope * outward, frame=-axial.lever.dot(p.masses * outward))
        levers.sunk = levers.sunk + 2 * w * leaning.height
        levers.sinking = levers.sinking + 2 * m.swing * (w * leaning.rise + v * leaning.height)

    def _shake(self, m: Motion, levers: Levers, loads: Loads, p: Parameters) -> None:
        """The races' own acceleration along the spindle, and how the turning of a driven rotor makes it."""
        c, s, zero = m.xp.cos(m.turn), m.xp.sin(m.turn), 0.0 * m.cos
        shaken = zero - self.axial_runout * (m.speed * m.speed * c + m.acceleration * s)
        rows = [zero] * len(levers.outward)
        for row in p.frame.turning:
            rows[row] = zero - self.axial_runout * s
        before = levers.axial or Axial(0.0, 0.0, zero)
        if levers.leaning is not None:  # this way is none of the lean, and sees the going round of the other
            loads.add(frame=np.array(rows).dot(p.masses * m.swing * m.swing * levers.leaning.height))
        levers.axial = Axial(before.lever + np.array(rows), before.carried + shaken, before.slope)
        if levers.sunk is None:
            levers.sunk = levers.sinking = zero

    def rates(self, m: Motion, own: Any, solved: Solved) -> AnyArray:
        """w', w'', ν'."""
        _, v, _ = self._split(own)
        spun = [v * (m.swing - m.radii * m.rate / self.bend)] if self.free_spin else []
        return np.concatenate([v, solved.across, *spun])

    def start(self, scene: Circumstances) -> tuple[float, ...]:
        """Balls at rest in the middle of the groove."""
        return (0.0,) * (len(self.ball_states) * len(scene.ball_masses))

    def scales(self, scene: Circumstances) -> tuple[float, ...]:
        """The axial runout, or a hundredth of the ball; rates at the speed of the rotor."""
        balls, way = len(scene.ball_masses), max(self.axial_runout, 0.01 * self.ball_radius)
        return (way,) * balls + (way * scene.speed,) * (balls * (len(self.ball_states) - 1))

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """1 − (w/w_max)²: no further than the groove reaches, nor far enough to lose half the pitch radius."""
        return self._left(own, p)

    def _left(self, own: Any, p: Parameters) -> list[Any]:
        w, _, _ = self._split(own)
        return [*(1 - w * w / self.bend**2), *(1 - w * w / (self.bend * p.radii))]

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """Nothing changes; raises NotTrustworthyError when a ball has climbed out of its groove."""
        left = self._left(at.own, at.parameters)
        if left and min(left) < _EDGE:
            ball = 1 + int(np.argmin(left)) % at.parameters.balls
            raise NotTrustworthyError(
                f"ball {ball} climbs out of its groove at t = {at.t:.6g} s\n"
                "  less axial runout, more rolling drag, or a groove radius whose resonance is further from the speed"
            )
        return at.y, at.mode

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """Drag across, −Σ m h₀ w'², and what the drag along the race takes at R beyond what it takes at R_p [W].

        The axial runout is part of the balls' places, like the turning of the rotor: its work is the drive's.
        """
        _, v, _ = self._split(own)
        drag = p.drags / p.radii
        return -(p.masses * drag).dot(v * v + p.radii * (m.radii - p.radii) * m.rate * m.rate)

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Σ m w²/2b as an imbalance, w the way across at steady state; None at a resonance that nothing damps, and on a
        support that tilts.
        """
        why = "balls off the middle of the groove stand nearer to the axis"
        if scene.support.tilt(np.array(scene.start_position)) is not None:
            return EffectInfluence(None, "a race that tilts moves the balls across it")
        if not self.axial_runout:
            return EffectInfluence(0.0, "no axial runout: the balls stay in the middle of the groove")
        lost = [self._way(scene, race) ** 2 / (2 * self.bend) * sum(race.ball_masses) for race in scene.races]
        if not all(math.isfinite(imbalance) for imbalance in lost):
            return EffectInfluence(None, f"{why}; the axial runout meets their resonance")
        return EffectInfluence(unbalanced_amplitude(scene, sum(lost)) / weighing_amplitude(scene), why)

    def _way(self, scene: Circumstances, race: Race) -> float:
        """Amplitude of w by the axial runout [m], as far as the groove reaches."""
        J, speed = race.inertia_factor, scene.speed
        stiffness = race.pitch_radius / self.bend + (J - 1 if self.free_spin else 0.0) - J
        resistance = abs(complex(stiffness, race.drag / speed))
        return min(self.axial_runout / resistance, self.bend) if resistance > 1e-12 else math.inf
