"""Changes of a file that may help start cases to balance, in time and below the level: oil, balls, run-up, damping."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import islice
from typing import Final

from abu_calc.features.design.band import turned_in_use
from abu_calc.features.design.start_rules import StartFacts
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation.errors import AbuError
from abu_calc.foundation.units import from_si
from abu_calc.inputs.duty import RunUp
from abu_calc.simulation.ensemble_results import Ensemble
from abu_calc.sizing import usable
from abu_calc.sizing.actions import pins, with_entries
from abu_calc.sizing.design import Design, built
from abu_calc.sizing.oil import FLAT, usual_oils
from abu_calc.sizing.vibration import truer_races

MOST_OTHERS: Final = 3
"""Runners-up that are tried where a listed start case fails."""
MOST_OILS: Final = (6, 3)
"""Oils of each viscosity index that are tried."""
FASTER, DAMPED = 0.5, 2.0
"""Factors on the time of the run-up and on the damping of the suspension."""
BEFORE: Final = 2
"""Oils that are tried before what leaves the oil as it is."""
BELOW, LEAST = 2 / 3, 0.05
"""Share of the stalling speed to which the rotor is slowed, and least stalling speed, as a share of the rotor's speed.
Slower balls hardly turn.
"""


def design_with(design: Design, entries: Mapping[str, object]) -> Design | None:
    """A design with entries of its file replaced, its balls and race pinned; None if the file refuses them."""
    try:
        table = with_entries(design.case.table, {**entries, **pins(design.autobalancer)})
        return replace(built(design, table), swing_arm=design.swing_arm)
    except (AbuError, ValueError):
        return None


def changes_for_starts(facts: StartFacts, *, loud: bool) -> Iterator[dict[str, object]]:
    """Changes for start cases, each with the balls and the race that it was tried with.

    Another oil, other balls if a listed start case fails, a temporary speed reduction if balls stall, a
    faster run-up if run-ups alone fail, more damping, a truer race; this first if start cases are too `loud`.
    """
    design, ensemble = facts.design, facts.ensemble
    if ensemble is None:
        return
    table = design.case.table
    oils = list(_other_oils(facts))
    truer = list(truer_races(design.case, design.eccentricity.least))
    ways = [*truer, *oils[:BEFORE]] if loud else oils[:BEFORE]
    if not facts.listed_pass:
        others = (runner_up for runner_up, _ in design.choice.runners_up if usable(design.case, runner_up))
        ways += map(pins, islice(others, MOST_OTHERS))
    bad = [start for start in ensemble.given if not start.balanced]
    ways += _pause(design, ensemble)
    if table.run_up and not table.motor and bad and all(start.member.run_up for start in bad):
        ways.append({"run_up.time_s": _rounded(FASTER * table.run_up.time_s)})
    ways += filter(None, [more_damping(design)])
    ways += oils[BEFORE:] if loud else [*oils[BEFORE:], *truer]
    yield from ({**pins(design.autobalancer), **entries} for entries in ways)


def more_damping(design: Design) -> dict[str, object] | None:
    """Entries that double the damping of springs; None for another suspension, and for hands, which nobody sets."""
    dampings = design.case.table.suspension.dampings
    if dampings is None or not isinstance(design.case.suspension, Springs) or turned_in_use(design):
        return None
    return {"suspension.damping_ratios": [float(f"{DAMPED * damping:.6g}") for damping in dampings]}


def _pause(design: Design, ensemble: Ensemble) -> Iterator[dict[str, object]]:
    """Temporary speed reduction that brings stalled balls to rest in their race.

    The rotor is slowed below the speed at which the balls stall, then speeds up again as in a run-up. Above that speed
    the balls go on stalling, the more so the nearer the rotor is to it. None for a motor, which sets its own pace, for
    balls that hardly turn, and if that speed is in the working range.
    """
    table, speed = design.case.table, design.case.speed
    caught = min(((1 - run.slip) * (run.member.speed or speed) for run in ensemble.given if run.hanging), default=0.0)
    given = table.run_up or RunUp()
    low, lowest = _rounded(from_si(BELOW * caught, "rpm")), from_si(design.case.speed_range[0], "rpm")
    if table.motor or caught < LEAST * speed or low >= min(given.pause_speed_rpm or math.inf, lowest):
        return
    rise = _rounded((1 - low / from_si(speed, "rpm")) * given.time_s)
    yield {"run_up.pause_speed_rpm": low, "run_up.pause_rise_s": rise}


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def _other_oils(facts: StartFacts) -> Iterator[dict[str, object]]:
    """Other oils, the nearest first, also in place of a drag rate that the file gives.

    More viscous ones alone if balls stall, or if only start cases in hot oil fail; less viscous ones if only those in
    cold oil do.
    """
    design, ensemble = facts.design, facts.ensemble
    case, limits = design.case, design.case.table.limits
    assert ensemble is not None
    bad = [run.member.drag for run in ensemble.outcomes if not run.holds(limits, case.level_limit)]
    more, less = bool(ensemble.hanging) or max(bad, default=case.drag) < case.drag, min(bad, default=0.0) > case.drag
    oils = [(entries, drag) for entries, drag in usual_oils(case, design.autobalancer)
            if not ((more and drag < case.drag) or (less and drag > case.drag))]  # fmt: skip
    for index, most in zip(FLAT, MOST_OILS, strict=True):
        yield from islice((entries for entries, _ in oils if entries["oil.viscosity_index"] == index), most)
