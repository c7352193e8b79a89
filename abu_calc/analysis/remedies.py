"""What would make a design pass from every start: small changes of its machine, each tried before it is named."""

from collections.abc import Iterator
from dataclasses import replace

from abu_calc.analysis.ensemble import Ensemble, simulate_members
from abu_calc.formulas.suspension import Springs
from abu_calc.parallel import Workers
from abu_calc.progress import Progress, within
from abu_calc.sizing.design import Design
from abu_calc.spec.duty import RunUp

OILS = (3.0, 5.0, 8.0, 12.0, 18.0, 27.0, 40.0, 60.0)
"""Drags h₀ [1/s] of oils and greases, of which those nearest to the drag given are tried."""
MOST_DRAGS, NEAR = 5, 1.2
"""How many are tried, and the factor within which another drag is none."""

FASTER, DAMPED = 0.5, 2.0
"""Of the run-up's time, and of the suspension's damping."""


def remedy(
    design: Design, first: Ensemble, most: int, accuracy: float, progress: Progress, workers: Workers | None
) -> str | None:
    """The first change with which every start at the drag given passes; else all that were tried without success.

    `first`: the starts of the design as it is; `most`: evaluations that all trials may take, None where it is none.
    """
    tried = []
    for name, other in changes(design, first):
        if most <= 0:
            break
        found = simulate_members(other, accuracy, within(progress, f"with {name}"), workers, (1.0,))
        if passes(other, found):
            return f"Tried: with {name} all {found.members} starts pass."
        tried.append(name)
        most -= found.work
    if not tried:
        return None
    return f"Tried without success: {'; '.join(tried)}. Not tried: a pause at a lower speed after the run-up."


def changes(design: Design, first: Ensemble) -> Iterator[tuple[str, Design]]:
    """Another drag, a faster run-up where run-ups alone fail, springs with more damping."""
    case, table = design.case, design.case.table
    for drag in other_drags(case.drag, only_more=bool(first.hanging)):
        yield f"autobalancer.rolling_drag_per_s = {drag:.3g}", replace(design, case=replace(case, drag=drag))
    if table.run_up and not table.motor and all(one.member.run_up for one in first.given if not one.balanced):
        time = FASTER * table.run_up.time_s
        faster = table.model_copy(update={"run_up": RunUp(time_s=time)})
        yield f"run_up.time_s = {time:.3g}", replace(design, case=replace(case, table=faster))
    if isinstance(case.suspension, Springs):
        x, y = (DAMPED * one for one in case.suspension.damping)
        held = replace(case.suspension, damping=(x, y))
        yield "suspension.damping_ratios twice as large", replace(design, case=replace(case, suspension=held))


def other_drags(given: float, *, only_more: bool) -> list[float]:
    """The nearest first; more drag alone where balls hang."""
    others = [drag for drag in OILS if drag > NEAR * given or (drag < given / NEAR and not only_more)]
    return sorted(others, key=lambda drag: max(drag / given, given / drag) if given else drag)[:MOST_DRAGS]


def passes(design: Design, ensemble: Ensemble) -> bool:
    """Whether every start at the drag given balances, in time and within the level."""
    limits, level = design.case.table.limits, design.case.level_limit
    lost = any(one.member.drag == ensemble.drag for one in ensemble.lost)
    return not lost and all(one.time <= limits.settling_time_s and one.level <= level for one in ensemble.given)
