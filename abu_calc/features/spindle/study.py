"""Study behind `abu size` of a machine with two races: sizing, stability, start cases, checks."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.features.design.judgement import TrialWatcher
from abu_calc.features.design.next_step import Judge, actions, next_step, verdict_of
from abu_calc.features.design.records import Eccentricity, Section
from abu_calc.features.design.verdict import benefit
from abu_calc.features.spindle.case import SpindleCase, SpindleDesign, arms, capacity_needs
from abu_calc.features.spindle.judgement import SpeedStability, SpindleJudgement, judge, proposals
from abu_calc.features.spindle.records import (
    OneRace,
    PlacedAutobalancerRecord,
    SpindleEnsemble,
    SpindleFrequency,
    SpindleResponse,
    SpindleRunUp,
    SpindleSizeResult,
)
from abu_calc.features.spindle.start_cases import ACCURACY, FIRST_TOLERANCE, scene_of, start_of, start_once
from abu_calc.foundation import patience
from abu_calc.foundation.parallel import processors
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import shown
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.ensemble import MORE, TIGHTER, WORK
from abu_calc.simulation.result import Provenance
from abu_calc.simulation.rotor_view import course, until_shortly_after, without_balls
from abu_calc.simulation.start_cases import Lost, Member, StartOutcome

RUN_UP_ACCURACY: Final = 0.01
"""Accuracy of the run-up that is drawn."""
RESPONSE_TO: Final = 1.1
RESPONSE_STEPS: Final = 200
"""Top of the speeds of the response over the highest working speed, and their number."""


def size_spindle(
    machine: Machine, accuracy: float = 0.01, progress: Progress = silent, workers: int | None = None
) -> SpindleSizeResult:
    """Size both autobalancers, judge stability, and simulate start cases over the unknown phases.

    `accuracy` moves nothing: start cases run at tolerances of their own. `workers`: start cases side by side, None: one
    for each processor.

    Raises InputError with file, line and key for what cannot be made.
    """
    accuracy, threads = max(accuracy, ACCURACY), processors() if workers is None else workers
    with machine.located():
        judged = judge(machine, accuracy, progress, threads)
        step = next_step(machine, judged, proposals(judged), _judge(accuracy, threads), progress)
    design, ensemble, one, vibration = judged.facts.design, judged.facts.ensemble, judged.one_race, judged.vibration
    checks = actions(judged, step)
    many = None if ensemble is None else SpindleEnsemble.of(ensemble, design)
    quiet = None if many is None else many.quiet_time_s.worst
    levels = vibration.level_before_db, vibration.level_after_db
    told = benefit("loudest place", *levels, design.case.level_limit, quiet)
    races = tuple(PlacedAutobalancerRecord.of_race(design, index) for index in range(len(design.races)))
    return SpindleSizeResult(
        title=machine.title,
        verdict=verdict_of(judged, checks, step, told, Provenance.of(machine)),
        checks=checks,
        warnings=tuple(dict.fromkeys((*machine.warnings, *_notes(design, one)))),
        provenance=Provenance.of(machine),
        system_mass_kg=design.system_mass,
        frequency=_frequency(design, judged.stability),
        imbalances=design.imbalances,
        required_capacity=design.races[0].need,
        autobalancer=races[0],
        autobalancers=races,
        eccentricities=tuple(Eccentricity.of(race.eccentricity) for race in design.races),
        sections=tuple(Section.of(race) for race in design.races),
        one_race=one,
        vibration=vibration,
        ensemble=many,
        response=tuple(_response(design.case)),
        run_up=run_up_amplitudes(design, progress),
    )


def _judge(accuracy: float, workers: int) -> Judge:
    """How a change of a machine with two races is tried."""

    def judged(machine: Machine, progress: Progress, trial: TrialWatcher) -> SpindleJudgement:
        """As `size_spindle` judges it."""
        return judge(machine, accuracy, progress, workers, trial)

    def once(design: SpindleDesign, member: Member, *, closer: bool = False) -> StartOutcome | Lost:
        """One start case."""
        work = MORE * WORK if member.run_up else WORK
        tolerance = (TIGHTER if closer else 1.0) * FIRST_TOLERANCE
        return start_once(design, member, accuracy, tolerance, work, early_end=True)

    return Judge(judged, once, slack=0.0)


def _response(case: SpindleCase) -> Iterator[SpindleResponse]:
    """Displacements over the speeds of a run-up, by closed forms."""
    top = RESPONSE_TO * max(case.speed_range)
    for step in range(1, RESPONSE_STEPS + 1):
        speed = top * step / RESPONSE_STEPS
        without = max(
            sum(abs(case.rotor.whirl(held.place, [wheel], speed)) for wheel in case.wheels) for held in case.places
        )
        still = case.balances_at(speed)
        yield SpindleResponse(speed=speed, without=without, balanced=_off(case) if still else None)


def run_up_amplitudes(
    design: SpindleDesign, progress: Progress = silent, accuracy: float = RUN_UP_ACCURACY
) -> tuple[SpindleRunUp, ...]:
    """The run-up with the balls together, imbalances of unknown phase in phase; both machines run up alike.

    None if the time of --patience is over.
    """
    if patience.over():
        return ()
    progress("run-up, with and without balls")
    run_up = start_of(design, "run-up")
    scene = until_shortly_after(scene_of(design, run_up))
    bare = replace(without_balls(scene_of(replace(design, case=design.bare), run_up)), duration=scene.duration)
    planes = [held.place for held in design.case.places]
    with_balls, empty = course(scene, planes, accuracy), course(bare, planes, accuracy)
    return tuple(
        SpindleRunUp(speed=speed, without=amplitude, with_=None if with_balls is None else with_balls[index][1])
        for index, (speed, amplitude) in enumerate(empty or ())
    )


def _off(case: SpindleCase) -> float:
    """Displacement [m] of the place that moves most while both races rotate about their eccentric centres."""
    return case.eccentricity * arms([held.place for held in case.places], case.races)


def _frequency(design: SpindleDesign, judged: Sequence[SpeedStability]) -> SpindleFrequency:
    case, above = design.case, design.case.balances
    critical = case.rotor.critical_speeds()
    below = [speed for speed in critical if speed < min(case.speed_range)]
    region = "supercritical" if above else "between" if below else "subcritical"
    growths = [each.growth for each in judged if each.growth is not None]
    states = [each.stable for each in judged]
    return SpindleFrequency(
        speed=case.speed,
        critical_speeds=critical,
        region=region,
        balancing_possible=above,
        stable=None if not states or None in states else all(states),
        growth_rate=max(growths, default=None),
    )


def _search_notes(design: SpindleDesign) -> Iterator[str]:
    """Places that were searched, with the displacement and capacities that they and the given ones ask for."""
    case = design.bare
    given = tuple(race.plane for race in case.table.autobalancer)
    if all(race.plane_range_mm is None for race in case.table.autobalancer):
        return
    before = case.with_races(given)
    needs, needs_before = capacity_needs(case), capacity_needs(before)
    for number, (race, place, old) in enumerate(zip(case.table.autobalancer, case.races, given, strict=True), 1):
        if race.plane_range_mm is not None:
            kept = " as given" if place == old else f", not {shown(old, 'mm', '.4g')}"
            yield (
                f"Race {number} stands at {shown(place, 'mm', '.4g')}{kept}, chosen within "
                f"{shown(race.plane_range, 'mm', 'g')}. Required capacity, without the autobalancers' own mass: from "
                f"{shown((needs_before[number - 1], needs[number - 1]), 'g_mm', '.4g', ' to ')}"
            )
    yield (
        f"Race eccentricity at the loudest place: {shown(_off(before), 'um')} as given, "
        f"{shown(_off(case), 'um')} as chosen (calculated)"
    )


def _notes(design: SpindleDesign, one: OneRace | None) -> Iterator[str]:
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
