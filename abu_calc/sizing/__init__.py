"""Steps of `abu size`, one after another, then their checks in the order in which a reader needs them.

Steps of the swing arm are imported only if the machine has one.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from abu_calc.foundation.checks import Check
from abu_calc.foundation.units import shown
from abu_calc.inputs.machine import MachineFile
from abu_calc.sizing.advice import candidate_checks, design_warnings, loudness, missed, power_checks, residual_check
from abu_calc.sizing.balls import AutobalancerChoice, Candidate, choose_for_motor, sound, why_not
from abu_calc.sizing.case import Case, read_case
from abu_calc.sizing.design import Design, RaceDesign, frequency_region
from abu_calc.sizing.drawing_requirements import drawing
from abu_calc.sizing.handles import body_bands, handle_checks, highest_total
from abu_calc.sizing.imbalance import Imbalance, find_imbalance
from abu_calc.sizing.manufacture.construction import construct
from abu_calc.sizing.manufacture.eccentricity import eccentricity_check, split_eccentricity
from abu_calc.sizing.oil import value_sources, with_oil
from abu_calc.sizing.track import track, track_checks
from abu_calc.sizing.type_test import band, declared_checks
from abu_calc.sizing.vibration import idle_vibration, loaded_vibration, speed_levels, vibration_checks, worst_residuals

if TYPE_CHECKING:
    from abu_calc.sizing.swing_arm import SwingArmBounds

__all__ = ["Design", "RaceDesign", "instead", "no_worse", "size", "size_race", "usable"]


def size(machine: MachineFile) -> Design:
    """Size an autobalancer for a machine.

    The need depends on the machine with its autobalancer, so each candidate is judged by its own mass, and the steps
    that come before it on paper (region, capacity, budget) are those of the candidate that was chosen. A runner-up is
    preferred to a lighter candidate that exceeds a limit of vibration, if only where the inertia is estimated. The
    bound of friction decides nothing: start cases hardly ever come near it, and it is not monotone in the imbalance.
    """
    case = read_case(machine)
    imbalance = find_imbalance(case)
    return _quieter(_designed(case, imbalance, choose_for_motor(case, imbalance.value)))


def size_race(machine: MachineFile) -> RaceDesign:
    """Lightest balls and race of a machine, with the checks that concern them alone.

    These take most of the time of `size` if the race has many balls.
    """
    case = read_case(machine)
    best = choose_for_motor(case, find_imbalance(case).value).best
    case = with_oil(case, best)
    race = track(case, best, frequency_region(case, best.ball_mass, best.mass).natural_frequencies)
    eccentricity = split_eccentricity(case, best)
    construction = construct(case, best, eccentricity)
    checks = (residual_check(best), *track_checks(case, best, race))
    return RaceDesign(case, best, race, eccentricity, construction, checks)


Refused = Sequence[tuple[Candidate, str]]
"""Candidates that were not taken, and why."""


def instead(design: Design, candidate: Candidate, refused: Refused) -> Design:
    """The same machine with a runner-up. The others compare with it, but for those that were refused."""
    case, reason_of = design.case, {id(each): why for each, why in refused}
    others = (design.autobalancer, *(each for each, _ in design.choice.runners_up if each is not candidate))
    reasons = tuple((each, reason_of.get(id(each)) or why_not(case, each, candidate)) for each in others)
    return _designed(case, design.imbalance, replace(design.choice, best=candidate, runners_up=reasons))


def usable(case: Case, candidate: Candidate) -> bool:
    """True if a candidate falls short of nothing; a file that places its balls has an angle for each."""
    placed = case.table.start
    return sound(case, candidate) and (placed is None or len(placed.angles_deg) == candidate.ball_count)


TOO_LOUD: Final = "too loud"
MAY_HANG: Final = "friction may hold one of so few balls on the heavy side"
"""Reasons against candidates."""
FREE: Final = 4
"""Balls, at least, of which friction hardly ever holds one on the heavy side: of three it did so in 2 of 70 starts, on
a vertical spindle with a lever arm of 2.8 µm and 83 % of the capacity in use."""


def _quieter(design: Design) -> Design:
    """The lightest runner-up that keeps the limits of vibration if a design does not, else one that warns if it fails.

    No requirement may be missed that is met now. Fewer than four balls replace no more of them, unless gravity shakes
    all friction out.
    """
    case, least = design.case, loudness(design)
    if not any(least) or not design.frequency.balancing_possible:
        return design
    chosen, refused = design, [(design.autobalancer, TOO_LOUD)]
    for runner_up, _ in design.choice.runners_up:
        if not usable(case, runner_up):
            continue
        if not _free(case, runner_up):
            refused.append((runner_up, MAY_HANG))
            continue
        other = instead(design, runner_up, refused)
        if not no_worse(other, design):
            continue
        if (level := loudness(other)) < least:
            chosen, least = other, level
        if not any(level):
            break
        refused.append((runner_up, TOO_LOUD))
    return chosen if chosen is design else replace(chosen, warnings=(_instead_of(design, chosen), *chosen.warnings))


def _instead_of(design: Design, chosen: Design) -> str:
    """Sentence on the balls that rank first, which are too loud; a runner-up of more than a dozen may be lighter."""
    lightest, less = design.autobalancer, chosen.autobalancer.mass - design.autobalancer.mass
    balls = f"{lightest.ball_count} × Ø{shown(lightest.ball_diameter, 'mm', 'g')} balls"
    advantage = f"{shown(less, 'g', '.1f')} lighter" if less > 0.05e-3 else "the first choice"
    return f"{balls} would be {advantage}, but {TOO_LOUD}."


def no_worse(other: Design, design: Design) -> bool:
    """True if another design misses no requirement that a design meets."""
    return missed(other) <= missed(design)


def _free(case: Case, candidate: Candidate) -> bool:
    """True if friction hardly ever holds a ball on the heavy side."""
    return candidate.ball_count >= FREE or band(replace(case, speed=case.speed_range[1]), candidate) == 0


def _designed(case: Case, imbalance: Imbalance, choice: AutobalancerChoice) -> Design:
    best = choice.best
    case = with_oil(case, best)
    frequency = frequency_region(case, best.ball_mass, best.mass)
    race = track(case, best, frequency.natural_frequencies)
    others = tuple(track(case, runner_up, frequency.natural_frequencies) for runner_up, _ in choice.runners_up)
    idle = idle_vibration(case, imbalance.value, best, frequency.balancing_possible)
    worst = worst_residuals(case, imbalance.value, best)
    levels = speed_levels(case, imbalance.value, best, worst, frequency.balancing_possible)
    loaded = loaded_vibration(case, imbalance.value, best, frequency.balancing_possible)
    limited = case.table.limits.a_hv_m_per_s2 is not None and frequency.balancing_possible
    total = highest_total(case, imbalance.value, best) if limited else None
    arm = _arm(case, imbalance.value, best)
    eccentricity = split_eccentricity(case, best)
    construction = construct(case, best, eccentricity)
    advice = drawing(case, best, race, eccentricity, construction)
    bands = body_bands(case, best, frequency.balancing_possible)
    before = (
        frequency.check,
        *_motor(case),
        *candidate_checks(case, best),
        eccentricity_check(case, eccentricity),
        *track_checks(case, best, race),
        *construction.checks,
    )
    level, lowered = vibration_checks(case, imbalance.value, best, idle, levels, bands.level if bands else None)
    behind = (
        lowered,
        *handle_checks(case, total, bands),
        *declared_checks(case, best, frequency.balancing_possible),
        *power_checks(case),
    )
    warnings = (*value_sources(case), *design_warnings(case, best, loaded, bands))
    return Design(
        case, frequency, imbalance, choice, race, others, idle, worst, levels, total, loaded, arm, advice,
        before, level, behind, warnings, bands, eccentricity, construction,
    )  # fmt: skip


def _motor(case: Case) -> tuple[Check, ...]:
    if case.idle_speed is None:
        return ()
    from abu_calc.sizing.design import motor_checks

    return motor_checks(case)


def _arm(case: Case, imbalance: float, candidate: Candidate) -> "SwingArmBounds | None":
    if case.table.swing_arm is None:
        return None
    from abu_calc.sizing.swing_arm import swing_arm_bounds

    return swing_arm_bounds(case, case.table.swing_arm, imbalance, candidate.mass, candidate.capacity)
