"""Statistics of long runs of a machine whose wheel bounces on its workpiece without repeating.

If errors grow without end, no run can be computed twice alike, nor does it happen twice on the shop
floor. The mean stays the same from run to run; the scatter of the runs shows how well it is known.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from abu_calc.analysis.idle import WORK
from abu_calc.analysis.ledger import chosen
from abu_calc.analysis.response import SAMPLES_PER_REVOLUTION, axis_velocity
from abu_calc.analysis.working import Seen, Working, read
from abu_calc.dynamics.effects.grinding_contact import GrindingContact
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Array, Sampling
from abu_calc.errors import NotTrustworthyError
from abu_calc.progress import Progress, silent
from abu_calc.units import level_from_velocity

COPIES: Final = 4
"""Starts, each with balls and axis a little further than the one before."""
FURTHER: Final = 1e-3, 1e-6
"""Balls [rad] and axis [m]: chaos makes another run of less."""
SECONDS: Final = 6.0
TURNS: Final = 30
"""Least length of a run, in seconds and in turns.

A rotor so slow that the turns take longer is followed for longer, as far as the allowed work permits.
"""
DROPPED: Final = 1 / 3
"""Share of a run that is dropped, since the balls find their places in it."""
TOLERANCES: Final = 2e-6, 2e-5
"""Tolerances, used in turn: results that depend on the tolerance show as scatter."""
LEAST: Final = 0.5
"""Scatter [dB] that four runs do not rule out by being alike."""
WIDEST: Final = 3.0
"""Scatter [dB] beyond which there is no level to be told."""


def bounces(scene: Scene) -> bool:
    """True if wheel and workpiece may bounce in the scene."""
    return any(isinstance(effect, GrindingContact) and effect.contact == "compliant" for effect in scene.effects)


def bouncing(scene: Scene, accuracy: float, progress: Progress = silent) -> Working:
    """Mean motion of a chaotic scene of grinding, by four runs of 6 s; velocities averaged in energy.

    `scatter`: twice the standard deviation of their levels, at least what the farthest is off, and 0.5 dB. Phasors are
    those of the first run; forces those of all. Raises NotTrustworthyError where runs are further apart than 3 dB, so
    that starts decide, or take more work than one scene may.
    """
    scene = chosen(scene, accuracy).scene
    runs = []
    for number, copy in enumerate(_copies(scene)):
        progress(f"{scene.name}: chaotic, run {number + 1} of {COPIES}")
        runs.append(_run(copy, TOLERANCES[number % len(TOLERANCES)]))
    velocity = math.sqrt(sum(run.velocity**2 for run in runs) / COPIES)
    levels = [level_from_velocity(run.velocity) for run in runs]
    farthest = max(abs(each - level_from_velocity(velocity)) for each in levels)
    scatter = max(2 * float(np.std(levels, ddof=1)), farthest, LEAST)
    if scatter > WIDEST:
        raise NotTrustworthyError(
            f"{scene.name}: chaotic, and its level hangs on the start: {min(levels):.1f} to {max(levels):.1f} dB in "
            f"{COPIES} runs"
        )
    warning = (
        f"wheel and work bounce without ever repeating (chaotic): levels are means of {COPIES} runs of {SECONDS:g} s"
    )
    force = np.concatenate([run.force for run in runs])
    return replace(runs[0], velocity=velocity, force=force, parts=bool(force.min() <= 0), scatter=scatter,
                   settled=False, warnings=(warning,))  # fmt: skip


def _copies(scene: Scene) -> Iterator[Scene]:
    """The same scene for whole turns, started a little further each."""
    whole = max(round(SECONDS / scene.revolution), TURNS) * scene.revolution
    ahead, aside = FURTHER
    for number in range(COPIES):
        races = tuple(
            replace(race, start_angles=tuple(angle + number * ahead for angle in race.start_angles))
            for race in scene.races
        )
        x, *rest = scene.start_position
        copy = replace(scene, duration=whole, races=races, start_position=(x + number * aside, *rest))
        yield with_parted_balls(copy)[0]


def _run(scene: Scene, tolerance: float) -> Working:
    equations, times = assemble(scene), _times(scene)
    choice = choose(equations, "auto", tolerance)
    trajectory = choice.integrate(equations, tolerance, Sampling(times), choice.evaluations(WORK))
    states = trajectory.at(times)
    count, balls = 2 * len(scene.support.names), len(scene.ball_masses)
    velocity = float(np.sqrt((axis_velocity(scene, states[:, :-1]) ** 2).mean(axis=1)).max())
    angles = tuple(states[count : count + balls, -1].tolist())
    return read(scene, times, states, Seen(velocity, angles, settled=False, error=math.nan, warnings=()))


def _times(scene: Scene) -> Array:
    """Whole turns up to the end."""
    turns = int((1 - DROPPED) * scene.duration / scene.revolution)
    step = scene.revolution / SAMPLES_PER_REVOLUTION
    return np.asarray(scene.duration - step * np.arange(turns * SAMPLES_PER_REVOLUTION, -1, -1), dtype=float)
