"""Step 7: velocity levels before and after, idle and under load, at every handle, and over the speed range.

The idle level is held against its limit, also with a truer race. The worst residual displacement counts too: friction
holds the axis farthest off, and all parts are in line.
"""

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from operator import attrgetter
from typing import Annotated, Final

from abu_calc.formulas.friction_band import remaining_band, worst_friction
from abu_calc.formulas.suspension import dynamic_stiffness, resonance_factor
from abu_calc.foundation.checks import Check, Finding, coded, verdict
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import LEVEL_AFTER, Quantity, Record, record
from abu_calc.foundation.units import from_si
from abu_calc.sizing.actions import Followed
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import (
    ResidualBudget,
    accuracy_budget,
    displacement_level,
    judged_speeds,
    loudest_displacement,
    loudest_transmission,
    steady_contact,
)
from abu_calc.sizing.case import EQUAL_SPEEDS, WHEEL_PLANE, Case
from abu_calc.sizing.places import Levels, VibrationLevels, handle_levels, in_space, settled_levels

_friction = lru_cache(maxsize=64)(worst_friction)
"""Worst friction, cached: races that differ only in their eccentricity have the same."""


@dataclass(frozen=True)
class WorstResidual:
    """Displacements 0–peak of the race [m] at one speed [rad/s]; `angles`: where the balls then stand [rad].

    `at_race`: the residual without what a race off the wheel's plane leaves at the loudest place. `vertical`: the same
    with the spindle held vertical, where gravity shakes nothing out; None if the file's spindle is vertical.
    """

    speed: float
    rolling_friction: float
    angles: tuple[float, ...]
    residual: float
    at_race: float
    vertical: "WorstResidual | None" = None

    @property
    def upright(self) -> "WorstResidual":
        """The worst residual of the machine with its spindle vertical."""
        return self if self.vertical is None else self.vertical


def worst_residuals(case: Case, imbalance: float, candidate: Candidate) -> tuple[WorstResidual, ...]:
    """Worst residual displacements at each of the judged speeds, in their order."""
    return tuple(_worst(case, imbalance, candidate, speed) for speed in judged_speeds(case))


def _worst(case: Case, imbalance: float, candidate: Candidate, speed: float) -> WorstResidual:
    """Plain sum of the parts; on a horizontal spindle with the friction that gravity leaves, and upright with all."""
    balls = candidate.balls
    band = case.friction_arm * balls.pitch_radius / balls.radius
    upright = _worst_with(case, imbalance, candidate, speed, band)
    if case.table.machine.spindle_axis == "vertical":
        return upright
    return replace(_worst_with(case, imbalance, candidate, speed, remaining_band(band, speed)), vertical=upright)


def _worst_with(case: Case, imbalance: float, candidate: Candidate, speed: float, band: float) -> WorstResidual:
    """Plain sum of the parts, the race made oval by all balls in two opposite groups; `band`: of the friction [m].

    Friction counts at least as that of evenly spread balls: balls that gravity shakes take long to creep to their end.
    """
    balls, need = candidate.balls, candidate.requirement
    usual = accuracy_budget(case, imbalance, need, balls, candidate.budget.resting_angles, speed)
    mass, carried = case.body.effective_mass(candidate.mass, case.race_place), imbalance * abs(need.plane_ratio)
    flexible = [speed**2 / dynamic_stiffness(case.suspension, axis, speed, mass) for axis in (0, 1)]
    held = _friction(balls.count, balls.moment, band, carried, sum(flexible) / 2)
    friction = max(held.displacement, usual.rolling_friction)
    parts = usual.race_eccentricity, friction, balls.count / 2 * usual.race_ovality, usual.capacity_shortfall
    at_race = math.fsum(parts)
    if not case.race_offset:
        return WorstResidual(speed, friction, held.angles, at_race, at_race)
    loudest = loudest_displacement(case, imbalance, candidate.mass, at_race, in_line=True)
    return WorstResidual(speed, friction, held.angles, loudest / loudest_transmission(case, candidate.mass), at_race)


CURVE_STEPS = 6
"""Steps of the speed range in the curve of level against speed."""


@record
class SpeedLevel(Record):
    """Level with the autobalancer at one speed, at the loudest place."""

    speed: Annotated[float, Quantity("speed", "Ω", 6, unit="rpm")]
    level_after_db: Annotated[float, LEVEL_AFTER]


@dataclass(frozen=True)
class SpeedLevels:
    """Idle levels with the autobalancer over the speed range; nothing where balls cannot balance.

    `by_speed`: as expected; `highest`: the worst of them; `arranged`: the worst where friction holds the balls in the
    worst arrangement and all parts of the budget lie in line. `upright`: that with the spindle held vertical; None if
    the file's spindle is vertical.
    """

    by_speed: tuple[SpeedLevel, ...]
    highest: SpeedLevel
    arranged: SpeedLevel
    upright: SpeedLevel | None = None

    @property
    def louder_upright(self) -> SpeedLevel | None:
        """Worst friction case with the spindle held vertical, if that is louder by what is shown."""
        upright = self.upright
        louder = upright is not None and upright.level_after_db >= self.arranged.level_after_db + SHOWN
        return upright if louder else None


SHOWN: Final = 0.1
"""Difference of two levels [dB] that shows."""


@formula(
    "Idle levels: without autobalancer by the whole imbalance, with it by the residual-displacement budget",
    "v = Ω·w/√2",
    "dB",
    where=(
        "The displacement is multiplied by the motion of the place per motion of the wheel. The louder of x and y "
        "counts. The background is added as energy. If the balls cannot balance, there is no level with the "
        "autobalancer."
    ),
    assumed="steady state",
    source="Kladiev 1996 (level and limit); rigid body and budget are derived here",
)
def idle_vibration(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> VibrationLevels:
    mass = case.body.effective_mass()
    before = imbalance / mass * resonance_factor(case.suspension, case.speed, mass)
    budget = _budget(case, imbalance, candidate, case.speed) if possible else None
    levels = settled_levels(case, before, budget.at_race if budget else None, imbalance, candidate.mass)
    if not (case.body.in_space and case.handles):
        return levels
    return replace(levels, places=in_space(case, imbalance, candidate, budget.at_race if budget else None))


@record
class IdleSpeedLevels(Record):
    """Levels at the motor's idle speed, at the loudest place; None after: balls cannot balance."""

    speed: Annotated[float, Quantity("idle speed of the motor", "Ω", 6, unit="rpm")]
    level_before_db: Annotated[float | None, Quantity("level before", "L")]
    level_after_db: Annotated[float | None, LEVEL_AFTER]
    reduction_db: Annotated[float | None, Quantity("reduction", "ΔL", 3)]


def idle_speed_levels(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> IdleSpeedLevels | None:
    """Levels of `idle_vibration` at the loudest place at the motor's idle speed, where that is not the rated speed."""
    idle = case.idle_speed
    if idle is None or math.isclose(idle, case.speed, rel_tol=EQUAL_SPEEDS):
        return None
    worst = idle_vibration(replace(case, speed=idle), imbalance, candidate, possible).worst
    return IdleSpeedLevels(
        speed=idle, level_before_db=worst.before, level_after_db=worst.after, reduction_db=worst.reduction
    )


def speed_levels(
    case: Case, imbalance: float, candidate: Candidate, worst: Sequence[WorstResidual], possible: bool
) -> SpeedLevels | None:
    """Levels over the speed range, background included."""
    if not possible:
        return None
    transmission = loudest_transmission(case, candidate.mass)

    def at(speed: float, residual: float) -> SpeedLevel:
        return SpeedLevel(
            speed=speed, level_after_db=displacement_level(residual * transmission, speed, case.background_level)
        )

    low, high = case.speed_range
    steps = {low + (high - low) * step / CURVE_STEPS for step in range(CURVE_STEPS)}
    curve = tuple(
        at(speed, _residual(case, imbalance, candidate, speed)) for speed in sorted({*steps, *judged_speeds(case)})
    )
    after = attrgetter("level_after_db")
    highest = max(curve, key=after)
    arranged = max((at(each.speed, each.residual) for each in worst), key=after, default=highest)
    turned = (each.vertical for each in worst if each.vertical is not None)
    upright = max((at(each.speed, each.residual) for each in turned), key=after, default=None)
    return SpeedLevels(curve, highest, arranged, upright)


def _residual(case: Case, imbalance: float, candidate: Candidate, speed: float) -> float:
    return _budget(case, imbalance, candidate, speed).residual


def _budget(case: Case, imbalance: float, candidate: Candidate, speed: float) -> ResidualBudget:
    return accuracy_budget(
        case, imbalance, candidate.requirement, candidate.balls, candidate.budget.resting_angles, speed
    )


@dataclass(frozen=True)
class LevelsUnderLoad:
    """Levels under load, pressed to the work when the balls have settled.

    `steady`: the loudest levels by steady contact, which hold unless wheel and work part, without or with the
    autobalancer. `hasty`: pressed before the balls have settled, where that was simulated; `stays`: whether that is
    another, louder state that stays.
    """

    levels: VibrationLevels
    steady: Levels
    parts_before: bool
    parts_after: bool
    hasty: VibrationLevels | None = None
    stays: bool = False


@formula(
    (
        "Levels under load by steady contact without separation, as information because the contact stiffness is "
        "uncertain"
    ),
    "",
    "dB",
    where=(
        "Without the autobalancer, the imbalance acts with the runout at the file's angle. With it, the balls balance "
        "the forward whirl. The remaining motion is added to the residual of the budget, as the root of the sum of "
        "squares. If the balls cannot balance, or the contact requires more than their capacity, there is no level "
        "with the autobalancer. A face contact does not press radially: the idle levels hold. If the contact force "
        "would have to pull, wheel and workpiece lose contact, and neither level holds. The simulation of grinding "
        "then gives the level with the autobalancer."
    ),
    assumed="wheel and workpiece keep contact",
    source="derived",
)
def loaded_vibration(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> LevelsUnderLoad | None:
    if case.contact is None:
        return None
    bare, loaded = steady_contact(case, 0.0, damped=True), steady_contact(case, candidate.mass, damped=True)
    if bare is None or loaded is None:
        idle = idle_vibration(case, imbalance, candidate, possible)
        return LevelsUnderLoad(idle, idle.worst, parts_before=False, parts_after=False)
    runout, press = cmath.rect(case.runout, math.radians(case.table.wheel.runout_angle_deg)), case.contact.press_force
    before, after = max(map(abs, bare.axis(imbalance, runout))), None
    balancing = loaded.balancing_imbalance(runout)
    carried = abs(balancing - imbalance) * abs(candidate.requirement.plane_ratio) <= candidate.capacity
    balanced = possible and carried and not loaded.balls_increase_imbalance
    if balanced:
        rest = _residual(case, imbalance, candidate, case.speed)
        after = math.hypot(max(map(abs, loaded.axis(balancing, runout))), rest)
    levels = handle_levels(case, before, after, candidate.mass)
    parts_before = abs(bare.normal_force(imbalance, runout)) > press
    parts_after = balanced and abs(loaded.normal_force(balancing, runout)) > press
    valid = handle_levels(case, None if parts_before else before, None if parts_after else after, candidate.mass)
    return LevelsUnderLoad(valid, levels.worst, parts_before, parts_after)


TRUER: Final = (0.9, 0.8, 0.7, 0.6, 0.5, 0.35, 0.25)
"""Shares of the race's eccentricity that are tried, the largest first: no shop is asked for more than is required."""
SMOOTHER: Final = (0.5, 0.25)
"""Shares of the friction's lever arm that are tried."""


def vibration_checks(
    case: Case,
    imbalance: float,
    candidate: Candidate,
    idle: VibrationLevels,
    levels: SpeedLevels | None,
    band: tuple[float, float] | None = None,
) -> tuple[Finding, Check]:
    """The idle level against the limit over the speed range, and the check that the autobalancer lowers it.

    `band`: of the highest level [dB], if the inertia is estimated.
    """
    limit, before, after = case.level_limit, idle.worst.before, idle.worst.after
    if after is None or levels is None:
        reason = "The level is not known: the balls cannot balance at these speeds"
        unknown = Finding("not-done", reason, None, limit)
        return unknown, coded("ABU402", *unknown._replace(limit=before))
    message = "The idle level with the autobalancer must be below the level without it"
    measurable, alike = measurably_lower(idle), before is not None and abs(after - before) < LEVEL_ERROR
    if not measurable and (idle.lowered or alike):
        much = f"lower by less than {LEAST_GAIN:g} dB" if idle.lowered else f"higher by less than {LEVEL_ERROR:g} dB"
        message += f". It is {much}, which no measurement tells from none"
    return (
        _level(case, levels, loudest_place(idle), band),
        coded("ABU402", verdict(idle.lowered or alike, measurable), message, after, before,
              None if measurable or candidate.budget.capacity_shortfall else NOT_NEEDED),
    )  # fmt: skip


NOT_NEEDED: Final = "The wheel is balanced better than balls can balance it: no autobalancer is needed."
LEAST_GAIN: Final = 1.0
"""Reduction of the idle level [dB] that a measurement tells from none (engineering practice, unverified)."""
LEVEL_ERROR: Final = 0.3
"""Error of a level [dB]: a smaller difference is none."""


def measurably_lower(idle: VibrationLevels) -> bool:
    """True if the wheel moves less with the autobalancer, and the level falls by as much as can be measured."""
    before, after = idle.worst.before, idle.worst.after
    return idle.lowered and before is not None and after is not None and before - after >= LEAST_GAIN


def loudest_place(vibration: VibrationLevels) -> str:
    """The loudest place in words: a handle, or the wheel plane if the file defines no handle."""
    return "Wheel plane" if vibration.judged == WHEEL_PLANE else f'Handle "{vibration.judged}"'


def decibels(level: float, limit: float) -> str:
    """A level as text that is not shown on the other side of its limit.

    >>> decibels(108.04, 109.0), decibels(109.03, 109.0)
    ('108.0 dB', '109.03 dB')
    """
    return next(
        (f"{level:.{digits}f} dB" for digits in (1, 2, 3) if (round(level, digits) <= limit) == (level <= limit)),
        f"{level:.4f} dB",
    )


def _level(case: Case, levels: SpeedLevels, place: str, band: tuple[float, float] | None) -> Finding:
    """Fails on the level as expected where it is highest; the bound of friction is told.

    On a horizontal spindle gravity shakes out friction that holds the balls. Hand tools get turned, so that the message
    gives the bound with the spindle vertical, too.
    """
    limit, highest, arranged = case.level_limit, levels.highest, levels.arranged
    kept = highest.level_after_db <= limit
    of_range = "" if len(levels.by_speed) == 1 else ", the loudest speed of the range"
    there = "" if arranged.speed == highest.speed else f" at {_rpm(arranged)}"
    message = (
        f"{place}, {_rpm(highest)}{of_range}: expected {decibels(highest.level_after_db, limit)} (limit {limit:g} dB). "
        f"Bound of friction{there}: {decibels(arranged.level_after_db, limit)}"
    )
    upright = levels.louder_upright
    if upright is not None:
        message += f". With the spindle held vertical: {decibels(upright.level_after_db, limit)}"
    background, action = case.background_level, None
    if background is not None and background >= limit:
        action = (
            f"The background alone is {background:.4g} dB (limit {limit:g} dB), and no autobalancer lowers it. Use a "
            "quieter machine, or change limits.vibration_level_db."
        )
    within = band is None or band[1] <= limit
    if band is not None:
        low, high = (decibels(level, limit) for level in band)
        message += f". The estimated inertia leaves {low.removesuffix(' dB')} … {high} as expected"
    if kept and not within:
        action = "Measure the inertia: the band of the estimate crosses the limit."
    return Finding(verdict(kept, within), message, highest.level_after_db, limit, action)


def level_of(after: Followed) -> float:
    """Highest expected level [dB] over the speed range."""
    levels = speed_levels(*after, (), possible=True)
    return math.inf if levels is None else levels.highest.level_after_db


LEAST_FRICTION_MM: Final = 0.0005
"""Lever arm of rolling friction that a hard, ground and clean race attains."""


def smoother(friction_mm: float, share: float) -> float:
    """A share of the lever arm of rolling friction [mm], no less than a clean race attains.

    >>> smoother(0.004, 0.5), smoother(0.0008, 0.5), smoother(0.0003, 0.5)
    (0.002, 0.0005, 0.0003)
    """
    return max(_rounded(share * friction_mm), min(LEAST_FRICTION_MM, friction_mm))


FEASIBLE_MM: Final = 0.005
"""Race eccentricity that careful work attains with a standard fit, a ground race and its spindle (assumed)."""


def feasible_mm(least: float) -> float:
    """Least race eccentricity [mm] of standard fits that hold the `least` [m], and of careful work."""
    return max(FEASIBLE_MM, from_si(least, "mm"))


def truer(eccentricity_mm: float, least: float) -> list[float]:
    """Smaller race eccentricities [mm] on whole micrometres, the largest first.

    None is less than standard fits hold [m], or than careful work attains.

    >>> truer(0.01, 2.61e-6), truer(0.0065, 2.61e-6), truer(0.01, 7.3e-6), truer(0.004, 2.61e-6)
    ([0.009, 0.008, 0.007, 0.006, 0.005], [0.006, 0.005], [0.009, 0.008], [])
    """
    shares = dict.fromkeys(round(share * eccentricity_mm, 3) for share in TRUER)
    lowest = feasible_mm(least)
    return [value for value in shares if lowest <= value < eccentricity_mm]


def truer_races(case: Case, least: float) -> Iterator[dict[str, object]]:
    """Entries of a race that is less eccentric, down to the `least` [m], or has less friction, or both."""
    abu = case.autobalancer
    true: list[dict[str, object]] = [
        {"autobalancer.race_eccentricity_mm": value} for value in truer(abu.race_eccentricity_mm, least)
    ]
    arms = dict.fromkeys(smoother(abu.rolling_friction_mm, share) for share in SMOOTHER)
    smooth: list[dict[str, object]] = [
        {"autobalancer.rolling_friction_mm": arm} for arm in arms if arm < abu.rolling_friction_mm
    ]
    yield from (*true, *smooth)
    yield from ({**arm, **value} for arm in smooth for value in true)


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def _rpm(level: SpeedLevel) -> str:
    return f"{level.speed_rpm:.6g} rpm"
