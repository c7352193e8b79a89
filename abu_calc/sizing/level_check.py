"""The idle level against its limit over the speed range, and what a truer race would do to it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from abu_calc.checks import Check, coded, verdict
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.vibration import LevelAtSpeed, SpeedLevels, Vibration, speed_levels
from abu_calc.sizing.worst import WorstResidual, worst_residuals
from abu_calc.units import from_si

SHARES = (0.5, 0.25)
"""Shares of the race's eccentricity and of the friction's lever arm that are tried."""


def vibration_checks(
    case: Case,
    imbalance: float,
    candidate: Candidate,
    idle: Vibration,
    levels: SpeedLevels | None,
    worst: Sequence[WorstResidual],
) -> tuple[Check, ...]:
    """The idle level against the limit over the speed range, and that the autobalancer lowers it."""
    limit, before, after = case.level_limit, idle.worst.before, idle.worst.after
    if after is None or levels is None:
        reason = "not known, since the balls cannot balance at these speeds"
        allowed = {"ABU401": limit, "ABU402": before}
        return tuple(coded(code, "not-done", reason, None, most, "dB") for code, most in allowed.items())
    remedy = None
    if not idle.lowered:
        remedy = "The wheel is balanced better than balls can do: no autobalancer is needed."
        if candidate.budget.shortfall:
            remedy = "What gives the balls enough capacity, see ABU201."
        elif candidate.budget.rolling_friction > candidate.budget.race_eccentricity:
            remedy = "A harder, cleaner race or larger balls: friction leaves more than the wheel's imbalance moves."
    message = "with the autobalancer against without, idle"
    return (
        _level_check(case, imbalance, candidate, levels, worst),
        coded("ABU402", verdict(idle.lowered), message, after, before, "dB", remedy),
    )


def _level_check(
    case: Case, imbalance: float, candidate: Candidate, levels: SpeedLevels, worst: Sequence[WorstResidual]
) -> Check:
    """Fails on the level as expected where it is highest, warns on that of the worst arrangement."""
    limit, highest, arranged = case.level_limit, levels.highest, levels.arranged
    kept, safe = highest.after <= limit, arranged.after <= limit
    of_range = "" if len(levels.by_speed) == 1 else ", the worst of the range"
    message = f"expected with the autobalancer at the worst handle, at {_rpm(highest)}{of_range}"
    if kept and not safe:
        there = "" if arranged.speed == highest.speed else f", at {_rpm(arranged)}"
        message += f"; {arranged.after:.1f} dB{there} where friction holds the balls at their worst"
    remedy = None if kept and safe else _remedy(case, imbalance, candidate, None if kept else worst)
    return coded("ABU401", verdict(kept, safe), message, highest.after, limit, "dB", remedy)


def _remedy(case: Case, imbalance: float, candidate: Candidate, held: Sequence[WorstResidual] | None) -> str:
    """The least truer race that keeps the limit, by the same formulas.

    `held`: where friction holds the balls worst, which is not asked about; None: that is what has to keep it.
    """
    background, limit = case.background_level, case.level_limit
    if background is not None and background >= limit:
        return (
            f"The background alone is {background:.4g} dB, which no autobalancer lowers: a quieter machine, or another "
            "limits.vibration_level_db."
        )

    def level(other: Case) -> float:
        levels = speed_levels(
            other, imbalance, candidate, held or worst_residuals(other, imbalance, candidate), possible=True
        )
        return math.inf if levels is None else (levels.highest if held else levels.arranged).after

    *others, (words, truest) = _truer(case)
    if (least := level(truest)) > limit:
        return (
            f"Tried without success: {1 / SHARES[-1]:g} times less eccentricity and friction of the race. What is "
            f"left: {_left(candidate)}a heavier machine, or another limits.vibration_level_db."
        )
    tried = ((each, level(other)) for each, other in others)
    words, new_level = next((pair for pair in tried if pair[1] <= limit), (words, least))
    return f"Tried: {words} gives {new_level:.1f} dB."


def _left(candidate: Candidate) -> str:
    """Actions on the other residuals at the wheel: enough capacity, or a race nearer to the wheel's plane."""
    capacity = "enough capacity (ABU201), " if candidate.budget.shortfall else ""
    return f"{capacity}a race nearer to the wheel's plane, " if candidate.budget.plane_offset else capacity


def _truer(case: Case) -> Iterator[tuple[str, Case]]:
    """A race less eccentric, or with less friction, or both."""
    for share in SHARES:
        less, smoother = share * case.race_eccentricity, share * case.friction_arm
        true = f"race_eccentricity_mm = {from_si(less, 'mm'):.3g}"
        hard = f"rolling_friction_mm = {from_si(smoother, 'mm'):.3g} (harder, cleaner)"
        yield true, replace(case, race_eccentricity=less)
        yield hard, replace(case, friction_arm=smoother)
        yield f"{true} with {hard}", replace(case, race_eccentricity=less, friction_arm=smoother)


def _rpm(level: LevelAtSpeed) -> str:
    return f"{from_si(level.speed, 'rpm'):.6g} rpm"
