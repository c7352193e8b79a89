"""A change of the file that makes all start cases pass, found by simulating them: another drag rate, heavier balls."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Final, NamedTuple

from abu_calc.features.two_races.checks import slowest
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.start_cases import StartCase, TwoRaceRun, run_of, start_cases
from abu_calc.foundation.checks import Action
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted
from abu_calc.foundation.units import from_si
from abu_calc.standards.balls import stock_diameters

FACTORS: Final = (2.0, 0.5, 3.0)
"""Factors on the given viscous drag rates that are tried."""
LARGER: Final = (1.2, 1.45, 1.75)
"""Least factors on the diameter of the balls that are tried."""


class Change(NamedTuple):
    """A design with entries of its file changed, alike for both races: key of [[autobalancer]] to value."""

    design: TwoRaceDesign
    entries: dict[str, float]

    @property
    def text(self) -> str:
        """The entries as a sentence begins with them."""
        return " and ".join(f"{key} = {value:g}" for key, value in self.entries.items())


def changed(design: TwoRaceDesign, entries: dict[str, float]) -> Change | None:
    """The machine sized anew with these entries in both tables; None if it then breaks a limit, or cannot be made."""
    tables = tuple(race.model_copy(update=entries) for race in design.bare.table.autobalancer)
    table = design.bare.table.model_copy(update={"autobalancer": tables})
    case = replace(design.bare, table=table)
    try:
        sized = choose_both(case)
    except InputError:
        return None
    for race, room in zip(sized.races, tables, strict=True):
        light = race.design.autobalancer.mass <= room.max_mass_fraction * table.machine.mass_kg
        carries = race.design.autobalancer.capacity >= race.need * room.capacity_margin * (1 - 1e-9)
        if not (light and carries and all(check.status == "pass" for check in race.design.checks)):
            return None
    return Change(sized, entries)


def _changes(design: TwoRaceDesign) -> Iterator[Change]:
    """Drag rates first, then larger balls of the stock, with the given drag rate and twice that."""
    drag = max(design.case.drags)
    for factor in FACTORS:
        if change := changed(design, {"rolling_drag_per_s": _rounded(drag * factor)}):
            yield change
    diameter = design.races[0].design.autobalancer.ball_diameter
    stock = stock_diameters(design.case.table.autobalancer[0].ball_sizes)
    for factor in LARGER:
        larger = next((size for size in stock if size >= factor * diameter), None)
        if larger is None:
            return
        ball = {"ball_diameter_mm": round(from_si(larger, "mm"), 6)}
        for entries in (ball, {**ball, "rolling_drag_per_s": _rounded(2 * drag)}):
            if change := changed(design, entries):
                yield change


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def tried_change(
    design: TwoRaceDesign, late: StartCase, before: float | None, accuracy: float, progress: Progress, workers: int
) -> Action | None:
    """The first change at which every start case balances in time; None if none of those tried does.

    `late`: the slowest start case, which is tried first, `before`: its settling time [s] if it settles.
    """
    limit = design.case.table.limits.settling_time_s
    for change in _changes(design):
        first = run_of(change.design, late, accuracy)
        if not isinstance(first, TwoRaceRun) or first.settling_time is None or first.settling_time > limit:
            continue
        tasks = [(change.design, start, accuracy) for start in start_cases(change.design)]
        counting = counted(progress, f"{change.text}: {{}} of {{}} starts", len(tasks))
        runs = list(side_by_side(run_of, tasks, workers, counting))
        known = [run for run in runs if isinstance(run, TwoRaceRun) and run.balances]
        slow = slowest(known) if len(known) == len(runs) else None
        if slow is None or slow[0] > limit:
            continue
        was = "" if before is None else f"from {before:.2f} "
        return Action(
            f"Set {change.text} in both [[autobalancer]] tables: the slowest start case falls {was}to {slow[0]:.2f} s "
            f"(simulated). All {len(runs)} start cases, hot and cold oil included, then pass.",
            tuple(f"autobalancer.{race}.{key}={value:g}" for race in (0, 1) for key, value in change.entries.items()),
        )
    return None
