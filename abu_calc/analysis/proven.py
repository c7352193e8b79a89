"""The design whose starts all balance: the first of the candidates that does, and remedies that were tried."""

from dataclasses import replace
from itertools import islice

from abu_calc import patience
from abu_calc.analysis.covering import Searched, search
from abu_calc.analysis.ensemble import simulate_members
from abu_calc.analysis.outcomes import Ensemble
from abu_calc.analysis.remedies import passes, remedy
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent, within
from abu_calc.sizing import instead
from abu_calc.sizing.balls import Candidate, sound
from abu_calc.sizing.design import Design

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
    searched: Searched | None = None
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
