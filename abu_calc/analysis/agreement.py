"""Agreement of closed form and simulation for the same machine on its workpiece."""

import cmath
from dataclasses import replace
from typing import Final

from abu_calc.analysis.grinding import Work
from abu_calc.analysis.under_load import Balls, Steady, contact_presses
from abu_calc.analysis.working import Working, only_contact, working
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent
from abu_calc.scenes.durations import free_rates
from abu_calc.scenes.from_design import scene_of_design
from abu_calc.sizing.design import Design

AGREES: Final = 0.02
"""Permitted relative difference between closed form and simulation of the same contact.

The averages leave out that balls swing twice per turn, and the run may not have settled completely.
"""

LONG, LONGEST = 7.0, 6.0
"""Decay times of the slowest balls that a run to be compared lasts, and the most seconds."""

STAYS: Final = 3.0
"""Seconds at least for balls to stay where they were put: near a resonance axis and balls decay slower than either."""


@dataclass(frozen=True)
class Agreement:
    """Relative differences of the simulated contact from the closed form: axis, force, resulting imbalance.

    `apart`: the largest; `failure`: why there is none. `reached`: whether balls get there from where they stand at
    idle; if not, they were started where the closed form has them.
    """

    axis: float | None = None
    reaction: float | None = None
    imbalance: float | None = None
    failure: str | None = None
    reached: bool = True

    @property
    def apart(self) -> float | None:
        """The largest."""
        return max((each for each in (self.axis, self.reaction, self.imbalance) if each is not None), default=None)


def agreement(work: Work, accuracy: float, progress: Progress = silent) -> Agreement | None:
    """Closed form against the simulation of the same contact, ideal race and balls, from where the balls stand at idle.

    Balls that do not get to their places from there, or not within what is simulated, are started at them: they must
    stay. None where wheel and work part or balls do not balance: the closed form does not speak of these. A face leaves
    balls where they stand.
    """
    steady = work.fitted.steady
    if (
        not contact_presses(work.design.case)
        or work.fitted.parts
        or steady.balls is None
        or steady.balls.places != "balanced"
        or steady.axis is None
    ):
        return None
    scene = only_contact(scene_of_design(work.design, "grinding", "settled"))
    sway, _ = free_rates(scene.support, scene.races[0], scene.speed)
    slowest = min(loaded_rate(work.design, each) for each in (steady.balls.stiffness, steady.balls.worst))
    if min(slowest, sway) * LONGEST >= LONG:
        comparison = _compared(work, _lasting(scene, min(slowest, sway)), accuracy, progress)
        if comparison.apart is not None and comparison.apart <= AGREES:
            return comparison
    there = _compared(work, _lasting(_placed(scene, steady.balls), min(sway, LONG / STAYS)), accuracy, progress)
    return replace(there, reached=False)


def _lasting(scene: Scene, rate: float) -> Scene:
    """Until what dies out at a rate [1/s] is gone, within bounds."""
    longer = min(LONG / rate if rate > 0 else LONGEST, LONGEST)
    return replace(scene, name="grinding, contact alone", duration=max(scene.duration, longer))


def _placed(scene: Scene, balls: Balls) -> Scene:
    """Started where the closed form has its balls."""
    return replace(scene, races=tuple(replace(race, start_angles=balls.angles) for race in scene.races))


def _compared(work: Work, scene: Scene, accuracy: float, progress: Progress) -> Agreement:
    try:
        run = working(scene, accuracy, progress)
    except NotTrustworthyError as error:
        return Agreement(failure=str(error).splitlines()[0])
    return compared(work.fitted.steady, run, work.design.autobalancer.static_moment)


def loaded_rate(design: Design, stiffness: tuple[complex, complex]) -> float:
    """Slowest decay rate of the balls under load [1/s]; below zero where they flutter or go away."""
    drag, inertia = design.case.drag, design.case.inertia_factor
    return min((drag - abs(cmath.sqrt(drag**2 - 4 * inertia * k).real)) / (2 * inertia) for k in stiffness)


def compared(steady: Steady, run: Working, moment: float) -> Agreement:
    """Differences relative to the larger of what is compared and what the imbalance that the balls carry would cause.

    `moment` Σ m·R_p [kg m].
    """
    axis, total = steady.axis or (0j, 0j), steady.imbalance or 0j
    carried = max(abs(total - steady.own), 0.01 * moment)
    force = carried * steady.contact.speed**2
    off = max(abs(simulated - calculated) for simulated, calculated in zip(run.axis, axis, strict=True))
    usual = max(*map(abs, axis), force / min(map(abs, steady.contact.dynamic_stiffness)))
    reaction = steady.reaction or 0j
    pressed = abs(run.reaction - reaction) / max(abs(reaction), force) if len(run.force) else None
    return Agreement(off / usual, pressed, abs(run.imbalance - total) / carried)
