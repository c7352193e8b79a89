"""Checks of a machine with two races, in the order of their codes."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.records import OneRace, TwoRaceVibration
from abu_calc.features.two_races.start_cases import NOT_TRIED, LostRun, TwoRaceRun
from abu_calc.formulas.two_races import two_races_balance
from abu_calc.foundation.checks import Action, Check, coded, verdict
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si


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
        "1/s", None if passed else "Raise rolling_drag_per_s of both races, or damp the bearings.",
    )  # fmt: skip


NO_OTHER_MAKE = "No larger ball, room, share of mass, or truer race that was tried helps. Reduce the imbalances."


def capacity_checks(design: TwoRaceDesign, action: Action | None = None) -> Iterator[Check]:
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
            None if passed else action or NO_OTHER_MAKE,
            "least", of=f"race {number}",
        )  # fmt: skip


def race_checks(design: TwoRaceDesign, action: Action | None = None) -> Iterator[Check]:
    """Checks of each race by itself; their actions were tried on one race, so `action` of both takes their place."""
    for number, race in enumerate(design.races, 1):
        for check in race.design.checks:
            bare = replace(check, name=f"{check.name}, race {number}", remedy=None, overrides=())
            yield bare if check.status == "pass" else bare.with_action(action or NO_OTHER_MAKE)


def mass_checks(design: TwoRaceDesign, action: Action | None = None) -> Iterator[Check]:
    """ABU203 for each autobalancer: its share of the mass of the machine."""
    machine = design.case.table.machine.mass_kg
    for number, (race, table) in enumerate(zip(design.races, design.case.table.autobalancer, strict=True), 1):
        share = race.design.autobalancer.mass / machine
        passed = share <= table.max_mass_fraction
        yield coded(
            "ABU203", verdict(passed), "The autobalancer with its balls takes this share of the machine's mass",
            100 * share, 100 * table.max_mass_fraction, "%",
            None if passed else action or NO_OTHER_MAKE,
            of=f"race {number}",
        )  # fmt: skip


NO_QUIETER = "No smaller eccentricity, friction, or other drag rate that was tried helps. Balance the wheels."


def level_checks(
    design: TwoRaceDesign, vibration: TwoRaceVibration, all_runs: Sequence[TwoRaceRun | LostRun],
    action: Action | None = None,
) -> Iterator[Check]:  # fmt: skip
    """ABU401 and ABU402: levels of the loudest place against the limit, and against those without autobalancers.

    `action`: one that was tried and brings all start cases below the limit. Where start cases gave no answer, what
    would pass is not evaluated.
    """
    limit, runs = design.case.table.limits.vibration_level_db, [run for run in all_runs if isinstance(run, TwoRaceRun)]
    if vibration.level_after_db is None:
        yield coded("ABU401", "not-done", "No start case balances, so no level is known", remedy="See ABU701.")
        return
    given, loudest = max(run.level for run in runs if run.case.drag_factor == 1), max(run.level for run in runs)
    passed, safe = given <= limit, loudest <= limit
    lost = len(all_runs) - len(runs)
    partly = f"Only {len(runs)} of {len(all_runs)} start cases gave a level, the loudest {loudest:.1f} dB"
    if lost and passed:
        yield coded("ABU401", "not-done", partly, remedy="See ABU701.")
    else:
        yield coded(
            "ABU401", verdict(passed, safe),
            "Level at the loudest place with the autobalancers, loudest start case at the given drag rate"
            + ("" if safe else f"; in any oil {loudest:.1f} dB"), given, limit, "dB",
            None if passed and safe else action or NO_QUIETER,
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


OTHERWISE = "No drag rate and no larger ball that were tried help. Permit a longer quiet time."


def start_checks(design: TwoRaceDesign, runs: Sequence[TwoRaceRun | LostRun], action: Action | None) -> Iterator[Check]:
    """Checks of the start cases; `action`: one that was tried and makes all of them pass."""
    if not runs:
        for code in ("ABU701", "ABU702", "ABU704"):
            yield coded(code, "not-done", "Not simulated below a critical speed", remedy="See ABU101.")
        return
    lost = [run for run in runs if isinstance(run, LostRun)]
    if lost:
        text, remedy = _lost_in_words(lost, len(runs))
        for code in ("ABU701", "ABU702", "ABU704"):
            yield coded(code, "not-done", text, remedy=remedy)
        return
    known = [run for run in runs if isinstance(run, TwoRaceRun)]
    given, limits = [run for run in known if run.case.drag_factor == 1], design.case.table.limits
    bad = [run for run in given if not run.balances]
    elsewhere = [run for run in known if not run.balances and run.case.drag_factor != 1]
    text = "Start cases in which both races balance, at the given drag rate"
    text += f"; not: {bad[0].case.name}" if bad else ""
    text += f"; not in hot or cold oil: {elsewhere[0].case.name}" if elsewhere else ""
    yield coded(
        "ABU701", verdict(not bad, not elsewhere), text, float(len(given) - len(bad)), float(len(given)), None,
        action or "Run farther above the critical speeds." if bad or elsewhere else None, "least",
    )  # fmt: skip
    slow, slow_anywhere = slowest(given), slowest(known)
    in_time, all_in_time = (all(run.in_time(limits) for run in some) for some in (given, known))
    rest = max((math.inf if run.rest_time is None else run.rest_time for run in known), default=0.0)
    yield coded(
        "ABU702", verdict(in_time, all_in_time),
        "Slowest start case at the given drag rate" + (f": {slow[1].case.name}" if slow else " is never quiet")
        + ("" if all_in_time or slow_anywhere is None else f"; in hot or cold oil {slow_anywhere[0]:.2f} s")
        + (f"; balls rest after {_seconds(rest)} (limit {limits.rest_time_s:g} s)" if limits.rest_time_s else ""),
        None if slow is None else slow[0], limits.longest_quiet_time, "s",
        None if in_time and all_in_time else action or OTHERWISE,
    )  # fmt: skip
    stalled = [run for run in known if run.stalls]
    at_given = [run for run in stalled if run.case.drag_factor == 1]
    yield coded(
        "ABU704", verdict(not at_given, not stalled), "Start cases that leave balls stalled"
        + (f": {stalled[0].case.name}" if stalled else ""), float(len(stalled)), 0.0, None,
        action or "Run up faster, or farther above the critical speeds." if stalled else None,
    )  # fmt: skip


def _lost_in_words(lost: Sequence[LostRun], count: int) -> tuple[str, str]:
    """How many start cases gave no answer and why, and what to do about each reason."""
    chaotic = [run for run in lost if "chaotic" in run.reason]
    hurried = [run for run in lost if "--patience" in run.reason]
    untried = [run for run in lost if run.reason == NOT_TRIED]
    laborious = [run for run in lost if run.short and run not in (*hurried, *untried)]
    others = [run for run in lost if not (run in chaotic or run in hurried or run.short)]
    reasons, actions = [], []
    if hurried:
        reasons.append(f"{len(hurried)} ran out of time")
        actions.append("Allow more time: --patience.")
    if laborious:
        reasons.append(f"{len(laborious)} would take more work than allowed")
        actions.append("Allow some minutes: --patience 600 (not tried).")
    if chaotic:
        number = "1 is" if len(chaotic) == 1 else f"{len(chaotic)} are"
        reasons.append(f"{number} chaotic, so that no two runs agree: {chaotic[0].case.name}")
    if others:
        reasons.append(f"{len(others)} otherwise: {others[0].case.name}: {others[0].reason}")
        actions.append("Specify a coarser --accuracy.")
    if untried:
        reasons.append(f"{len(untried)} were not tried")
    if chaotic or others:
        actions.append("Narrow speed_range_rpm, or raise rolling_drag_per_s of both races (not tried).")
    return f"{len(lost)} of {count} start cases gave no answer. {'; '.join(reasons)}", " ".join(dict.fromkeys(actions))


def _seconds(time: float) -> str:
    return "more than the run" if math.isinf(time) else f"{time:.2f} s"


def slowest(runs: Sequence[TwoRaceRun]) -> tuple[float, TwoRaceRun] | None:
    """Longest quiet time [s] and its run; None if one is never quiet."""
    if any(run.quiet_time is None for run in runs):
        return None
    run = max(runs, key=lambda each: each.quiet_time or 0.0)
    return run.quiet_time or 0.0, run
