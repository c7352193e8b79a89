"""Simulation from an unstable arrangement of balls, slightly disturbed: do they drift to a stable one, or away?"""

import math
from dataclasses import replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.scene import Scene, only
from abu_calc.dynamics.stability.family import closed
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.search import MARGIN, Search, decided, searched
from abu_calc.dynamics.stability.verdict import Stability, judged
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

Array = NDArray[np.float64]
Kind = Literal["drift", "growth", "undecided"]

DISTURBANCE: Final = 0.02
"""The largest displacement of a ball at the start [rad]."""

TIMES: Final = 15.0
"""Length of the run, in times 1/growth rate: a disturbance could grow e¹⁵-fold."""

TOLERANCE: Final = 1e-6
WORK, WORK_PLAIN = 400_000, 30_000
"""Work that the run may take, with compiled code and without: about a second."""

SAMPLES: Final = 2000
LAST: Final = 0.05
"""Share of the run whose largest residual imbalance is compared with that of its first such share."""

SETTLED, LEFT = 0.1, 10.0
"""Ratios of these two: below the first the balls have settled, above the second they have left."""


@dataclass(frozen=True)
class Consequence:
    """The end of a run of `duration` [s]: balls in a stable arrangement ("drift"), away from balance ("growth"), or
    neither within the work allowed ("undecided").

    `angles` [rad] of the arrangement they end in and its `growth_rate` [1/s], None unless they drift. `residual`: the
    largest residual imbalance at the end over that at the start, None without a run.
    """

    kind: Kind
    duration: float
    residual: float | None = None
    angles: tuple[float, ...] | None = None
    growth_rate: float | None = None


def consequence(scene: Scene, worst: Stability, half_angle: float = 0.0) -> Consequence | None:
    """Simulate the scene from its worst arrangement, disturbed by 0.02 rad at most; None unless others are stable.

    At constant speed, without effects other than contact of balls, as the linear motion has it. `worst`: the stability
    of the scene, `half_angle` [rad] of touching balls. Range: anisotropic supports, as in `searched`. One run with one
    disturbance: another may end elsewhere.
    """
    if worst.stable is not False or worst.state != "balanced" or not worst.angles or not worst.growth_rate:
        return None
    search = searched(judged(scene, half_angle)[1], half_angle)
    if search is None or all(decided(motion, scene.speed)[1] >= -MARGIN * scene.speed for motion in search.motions):
        return None
    disturbed, duration = _disturbed(scene, worst.angles), TIMES / worst.growth_rate
    try:
        return _followed(disturbed, duration, search)
    except NotTrustworthyError:
        return Consequence("undecided", 0.0)


def _disturbed(scene: Scene, angles: tuple[float, ...]) -> Scene:
    """The scene at rest in the arrangement, gaps between neighbours opened but for the widest one of each race."""
    races, first = [], 0
    for race in scene.races:
        count = len(race.ball_masses)
        own = np.array(angles[first : first + count])
        rank = _ranks(own)
        # Not even, so that no symmetry of the arrangement is kept.
        moved = own + DISTURBANCE * (rank / max(1, count - 1)) ** 1.5
        races.append(replace(race, start_angles=tuple(moved.tolist()), start_speeds=(0.0,) * count))
        first += count
    still = (0.0,) * len(scene.support.names)
    contact = [effect.name for effect in scene.effects if effect.name == "ball_contact"]
    return replace(only(scene, contact), races=tuple(races), start_position=still, start_velocity=still)


def _ranks(angles: Array) -> Array:
    """The places of balls in their order round the race, counted from behind the widest gap."""
    order = np.argsort(angles % math.tau)
    places = angles[order] % math.tau
    widest = int(np.argmax(np.diff(places, prepend=places[-1] - math.tau)))
    ranks = np.empty(len(angles))
    ranks[np.roll(order, -widest)] = np.arange(len(angles))
    return ranks


def _followed(scene: Scene, duration: float, search: Search) -> Consequence:
    """The run, as long as the work allowed reaches."""
    scene = replace(scene, duration=duration)
    equations = assemble(scene)
    choice, work = choose(equations, "auto", TOLERANCE), WORK if installed() else WORK_PLAIN
    expected = choice.expected(equations, TOLERANCE)
    if expected > work:
        duration *= work / expected
        scene = replace(scene, duration=duration)
        equations = assemble(scene)
    run = choice.integrate(equations, TOLERANCE, np.linspace(0, duration, SAMPLES), choice.evaluations(2 * work))
    size, count = len(scene.support.names), len(scene.ball_masses)
    angles = run.y[2 * size : 2 * size + count]
    left = _residual(search, angles)
    share = math.ceil(LAST * SAMPLES)
    ratio = float(left[-share:].max() / left[:share].max())
    if ratio > LEFT:
        return Consequence("growth", duration, ratio)
    resting = closed(search.races, angles[:, -share:].mean(axis=1))
    if ratio < SETTLED and resting is not None:
        motion = BalancedMotion(search.listed[0].scene, tuple(math.remainder(a, math.tau) for a in resting))
        rate = decided(motion, scene.speed)[1]
        if rate < -MARGIN * scene.speed:
            return Consequence("drift", duration, ratio, motion.angles, rate)
    return Consequence("undecided", duration, ratio)


def _residual(search: Search, angles: Array) -> Array:
    """Σ over races of |Σ m e^{iθ} − what balances| [kg], over time."""
    total, first = np.zeros(angles.shape[1]), 0
    for masses, resultant, _ in search.races:
        own = angles[first : first + len(masses)]
        total += np.abs(masses @ np.exp(1j * own) - resultant)
        first += len(masses)
    return total
