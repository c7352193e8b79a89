"""Checks of one run of a machine against the limits in its file.

Criteria by which the balls of a run count as balancing, as lingering, and a machine as staying quiet.
"""

import math
from collections.abc import Callable
from typing import Annotated, Final

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.steady_motion import reference_imbalance
from abu_calc.formulas.friction_band import friction_band
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.formulas.rigid_body import Vector
from abu_calc.formulas.slow_motion import shaken_drag
from abu_calc.foundation.checks import Check, coded, overall, verdict
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import level_from_velocity
from abu_calc.simulation.quiet import LAST
from abu_calc.simulation.response import Response
from abu_calc.sizing.budget import displacement_level
from abu_calc.sizing.case import WHEEL_PLANE
from abu_calc.sizing.design import Design

HALF = 0.5
"""Share of the imbalance that friction may leave."""

SLIPPING = 0.05
"""Share of the rotor's speed: balls stall if their mean speed against the race stays above it."""


def slip(response: Response, speed: float) -> float:
    """The largest mean speed of a ball against its race over the rotor's, at the end of a run."""
    return max(map(abs, response.final.ball_speeds), default=0.0) / speed


def allowed_imbalance(design: Design, moved: float, felt: float | None = None) -> float:
    """Allowed residual imbalance [kg m]: a tenth of the imbalance, plus unavoidable shares.

    Eccentricity and dry friction leave some imbalance in any case. Dry friction counts in its worst
    arrangement, as on a vertical spindle: on a horizontal one gravity shakes balls free, but slowly. With
    it at most half the imbalance is allowed: leaving more would be no balancing. A design without worst
    arrangements takes the friction of evenly spread balls: the least that is allowed.

    `felt`: effective mass for the balls [kg]; None: that of the machine in hand.
    """
    autobalancer = design.autobalancer
    mass, budget = felt or autobalancer.requirement.effective_mass, autobalancer.budget
    tenth = SETTLED * max(moved, HARDLY * autobalancer.static_moment) + mass * budget.race_eccentricity
    worst = max((each.upright.rolling_friction for each in design.worst), default=0.0)
    return max(tenth + mass * budget.rolling_friction, min(tenth + mass * worst, HALF * moved))


def allowed_of_scene(scene: Scene, ball_angles: tuple[float, ...]) -> float:
    """Allowed residual imbalance [kg m] of a scene given outright, for balls that rest at these angles [rad].

    A tenth of the imbalance, and what eccentricity and dry friction leave; with friction at most half of it.
    """
    mass = scene.support.felt_mass
    eccentric, rolling = scene.effect("race_eccentricity"), scene.effect("dry_rolling_friction")
    tenth = SETTLED * reference_imbalance(scene) + mass * getattr(eccentric, "magnitude", 0.0)
    if rolling is None:
        return tenth
    arm, radius = getattr(rolling, "lever_arm", 0.0), getattr(rolling, "ball_radius", 1.0)
    bands = (friction_band(arm, race.pitch_radius, radius, own) for race, own in scene.by_race(ball_angles))
    held = max(bands, default=0.0)
    return max(tenth, min(tenth + mass * held, HALF * scene.imbalance))


def balances(left: float, allowed: float, slipping: float) -> bool:
    """True if the balls are at rest in their race and the imbalance left [kg m] is allowed."""
    return slipping <= SLIPPING and left <= allowed


LINGERING: Final = 0.1
"""Share of the imbalance: if balls leave more beyond what they leave balanced, they are not balanced."""

MARGIN: Final = 1.0
"""Distance below the permitted level [dB]: a run that may come nearer does not end early."""


def felt_mass(design: Design, scene: Scene) -> float:
    """Effective mass [kg] for the balls: at the race of a machine in hand, or that of its arm, J_O/l²."""
    if not scene.name.startswith("swing-arm"):
        return design.autobalancer.requirement.effective_mass
    return scene.support.felt_mass + sum(scene.ball_masses)


def linger(design: Design, scene: Scene, imbalance: float) -> bool:
    """True if balls that friction does not hold leave an imbalance [kg m] as elsewhere than where they balance.

    Sooner or later they go there.

    On a horizontal spindle gravity shakes them loose, see `shaken_drag`.
    """
    held = _friction_arm(scene) > 0 and not _shaken(design, scene)
    return not held and abs(imbalance - abs(_balanced(design, scene))) > LINGERING * reference_imbalance(scene)


def kept_quiet(scene: Scene, velocity: float, louder: float) -> bool:
    """True if a machine of this velocity [m/s] stays quiet, by `MARGIN`, though its level rises by so much [dB]."""
    quiet = scene.quiet_velocity
    return quiet is None or velocity * 10 ** ((louder + MARGIN) / 20) <= quiet


def _balanced(design: Design, scene: Scene) -> complex:
    """Imbalance [kg m] that the balls leave where they balance."""
    eccentricity = scene.effect("race_eccentricity")
    offset = eccentricity.offset if isinstance(eccentricity, RaceEccentricityEffect) else 0j
    return felt_mass(design, scene) * offset


def _shaken(design: Design, scene: Scene) -> float:
    """Drag rate [1/s] that friction adds where gravity shakes the balls; 0 on a vertical spindle."""
    autobalancer = design.autobalancer
    if scene.effect("gravity") is None:
        return 0.0
    arm, radius = _friction_arm(scene), autobalancer.ball_diameter / 2
    return shaken_drag(arm, radius, autobalancer.pitch_radius, scene.speed, design.case.inertia_factor)


def _friction_arm(scene: Scene) -> float:
    """Lever arm of dry rolling friction [m]; 0 without it."""
    return float(getattr(scene.effect("dry_rolling_friction"), "lever_arm", 0.0))


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
