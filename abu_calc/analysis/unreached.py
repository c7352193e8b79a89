"""Why no tolerance reached an accuracy: a motion that amplifies errors, or a settling that hangs on them."""

import math
from dataclasses import replace
from typing import Final

from abu_calc.analysis.course import Course
from abu_calc.analysis.differences import QUANTITIES
from abu_calc.analysis.response import Response, evaluate, sampling
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import Choice
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import ChaoticError, NotTrustworthyError

MOVED: Final = 1e-9
"""Angle [rad] by which one ball of each race is moved at the start.

The ball moves into its widest gap, so that no balls overlap.
"""

SENSITIVE: Final = 1e5
"""Growth of an error beyond which a motion is called chaotic: what decides a run is less than anyone can measure."""

FELT: Final = 0.1
"""Share of the requested accuracy that the grown error must exceed for a motion to be called chaotic."""

COMPARED: Final = {"amplitude": "amplitude", "settling": "settling time", "angles": "ball angles"}


def unreached(
    scene: Scene,
    accuracy: float,
    apart: float,
    runs: tuple[Response, Response],
    choice: Choice,
    tolerance: float,
    most: int,
    otherwise: NotTrustworthyError | None = None,
) -> NotTrustworthyError:
    """The error that says so, from the two finest runs, so far apart; another run shows whether the motion is chaotic.

    `otherwise`: what stopped the runs before rounding did.
    """
    worst, key = max((QUANTITIES[key](scene, *runs), key) for key in COMPARED)
    by = "in whether they settle" if math.isinf(worst) else "in the turns of the balls"
    by = f"by {apart:.2g}, most in the {COMPARED[key]}" if math.isfinite(apart) else by
    first = f"{scene.name}: the accuracy {accuracy:.3g} is not reached, the two finest runs differ {by}"
    growth = _growth(scene, runs[1], choice, tolerance, most)
    # A run that more work would finish is chaotic only where what starts that small comes near the accuracy.
    if growth > SENSITIVE and (otherwise is None or growth * MOVED > FELT * accuracy):
        return ChaoticError(
            f"{first}: the motion is chaotic, {MOVED:g} rad at its start grow {growth:.0e} times\n"
            "  shorten the run, start the balls at other places, or give them more drag"
        )
    if otherwise:
        return otherwise
    if math.isinf(worst):
        return NotTrustworthyError(
            f"{first}: the end of the run decides\n  lengthen or shorten the run (--duration, Python: duration_s=)"
        )
    return NotTrustworthyError(
        f"{first}: rounding decides\n  ask for less accuracy, shorten the run, or start the balls at other places"
    )


def _growth(scene: Scene, response: Response, choice: Choice, tolerance: float, most: int) -> float:
    """Growth of an error at the start, in amplitude and angles; 0 if that run cannot be finished."""
    moved = replace(scene, races=tuple(replace(race, start_angles=_moved(race.start_angles)) for race in scene.races))
    try:
        course, times = Course(moved), sampling(moved)
        trajectory = choice.integrate(assemble(moved), tolerance, times.read_by(course), choice.evaluations(most))
        moved_response = evaluate(moved, trajectory, course)
        apart = [QUANTITIES[key](scene, moved_response, response) for key in ("amplitude", "angles")]
    except NotTrustworthyError:
        return 0.0
    return max(apart) / MOVED


def _moved(angles: tuple[float, ...]) -> tuple[float, ...]:
    """The angles [rad] with the ball moved that has most room ahead of it."""

    def room(ball: int) -> float:
        turn = 2 * math.pi
        return min((turn - (angles[ball] - other) % turn for k, other in enumerate(angles) if k != ball), default=turn)

    first = max(range(len(angles)), key=room, default=None)
    return tuple(angle + MOVED * (k == first) for k, angle in enumerate(angles))
