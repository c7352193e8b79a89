"""Trials of changed entries with which the best candidate meets a missed requirement; the same search tries each."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace

from abu_calc.foundation.checks import Action
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.moved import Moved
from abu_calc.sizing.actions import PINS, Followed, followed, pins, set_action, words
from abu_calc.sizing.balls import Candidate, shortfalls, sound
from abu_calc.sizing.case import Case

ROOM = (1.1, 1.25, 1.5)
"""Factors on the envelope."""
WALLS = (1.5, 2.0, 3.0)
"""Factors on the least wall."""
HARDEST = 63.0
"""Hardness of a ground race, at most [HRC]."""


@dataclass(frozen=True)
class Change:
    """Entries to replace; `free`: whether the search is free of the balls and the race that the file pins."""

    entries: dict[str, object]
    free: bool = False


@dataclass(frozen=True)
class TriedRequirement:
    """A requirement on the autobalancer: the number that decides it, as printed, and whether a candidate holds it."""

    quantity: str
    unit: str
    value: Callable[[Case, Candidate], float]
    limit: Callable[[Case, Candidate], float]
    holds: Callable[[Case, Candidate], bool]
    limit_name: str = "the limit"

    def moved(self, case: Case, candidate: Candidate, after: Followed) -> Moved:
        """The number before and after a change, or its limit if that moves more."""
        before, new = self.value(case, candidate), self.value(after.case, after.candidate)
        limit, new_limit = self.limit(case, candidate), self.limit(after.case, after.candidate)
        if abs(new_limit - limit) > abs(new - before):
            return Moved(self.limit_name, limit, new_limit, self.unit, new)
        return Moved(self.quantity, before, new, self.unit, new_limit)


_left_out: ContextVar[bool] = ContextVar("trials left out", default=False)


@contextmanager
def left_out() -> Iterator[None]:
    """No trials meanwhile, for designs whose actions nobody sees: they take hundreds of searches."""
    before = _left_out.set(True)
    try:
        yield
    finally:
        _left_out.reset(before)


ALL_HOLD = "All other requirements on the autobalancer hold."


def remedy(case: Case, present: Candidate, changes: Iterator[Change], required: TriedRequirement) -> Action:
    """The first change with which the search finds a candidate that meets every requirement, else this one alone.

    Each is followed literally: with its entries, and with the balls and the race that the search has found pinned.
    """
    if _left_out.get():
        return Action("No change was looked for.")
    tried, partly = [], None
    for change in changes:
        free = followed(_unpinned_case(case) if change.free else case, change.entries)
        after = None if free is None else followed(case, {**change.entries, **pins(free.candidate)})
        if after is None:
            continue
        shown = {**change.entries, **pins(after.candidate)} if change.free else change.entries
        tried.append(words(shown))
        complete = sound(after.case, after.candidate)
        if complete or (required.holds(after.case, after.candidate) and partly is None):
            action = set_action(shown, after.candidate, required.moved(case, present, after),
                                more=ALL_HOLD if complete else _not_all(after), present=present)  # fmt: skip
            if complete:
                return action
            partly = action
    if partly is not None:
        return partly
    return Action(f"No change was found. Calculated without success: {'; '.join(tried)}." if tried
                  else "No change of the file was found.")  # fmt: skip


def _not_all(after: Followed) -> str:
    return f"Another requirement then fails: {' and '.join(shortfalls(after.case, after.candidate))}."


def more_room(case: Case) -> Iterator[Change]:
    """The search free of what is pinned, then less margin, then a larger envelope with it free."""
    yield from _unpinned(case)
    if case.autobalancer.capacity_margin > 1:
        yield Change({"autobalancer.capacity_margin": 1.0})
    for more in ROOM:
        across, along = (round(more * size, 1) for size in (case.autobalancer.max_outer_diameter_mm,
                                                            case.autobalancer.max_width_mm))  # fmt: skip
        entries: dict[str, object] = {"autobalancer.max_outer_diameter_mm": across, "autobalancer.max_width_mm": along}
        yield Change(entries, free=_pinned(case))


def lighter(case: Case) -> Iterator[Change]:
    """The search free of what is pinned, the light design, less margin."""
    yield from _unpinned(case)
    if case.autobalancer.design != "light":
        yield Change({"autobalancer.design": "light"})
    if case.autobalancer.capacity_margin > 1:
        yield Change({"autobalancer.capacity_margin": 1.0})


def rounder(case: Case) -> Iterator[Change]:
    """A thicker wall, another body, the search free of what is pinned."""
    for more in WALLS:
        yield Change({"autobalancer.min_wall_mm": round(more * case.autobalancer.min_wall_mm, 2)})
    yield from stronger(case)


def harder(case: Case) -> Iterator[Change]:
    """A harder race, the search free of what is pinned."""
    if case.autobalancer.race_hardness_HRC < HARDEST:
        yield Change({"autobalancer.race_hardness_HRC": HARDEST})
    yield from _unpinned(case)


def stronger(case: Case) -> Iterator[Change]:
    """A body of steel, the search free of what is pinned."""
    if case.autobalancer.design == "light":
        yield Change({"autobalancer.design": "one-piece"})
    yield from _unpinned(case)


def _unpinned(case: Case) -> Iterator[Change]:
    if _pinned(case):
        yield Change({}, free=True)


def _pinned(case: Case) -> bool:
    return any(getattr(case.autobalancer, pin) is not None for pin in PINS)


def _unpinned_case(case: Case) -> Case:
    abu = case.autobalancer.model_copy(update=dict.fromkeys(PINS))
    abu = type(abu).model_validate(abu.model_dump(exclude_unset=True, exclude=set(PINS)))
    return replace(case, autobalancer=abu, table=case.table.model_copy(update={"autobalancer": abu}))
