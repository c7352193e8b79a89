"""A scene: everything one simulation needs, in SI, nothing optional.

Axes x, y are inertial; angles of a scene (imbalance, balls) are measured in the rotor from its zero mark, which lies on
+x at t = 0, in the sense of rotation (from +x to +y).
"""

import math
import sys
from dataclasses import dataclass, replace

from abu_calc.errors import InputError
from abu_calc.validity import Range

Matrix = tuple[tuple[float, ...], ...]

SMALLEST_GAP = 1e-6
"""Balls nearer to each other than this at the start [rad] are parted: from exactly one place they could never part."""

_LARGEST = sys.float_info.max
_NON_NEGATIVE = (0.0, _LARGEST)


def _finite(name: str, values: tuple[float, ...]) -> None:
    for value in values:
        Range(name, -_LARGEST, _LARGEST, remedy="give a finite number").check(value)


def _same_length(name: str, values: tuple[float, ...], count: int, of: str) -> None:
    if len(values) != count:
        raise InputError(f"{name}: one value for each {of}", found=str(len(values)), allowed=str(count))


@dataclass(frozen=True)
class LinearSupport:
    """M q'' + C q' + K q = Pᵀ F in N coordinates q, and the race centre r = P q (2 × N), on which the force F acts.

    The mass M is what moves with the rotor WITHOUT balls; it must be symmetric and positive definite, which
    `equations.assemble` verifies. Units: coordinates in m (then kg, N·s/m, N/m) unless their name says otherwise.
    """

    mass: Matrix
    damping: Matrix
    stiffness: Matrix
    race_map: Matrix
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        size = len(self.names)
        for name, matrix, rows in (
            ("support mass", self.mass, size),
            ("support damping", self.damping, size),
            ("support stiffness", self.stiffness, size),
            ("race map", self.race_map, 2),
        ):
            if len(matrix) != rows or any(len(row) != size for row in matrix):
                raise InputError(f"{name}: must be {rows} × {size}")
            for row in matrix:
                _finite(name, row)


@dataclass(frozen=True)
class Race:
    """A race and its balls.

    pitch_radius R_p [m] to the ball centres; ball_masses [kg], none or more; drag h0 [1/s], the torque on a ball being
    −m·R_p²·h0·(speed relative to the race); inertia_factor J = 1 (point), 7/5 (rolling ball), 3/2 (rolling roller);
    start_angles [rad] in the rotor; start_speeds [rad/s] relative to the race. Raises RangeError, InputError.
    """

    pitch_radius: float
    ball_masses: tuple[float, ...]
    drag: float
    inertia_factor: float
    start_angles: tuple[float, ...]
    start_speeds: tuple[float, ...]

    def __post_init__(self) -> None:
        Range("pitch radius", 0, _LARGEST, "m", open_low=True).check(self.pitch_radius)
        Range("rolling drag", *_NON_NEGATIVE, "1/s").check(self.drag)
        # Below 1 a ball would have less than its own mass, above 2 more than a rolling thin ring.
        Range("inertia factor", 1, 2).check(self.inertia_factor)
        for mass in self.ball_masses:
            Range("ball mass", 0, _LARGEST, "kg", open_low=True).check(mass)
        for name, values in (("start angles", self.start_angles), ("start speeds", self.start_speeds)):
            _same_length(name, values, len(self.ball_masses), "ball")
            _finite(name, values)

    @property
    def static_moment(self) -> float:
        """Σ m·R_p [kg m]: the imbalance of all balls in one place."""
        return sum(self.ball_masses) * self.pitch_radius


@dataclass(frozen=True)
class Scene:
    """One simulation: speed Ω [rad/s], imbalance m₀e [kg m], its angle [rad], duration [s], start of the support."""

    name: str
    support: LinearSupport
    speed: float
    imbalance: float
    imbalance_angle: float
    race: Race
    duration: float
    start_position: tuple[float, ...]
    start_velocity: tuple[float, ...]

    def __post_init__(self) -> None:
        Range("speed", 0, _LARGEST, "rad/s", open_low=True).check(self.speed)
        Range("imbalance", *_NON_NEGATIVE, "kg m").check(self.imbalance)
        Range(
            "duration", self.revolution, _LARGEST, "s", remedy="results are means over at least one revolution"
        ).check(self.duration)
        _finite("imbalance angle", (self.imbalance_angle,))
        for name, values in (("start position", self.start_position), ("start velocity", self.start_velocity)):
            _same_length(name, values, len(self.support.names), "support coordinate")
            _finite(name, values)

    @property
    def revolution(self) -> float:
        """Time of one revolution, 2π/Ω [s]."""
        return 2 * math.pi / self.speed


def parted_angles(angles: tuple[float, ...]) -> tuple[float, ...]:
    """The angles [rad] moved just enough that no two are within 1e-6 rad of each other on the circle.

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
        placed = natural if natural - placed >= SMALLEST_GAP * (1 - 1e-6) else placed + SMALLEST_GAP
        if placed != natural:
            result[order[k]] = angles[order[k]] + (placed - natural)
    return tuple(result)


def with_parted_balls(scene: Scene) -> tuple[Scene, tuple[str, ...]]:
    """The scene with its balls parted where they start in one place, and the warnings that say so."""
    parted = parted_angles(scene.race.start_angles)
    if parted == scene.race.start_angles:
        return scene, ()
    names = ", ".join(str(k) for k, (a, b) in enumerate(zip(parted, scene.race.start_angles, strict=True), 1) if a != b)
    gap = f"{SMALLEST_GAP:g} rad"
    warning = f"balls within {gap} of each other at the start were parted by {gap} (moved: {names})"
    return replace(scene, race=replace(scene.race, start_angles=parted)), (warning,)
