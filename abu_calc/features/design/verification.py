"""Verification of a design: the first candidate that balances from every start case, and simulated changes.

Changes are entries of the file with which the design passes from every start case. Each is simulated before it is
named.
"""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import partial

from abu_calc.features.design.start_rules import FULL, ONE, StartFacts, TriedChange
from abu_calc.features.design.start_search import SearchResult, fails, search
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation import patience
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent, within
from abu_calc.foundation.units import from_si
from abu_calc.inputs.duty import RunUp
from abu_calc.simulation.ensemble import simulate_first, simulate_members
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.sizing import instead, no_worse, usable
from abu_calc.sizing.actions import overrides, pins, with_entries, words
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.design import Design, built
from abu_calc.sizing.oil import overriding

OILS = (3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0)
"""Drags h₀ [1/s] of oils and greases, of which those nearest to the drag given are tried."""
MOST_DRAGS, NEAR = 5, 1.15
"""Most drag rates that are tried, and the factor within which another drag rate counts as the same."""

FASTER, DAMPED = 0.5, 2.0
"""Factors on the time of the run-up and on the damping of the suspension."""

MOST_OILS = 3
"""Drag rates that are tried for start cases in hot or cold oil."""

BEFORE = 2
"""Drags that are tried before what leaves the oil as it is."""

BELOW, LEAST = 2 / 3, 0.05
"""Share of the stalling speed to which the rotor is slowed, and least stalling speed.

The least stalling speed is a share of the rotor's speed; slower balls hardly turn.
"""


@dataclass(frozen=True)
class MachineChange:
    """Entries of the file to replace, and further variants of them that must pass, too."""

    entries: dict[str, object]
    variants: tuple[dict[str, object], ...] = ()

    @property
    def name(self) -> str:
        """The change in words."""
        return words(self.entries)

    def designs(self, design: Design) -> tuple[Design, ...]:
        """The machines with the change, each of which must pass, built to the design; none if the file refuses it."""
        changed = (design_with(design, entries) for entries in (self.entries, *self.variants))
        return tuple(other for other in changed if other is not None)


def design_with(design: Design, entries: Mapping[str, object]) -> Design | None:
    """A design with entries of its file replaced, its balls and race pinned; None if the file refuses them."""
    try:
        table = with_entries(design.case.table, {**entries, **pins(design.autobalancer)})
        return replace(built(design, table), swing_arm=design.swing_arm)
    except (AbuError, ValueError):
        return None


def tried_change(
    design: Design, first: Ensemble, most: int, accuracy: float, progress: Progress, workers: int,
    searched: SearchResult | None = None,
) -> TriedChange | None:  # fmt: skip
    """The first change with which every promised start passes; else all that were tried without success.

    `first`: the starts of the design as it is, `searched`: its further ones; `most`: evaluations that all trials may
    take, None where it is none.
    """
    tried, first = list[str](), _with_promised(first, searched)
    for change in changes(design, first):
        if most <= 0:
            break
        ensembles = list[Ensemble]()
        for variant in change.designs(design):
            ensemble = simulate_members(variant, accuracy, within(progress, f"with {change.name}"), workers, (1.0,))
            most -= ensemble.work
            if not passes(variant, ensemble):
                break
            more = search(variant, accuracy, within(progress, f"with {change.name}"), workers, ensemble.given)
            most -= sum(outcome.work for outcome in more.outcomes)
            if any(map(partial(fails, variant), more.outcomes)):
                break
            ensembles.append(_with_promised(ensemble, more))
        if len(ensembles) == 1 + len(change.variants):
            by_oil = overriding(design.case, change.entries)
            return TriedChange(design.autobalancer, first, change.entries, ensembles[0], by_oil=by_oil)
        tried.append(change.name)
    return TriedChange(design.autobalancer, first, {}, None, tuple(tried)) if tried else None


def _with_promised(ensemble: Ensemble, searched: SearchResult | None) -> Ensemble:
    """Start cases with the further ones that are promised."""
    more = () if searched is None else (outcome for outcome in searched.outcomes if outcome.member.promised)
    return replace(ensemble, outcomes=(*ensemble.outcomes, *more))


def change_for_oils(
    design: Design, first: Ensemble, accuracy: float, progress: Progress, workers: int
) -> TriedChange | None:
    """The nearest drag rate, of those tried, with which start cases in hot and cold oil pass, too.

    None if all pass as the design is, or if some gave no answer. If start cases fail in hot oil alone, only greater
    drag rates are tried, if in cold oil alone, only smaller ones.
    """
    bad = [outcome.member.drag for outcome in first.outcomes if not _good(design, outcome)]
    if not bad or first.lost or patience.over() or not design.frequency.balancing_possible:
        return None
    most, tried, drag = int(REMEDIES * MOST_WORK), list[str](), design.case.drag
    for other in other_drags(drag, only_more=False):
        if (max(bad) < drag and other < drag) or (min(bad) > drag and other > drag):
            continue
        if most <= 0 or len(tried) >= MOST_OILS:
            break
        change = MachineChange({"autobalancer.rolling_drag_per_s": other})
        for variant in change.designs(design):
            ensemble = simulate_members(variant, accuracy, within(progress, f"with {change.name}"), workers)
            most -= ensemble.work
            if not ensemble.lost and all(_good(variant, outcome) for outcome in ensemble.outcomes):
                by_oil = overriding(design.case, change.entries)
                return TriedChange(
                    design.autobalancer, first, change.entries, ensemble, in_all_oils=True, by_oil=by_oil
                )
        tried.append(change.name)
    return TriedChange(design.autobalancer, first, {}, None, tuple(tried), in_all_oils=True) if tried else None


def _good(design: Design, outcome: StartOutcome) -> bool:
    """True if a start case balances, in time and within the level."""
    return outcome.holds(design.case.table.limits, design.case.level_limit)


def changes(design: Design, first: Ensemble) -> Iterator[MachineChange]:
    """Another drag rate, a temporary speed reduction if balls stall, a faster run-up if run-ups alone fail, more
    damping.
    """
    case, table = design.case, design.case.table
    drags = other_drags(case.drag, only_more=bool(first.hanging))
    with_drags = [MachineChange({"autobalancer.rolling_drag_per_s": drag}) for drag in drags]
    yield from with_drags[:BEFORE]
    yield from _pause(design, first)
    if table.run_up and not table.motor and all(start.member.run_up for start in first.given if not start.balanced):
        yield MachineChange({"run_up.time_s": _rounded(FASTER * table.run_up.time_s)})
    if damping := more_damping(design):
        yield MachineChange(damping)
    yield from with_drags[BEFORE:]


def more_damping(design: Design) -> dict[str, object] | None:
    """Entries that double the damping of springs; None for another suspension."""
    dampings = design.case.table.suspension.dampings
    if dampings is None or not isinstance(design.case.suspension, Springs):
        return None
    return {"suspension.damping_ratios": [float(f"{DAMPED * damping:.6g}") for damping in dampings]}


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
    slow: dict[str, object] = {"run_up.pause_speed_rpm": low, "run_up.pause_rise_s": rise}
    yield MachineChange(slow, ({**slow, "run_up.pause_rise_s": FASTER * rise},))


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def other_drags(given: float, *, only_more: bool) -> list[float]:
    """Other drag rates [1/s], the nearest first; greater ones alone if balls stall."""
    others = [drag for drag in OILS if drag > NEAR * given or (drag < given / NEAR and not only_more)]
    return sorted(others, key=lambda drag: max(drag / given, given / drag) if given else drag)[:MOST_DRAGS]


def passes(design: Design, ensemble: Ensemble) -> bool:
    """True if every start case at the given drag rate balances, in time and within the level."""
    lost = any(start.member.drag == ensemble.drag for start in ensemble.lost)
    return not lost and all(_good(design, start) for start in ensemble.given)


MOST_OTHERS, MOST_WORK, REMEDIES = 3, 600_000, 0.5
"""Candidates that are tried when the best one does not pass; evaluations beyond which nothing more is tried, and the
share of these that remedies may take in any case."""

LATE = "does not pass from every start case"
"""Reason against a candidate."""

NOT_SEARCHED = (
    "Further start cases were not simulated, since each takes long (--patience 300 allows them 300 s). All listed "
    "start cases pass."
)

MOST_SEARCHED = 2_000_000
"""Work of the listed starts beyond which no further ones are tried."""


@dataclass(frozen=True)
class Proven(StartFacts):
    """A design of one race, what its starts show, and what was tried beside it.

    Without an ensemble its balls cannot carry the imbalance. Further start cases are searched if all listed ones pass.
    """

    warnings: tuple[str, ...] = ()

    @property
    def holds(self) -> bool:
        """True if no promised start case that was searched breaks a limit."""
        return self.searched is None or not any(map(partial(fails, self.design), self.searched.outcomes))


def proven(
    design: Design, accuracy: float = 0.01, progress: Progress = silent, workers: int = 1, starts: str = FULL
) -> Proven:
    """The best candidate if it passes from every start at the drag given, else the next one that does.

    If none does, the best one, with the first change that would make it pass. With one start or none nothing is
    proven: the best candidate stands, and no check that needs all start cases passes.
    """
    if not _carries(design):
        return Proven(design, None)
    if starts != FULL:
        return Proven(design, simulate_first(design, accuracy) if starts == ONE else None, starts=starts)
    first = simulate_members(design, accuracy, progress, workers)
    proof = Proven(design, first)
    if passes(design, first):
        proof = _with_search(proof, accuracy, progress, workers)
        if proof.holds:
            # After the search, whose time the patience that was asked for must not go to what only advises.
            return replace(proof, change=change_for_oils(design, first, accuracy, progress, workers))
    if not design.frequency.balancing_possible or patience.over():
        return proof
    spent, refused = first.work, [(design.autobalancer, LATE)]
    # Where further starts alone break a limit, a runner-up that has none such would be the luckier one, no better.
    candidates = () if passes(design, first) else design.choice.runners_up
    others = [candidate for candidate, _ in candidates if usable(design.case, candidate)]
    # Those that were passed over for a calculated check come last.
    others.sort(key=lambda candidate: not no_worse(instead(design, candidate, ()), design))
    for runner_up in others[:MOST_OTHERS]:
        if spent > MOST_WORK:
            break
        other = instead(design, runner_up, refused)
        ensemble = simulate_members(other, accuracy, within(progress, f"{_words(runner_up)} instead"), workers)
        spent += ensemble.work
        if passes(other, ensemble):
            # Other commands, without these start cases, would not take the runner-up.
            text = (
                f"{_words(design.autobalancer)} balls, the first choice, do not pass from every start case. "
                f"{_words(runner_up)} balls do. Pin them for other commands: "
                f"{' '.join(f'--set {entry}' for entry in overrides(pins(runner_up)))}"
            )
            another = Proven(other, ensemble, warnings=(text,))
            another = _with_search(another, accuracy, progress, workers, every_part=True)
            if another.holds:
                return replace(another, change=change_for_oils(other, ensemble, accuracy, progress, workers))
        refused.append((runner_up, LATE))
    left = max(MOST_WORK - spent, int(REMEDIES * MOST_WORK))
    found = tried_change(design, first, left, accuracy, progress, workers, proof.searched)
    return replace(proof, change=found)


def _with_search(
    proof: Proven, accuracy: float, progress: Progress, workers: int, *, every_part: bool = False
) -> Proven:
    """Add the result of further start cases, or a warning if they would take too long."""
    if proof.ensemble is not None and proof.ensemble.work > MOST_SEARCHED and not patience.given():
        return replace(proof, warnings=(*proof.warnings, NOT_SEARCHED))
    listed = () if proof.ensemble is None else proof.ensemble.given
    return replace(proof, searched=search(proof.design, accuracy, progress, workers, listed, every_part=every_part))


def _carries(design: Design) -> bool:
    autobalancer = design.autobalancer
    return autobalancer.capacity >= design.imbalance.value * abs(autobalancer.requirement.plane_ratio)


def _words(candidate: Candidate) -> str:
    return f"{candidate.ball_count} × Ø{1e3 * candidate.ball_diameter:g} mm"
