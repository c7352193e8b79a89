"""A machine with two races judged: stability, start cases over the unknown phases, levels, and all checks."""

import statistics
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, cast

from abu_calc.dynamics.stability.verdict import stability
from abu_calc.features.design.judgement import TrialWatcher
from abu_calc.features.design.start_rules import StartFacts, checks_of_starts
from abu_calc.features.two_races.case import TwoRaceCase, read_case
from abu_calc.features.two_races.checks import (
    BELOW,
    LONGER,
    SpeedStability,
    capacity_checks,
    level_checks,
    mass_checks,
    race_checks,
    region_check,
    stability_check,
)
from abu_calc.features.two_races.choice import TwoRaceDesign, choose_both
from abu_calc.features.two_races.records import OneRace, PlaceOnSpindleLevel, TwoRaceVibration
from abu_calc.features.two_races.start_cases import (
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
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress
from abu_calc.inputs.two_races import TwoRaceFile
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome

ONE_RACE_PLACES: Final = 9
"""Places of a single race that are tried between both races."""


@dataclass(frozen=True)
class TwoRaceJudgement:
    """Two autobalancers with all that was calculated and simulated of them, and the checks."""

    facts: StartFacts
    stability: tuple[SpeedStability, ...]
    one_race: OneRace | None
    vibration: TwoRaceVibration
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
    table: TwoRaceFile, accuracy: float, progress: Progress, workers: int, trial: TrialWatcher | None = None
) -> TwoRaceJudgement:
    """Design, simulate and judge a machine; whatever `trial` raises ends it."""
    trial = trial or TrialWatcher()
    design = choose_both(read_case(table))
    made = *capacity_checks(design), *race_checks(design), *mass_checks(design)
    trial.checked((region_check(design, None), *made))
    one = _one_race(design)
    region = region_check(design, one)
    above, speeds = balances(design), dict.fromkeys((*design.case.speed_range, design.case.speed))
    judged = tuple(_stability(design, speed) for speed in speeds) if above else ()
    stable = tuple(stability_check(design, judged))
    trial.checked(stable)
    trial.repeated(design)
    ensemble = ensemble_of(design, accuracy, progress, workers, trial.seen) if above else None
    vibration = _vibration(design.case, ensemble)
    facts = facts_of(design, ensemble)
    checks = region, *stable, *made, *level_checks(design, vibration, ensemble), *checks_of_starts(facts)
    trial.checked(checks)
    return TwoRaceJudgement(facts, judged, one, vibration, checks)


def facts_of(design: TwoRaceDesign, ensemble: Ensemble | None) -> StartFacts:
    """What the start cases show; None below a critical speed, where none runs."""
    return StartFacts(
        design, ensemble, unsimulated=BELOW, advice=lambda _, status: LONGER if status == "not-done" else None
    )


def balances(design: TwoRaceDesign) -> bool:
    """True if two races balance at every speed that is judged."""
    speeds = dict.fromkeys((*design.case.speed_range, design.case.speed))
    return all(two_races_balance(design.case.rotor, speed) for speed in speeds)


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
        plane=place,
        level_db=level,
        limit_to_place=limit,
        enough=level <= case.table.limits.vibration_level_db,
    )
