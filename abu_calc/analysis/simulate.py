"""A simulation whose accuracy is known: the same scene at two tolerances, tightened until they agree."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.response import Response, evaluate, needed_moments, reference_moment
from abu_calc.dynamics.equations import assemble
from abu_calc.dynamics.integrators import scipy_
from abu_calc.dynamics.receptance import unbalanced_amplitude
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.errors import InputError, NotTrustworthyError
from abu_calc.validity import Range

ACCURACY = Range("accuracy", 1e-6, 0.5, key="--accuracy")

LAST_TOLERANCE = 1e-12
"""Below, rounding decides."""


@dataclass(frozen=True)
class Cost:
    """Work of all runs of a simulation together; `tolerance` is that of the run reported."""

    integrator: str
    tolerance: float
    evaluations: int
    steps: int
    wall_s: float


@dataclass(frozen=True)
class Simulation:
    """A response, the trajectory it was read from, what it cost, and by how much a tenfold looser run differed."""

    response: Response
    trajectory: Trajectory
    cost: Cost
    error_estimate: float
    warnings: tuple[str, ...]


def simulate(
    scene: Scene, accuracy: float = 0.01, sample_times: Sequence[float] = (), most_evaluations: int = 50_000_000
) -> Simulation:
    """The finer of two runs, a decade of tolerance apart, whose results differ by no more than `accuracy`.

    `sample_times` [s] are further moments to hold in the trajectory; `most_evaluations` bounds the work of all runs.
    Raises NotTrustworthyError when the work does not suffice, or when no tolerance reaches the accuracy: the motion is
    then chaotic, or decided by less than rounding.
    """
    ACCURACY.check(accuracy)
    scipy_.load()
    started = time.perf_counter()
    scene, warnings = with_parted_balls(scene)
    equations = assemble(scene)
    wanted = np.asarray(sample_times, dtype=float)
    if not np.all((wanted >= 0) & (wanted <= scene.duration)):
        raise InputError("sample times must lie within the run", allowed=f"0 … {scene.duration:g} s")
    moments = np.union1d(needed_moments(scene), wanted)
    evaluations, steps, error = 0, 0, math.inf
    before: Response | None = None
    for tolerance in tolerances(accuracy):
        trajectory = scipy_.integrate(equations, tolerance, moments, most_evaluations - evaluations)
        response = evaluate(scene, trajectory)
        evaluations, steps = evaluations + trajectory.evaluations, steps + trajectory.steps
        error = difference(scene, before, response) if before else math.inf
        if error <= accuracy:
            cost = Cost(trajectory.integrator, tolerance, evaluations, steps, time.perf_counter() - started)
            return Simulation(response, trajectory, cost, error, warnings)
        before = response
    raise NotTrustworthyError(
        f"{scene.name}: the accuracy {accuracy:g} is not reached, the two finest runs differ by {error:.2g}\n"
        "  ask for less accuracy, shorten the run, or start the balls at other places"
    )


def tolerances(accuracy: float) -> tuple[float, ...]:
    """Tolerances to try, a decade apart: from the loosest that usually is good enough to the last above rounding.

    >>> tolerances(0.01)[:3]
    (0.0002, 2e-05, 2e-06)
    """
    first = min(2e-4, accuracy / 50)
    return tuple(float(f"{first / 10**k:.3g}") for k in range(math.floor(math.log10(first / LAST_TOLERANCE)) + 1))


def difference(scene: Scene, coarse: Response, fine: Response) -> float:
    """The largest difference of two runs in axis amplitude (relative), settling time (relative) and ball angles (rad).

    Amplitudes are taken relative to the finer one, but at least to 1 % of the amplitude without balls; settling times
    likewise, but at least to one revolution. Settled in one run and not in the other is infinitely different.
    """
    floor = 0.01 * unbalanced_amplitude(scene, reference_moment(scene))
    amplitude = abs(coarse.axis_amplitude - fine.axis_amplitude)
    # Nothing at all to drive the axis leaves nothing to compare with.
    relative = amplitude / max(fine.axis_amplitude, floor) if amplitude > 0 else 0.0
    return max(relative, _settling_difference(scene, coarse, fine), _angle_difference(scene, coarse, fine))


def _settling_difference(scene: Scene, coarse: Response, fine: Response) -> float:
    a, b = coarse.settling_time, fine.settling_time
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / max(b, scene.revolution)


def _angle_difference(scene: Scene, coarse: Response, fine: Response) -> float:
    """Largest difference of ball angles on the circle; balls of one mass may have changed places."""
    masses = np.array(scene.race.ball_masses)
    a, b = np.array(coarse.final.ball_angles), np.array(fine.final.ball_angles)
    return max((_circular_distance(a[masses == m], b[masses == m]) for m in set(scene.race.ball_masses)), default=0.0)


def _circular_distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Largest distance on the circle between two sets of angles, in the best pairing.

    On a circle the best pairing keeps the order round it, so only the rotations of one order have to be tried.

    >>> round(_circular_distance(np.array([0.1, 3.0]), np.array([3.0, 4 * math.pi - 0.1])), 9)
    0.2
    """
    a, b = np.sort(a % (2 * math.pi)), np.sort(b % (2 * math.pi))
    shifts = (np.angle(np.exp(1j * (a - np.roll(b, k)))) for k in range(len(b)))
    return min(float(np.abs(shift).max()) for shift in shifts)
