"""Step 7: velocity levels before and after, idle and under load, at every handle."""

import math
from dataclasses import dataclass

from abu_calc.checks import Check, verdict
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.capacity import steady_contact
from abu_calc.sizing.case import Case
from abu_calc.sizing.suspension import resonance_factor
from abu_calc.units import level_from_velocity, velocity_from_level


@dataclass(frozen=True)
class Levels:
    """Levels [dB] at one place without and with the autobalancer."""

    before: float
    after: float

    @property
    def reduction(self) -> float:
        """before − after [dB]."""
        return self.before - self.after


@dataclass(frozen=True)
class Vibration:
    """Levels where the machine is held (the wheel plane when no handle is given); `worst` is the loudest place."""

    places: tuple[tuple[str, Levels], ...]
    worst: Levels


def idle_vibration(case: Case, imbalance: float, one: Candidate) -> Vibration:
    """Idle levels: before, the whole imbalance without autobalancer; after, what the accuracy budget leaves.

    v = Ω·w/√2 rms of the displacement w at the wheel, times the motion of the place per motion of the wheel; in the
    louder of x and y; the background added as energy. Range: steady state at the rated speed. Source: Kladiev 1996
    (level and limit); the rigid body and the budget are ours.
    """
    resonance = resonance_factor(case.suspension, case.speed, case.body.effective_mass())
    before = imbalance / case.body.effective_mass() * resonance
    return _vibration(case, before, one.budget.residual, one.mass)


def loaded_vibration(case: Case, imbalance: float, one: Candidate) -> Vibration | None:
    """Levels under load by steady contact without separation: information, the contact's stiffness is uncertain.

    Before: the imbalance and the runout at the file's angle, without autobalancer. After: the balls balance the forward
    whirl, and what stays is added to the budget's residual as squares. A face contact does not press radially: idle.
    """
    if case.contact is None:
        return None
    bare, loaded = steady_contact(case, 0.0, damped=True), steady_contact(case, one.mass, damped=True)
    if bare is None or loaded is None:
        return idle_vibration(case, imbalance, one)
    angle = math.radians(case.table.wheel.runout_angle_deg)
    runout = case.runout * complex(math.cos(angle), math.sin(angle))
    before = max(map(abs, bare.axis(imbalance, runout)))
    balanced = max(map(abs, loaded.axis(loaded.balancing_imbalance(runout), runout)))
    return _vibration(case, before, math.hypot(balanced, one.budget.residual), one.mass)


def _vibration(case: Case, before: float, after: float, added_mass: float) -> Vibration:
    handles = [(handle.name, handle.place) for handle in case.handles] or [("wheel plane", case.body.wheel)]
    places = tuple(
        (
            name,
            Levels(
                _level(case, before * case.body.transmission(place)),
                _level(case, after * case.body.transmission(place, added_mass)),
            ),
        )
        for name, place in handles
    )
    worst = Levels(max(levels.before for _, levels in places), max(levels.after for _, levels in places))
    return Vibration(places, worst)


def _level(case: Case, displacement: float) -> float:
    """Level of a displacement 0–peak [m] with the background; a place at rest is given the floor of 0 dB."""
    background = case.table.machine.background_level_db
    noise = velocity_from_level(background) if background is not None else 0.0
    velocity = math.hypot(displacement * case.speed / math.sqrt(2), noise)
    return level_from_velocity(max(velocity, velocity_from_level(0.0)))


def vibration_checks(case: Case, idle: Vibration) -> tuple[Check, ...]:
    """The idle level against the limit, and that the autobalancer lowers it."""
    limit, after = case.table.limits.vibration_level_db, idle.worst.after
    lower = idle.worst.reduction > 0
    return (
        Check("ABU401", "idle vibration level", verdict(after <= limit), "expected with the autobalancer at the worst "
              "handle, limit of the file", after, limit, "dB",
              None if after <= limit else "Smaller race eccentricity, a harder and cleaner race, larger balls."),
        Check("ABU402", "level lowered", verdict(lower), "with the autobalancer against without, idle", after,
              idle.worst.before, "dB",
              None if lower else "The wheel is balanced better than balls can do: no autobalancer is needed."),
    )  # fmt: skip
