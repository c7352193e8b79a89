"""A machine with one race judged: its design, what start cases and scenes show, and all checks.

`abu size` makes its result of this, and a change of the file is tried by it, so that both cannot answer differently.
"""

import math
import statistics
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from abu_calc.features.design.region import TrueRegion, true_region
from abu_calc.features.design.start_rules import FULL, ONE, StartFacts, checks_of_starts, level_check
from abu_calc.features.design.start_search import design_part, search
from abu_calc.features.grinding.work import Work, work_of
from abu_calc.features.swing_arm.view import ArmMotion
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import meanwhile
from abu_calc.foundation.progress import Progress, silent
from abu_calc.inputs.machine import MachineFile
from abu_calc.simulation.design_scenes import SceneFailure, SceneRun, not_simulated, simulated
from abu_calc.simulation.ensemble import simulate_first, simulate_members
from abu_calc.simulation.start_cases import Ensemble, Lost, StartOutcome
from abu_calc.sizing import size as size_design
from abu_calc.sizing.design import Design

if TYPE_CHECKING:
    from abu_calc.features.seats.seats import BearingSeats
    from abu_calc.features.swing_arm.verdict import ArmJudgement

ACCURACY = 0.01
"""Accuracy of a simulation where nobody asks for another."""
LEAST_SCATTER = 0.1
"""Scatter of levels [dB] below which none is told."""


@dataclass(frozen=True)
class Judgement:
    """A design with all that was calculated and simulated of it, and its checks.

    `work`: the machine at its workpiece, None without one; of a change that is tried only where a scene failed.
    """

    facts: StartFacts
    seats: "tuple[BearingSeats, ...]"
    region: TrueRegion
    arm: "ArmJudgement | None"
    arm_motion: ArmMotion | None
    runs: Sequence[SceneRun]
    failures: Sequence[SceneFailure]
    work: Work | SceneFailure | None
    checks: tuple[Check, ...]

    @property
    def design(self) -> Design:
        """The design that is judged."""
        design: Design = self.facts.design
        return design

    @property
    def level_after(self) -> float | None:
        """Idle level with the autobalancer at the loudest place [dB], as expected."""
        return self.design.idle.worst.after

    @property
    def outcomes(self) -> Iterator[StartOutcome]:
        """Every start case that was simulated."""
        yield from () if self.facts.ensemble is None else self.facts.ensemble.outcomes
        yield from () if self.facts.searched is None else self.facts.searched.outcomes


class TrialWatcher:
    """What ends a judgement early, of a change that is tried; of the file as it is nothing does.

    `stable`: whether the file as it is is stable; if not, stability is judged before start cases.
    """

    stable = True

    def seen(self, design: Any, outcome: StartOutcome | Lost) -> None:
        """Called with each outcome of its start cases, in their order."""

    def checked(self, checks: Iterable[Check]) -> None:
        """Called with the checks that are known so far."""

    def repeated(self, design: Any) -> None:
        """Called with the design before its start cases run."""


def judge(
    tables: MachineFile,
    accuracy: float = ACCURACY,
    progress: Progress = silent,
    workers: int = 1,
    starts: str = FULL,
    trial: TrialWatcher | None = None,
) -> Judgement:
    """Design, simulate and judge a machine; whatever `trial` raises ends it."""
    only_checks, trial = trial is not None, trial or TrialWatcher()
    seats = _seats(tables)
    trial.checked(_of(seats, tables))
    design = size_design(tables)
    trial.checked(design.checks)
    # The balanced state on an arm may be judged beside all that is simulated.
    on_arm = None if design.swing_arm is None else meanwhile(_judged_arm, design, workers=workers)
    trial.repeated(design)
    early = None if trial.stable else true_region(design, accuracy)
    trial.checked(() if early is None else (early.check,))
    scenes = None
    if only_checks and on_arm is not None:  # all that takes less than start cases comes before them
        trial.checked(on_arm().checks)
        scenes = simulated(design, accuracy, progress, workers=workers)
        trial.checked(_on_work(design, scenes[0]))
    facts = proven(design, accuracy, progress, workers, starts, trial)
    seats = _with_lives(seats, design, facts.ensemble, tables)
    region = early or true_region(design, accuracy)
    trial.checked((region.check,))
    runs, failures = scenes or simulated(design, accuracy, progress, workers=workers)
    work = None if only_checks and not failures else work_of(design, accuracy, progress, _grinding(runs, failures))
    arm, stays = None if on_arm is None else on_arm(), _on_work(design, runs)
    given = () if facts.ensemble is None else facts.ensemble.given
    lost = (
        not_simulated(
            fault.scene, fault.reason, mean=_mean(fault, work),
            answered=any(outcome.member.on_arm == fault.scene.startswith("swing-arm") for outcome in given),
        )
        for fault in failures
    )  # fmt: skip
    of_arm = () if arm is None else arm.checks  # that of the balanced state last
    checks = (
        *design.checks_before, level_check(facts), *design.checks_behind,
        *of_arm[:-1], *_of(seats, tables), *of_arm[-1:], *stays, region.check,
        *checks_of_starts(facts), *lost,
    )  # fmt: skip
    trial.checked(checks)
    moved = None if only_checks else _motion(design)
    arm = arm and replace(arm, checks=(*of_arm, *stays), simulated=True)
    return Judgement(facts, seats, region, arm, moved, runs, failures, work, checks)


SEARCHED_LESS = "designed start cases were simulated, since each takes long"
"""Words of the warning that fewer start cases than usual were run."""

MOST_SEARCHED = 2_000_000
"""Work of the listed starts beyond which fewer further ones are tried: as many as take about as much again."""

FEWEST_SEARCHED = 8
"""Further starts that are tried in any case."""


def proven(
    design: Design, accuracy: float = ACCURACY, progress: Progress = silent, workers: int = 1, starts: str = FULL,
    trial: TrialWatcher | None = None,
) -> StartFacts:  # fmt: skip
    """What the start cases of a design show: listed ones, and further ones if these pass at the drag given.

    Without an ensemble its balls cannot carry the imbalance. With one start or none nothing is proven: no check that
    needs all start cases passes.
    """
    if not _carries(design):
        return StartFacts(design, None)
    if starts != FULL:
        return StartFacts(design, simulate_first(design, accuracy) if starts == ONE else None, starts=starts)
    trial = trial or TrialWatcher()
    first = simulate_members(design, accuracy, progress, workers, watch=trial.seen)
    facts = StartFacts(design, first)
    trial.checked((level_check(facts), *checks_of_starts(facts)))
    if not facts.listed_pass:
        return facts
    most = None
    if first.work > MOST_SEARCHED and not patience.given():
        most = max(FEWEST_SEARCHED, int(MOST_SEARCHED * len(first.outcomes) / first.work))
        number = len(tuple(design_part(design, 0)))
        less = f"Only {min(most, number)} of {number} {SEARCHED_LESS} (--patience 300 allows all of them 300 s)."
        facts = replace(facts, warnings=(less,))
    return replace(facts, searched=search(design, accuracy, progress, workers, first.given, trial.seen, most))


def _carries(design: Design) -> bool:
    autobalancer = design.autobalancer
    return autobalancer.capacity >= design.imbalance.value * abs(autobalancer.requirement.plane_ratio)


def _seats(tables: MachineFile) -> "tuple[BearingSeats, ...]":
    """Bearing seats of the machine, judged."""
    if not tables.bearing:
        return ()
    from abu_calc.features.seats.seats import seat_bearings

    return seat_bearings(tables.bearing)


def _of(seats: "tuple[BearingSeats, ...]", tables: MachineFile) -> Iterator[Check]:
    """Checks of the seats, their actions as entries of the file; a clearance group of the designation is none."""
    for number, (bearing, table) in enumerate(zip(seats, tables.bearing or (), strict=True)):
        for check in bearing.checks:
            entries = bearing.actions[check.code].overrides if check.code in bearing.actions else ()
            if table.internal_clearance is None and any(entry.startswith("internal_clearance") for entry in entries):
                entries = ()
            yield replace(check, overrides=tuple(f"bearing.{number}.{entry}" for entry in entries))


def _with_lives(
    seats: "tuple[BearingSeats, ...]", design: Design, ensemble: Ensemble | None, tables: MachineFile
) -> "tuple[BearingSeats, ...]":
    """Bearings with their lives under the loads of the simulation, without and with the autobalancer.

    The rotating force is the imbalance, or the median residual displacement of the start cases that balance times the
    effective mass; the constant one is the press force with its friction, of machines that grind.
    """
    if not seats:
        return ()
    from abu_calc.features.seats.life_in_use import UseLoads, lives_in_use
    from abu_calc.features.seats.seats import with_life

    outcomes = () if ensemble is None else ensemble.given
    residuals = [outcome.residual for outcome in outcomes if outcome.balanced]
    speed, grinding = design.case.speed, tables.grinding
    constant = 0.0
    if grinding is not None:
        constant = grinding.press_force_N * math.hypot(1.0, grinding.cutting_coefficient)
    residual = statistics.median(residuals) * design.autobalancer.requirement.effective_mass if residuals else None
    loads = UseLoads(design.imbalance.value * speed**2, None if residual is None else residual * speed**2, constant)
    lives = lives_in_use([bearing.bearing for bearing in seats], loads, speed)
    return tuple(map(with_life, seats, lives))


def _grinding(runs: Sequence[SceneRun], failures: Sequence[SceneFailure]) -> SceneRun | SceneFailure | None:
    """Run of the grinding scene, or its failure; None if there is neither."""
    outcomes: list[SceneRun | SceneFailure] = [run for run in runs if run.ledger.scene.name == "grinding"]
    outcomes += [failure for failure in failures if failure.scene == "grinding"]
    return next(iter(outcomes), None)


def _mean(failure: SceneFailure, work: Work | SceneFailure | None) -> str | None:
    """Average result of the grinding scene; None unless it is chaotic and the average is known."""
    if failure.scene != "grinding" or not isinstance(work, Work) or not work.at_once.scatter:
        return None
    return (
        f"The wheel bounces chaotically. Mean level of the early-pressed run: {work.level_at_once:.1f} ± "
        f"{max(work.at_once.scatter, LEAST_SCATTER):.1f} dB"
    )


def _judged_arm(design: Design) -> "ArmJudgement":
    """The swing arm judged."""
    from abu_calc.features.swing_arm.verdict import judge_arm

    return judge_arm(design)


def _motion(design: Design) -> ArmMotion | None:
    """Motion of the arm at the work; None without an arm, or if it does not stand or does not reach the work."""
    if design.swing_arm is None:
        return None
    from abu_calc.features.swing_arm.motion import arm_motion
    from abu_calc.simulation.scene_of_design import scene_of_design

    try:
        moved = arm_motion(scene_of_design(design, "swing-arm-cutting"))
    except NotTrustworthyError:  # checks say so
        return None
    return None if isinstance(moved, str) else moved


def _on_work(design: Design, runs: Sequence[SceneRun]) -> tuple[Check, ...]:
    """Check that the disk of a swing arm stays on its workpiece.

    There is none for machines without an arm, or with one that does not press.
    """
    bounds, presses = design.swing_arm, ("arm_pressed", "arm_stands")
    if bounds is None or any(check.status != "pass" for check in bounds.checks if check.key in presses):
        return ()
    from abu_calc.features.swing_arm.scenes import on_work

    check = on_work(design, runs)
    return () if check is None else (check,)
