"""A machine at its work, with and without its autobalancer: levels, remedies that were tried, and how far closed form
and simulation agree.
"""

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final, Literal

from abu_calc.analysis.under_load import Steady, bare, changed, contact_presses, crossing, fitted, runout_of
from abu_calc.analysis.working import Working, only_contact, working
from abu_calc.dynamics.scene import Scene
from abu_calc.errors import NotTrustworthyError
from abu_calc.progress import Progress, silent
from abu_calc.scenes.durations import free_rates
from abu_calc.scenes.from_design import grinding_without, scene_of_design
from abu_calc.sizing import size
from abu_calc.sizing.budget import accuracy_budget
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import Levels, handle_levels
from abu_calc.units import from_si

AGREES: Final = 0.02
"""How far closed form and simulation of the same contact may be apart, relative: the averages leave out that balls
swing twice per turn, and the run may not have settled to the last."""

EXCEEDED: Final = math.sqrt(2)
"""How many times the closed form a run may show, until it is believed instead: 3 dB."""

LONG, LONGEST = 7.0, 6.0
"""Decay times of the slowest balls that a run to be compared lasts, and the most seconds."""

What = Literal["runout", "stiffness", "press"]

LESS: Final = 1.0, 0.75, 0.5
"""Of what would just do, tried one after another."""

SOFTEST: Final = 1e-3
"""Share of the contact's stiffness down to which a softer one is tried."""


@dataclass(frozen=True)
class Side:
    """The machine with or without its autobalancer: steady motion, whether wheel and work part, and the run.

    `run` None where it was not asked for, or where none gave an answer: then `failure` says why.
    """

    steady: Steady
    run: Working | None = None
    failure: str | None = None
    press: float = math.inf

    @property
    def parts(self) -> bool:
        """Whether wheel and work would have to pull in the steady motion, or part in the run."""
        return self.pulls or (self.run is not None and self.run.parts)

    @property
    def pulls(self) -> bool:
        """Whether the variable force of the steady motion is above the press [N]."""
        return abs(self.steady.reaction or 0.0) > self.press


@dataclass(frozen=True)
class Work:
    """A machine at its work: without autobalancer, and with it pressed when the balls have settled at idle, or at once.

    `levels` [dB] at the loudest handle, `hasty`: with the autobalancer when pressed at once. A level is None where no
    way to compute it holds. `rest`: displacement that race and friction leave anyway [m].
    """

    design: Design
    without: Side
    fitted: Side
    at_once: Side
    levels: Levels
    hasty: float | None
    rest: float

    @property
    def lowered(self) -> bool | None:
        """Whether the autobalancer lowers the level when balls have settled; None where that is not known."""
        return _below(self.levels.after, self.levels.before)

    @property
    def always(self) -> bool | None:
        """Whether it does so when pressed at once, too."""
        both = self.lowered, _below(self.hasty, self.levels.before)
        return None if None in both else all(both)


def _below(after: float | None, before: float | None) -> bool | None:
    return None if before is None or after is None else after < before


@dataclass(frozen=True)
class Remedy:
    """What was tried and lowers the level: runout [m], contact stiffness [N/m] or press force [N], and what it gave."""

    what: What
    value: float
    levels: Levels


def at_work(design: Design, accuracy: float, progress: Progress = silent) -> Work:
    """Steady motions and runs; without autobalancer a run where wheel and work part only."""
    runout, case, one = runout_of(design.case), design.case, design.autobalancer
    press = case.contact.press_force if case.contact else math.inf
    budget = accuracy_budget(case, design.imbalance.value, one.requirement, one.balls, one.budget.resting_angles,
                             case.speed)  # fmt: skip
    rest = budget.residual - budget.shortfall
    without, free = Side(bare(design, runout), press=press), Side(fitted(design, runout), press=press)
    if without.parts:
        without = _run(without, grinding_without(design), accuracy, progress)
    hard = scene_of_design(design, "grinding")
    usual, at_once = _run(free, _calm(design, hard), accuracy, progress), free
    if contact_presses(case):
        at_once = _run(free, hard, accuracy, progress)
    before, after, hasty = (_displacement(design, side, left) for side, left in
                            ((without, 0.0), (usual, rest), (at_once, rest)))  # fmt: skip
    levels = handle_levels(case, before, after, one.mass).worst
    return Work(design, without, usual, at_once, levels, handle_levels(case, before, hasty, one.mass).worst.after, rest)


def _calm(design: Design, scene: Scene) -> Scene:
    """The same scene with balls that have settled at idle."""
    return replace(scene, races=tuple(replace(race, start_angles=_settled(design)) for race in scene.races))


def _settled(design: Design) -> tuple[float, ...]:
    """Where the balls stand at idle when they have settled [rad], as well as they can."""
    idle = replace(design, case=replace(design.case, contact=None))
    balls = fitted(idle, 0j).balls
    found = balls.angles if balls else ()
    return found or tuple(design.autobalancer.budget.resting_angles)


def _run(side: Side, scene: Scene, accuracy: float, progress: Progress) -> Side:
    try:
        return replace(side, run=working(scene, accuracy, progress))
    except NotTrustworthyError as error:
        return replace(side, failure=str(error).splitlines()[0])


def _displacement(design: Design, side: Side, rest: float) -> float | None:
    """0–peak [m] that makes the level; by the run where the steady motion does not hold, or is far exceeded by it."""
    contact, steady = design.case.contact, side.steady
    rigid = contact is not None and contact.kind == "rigid"
    holds = steady.amplitude is not None and (steady.balls is None or steady.balls.places != "restless")
    seen = None if side.run is None else math.sqrt(2) * side.run.velocity / design.case.speed
    if steady.amplitude is not None and holds and not (side.parts and (not rigid or side.pulls)):
        told = math.hypot(steady.amplitude, rest)
        return told if seen is None or seen <= EXCEEDED * told else seen
    return None if rigid and side.parts else seen


def remedies(work: Work, accuracy: float, progress: Progress = silent) -> tuple[Remedy, ...]:
    """What lowers the level of a machine whose autobalancer does not always: each was simulated, pressed either way.

    Of each kind first as little as helps by steady contact, then more.
    """
    found = []
    for what, values in _candidates(work):
        for value in values:
            tried = at_work(_sized(work.design, what, value), accuracy, progress)
            if tried.always and tried.hasty is not None:
                worst = max(tried.hasty, tried.levels.after or tried.hasty)
                found.append(Remedy(what, value, Levels(tried.levels.before, worst)))
                break
    return tuple(found)


def _sized(design: Design, what: What, value: float) -> Design:
    """What sizing makes of a file with the remedy in it."""
    table = design.case.table
    if what == "runout":
        runout = {"runout_mm": from_si(value, "mm"), "runout_tir_mm": None}
        return size(table.model_copy(update={"wheel": table.wheel.model_copy(update=runout)}))
    key = "press_force_N" if what == "press" else "contact_stiffness_N_per_m"
    grinding = table.grinding.model_copy(update={key: value}) if table.grinding else None
    return size(table.model_copy(update={"grinding": grinding}))


def _with(design: Design, what: What, value: float) -> Design:
    if what == "runout":
        return replace(design, case=replace(design.case, runout=value))
    return changed(design, press=value) if what == "press" else changed(design, stiffness=value)


def _candidates(work: Work) -> Iterator[tuple[What, tuple[float, ...]]]:
    """A truer wheel, a softer contact, a harder press."""
    design, contact = work.design, work.design.case.contact
    if contact is None or contact.kind == "face":
        return
    runout = design.case.runout
    if runout and _better(work, "runout", runout / 100):
        least = crossing(lambda e: _better(work, "runout", e), runout / 100, runout)
        yield "runout", tuple(_rounded(share * least, down=True) for share in LESS)
    if contact.kind == "compliant" and _better(work, "stiffness", SOFTEST * contact.stiffness):
        softest = SOFTEST * contact.stiffness
        least = crossing(lambda c: _better(work, "stiffness", c), softest, contact.stiffness)
        yield "stiffness", tuple(_rounded(share * least, down=True) for share in LESS)
    forces = [abs(side.steady.reaction or 0.0) for side in (work.fitted, work.without)]
    needed = max(forces if contact.kind == "rigid" else forces[:1])
    if (work.fitted.parts or work.at_once.parts) and _better(work, "press", 1.1 * needed):
        needed = max(needed, contact.press_force)
        yield "press", tuple(_rounded(needed / share * 1.02, down=False) for share in LESS)


def _better(work: Work, what: What, value: float) -> bool:
    """Whether the steady motion with the autobalancer holds, and is the smaller one."""
    design = _with(work.design, what, value)
    runout, contact = runout_of(design.case), design.case.contact
    free, without = fitted(design, runout), bare(design, runout)
    if free.reaction is None or free.balls is None or free.balls.places != "balanced" or without.amplitude is None:
        return False
    holds = contact is not None and abs(free.reaction) < contact.press_force
    return holds and math.hypot(free.amplitude or 0.0, work.rest) < without.amplitude


def _rounded(value: float, *, down: bool) -> float:
    """Two digits, to the safe side.

    >>> _rounded(0.0347, down=True), _rounded(151.0, down=False)
    (0.034, 160.0)
    """
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    steps = math.floor(value / unit * (1 + 1e-9)) if down else math.ceil(value / unit * (1 - 1e-9))
    return float(f"{steps * unit:.6g}")


@dataclass(frozen=True)
class Agreement:
    """Relative differences of the simulated contact from the closed form: axis, force, resulting imbalance.

    `apart`: the largest; `failure`: why there is none.
    """

    axis: float | None = None
    reaction: float | None = None
    imbalance: float | None = None
    failure: str | None = None

    @property
    def apart(self) -> float | None:
        """The largest."""
        return max((each for each in (self.axis, self.reaction, self.imbalance) if each is not None), default=None)


def agreement(work: Work, accuracy: float, progress: Progress = silent) -> Agreement | None:
    """Closed form against the simulation of the same contact, ideal race and balls, from where the balls stand at idle.

    None where wheel and work part or balls do not balance: the closed form does not speak of these. A face leaves
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
    scene = only_contact(_calm(work.design, scene_of_design(work.design, "grinding")))
    sway, _ = free_rates(scene.support, scene.races[0], scene.speed)
    rate = min(loaded_rate(work.design, steady.balls.worst), sway)
    longer = min(LONG / rate if rate > 0 else LONGEST, LONGEST)
    scene = replace(scene, name="grinding, contact alone", duration=max(scene.duration, longer))
    try:
        run = working(scene, accuracy, progress)
    except NotTrustworthyError as error:
        return Agreement(failure=str(error).splitlines()[0])
    return compared(steady, run, work.design.autobalancer.static_moment)


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
    off = max(abs(found - told) for found, told in zip(run.axis, axis, strict=True))
    usual = max(*map(abs, axis), force / min(map(abs, steady.contact.dynamic_stiffness)))
    told = steady.reaction or 0j
    pressed = abs(run.reaction - told) / max(abs(told), force) if len(run.force) else None
    return Agreement(off / usual, pressed, abs(run.imbalance - total) / carried)
