"""Changes of the file that mend a check, each tried first: simulated, or calculated for the checks of a race."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Final, NamedTuple

from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.start_cases import FIRST_TOLERANCE, ensemble_of, start_once
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Action
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.progress import Progress, within
from abu_calc.foundation.units import from_si, to_si
from abu_calc.simulation.ensemble import MORE, WORK
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.sizing.balls import CAPACITY, MASS
from abu_calc.sizing.requirements import missed_by_race
from abu_calc.standards.balls import stock_diameters

FACTORS: Final = (2.0, 0.5, 3.0)
"""Factors on the given viscous drag rates that are tried."""
LARGER: Final = (1.2, 1.45, 1.75)
"""Least factors on the diameter of the balls that are tried."""
TRUER: Final = (0.5, 0.25)
"""Factors on race eccentricity and rolling friction that are tried."""
ROOM: Final = ("max_outer_diameter_mm", "max_width_mm")
ROOMIER: Final = (1.25, 1.6)
"""Factors on the room of both autobalancers that are tried."""
HEAVIER: Final = (0.08, 0.15)
"""Shares of the machine's mass that are tried for each autobalancer."""
MOST_WORK: Final = 2_000_000
"""Work of all start cases of changes that are tried for one check."""


class Change(NamedTuple):
    """A design with entries of its file changed, alike for both races: key of [[autobalancer]] to value."""

    design: TwoRaceDesign
    entries: dict[str, float]

    @property
    def text(self) -> str:
        """The entries as a sentence begins with them."""
        return " and ".join(f"{key} = {value:g}" for key, value in self.entries.items())

    @property
    def overrides(self) -> tuple[str, ...]:
        """The entries as `--set` takes them."""
        return tuple(f"autobalancer.{race}.{key}={value:g}" for race in (0, 1) for key, value in self.entries.items())


def missed(design: TwoRaceDesign) -> frozenset[tuple[str, int]]:
    """Names of the requirements on capacity, mass and the races by themselves that are missed, each with its race."""
    table, names = design.case.table, set[tuple[str, int]]()
    for index, (race, room) in enumerate(zip(design.races, table.autobalancer, strict=True)):
        made = race.design
        heavy = made.autobalancer.mass > room.max_mass_fraction * table.machine.mass_kg
        small = made.autobalancer.capacity < race.need * room.capacity_margin * (1 - 1e-9)
        own = missed_by_race(made.case, made.autobalancer, made.track) - {MASS, CAPACITY}
        names |= {(name, index) for name in (*own, *[MASS] * heavy, *[CAPACITY] * small)}
    return frozenset(names)


def changed(
    design: TwoRaceDesign, entries: dict[str, float], allowed: frozenset[tuple[str, int]] | None = None
) -> Change | None:
    """The machine sized anew with these entries in both tables; None if it cannot be made, or then breaks a limit.

    `allowed`: requirements that may be missed; None: those that are missed without the change.
    """
    tables = tuple(race.model_copy(update=entries) for race in design.bare.table.autobalancer)
    table = design.bare.table.model_copy(update={"autobalancer": tables})
    eccentricity, friction = entries.get("race_eccentricity_mm"), entries.get("rolling_friction_mm")
    case = replace(
        design.bare,
        table=table,
        eccentricity=design.bare.eccentricity if eccentricity is None else to_si(eccentricity, "mm"),
        friction_arm=design.bare.friction_arm if friction is None else to_si(friction, "mm"),
    )
    try:
        sized = choose_both(case, advised=False)
    except InputError:
        return None
    if not missed(sized) <= (missed(design) if allowed is None else allowed):
        return None
    return Change(sized, entries)


def _quicker(design: TwoRaceDesign) -> Iterator[Change]:
    """Drag rates first, then larger balls of the stock, with the given drag rate and twice that."""
    drag = design.case.drag
    for factor in FACTORS:
        if change := changed(design, {"rolling_drag_per_s": _rounded(drag * factor)}):
            yield change
    for larger in _larger(design):
        ball = {"ball_diameter_mm": larger}
        for entries in (ball, {**ball, "rolling_drag_per_s": _rounded(2 * drag)}):
            if change := changed(design, entries):
                yield change


def _larger(design: TwoRaceDesign) -> Iterator[float]:
    """Diameters [mm] of larger balls in stock."""
    diameter = design.races[0].design.autobalancer.ball_diameter
    stock = stock_diameters(design.case.table.autobalancer[0].ball_sizes)
    for factor in LARGER:
        if larger := next((size for size in stock if size >= factor * diameter), None):
            yield round(from_si(larger, "mm"), 6)


def _quieter(design: TwoRaceDesign) -> Iterator[Change]:
    """Truer races, cleaner races, both; then other drag rates."""
    given = design.bare.table.autobalancer[0]
    keys = [key for key in ("race_eccentricity_mm", "rolling_friction_mm") if getattr(given, key) > 0]
    for factor in TRUER:
        for chosen in (*((key,) for key in keys), tuple(keys)):
            entries = {key: _rounded(getattr(given, key) * factor) for key in chosen}
            if entries and (change := changed(design, entries)):
                yield change
    for factor in FACTORS:
        if change := changed(design, {"rolling_drag_per_s": _rounded(design.case.drag * factor)}):
            yield change


def _sturdier(design: TwoRaceDesign) -> Iterator[Change]:
    """Truer and cleaner races, the next larger ball, more room, a larger share of the mass; then all of them."""
    tables = design.bare.table.autobalancer
    larger = next(_larger(design), None)
    truer = [
        {key: _rounded(getattr(tables[0], key) * factor) for key in ("race_eccentricity_mm", "rolling_friction_mm")}
        for factor in TRUER
    ]
    rooms = [
        {key: _rounded(max(getattr(table, key) for table in tables) * factor) for key in ROOM} for factor in ROOMIER
    ]
    heavier = [{"max_mass_fraction": share} for share in HEAVIER]
    balls = [] if larger is None else [{"ball_diameter_mm": larger}]
    together = [{**room, **heavier[-1]} for room in rooms] + [{**truer[0], **rooms[0]}]
    for entries in (*truer, *balls, *rooms, *heavier, *together):
        if change := changed(design, entries, frozenset()):
            yield change


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def tried_change(
    design: TwoRaceDesign, before: Ensemble, accuracy: float, progress: Progress, workers: int
) -> Action | None:
    """The first change at which every start case balances in time; None if none of those tried does."""
    slow, limits = max(before.outcomes, key=lambda run: run.quiet_time_or_inf), design.case.table.limits

    def in_time(run: StartOutcome) -> bool:
        """True if the run balances within the limit."""
        return run.balanced and run.in_time(limits)

    mended = _mended(design, _quicker(design), before, in_time, accuracy, progress, workers)
    if mended is None:
        return None
    change, after = mended
    was = "" if slow.quiet_time is None else f"from {slow.quiet_time:.2f} "
    return Action(
        f"Set {change.text} in both [[autobalancer]] tables: the slowest start case falls {was}to "
        f"{max(run.quiet_time_or_inf for run in after.outcomes):.2f} s (simulated). All {after.members} start cases, "
        "hot and cold oil included, then pass.",
        change.overrides,
    )


def quieter_change(
    design: TwoRaceDesign, before: Ensemble, accuracy: float, progress: Progress, workers: int
) -> Action | None:
    """The first change at which every start case balances below the level limit; None as for `tried_change`."""
    loud, limits = max(before.outcomes, key=lambda run: run.level), design.case.table.limits

    def quiet(run: StartOutcome) -> bool:
        """True if the run balances below the limit."""
        return run.balanced and run.level <= limits.vibration_level_db

    mended = _mended(design, _quieter(design), before, quiet, accuracy, progress, workers)
    if mended is None:
        return None
    change, after = mended
    return Action(
        f"Set {change.text} in both [[autobalancer]] tables: the loudest start case falls from {loud.level:.1f} to "
        f"{max(run.level for run in after.outcomes):.1f} dB (simulated, {after.members} start cases, hot and cold oil "
        "included).",
        change.overrides,
    )


def sturdier_change(design: TwoRaceDesign) -> Action | None:
    """The first change at which capacity, mass and the own checks of both races pass, calculated; None: none does."""
    change = next(_sturdier(design), None)
    if change is None:
        return None
    return Action(
        f"Set {change.text} in both [[autobalancer]] tables: capacity, mass and strength of both races then pass "
        "(calculated).",
        change.overrides,
    )


def _mended(
    design: TwoRaceDesign, changes: Iterable[Change], before: Ensemble, passes: Callable[[StartOutcome], bool],
    accuracy: float, progress: Progress, workers: int,
) -> tuple[Change, Ensemble] | None:  # fmt: skip
    """The first change at which every start case passes, with these; those that did not `before` are tried first."""
    failed = sorted((run for run in before.outcomes if not passes(run)), key=lambda run: run.badness, reverse=True)
    left, given = MOST_WORK, design.case.drag
    for change in changes:
        other = change.design
        scale = other.case.drag / given if given else 1.0
        for run in failed:
            if left <= 0 or patience.over():
                return None
            member, work = replace(run.member, drag=scale * run.member.drag), MORE * WORK if run.member.run_up else WORK
            again = start_once(other, member, accuracy, FIRST_TOLERANCE, work, early_end=True)
            left -= again.work
            if not isinstance(again, StartOutcome) or not passes(again):
                break
        else:
            after = ensemble_of(other, accuracy, within(progress, change.text), workers)
            left -= after.work
            if not after.lost and all(map(passes, after.outcomes)):
                return change, after
    return None
