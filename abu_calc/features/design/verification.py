"""Verification of a design: the first candidate that balances from every start case, and tried remedies.

Remedies are small changes of a machine with which its design passes from every start case. Each is tried before it is
named.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import islice

from abu_calc.features.design.start_search import SearchResult, search
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation import patience
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.units import from_si
from abu_calc.inputs.duty import RunUp
from abu_calc.simulation.ensemble import simulate_members
from abu_calc.simulation.ensemble_results import Ensemble
from abu_calc.sizing import instead
from abu_calc.sizing.balls import Candidate, sound
from abu_calc.sizing.design import Design

OILS = (3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0)
"""Drags h₀ [1/s] of oils and greases, of which those nearest to the drag given are tried."""
MOST_DRAGS, NEAR = 5, 1.2
"""Most drag rates that are tried, and the factor within which another drag rate counts as the same."""

FASTER, DAMPED = 0.5, 2.0
"""Factors on the time of the run-up and on the damping of the suspension."""

BEFORE = 2
"""Drags that are tried before what leaves the oil as it is."""

BELOW, LEAST = 2 / 3, 0.05
"""Share of the stalling speed to which the rotor is slowed, and least stalling speed.

The least stalling speed is a share of the rotor's speed; slower balls hardly turn.
"""


@dataclass(frozen=True)
class MachineChange:
    """Change in words, and the machines with it, each of which must pass."""

    name: str
    designs: tuple[Design, ...]


def remedy(design: Design, first: Ensemble, most: int, accuracy: float, progress: Progress, workers: int) -> str | None:
    """The first change with which every start at the drag given passes; else all that were tried without success.

    `first`: the starts of the design as it is; `most`: evaluations that all trials may take, None where it is none.
    """
    tried = []
    for change in changes(design, first):
        if most <= 0:
            break
        for variant in change.designs:
            ensemble = simulate_members(variant, accuracy, within(progress, f"with {change.name}"), workers, (1.0,))
            most -= ensemble.work
            if not passes(variant, ensemble):
                break
        else:
            return f"Tried: with {change.name} all {ensemble.members} starts pass."
        tried.append(change.name)
    return f"Tried without success: {'; '.join(tried)}." if tried else None


def changes(design: Design, first: Ensemble) -> Iterator[MachineChange]:
    """Another drag, a pause where balls hang, a faster run-up where run-ups alone fail, more damping."""
    case, table = design.case, design.case.table
    drags = other_drags(case.drag, only_more=bool(first.hanging))
    with_drags = [
        MachineChange(
            f"autobalancer.rolling_drag_per_s = {drag:.3g}", (replace(design, case=replace(case, drag=drag)),)
        )
        for drag in drags
    ]
    yield from with_drags[:BEFORE]
    yield from _pause(design, first)
    if table.run_up and not table.motor and all(start.member.run_up for start in first.given if not start.balanced):
        time = FASTER * table.run_up.time_s
        yield MachineChange(f"run_up.time_s = {time:.3g}", (_running_up(design, table.run_up, time_s=time),))
    if isinstance(case.suspension, Springs):
        x, y = (DAMPED * damping for damping in case.suspension.damping)
        held = replace(case.suspension, damping=(x, y))
        damped = replace(design, case=replace(case, suspension=held))
        yield MachineChange("suspension.damping_ratios twice as large", (damped,))
    yield from with_drags[BEFORE:]


def _pause(design: Design, first: Ensemble) -> Iterator[MachineChange]:
    """Temporary speed reduction that brings stalled balls to rest in their race.

    The rotor is slowed below the speed at which the balls stall. It then speeds up again as in a run-up,
    and sooner. Above that speed the balls go on stalling, the more so the nearer the rotor is to it. None
    for a motor, which sets its own pace, for balls that hardly turn, and if that speed is in the working
    range.
    """
    table, speed = design.case.table, design.case.speed
    caught = min(((1 - run.slip) * (run.member.speed or speed) for run in first.given if run.hanging), default=0.0)
    given = table.run_up or RunUp()
    low, lowest = _rounded(from_si(BELOW * caught, "rpm")), from_si(design.case.speed_range[0], "rpm")
    if table.motor or caught < LEAST * speed or low >= min(given.pause_speed_rpm or math.inf, lowest):
        return
    rise = _rounded((1 - low / from_si(speed, "rpm")) * given.time_s)
    rises = rise, FASTER * rise
    designs = tuple(_running_up(design, given, pause_speed_rpm=low, pause_rise_s=rise_time) for rise_time in rises)
    yield MachineChange(f"run_up.pause_speed_rpm = {low:.0f} and run_up.pause_rise_s = {rise:g}", designs)


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def _running_up(design: Design, given: RunUp, **changed: float) -> Design:
    """The machine with another run-up."""
    table = design.case.table.model_copy(update={"run_up": given.model_copy(update=changed)})
    return replace(design, case=replace(design.case, table=table))


def other_drags(given: float, *, only_more: bool) -> list[float]:
    """The nearest first; more drag alone where balls hang."""
    others = [drag for drag in OILS if drag > NEAR * given or (drag < given / NEAR and not only_more)]
    return sorted(others, key=lambda drag: max(drag / given, given / drag) if given else drag)[:MOST_DRAGS]


def passes(design: Design, ensemble: Ensemble) -> bool:
    """True if every start case at the given drag rate balances, in time and within the level."""
    limits, level = design.case.table.limits, design.case.level_limit
    lost = any(start.member.drag == ensemble.drag for start in ensemble.lost)
    return not lost and all(
        start.settling_time_or_inf <= limits.settling_time_s and start.level <= level for start in ensemble.given
    )


MOST_OTHERS, MOST_WORK, REMEDIES = 3, 600_000, 0.5
"""Candidates that are tried when the best one does not pass, evaluations beyond which nothing more is tried, and the
share of these that remedies may take in any case."""


NOT_SEARCHED = (
    "Further starts were not tried, since each takes long: --patience 300 tries them, in seconds. The starts that are "
    "listed all pass."
)

MOST_SEARCHED = 2_000_000
"""Work of the listed starts, in SciPy's evaluations, beyond which no further ones are tried."""


@dataclass(frozen=True)
class Proven:
    """A design, what its starts show (None: its balls cannot carry the imbalance), and what was tried beside it."""

    design: Design
    ensemble: Ensemble | None
    remedy: str | None = None
    warnings: tuple[str, ...] = ()
    searched: SearchResult | None = None
    """Result of further start cases, if all listed ones pass."""


def proven(design: Design, accuracy: float = 0.01, progress: Progress = silent, workers: int = 1) -> Proven:
    """The best candidate if it passes from every start at the drag given, else the next one that does.

    If none does, the best one, with the first change that would make it pass.
    """
    if not _carries(design):
        return Proven(design, None)
    first = simulate_members(design, accuracy, progress, workers)
    if passes(design, first):
        return _with_search(Proven(design, first), accuracy, progress, workers)
    if not design.frequency.balancing_possible or patience.over():
        return Proven(design, first)
    spent, placed = first.work, design.case.table.start
    others = (
        candidate
        for candidate, _ in design.choice.runners_up
        # A file that places its balls has an angle for each.
        if sound(design.case, candidate) and (placed is None or len(placed.angles_deg) == candidate.ball_count)
    )
    for runner_up in islice(others, MOST_OTHERS):
        if spent > MOST_WORK:
            break
        other = instead(design, runner_up, "does not balance from every start")
        ensemble = simulate_members(other, accuracy, within(progress, f"{_words(runner_up)} instead"), workers)
        spent += ensemble.work
        if passes(other, ensemble):
            text = f"{_words(design.autobalancer)}, the best by weight, does not pass from every start; this one does."
            return _with_search(Proven(other, ensemble, warnings=(text,)), accuracy, progress, workers)
    left = max(MOST_WORK - spent, int(REMEDIES * MOST_WORK))
    return Proven(design, first, remedy(design, first, left, accuracy, progress, workers))


def _with_search(proof: Proven, accuracy: float, progress: Progress, workers: int) -> Proven:
    """Add the result of further start cases, or a warning if they would take too long."""
    if proof.ensemble is not None and proof.ensemble.work > MOST_SEARCHED and not patience.given():
        return replace(proof, warnings=(*proof.warnings, NOT_SEARCHED))
    searched = search(proof.design, accuracy, progress, workers)
    return replace(
        proof, searched=searched if proof.ensemble is None else replace(searched, listed=proof.ensemble.given)
    )


def _carries(design: Design) -> bool:
    autobalancer = design.autobalancer
    return autobalancer.capacity >= design.imbalance.value * abs(autobalancer.requirement.plane_ratio)


def _words(candidate: Candidate) -> str:
    return f"{candidate.ball_count} × Ø{1e3 * candidate.ball_diameter:g} mm"
