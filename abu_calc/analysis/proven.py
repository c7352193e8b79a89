"""The design whose starts all balance: the first of the candidates that does, and remedies that were tried."""

from dataclasses import dataclass, replace

from abu_calc.analysis.ensemble import Ensemble, simulate_members
from abu_calc.parallel import Workers
from abu_calc.progress import Progress, silent
from abu_calc.sizing import instead
from abu_calc.sizing.balls import Candidate, sound
from abu_calc.sizing.design import Design

MOST_OTHERS = 3
"""Candidates that are tried when the best one does not pass."""

DRAGS = (3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0)
"""Drags [1/s] of oils and greases, of which those nearest to the drag given are tried as a remedy."""
MOST_DRAGS, NEAR = 5, 1.2
"""How many are tried, and the factor within which another drag is none."""


@dataclass(frozen=True)
class Proven:
    """A design, what its starts show (None: its balls cannot carry the imbalance), and what was tried beside it."""

    design: Design
    ensemble: Ensemble | None
    remedy: str | None = None
    warnings: tuple[str, ...] = ()


def proven(
    design: Design, doubtful: float = 0.0, accuracy: float = 0.01, progress: Progress = silent,
    workers: Workers | None = None,
) -> Proven:  # fmt: skip
    """The best candidate if it passes from every start at the drag given, else the next one that does.

    If none does, the best one, with the first change of the drag that would make it pass. `doubtful`: see `members`.
    """
    if not _carries(design):
        return Proven(design, None)
    first = simulate_members(design, doubtful, accuracy, progress, workers)
    if passes(design, first) or not design.frequency.balancing_possible:
        return Proven(design, first)
    for one in [each for each, _ in design.choice.runners_up if sound(design.case, each)][:MOST_OTHERS]:
        other = instead(design, one, "does not balance from every start")
        progress(f"idle: {_words(one)} instead")
        found = simulate_members(other, doubtful, accuracy, silent, workers)
        if passes(other, found):
            text = f"{_words(design.autobalancer)}, the best by weight, does not pass from every start; this one does."
            return Proven(other, found, warnings=(text,))
    return Proven(design, first, _remedy(design, first, doubtful, accuracy, progress, workers))


def passes(design: Design, ensemble: Ensemble) -> bool:
    """Whether every start at the drag given balances, in time and within the level."""
    limits, level = design.case.table.limits, design.case.level_limit
    lost = any(one.member.drag == ensemble.drag for one in ensemble.lost)
    return not lost and all(one.time <= limits.settling_time_s and one.level <= level for one in ensemble.given)


def _carries(design: Design) -> bool:
    one = design.autobalancer
    return one.capacity >= design.imbalance.value * abs(one.requirement.plane_ratio)


def _remedy(
    design: Design, first: Ensemble, doubtful: float, accuracy: float, progress: Progress, workers: Workers | None
) -> str:  # fmt: skip
    """A drag with which every start passes, or that none was found."""
    tried = _other_drags(design.case.drag, only_more=bool(first.hanging))
    for drag in tried:
        progress(f"idle: a drag of {drag:.3g} 1/s instead")
        other = replace(design, case=replace(design.case, drag=drag))
        found = simulate_members(other, doubtful, accuracy, silent, workers, (1.0,))
        if passes(other, found):
            return f"Tried: with autobalancer.rolling_drag_per_s = {drag:.3g} all {found.members} starts pass."
    names = ", ".join(f"{drag:.3g}" for drag in sorted(tried))
    return f"Tried without success: drags of {names} 1/s. Not tried: another suspension, speed or run-up."


def _other_drags(given: float, *, only_more: bool) -> list[float]:
    """The nearest first; more drag alone where balls hang."""
    others = [drag for drag in DRAGS if drag > NEAR * given or (drag < given / NEAR and not only_more)]
    return sorted(others, key=lambda drag: max(drag / given, given / drag) if given else drag)[:MOST_DRAGS]


def _words(one: Candidate) -> str:
    return f"{one.ball_count} × Ø{1e3 * one.ball_diameter:g} mm"
