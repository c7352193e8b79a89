"""Differences between two runs of one scene, and the reason why no tolerance reached an accuracy.

Differences are measured as accuracy measures errors. Reasons: a motion that amplifies errors, or a settling time that
depends on them.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import IntegratorChoice
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import weighing_amplitude
from abu_calc.foundation.errors import ChaoticError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.simulation.quiet import TimeRange
from abu_calc.simulation.response import Course, Response, evaluate, sampling


class Measures(Protocol):
    """Compared quantities of a run: of a response, or of an estimate that integrates no equations."""

    @property
    def axis_amplitude(self) -> float:
        """0–peak [m]."""

    @property
    def velocity_rms(self) -> float:
        """RMS velocity in the larger of x and y [m/s]."""

    @property
    def settling_time(self) -> float | None:
        """Settling time, from full speed [s]; None if later than the run."""

    @property
    def quiet(self) -> TimeRange:
        """Quiet time, from full speed [s]."""

    @property
    def rest(self) -> TimeRange:
        """Rest time, from full speed [s]."""

    @property
    def ball_angles(self) -> tuple[float, ...]:
        """Ball angles at the end [rad]."""


def difference(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """The largest of the differences in amplitude, times and ball angles."""
    return max(measure(scene, coarse, fine) for measure in (amplitude, settling, quiet, rest, angles))


def amplitude(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer amplitude, but at least to 1 % of that without balls."""
    apart = abs(coarse.axis_amplitude - fine.axis_amplitude)
    # Nothing at all to drive the axis leaves nothing to compare with.
    return apart / max(fine.axis_amplitude, weighing_amplitude(scene)) if apart > 0 else 0.0


def level(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Difference of the rms velocities, likewise relative: 0.01 is 0.09 dB."""
    apart = abs(coarse.velocity_rms - fine.velocity_rms)
    least = weighing_amplitude(scene) * scene.speed / math.sqrt(2)
    return apart / max(fine.velocity_rms, least) if apart > 0 else 0.0


def settling(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer time, but at least to one revolution; infinite where only one of them has settled."""
    a, b = coarse.settling_time, fine.settling_time
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / max(b, scene.revolution)


def quiet(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Of the quiet times, likewise; 0 where each lies in the range of the other."""
    return coarse.quiet.apart(fine.quiet, scene.revolution)


def rest(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Of the rest times, likewise."""
    return coarse.rest.apart(fine.rest, scene.revolution)


def angles(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Largest difference on the circle [rad]; balls of one mass on one race may have changed places."""
    a, b, worst, first = np.array(coarse.ball_angles), np.array(fine.ball_angles), 0.0, 0
    for race in scene.races:
        masses = np.array(race.ball_masses)
        here = slice(first, first + len(masses))
        for mass in set(race.ball_masses):
            worst = max(worst, _circular_distance(a[here][masses == mass], b[here][masses == mass]))
        first += len(masses)
    return worst


QUANTITIES: Final[dict[str, Callable[[Scene, Measures, Measures], float]]] = {
    "amplitude": amplitude,
    "level": level,
    "settling": settling,
    "quiet": quiet,
    "rest": rest,
    "angles": angles,
}
"""Quantities for which the error of a computation can be requested."""


def _circular_distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Largest distance on the circle between two sets of angles, in the best pairing.

    On a circle the best pairing keeps the order round it, so only the rotations of one order have to be tried.

    >>> round(_circular_distance(np.array([0.1, 3.0]), np.array([3.0, 4 * math.pi - 0.1])), 9)
    0.2
    """
    a, b = np.sort(a % (2 * math.pi)), np.sort(b % (2 * math.pi))
    shifts = (np.angle(np.exp(1j * (a - np.roll(b, k)))) for k in range(len(b)))
    return min(float(np.abs(shift).max()) for shift in shifts)


MOVED: Final = 1e-9
"""Angle [rad] by which one ball of each race is moved at the start.

The ball moves into its widest gap, so that no balls overlap.
"""

SENSITIVE: Final = 1e5
"""Growth of an error beyond which a motion is called chaotic: what decides a run is less than anyone can measure."""

FELT: Final = 0.1
"""Share of the requested accuracy that the grown error must exceed for a motion to be called chaotic."""

COMPARED: Final = {
    "amplitude": "amplitude", "settling": "settling time", "quiet": "quiet time", "rest": "rest time",
    "angles": "ball angles",
}  # fmt: skip


@dataclass(frozen=True)
class FinestRuns:
    """The two finest runs of a scene, which do not agree."""

    coarse: Response
    fine: Response
    apart: float
    """Difference as accuracy measures errors; infinite if the balls made other turns."""
    choice: IntegratorChoice
    tolerance: float
    """Tolerance of the finer run."""


def unreached(
    scene: Scene, accuracy: float, runs: FinestRuns, most: int, otherwise: NotTrustworthyError | None = None
) -> NotTrustworthyError:
    """Error of an accuracy that is not reached; another run shows whether the motion is chaotic.

    `most`: work that this run may take. `otherwise`: what stopped the runs before rounding did.
    """
    worst, key = max((QUANTITIES[key](scene, runs.coarse, runs.fine), key) for key in COMPARED)
    by = "in whether they settle" if math.isinf(worst) else "in the turns of the balls"
    by = f"by {runs.apart:.2g}, most in the {COMPARED[key]}" if math.isfinite(runs.apart) else by
    first = f"{scene.name}: the accuracy {accuracy:.3g} is not reached, the two finest runs differ {by}"
    growth = _growth(scene, runs, most)
    # A run that more work would finish is chaotic only where what starts that small comes near the accuracy.
    if growth > SENSITIVE and (otherwise is None or growth * MOVED > FELT * accuracy):
        return ChaoticError(
            f"{first}. The motion is chaotic: {MOVED:g} rad at its start grow {growth:.0e} times\n"
            "  Shorten the run, start the balls at other places, or specify a greater drag rate."
        )
    if otherwise:
        return otherwise
    if math.isinf(worst):
        return NotTrustworthyError(
            f"{first}: the end of the run decides\n  Lengthen or shorten the run (--duration, Python: duration_s=)."
        )
    return NotTrustworthyError(
        f"{first}: rounding decides\n  Specify less accuracy, shorten the run, or start the balls at other places."
    )


def _growth(scene: Scene, runs: FinestRuns, most: int) -> float:
    """Growth of an error at the start, in amplitude and angles; 0 if that run cannot be finished."""
    moved = replace(scene, races=tuple(replace(race, start_angles=_moved(race.start_angles)) for race in scene.races))
    try:
        course, times, choice = Course(moved), sampling(moved), runs.choice
        work = choice.evaluations(most)
        trajectory = choice.integrate(assemble(moved), runs.tolerance, times.read_by(course), work)
        moved_response = evaluate(moved, trajectory, course)
        apart = [QUANTITIES[key](scene, moved_response, runs.fine) for key in ("amplitude", "angles")]
    except NotTrustworthyError:
        return 0.0
    return max(apart) / MOVED


def _moved(angles: tuple[float, ...]) -> tuple[float, ...]:
    """The angles [rad] with the ball moved that has most room ahead of it."""

    def room(ball: int) -> float:
        """Gap ahead of a ball [rad]."""
        turn = 2 * math.pi
        return min((turn - (angles[ball] - other) % turn for k, other in enumerate(angles) if k != ball), default=turn)

    first = max(range(len(angles)), key=room, default=None)
    return tuple(angle + MOVED * (k == first) for k, angle in enumerate(angles))
