"""Trials of changes to the file with which the best candidate meets its missed requirements.

The same search tries each of them.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.units import from_si
from abu_calc.sizing.balls import Candidate, choose, sound
from abu_calc.sizing.case import Case

ROOM = (1.1, 1.25, 1.5)
"""Factors on the envelope."""
WALLS = (1.5, 2.0, 3.0)
"""Factors on the least wall."""
HARDEST = 63.0
"""Hardness of a ground race, at most [HRC]."""
PINS = "ball_count", "ball_diameter_mm", "race_radius_mm"

Holds = Callable[[Case, Candidate], bool]
Change = tuple[str, Case]


def remedy(case: Case, imbalance: float, changes: Iterator[Change], holds: Holds) -> str:
    """The first change with which the search finds a candidate that falls short of nothing, else of this alone."""
    tried, partly = [], ""
    for words, other in changes:
        try:
            candidate = choose(other, imbalance).best
        except AbuError:  # no race fits: no remedy
            continue
        tried.append(words)
        trial = f"Tried: with {words}, {_balls(candidate)}"
        if sound(other, candidate):
            return f"{trial} holds it, and what else is asked of the autobalancer."
        if holds(other, candidate) and not partly:
            partly = f"{trial} holds it, though not all else."
    return partly or (f"Tried without success: {'; '.join(tried)}." if tried else "What can be changed was not found.")


def more_room(case: Case) -> Iterator[Change]:
    """The search free of what is pinned, then less margin, then a larger envelope with it free."""
    yield from _unpinned(case)
    if case.autobalancer.capacity_margin > 1:
        yield "capacity_margin = 1", _with(case, capacity_margin=1.0)
    free = dict.fromkeys(PINS)
    word = ", nothing pinned" if _pinned(case) else ""
    for more in ROOM:
        across, along = (round(more * size, 1) for size in (case.autobalancer.max_outer_diameter_mm,
                                                            case.autobalancer.max_width_mm))  # fmt: skip
        words = f"max_outer_diameter_mm = {across:g}, max_width_mm = {along:g}{word}"
        yield words, _with(case, max_outer_diameter_mm=across, max_width_mm=along, **free)


def lighter(case: Case) -> Iterator[Change]:
    """The search free of what is pinned, the light design, less margin."""
    yield from _unpinned(case)
    if case.autobalancer.design != "light":
        yield 'design = "light"', _with(case, design="light")
    if case.autobalancer.capacity_margin > 1:
        yield "capacity_margin = 1", _with(case, capacity_margin=1.0)


def rounder(case: Case) -> Iterator[Change]:
    """A thicker wall, another body, the search free of what is pinned."""
    for more in WALLS:
        wall = round(more * case.autobalancer.min_wall_mm, 2)
        yield f"min_wall_mm = {wall:g}", _with(case, min_wall_mm=wall)
    yield from stronger(case)


def harder(case: Case) -> Iterator[Change]:
    """A harder race, the search free of what is pinned."""
    if case.autobalancer.race_hardness_HRC < HARDEST:
        yield f"race_hardness_HRC = {HARDEST:g}", _with(case, race_hardness_HRC=HARDEST)
    yield from _unpinned(case)


def stronger(case: Case) -> Iterator[Change]:
    """A body of steel, the search free of what is pinned."""
    if case.autobalancer.design == "light":
        yield 'design = "one-piece"', _with(case, design="one-piece")
    yield from _unpinned(case)


def _unpinned(case: Case) -> Iterator[Change]:
    if pins := _pinned(case):
        yield f"{', '.join(pins)} not pinned", _with(case, **dict.fromkeys(PINS))


def _pinned(case: Case) -> list[str]:
    return [pin for pin in PINS if getattr(case.autobalancer, pin) is not None]


def _with(case: Case, **changed: Any) -> Case:
    abu = case.autobalancer.model_copy(update=changed)
    return replace(case, autobalancer=abu, table=case.table.model_copy(update={"autobalancer": abu}))


def _balls(candidate: Candidate) -> str:
    return f"{candidate.ball_count} × Ø{from_si(candidate.ball_diameter, 'mm'):.5g} mm"
