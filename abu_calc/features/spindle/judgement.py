"""A machine with two races judged: stability, start cases over the unknown phases, levels, and all checks."""

import math
import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.design.judgement import TrialWatcher
from abu_calc.features.design.next_step import Entries, together
from abu_calc.features.design.start_rules import OF_STARTS, StartFacts, checks_of_starts
from abu_calc.features.spindle.case import SpindleCase, SpindleDesign, size_races
from abu_calc.features.spindle.records import OneRace, PlaceOnSpindleLevel, SpindleVibration
from abu_calc.features.spindle.start_cases import (
    all_phases,
    ensemble_of,
    level_of,
    scene_of,
    start_of,
)
from abu_calc.formulas.tilting_rotor import (
    PlacedImbalance,
    mode_margin,
    one_race_limit,
    one_race_resultant,
)
from abu_calc.foundation.checks import Check, Finding, coded, verdict
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.foundation.units import shown
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.start_cases import Ensemble, StartOutcome
from abu_calc.sizing.actions import overrides
from abu_calc.sizing.vibration import truer_races
from abu_calc.standards.balls import stock_diameters
from abu_calc.standards.tables import millimetres

ONE_RACE_PLACES: Final = 9
"""Places of a single race that are tried between both races."""


@dataclass(frozen=True)
class SpeedStability:
    """Stability at one speed [rad/s]: by the sufficient rule (`growth` None) or by eigenvalues [1/s]."""

    speed: float
    stable: bool | None
    growth: float | None
    reason: str = ""


@dataclass(frozen=True)
class SpindleJudgement:
    """Two autobalancers with all that was calculated and simulated of them, and the checks."""

    facts: StartFacts
    stability: tuple[SpeedStability, ...]
    one_race: OneRace | None
    vibration: SpindleVibration
    checks: tuple[Check, ...]

    @property
    def level_after(self) -> float | None:
        """Level of the loudest place [dB], median of the start cases."""
        return self.vibration.level_after_db

    @property
    def outcomes(self) -> Iterator[StartOutcome]:
        """Every start case that was simulated."""
        yield from () if self.facts.ensemble is None else self.facts.ensemble.outcomes


def judge(
    machine: Machine, accuracy: float, progress: Progress, workers: int, trial: TrialWatcher | None = None
) -> SpindleJudgement:
    """Design, simulate and judge a machine; whatever `trial` raises ends it."""
    trial = trial or TrialWatcher()
    design = size_races(machine)
    made = *capacity_checks(design), *race_checks(design), *mass_checks(design)
    trial.checked((region_check(design, None), *made))
    one = _one_race(design)
    region = region_check(design, one)
    above = design.case.balances
    judged = tuple(_stability(design, speed) for speed in design.case.speeds) if above else ()
    stable = tuple(stability_check(design, judged))
    trial.checked(stable)
    trial.repeated(design)
    ensemble = ensemble_of(design, accuracy, progress, workers, trial.seen) if above else None
    vibration = _vibration(design.case, ensemble)
    facts = facts_of(design, ensemble)
    checks = region, *stable, *made, *level_checks(design, vibration, ensemble), *checks_of_starts(facts)
    trial.checked(checks)
    return SpindleJudgement(facts, judged, one, vibration, checks)


def facts_of(design: SpindleDesign, ensemble: Ensemble | None) -> StartFacts:
    """What the start cases show; None below a critical speed, where none runs."""
    return StartFacts(
        design, ensemble, unsimulated=BELOW, advice=lambda _, status: LONGER if status == "not-done" else None
    )


def _stability(design: SpindleDesign, speed: float) -> SpeedStability:
    """The sufficient rule for every forward whirl; where it does not hold, eigenvalues at phases of the imbalances."""
    case = design.case
    modes = case.rotor.forward_modes(speed)
    slower = [mode for mode in modes if mode.frequency < speed]
    margins = [
        mode_margin(mode, design.balls(), speed, drag, case.inertia_factor) for mode in slower for drag in case.drags
    ]
    if margins and len(slower) == len(modes) and all(margin.holds for margin in margins):
        return SpeedStability(speed, True, None)
    growths: list[float] = []
    for phases in all_phases(case):
        balanced = scene_of(design, start_of(design, "spread", phases))
        scene = replace(balanced, effects=(), speed=speed)
        try:
            found = stability(scene, design.autobalancers[0].half_angle)
        except NotTrustworthyError as error:
            return SpeedStability(speed, None, None, str(error).splitlines()[0])
        if found.growth_rate is None:
            return SpeedStability(speed, found.stable, None, found.reason or "")
        growths.append(found.growth_rate)
    return SpeedStability(speed, max(growths) < 0, max(growths))


def _vibration(case: SpindleCase, ensemble: Ensemble | None) -> SpindleVibration:
    """Levels at every place: without autobalancers at the worst of the phases, with them over the start cases."""
    runs = () if ensemble is None else ensemble.outcomes
    given = [run for run in runs if run.balanced and run.member.at_nominal]
    rows = []
    for index, held in enumerate(case.places):
        without = sum(abs(case.rotor.whirl(held.place, [wheel], case.speed)) for wheel in case.wheels)
        if not case.unknown_phases:
            without = abs(case.rotor.whirl(held.place, case.turned(()), case.speed))
        medians = [run.displacements[index] for run in given]
        rows.append(
            PlaceOnSpindleLevel(
                name=held.name,
                level_before_db=level_of(without, case.speed),
                level_after_db=level_of(statistics.median(medians), case.speed) if medians else None,
                level_after_worst_db=_largest(
                    [level_of(run.displacements[index], run.member.speed or case.speed) for run in runs]
                ),
            )
        )
    before = max(row.level_before_db for row in rows)
    after = _largest([row.level_after_db for row in rows])
    return SpindleVibration(
        level_before_db=before,
        level_after_db=after,
        level_after_worst_db=_largest([row.level_after_worst_db for row in rows]),
        reduction_db=None if after is None else before - after,
        handles=tuple(rows),
    )


def _largest(values: Sequence[float | None]) -> float | None:
    return max((value for value in values if value is not None), default=None)


def _one_race(design: SpindleDesign) -> OneRace | None:
    """The single race between both races that leaves the least at the loudest place; None if none balances."""
    case = design.bare
    # The autobalancer's own mass h at its place z_r adds h to M and h·z_r² to J': together 2·h in the limit to z_r.
    own = max(made.mass for made in design.autobalancers)
    limit = one_race_limit(replace(case.rotor, mass=case.rotor.mass + 2 * own), case.speed)
    tried: list[tuple[float, float]] = []
    first, second = case.races
    for step in range(ONE_RACE_PLACES):
        place = first + (second - first) * step / (ONE_RACE_PLACES - 1)
        if not case.rotor.receptance(place, place, case.speed).real < 0 or (limit and abs(place) > limit):
            continue
        loudest = 0.0
        for phases in all_phases(case):
            wheels = case.turned((0.0, *phases) if all(angle is None for angle in case.angles) else phases)
            whole = [*wheels, PlacedImbalance(place, one_race_resultant(case.rotor, place, wheels, case.speed))]
            loudest = max([loudest, *(abs(case.rotor.whirl(held.place, whole, case.speed)) for held in case.places)])
        tried.append((loudest, place))
    if not tried:
        return None
    rest, place = min(tried)
    level = level_of(rest + case.eccentricity, case.speed)
    return OneRace(
        plane=place,
        level_db=level,
        limit_to_place=limit,
        enough=level <= case.table.limits.vibration_level_db,
    )


def region_check(design: SpindleDesign, one: OneRace | None) -> Check:
    """Whether all working speeds lie above both critical speeds."""
    case = design.case
    critical = max(case.rotor.critical_speeds(), default=0.0)
    balances = all(map(case.balances_at, case.speed_range))
    limit = one.limit_to_place_mm if one is not None else None
    if case.rotor.forward_inertia <= 0:
        remedy = "A rotor with a larger polar than transverse inertia takes one race: remove one [[autobalancer]]."
    elif limit is not None:
        remedy = f"Raise the speed, soften the bearings, or use one race within {limit:.4g} mm of the centre of mass."
    else:
        remedy = "Raise the speed, or soften the bearings."
    return coded("ABU101", verdict(balances), "Balls in two races balance above both critical speeds only",
        min(case.speed_range), critical, None if balances else remedy,
    )  # fmt: skip


def stability_check(design: SpindleDesign, judged: Sequence[SpeedStability]) -> Iterator[Check]:
    """Stability of the balanced state at the speeds judged."""
    if not judged:
        yield coded("ABU103", "not-done", "The speed is not above both critical speeds", remedy="See ABU101.")
        return
    unknown = next((each for each in judged if each.stable is None), None)
    if unknown is not None:
        yield coded("ABU103", "not-done", f"Stability is not known: {unknown.reason}", remedy="See the notes.")
        return
    worst = max(judged, key=lambda each: -math.inf if each.growth is None else each.growth)
    if worst.growth is None:
        yield coded("ABU103", "pass", "A sufficient rule holds for both whirls at every speed judged")
        return
    speed = shown(worst.speed, "rpm", ".6g")
    passed = all(each.stable for each in judged)
    yield coded("ABU103", verdict(passed), f"Fastest-growing disturbance of the balanced state, at {speed}",
        worst.growth, 0.0, None if passed else "Use a more viscous oil in both races, or damp the bearings.",
    )  # fmt: skip


def capacity_checks(design: SpindleDesign) -> Iterator[Check]:
    """Whether the balls of each race carry the required capacity times the margin."""
    for number, race in enumerate(design.races, 1):
        made, margin = race.autobalancer, race.case.autobalancer.capacity_margin
        needed = race.need * margin
        yield coded("ABU201", verdict(made.capacity >= needed * (1 - 1e-9)),
            f"{made.ball_count} balls must carry the required capacity of the worst phase times the margin {margin:g}",
            made.capacity, needed, of=f"race {number}",
        )  # fmt: skip


def race_checks(design: SpindleDesign) -> Iterator[Check]:
    """Checks of each race by itself, without the actions of one race."""
    for number, race in enumerate(design.races, 1):
        for check in race.checks:
            yield replace(check, name=f"{check.name}, race {number}", remedy=None, overrides=())


def mass_checks(design: SpindleDesign) -> Iterator[Check]:
    """The share of each autobalancer: of of the mass of the machine."""
    tables, machine = design.case.table.autobalancer, design.case.table.machine.mass_kg
    for number, (made, table) in enumerate(zip(design.autobalancers, tables, strict=True), 1):
        share, most = made.mass / machine, table.max_mass_fraction
        yield coded("ABU203", verdict(share <= most),
            "The autobalancer with its balls takes this share of the machine's mass", share, most, of=f"race {number}",
        )  # fmt: skip


def level_checks(design: SpindleDesign, vibration: SpindleVibration, ensemble: Ensemble | None) -> Iterator[Check]:
    """Levels of the loudest place against the limit, and against those without autobalancers.

    Where start cases gave no answer, what would pass is not evaluated.
    """
    limit = design.case.table.limits.vibration_level_db
    if vibration.level_after_db is None or ensemble is None:
        yield coded("ABU401", "not-done", "No start case balances, so no level is known", remedy="See ABU701.")
        return
    given, loudest = (max(run.level for run in runs) for runs in (ensemble.given, ensemble.outcomes))
    passed, safe, lost = given <= limit, loudest <= limit, len(ensemble.lost)
    known = len(ensemble.outcomes)
    partly = f"Only {known} of {ensemble.members} start cases gave a level, the loudest {loudest:.1f} dB"
    if lost and passed:
        yield coded("ABU401", "not-done", partly, remedy="See ABU701.")
    else:
        yield coded("ABU401", verdict(passed, safe),
            "Level at the loudest place with the autobalancers, loudest start case at the given drag rate"
            + ("" if safe else f"; in any oil {loudest:.1f} dB"), given, limit,
        )  # fmt: skip
    if lost:
        yield coded("ABU402", "not-done", partly, remedy="See ABU701.")
        return
    lowered = vibration.level_after_db < vibration.level_before_db
    yield coded("ABU402", verdict(lowered),
        "Level at the loudest place, median of the start cases, against that without",
        vibration.level_after_db, vibration.level_before_db,
        None if lowered else "The imbalances are too small for these races: use none, or races that run truer.",
    )  # fmt: skip


LONGER = "Allow some minutes: --patience 600 (not tried)."
"""Action where start cases gave no answer."""


BELOW: Final = Finding("not-done", "Not simulated below a critical speed", action="See ABU101.")
"""What is known of start cases where none runs."""


LARGER: Final = (1.2, 1.45, 1.75)
"""Least factors on the diameter of the balls that are tried."""
ROOM: Final = ("max_outer_diameter_mm", "max_width_mm")
ROOMIER: Final = (1.25, 1.6)
"""Factors on the room of both autobalancers that are tried."""
HEAVIER: Final = (0.08, 0.15)
"""Shares of the machine's mass that are tried for each autobalancer."""
OF_BALLS: Final = frozenset(rule.key for rule in OF_STARTS)
"""Keys of the checks for which larger balls are tried."""


def proposals(before: SpindleJudgement) -> Iterator[Entries]:
    """Changes for what does not pass: races that are made, start cases that are too loud or too slow, and pairs."""
    bad = {check.key for check in before.checks if check.requested and check.status != "pass"}
    design, of_starts = before.facts.design, list[dict[str, object]]()
    if "idle_level" in bad:
        of_starts += _truer(design)
    if bad & OF_BALLS:
        of_starts += ({"ball_diameter_mm": larger} for larger in _larger(design))
    made = [*_sturdier(design)] if bad - OF_BALLS - {"idle_level", "level_lowered"} else []
    yield from together(*([_of_all(design, entries) for entries in kind] for kind in (made, of_starts)))


def _of_all(design: SpindleDesign, entries: dict[str, object]) -> Entries:
    """Entries of each [[autobalancer]]."""
    return overrides({f"{race}.{key}": value for race in design.case.race_keys for key, value in entries.items()})


def _larger(design: SpindleDesign) -> Iterator[float]:
    """Diameters [mm] of larger balls in stock."""
    diameter, stock = design.autobalancers[0].ball_diameter, stock_diameters(design.case.autobalancer.ball_sizes)
    for factor in LARGER:
        if larger := next((size for size in stock if size >= factor * diameter), None):
            yield millimetres(larger)


def _truer(design: SpindleDesign) -> list[dict[str, object]]:
    """Less eccentric races, races with less friction, both, as far as standard fits and careful work go."""
    least = max(race.eccentricity.least for race in design.races)
    changes = truer_races(design.races[0].case, least)
    return [{key.removeprefix("autobalancer."): value for key, value in entries.items()} for entries in changes]


def _sturdier(design: SpindleDesign) -> Iterator[dict[str, object]]:
    """Truer and cleaner races, the next larger ball, more room, a larger share of the mass; then all of them."""
    tables = design.bare.table.autobalancer
    larger = next(_larger(design), None)
    races = [entries for entries in _truer(design) if len(entries) > 1]
    rooms: list[dict[str, object]] = [
        {key: _rounded(max(getattr(table, key) for table in tables) * factor) for key in ROOM} for factor in ROOMIER
    ]
    heavier: list[dict[str, object]] = [{"max_mass_fraction": share} for share in HEAVIER]
    balls: list[dict[str, object]] = [] if larger is None else [{"ball_diameter_mm": larger}]
    combined = [{**room, **heavier[-1]} for room in rooms] + [{**entries, **rooms[0]} for entries in races[:1]]
    yield from (*races, *balls, *rooms, *heavier, *combined)


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")
