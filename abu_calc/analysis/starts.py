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
    choices = [] if ensemble.worst is None else [("worst", ensemble.worst)]
    settled = sorted((start for start in ensemble.rated if math.isfinite(start.time)), key=lambda start: start.time)
    if settled:
        choices.append(("typical", settled[len(settled) // 2]))
    given = [start for start in ensemble.given if start.member.speed is None]
    kinds = dict.fromkeys(start.member.name for start in given)
    choices += [("", max((start for start in given if start.member.name == kind), key=_slow)) for kind in kinds]
    first: dict[int, tuple[str, Outcome]] = {}
    for why, outcome in choices:
        first.setdefault(id(outcome), (why, outcome))
    return tuple(first.values())[:MOST]


def _slow(outcome: Outcome) -> tuple[bool, bool, float]:
    return outcome.hanging, not outcome.balanced, outcome.time


def starts_again(design: Design, ensemble: Ensemble, accuracy: float) -> Iterator[Again]:
    """Repeat the chosen start cases, as far as the allowed work permits, each by the run of its outcome."""
    left, first = MOST_WORK if installed() else MOST_PLAIN, first_tolerance(design)
    for why, outcome in chosen_starts(ensemble):
        if outcome.work > left:
            continue
        for tolerance in (TIGHTER * first, first) if outcome.confirmed else (first,):
            try:
                repeat, scene, trajectory = run_of_start(design, outcome.member, accuracy, tolerance)
            except NotTrustworthyError:
                left -= WORK
                continue
            left -= repeat.work
            if (repeat.hanging, repeat.balanced) == (outcome.hanging, outcome.balanced):
                yield Again(why, outcome, scene, trajectory)
                break


def levels_of(design: Design, scene: Scene) -> Callable[[float], float]:
    """Function from an rms velocity of the axis [m/s] to the level [dB] at the loudest place.

    The level is that which an ensemble reports.
    """

    case = replace(design.case, speed=scene.speed)

    def level(velocity: float) -> float:
        return level_at_loudest(case, design.autobalancer, math.sqrt(2) * velocity / scene.speed)

    return level
