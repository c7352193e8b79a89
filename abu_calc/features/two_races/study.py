"""Study behind `abu size` of a machine with two races: sizing, stability, start cases, checks."""

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, cast

from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.design.records import Eccentricity, Section
from abu_calc.features.design.verdict import Verdict, benefit
from abu_calc.features.two_races.advice import missed, quieter_change, sturdier_change, tried_change
from abu_calc.features.two_races.case import TwoRaceCase, capacity_needs, read_case
from abu_calc.features.two_races.checks import (
    SpeedStability,
    capacity_checks,
    level_checks,
    mass_checks,
    race_checks,
    region_check,
    stability_check,
    start_checks,
)
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.places import arms
from abu_calc.features.two_races.records import (
    OneRace,
    PlaceOnSpindleLevel,
    TwoRaceAutobalancer,
    TwoRaceEnsemble,
    TwoRaceFrequency,
    TwoRaceResponse,
    TwoRaceRunUp,
    TwoRaceSizeResult,
    TwoRaceVibration,
)
from abu_calc.features.two_races.run_up import run_up_amplitudes
from abu_calc.features.two_races.start_cases import (
    ACCURACY,
    TwoRaceOutcome,
    all_phases,
    ensemble_of,
    level_of,
    stability_scene,
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
from abu_calc.foundation.checks import Action, Check
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.foundation.parallel import processors
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import from_si, to_si
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.ensemble_results import Ensemble
from abu_calc.simulation.result import Provenance
from abu_calc.sizing.actions import SIMULATED

ONE_RACE_PLACES: Final = 9
"""Places of a single race that are tried between both races."""
UNTRIED: Final = Action("No change was tried, since start cases gave no answer or the time of --patience was over.")
RUN_UP_ACCURACY: Final = 0.01
"""Accuracy of the run-up that is drawn."""
RESPONSE_TO: Final = 1.1
RESPONSE_STEPS: Final = 200
"""Top of the speeds of the response over the highest working speed, and their number."""


def size_two_races(
    machine: Machine, accuracy: float = 0.01, progress: Progress = silent, workers: int | None = None
) -> TwoRaceSizeResult:
    """Size both autobalancers, judge stability, and simulate start cases over the unknown phases.

    `accuracy` moves nothing: start cases run at tolerances of their own. `workers`: start cases side by side, None: one
    for each processor.

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
    accuracy, threads = max(accuracy, ACCURACY), processors() if workers is None else workers
    ensemble = ensemble_of(design, accuracy, progress, threads) if above else None
    one, vibration = _one_race(design), _vibration(design.case, ensemble)
    late, loud = _advice(design, ensemble, accuracy, progress, threads)
    checks = (
        region_check(design, one),
        *stability_check(design, judged),
        *_made(design),
        *level_checks(design, vibration, ensemble, loud),
        *start_checks(design, ensemble, late),
    )
    many, limit = None if ensemble is None else TwoRaceEnsemble.of(ensemble), table.limits.vibration_level_db
    quiet = None if many is None else many.quiet_time_s.typical
    told = benefit("loudest place", vibration.level_before_db, vibration.level_after_db, limit, quiet)
    return TwoRaceSizeResult(
        title=table.machine.name,
        verdict=Verdict.of(checks, told, machine.file or None, _simulated_change(checks)),
        checks=checks,
        warnings=tuple(dict.fromkeys((*machine.warnings, *_notes(design, one)))),
        provenance=Provenance.of(machine),
        system_mass_kg=design.system_mass,
        frequency=_frequency(design, judged, above),
        imbalances_g_mm=tuple(from_si(abs(wheel.imbalance), "g_mm") for wheel in design.case.wheels),
        required_capacity_g_mm=from_si(design.races[0].need, "g_mm"),
        autobalancer=TwoRaceAutobalancer.of_race(design, 0),
        autobalancers=tuple(TwoRaceAutobalancer.of_race(design, index) for index in (0, 1)),
        eccentricities=tuple(Eccentricity.of(race.design.eccentricity) for race in design.races),
        sections=tuple(Section.of(race.design) for race in design.races),
        one_race=one,
        vibration=vibration,
        ensemble=many,
        response=tuple(_response(design.case)),
        run_up=tuple(_run_up(design, progress)),
    )


def _simulated_change(checks: Sequence[Check]) -> tuple[str, ...]:
    """Entries of the first change that was simulated; one that was calculated alone may leave another check failing."""
    return next((check.overrides for check in checks if check.overrides and SIMULATED in (check.remedy or "")), ())


def _response(case: TwoRaceCase) -> Iterator[TwoRaceResponse]:
    """Displacements over the speeds of a run-up, by closed forms."""
    top = RESPONSE_TO * max(case.speed_range)
    for step in range(1, RESPONSE_STEPS + 1):
        speed = top * step / RESPONSE_STEPS
        without = max(
            sum(abs(case.rotor.whirl(held.place, [wheel], speed)) for wheel in case.wheels) for held in case.places
        )
        still = two_races_balance(case.rotor, speed)
        yield TwoRaceResponse(
            speed_rpm=from_si(speed, "rpm"),
            without_um=from_si(without, "um"),
            balanced_um=from_si(_off(case), "um") if still else None,
        )


def _run_up(design: TwoRaceDesign, progress: Progress) -> Iterator[TwoRaceRunUp]:
    """Displacements of the simulated run-up; none if the time of --patience is over."""
    if patience.over():
        return
    progress("run-up, with and without balls")
    for point in run_up_amplitudes(design, RUN_UP_ACCURACY):
        yield TwoRaceRunUp(
            speed_rpm=from_si(point.speed, "rpm"),
            without_um=from_si(point.without, "um"),
            with_um=None if point.with_balls is None else from_si(point.with_balls, "um"),
        )


def _off(case: TwoRaceCase) -> float:
    """Displacement [m] of the place that moves most while both races rotate about their eccentric centres."""
    return case.eccentricity * arms([held.place for held in case.places], case.races)


def _advice(
    design: TwoRaceDesign, ensemble: Ensemble | None, accuracy: float, progress: Progress, workers: int
) -> tuple[Action | None, Action | None]:
    """Changes that were tried: one if a start case is late or does not balance, one if a start case is too loud."""
    if ensemble is None or not ensemble.outcomes:
        return None, None
    if ensemble.lost or patience.over():
        return UNTRIED, UNTRIED
    limits = design.case.table.limits
    late = any(not run.balanced or not run.in_time(limits) for run in ensemble.outcomes)
    loud = any(run.level > limits.vibration_level_db for run in ensemble.outcomes)
    return (
        tried_change(design, ensemble, accuracy, progress, workers) if late else None,
        quieter_change(design, ensemble, accuracy, progress, workers) if loud else None,
    )


def _made(design: TwoRaceDesign) -> Iterator[Check]:
    """Checks of what is made: capacity, the races by themselves, mass; a change is tried if one does not pass."""
    action = sturdier_change(design) if missed(design) and not patience.over() else None
    yield from (*capacity_checks(design, action), *race_checks(design, action), *mass_checks(design, action))


def _stability(design: TwoRaceDesign, speed: float) -> SpeedStability:
    """The sufficient rule for every forward whirl; where it does not hold, eigenvalues at phases of the imbalances."""
    case = design.case
    balls = [PlacedImbalance(place, mass) for place, mass in zip(case.races, design.ball_masses, strict=True)]
    modes = case.rotor.forward_modes(speed)
    slower = [mode for mode in modes if mode.frequency < speed]
    margins = [mode_margin(mode, balls, speed, drag, case.inertia_factor) for mode in slower for drag in case.drags]
    if margins and len(slower) == len(modes) and all(margin.holds for margin in margins):
        return SpeedStability(speed, True, None)
    growths: list[float] = []
    for phases in all_phases(case):
        scene = replace(stability_scene(design, phases), speed=speed)
        abu = design.races[0].design.autobalancer
        try:
            found = stability(scene, half_angle(abu.ball_diameter / 2, abu.pitch_radius))
        except NotTrustworthyError as error:
            return SpeedStability(speed, None, None, str(error).splitlines()[0])
        if found.growth_rate is None:
            return SpeedStability(speed, found.stable, None, found.reason or "")
        growths.append(found.growth_rate)
    return SpeedStability(speed, max(growths) < 0, max(growths))


def _vibration(case: TwoRaceCase, ensemble: Ensemble | None) -> TwoRaceVibration:
    """Levels at every place: without autobalancers at the worst of the phases, with them over the start cases."""
    runs = () if ensemble is None else cast("tuple[TwoRaceOutcome, ...]", ensemble.outcomes)
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
    return TwoRaceVibration(
        level_before_db=before,
        level_after_db=after,
        level_after_worst_db=_largest([row.level_after_worst_db for row in rows]),
        reduction_db=None if after is None else before - after,
        handles=tuple(rows),
    )


def _largest(values: Sequence[float | None]) -> float | None:
    return max((value for value in values if value is not None), default=None)


def _frequency(design: TwoRaceDesign, judged: Sequence[SpeedStability], above: bool) -> TwoRaceFrequency:
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
    # The autobalancer's own mass h at its place z_r adds h to M and h·z_r² to J': together 2·h in the limit to z_r.
    own = max(race.design.autobalancer.mass for race in design.races)
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
        plane_mm=from_si(place, "mm"),
        level_db=level,
        limit_to_place_mm=None if limit is None else from_si(limit, "mm"),
        enough=level <= case.table.limits.vibration_level_db,
    )


def _search_notes(design: TwoRaceDesign) -> Iterator[str]:
    """Places that were searched, with the displacement and capacities that they and the given ones ask for."""
    case = design.bare
    given = first, second = [to_si(race.plane_mm, "mm") for race in case.table.autobalancer]
    if all(race.plane_range_mm is None for race in case.table.autobalancer):
        return
    before = case.with_races((first, second))
    needs, needs_before = capacity_needs(case), capacity_needs(before)
    for number, (race, place, old) in enumerate(zip(case.table.autobalancer, case.races, given, strict=True), 1):
        if race.plane_range_mm is not None:
            low, high = race.plane_range_mm
            kept = " as given" if place == old else f", not {from_si(old, 'mm'):.4g} mm"
            yield (
                f"Race {number} stands at {from_si(place, 'mm'):.4g} mm{kept}, chosen within {low:g} … {high:g} mm. "
                f"Required capacity, without the autobalancers' own mass: from "
                f"{from_si(needs_before[number - 1], 'g_mm'):.4g} to {from_si(needs[number - 1], 'g_mm'):.4g} g·mm"
            )
    yield (
        f"Race eccentricity at the loudest place: {from_si(_off(before), 'um'):.3g} µm as given, "
        f"{from_si(_off(case), 'um'):.3g} µm as chosen (calculated)"
    )


def _notes(design: TwoRaceDesign, one: OneRace | None) -> Iterator[str]:
    yield from _search_notes(design)
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
    yield "Hands, and levels off the spindle axis, are not modelled with two races"
    if design.case.table.grinding is not None:
        yield (
            "Start cases and levels are those at idle; capacity counts the runout of the wheel at work. `abu grinding "
            "FILE` simulates the machine at work"
        )
