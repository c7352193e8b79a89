"""Checks of a machine with two races, in the order of their codes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.records import OneRace, TwoRaceVibration
from abu_calc.formulas.two_races import two_races_balance
from abu_calc.foundation.checks import Check, Finding, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.simulation.ensemble_results import Ensemble


@dataclass(frozen=True)
class SpeedStability:
    """Stability at one speed [rad/s]: by the sufficient rule (`growth` None) or by eigenvalues [1/s]."""

    speed: float
    stable: bool | None
    growth: float | None
    reason: str = ""


def region_check(design: TwoRaceDesign, one: OneRace | None) -> Check:
    """ABU101: whether all working speeds lie above both critical speeds."""
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


def stability_check(design: TwoRaceDesign, judged: Sequence[SpeedStability]) -> Iterator[Check]:
    """ABU103: stability of the balanced state at the speeds judged."""
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
        "1/s", None if passed else "Use a more viscous oil in both races, or damp the bearings.",
    )  # fmt: skip


def capacity_checks(design: TwoRaceDesign) -> Iterator[Check]:
    """ABU201 for each race: its balls carry the required capacity times the margin."""
    for number, race in enumerate(design.races, 1):
        table = design.case.table.autobalancer[number - 1]
        needed = race.need * table.capacity_margin
        passed = race.design.autobalancer.capacity >= needed * (1 - 1e-9)
        yield coded(
            "ABU201", verdict(passed),
            f"{race.design.autobalancer.ball_count} balls must carry the required capacity of the worst phase times "
            f"the margin {table.capacity_margin:g}", from_si(race.design.autobalancer.capacity, "g_mm"),
            from_si(needed, "g_mm"), "g·mm",
            bound="least", of=f"race {number}",
        )  # fmt: skip


def race_checks(design: TwoRaceDesign) -> Iterator[Check]:
    """Checks of each race by itself, without the actions of one race."""
    for number, race in enumerate(design.races, 1):
        for check in race.design.checks:
            yield replace(check, name=f"{check.name}, race {number}", remedy=None, overrides=())


def mass_checks(design: TwoRaceDesign) -> Iterator[Check]:
    """ABU203 for each autobalancer: its share of the mass of the machine."""
    machine = design.case.table.machine.mass_kg
    for number, (race, table) in enumerate(zip(design.races, design.case.table.autobalancer, strict=True), 1):
        share = race.design.autobalancer.mass / machine
        passed = share <= table.max_mass_fraction
        yield coded(
            "ABU203", verdict(passed), "The autobalancer with its balls takes this share of the machine's mass",
            100 * share, 100 * table.max_mass_fraction, "%",
            of=f"race {number}",
        )  # fmt: skip


def level_checks(design: TwoRaceDesign, vibration: TwoRaceVibration, ensemble: Ensemble | None) -> Iterator[Check]:
    """ABU401 and ABU402: levels of the loudest place against the limit, and against those without autobalancers.

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
        yield coded(
            "ABU401", verdict(passed, safe),
            "Level at the loudest place with the autobalancers, loudest start case at the given drag rate"
            + ("" if safe else f"; in any oil {loudest:.1f} dB"), given, limit, "dB",
        )  # fmt: skip
    if lost:
        yield coded("ABU402", "not-done", partly, remedy="See ABU701.")
        return
    lowered = vibration.level_after_db < vibration.level_before_db
    yield coded(
        "ABU402", verdict(lowered), "Level at the loudest place, median of the start cases, against that without",
        vibration.level_after_db, vibration.level_before_db, "dB",
        None if lowered else "The imbalances are too small for these races: use none, or races that run truer.",
    )  # fmt: skip


LONGER = "Allow some minutes: --patience 600 (not tried)."
"""Action where start cases gave no answer."""


BELOW: Final = Finding("not-done", "Not simulated below a critical speed", action="See ABU101.")
"""What is known of start cases where none runs."""
