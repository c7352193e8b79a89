"""A machine at its workpiece with and without its autobalancer: levels, and remedies that were tried.

`loaded_levels` gives the levels under load in `abu size`: those that `abu grinding` computes of the same design.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Annotated, Final, Literal

from abu_calc.dynamics.scene import Scene
from abu_calc.features.grinding.simulation import WorkSimulation, bounces, bouncing, seen, working
from abu_calc.features.grinding.steady_contact import (
    SteadyWork,
    bare,
    changed,
    contact_presses,
    crossing,
    fitted,
    runout_of,
)
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import in_file
from abu_calc.simulation.design_scenes import WORK, SceneFailure, SceneRun
from abu_calc.simulation.scene_of_design import grinding_without, scene_of_design
from abu_calc.sizing import size
from abu_calc.sizing.budget import accuracy_budget
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import Levels, VibrationLevels, handle_levels
from abu_calc.sizing.vibration import LevelsUnderLoad

EXCEEDED: Final = math.sqrt(2)
"""Ratio of run to closed form above which the run is trusted instead: 3 dB."""

LONGEST: Final = 6.0
"""Seconds after which a start that is louder than the usual one is taken to stay so."""

LOUDER: Final = 1.0
"""Difference in dB above which a start case counts as another state than the usual one.

A smaller difference counts as the same state with a decaying transient.
"""
LOUD: Final = 10 ** (LOUDER / 20)

What = Literal["runout", "contact_stiffness", "press_force"]

LESS: Final = 1.0, 0.75, 0.5
"""Shares of the value that would just suffice, tried one after another."""

SOFTEST: Final = 1e-3
"""Share of the contact's stiffness down to which a softer one is tried."""


@dataclass(frozen=True)
class Side:
    """The machine with or without its autobalancer: steady motion, whether wheel and work part, and the run.

    `run` None where it was not asked for, or where none gave an answer: then `failure` says why.
    """

    steady: SteadyWork
    run: WorkSimulation | None = None
    failure: str | None = None
    press: float = math.inf

    @property
    def parts(self) -> bool:
        """True if the steady contact would have to pull, or wheel and workpiece lose contact in the run."""
        return self.pulls or (self.run is not None and self.run.parts)

    @property
    def scatter(self) -> float:
        """Uncertainty of the level [dB] if it is the mean of chaotic runs; else 0."""
        return 0.0 if self.run is None else self.run.scatter

    @property
    def pulls(self) -> bool:
        """True if the variable force of the steady motion exceeds the normal force [N]."""
        return abs(self.steady.reaction or 0.0) > self.press


@dataclass(frozen=True)
class Work:
    """A machine at its work: without autobalancer, and with it pressed when the balls have settled at idle, or at once.

    `settled`, `hasty`: levels [dB] when pressed either way. One is None where no way to compute it holds. `moved`:
    displacement 0–peak [m] that makes the former; `rest`: what race and friction leave anyway [m].
    """

    design: Design
    without: Side
    fitted: Side
    at_once: Side
    settled: VibrationLevels
    hasty: VibrationLevels
    moved: float | None
    rest: float
    moved_without: float | None = None
    """Displacement 0–peak [m] without the autobalancer."""

    @property
    def levels(self) -> Levels:
        """Levels at the loudest handle, pressed after the balls have settled: the usual way to work."""
        return self.settled.worst

    @property
    def level_at_once(self) -> float | None:
        """Level with the autobalancer at the loudest handle, pressed before the balls have settled."""
        return self.hasty.worst.after

    @property
    def stays_loud(self) -> bool:
        """True if wheel and workpiece, pressed at once, keep bouncing louder than otherwise: a separate state."""
        usual, loud = self.levels.after, self.level_at_once
        return self.at_once.parts and usual is not None and loud is not None and loud > usual + LOUDER

    @property
    def lowered(self) -> bool | None:
        """True if the autobalancer lowers the level once the balls have settled; None if not known."""
        return below(self.levels.after, self.levels.before, self.fitted.scatter + self.without.scatter)

    @property
    def always(self) -> bool | None:
        """True if the autobalancer lowers the level also when pressed at once; None if not known."""
        doubt = self.at_once.scatter + self.without.scatter
        both = self.lowered, below(self.level_at_once, self.levels.before, doubt)
        return None if None in both else all(both)


def below(after: float | None, before: float | None, doubt: float) -> bool | None:
    """True if a level [dB] is below another.

    None where one is not known, or where they are no further apart than chaotic runs scatter, by the `doubt` [dB].
    """
    if before is None or after is None or (doubt and abs(before - after) <= doubt):
        return None
    return after < before


@record
class TriedRemedy(Record):
    """Change that was tried and lowers the level under load, and the levels it gave."""

    runout: Annotated[float | None, Quantity("runout", "ε", unit="mm")] = None
    contact_stiffness: Annotated[float | None, Quantity("contact stiffness", "c_n", unit="N_per_m")] = None
    press_force: Annotated[float | None, Quantity("press force", "N₀", unit="N")] = None
    level_before_db: Annotated[float | None, Quantity("level without autobalancer")]
    level_after_db: Annotated[float | None, Quantity("level with it")]


def at_work(
    design: Design, accuracy: float, progress: Progress = silent, hard: SceneRun | SceneFailure | None = None
) -> Work:
    """Steady motions and runs; without autobalancer a run where wheel and work part only.

    `hard`: what came of the scene of grinding from bunched balls, where that was simulated before.
    """
    runout, case, abu = runout_of(design.case), design.case, design.autobalancer
    press = case.contact.press_force if case.contact else math.inf
    budget = accuracy_budget(case, design.imbalance.value, abu.requirement, abu.balls, abu.budget.resting_angles,
                             case.speed)  # fmt: skip
    rest = budget.residual - budget.capacity_shortfall
    without, free = Side(bare(design, runout), press=press), Side(fitted(design, runout), press=press)
    if without.parts:
        without = _run(without, grinding_without(design), accuracy, progress)
    usual = _run(free, scene_of_design(design, "grinding", "settled"), accuracy, progress)
    moved, left, at_once = _displacement(design, without, 0.0), _displacement(design, usual, rest), free
    if contact_presses(case):
        at_once = _at_once(design, free, accuracy, progress, hard)
        loud = _displacement(design, at_once, rest)
        if left and loud and loud > LOUD * left and at_once.parts and not at_once.scatter:
            at_once = _still(design, at_once, accuracy, progress)
    levels, hasty = (handle_levels(case, moved, displacement, abu.mass) for displacement in
                     (left, _displacement(design, at_once, rest)))  # fmt: skip
    return Work(design, without, usual, at_once, levels, hasty, left, rest, moved)


def _at_once(
    design: Design, free: Side, accuracy: float, progress: Progress, hard: SceneRun | SceneFailure | None
) -> Side:
    scene = scene_of_design(design, "grinding")
    if isinstance(hard, SceneFailure):
        return _by_statistics(free, scene, accuracy, hard.reason, progress)
    if hard is not None:
        return replace(free, run=seen(hard.simulation))
    return _run(free, scene, accuracy, progress)


def _still(design: Design, loud: Side, accuracy: float, progress: Progress) -> Side:
    """The same start for as long as is simulated at most: whether it stays so loud. What it was where that fails."""
    scene = replace(scene_of_design(design, "grinding"), duration=LONGEST)
    later = _run(loud, scene, accuracy, progress, WORK)
    return loud if later.failure else later


def _run(side: Side, scene: Scene, accuracy: float, progress: Progress, work: int | None = None) -> Side:
    """Simulate one side; if its bouncing motion cannot be computed, take statistics of several runs.

    Chaos is recognised long before all the allowed work is spent.
    """
    if work is None:
        work = WORK // 4 if bounces(scene) else WORK
    try:
        return replace(side, run=working(scene, accuracy, progress, work))
    except NotTrustworthyError as error:
        return _by_statistics(side, scene, accuracy, str(error), progress)


def _by_statistics(side: Side, scene: Scene, accuracy: float, reason: str, progress: Progress) -> Side:
    """Average of several runs in place of a failed one.

    If wheel and workpiece cannot bounce, or these runs fail too, the reason for the failure is kept.
    """
    first = replace(side, failure=reason.splitlines()[0])
    if not bounces(scene):
        return first
    try:
        return replace(side, run=bouncing(scene, accuracy, progress))
    except NotTrustworthyError as error:
        return replace(side, failure=str(error).splitlines()[0])


def _displacement(design: Design, side: Side, rest: float) -> float | None:
    """0–peak [m] that makes the level; by the run where the steady motion does not hold, or is far exceeded by it.

    Balls that would leave their places if nothing held them (restless) are taken at the larger of both: the run starts
    with balls exactly where they balance, where dry friction may hold them, or what grows has not grown yet. No machine
    that was switched on has such balls, so that the run alone is an easier case than the usual one.
    """
    contact, steady = design.case.contact, side.steady
    rigid = contact is not None and contact.contact == "rigid"
    seen = None if side.run is None else math.sqrt(2) * side.run.velocity / design.case.speed
    if steady.amplitude is not None and not (side.parts and (not rigid or side.pulls)):
        amplitude = math.hypot(steady.amplitude, rest)
        if steady.balls is not None and steady.balls.places == "restless":
            return None if seen is None else max(seen, amplitude)
        return amplitude if seen is None or seen <= EXCEEDED * amplitude else seen
    return None if rigid and side.parts else seen


def remedies(
    work: Work, accuracy: float, progress: Progress = silent, loudest: Callable[[Work], float | None] | None = None
) -> tuple[TriedRemedy, ...]:
    """Changes that lower the level of a machine whose autobalancer does not always; each was simulated, pressed either
    way.

    Of each kind first as little as helps by steady contact, then more. `loudest`: the highest level [dB] of the start
    cases of a machine that was tried, None if it does not help in all of them; without it they are not tried.
    """
    helpful_remedies = []
    for what, values in _candidates(work):
        for value in values:
            tried = at_work(_sized(work.design, what, value), accuracy, progress)
            if tried.always and tried.level_at_once is not None:
                started = tried.level_at_once if loudest is None else loudest(tried)
                if started is None:
                    continue
                worst = max(tried.level_at_once, tried.levels.after or tried.level_at_once, started)
                remedy = {what: value, "level_before_db": tried.levels.before, "level_after_db": worst}
                helpful_remedies.append(TriedRemedy(**remedy))
                break
    return tuple(helpful_remedies)


def _sized(design: Design, what: What, value: float) -> Design:
    """Size the design again with the change in its file."""
    table = design.case.table
    if what == "runout":
        runout = dict((in_file("runout_mm", value), ("runout_tir_mm", None)))
        return size(table.model_copy(update={"wheel": table.wheel.model_copy(update=runout)}))
    key = "press_force_N" if what == "press_force" else "contact_stiffness_N_per_m"
    grinding = table.grinding.model_copy(update={key: value}) if table.grinding else None
    return size(table.model_copy(update={"grinding": grinding}))


def _with(design: Design, what: What, value: float) -> Design:
    if what == "runout":
        return replace(design, case=replace(design.case, runout=value))
    return changed(design, press=value) if what == "press_force" else changed(design, stiffness=value)


def _candidates(work: Work) -> Iterator[tuple[What, tuple[float, ...]]]:
    """A truer wheel, a softer contact, a harder press."""
    design, contact = work.design, work.design.case.contact
    if contact is None or contact.contact == "face":
        return
    runout = design.case.runout
    if runout and _better(work, "runout", runout / 100):
        least = crossing(lambda e: _better(work, "runout", e), runout / 100, runout)
        yield "runout", tuple(_rounded(share * least, down=True) for share in LESS)
    if contact.contact == "compliant" and _better(work, "contact_stiffness", SOFTEST * contact.contact_stiffness):
        softest = SOFTEST * contact.contact_stiffness
        least = crossing(lambda c: _better(work, "contact_stiffness", c), softest, contact.contact_stiffness)
        yield "contact_stiffness", tuple(_rounded(share * least, down=True) for share in LESS)
    forces = [abs(side.steady.reaction or 0.0) for side in (work.fitted, work.without)]
    needed = max(forces if contact.contact == "rigid" else forces[:1])
    if (work.fitted.parts or work.at_once.parts) and _better(work, "press_force", 1.1 * needed):
        needed = max(needed, contact.press_force)
        yield "press_force", tuple(_rounded(needed / share * 1.02, down=False) for share in LESS)


def _better(work: Work, what: What, value: float) -> bool:
    """True if steady contact with the autobalancer holds and moves less than without it."""
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


def work_of(
    design: Design, accuracy: float, progress: Progress = silent, hard: SceneRun | SceneFailure | None = None
) -> Work | SceneFailure | None:
    """The machine at its work, see `at_work`; None without a contact that presses in the plane: there it idles."""
    if not contact_presses(design.case):
        return None
    try:
        return at_work(design, accuracy, progress, hard)
    except NotTrustworthyError as error:
        return SceneFailure("at work", str(error).splitlines()[0])


def loaded_levels(design: Design, work: Work | SceneFailure | None) -> LevelsUnderLoad | None:
    """Levels by steady contact and runs: pressed after the balls have settled, and at once."""
    steady = design.loaded
    if steady is None or work is None:
        return steady
    if isinstance(work, SceneFailure):
        return replace(steady, levels=handle_levels(design.case, None, None, design.autobalancer.mass))
    return replace(
        steady, levels=work.settled, hasty=work.hasty, stays=work.stays_loud, parts_before=work.without.parts,
        parts_after=work.fitted.parts,
    )  # fmt: skip
