"""A scene: everything that one simulation needs, in SI, nothing optional."""

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Self

import numpy as np

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.rotor import Race, Rotation, most_demanding
from abu_calc.dynamics.support import Array, Circumstances, Complex, Holding, Support
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass

__all__ = ["Effect", "Race", "Scene", "Support", "only", "parted_angles", "placed", "with_parted_balls", "without"]

SMALLEST_GAP = 1e-6
"""Balls nearer to each other than this at the start [rad] are parted: from exactly one place they could never part."""


@dataclass(frozen=True)
class Scene(Circumstances):
    """One simulation: circumstances, and the effects that act in them, in the order of their registry."""

    effects: tuple[Effect, ...] = ()
    quiet_velocity: float | None = None
    """Rms velocity [m/s] of the axis, in a turn, up to which the machine is quiet; None: 1 dB above that of the end."""
    quiet_places: tuple[float, ...] = ()
    """Places [m] from the centre of mass on the axis of a spindle that tilts, whose loudest one counts; none: that."""

    @property
    def rotor(self) -> Rotation:
        """The one that asks for most: a torque before a given acceleration before none."""
        return most_demanding(effect.rotor for effect in self.effects)

    @property
    def start_speed(self) -> float:
        """Speed of the scene, unless an effect makes the rotor start from rest."""
        return 0.0 if any(effect.from_rest for effect in self.effects) else self.speed

    @property
    def full_speed(self) -> float:
        """Time from which settling counts [s]: the rotor is at full speed for good, after its run-up and any pause."""
        return max((effect.at_speed for effect in self.effects), default=0.0)

    @property
    def run_down(self) -> float:
        """The longest of any effect."""
        return max((effect.run_down for effect in self.effects), default=0.0)

    @property
    def ball_states(self) -> tuple[str, ...]:
        """Ball states of all effects."""
        return tuple(name for effect in self.effects for name in effect.ball_states)

    @property
    def state_count(self) -> int:
        """Number of states of the scene's equations."""
        balls = (2 + len(self.ball_states)) * len(self.ball_masses)
        return 2 * len(self.support.names) + balls + len(self.rotor.states)

    @property
    def balls_meet(self) -> bool:
        """True if any effect gives balls a size."""
        return any(effect.balls_meet for effect in self.effects)

    @property
    def holding(self) -> Holding | None:
        """Holding by the first effect that holds balls."""
        holdings = (effect.holding(self) for effect in self.effects)
        return next((holding for holding in holdings if holding is not None), None)

    def axis_place(self, states: Array, plane: float = 0.0) -> Array:
        """Place x, y of the axis [m] at a plane z [m] from the centre of mass, for states [state, time].

        On a swing arm: from the place where it lies along +x.
        """
        return self.support.axis(states[: len(self.support.names)], plane)

    def axis_velocity(self, states: Array) -> Array:
        """Velocity of the axis [m/s] in the plane of the centre of mass, for states [state, time]."""
        size = len(self.support.names)
        return self.support.axis_velocity(states[:size], states[size : 2 * size])

    def total_imbalance(self, angles: Array) -> Complex:
        """Imbalance of rotor and balls, m₀e e^{iφ} + Σ m R_p e^{iθ} [kg m], for ball angles [ball, time]."""
        total = np.full(angles.shape[1:], self.imbalance * np.exp(1j * self.imbalance_angle))
        for static_moment, angle in zip(self.static_moments, angles, strict=True):
            total += static_moment * np.exp(1j * angle)
        return total

    def started(self, angles: Sequence[float], speeds: Sequence[float] | None = None) -> Self:
        """The scene with all balls started at these angles [rad]; speeds against the race [rad/s], None: at rest."""
        rates = self.by_race([0.0] * len(angles) if speeds is None else [*map(float, speeds)])
        races = (
            replace(race, start_angles=tuple(own), start_speeds=tuple(next(rates)[1]))
            for race, own in self.by_race([*map(float, angles)])
        )
        return replace(self, races=tuple(races))

    def effect(self, name: str) -> Effect | None:
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


def placed(scene: Scene) -> Scene:
    """The scene started where its effects have to have it: a wheel in rigid contact on its work. Else unchanged."""
    for effect in scene.effects:
        position, velocity = effect.placed(scene)
        if (position, velocity) != (scene.start_position, scene.start_velocity):
            scene = replace(scene, start_position=position, start_velocity=velocity)
    return scene


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
