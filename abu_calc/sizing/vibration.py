"""Step 7: velocity levels before and after, idle and under load, at every handle."""

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace

from abu_calc.formula import formula
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.frozen import dataclass
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import accuracy_budget, displacement_level, judged_speeds, loudest_transmission
from abu_calc.sizing.capacity import steady_contact
from abu_calc.sizing.case import EQUAL_SPEEDS, Case
from abu_calc.sizing.worst import WorstResidual

CURVE_STEPS = 6
"""Steps of the speed range in the curve of level against speed."""


@dataclass(frozen=True)
class Levels:
    """Levels [dB] without and with the autobalancer; `after` is null where balls cannot balance, each under load where
    it is not known.
    """

    before: float | None
    after: float | None

    @property
    def reduction(self) -> float | None:
        """before − after [dB]."""
        return None if self.before is None or self.after is None else self.before - self.after


@dataclass(frozen=True)
class Place:
    """A handle, or the wheel plane; `effective_mass` [kg] is imbalance at the wheel over the motion it makes here."""

    name: str
    effective_mass: float | None
    levels: Levels


@dataclass(frozen=True)
class LevelAtSpeed:
    """Level with the autobalancer [dB] at the loudest place, at a speed [rad/s]."""

    speed: float
    after: float


@dataclass(frozen=True)
class Vibration:
    """Levels at the rated speed where the machine is held (the wheel plane when no handle is given).

    `worst` is the loudest place; `lowered`: whether the wheel itself moves less with the autobalancer.
    """

    places: tuple[Place, ...]
    worst: Levels
    lowered: bool


@dataclass(frozen=True)
class SpeedLevels:
    """Idle levels with the autobalancer over the speed range; nothing where balls cannot balance.

    `by_speed`: as expected; `highest`: the worst of them; `arranged`: the worst where friction holds the balls in the
    worst arrangement and all parts of the budget lie in line.
    """

    by_speed: tuple[LevelAtSpeed, ...]
    highest: LevelAtSpeed
    arranged: LevelAtSpeed


@formula(
    "Idle levels: before, the whole imbalance without autobalancer; after, what the accuracy budget leaves",
    "v = Ω·w/√2",
    "dB",
    where=(
        "Times the motion of the place per motion of the wheel; in the louder of x and y; the background added as "
        "energy. Where balls cannot balance there is no level after."
    ),
    assumed="steady state",
    source="Kladiev 1996 (level and limit); the rigid body and the budget are ours",
)
def idle_vibration(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> Vibration:
    mass = case.body.effective_mass()
    before = imbalance / mass * resonance_factor(case.suspension, case.speed, mass)
    return handle_levels(
        case, before, _residual(case, imbalance, candidate, case.speed) if possible else None, candidate.mass
    )


def idle_speed_levels(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> Levels | None:
    """Levels of `idle_vibration` at the loudest place at the motor's idle speed, where that is not the rated speed."""
    idle = case.idle_speed
    if idle is None or math.isclose(idle, case.speed, rel_tol=EQUAL_SPEEDS):
        return None
    return idle_vibration(replace(case, speed=idle), imbalance, candidate, possible).worst


def speed_levels(
    case: Case, imbalance: float, candidate: Candidate, worst: Sequence[WorstResidual], possible: bool
) -> SpeedLevels | None:
    """Levels over the speed range, background included."""
    if not possible:
        return None
    transmission = loudest_transmission(case, candidate.mass)

    def at(speed: float, residual: float) -> LevelAtSpeed:
        return LevelAtSpeed(speed, displacement_level(residual * transmission, speed, case.background_level))

    low, high = case.speed_range
    steps = {low + (high - low) * step / CURVE_STEPS for step in range(CURVE_STEPS)}
    curve = tuple(
        at(speed, _residual(case, imbalance, candidate, speed)) for speed in sorted({*steps, *judged_speeds(case)})
    )
    highest, arranged = max(curve, key=_after), max((at(each.speed, each.residual) for each in worst), key=_after)
    return SpeedLevels(curve, highest, arranged)


def _after(level: LevelAtSpeed) -> float:
    return level.after


def _residual(case: Case, imbalance: float, candidate: Candidate, speed: float) -> float:
    return accuracy_budget(
        case, imbalance, candidate.requirement, candidate.balls, candidate.budget.resting_angles, speed
    ).residual


@dataclass(frozen=True)
class Loaded:
    """Levels under load, pressed to the work when the balls have settled.

    `steady`: the loudest levels by steady contact, which hold unless wheel and work part, without or with the
    autobalancer. `hasty`: pressed before the balls have settled, where that was simulated; `stays`: whether that is
    another, louder state that stays.
    """

    levels: Vibration
    steady: Levels
    parts_before: bool
    parts_after: bool
    hasty: Vibration | None = None
    stays: bool = False


@formula(
    "Levels under load by steady contact without separation: information, the contact's stiffness is uncertain",
    "",
    "dB",
    where=(
        "Before: the imbalance and the runout at the file's angle, without autobalancer. After: the balls balance the "
        "forward whirl, and what stays is added to the budget's residual as squares; none where balls cannot balance, "
        "or where the contact asks for more than they carry. A face contact does not press radially: idle. Where the "
        "force between wheel and work would pull, they part, and neither holds: the simulation of grinding gives the "
        "level after."
    ),
    assumed="no separation of wheel and work",
    source="derived",
)
def loaded_vibration(case: Case, imbalance: float, candidate: Candidate, possible: bool) -> Loaded | None:
    if case.contact is None:
        return None
    bare, loaded = steady_contact(case, 0.0, damped=True), steady_contact(case, candidate.mass, damped=True)
    if bare is None or loaded is None:
        idle = idle_vibration(case, imbalance, candidate, possible)
        return Loaded(idle, idle.worst, parts_before=False, parts_after=False)
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
    return Loaded(valid, levels.worst, parts_before, parts_after)


def handle_levels(case: Case, before: float | None, after: float | None, added_mass: float) -> Vibration:
    """Levels at every handle of displacements at the wheel [m] at the rated speed, None: not known."""
    handles = [(handle.name, handle.place) for handle in case.handles] or [("wheel plane", case.body.wheel)]
    places = []
    for name, place in handles:
        bare = None if before is None else _level(case, before * case.body.transmission(place))
        fitted = None if after is None else _level(case, after * case.body.transmission(place, added_mass))
        inertance = abs(case.body.inertance(place, case.body.wheel, added_mass))
        places.append(Place(name, 1 / inertance if inertance else None, Levels(bare, fitted)))
    worst = Levels(_loudest(each.levels.before for each in places), _loudest(each.levels.after for each in places))
    return Vibration(tuple(places), worst, before is not None and after is not None and after < before)


def _loudest(levels: Iterable[float | None]) -> float | None:
    return max((level for level in levels if level is not None), default=None)


def level_at_loudest(case: Case, candidate: Candidate, displacement: float) -> float:
    """The level [dB] at the loudest handle of a displacement 0–peak [m] of the race, idle.

    What rests at a wheel off the race's plane is added as squares.
    """
    places = [handle.place for handle in case.handles] or [case.body.wheel]
    at_wheel = math.hypot(displacement, candidate.budget.plane_offset)
    return max(_level(case, at_wheel * case.body.transmission(place, candidate.mass)) for place in places)


def _level(case: Case, displacement: float) -> float:
    return displacement_level(displacement, case.speed, case.background_level)
