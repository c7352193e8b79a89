"""One design switched on from many start cases: which balance, how soon, how loud, and where balls stall.

`hanging_bounds` gives the closed bounds on stalling of a design, idle, over its whole speed range.
"""

import math
from collections.abc import Callable, Generator, Iterable, Sequence
from contextlib import closing
from dataclasses import replace
from functools import partial
from itertools import islice
from typing import Any, NamedTuple

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.stability.stall import HangingBounds
from abu_calc.dynamics.stability.stall import hanging_bounds as bounds_of
from abu_calc.dynamics.trajectory import Samples, Times, Trajectory
from abu_calc.foundation import patience
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted, silent, within
from abu_calc.simulation.early_stopping import Early
from abu_calc.simulation.response import Response, needed_times
from abu_calc.simulation.run_checks import (
    MARGIN,
    allowed_imbalance,
    balances,
    felt_mass,
    kept_quiet,
    linger,
    slip,
)
from abu_calc.simulation.scene_of_design import guided, idle_scene
from abu_calc.simulation.start_cases import (
    Ensemble,
    Lost,
    Member,
    StartOutcome,
    deciding,
    members,
    scene_of_member,
    worse,
)
from abu_calc.simulation.subject import chosen
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import level_at_loudest


def hanging_bounds(design: Design) -> HangingBounds:
    """Drags [1/s] above which no balls of a design hang at any speed of its range; `doubt(drag)` asks of one."""
    horizontal = design.case.table.machine.spindle_axis == "horizontal"
    return bounds_of(idle_scene(design), design.autobalancer.half_angle, design.case.speed_range, horizontal=horizontal)


TOLERANCE, TIGHTER = 2e-4, 0.1
"""Tolerance of the first run of a start case, and the factor on it for a confirming run.

A case that decides a check is confirmed by a run at the tighter tolerance.
"""

WORK, MOST_LOST = 400_000, 3
"""Work of one run: half a second in compiled code. Machines that balance take a twentieth of that.
And how many starts at the drag given may be without an answer until no others are tried."""

MORE, MOST_MORE = 10, 24_000_000
"""Times the work that a start may take in a second run, where that of the first did not suffice, and the work of all
runs together after which none is begun: about half a minute of compiled code. A run-up takes long, so its first run may
take as much."""

BEGUN = 0.75
"""Share of that work after which only confirming runs are begun."""

STARTS = 30
"""About how many starts and closer runs a machine has."""

LONGEST_LINGERING, LONGEST_CREEPING = 3.0, 10.0
"""Quiet times permitted: for so long at full speed a start is followed whose balls linger where they do not balance,
and one whose balls still creep.
"""

ALWAYS = ("dry_rolling_friction", "ball_contact")
"""Effects that are in whatever they weigh: where balls hang or rest is decided by them."""


Once = Callable[..., "StartOutcome | Lost"]
Watch = Callable[[Any, "StartOutcome | Lost"], None]
"""One start of a machine, as `start_once` runs it; and what looks at the outcomes of a design in their order."""


class Runner(NamedTuple):
    """How one start of a machine is run, as `start_once` does it, its scene, the work after which no further start is
    begun, and what looks at each outcome in turn and may end all by raising.
    """

    once: Once
    scene: Callable[[Any, Member, float], Scene]
    most: int = MOST_MORE
    watch: "Watch | None" = None


class StartRun(NamedTuple):
    """Outcome of one start case, and the run it is from."""

    outcome: StartOutcome
    scene: Scene
    trajectory: Trajectory


def simulate_members(
    design: Design, accuracy: float = 0.01, progress: Progress = silent, workers: int = 1,
    shares: tuple[float, ...] | None = None, doubtful: float | None = None, watch: "Watch | None" = None,
) -> Ensemble:  # fmt: skip
    """Every start once, at these shares of the drag given; None: those of working, hot and cold oil.

    Those that decide a check run again at a tighter tolerance, and the worse of both counts. `doubtful` [1/s]: the drag
    below which balls might hang, so that a slow run-up is tried, too; None: by the closed bounds. A start
    whose work did not suffice gets more. The outcome does not depend on how many run side by side. `watch`
    looks at each.
    """
    if doubtful is None:
        doubtful = hanging_bounds(design).largest or 0.0
    starts, oil = list(members(design, doubtful, shares)), design.case.oil
    runner = Runner(start_once, called_for, watch=watch)
    ensemble = simulate_starts(design, starts, accuracy, first_tolerance(design), progress, workers, runner)
    return ensemble if oil is None else replace(ensemble, temperatures=oil.temperatures)


def simulate_starts(
    design: Any, starts: Sequence[Member], accuracy: float, tolerance: float, progress: Progress, workers: int,
    runner: Runner | None = None,
) -> Ensemble:  # fmt: skip
    """Each of these starts once at a tolerance, those that decide a check once more at a tighter one.

    `design`: of whatever machine `runner` runs; None: one with a single race.
    """
    runner = runner or Runner(start_once, called_for)
    if patience.given():
        runner = runner._replace(most=patience.UNBOUNDED)
    results = _found(design, starts, accuracy, tolerance, progress, workers, runner)
    spent = sum(result.work for result in results)
    while undecided := deciding(results, design.case.drag):
        if spent >= runner.most:
            results = [
                Lost(result.member, "not confirmed, since others took all the work allowed")
                if k in undecided
                else result
                for k, result in enumerate(results)
            ]
            continue
        again = [(results[k].member, early_end) for k, early_end in undecided.items()]
        closer, tight = within(progress, "closer"), TIGHTER * tolerance
        most = max(WORK, min(MORE * WORK, runner.most - spent))
        runs = list(every_start(design, again, accuracy, tight, closer, workers, run_up_work=most, runner=runner))
        runs = _with_more(design, runs, again, accuracy, tight, closer, workers, spent, runner)
        spent += sum(run.work for run in runs)
        for k, rerun in zip(undecided, runs, strict=True):
            results[k] = worse(results[k], rerun)
    outcomes = tuple(result for result in results if isinstance(result, StartOutcome))
    return Ensemble(design.case.drag, outcomes, tuple(result for result in results if isinstance(result, Lost)))


def simulate_first(design: Design, accuracy: float = 0.01) -> Ensemble:
    """The first of the start cases alone, at the tighter tolerance: an ensemble of one, which proves nothing."""
    start = next(iter(members(design, 0.0, (1.0,))))
    result = start_once(design, start, accuracy, TIGHTER * first_tolerance(design), early_end=False)
    done = isinstance(result, StartOutcome)
    return Ensemble(design.case.drag, (result,) if done else (), () if done else (result,))  # type: ignore[arg-type]


def first_tolerance(design: Design) -> float:
    """Tolerance of the first run of each start; tighter with a pause, whose slow turns amplify errors."""
    return TIGHTER * TOLERANCE if guided(design, 0.0).pause else TOLERANCE


def start_once(
    design: Design,
    member: Member,
    accuracy: float,
    tolerance: float,
    work: int = WORK,
    early_end: bool = True,
    wanted: str = "auto",
    *,
    to_rest: bool = True,
) -> StartOutcome | Lost:
    """One start, by one run; `work`: what it may take; `early_end`: whether it may end early; `to_rest`: whether it is
    followed until its balls rest, though the machine balances and is quiet soon and with a margin.
    """
    try:
        return run_of_start(design, member, accuracy, tolerance, work, early_end, wanted, to_rest=to_rest).outcome
    except NotTrustworthyError as error:
        reason = str(error).splitlines()[0]
        if not isinstance(error, TooMuchWorkError) or patience.over():
            return Lost(member, reason, work)
        return Lost(member, reason + _would_do(design, member, error), work, short=True)


def _would_do(design: Design, member: Member, error: TooMuchWorkError) -> str:
    """Advice on how many seconds suffice for all start cases, rounded, by how far this one came.

    Empty if this run never began.
    """
    if not error.reached:
        return ""
    scene = scene_of_member(design, member)
    evaluations = STARTS * error.evaluations * scene.duration / error.reached
    return f"; {patience.would_do(evaluations, scene.state_count)} would do, in seconds"


def called_for(design: Design, member: Member, accuracy: float) -> Scene:
    """The scene of a start with the effects that it calls for."""
    return with_parted_balls(chosen(scene_of_member(design, member), accuracy, ALWAYS).scene)[0]


def integrator_for(scene: Scene, tolerance: float) -> str:
    """Integrator to request from `choose` for all start cases of a design, found from the scene of one of them.

    The cases differ only in where the balls are. Finding the decay rate of each would take as long as many
    runs.
    """
    name = choose(assemble(scene), "auto", tolerance).name
    return "compiled" if name.startswith("compiled") else "auto"


def run_of_start(
    design: Design,
    member: Member,
    accuracy: float,
    tolerance: float,
    work: int = WORK,
    early_end: bool = False,
    wanted: str = "auto",
    *,
    to_rest: bool = True,
) -> StartRun:
    """The same with the run itself; raises NotTrustworthyError.

    A scene ends by the rates of small motions. Balls that linger in an unstable equilibrium, or creep by friction, take
    longer: their run is done again, as long as settling may matter.
    """
    scene = called_for(design, member, accuracy)
    to_rest = to_rest or design.case.table.limits.rest_time_s is not None
    run, longest = _run_of_scene(design, member, scene, tolerance, work, early_end, wanted, to_rest)
    soon = not to_rest and _surely(design, run.outcome)
    while longest is not None and (run.outcome.creeping or not soon):
        spent, duration = run.outcome.work, longest
        longer = replace(scene, duration=duration)
        run, longest = _run_of_scene(design, member, longer, tolerance, work, early_end, wanted, to_rest)
        run = run._replace(outcome=replace(run.outcome, work=spent + run.outcome.work, duration=duration))
    return run


def _surely(design: Design, outcome: StartOutcome) -> bool:
    """True if a machine balances, is quiet within half of the time permitted, and is less loud by a margin."""
    soon = outcome.quiet_time_or_inf <= design.case.table.limits.longest_quiet_time / 2
    return outcome.balanced and soon and outcome.loudest <= design.case.level_limit - 2 * MARGIN


def _followed_until(design: Design, scene: Scene, outcome: StartOutcome, early: Early, run: Samples) -> float | None:
    """Time [s] until which a start case is followed whose balls are not at rest at the end of its scene, if any."""
    limit = design.case.table.limits.longest_quiet_time
    creeping = outcome.creeping and not outcome.hanging
    longest = scene.full_speed + (LONGEST_CREEPING if creeping else LONGEST_LINGERING) * limit
    late = outcome.hanging or (outcome.quiet_time or 0.0) > limit
    if late or longest <= scene.duration:
        return None
    if creeping:
        return longest
    moving = early.goes_on(run) or linger(design, scene, outcome.imbalance)
    return longest if moving else None


def followed_until(design: Design, scene: Scene, response: Response, samples: Samples) -> float | None:
    """Time [s] until which a whole run of a design's scene is followed, as its start cases are; None: no longer."""
    member = Member("placed", design.case.drag)
    outcome = outcome_of(design, member, scene, response)
    return _followed_until(design, scene, outcome, _early(design, member, scene), samples)


def integrated(
    scene: Scene, times: Times, tolerance: float, work: int = WORK, wanted: str = "auto"
) -> tuple[Trajectory, int]:
    """One run of a scene, and the work that it took of so much. Raises NotTrustworthyError."""
    equations = assemble(scene)
    choice = choose(equations, wanted, tolerance)
    run = choice.integrate(equations, tolerance, times, choice.evaluations(work))
    return run, choice.work(run)


def _early(design: Design, member: Member, scene: Scene, to_rest: bool = True) -> Early:
    """Early stopping of a start case's run."""
    return Early(scene, scene.full_speed, partial(_decided, design, member, scene, to_rest))


def _run_of_scene(
    design: Design,
    member: Member,
    scene: Scene,
    tolerance: float,
    work: int,
    early_end: bool,
    wanted: str,
    to_rest: bool,
) -> tuple[StartRun, float | None]:
    """One run, and the time [s] until which it must be followed; None: no longer."""
    early = _early(design, member, scene, to_rest)
    run, spent = integrated(scene, early.sampling() if early_end else needed_times(scene), tolerance, work, wanted)
    outcome = outcome_of(design, member, scene, early.response(run))
    outcome = replace(outcome, work=spent, rise=early.rising(run))
    return StartRun(outcome, scene, run), _followed_until(design, scene, outcome, early, run)


def _decided(
    design: Design, member: Member, scene: Scene, to_rest: bool, response: Response, creep: float, rise: float
) -> bool:  # fmt: skip
    """True if a start case balances well and in time, even with the change still possible.

    Otherwise the run goes on to its end. The level follows the residual imbalance: if little is left, a
    small creep is many decibels.
    """
    outcome, limits = outcome_of(design, member, scene, response), design.case.table.limits
    if linger(design, scene, outcome.imbalance) and (to_rest or not _surely(design, outcome)):
        return False
    if (
        not balances(outcome.imbalance + creep, outcome.allowed, outcome.slip)
        or outcome.quiet_time_or_inf > limits.longest_quiet_time
    ):
        return False
    louder = max(rise, 20 * math.log10(1 + creep / outcome.imbalance)) if outcome.imbalance else math.inf
    return outcome.level + louder <= design.case.level_limit - MARGIN and kept_quiet(scene, outcome.velocity, louder)


def _found(
    design: Any, starts: Sequence[Member], accuracy: float, tolerance: float, progress: Progress, workers: int,
    runner: Runner,
) -> list[StartOutcome | Lost]:  # fmt: skip
    """All starts, those at the drag given first; the others only where these have answers."""
    first = [(start, True) for start in starts if start.drag == design.case.drag]
    others = [(start, True) for start in starts if start.drag != design.case.drag]
    both, most = [*first, *others], min(MORE * WORK, runner.most // 2)
    runs = every_start(design, both, accuracy, tolerance, progress, workers, run_up_work=most, runner=runner)
    with closing(runs):
        results = _begun(islice(runs, len(first)), first, int(BEGUN * runner.most))
        spent = sum(result.work for result in results)
        results = _with_more(design, results, first, accuracy, tolerance, progress, workers, spent, runner)
        spent = sum(result.work for result in results)
        if sum(isinstance(result, Lost) for result in results) >= MOST_LOST:
            return [*results, *(Lost(start, "not tried, since others gave no answer") for start, _ in others)]
        rest = _begun(runs, others, int(BEGUN * runner.most) - spent)
    spent += sum(result.work for result in rest)
    return [*results, *_with_more(design, rest, others, accuracy, tolerance, progress, workers, spent, runner)]


def _begun(
    runs: Iterable[StartOutcome | Lost], starts: Sequence[tuple[Member, bool]], most: int
) -> list[StartOutcome | Lost]:
    """Results of runs, none begun after so much work."""
    results = list[StartOutcome | Lost]()
    for run in runs:
        results.append(run)
        most -= run.work
        if most <= 0:
            break
    short = "not tried, since others took all the work allowed"
    return [*results, *(Lost(start, short) for start, _ in starts[len(results) :])]


def _with_more(
    design: Any, results: list[StartOutcome | Lost], starts: Sequence[tuple[Member, bool]], accuracy: float,
    tolerance: float, progress: Progress, workers: int, spent: int, runner: Runner,
) -> list[StartOutcome | Lost]:  # fmt: skip
    """Outcomes of the start cases; those that ran out of allowed work are tried once more.

    `spent`: work so far.
    """
    lost = [(k, outcome.work) for k, outcome in enumerate(results) if isinstance(outcome, Lost) and outcome.short]
    short = [k for k, work in lost if work < MORE * WORK]
    work = min(MORE * WORK, (runner.most - spent) // max(len(short), 1))
    if not short or work <= WORK:
        return results
    runs = every_start(
        design, [starts[k] for k in short], accuracy, tolerance, within(progress, "longer"), workers, work,
        runner=runner,
    )  # fmt: skip
    longer = dict(zip(short, runs, strict=True))
    return [longer.get(k, outcome) for k, outcome in enumerate(results)]


def every_start(
    design: Any, starts: Sequence[tuple[Member, bool]], accuracy: float, tolerance: float, progress: Progress,
    workers: int, work: int = WORK, run_up_work: int | None = None, runner: Runner | None = None,
) -> Generator[StartOutcome | Lost, None, None]:  # fmt: skip
    """Each start once, and whether it may end early.

    `run_up_work`: work that a run-up may take; None: as much as any start.
    """
    once, scene, _, watch = runner or Runner(start_once, called_for)
    wanted = integrator_for(scene(design, starts[0][0], accuracy), tolerance) if starts else "auto"
    long = work if run_up_work is None else run_up_work
    tasks = [
        (design, start, accuracy, tolerance, long if start.run_up else work, early_end, wanted)
        for start, early_end in starts
    ]

    with closing(side_by_side(once, tasks, workers, counted(progress, "idle: {} of {} starts", len(tasks)))) as runs:
        for outcome in runs:
            if watch is not None:
                watch(design, outcome)
            yield outcome


def outcome_of(design: Design, member: Member, scene: Scene, response: Response) -> StartOutcome:
    """Return the outcome that the response of a start case's scene gives."""
    speed = abs(response.final.rotor_speed) or scene.speed
    case = replace(design.case, speed=speed)
    return StartOutcome(
        member=member,
        settling_time=response.settling_time,
        quiet_time=response.quiet_time,
        rest_time=response.rest_time,
        creeping=response.creeping,
        residual=response.axis_amplitude,
        level=level_at_loudest(case, design.autobalancer, math.sqrt(2) * response.velocity_rms / speed),
        slip=slip(response, speed),
        imbalance=response.residual_imbalance,
        allowed=allowed_imbalance(design, max(scene.imbalance, scene.largest_imbalance), felt_mass(design, scene)),
        ball_angles=response.ball_angles,
        moved=design.imbalance.value * abs(design.autobalancer.requirement.plane_ratio),
        velocity=response.velocity_rms,
    )
