"""Grinding contact: the wheel is pressed to the workpiece on the −y side, where it cuts.

    N along +y,    T = s f N along x,    h = y_w + ε sin(turn + φ₀): how far the wheel's surface stands off its place

    compliant    N = N₀ − c_n h while that is positive (touching), 0 else (apart)
    rigid        h = 0 without parting: N is the reaction, negative where the wheel would part
    face         N = N₀, along the spindle: runout does not press, T moves the mean place alone and is left out

The axis is counted from static equilibrium under the press force N₀, so along y acts N − N₀; T acts as a whole. s = −1:
friction opposes a rotation from +x to +y; s = +1 is T as Kladiev 1996 prints it, which drives that rotation. Both work
on the centre of the wheel's surface, ε e^{i(turn + φ₀)} off the axis, R_w above the work: a driven rotor feels

    ε (N cos − T sin)(turn + φ₀) + T R_w,    face: s f N₀ R_w

If T brakes a driven rotor, it turns round with the sliding, and at rest holds by up to f N, see
`switching.contact_stop`.

Source: Kladiev 1996, (1), (3), (10). Printed: N < 0 is not excluded; rigid contact is given as printed, and a remark
tells where that cannot be. There T = s f N may feed the balls: N grows with the square of their speed and their power
with its cube, so that it is infinite after a finite time. Compliance, one-sided contact and torque are derived.
"""

import cmath
import math
import sys
from dataclasses import replace
from typing import Any, ClassVar, Final, Literal

import numpy as np

from abu_calc.dynamics.effect import Effect, EffectInfluence, Kind, Laws, Rule, SwitchPoint
from abu_calc.dynamics.motion import AnyArray, Constraint, Levers, Loads, Motion, Solved
from abu_calc.dynamics.rotor import Parameters
from abu_calc.dynamics.support import Circumstances
from abu_calc.dynamics.supports.steady_motion import receptance, reference_imbalance, weighing_amplitude
from abu_calc.dynamics.switching.contact_stop import RUNAWAY, Cutting, Slip, check_speeds, decided, goes_on, inside
from abu_calc.dynamics.trajectory import Samples, at_samples
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range
from abu_calc.inputs.duty import Grinding
from abu_calc.inputs.reading.table import entry

Contact = Literal["compliant", "rigid", "face"]

_LARGEST = sys.float_info.max

TOUCHING, APART = 1.0, 0.0

STOPPED: Final = 0.01
"""Share of the scene's speed: a rotor slower than this stands."""

_REMEDY: Final = ": press harder, or run the wheel truer"

PARTING: Final = (
    f"wheel and workpiece lose contact again and again{_REMEDY}. Nothing damps their contact, so the bouncing may "
    "depend on the start case"
)
DRIVEN: Final = (
    "with rotation_sense = 1 the workpiece drives the rotor, as published in Kladiev 1996. A cutting wheel is braked: "
    "set rotation_sense = -1"
)

BRAKES: Final = {
    True: "cutting brakes a driven rotor",
    False: "no wheel radius: cutting does not brake the rotor",
}
"""Texts by whether the radius of the wheel is known."""

NEAR = 1e-9
"""Distance, relative to the contact's own lengths, within which the motion decides about contact.

So near, the motion tells whether wheel and workpiece touch.
"""

LEAST_DEPTH = 1e-9
"""A depth [m] that counts as something where there is neither press nor runout."""


class GrindingContact(Grinding):
    """Wheel and work under load."""

    runout_mm: float = entry(0.0, ge=0, le=10).means(
        "Eccentricity of the wheel's outer surface, half of what a dial gauge shows [mm]; {range}. Default: {default}, "
        "a true wheel."
    )
    runout_angle_deg: float = entry(0.0, ge=-360, le=360).means(
        "Angle of the high spot from the zero mark [degrees]; {range}. Default: {default}."
    )
    wheel_radius_mm: float | None = entry(None, gt=0, le=1e4, example=75.0).means(
        "Radius of the wheel [mm]; {range}. With it cutting brakes a rotor that a motor drives."
    )
    plane_offset_mm: float = entry(0.0, ge=-1e5, le=1e5).means(
        "Tilting support: place of the wheel along +z from the centre of mass [mm]; {range}. Default: {default}."
    )


@dataclass(frozen=True)
class GrindingContactEffect(Effect):
    """`press_force` N₀ [N], `cutting_coefficient` f, `contact_stiffness` c_n [N/m] where compliant, `rotation_sense` s.

    `runout` ε [m] of the wheel's surface at `runout_angle` φ₀ [rad] from the zero mark, `wheel_radius` R_w [m], 0 where
    it is not known: then cutting does not brake the rotor; `plane_offset` z [m] of the wheel on supports that tilt.
    """

    press_force: float
    cutting_coefficient: float
    contact: Contact = "compliant"
    contact_stiffness: float = 0.0
    rotation_sense: int = -1
    runout: float = 0.0
    runout_angle: float = 0.0
    wheel_radius: float = 0.0
    plane_offset: float = 0.0

    name: ClassVar[str] = "grinding_contact"
    keys = GrindingContact
    kind: ClassVar[Kind] = "driven"
    about: ClassVar[str] = "Grinding contact: the wheel is pressed to the workpiece on its −y side, and cuts there"
    switches: ClassVar[bool] = True
    whole_run: ClassVar[bool] = True

    def __post_init__(self) -> None:
        Range("press force", 0, _LARGEST, "N").check(self.press_force)
        Range("cutting coefficient", 0, _LARGEST).check(self.cutting_coefficient)
        Range("wheel runout", 0, _LARGEST, "m").check(self.runout)
        Range("wheel radius", 0, _LARGEST, "m").check(self.wheel_radius)
        if self.contact == "compliant":
            Range("contact stiffness", 0, _LARGEST, "N/m", open_low=True).check(self.contact_stiffness)
        if self.rotation_sense not in (-1, 1):
            raise InputError("rotation sense", found=str(self.rotation_sense), allowed="-1, 1")

    def switching(self, scene: Circumstances) -> bool:
        """Wheel and work part where the contact is compliant; where it is rigid, balls may run away; rotors stop."""
        return self.contact != "face" or self._may_stop(scene)

    @property
    def drag(self) -> float:
        """s f: T per N."""
        return self.rotation_sense * self.cutting_coefficient

    def _may_stop(self, scene: Circumstances) -> bool:
        """True if cutting brakes a rotor that a torque drives."""
        return self.drag < 0 and self.wheel_radius > 0 and bool(scene.rotor.rows)

    def check(self, scene: Circumstances) -> None:
        """Raise InputError on supports that have no such contact."""
        self._row(scene)

    def first_mode(self, scene: Circumstances) -> Any:
        """Touching, and sliding where that may change."""
        if self._may_stop(scene):
            return Cutting()
        return TOUCHING if self.contact == "compliant" else None

    def _row(self, scene: Circumstances) -> AnyArray:
        """y_w per unit of each coordinate of the support."""
        return np.asarray(scene.support.plane(self.plane_offset)[1])

    def act(self, m: Motion, mode: Any, own: Any, levers: Levers, loads: Loads, p: Parameters) -> None:
        """N and T on the frame, or the constraint."""
        if self.contact == "rigid":
            loads.own(bound=self._bound(m, mode, p))
            loads.add(frame=-self.press_force * self._rows(0.0, 1.0, 0.0, p))
        elif self.contact == "compliant" or p.rotor.rows:
            loads.add(frame=self._force(m, mode, p, self.pressed(m, mode, p)))
            if isinstance(mode, Cutting):
                loads.own(bound=self._standing(m, mode, p))

    def _surface(self, m: Motion, p: Parameters) -> tuple[Any, Any, Any, Any]:
        """h, h' without the turning of the rotor, and ε (cos, sin)(turn + φ₀)."""
        place = m.turn + self.runout_angle
        x, y = self.runout * m.xp.cos(place), self.runout * m.xp.sin(place)
        row = p.geometry.plane(self.plane_offset)[1]
        return row.dot(m.support[: p.size]) + y, row.dot(m.support[p.size :]), x, y

    def pressed(self, m: Motion, mode: Any, p: Parameters) -> Any:
        """N [N] of a contact that is not rigid."""
        if self.contact == "face":
            return self.press_force
        touching = mode.touching if isinstance(mode, Cutting) else mode
        return touching * (self.press_force - self.contact_stiffness * self._surface(m, p)[0])

    def held(self, m: Motion, mode: Cutting, solved: Solved, p: Parameters) -> tuple[Any, Any]:
        """T with which the work holds a wheel that stands, and the most it can, f N [N]."""
        rigid = self.contact == "rigid"
        normal = solved.reaction if rigid else self.pressed(m, mode, p)
        return solved.beside if rigid else solved.reaction, self.cutting_coefficient * normal

    def _rows(self, x: Any, y: Any, turning: Any, p: Parameters) -> AnyArray:
        """A force (x, y) at the wheel and a torque on the rotor, as the frame feels them."""
        return p.rotor.on_frame(p.geometry.forces(x, y, self.plane_offset), turning)

    def _direction(self, m: Motion, mode: Any, p: Parameters) -> AnyArray:
        """Force on the frame per unit N."""
        drag = mode.slides * self.drag if isinstance(mode, Cutting) else self.drag
        if self.contact == "face":
            return self._rows(0.0, 0.0, drag * self.wheel_radius, p)
        _, _, x, y = self._surface(m, p)
        return self._rows(drag, 1.0, x - drag * y + drag * self.wheel_radius, p)

    def _force(self, m: Motion, mode: Any, p: Parameters, normal: Any) -> AnyArray:
        """Whole force of the contact on the frame."""
        force: AnyArray = normal * self._direction(m, mode, p)
        return force if self.contact == "face" else force - self.press_force * self._rows(0.0, 1.0, 0.0, p)

    def slip(self, m: Motion, p: Parameters) -> Slip:
        """Motion of the wheel's surface over the workpiece; on a face by the turning alone."""
        if self.contact == "face":
            return Slip(self.wheel_radius * m.speed, self._rows(0.0, 0.0, self.wheel_radius, p), 0.0, self.wheel_radius)
        _, _, x, y = self._surface(m, p)
        lever = self.wheel_radius - y
        moved = p.geometry.plane(self.plane_offset)[0].dot(m.support[p.size :])
        return Slip(moved + lever * m.speed, self._rows(1.0, 0.0, lever, p), x * m.speed * m.speed, lever)

    def _standing(self, m: Motion, mode: Cutting, p: Parameters) -> Constraint:
        """v' = −Ω v, so that errors die as in `_bound`; T is the reaction."""
        slip = self.slip(m, p)
        return Constraint(slip.row, slip.turned - p.speed * slip.speed, slip.row, mode.stands)

    def _bound(self, m: Motion, mode: Any, p: Parameters) -> Constraint:
        """h'' = −2 Ω h' − Ω² h.

        An integrator's errors of h'' = 0 would add up over time; so they die within a turn (Baumgarte 1972, Computer
        Methods in Applied Mechanics and Engineering 1), and without any nothing is added.
        """
        h, moved, x, y = self._surface(m, p)
        strayed = p.speed * (2 * (moved + x * m.speed) + p.speed * h)
        value = y * m.speed * m.speed - x * m.acceleration - strayed
        beside = self._standing(m, mode, p) if isinstance(mode, Cutting) else None
        return Constraint(self._rows(0.0, 1.0, x, p), value, self._direction(m, mode, p), beside=beside)

    def watch(self, m: Motion, mode: Any, own: Any, loads: Loads, solved: Solved, p: Parameters) -> list[Any]:
        """Depth of the wheel in the workpiece while touching, gap while apart, relative to the usual depth.

        Rigid: the margin of the balls' squared speeds to a runaway. If cutting may stop the rotor: also the
        margins with which it slides, or stands.
        """
        margins = self._goes_on(m, mode, solved, p) if isinstance(mode, Cutting) else []
        if self.contact == "face":
            return margins
        if self.contact == "rigid":
            return [1 - m.rate.dot(m.rate) / (RUNAWAY * p.speed * RUNAWAY * p.speed), *margins] if p.balls else margins
        unloaded = self.press_force / self.contact_stiffness
        touching = mode.touching if isinstance(mode, Cutting) else mode
        return [(2 * touching - 1) * (unloaded - self._surface(m, p)[0]) / self._depth, *margins]

    @property
    def _depth(self) -> float:
        """Usual depth of a compliant contact [m]."""
        return self.press_force / self.contact_stiffness + self.runout + LEAST_DEPTH

    def _goes_on(self, m: Motion, mode: Cutting, solved: Solved, p: Parameters) -> list[Any]:
        """Margins with which the wheel slides or stands.

        They use the speed over the workpiece relative to that of the surface, and forces relative to usual
        ones.
        """
        usual = self.contact_stiffness * self._depth if self.contact == "compliant" else self.press_force or 1.0
        unit, (held, most) = self.cutting_coefficient * usual, self.held(m, mode, solved, p)
        return goes_on(mode, self.slip(m, p).speed / (p.speed * self.wheel_radius), held / unit, most / unit)

    def rule(self, mode: Any) -> Rule | None:
        """Wheel and work part and meet where the contact is compliant and cannot stop the rotor."""
        return Rule("one-sided contact") if isinstance(mode, float) else None

    def settle(self, at: SwitchPoint) -> tuple[Any, Any]:
        """Touching where the wheel is in the work; at its very surface, where it is about to be. And how it slides.

        Raises NotTrustworthyError when a rigid contact drives the balls to ever higher speeds, or makes no sense.
        """
        if self.contact == "rigid":
            check_speeds(at)
        touching = self._touches(at) if self.contact == "compliant" else TOUCHING
        if not isinstance(at.mode, Cutting):
            return at.y, at.mode if at.mode in (None, touching) else touching
        y, mode = decided(at, replace(at.mode, touching=touching), self)
        return y, at.mode if mode == at.mode else mode

    def _touches(self, at: SwitchPoint) -> float:
        """Mode of the contact: touching if wheel and workpiece stay in contact, else apart."""
        m, _, solved = at.solved(replace(at.mode, touching=APART) if isinstance(at.mode, Cutting) else APART)
        p = at.parameters
        h, moved, x, y = self._surface(m, p)
        unloaded = self.press_force / self.contact_stiffness
        rows = self._rows(0.0, 1.0, x, p)
        depth, deeper = unloaded - h, -(moved + x * m.speed)
        ever = -(float(rows.dot(solved.frame)) + x * m.acceleration - y * m.speed * m.speed)
        return TOUCHING if inside(depth, deeper, ever, NEAR * (unloaded + self.runout + abs(h))) else APART

    def power(self, m: Motion, mode: Any, own: Any, solved: Solved, p: Parameters) -> Any:
        """Power of N − N₀, T and, if driven, the torque, by the motion of frame and rotor [W].

        Standing gives none. The work of the compliant spring is included. If the rotor's speed is given, the
        drive supplies the power that carries the runout past the workpiece, not the coordinates.
        """
        normal = solved.reaction if self.contact == "rigid" else self.pressed(m, mode, p)
        return self._force(m, mode, p, normal).dot(p.rotor.on_frame(p.geometry.rates(m, p), m.speed))

    def normal_forces(self, equations: Laws, samples: Samples) -> AnyArray:
        """N [N] at the samples of a run; 0 where wheel and work are apart, and negative where a rigid contact pulls.

        With dry friction all balls count as sticking, which makes a difference of less than a per cent.
        """
        p, acting = equations.parameters, equations.in_mode(equations.first_modes)

        def normal(t: Any, y: Any) -> Any:
            """Normal force [N] of the wheel while it touches."""
            m, _, solved = equations.accelerations(np, t, y, acting)
            return solved.reaction if self.contact == "rigid" else self.pressed(m, TOUCHING, p)

        force = at_samples(normal, samples.t, samples.y, at_once=p.traceable)
        return force if self.contact == "rigid" else np.maximum(force, 0.0)

    def remarks(self, equations: Laws, samples: Samples) -> tuple[str, ...]:
        """Remarks on a contact that pulls, is lost, or stops the rotor.

        They tell how long a rigid contact pulls, whether a compliant one is lost in the last twentieth of the
        run, and a stop.
        """
        scene, stops = equations.scene, self._turning(equations.scene, samples)
        if self.contact == "face":
            return stops
        if self.contact == "rigid":
            return (*pulls(samples.t, self.normal_forces(equations, samples)), *stops)
        late = samples.t >= 0.95 * scene.duration
        parts = late.any() and self.normal_forces(equations, Samples(samples.t[late], samples.y[:, late])).min() <= 0
        return (PARTING, *stops) if parts else stops

    def _turning(self, scene: Circumstances, samples: Samples) -> tuple[str, ...]:
        """Remark that cutting stops a rotor that a torque drives, or that friction as published drives it.

        The latter follows from the published sign of the friction.
        """
        if self._may_stop(scene):
            return stopped(scene, samples, self.cutting_coefficient * self.press_force * self.wheel_radius)
        return (DRIVEN,) if self.drag > 0 and self.wheel_radius and scene.rotor.rows else ()

    def weight(self, scene: Circumstances) -> EffectInfluence:
        """Change of the axis's motion without balls, as if wheel and work never parted: see `moved`."""
        self._row(scene)
        braking = BRAKES[self.wheel_radius > 0]
        if self.contact == "face":
            return (
                EffectInfluence(None, braking)
                if scene.rotor.rows
                else EffectInfluence(0.0, "presses along the spindle alone")
            )
        give = 1 / self.contact_stiffness if self.contact == "compliant" else 0.0
        surface = -1j * cmath.rect(self.runout, self.runout_angle)
        changed = moved(scene, self.plane_offset, self.drag, surface, give, self.press_force)
        why, least = f"holds the axis, and runout drives it; {braking}", weighing_amplitude(scene)
        # A wheel without imbalance or balls has no amplitude to weigh against.
        return EffectInfluence(changed / least if least else None, why)

    def placed(self, scene: Circumstances) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Start on the constraint of a rigid contact, h = h' = 0, by the shortest way."""
        row, start = self._row(scene), (scene.start_position, scene.start_velocity)
        if self.contact != "rigid":
            return start
        runout, speed = self.runout, scene.start_speed
        wanted = -runout * math.sin(self.runout_angle), -runout * math.cos(self.runout_angle) * speed
        position, velocity = (
            tuple((np.array(now) + row * (target - row @ now) / (row @ row)).tolist())
            for now, target in zip(start, wanted, strict=True)
        )
        return position, velocity


def moved(scene: Circumstances, plane_offset: float, drag: float, surface: complex, give: float, press: float) -> float:
    """Change of the axis's motion [m] by the contact, without balls, as if contact were never lost.

    N~ = −(y + E)/(give + h_wn), y of the wheel without contact, E = `surface`, h_wn its motion by the
    contact, `drag` T per N. Added is the remaining swing near the end about the place to which T moves it.
    """
    h = receptance(scene.support, scene.speed)
    wheel = np.vstack([np.eye(2), plane_offset * np.eye(2)])[: len(h)]
    pull = reference_imbalance(scene) * scene.speed**2 * np.exp(1j * scene.imbalance_angle)
    free = (wheel[:, 1] @ h)[:2] @ (pull * np.array((1, -1j)))
    pressed = wheel @ np.array((drag, 1.0))
    X, Y = -(free + surface) / (give + wheel[:, 1] @ h @ pressed) * (h[:2] @ pressed)
    swings = scene.small_motion.swinging(wheel @ (drag * press, 0.0), 0.95 * scene.duration)
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2 + swings


def pulls(t: AnyArray, normal: AnyArray) -> tuple[str, ...]:
    """Remark on the share of time in which a rigid contact would have to pull, and on the least force.

    The samples may be unevenly spaced.
    """
    if not len(t) or normal.min() >= 0:
        return ()
    spans = np.diff(t, prepend=t[0], append=t[-1])
    share = float(((spans[:-1] + spans[1:]) * (normal < 0)).sum() / spans.sum() / 2) if len(t) > 1 else 1.0
    return (
        f"wheel and work would part if they could: the rigid contact pulls for {100 * share:.2g} % of the time, its "
        f"least force {normal.min():.3g} N{_REMEDY}, or give it a stiffness",
    )


def stopped(scene: Circumstances, samples: Samples, most: float) -> tuple[str, ...]:
    """Remark that cutting has stopped the rotor before anything switched its motor off.

    Cutting takes up to `most` [N m].
    """
    if scene.run_down:
        return ()
    _, speeds = scene.rotor.turning(samples.t, samples.y, scene.speed)
    moves = np.flatnonzero(np.abs(speeds) > STOPPED * scene.speed)
    if not len(samples.t) or (len(moves) and moves[-1] == len(speeds) - 1):
        return ()
    since = samples.t[moves[-1] + 1] if len(moves) else samples.t[0]
    return (
        f"the rotor stands on the work from t = {since:.4g} s on: cutting takes up to {most:.3g} N·m; press less, or "
        "take a stronger motor",
    )
