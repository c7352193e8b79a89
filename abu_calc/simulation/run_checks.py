"""Checks of one run of a machine against the limits in its file."""

import math
from collections.abc import Callable
from typing import Annotated, Final

from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.checks import Check, coded, overall, verdict
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity
from abu_calc.simulation.quiet import LAST
from abu_calc.simulation.residual_criteria import SLIPPING, allowed_imbalance, balances, slip
from abu_calc.simulation.response import Response
from abu_calc.sizing.budget import displacement_level
from abu_calc.sizing.case import WHEEL_PLANE
from abu_calc.sizing.design import Design

HELD: Final = frozenset({"idle", "run-up", "grinding"})
"""Scenes of a machine that is held where its handles are; on a swing arm it is not."""
LIMITED: Final = frozenset({"idle", "run-up"})
"""Scenes that the limits of a file are for; under load a level is information."""
Level = Callable[[float], float]
"""Function from the rms velocity of the axis [m/s] to the level [dB]."""
TRIES: Final = "`abu size FILE` simulates changes that help."


@record
class SimulatedLevel(Record):
    """Level at one place where the machine is held, by the simulated motion."""

    name: Annotated[str, Quantity("place")]
    level: Annotated[float, Quantity("level", "L", unit="db")]


def levels_at_places(design: Design, response: Response) -> tuple[SimulatedLevel, ...]:
    """Levels where the machine is held: what the race plane does, carried there as by a free rigid body.

    What balls in another plane than the imbalance's leave when they hold the race still is added as squares; a
    background as energy. Valid well above the suspension, as in sizing. The wheel plane of a body in space, whose level
    is limited, comes last. No places for a machine on a swing arm.
    """
    held = _held(design, response) if response.scene in HELD else []
    return tuple(SimulatedLevel(name=name, level=level(response.velocity_rms)) for name, level in held)


def _held(design: Design, response: Response) -> list[tuple[str, Level]]:
    """The level at each place where the machine is held, of a velocity."""
    case = design.case
    places = dict.fromkeys((*case.places, *case.judged_places))
    return [(held.name, _level_of(design, response, held.place)) for held in places]


def loudest(design: Design, response: Response) -> Level:
    """The level at the loudest place whose level is limited, of a velocity.

    On a swing arm, where it is not, that on the axis.
    """
    levels: list[Level] = [level_from_velocity]
    if response.scene in HELD:
        levels = [_level_of(design, response, held.place) for held in design.case.judged_places]
    return lambda velocity: max(level(velocity) for level in levels)


def level_at(design: Design, response: Response, place: Vector) -> float:
    """The level [dB] at a place [m] from the centre of mass, as `levels_at_places`."""
    return _level_of(design, response, place)(response.velocity_rms)


def _level_of(design: Design, response: Response, place: Vector) -> Level:
    """The level of the loudest axis at a place [m] at the speed that the run ends with."""
    case, added, speed = design.case, design.autobalancer.mass, abs(response.final.rotor_speed) or design.case.speed
    body, race = case.body, case.race_place
    imbalance, balls = design.imbalance.value, design.imbalance.value * design.autobalancer.requirement.plane_ratio
    held = body.inertance(race, race, added)
    by_race = body.body.acceleration(place, race, added=added)
    by_wheel = body.body.acceleration(place, body.wheel, added=added)
    count = 2 if place == body.wheel else 3
    axes = [(abs(at), abs(imbalance * wheel - balls * at)) for at, wheel in zip(by_race, by_wheel, strict=True)][:count]

    def level(velocity: float) -> float:
        """Level [dB] at the place, by the rms velocity [m/s] of the race."""
        swing = math.sqrt(2) * velocity / speed / held
        moved = max(math.hypot(swing * at, beside) for at, beside in axes)
        return displacement_level(moved, speed, case.background_level)

    return level


def one_run_checks(
    design: Design, response: Response, start: str, error: float = 0.0, *, asked: bool = False
) -> tuple[Check, ...]:
    """Check that the balls balance, the machine is quiet in time and keeps the level.

    Only scenes that idle at full speed are checked. `start`: the start case in words; `error`: of the run,
    relative; `asked`: the user set its duration. If such a run ends too soon to judge, the checks are NOT
    EVALUATED. After a run-up, times count from full speed.
    """
    if response.scene not in LIMITED:
        return ()
    ramp, limit = response.full_speed, design.case.table.limits.longest_quiet_time
    counted = f". It counts from full speed, after {ramp:.3g} s" if ramp else ""
    motor = (check for check in design.checks if check.key == "motor_idle_speed")
    checks = (*motor, *_balancing(design, response, f"Start: {start}{counted}"), _level(design, response, error))
    if asked and LAST * response.duration < ramp + limit and overall(checks) == "fail":
        reason = f"The run ends after {response.duration:.3g} s, before the limit of the quiet time"
        remedy = "Specify a longer run (--duration, Python: duration_s=)."
        return tuple(coded(check.code, "not-done", reason, remedy=remedy) for check in checks)
    return checks


def _balancing(design: Design, response: Response, start: str) -> tuple[Check, ...]:
    """Check that the balls balance, that the machine is quiet in time, and that its balls rest in time if asked for.

    NOT EVALUATED if balls side by side cannot carry the imbalance.
    """
    autobalancer = design.autobalancer
    moved = design.imbalance.value * abs(autobalancer.requirement.plane_ratio)
    if autobalancer.capacity < moved:
        reason = "The balls, side by side, cannot carry the imbalance"
        remedy = "Add balls or specify larger ones."
        return coded("ABU701", "not-done", reason, remedy=remedy), coded("ABU702", "not-done", reason, remedy=remedy)
    left, allowed = response.residual_imbalance, allowed_imbalance(design, moved)
    slipping = slip(response, abs(response.final.rotor_speed) or design.case.speed)
    balanced = balances(left, allowed, slipping)
    message = "The balls end opposite the imbalance"
    if slipping > SLIPPING:
        message = "The balls stall: they keep turning more slowly than the rotor"
    elif not balanced:
        worse = "The balls gather on the heavy side and increase the imbalance"
        message = worse if left > moved else "The balls reduce the imbalance, but do not balance it"
    message += ". The value is the imbalance left"
    return (
        coded("ABU701", verdict(balanced), message, left, allowed, None if balanced else TRIES),
        _quiet(design, response, start),
    )  # fmt: skip


def _quiet(design: Design, response: Response, start: str) -> Check:
    """The quiet time against its limit, and the rest time where the file limits it."""
    limits = design.case.table.limits
    quiet, rest, longest = response.quiet_time, response.rest_time, limits.rest_time_s
    soon = quiet is not None and quiet <= limits.longest_quiet_time
    rests = longest is None or (rest is not None and rest <= longest)
    rested = "The balls still creep at the end" if response.creeping else f"The balls rest after {_seconds(rest)}"
    message = f"{start}. {rested}" + ("" if longest is None else f" (limit {longest:g} s)")
    good = soon and rests
    return coded("ABU702", verdict(good, good and not response.creeping), message, quiet, limits.longest_quiet_time,
        None if good else TRIES,
    )  # fmt: skip


def _seconds(time: float | None) -> str:
    return "more than the run" if time is None else f"{time:#.3g} s"


def _level(design: Design, response: Response, error: float) -> Check:
    """The loudest place against the limit; a warning where the error of the run leaves it open."""
    judged = [SimulatedLevel(name=held.name, level=level_at(design, response, held.place))
              for held in design.case.judged_places]  # fmt: skip
    loudest, limit = max(judged, key=lambda place: place.level), design.case.level_limit
    passed, safe = loudest.level <= limit, loudest.level + 20 * math.log10(1 + error) <= limit
    place = "in the wheel plane" if loudest.name == WHEEL_PLANE else f'at the handle "{loudest.name}"'
    message = f"The level {place} at the end of this run"
    if passed and not safe:
        message += f". The error of {error:.2g} leaves open whether the limit is kept"
    remedy = None if passed and safe else TRIES if not passed else "Specify more accuracy (--accuracy)."
    return coded("ABU401", verdict(passed, safe), message, loudest.level, limit, remedy)
