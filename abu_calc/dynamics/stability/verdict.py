"""Stability of the balanced state: balls at rest in their races, opposite the imbalance, the axis still.

Sources: Green, Champneys & Lieven 2006 and Rodrigues, Champneys, Friswell & Wilson 2008, for two balls on an isotropic
support; Kovalenko 2010, (17)–(24), for a swing arm. Printed: Kladiev 1996, (7), asks only for a speed above the natural
frequency; that does not suffice.

Search for the worst arrangement of balls: the one whose small motions die out most slowly.

The search is needed on an anisotropic support or a swing arm. It covers the family of all arrangements that balance.
`worst` compares several; growth below a stated bound counts as none.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from functools import cached_property
from typing import Final, Literal, Protocol, Self, TypeVar

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.family import (
    Arrangement,
    Array,
    BallGroup,
    Family,
    largest,
    likeness,
    neighbours,
    rests,
)
from abu_calc.dynamics.stability.linearised import BalancedMotion, growth_of
from abu_calc.dynamics.stability.resting import NotKnownError, Rest, needed_gap, resting_state
from abu_calc.dynamics.stability.two_modes import LinearMotion, TwoModes, two_modes
from abu_calc.foundation.frozen import dataclass

MARGIN: Final = 1e-9
"""Growth per radian of rotation that is taken for none: below, rounding decides."""

UNDECIDED: Final = 10 * MARGIN
"""Growth per radian below which balls that stand almost on one line count as standing on it."""


class Linear(Protocol):
    """Interface of a linear motion: see `BalancedMotion` and `TwoModes`."""

    @property
    def on_one_line(self) -> Self:
        """Motion with balls that are almost on one line treated as if they were."""
        ...

    def growth(self, speed: float) -> float:
        """Growth rate of the slowest-dying disturbance [1/s]."""
        ...


Motion = TypeVar("Motion", bound=Linear)


def worst(motions: tuple[BalancedMotion, ...], speed: float) -> BalancedMotion:
    """The one that dies out most slowly; of those alike the first."""
    if len(motions) == 1:
        return decided(motions[0], speed)[0]
    best, most = motions[0], -math.inf
    for motion in motions:
        looked_at, growth = decided(motion, speed)
        if growth > most + MARGIN * speed:
            best, most = looked_at, growth
    return best


def decided(motion: Motion, speed: float) -> tuple[Motion, float]:
    """The motion itself, or where rounding would decide that of balls on one line; and its growth rate [1/s].

    Balls that stand all but on one line come back along it next to not at all, by the square of what they lack: less
    than rounding. As the support pushes them back exactly where it pushes back those on the line, these decide.
    """
    growth = motion.growth(speed)
    if abs(growth) > UNDECIDED * speed or motion.on_one_line is motion:
        return motion, growth
    return motion.on_one_line, motion.on_one_line.growth(speed)


GRID: Final = 11
"""Values of χ at which the growth rate is compared first."""

SECTIONS: Final = 7
"""Golden sections about the best of them."""

ALIKE: Final = 1e-6
"""Arrangements whose χ differ by less are one."""

SCREEN: Final = 5
"""Values of χ that are looked at where many speeds are."""

STEPS: Final = (0.4, 0.2, 0.1, 0.05)
"""Steps of a search that moves the balls themselves [rad]."""

TRIALS: Final = 80
"""Growth rates that such a search may take."""

ON_ARM, CLIMBS = 24, 3
"""Arrangements of one race on a swing arm that are compared first, and from how many of them balls are moved."""


@dataclass(frozen=True)
class Search:
    """A search of all arrangements, started from those listed; `half_angle` β [rad] of touching balls.

    Balls of one race whose support moves in its plane: their χ alone decides, since turning all balls together only
    shifts the time at which the support is felt. χ is searched by a grid and golden sections. Several races, or a
    support that tilts: the balls are moved one free direction at a time, from the worst of the list, with up to 80
    growth rates; a local maximum may remain then, and the share of each race stays that of the list. A swing arm turns
    the race with it, so for equal balls the complex Σ m e^{2iθ} decides: arrangements that differ most in it are
    compared first, and the balls are moved from the three worst of them.
    """

    listed: tuple[BalancedMotion, ...]
    half_angle: float = 0.0

    @cached_property
    def motions(self) -> tuple[LinearMotion, ...]:
        """The listed ones, by their two modes where these are all."""
        return tuple(two_modes(motion) or motion for motion in self.listed)

    @property
    def in_plane(self) -> bool:
        """True if χ alone decides."""
        return isinstance(self.motions[0], TwoModes)

    def worst(self, speed: float) -> BalancedMotion:
        """The motion about the arrangement with the largest growth rate that was found at a speed [rad/s]."""
        angles = self._by_likeness(speed) if self.in_plane else self._by_moving(speed)
        return replace(self.listed[0], angles=tuple((np.remainder(angles + np.pi, 2 * np.pi) - np.pi).tolist()))

    @property
    def trials(self) -> int:
        """About how many arrangements are compared."""
        moved = TRIALS * (CLIMBS if self._more else 1)
        return len(self.listed) + (GRID + SECTIONS + 1 if self.in_plane else len(self._more) + moved)

    def growth(self, speed: float) -> float:
        """The largest growth rate [1/s] that was found at a speed [rad/s]."""
        return decided(self._quick(self.worst(speed)), speed)[1]

    def added(self, motions: tuple[LinearMotion, ...], speeds: Iterable[float]) -> tuple[LinearMotion, ...]:
        """The motions, and one more for each of these speeds at which none of them grows although another does."""
        for speed in speeds:
            if _grow(motions, speed):
                continue
            motion = self._quick(self.worst(speed))
            if _grow((motion,), speed):
                motions = (*motions, motion)
        return motions

    def screened(self, motions: tuple[LinearMotion, ...], speeds: Iterable[float]) -> tuple[LinearMotion, ...]:
        """The same of some evenly spaced χ alone; none where χ does not decide alone."""
        if not self.in_plane:
            return motions
        others = [self._shape(float(chi)) for chi in np.linspace(self._family.chi[0], self._family.chi[-1], SCREEN)]
        for speed in speeds:
            if not _grow(motions, speed):
                motions = (*motions, *[motion for motion in others if _grow((motion,), speed)])
        return motions

    def _quick(self, motion: BalancedMotion) -> LinearMotion:
        return self._shape(likeness(self._masses, motion.angles)) if self.in_plane else motion

    @property
    def _masses(self) -> tuple[float, ...]:
        return self.listed[0].scene.ball_masses

    @cached_property
    def races(self) -> list[BallGroup]:
        """Masses, resultant and needed gap of the balls of each race, which a search keeps."""
        scene, angles = self.listed[0].scene, self.listed[0].angles
        return [
            (masses, complex(masses @ np.exp(1j * np.array(own))), needed_gap(scene, race, self.half_angle))
            for race, own in scene.by_race(angles)
            for masses in [np.array(race.ball_masses)]
        ]

    @cached_property
    def _family(self) -> Family:
        ((_, _, gap),) = self.races
        return Family.of(self._masses, self.listed[0].angles, gap)

    @cached_property
    def _shapes(self) -> dict[float, TwoModes]:
        return {}

    def _shape(self, chi: float) -> TwoModes:
        """The two modes of an arrangement of this χ."""
        if chi not in self._shapes:
            first = self.motions[0]
            assert isinstance(first, TwoModes)
            self._shapes[chi] = replace(first, likeness=chi)
        return self._shapes[chi]

    def _by_likeness(self, speed: float) -> Array:
        low, high = float(self._family.chi[0]), float(self._family.chi[-1])
        grid = np.linspace(low, high, GRID).tolist() if high - low > ALIKE else [low]
        return self._family.nearest(largest(lambda chi: decided(self._shape(chi), speed)[1], grid, SECTIONS))

    def _by_moving(self, speed: float) -> Array:
        """Every neighbour that is worse is taken; where none is, the step is halved."""
        scene = at_speed(self.listed[0].scene, speed)

        def growth(angles: Array) -> float:
            """Growth rate [1/s] of balls at these angles [rad]."""
            return decided(replace(self.listed[0], scene=scene, angles=tuple(angles.tolist())), speed)[1]

        listed = [np.array(motion.angles) for motion in self.listed]
        starts = sorted(((growth(motion), motion) for motion in (*listed, *self._more)), key=lambda pair: -pair[0])
        climbs = [self._climbed(growth, *start, MARGIN * speed) for start in starts[: CLIMBS if self._more else 1]]
        return max(climbs, key=lambda pair: pair[0])[1]

    def _climbed(self, growth: Callable[[Array], float], most: float, best: Array, least: float) -> tuple[float, Array]:
        """The largest growth rate to which neighbours lead, each larger by `least` [1/s], and its arrangement."""
        left = TRIALS
        for step in STEPS:
            better = True
            while better and left > 0:
                better = False
                for angles in neighbours(self.races, best, step):
                    rate, left = growth(angles), left - 1
                    if rate > most + least:
                        most, best, better = rate, angles, True
                        break
        return most, best

    @cached_property
    def _more(self) -> tuple[Array, ...]:
        """Further arrangements on a swing arm: one with χ = 0, the least and the largest χ, then the farthest in Σ m
        e^{2iθ}.

        Growth may have a sharp peak at χ = 0, so that neighbours do not lead there.
        """
        if not self.listed[0].on_arm or len(self.races) != 1 or len(self.listed[0].angles) <= 2:
            return ()
        rows, masses = self._family.rows, self.races[0][0]
        double = np.exp(2j * rows) @ masses
        picked, near = [0, len(rows) - 1], np.full(len(rows), np.inf)
        while len(picked) < ON_ARM:
            near = np.minimum(near, np.abs(double[:, None] - double[picked]).min(axis=1))
            if near.max() <= ALIKE * masses.sum():
                break
            picked.append(int(near.argmax()))
        even = next((moved for k in picked if (moved := self._family.moved(rows[k], 0.0)) is not None), None)
        return (*([] if even is None else [even]), *rows[picked])


def searched(listed: tuple[BalancedMotion, ...], half_angle: float) -> Search | None:
    """A search where it may find a worse arrangement than the list has.

    None on an isotropic support, where the list stands for all; where all arrangements are one; and where the axis
    moves.
    """
    if len(listed) < 2 or listed[0].motion:
        return None
    search = Search(listed, half_angle)
    return None if search.motions[0].isotropic else search


def _grow(motions: Iterable[LinearMotion], speed: float) -> bool:
    """True if any of the motions grows beyond what rounding decides."""
    return any(decided(motion, speed)[1] > UNDECIDED * speed for motion in motions)


def at_speed(scene: Scene, speed: float) -> Scene:
    """The scene at another speed [rad/s], without effects."""
    return replace(scene, speed=speed, duration=4 * math.pi / speed, effects=())


State = Literal["balanced", "race still", "arm alone"]


@dataclass(frozen=True)
class Stability:
    """One state at one speed; rates in 1/s, angles in rad.

    `state` judged: balanced; the races' centres still while the axis moves elsewhere ("race still"); or a swing arm
    without balls ("arm alone"). `angles` None: the balls cannot balance. `eigenvalues` on an isotropic support,
    `multipliers` of one revolution on any other. `stable` None where it is not known, `reason` says why. Directions in
    which balls move without changing what they carry (n − 2 of the n of a race) are neutral and do not count.
    `left_out`: effects of the scene that are no part of the linear motion; `arrangements`: how many were judged, of
    which the angles are those of the worst.
    """

    speed: float
    state: State | None
    angles: tuple[float, ...] | None
    eigenvalues: tuple[complex, ...] | None
    multipliers: tuple[complex, ...] | None
    growth_rate: float | None
    stable: bool | None
    reason: str | None
    left_out: tuple[str, ...]
    arrangements: int = 0


def stability(scene: Scene, half_angle: float = 0.0, arrangement: Arrangement = "worst") -> Stability:
    """Stability of the balanced state of a scene, at its speed, by the worst arrangement.

    Growth rate: the largest Re λ, or ln|μ|/T over a revolution T [1/s]; stable below −1e-9·Ω. `half_angle` [rad] of
    touching balls, 0 for balls without size; `arrangement`: see `arrangements.rests`; on an anisotropic support and on
    a swing arm the worst is searched, see `Search`. A swing arm whose balls are none, or cannot balance, is
    judged alone; with balls that cannot balance it is not called stable. Range: constant speed, small motions, no
    effects. Raises NotTrustworthyError when multipliers do not settle.
    """
    left_out = tuple(effect.name for effect in scene.effects)
    unknown = Stability(scene.speed, None, None, None, None, None, None, None, left_out)
    try:
        state, motions = judged(scene, half_angle, arrangement)
    except NotKnownError as error:
        return replace(unknown, reason=str(error))
    if not motions:
        return replace(unknown, stable=False)
    motion, search = worst(motions, scene.speed), searched(motions, half_angle)
    count = len(motions)
    if search:
        motion, count = worst((motion, search.worst(scene.speed)), scene.speed), search.trials
    eigenvalues = motion.eigenvalues(scene.speed)
    multipliers = motion.multipliers(scene.speed) if eigenvalues is None else None
    growth = growth_of(multipliers, scene.speed) if multipliers else motion.growth(scene.speed)
    carried = state != "arm alone" or not scene.ball_masses
    stable = carried and growth < -MARGIN * scene.speed
    angles = motion.angles if carried else None
    return Stability(scene.speed, state, angles, eigenvalues, multipliers, growth, stable, None, left_out, count)


def critical_damping(scene: Scene) -> float | None:
    """Damping of the support [N·s/m] that parametric resonance cannot overcome as long as nothing is balanced.

    None where there is none: see `SwingArmSupport.critical_damping`.
    """
    return scene.support.critical_damping(scene.imbalance, scene.balls)


def judged(
    scene: Scene, half_angle: float = 0.0, arrangement: Arrangement = "worst"
) -> tuple[State | None, tuple[BalancedMotion, ...]]:
    """State that is judged of a scene, and its motions at each arrangement, if there are any."""
    states = rests(scene, half_angle, arrangement) if scene.ball_masses else _without_balls(scene, half_angle)
    support = scene.support
    if states:
        state: State = "race still" if states[0].motion else "balanced"
        return state, tuple(BalancedMotion(scene, rest.angles, rest.motion) for rest in states)
    if not support.turns:
        return None, ()
    races = tuple(replace(race, ball_masses=(), start_angles=(), start_speeds=()) for race in scene.races)
    return "arm alone", (BalancedMotion(replace(scene, support=support.holding(scene.balls), races=races), ()),)


def _without_balls(scene: Scene, half_angle: float) -> tuple[Rest, ...]:
    """An arm without balls is judged alone, whether it has an imbalance or not."""
    rest = None if scene.support.turns else resting_state(scene, half_angle)
    return () if rest is None else (rest,)
