"""Study behind `abu size` of a machine with two races: sizing, stability, start cases, checks."""

import math
import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.two_races.case import TwoRaceCase, read_case
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.records import (
    OneRace,
    PlaceOnSpindleLevel,
    TwoRaceAutobalancer,
    TwoRaceEnsemble,
    TwoRaceFrequency,
    TwoRaceSizeResult,
    TwoRaceSpread,
    TwoRaceVibration,
)
from abu_calc.features.two_races.start_cases import (
    PHASES,
    STILL,
    LostRun,
    TwoRaceRun,
    run_of,
    stability_scene,
    start_cases,
)
from abu_calc.formulas.balls import half_angle
from abu_calc.formulas.two_races import (
    PlacedImbalance,
    mode_margin,
    one_race_limit,
    one_race_resultant,
    two_races_balance,
)
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted, silent
from abu_calc.foundation.units import from_si, level_from_velocity
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.result import Provenance

ONE_RACE_PLACES: Final = 9
"""Places of a single race that are tried between both races."""
SMALL_PLACE: Final = 1e-12
"""Displacement [m] that counts as none."""


@dataclass(frozen=True)
class Stable:
    """Stability at one speed [rad/s]: by the sufficient rule (`growth` None) or by eigenvalues [1/s]."""

    speed: float
    stable: bool | None
    growth: float | None
    reason: str = ""


def size_two_races(
    machine: Machine, accuracy: float = 0.01, progress: Progress = silent, workers: int = 1
) -> TwoRaceSizeResult:
    """Size both autobalancers, judge stability, and simulate start cases over the unknown phases.

    Raises InputError with file, line and key for what cannot be made, and if the file has one race.
    """
    table = machine.two_races
    if table is None:
        raise InputError("this file has one race", remedy="Use `abu size FILE`.")
    with machine.located():
        design = choose_both(read_case(table))
    speeds = dict.fromkeys((*design.case.speed_range, design.case.speed))
    above = all(two_races_balance(design.case.rotor, speed) for speed in speeds)
    judged = tuple(_stability(design, speed) for speed in speeds) if above else ()
    runs = tuple(_runs(design, max(accuracy, 0.05), progress, workers)) if above else ()
    one = _one_race(design)
    known = [run for run in runs if isinstance(run, TwoRaceRun)]
    vibration = _vibration(design.case, known)
    return TwoRaceSizeResult(
        title=table.machine.name,
        checks=(
            _region(design, one),
            *_stable_check(design, judged),
            *_capacities(design),
            *_of_races(design),
            *_masses(design),
            *_levels(design, vibration, known),
            *_starts(design, runs),
        ),
        warnings=tuple(dict.fromkeys((*machine.warnings, *_notes(design, one)))),
        provenance=Provenance.of(machine),
        system_mass_kg=design.system_mass,
        frequency=_frequency(design, judged, above),
        imbalances_g_mm=tuple(from_si(abs(wheel.imbalance), "g_mm") for wheel in design.case.wheels),
        required_capacity_g_mm=from_si(design.races[0].need, "g_mm"),
        autobalancer=TwoRaceAutobalancer.of_race(design, 0),
        autobalancers=tuple(TwoRaceAutobalancer.of_race(design, index) for index in (0, 1)),
        one_race=one,
        vibration=vibration,
        ensemble=_ensemble(runs),
    )


def _runs(design: TwoRaceDesign, accuracy: float, progress: Progress, workers: int) -> Iterator[TwoRaceRun | LostRun]:
    tasks = [(design, start, accuracy) for start in start_cases(design)]
    for index, run in enumerate(side_by_side(run_of, tasks, workers, counted(progress, "{} of {} starts", len(tasks)))):
        yield LostRun(tasks[index][1], "the time of --patience was over") if patience.over() else run


def _stability(design: TwoRaceDesign, speed: float) -> Stable:
    """The sufficient rule for every forward whirl; where it does not hold, eigenvalues at phases of the imbalances."""
    case = design.case
    balls = [PlacedImbalance(place, mass) for place, mass in zip(case.races, design.ball_masses, strict=True)]
    modes = case.rotor.forward_modes(speed)
    slower = [mode for mode in modes if mode.frequency < speed]
    margins = [mode_margin(mode, balls, speed, drag, case.inertia_factor) for mode in slower for drag in case.drags]
    if margins and len(slower) == len(modes) and all(margin.holds for margin in margins):
        return Stable(speed, True, None)
    growths: list[float] = []
    for phase in PHASES if case.unknown_phases else (0.0,):
        phases = tuple(phase * k for k in range(1, case.unknown_phases + 1))
        scene = replace(stability_scene(design, phases), speed=speed)
        abu = design.races[0].design.autobalancer
        try:
            found = stability(scene, half_angle(abu.ball_diameter / 2, abu.pitch_radius))
        except NotTrustworthyError as error:
            return Stable(speed, None, None, str(error).splitlines()[0])
        if found.growth_rate is None:
            return Stable(speed, found.stable, None, found.reason or "")
        growths.append(found.growth_rate)
    return Stable(speed, max(growths) < 0, max(growths))


def _region(design: TwoRaceDesign, one: OneRace | None) -> Check:
    case = design.case
    critical = max(case.rotor.critical_speeds(), default=0.0)
    balances = all(two_races_balance(case.rotor, speed) for speed in case.speed_range)
    limit = one.limit_to_place_mm if one is not None else None
    if case.rotor.forward_inertia <= 0:
        remedy = "A rotor with a larger polar than transverse inertia takes one race: remove one [[autobalancer]]."
    elif limit is not None:
        remedy = f"Raise the speed, soften the bearings, or use one race within {limit:.4g} mm of the centre of mass."
    else:
        remedy = "Raise the speed, or soften the bearings."
    return coded(
        "ABU101", verdict(balances), "Balls in two races balance above both critical speeds only",
        from_si(min(case.speed_range), "hz"), from_si(critical, "hz"), "Hz", None if balances else remedy, "least",
    )  # fmt: skip


def _stable_check(design: TwoRaceDesign, judged: Sequence[Stable]) -> Iterator[Check]:
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
    speed = f"{from_si(worst.speed, 'rpm'):.6g} rpm"
    passed = all(each.stable for each in judged)
    yield coded(
        "ABU103", verdict(passed), f"Fastest-growing disturbance of the balanced state, at {speed}", worst.growth, 0.0,
        "1/s", None if passed else "Raise rolling_drag_per_s of both races, or damp the bearings.",
    )  # fmt: skip


def _capacities(design: TwoRaceDesign) -> Iterator[Check]:
    for number, race in enumerate(design.races, 1):
        table = design.case.table.autobalancer[number - 1]
        needed = race.need * table.capacity_margin
        passed = race.design.autobalancer.capacity >= needed * (1 - 1e-9)
        yield coded(
            "ABU201", verdict(passed),
            f"{race.design.autobalancer.ball_count} balls must carry the required capacity of the worst phase times "
            f"the margin {table.capacity_margin:g}", from_si(race.design.autobalancer.capacity, "g_mm"),
            from_si(needed, "g_mm"), "g·mm",
            None if passed else f"Increase max_outer_diameter_mm or max_width_mm of [[autobalancer]] {number}.",
            "least", of=f"race {number}",
        )  # fmt: skip


def _of_races(design: TwoRaceDesign) -> Iterator[Check]:
    """Checks of each race by itself; their actions were tried on one race, so they are left out here."""
    for number, race in enumerate(design.races, 1):
        for check in race.design.checks:
            remedy = None if check.status == "pass" else "Change the keys of that [[autobalancer]]; see `abu explain`."
            yield replace(check, name=f"{check.name}, race {number}", remedy=remedy, overrides=())


def _masses(design: TwoRaceDesign) -> Iterator[Check]:
    machine = design.case.table.machine.mass_kg
    for number, (race, table) in enumerate(zip(design.races, design.case.table.autobalancer, strict=True), 1):
        share = race.design.autobalancer.mass / machine
        passed = share <= table.max_mass_fraction
        yield coded(
            "ABU203", verdict(passed), "The autobalancer with its balls takes this share of the machine's mass",
            100 * share, 100 * table.max_mass_fraction, "%",
            None if passed else f"Balance the wheels better, or raise max_mass_fraction of [[autobalancer]] {number}.",
            of=f"race {number}",
        )  # fmt: skip


def _level(displacement: float, speed: float) -> float:
    return level_from_velocity(max(displacement, SMALL_PLACE) * speed / math.sqrt(2))


def _vibration(case: TwoRaceCase, runs: Sequence[TwoRaceRun]) -> TwoRaceVibration:
    """Levels at every place: without autobalancers at the worst of the phases, with them over the start cases."""
    given = [run for run in runs if run.case.drag_factor == 1 and run.balances]
    rows = []
    for index, held in enumerate(case.places):
        without = sum(abs(case.rotor.whirl(held.place, [wheel], case.speed)) for wheel in case.wheels)
        if not case.unknown_phases:
            without = abs(case.rotor.whirl(held.place, case.turned(()), case.speed))
        medians = [run.displacements[index] for run in given]
        rows.append(
            PlaceOnSpindleLevel(
                name=held.name,
                level_before_db=_level(without, case.speed),
                level_after_db=_level(statistics.median(medians), case.speed) if medians else None,
                level_after_worst_db=_level(max(run.displacements[index] for run in runs), case.speed)
                if runs
                else None,
            )
        )
    before = max(row.level_before_db for row in rows)
    after = _largest([row.level_after_db for row in rows])
    return TwoRaceVibration(
        level_before_db=before,
        level_after_db=after,
        level_after_worst_db=_largest([row.level_after_worst_db for row in rows]),
        reduction_db=None if after is None else before - after,
        handles=tuple(rows),
    )


def _largest(values: Sequence[float | None]) -> float | None:
    return max((value for value in values if value is not None), default=None)


def _levels(design: TwoRaceDesign, vibration: TwoRaceVibration, runs: Sequence[TwoRaceRun]) -> Iterator[Check]:
    limit = design.case.table.limits.vibration_level_db
    if vibration.level_after_db is None:
        yield coded("ABU401", "not-done", "No start case balances, so no level is known", remedy="See ABU701.")
        return
    given = max(
        _level(max(run.displacements), design.case.speed) for run in runs if run.case.drag_factor == 1
    )  # fmt: skip
    loudest = max(_level(max(run.displacements), design.case.speed) for run in runs)
    passed, safe = given <= limit, loudest <= limit
    yield coded(
        "ABU401", verdict(passed, safe),
        "Level at the loudest place with the autobalancers, loudest start case at the given drag rate"
        + ("" if safe else f"; in hot or cold oil {loudest:.1f} dB"), given, limit, "dB",
        None if passed and safe else "Reduce race_eccentricity_mm and rolling_friction_mm of both races.",
    )  # fmt: skip
    lowered = vibration.level_after_db < vibration.level_before_db
    yield coded(
        "ABU402", verdict(lowered), "Level at the loudest place, median of the start cases, against that without",
        vibration.level_after_db, vibration.level_before_db, "dB",
        None if lowered else "The imbalances are too small for these races: use none, or races that run truer.",
    )  # fmt: skip


def _starts(design: TwoRaceDesign, runs: Sequence[TwoRaceRun | LostRun]) -> Iterator[Check]:
    if not runs:
        for code in ("ABU701", "ABU702", "ABU704"):
            yield coded(code, "not-done", "Not simulated below a critical speed", remedy="See ABU101.")
        return
    lost = [run for run in runs if isinstance(run, LostRun)]
    if lost:
        text = f"{len(lost)} of {len(runs)} start cases gave no answer: {lost[0].reason}"
        for code in ("ABU701", "ABU702", "ABU704"):
            yield coded(code, "not-done", text, remedy="Allow more time: --patience.")
        return
    known = [run for run in runs if isinstance(run, TwoRaceRun)]
    given, limit = [run for run in known if run.case.drag_factor == 1], design.case.table.limits.settling_time_s
    bad = [run for run in given if not run.balances]
    elsewhere = [run for run in known if not run.balances and run.case.drag_factor != 1]
    yield coded(
        "ABU701", verdict(not bad, not elsewhere), "Start cases in which both races balance, at the given drag rate"
        + (f"; not: {bad[0].case.name}" if bad else "") + (f"; not in all oils: {elsewhere[0].case.name}" if elsewhere else ""),
        float(len(given) - len(bad)), float(len(given)), None,
        "Raise rolling_drag_per_s of both races, or the distance from the critical speeds." if bad or elsewhere else None,
        "least",
    )  # fmt: skip
    slow, slowest = _slowest(given), _slowest(known)
    in_time = slow is not None and slow[0] <= limit
    all_in_time = slowest is not None and slowest[0] <= limit
    yield coded(
        "ABU702", verdict(in_time, all_in_time),
        "Slowest start case at the given drag rate" + (f": {slow[1].case.name}" if slow else " does not settle")
        + ("" if all_in_time or slowest is None else f"; in hot or cold oil {slowest[0]:.2f} s"),
        None if slow is None else slow[0], limit, "s",
        None if in_time and all_in_time else "Change rolling_drag_per_s, use heavier balls, or permit a longer settling time.",
    )  # fmt: skip
    stalled = [run for run in known if run.slip > STILL]
    at_given = [run for run in stalled if run.case.drag_factor == 1]
    yield coded(
        "ABU704", verdict(not at_given, not stalled), "Start cases that leave balls stalled"
        + (f": {stalled[0].case.name}" if stalled else ""), float(len(stalled)), 0.0, None,
        "Raise rolling_drag_per_s of both races, or run up faster." if stalled else None,
    )  # fmt: skip


def _slowest(runs: Sequence[TwoRaceRun]) -> tuple[float, TwoRaceRun] | None:
    """Longest settling time [s] and its run; None if one does not settle."""
    if any(run.settling_time is None for run in runs):
        return None
    run = max(runs, key=lambda each: each.settling_time or 0.0)
    return run.settling_time or 0.0, run


def _ensemble(runs: Sequence[TwoRaceRun | LostRun]) -> TwoRaceEnsemble | None:
    known = [run for run in runs if isinstance(run, TwoRaceRun)]
    if not known:
        return None
    times = [run.settling_time for run in known]
    settled = [time for time in times if time is not None]
    slow = _slowest(known)
    return TwoRaceEnsemble(
        members=len(runs),
        balanced=sum(run.balances for run in known),
        hanging=sum(run.slip > STILL for run in known),
        lost=len(runs) - len(known),
        settling_time_s=TwoRaceSpread(
            typical=statistics.median(settled) if len(settled) == len(times) else None,
            worst=None if slow is None else slow[0],
        ),
        slowest=None if slow is None else slow[1].case.name,
    )


def _frequency(design: TwoRaceDesign, judged: Sequence[Stable], above: bool) -> TwoRaceFrequency:
    case = design.case
    critical = case.rotor.critical_speeds()
    below = [speed for speed in critical if speed < min(case.speed_range)]
    region = "supercritical" if above else "between" if below else "subcritical"
    growths = [each.growth for each in judged if each.growth is not None]
    states = [each.stable for each in judged]
    return TwoRaceFrequency(
        speed_hz=from_si(case.speed, "hz"),
        critical_speeds_rpm=tuple(from_si(speed, "rpm") for speed in critical),
        region=region,
        balancing_possible=above,
        stable=None if not states or None in states else all(states),
        growth_rate_per_s=max(growths) if growths else None,
    )


def _one_race(design: TwoRaceDesign) -> OneRace | None:
    """The single race between both races that leaves the least at the loudest place; None if none balances."""
    case = design.bare
    limit = one_race_limit(case.rotor, case.speed)
    turns = [tuple(phase * k for k in range(1, case.unknown_phases + 1)) for phase in PHASES]
    tried: list[tuple[float, float]] = []
    first, second = case.races
    for step in range(ONE_RACE_PLACES):
        place = first + (second - first) * step / (ONE_RACE_PLACES - 1)
        if not case.rotor.receptance(place, place, case.speed).real < 0:
            continue
        loudest = 0.0
        for phases in turns:
            wheels = case.turned((0.0, *phases) if all(angle is None for angle in case.angles) else phases)
            whole = [*wheels, PlacedImbalance(place, one_race_resultant(case.rotor, place, wheels, case.speed))]
            loudest = max([loudest, *(abs(case.rotor.whirl(held.place, whole, case.speed)) for held in case.places)])
        tried.append((loudest, place))
    if not tried:
        return None
    rest, place = min(tried)
    level = _level(rest + case.eccentricity, case.speed)
    return OneRace(
        plane_mm=from_si(place, "mm"),
        level_db=level,
        limit_to_place_mm=None if limit is None else from_si(limit, "mm"),
        enough=level <= case.table.limits.vibration_level_db,
    )


def _notes(design: TwoRaceDesign, one: OneRace | None) -> Iterator[str]:
    limit = design.case.table.limits.vibration_level_db
    if one is not None and one.enough:
        yield (
            f"One race at {one.plane_mm:.4g} mm leaves {one.level_db:.1f} dB at the worst phase (calculated, limit "
            f"{limit:g} dB): the second race may not be needed"
        )
    for number, race in enumerate(design.races, 1):
        outside = [share for share in race.shares if not -1e-9 <= share <= 1 + 1e-9]
        if outside:
            yield (
                f"Race {number} carries {max(outside, key=abs):.2f} times the imbalance of a wheel that lies outside "
                "both races: move the races apart"
            )
    yield "Housings of both autobalancers are taken to leave the centre of mass in its place"
    yield "Grinding, hands, and levels off the spindle axis are not modelled with two races"
