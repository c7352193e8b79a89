"""A rotor at the end of a swing arm; small angles are not assumed."""

import math
from collections.abc import Sequence
from dataclasses import field, replace
from typing import Any, ClassVar, Final, Self, final

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from abu_calc.dynamics.motion import AnyArray, Levers, Motion
from abu_calc.dynamics.rotor import LARGEST, NON_NEGATIVE, Balls, Frame, Geometry, Parameters, Race, finite
from abu_calc.dynamics.support import SmallMotion, Support, Unbalance
from abu_calc.formulas.swing_arm import Arm, contact_gain, damping_limit, resonance
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.foundation.validity import Range
from abu_calc.inputs.duty import GRIP, SwingArm
from abu_calc.inputs.reading.table import entry, problem

CONTACT_STIFFNESS = Range("contact stiffness", 0, LARGEST, "N/m")
FRICTION = Range("cutting coefficient", 0, 1.5)
CONTACT_ANGLE = Range("contact angle", 0, math.pi, "rad")
WHEEL_RADIUS = Range("wheel radius", 0, LARGEST, "m", open_low=True)
ARM_LENGTH = Range("arm length", 0, LARGEST, "m", open_low=True)
TOUCHING: Final = 1e-12
"""Rounding of an angle [rad]."""

Numbers = NDArray[np.float64]


class SceneSwingArm(SwingArm):
    """The rotor at the end of a swing arm (Kovalenko 2010): support = "swing-arm". The defaults are an example."""

    shown_in_template: ClassVar[frozenset[str]] = frozenset({"wheel_radius_mm"})

    wheel_radius_mm: float | None = entry(None, gt=0, le=1e4, example=115.0).means(
        "Radius of the wheel that cuts [mm]; {range}. With cutting = true."
    )
    cutting: bool = entry(False).means(
        "Whether the wheel is pressed to the work: true or false. Default: {default}, idle."
    )

    def unused(self) -> frozenset[str]:
        """Keys of the pressing to the workpiece, while the wheel is not pressed."""
        return frozenset() if self.cutting else frozenset({*GRIP, "wheel_radius_mm"})

    @model_validator(mode="after")
    def _cutting_needs_a_radius(self) -> Self:
        if self.cutting and self.wheel_radius_mm is None:
            raise problem("cutting = true needs wheel_radius_mm", "wheel_radius_mm", remedy="add wheel_radius_mm = …")
        return self


@final
@dataclass(frozen=True)
class ArmGeometry(Geometry):
    """A = φ''. Source: Kovalenko 2010, (1) and (2), whose ball angle ψ is counted from the arm."""

    length: Any

    def levers(self, m: Motion, p: Parameters) -> Levers:
        """T = l cos ψ + R_p, N = l sin ψ, ψ = γ − φ; the races are carried with φ'² l (sin ψ, −cos ψ)."""
        arm, rate = m.support[0], m.support[1]
        cos, sin = m.xp.cos(arm), m.xp.sin(arm)
        l_cos = self.length * (m.cos * cos + m.sin * sin)
        l_sin = self.length * (m.sin * cos - m.cos * sin)
        levers = Levers((l_cos + m.radii)[None, :], l_sin[None, :], None)
        levers.carry(rate * rate * l_sin, -(rate * rate) * l_cos)
        return p.rotor.carry(m, levers)

    def imbalance(self, m: Motion, p: Parameters) -> tuple[AnyArray, AnyArray | None]:
        """Moment about the arm's axis of an imbalance U at ψ₀: U l (speed² − φ'²) sin ψ₀, and its inertia 2 U l cos ψ₀.

        Source: Kovalenko 2010, (2), the term of index 0; its own inertia belongs to that of the arm.
        """
        arm, rate = m.support[0], m.support[1]
        psi = m.turn + p.imbalance_angle - arm
        along = p.imbalance * self.length * m.xp.cos(psi)
        aside = p.imbalance * self.length * m.xp.sin(psi)
        force, weight = np.array([aside * (m.speed * m.speed - rate * rate)]), np.array([[2 * along]])
        return p.rotor.unbalanced(m, force, weight, lambda: np.array([along]), lambda: -aside * rate * rate)

    def turning(self, support: AnyArray) -> tuple[Any, Any] | None:
        """φ and φ'."""
        return support[0], support[1]


@final
@dataclass(frozen=True)
class SwingArmSupport(Support):
    """A rigid arm of length l [m] that turns by φ about its axis, the rotor at its end (Kovalenko 2010, eqs. (1)–(3)).

    J_O φ'' + b l² φ' + c l² φ = torque + what rotor and balls do; J_O [kg m²] without balls, stiffness c [N/m] and
    damping b [N·s/m] of the joint reduced to l. Work that is cut adds its own to the stiffness and to the torque
    [N m]: `cutting_arm` says how. At φ = 0 the arm lies along +x; the axis is the rotor's.
    """

    length: float
    inertia: float
    stiffness: float
    damping: float
    torque: float = 0.0
    names: tuple[str, ...] = field(default=("arm_angle",), init=False)

    turns: ClassVar[bool] = True
    kind, about = "swing-arm", "[scene.swing_arm]"
    needs = ("swing_arm",)
    keys = {"swing_arm": SceneSwingArm}  # noqa: RUF012

    @classmethod
    def of(cls, scene: Any) -> "SwingArmSupport":
        """Arm of the file, idle or pressed to the work."""
        own: SceneSwingArm = scene.swing_arm
        arm = own.arm(own.wheel_radius or 0.0)  # which no arm that cuts takes
        return cutting_arm(arm) if own.cutting else idle_arm(arm)

    def started(self, scene: Any) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """At rest where it stands. Raises InputError if it does not, or if the disk does not touch the workpiece."""
        own: SceneSwingArm = scene.swing_arm
        try:
            (angle,) = self.resting_position()
        except InputError as error:
            raise error.at(Place(key="scene.swing_arm.contact_angle_deg")) from None
        if own.cutting and angle < own.touch_angle - TOUCHING:
            raise InputError(
                "the disk is not pressed to the work",
                place=Place(key="scene.swing_arm.pressing_moment_N_m"),
                found=f"the arm rests at {shown(angle, 'deg', '.4g')}",
                allowed=f"at least touch_angle_deg, {own.touch_angle_deg:g}°",
                remedy="a larger moment, or cutting = false",
            )
        return (angle,), (0.0,)

    def __post_init__(self) -> None:
        Range("arm length", 0, LARGEST, "m", open_low=True).check(self.length)
        Range("arm inertia", 0, LARGEST, "kg m²", open_low=True).check(self.inertia)
        Range("joint damping", *NON_NEGATIVE, "N s/m").check(self.damping)
        # The stiffness of work that pushes itself away is negative.
        finite("arm stiffness and moment", (self.stiffness, self.torque))

    def frame(self, balls: Balls) -> Frame:
        """J_O, −(c, b) l² and the constant torque: the arm's own turning is the frame."""
        square = self.length**2
        return Frame(
            mass=np.array([[self.inertia]]),
            held=np.array([[-self.stiffness * square, -self.damping * square]]),
            turning=(0,),
            steady_force=np.array([self.torque]) if self.torque else None,
        )

    def geometry(self, unbalance: Unbalance) -> Geometry:
        """Geometry on a circle."""
        return ArmGeometry(self.length)

    @property
    def felt_mass(self) -> float:
        """J_O/l²."""
        return self.inertia / self.length**2

    def shares(self, races: Sequence[Race]) -> list[float]:
        """l."""
        return [self.length]

    def small_motion(self, speed: float) -> SmallMotion:
        """The rotor moves along y only, by l φ.

        Balls add m l² here: their angles are counted in space, where the arm does not turn balls that are free to roll.
        """
        square = self.length**2
        return SmallMotion(
            np.array([[self.inertia]]),
            np.array([[self.damping * square]]),
            np.array([[self.stiffness * square]]),
            np.array([[0.0], [self.length]]),
        )

    def holding(self, balls: Balls) -> Self:
        """m (l² + R_p²) each, as J_O of Kovalenko 2010, (2), has it: balls that stand in the race turn with the arm.

        That is the mean, while the rotor turns, of what `ArmGeometry.levers` gives for balls at rest in their races.
        """
        added = float((balls.masses * (self.length**2 + balls.radii**2)).sum())
        return replace(self, inertia=self.inertia + added)

    def resonances(self, balls: Balls) -> list[float]:
        """Twice the natural frequency, and what that is divided by 2 and 3: parametric resonance."""
        arm = self.holding(balls)
        natural = arm.length * math.sqrt(max(arm.stiffness, 0.0) / arm.inertia)
        return [2 * natural / k for k in (1, 2, 3)]

    def resting_position(self, force: tuple[float, float] = (0.0, 0.0)) -> tuple[float, ...]:
        """φ [rad] at which the arm stands, (torque + l F_y)/(c l²); Kovalenko 2010, (5').

        Raises InputError where it does not stand: friction at a small contact angle pushes the work's side away
        (static divergence), or nothing holds it.

        >>> SwingArmSupport(2.0, 1.0, 5.0, 0.0, torque=4.0).resting_position()
        (0.2,)
        """
        torque = self.torque + self.length * force[1]
        if self.stiffness > 0:
            return (torque / (self.stiffness * self.length**2),)
        if self.stiffness == 0 and torque == 0:
            return (0.0,)
        raise InputError(
            "the arm does not stand: its stiffness with the contact is not positive",
            found=f"{self.stiffness:g} N/m",
            allowed="above 0",
            remedy="turn the contact angle nearer to 90°, or a stiffer joint",
        )

    def without_steady_force(self) -> Self:
        """Arm without its torque, which only moves the place where it stands."""
        return replace(self, torque=0.0)

    def critical_damping(self, imbalance: float, balls: Balls) -> float | None:
        """Joint damping [N·s/m] that parametric resonance cannot overcome as long as nothing is balanced.

        (m₀e/l)·ω₀·(1 + 17κ²/64 + …), see `formulas.swing_arm.damping_limit`; ω₀ = l√(c/J_O) with the inertia of balls
        that stand. None on an arm that does not stand, and beyond κ = 0.3. Source: Kovalenko 2010, (24).
        """
        if self.stiffness <= 0:
            return None
        arm = self.standing_arm(balls)
        try:
            return damping_limit(arm, imbalance, resonance(arm, 0.0))
        except InputError:
            return None

    def standing_arm(self, balls: Balls) -> Arm:
        """Arm with its whole stiffness, that of the workpiece included, as the pivot's."""
        arm = self.holding(balls)
        return Arm(arm.length, arm.inertia, arm.stiffness, arm.damping)

    def not_averaged(self, position: Sequence[float], velocity: Sequence[float]) -> str | None:
        """About any other place its motion is not the small one."""
        away = any((self.torque, *position, *velocity))
        return "the arm does not start at rest in its middle position" if away else None

    def plane(self, z: float) -> Numbers:
        """There is none."""
        raise InputError("a swing arm has a contact of its own", remedy="describe the cutting in the arm's own table")

    def axis(self, q: Numbers, plane: float = 0.0) -> Numbers:
        """Place of the axis, counted from where the arm lies along +x."""
        return self.length * np.array((np.cos(q[0]) - 1, np.sin(q[0])))

    def axis_velocity(self, q: Numbers, rates: Numbers) -> Numbers:
        """Across the arm."""
        return np.asarray(self.length * rates[0] * np.array((-np.sin(q[0]), np.cos(q[0]))))

    def turned(self, q: Numbers) -> Any:
        """φ."""
        return q[0]

    def lost(self, t: Numbers, q: Numbers) -> NotTrustworthyError | None:
        """No joint and no work goes on holding an arm by a spring that has turned it right round."""
        beyond = t[np.abs(q[0]) > math.pi]
        if not len(beyond):
            return None
        return NotTrustworthyError(
            f"the arm has turned right round at t = {beyond[0]:.6g} s: it does not stand, or resonates\n"
            "  a stiffer or more damped joint, a contact angle nearer to 90°, or a shorter run"
        )

    @property
    def description(self) -> str:
        """Description of the arm."""
        return "Rotor on a swing arm"

    def model(self) -> dict[str, Any]:
        """Numbers of the arm."""
        return {
            "arm_length_m": self.length,
            "moment_of_inertia_kg_m2": self.inertia,
            "stiffness_N_per_m": self.stiffness,
            "damping_N_s_per_m": self.damping,
            "moment_N_m": self.torque,
        }


def idle_arm(arm: Arm) -> SwingArmSupport:
    """J_O φ'' + h_sh l² φ' + c_sh l² φ = what rotor and balls do; the arm rests at φ = 0.

    J_O [kg m²] is that of the arm without balls. Source: Kovalenko 2010, (2). Raises RangeError.

    >>> idle_arm(Arm(0.35, 0.62, 2000.0, 40.0)).torque
    0.0
    """
    return SwingArmSupport(arm.length, arm.inertia, arm.joint_stiffness, arm.joint_damping)


def cutting_arm(arm: Arm) -> SwingArmSupport:
    """The arm while the disk cuts, pressed to the work by N = c_n l (φ − φ₀) sin Z, dragged by T = f N.

        c^(p) = c_sh + c_n g(Z),    torque = M_p + c_n l² g(Z) φ₀,    g(Z) = sin Z (sin Z + f (R/l − cos Z))

    Contact stiffness c_n [N/m], cutting coefficient f of a disk that turns in the sense of +φ, the pressing one, Z
    [rad] between the arm and the contact radius, φ₀ [rad] where the disk touches, M_p [N m], wheel radius R [m]. One
    contact point that never parts. φ is the arm's own angle: it rests at its `resting_position`. Raises RangeError.
    Source: Kovalenko 2010, (3). Printed: the text measures Z to the tangent; (3) holds for the normal.

    >>> arm = cutting_arm(Arm(0.35, 0.62, 2000.0, 40.0, 1e6, 0.0, 0.115, math.pi / 2, 0.02, 20.0))
    >>> arm.stiffness, round(arm.torque, 9)
    (1002000.0, 2470.0)
    """
    CONTACT_STIFFNESS.check(arm.contact_stiffness)
    ratio = WHEEL_RADIUS.check(arm.disk_radius) / ARM_LENGTH.check(arm.length)
    gain = contact_gain(CONTACT_ANGLE.check(arm.contact_angle), FRICTION.check(arm.friction), ratio)
    felt = arm.contact_stiffness * gain
    return SwingArmSupport(
        length=arm.length,
        inertia=arm.inertia,
        stiffness=arm.joint_stiffness + felt,
        damping=arm.joint_damping,
        torque=arm.pressing_moment + felt * arm.length**2 * arm.touch_angle,
    )
