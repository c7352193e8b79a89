"""A simulation whose accuracy is known: the same scene at two tolerances, tightened until they agree."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from abu_calc.analysis.differences import difference
from abu_calc.analysis.response import Response, evaluate, needed_moments
from abu_calc.dynamics.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError, NotTrustworthyError
from abu_calc.validity import Range

ACCURACY = Range("accuracy", 1e-8, 0.5, key="--accuracy")

SAFETY = 3.0
"""On the difference of two runs: where the longest step rules, errors fall by less than the tenth of the tolerance, and
the finer run may be further off than the two are apart."""

LAST_TOLERANCE = 1e-12
"""Below, rounding decides."""


@dataclass(frozen=True)
class Cost:
    """Work of all runs of a simulation together; `tolerance`: of the run reported, `why`: the integrator's choice."""

    integrator: str
    tolerance: float
    evaluations: int
    steps: int
    events: int
    wall_s: float
    why: str


@dataclass(frozen=True)
class Simulation:
    """A response, the trajectory it was read from, what it cost, and thrice what a tenfold looser run differed by."""

    scene: Scene
    response: Response
    trajectory: Trajectory
    cost: Cost
    error_estimate: float
    warnings: tuple[str, ...]


def simulate(
    scene: Scene,
    accuracy: float = 0.01,
    sample_times: Sequence[float] = (),
    most_evaluations: int = 50_000_000,
    integrator: str = "auto",
) -> Simulation:
    """The finer of two runs, a decade of tolerance apart, whose results differ by no more than a third of `accuracy`.

    `sample_times` [s] are further moments to hold in the trajectory; `most_evaluations` bounds the work of all runs;
    `integrator` is auto, scipy or heyoka. Raises NotTrustworthyError when the work does not suffice, or when no
    tolerance reaches the accuracy: the motion is then chaotic, or decided by less than rounding.
    """
    ACCURACY.check(accuracy)
    scene, warnings = with_parted_balls(scene)
    wanted = np.asarray(sample_times, dtype=float)
    if not np.all((wanted >= 0) & (wanted <= scene.duration)):
        raise InputError("sample times must lie within the run", allowed=f"0 … {scene.duration:g} s")
    equations, moments = assemble(scene), np.union1d(needed_moments(scene), wanted)
    choice = choose(equations, integrator, tolerances(accuracy)[0])
    started = time.perf_counter()
    evaluations, steps, error = 0, 0, math.inf
    before: Response | None = None
    for tolerance in tolerances(accuracy):
        trajectory = choice.integrate(equations, tolerance, moments, most_evaluations - evaluations)
        response = evaluate(scene, trajectory)
        evaluations, steps = evaluations + trajectory.evaluations, steps + trajectory.steps
        error = SAFETY * _apart(scene, before, response) if before else math.inf
        if error <= accuracy:
            spent = time.perf_counter() - started
            cost = Cost(trajectory.integrator, tolerance, evaluations, steps, trajectory.events, spent, choice.why)
            return Simulation(scene, response, trajectory, cost, error, (*warnings, *_told(scene, trajectory)))
        before = response
    raise NotTrustworthyError(
        f"{scene.name}: the accuracy {accuracy:g} is not reached, the two finest runs differ by {error / SAFETY:.2g}\n"
        "  ask for less accuracy, shorten the run, or start the balls at other places"
    )


def _apart(scene: Scene, before: Response, response: Response) -> float:
    """Their difference; infinite where the balls made other turns: such runs went other ways, and end alike by chance.

    Where balls slip behind the rotor, errors far below the accuracy may decide which of several ends they come to, and
    loose tolerances may agree on the wrong one.
    """
    turns = zip(*(np.sort(run.ball_angles) for run in (before, response)), strict=True)
    return math.inf if any(abs(a - b) > math.pi for a, b in turns) else difference(scene, before, response)


def _told(scene: Scene, trajectory: Trajectory) -> tuple[str, ...]:
    """What the effects have to say of a run."""
    return tuple(text for effect in scene.effects for text in effect.remarks(scene, trajectory))


def tolerances(accuracy: float) -> tuple[float, ...]:
    """Tolerances to try, a decade apart: from the loosest that usually is good enough to the last above rounding.

    >>> tolerances(0.01)[:3]
    (0.0002, 2e-05, 2e-06)
    """
    first = min(2e-4, accuracy / 50)
    return tuple(float(f"{first / 10**k:.3g}") for k in range(math.floor(math.log10(first / LAST_TOLERANCE)) + 1))
