"""Step 7: velocity levels before and after, idle and under load, at every handle."""

import cmath
import math
from dataclasses import dataclass

from abu_calc.checks import Check, coded, verdict
from abu_calc.formula import formula
from abu_calc.formulas.suspension import resonance_factor
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.budget import displacement_level
from abu_calc.sizing.capacity import steady_contact
from abu_calc.sizing.case import Case


@dataclass(frozen=True)
class Levels:
    """Levels [dB] without and with the autobalancer; `after` is null where balls cannot balance."""

    before: float
    after: float | None

    @property
    def reduction(self) -> float | None:
        """before − after [dB]."""
        return None if self.after is None else self.before - self.after


@dataclass(frozen=True)
class Place:
    """A handle, or the wheel plane; `effective_mass` [kg] is imbalance at the wheel over the motion it makes here."""

    name: str
    effective_mass: float | None
    levels: Levels


@dataclass(frozen=True)
class Vibration:
    """Levels where the machine is held (the wheel plane when no handle is given).

    `worst` is the loudest place; `lowered`: whether the wheel itself moves less with the autobalancer.
    """

    places: tuple[Place, ...]
    worst: Levels
    lowered: bool


@formula(
    "Idle levels: before, the whole imbalance without autobalancer; after, what the accuracy budget leaves",
    "v = Ω·w/√2",
    "dB",
    where=(
        "v rms of the displacement w at the wheel, times the motion of the place per motion of the wheel; in the "
        "louder of x and y; the background added as energy. Where balls cannot balance there is no level after."
    ),
    assumed="steady state at the rated speed",
    source="Kladiev 1996 (level and limit); the rigid body and the budget are ours",
)
def idle_vibration(case: Case, imbalance: float, one: Candidate, possible: bool) -> Vibration:
    mass = case.body.effective_mass()
    before = imbalance / mass * resonance_factor(case.suspension, case.speed, mass)
    return _vibration(case, before, one.budget.residual if possible else None, one.mass)


@formula(
    "Levels under load by steady contact without separation: information, the contact's stiffness is uncertain",
    "",
    "dB",
    where=(
        "Before: the imbalance and the runout at the file's angle, without autobalancer. After: the balls balance the "
        "forward whirl, and what stays is added to the budget's residual as squares; none where balls cannot balance, "
        "or where the contact asks for more than they carry. A face contact does not press radially: idle."
    ),
    assumed="no separation of wheel and work",
    source="derived",
)
def loaded_vibration(case: Case, imbalance: float, one: Candidate, possible: bool) -> Vibration | None:
    if case.contact is None:
        return None
    bare, loaded = steady_contact(case, 0.0, damped=True), steady_contact(case, one.mass, damped=True)
    if bare is None or loaded is None:
        return idle_vibration(case, imbalance, one, possible)
    runout = cmath.rect(case.runout, math.radians(case.table.wheel.runout_angle_deg))
    before = max(map(abs, bare.axis(imbalance, runout)))
    balancing = loaded.balancing_imbalance(runout)
    carried = abs(balancing - imbalance) * abs(one.requirement.plane_ratio) <= one.capacity
    if not (possible and carried) or loaded.balls_increase_imbalance:
        return _vibration(case, before, None, one.mass)
    after = math.hypot(max(map(abs, loaded.axis(balancing, runout))), one.budget.residual)
    return _vibration(case, before, after, one.mass)


def _vibration(case: Case, before: float, after: float | None, added_mass: float) -> Vibration:
    handles = [(handle.name, handle.place) for handle in case.handles] or [("wheel plane", case.body.wheel)]
    places = []
    for name, place in handles:
        bare = _level(case, before * case.body.transmission(place))
        fitted = None if after is None else _level(case, after * case.body.transmission(place, added_mass))
        inertance = abs(case.body.inertance(place, case.body.wheel, added_mass))
        places.append(Place(name, 1 / inertance if inertance else None, Levels(bare, fitted)))
    loudest = [place.levels.after for place in places if place.levels.after is not None]
    worst = Levels(max(place.levels.before for place in places), max(loudest, default=None))
    return Vibration(tuple(places), worst, after is not None and after < before)


def level_at_loudest(case: Case, one: Candidate, displacement: float) -> float:
    """The level [dB] at the loudest handle of a displacement 0–peak [m] of the race, idle.

    What rests at a wheel off the race's plane is added as squares.
    """
    places = [handle.place for handle in case.handles] or [case.body.wheel]
    at_wheel = math.hypot(displacement, one.budget.plane_offset)
    return max(_level(case, at_wheel * case.body.transmission(place, one.mass)) for place in places)


def _level(case: Case, displacement: float) -> float:
    return displacement_level(displacement, case.speed, case.background_level)


def vibration_checks(case: Case, idle: Vibration) -> tuple[Check, ...]:
    """The idle level against the limit, and that the autobalancer lowers it."""
    limit, before, after = case.level_limit, idle.worst.before, idle.worst.after
    if after is None:
        reason = "not known, since the balls cannot balance at these speeds"
        allowed = {"ABU401": limit, "ABU402": before}
        return tuple(coded(code, "not-done", reason, None, most, "dB") for code, most in allowed.items())
    lower = idle.lowered
    return (
        coded("ABU401", verdict(after <= limit), "expected with the autobalancer at the worst handle, limit of the "
              "file", after, limit, "dB",
              None if after <= limit else "Smaller race eccentricity, a harder and cleaner race, larger balls."),
        coded("ABU402", verdict(lower), "with the autobalancer against without, idle", after, before, "dB",
              None if lower else "The wheel is balanced better than balls can do: no autobalancer is needed."),
    )  # fmt: skip
