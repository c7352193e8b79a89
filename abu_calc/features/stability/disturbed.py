"""Simulation from an unstable arrangement of balls, slightly disturbed: do they drift to a stable one, or away?"""

import math
from dataclasses import replace
from typing import Annotated, Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.scene import Scene, only
from abu_calc.dynamics.stability.family import closed, parts
from abu_calc.dynamics.stability.linearised import BalancedMotion
from abu_calc.dynamics.stability.verdict import MARGIN, Search, Stability, decided, judged, searched
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.quantity import Quantity, Record, record

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


RUN: Final = f"Simulated without friction from the worst arrangement, disturbed by {DISTURBANCE:g} rad at most"
ENDS: Final[dict[Kind, str]] = {
    "drift": "the balls drift to a stable arrangement nearby and balance there",
    "growth": "the balls leave the balanced state",
    "undecided": "the run does not decide whether the balls drift to a stable arrangement or leave the balanced state",
}


@record
class ArrangementEnd(Record):
    """The end of a run that starts in the worst arrangement, a little disturbed."""

    kind: Annotated[str, Quantity("what the balls do", "", 4, "drift, growth or undecided")]
    simulated_time: Annotated[float, Quantity("simulated time", unit="s")]
    residual_ratio: Annotated[float | None, Quantity("residual imbalance at the end over that at the start")]
    resting_angles: Annotated[tuple[float, ...] | None, Quantity("balls rest at", "θ", 5, unit="deg")]
    growth_rate: Annotated[float | None, Quantity("growth rate there", "max Re λ", unit="per_s")]
    text: Annotated[str, Quantity("in words")]


def end_of_run(
    kind: Kind, duration: float, residual: float | None = None, angles: tuple[float, ...] | None = None,
    growth_rate: float | None = None,
) -> ArrangementEnd:  # fmt: skip
    """The end of a run of a `duration` [s]; `angles` [rad] of the arrangement that balls end in, if they drift."""
    text = f"{RUN}, for {duration:.3g} s: {ENDS[kind]}"
    if growth_rate is not None:
        text += f" (growth rate {growth_rate:.3g} 1/s)"
    if duration == 0:
        text = "No simulation tells what becomes of the balls in the worst arrangement: the work allowed did not do"
    return ArrangementEnd(
        kind=kind,
        simulated_time=duration,
        residual_ratio=residual,
        resting_angles=angles,
        growth_rate=growth_rate,
        text=f"{text}.",
    )


def consequence(scene: Scene, worst: Stability, half_angle: float = 0.0) -> ArrangementEnd | None:
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
        return end_of_run("undecided", 0.0)


def _disturbed(scene: Scene, angles: tuple[float, ...]) -> Scene:
    """The scene at rest in the arrangement, gaps between neighbours opened but for the widest one of each race."""
    # Not even, so that no symmetry of the arrangement is kept.
    parts = [
        own + DISTURBANCE * (_ranks(own) / max(1, len(own) - 1)) ** 1.5 for _, own in scene.by_race(np.array(angles))
    ]
    still = (0.0,) * len(scene.support.names)
    contact = [effect.name for effect in scene.effects if effect.name == "ball_contact"]
    moved = only(scene, contact).started(np.concatenate(parts).tolist())
    return replace(moved, start_position=still, start_velocity=still)


def _ranks(angles: Array) -> Array:
    """The places of balls in their order round the race, counted from behind the widest gap."""
    order = np.argsort(angles % math.tau)
    places = angles[order] % math.tau
    widest = int(np.argmax(np.diff(places, prepend=places[-1] - math.tau)))
    ranks = np.empty(len(angles))
    ranks[np.roll(order, -widest)] = np.arange(len(angles))
    return ranks


def _followed(scene: Scene, duration: float, search: Search) -> ArrangementEnd:
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
        return end_of_run("growth", duration, ratio)
    resting = closed(search.races, angles[:, -share:].mean(axis=1))
    if ratio < SETTLED and resting is not None:
        motion = BalancedMotion(search.listed[0].scene, tuple(math.remainder(a, math.tau) for a in resting))
        rate = decided(motion, scene.speed)[1]
        if rate < -MARGIN * scene.speed:
            return end_of_run("drift", duration, ratio, motion.angles, rate)
    return end_of_run("undecided", duration, ratio)


def _residual(search: Search, angles: Array) -> Array:
    """Σ over races of |Σ m e^{iθ} − what balances| [kg], over time."""
    every = zip(search.races, parts(search.races, angles), strict=True)
    left = (np.abs(masses @ np.exp(1j * own) - resultant) for (masses, resultant, _), own in every)
    return sum(left, np.zeros(angles.shape[1]))
