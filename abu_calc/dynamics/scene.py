"""A scene: everything one simulation needs, in SI, nothing optional.

Axes x, y are inertial; angles of a scene (imbalance, balls) are measured in the rotor from its zero mark, which lies on
+x at t = 0, in the sense of rotation (from +x to +y).
"""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from abu_calc.dynamics.supports.kinds import LARGEST, Support, finite
from abu_calc.errors import InputError
from abu_calc.validity import Range

if TYPE_CHECKING:
    from abu_calc.dynamics.effects.effect import Effect

SMALLEST_GAP = 1e-6
"""Balls nearer to each other than this at the start [rad] are parted: from exactly one place they could never part."""

_NON_NEGATIVE = (0.0, LARGEST)


def _same_length(name: str, values: tuple[float, ...], count: int, of: str) -> None:
    if len(values) != count:
        raise InputError(f"{name}: one value for each {of}", found=str(len(values)), allowed=str(count))


@dataclass(frozen=True)
class Race:
    """A race and its balls.

    pitch_radius R_p [m] to the ball centres; ball_masses [kg], none or more; drag h0 [1/s], the torque on a ball being
    −m·R_p²·h0·(speed relative to the race); inertia_factor J = 1 (point), 7/5 (rolling ball), 3/2 (rolling roller);
    start_angles [rad] in the rotor; start_speeds [rad/s] relative to the race; plane_offset z [m] from the centre of
    mass; ball_radius r [m], 0 where nothing tells it. Raises RangeError, InputError.
    """

    pitch_radius: float
    ball_masses: tuple[float, ...]
    drag: float
    inertia_factor: float
    start_angles: tuple[float, ...]
    start_speeds: tuple[float, ...]
    plane_offset: float = 0.0
    ball_radius: float = 0.0

    def __post_init__(self) -> None:
        Range("pitch radius", 0, LARGEST, "m", open_low=True).check(self.pitch_radius)
        Range("rolling drag", *_NON_NEGATIVE, "1/s").check(self.drag)
        # Below 1 a ball would have less than its own mass, above 2 more than a rolling thin ring.
        Range("inertia factor", 1, 2).check(self.inertia_factor)
        Range("ball radius", 0, self.pitch_radius, "m").check(self.ball_radius)
        finite("plane offset", (self.plane_offset,))
        for mass in self.ball_masses:
            Range("ball mass", 0, LARGEST, "kg", open_low=True).check(mass)
        for name, values in (("start angles", self.start_angles), ("start speeds", self.start_speeds)):
            _same_length(name, values, len(self.ball_masses), "ball")
            finite(name, values)

    @property
    def static_moment(self) -> float:
        """Σ m·R_p [kg m]: the imbalance of all balls in one place."""
        return sum(self.ball_masses) * self.pitch_radius


@dataclass(frozen=True)
class Scene:
    """One simulation: speed Ω [rad/s], imbalance m₀e [kg m], its angle [rad], duration [s], start of the support.

    `couple`: χ(J_t − J_p) [kg m²] of a polar axis that leans by χ toward `couple_angle` [rad], on supports that tilt.
    `effects`: what acts beside the support, the races and the imbalance.
    """

    name: str
    support: Support
    speed: float
    imbalance: float
    imbalance_angle: float
    races: tuple[Race, ...]
    duration: float
    start_position: tuple[float, ...]
    start_velocity: tuple[float, ...]
    couple: float = 0.0
    couple_angle: float = 0.0
    effects: tuple["Effect", ...] = ()

    def __post_init__(self) -> None:
        Range("speed", 0, LARGEST, "rad/s", open_low=True).check(self.speed)
        Range("imbalance", *_NON_NEGATIVE, "kg m").check(self.imbalance)
        Range("duration", self.revolution, LARGEST, "s", remedy="results are means over at least one revolution").check(
            self.duration
        )
        finite("imbalance angle", (self.imbalance_angle,))
        finite("couple imbalance", (self.couple, self.couple_angle))
        if not self.support.tilts and (self.couple or any(race.plane_offset for race in self.races)):
            raise InputError("only a support that tilts knows a couple and places along the spindle")
        for name, values in (("start position", self.start_position), ("start velocity", self.start_velocity)):
            _same_length(name, values, len(self.support.names), "support coordinate")
            finite(name, values)

    @property
    def revolution(self) -> float:
        """Time of one revolution, 2π/Ω [s]."""
        return 2 * math.pi / self.speed

    @property
    def ball_masses(self) -> tuple[float, ...]:
        """Masses of all balls [kg], race by race."""
        return tuple(mass for race in self.races for mass in race.ball_masses)

    @property
    def ball_moments(self) -> tuple[float, ...]:
        """m R_p of all balls [kg m], race by race."""
        return tuple(mass * race.pitch_radius for race in self.races for mass in race.ball_masses)

    @property
    def static_moment(self) -> float:
        """Σ m R_p [kg m] of all balls."""
        return sum(self.ball_moments)

    @property
    def start_angles(self) -> tuple[float, ...]:
        """Start angles of all balls [rad], race by race."""
        return tuple(angle for race in self.races for angle in race.start_angles)

    def effect(self, name: str) -> "Effect | None":
        """The effect of this name, if the scene has it."""
        return next((effect for effect in self.effects if effect.name == name), None)


def only(scene: Scene, names: Collection[str]) -> Scene:
    """The scene with none but these of its effects. Raises InputError for one that it has no data for."""
    for name in names:
        if scene.effect(name) is None:
            present = ", ".join(effect.name for effect in scene.effects)
            raise InputError("the scene has no data for this effect", found=name, allowed=present or "none")
    return replace(scene, effects=tuple(effect for effect in scene.effects if effect.name in names))


def without(scene: Scene, names: Collection[str]) -> Scene:
    """The scene without these effects, whether it has them or not."""
    return only(scene, [effect.name for effect in scene.effects if effect.name not in names])


def parted_angles(angles: tuple[float, ...], least: float = SMALLEST_GAP) -> tuple[float, ...]:
    """The angles [rad] moved just enough that no two are nearer to each other on the circle, as far as there is room.

    >>> parted_angles((0.5, 0.5, 2.0))
    (0.5, 0.500001, 2.0)
    """
    if len(angles) < 2:
        return angles
    turn = 2 * math.pi
    order = sorted(range(len(angles)), key=lambda k: angles[k] % turn)
    places = [angles[k] % turn for k in order]
    gaps = [place - before for before, place in zip([places[-1] - turn, *places], places, strict=False)]
    # Sweeping from behind the widest gap, a moved ball can never run into the one that was placed first.
    first = gaps.index(max(gaps))
    result = list(angles)
    natural = placed = 0.0
    for k in (*range(first + 1, len(order)), *range(first)):
        natural += gaps[k]
        # The small allowance keeps balls that were parted before from being moved again.
        placed = natural if natural - placed >= least - 1e-6 * SMALLEST_GAP else placed + least
        if placed != natural:
            result[order[k]] = angles[order[k]] + (placed - natural)
    return tuple(result)


def with_parted_balls(scene: Scene) -> tuple[Scene, tuple[str, ...]]:
    """The scene with its balls parted where they start in one place, and the warnings that say so."""
    races = tuple(replace(race, start_angles=parted_angles(race.start_angles)) for race in scene.races)
    parted = replace(scene, races=races)
    if parted == scene:
        return scene, ()
    pairs = enumerate(zip(parted.start_angles, scene.start_angles, strict=True), 1)
    names = ", ".join(str(k) for k, (a, b) in pairs if a != b)
    gap = f"{SMALLEST_GAP:g} rad"
    warning = f"balls within {gap} of each other at the start were parted by {gap} (moved: {names})"
    return parted, (warning,)
