"""Starts of an ensemble run once more, to be looked at: the worst, a typical one, each kind."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Final

from abu_calc.analysis.ensemble import TIGHTER, WORK, first_tolerance, run_of_start
from abu_calc.analysis.outcomes import Ensemble, Outcome
from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import NotTrustworthyError
from abu_calc.frozen import dataclass
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import level_at_loudest

MOST: Final = 12
MOST_WORK, MOST_PLAIN = 400_000, 60_000
"""Evaluations of all starts together, in SciPy's, in compiled code and without: a second or two."""


@dataclass(frozen=True)
class Again:
    """A start's run, what it came to, and why it is shown: "worst", "typical" or nothing."""

    why: str
    outcome: Outcome
    scene: Scene
    trajectory: Trajectory


def chosen_starts(ensemble: Ensemble) -> tuple[tuple[str, Outcome], ...]:
    """The worst of all; at the rated speed that of the median time among those that balance, then the slowest of each
    kind at the drag given.
    """
    found = [] if ensemble.worst is None else [("worst", ensemble.worst)]
    settled = sorted((one for one in ensemble.rated if math.isfinite(one.time)), key=lambda one: one.time)
    if settled:
        found.append(("typical", settled[len(settled) // 2]))
    given = [one for one in ensemble.given if one.member.speed is None]
    kinds = dict.fromkeys(one.member.name for one in given)
    found += [("", max((one for one in given if one.member.name == kind), key=_slow)) for kind in kinds]
    first: dict[int, tuple[str, Outcome]] = {}
    for why, one in found:
        first.setdefault(id(one), (why, one))
    return tuple(first.values())[:MOST]


def _slow(one: Outcome) -> tuple[bool, bool, float]:
    return one.hanging, not one.balanced, one.time


def starts_again(design: Design, ensemble: Ensemble, accuracy: float) -> Iterator[Again]:
    """Those chosen, as far as the work allowed goes, each by the run that its outcome is from."""
    left, first = MOST_WORK if installed() else MOST_PLAIN, first_tolerance(design)
    for why, one in chosen_starts(ensemble):
        if one.work > left:
            continue
        for tolerance in (TIGHTER * first, first) if one.confirmed else (first,):
            try:
                found, scene, trajectory = run_of_start(design, one.member, accuracy, tolerance)
            except NotTrustworthyError:
                left -= WORK
                continue
            left -= found.work
            if (found.hanging, found.balanced) == (one.hanging, one.balanced):
                yield Again(why, one, scene, trajectory)
                break


def levels_of(design: Design, scene: Scene) -> Callable[[float], float]:
    """Of a velocity of the axis, rms [m/s], the level [dB] at the loudest place, as an ensemble tells it."""

    case = replace(design.case, speed=scene.speed)

    def level(velocity: float) -> float:
        return level_at_loudest(case, design.autobalancer, math.sqrt(2) * velocity / scene.speed)

    return level
