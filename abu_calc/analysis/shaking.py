"""Residual displacement by dry friction at work, with and without shaking of the balls, by simulation.

The model has only the balls, their friction and the shaking. An axial runout of a face wheel moves the
machine along its spindle, so that balls roll across their race. A runout in the plane moves the race
along the balls' path. Source of the question: Kladiev 1996.
"""

from dataclasses import replace
from typing import Final, Literal

import numpy as np

from abu_calc.analysis.course import total_imbalance
from abu_calc.analysis.grinding import Work
from abu_calc.analysis.under_load import contact_presses, fitted
from abu_calc.analysis.working import only_contact
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
from abu_calc.dynamics.effects.transverse_motion import TransverseMotion
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import quickest_loop
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Sampling
from abu_calc.errors import NotTrustworthyError
from abu_calc.formulas.shaking import shaking_threshold
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent
from abu_calc.scenes.from_design import scene_of_design
from abu_calc.sizing.design import Design
from abu_calc.units import to_si

TRIED: Final = 3.0
"""Times the threshold: the axial runout that is tried of a wheel that has none."""
SECONDS: Final = 1.0, 6.0
"""Seconds of a run that is shaken across the race, and of one shaken along it, in which balls creep."""
TOLERANCE: Final = 2e-4
MOST: Final = 750_000
"""Evaluations, of the loop that is compiled where it can be. Balls that shake less than they are held by start and stop
each turn, which takes the most.
"""
TURNS: Final = 5
"""Turns at the end over which the residual is averaged."""


@dataclass(frozen=True)
class Shaken:
    """Residual [m] of the balls' balance, unshaken and shaken by an amplitude [m], after `seconds`.

    `way`: across the race by an axial runout, which is `given` or only tried, or along it by runout in the
    plane. A residual is None if its run takes too long.
    """

    way: Literal["across", "along"]
    amplitude: float
    given: bool
    seconds: float
    unshaken: float | None
    shaken: float | None


def shaken(work: Work, progress: Progress = silent) -> Shaken | None:
    """Residuals of two runs from the same start, unshaken and shaken.

    None without friction, without a groove, or if no shaking applies. Balls of a face start together on the
    heavy side. Balls with a contact in the plane start where they balance at idle, if they balance and
    wheel and workpiece do not lose contact.
    """
    design = work.design
    if design.case.friction_arm == 0:
        return None
    progress("what shakes friction out")
    return _along(work) if contact_presses(design.case) else _across(design)


def _across(design: Design) -> Shaken | None:
    case, autobalancer, groove = design.case, design.autobalancer, design.track.groove_radius
    if groove is None or case.contact is None:
        return None
    radius, given = autobalancer.ball_diameter / 2, to_si(case.table.wheel.axial_runout_mm, "mm")
    amplitude = given or TRIED * shaking_threshold(case.friction_arm, autobalancer.pitch_radius, radius)
    full = scene_of_design(design, "grinding")
    scene = replace(full, effects=(DryRollingFriction(case.friction_arm, radius),))
    moved = replace(scene, effects=(TransverseMotion(groove, radius, amplitude), *scene.effects))
    left = [_left(design, each, 0j, SECONDS[0]) for each in (scene, moved)]
    return Shaken("across", amplitude, given > 0, SECONDS[0], *left)


def _along(work: Work) -> Shaken | None:
    design, steady = work.design, work.fitted.steady
    if steady.balls is None or steady.balls.places != "balanced" or work.fitted.parts or not design.case.runout:
        return None
    axis, case = steady.axis or (0j, 0j), design.case
    friction = DryRollingFriction(case.friction_arm, design.autobalancer.ball_diameter / 2)
    left = []
    for runout in (0.0, case.runout):
        variant = replace(design, case=replace(case, runout=runout))
        scene = only_contact(scene_of_design(variant, "grinding", "bunched"))
        ends = steady.imbalance if runout else fitted(variant, 0j).imbalance
        left.append(_left(variant, replace(scene, effects=(*scene.effects, friction)), ends or 0j, SECONDS[1]))
    return Shaken("along", abs(axis[0] - 1j * axis[1]) / 2, True, SECONDS[1], *left)


def _left(design: Design, scene: Scene, ends: complex, seconds: float) -> float | None:
    """Displacement [m] by what the balls leave beside the imbalance that they would end at."""
    turns = round(seconds / scene.revolution)
    scene = replace(scene, duration=turns * scene.revolution)
    equations = assemble(scene)
    # Friction that holds makes it look stiff; balls that start and stop each turn keep the steps short anyway.
    choice = quickest_loop(equations, TOLERANCE)
    last = np.asarray(scene.duration - scene.revolution / 16 * np.arange(16 * TURNS, -1, -1), dtype=np.float64)
    try:
        run = choice.integrate(equations, TOLERANCE, Sampling(last), MOST)
    except NotTrustworthyError:
        return None
    first = 2 * len(scene.support.names)
    total = total_imbalance(scene, run.at(last)[first : first + len(scene.ball_masses)])
    return abs(complex(total[:-1].mean()) - ends) / design.case.body.effective_mass(design.autobalancer.mass)
