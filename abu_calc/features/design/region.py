"""Stability of the idle machine over its speeds without approximations, and starts that dry friction ends.

`true_region` gives the frequency region in which the idle balanced state is stable, by eigenvalues. `stuck_balls`
counts the start cases at whose end dry friction holds every ball at rest in its race.

Stability of balls in a body in space, where the planar model leaves something out: gyroscopic moments, hands.

The planar model has the effective mass m_F on the springs of the file. On springs of one frequency that is enough. A
rotor with gyroscopic moments moves the boundary by 0.6 … 3 %, and hands hold the body at its handles.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Final

import numpy as np

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.stability.boundaries import StabilityBoundary, excess_of, limits_of_all, quick
from abu_calc.dynamics.stability.stall import HangingBounds
from abu_calc.dynamics.stability.two_modes import LinearMotion
from abu_calc.dynamics.stability.verdict import MARGIN, Search, judged, searched
from abu_calc.dynamics.switching.stick_slip import AT_REST
from abu_calc.features.design.changes import design_with, more_damping
from abu_calc.features.grinding.formulas import growing_roots
from abu_calc.formulas.body_motion import BodyMotion, whirl_receptances
from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, Grade, coded
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import shown
from abu_calc.simulation.ensemble import TIGHTER, first_tolerance, hanging_bounds, run_of_start
from abu_calc.simulation.scene_of_design import idle_scene
from abu_calc.simulation.start_cases import Member, members
from abu_calc.sizing.actions import speeds_from
from abu_calc.sizing.budget import judged_speeds
from abu_calc.sizing.design import Design
from abu_calc.sizing.oil import usual_oils
from abu_calc.sizing.places import body_suspension

SPREADS = (0.0, 0.5, 1.0)
"""|Σe^{2iθ}|/n of balls evenly spread, between, and in two groups side by side or opposite."""


@formula(
    "Small motions of balls that balance, in a body on any linear suspension",
    "Λ² − ½·n·m·(P_F + P_B)·Λ + (½·n·m)²·(1 − χ₂²)·P_F·P_B = 0",
    where=(
        "P_F and P_B are the fourth powers of λ + iΩ and λ − iΩ times the receptances of forward and backward whirl at "
        "the race, the balls' mass on it. Λ is J·λ² + h₀·λ. A root with a growing λ makes the balanced state unstable."
    ),
    signs="J h₀ λ Ω",
    assumed="small motion; equal balls",
    source="derived; within 0.04 % of Floquet multipliers of six degrees of freedom",
)
def growing_whirls(
    motion: BodyMotion, race: Vector, ball_mass: float, spread: float, drag: float, inertia_factor: float
) -> int:
    """Number of growing roots; `ball_mass` n·m [kg], `spread` χ₂ = |Σe^{2iθ}|/n."""
    half = ball_mass / 2

    def value(s: complex) -> complex:
        forward, backward = whirl_receptances(motion, race, s, ball_mass)
        ahead, back = (s + 1j * motion.speed) ** 4 * forward, (s - 1j * motion.speed) ** 4 * backward
        inertia = inertia_factor * s * s + drag * s
        return inertia**2 - half * (ahead + back) * inertia + half**2 * (1 - spread**2) * ahead * back

    return growing_roots(value, motion.speed)


def unstable_speed(design: Design) -> float | None:
    """The first judged speed [rad/s] at which a whirl of the body in space grows; None if there is none.

    None also if the planar model holds: no gyroscopic moments, and springs.
    """
    case, autobalancer = design.case, design.autobalancer
    suspension = body_suspension(case, carrying=True)
    hands = case.table.suspension.model == "hands"
    if not case.body.in_space or suspension is None or not (case.body.body.rotor_polar_inertia or hands):
        return None
    balls = autobalancer.balls_mass
    body = replace(case.body.body, mass=case.body.mass + autobalancer.mass - balls)
    for speed in judged_speeds(case):
        motion = BodyMotion(body, speed, suspension)
        for spread in SPREADS:
            if growing_whirls(motion, case.race_place, balls, spread, case.drag, case.inertia_factor):
                return speed
    return None


@dataclass(frozen=True)
class StuckBalls:
    """Number of start cases simulated at the given drag rate, and of those that end balanced and stuck.

    In the latter all balls balance and are held by friction.
    """

    starts: int
    held: int

    @property
    def proves(self) -> bool:
        """True if friction held the balls in every start case."""
        return 0 < self.starts == self.held

    @property
    def words(self) -> str:
        """The proof, or why there is none."""
        if not self.starts:
            return "The file gives no dry friction that could hold the balls"
        balls = "all balls" if self.proves else "the balls"
        return f"Dry friction holds {balls} at rest in {self.held} of {self.starts} simulated start cases"


def stuck_balls(design: Design, doubtful: float, accuracy: float = 0.01) -> StuckBalls:
    """Simulate every start at the drag given to its end, and count those whose balls stick and balance.

    A ball sticks when its mean speed in the last twentieth of the run is below 1e-9 of the rotor's: a disturbance that
    friction can carry then moves nothing. Runs that give no trustworthy number count as not held. `doubtful` [1/s]: see
    `members`. Range: one speed; a disturbance beyond what friction carries may still free the balls.
    """
    if not design.case.friction_arm:
        return StuckBalls(0, 0)
    starts = list(members(design, doubtful, (1.0,)))
    return StuckBalls(len(starts), sum(_sticks(design, member, accuracy) for member in starts))


def _sticks(design: Design, member: Member, accuracy: float) -> bool:
    try:
        run = run_of_start(design, member, accuracy, TIGHTER * first_tolerance(design))
    except NotTrustworthyError:
        return False
    return run.outcome.balanced and run.outcome.slip <= AT_REST


PLACES: Final = 9
"""Speeds of a range at which the growth rate is compared."""

NEUTRAL: Final = 1e-7
"""Decay per radian of rotation below which a disturbance is not said to die out: in a million turns it halves."""

NAMED: Final = 3
"""Boundaries that the check names, those nearest to the worst speed."""


@record
class Mode(Record):
    """A free motion of the idle machine that swings, the mass of its balls on it."""

    frequency: Annotated[float, Quantity("frequency", "|λ|/2π", unit="hz")]
    damping_ratio: Annotated[float, Quantity("damping ratio", "ζ", 3)]


@dataclass(frozen=True)
class TrueRegion:
    """Stability of the idle balanced state at the rated speed, and the speeds at which it changes.

    None: not known. It is judged in the worst arrangement that balances. Boundaries are searched from half
    the lowest natural frequency, or half the lowest speed if that is less, to twice the highest speed.
    `modes`: the oscillating ones, ascending.
    """

    stable: bool | None
    boundaries: tuple[StabilityBoundary, ...] | None
    modes: tuple[Mode, ...]
    hanging: HangingBounds
    check: Check


@dataclass(frozen=True)
class SpeedRange:
    """The idle balanced state over the speeds of a design; `worst_speed` [rad/s] and the `growth` rate [1/s] there.

    `rated`: the growth rate at the rated speed.
    """

    boundaries: tuple[StabilityBoundary, ...]
    worst_speed: float
    growth: float
    rated: float
    stable: bool


def true_region(design: Design, accuracy: float = 0.01) -> TrueRegion:
    """Stability of the idle scene by its eigenvalues, with the drag and the damping of the file.

    If a disturbance grows, start cases are simulated to see whether dry friction holds the balls: see
    `stuck_balls`.
    """
    modes, hanging = _modes(idle_scene(design)), hanging_bounds(design)
    try:
        speeds = _speed_range(design)
        if speeds is None:
            reason = "There is no balanced state: the balls cannot carry the imbalance"
            remedy = "Specify heavier or more balls, a larger race, or a better balanced wheel."
            check = coded("ABU103", "fail", reason, None, remedy=remedy)
            return TrueRegion(False, (), modes, hanging, check)
        check = _stable(design, speeds) if speeds.stable else _unstable(design, speeds, hanging, accuracy)
        whirling = unstable_speed(design) if speeds.stable else None
        check = check if whirling is None else _whirls(whirling)
        return TrueRegion(
            speeds.rated < -MARGIN * design.case.speed and whirling != design.case.speed,
            speeds.boundaries,
            modes,
            hanging,
            check,
        )
    except NotTrustworthyError as error:
        reason = f"Stability is not known: {str(error).splitlines()[0]}"
        remedy = "Specify another oil, or springs in place of hands."
        check = coded("ABU103", "not-done", reason, None, remedy=remedy)
        return TrueRegion(None, None, modes, hanging, check)


def _speed_range(design: Design, *, with_boundaries: bool = True) -> SpeedRange | None:
    """Every speed of the range: its ends, the rated one, those of a grid, and no boundary between; None: no balance.

    `with_boundaries`: also those outside the range.
    """
    scene, half = idle_scene(design), design.autobalancer.half_angle
    low, high = design.case.speed_range
    listed = judged(scene, half)[1]
    if not listed:
        return None
    motions, search, rated = quick(listed), searched(listed, half), design.case.speed
    ends = tuple(dict.fromkeys((low, rated, high)))
    scanned = _scanned(motions, search, ends)
    limits: tuple[StabilityBoundary, ...] = ()
    if with_boundaries or low < high:
        first = min(low, *design.frequency.natural_frequencies) / 2
        scanned, limits = limits_of_all(scanned, search, scene, first, 2 * high, coarse=True)
    grid = np.geomspace(low, high, PLACES).tolist() if low < high else ()
    rates = {speed: _rate(scanned, speed) for speed in grid}
    # The search looks at all the arrangements listed.
    rates |= {speed: search.growth(speed) if search else _rate(motions, speed) for speed in ends}
    worst = max(rates, key=lambda speed: rates[speed])
    stable = rates[worst] < -MARGIN * worst and not any(low < limit.speed < high for limit in limits)
    return SpeedRange(limits, worst, rates[worst], rates[rated], stable)


def _scanned(
    motions: tuple[LinearMotion, ...], search: Search | None, speeds: Sequence[float]
) -> tuple[LinearMotion, ...]:
    """Motions to look for boundaries with: all where that is quick.

    Elsewhere the least even one, which mostly needs the highest speed; of a search also those that grow at the speeds.
    """
    if all(motion.isotropic for motion in motions):
        return motions
    return search.added(motions[-1:], speeds) if search else motions[-1:]


def _rate(motions: Sequence[LinearMotion], speed: float) -> float:
    """The largest growth rate [1/s]."""
    return (excess_of(motions, speed) - MARGIN) * speed


def _stable(design: Design, speeds: SpeedRange) -> Check:
    low, high = design.case.speed_range
    where = f", slowest at {_rpm(speeds.worst_speed)}" if low < high else f" at {_rpm(speeds.worst_speed)}"
    neutral = abs(speeds.growth) < NEUTRAL * speeds.worst_speed
    course = "No small disturbance grows" if neutral else f"Every small disturbance dies out{where}"
    message = f"{course}, in the least stable balanced arrangement of the balls"
    return coded("ABU103", "pass", message, 0.0 if neutral else speeds.growth, 0.0)


def _whirls(speed: float) -> Check:
    """A failure by the body in space, where the planar model passes."""
    message = (
        f"At {_rpm(speed)} a small disturbance of the whole body in space grows, though one in the plane of the race "
        "dies out. Gyroscopic moments or the hands at the handles make the difference"
    )
    return coded("ABU103", "fail", message)


def _unstable(design: Design, speeds: SpeedRange, hanging: HangingBounds, accuracy: float) -> Check:
    """A failure, or a warning where dry friction holds the balls in every start that was simulated."""
    low, high = design.case.speed_range
    sentences = [
        f"A small disturbance grows at {_rpm(speeds.worst_speed)}, "
        "in the least stable balanced arrangement of the balls"
    ]
    nearest = sorted(speeds.boundaries, key=lambda limit: abs(limit.speed - speeds.worst_speed))[:NAMED]
    if nearest:
        named = (f"{_rpm(limit.speed)} ({'stable' if limit.stable_above else 'unstable'} above)" for limit in nearest)
        sentences.append(f"Stability changes at {', '.join(named)}")
    held = StuckBalls(0, 0)
    if low < high:
        sentences.append("Start cases at single speeds prove nothing for a range of speeds")
    else:
        held = stuck_balls(design, hanging.largest or 0.0, accuracy)
        sentences.append(held.words)
        if not held.proves and patience.over():
            sentences.append("The others were not simulated in the time of --patience")
            return coded("ABU103", "not-done", ". ".join(sentences), speeds.growth, 0.0)
    grade: Grade = "warn" if held.proves else "fail"
    return coded("ABU103", grade, ". ".join(sentences), speeds.growth, 0.0)


ABOVE: Final = 1.02
"""Factor over a boundary of stability at which the lowest speed is tried."""


def steadier(design: Design, boundaries: Sequence[StabilityBoundary]) -> dict[str, object] | None:
    """The first change of the file, of those tried, that makes every speed of the range stable.

    If the last boundary is inside the range: speeds above it. Else other oils, the nearest first, and
    more damping of springs. `boundaries`: speeds at which stability changes, ascending.
    """
    case, (low, high) = design.case, design.case.speed_range
    tried = list[dict[str, object]]()
    if boundaries and boundaries[-1].stable_above and low < boundaries[-1].speed < high:
        tried += speeds_from(case, ABOVE * boundaries[-1].speed)
    tried += (entries for entries, _ in usual_oils(case, design.autobalancer))
    tried += filter(None, [more_damping(design)])
    return next((entries for entries in tried if _steady(design, entries)), None)


def _steady(design: Design, entries: Mapping[str, object]) -> bool:
    """True if the ends of the range are stable with a change, each by itself, then all of it."""
    other = design_with(design, entries)
    low, high = design.case.speed_range if other is None else other.case.speed_range
    return other is not None and all(_stable_over(other, *ends) for ends in ((low, low), (high, high), (low, high)))


def _stable_over(design: Design, low: float, high: float) -> bool:
    case = replace(design.case, speed=min(max(design.case.speed, low), high), speed_range=(low, high))
    speeds = _speed_range(replace(design, case=case), with_boundaries=False)
    return speeds is not None and speeds.stable


def _rpm(speed: float) -> str:
    return shown(speed, "rpm", ".6g")


def _modes(scene: Scene) -> tuple[Mode, ...]:
    rates = np.linalg.eigvals(scene.small_motion.motion)
    swinging = rates[rates.imag > 0]
    modes = (Mode(frequency=float(abs(rate)), damping_ratio=float(-rate.real / abs(rate))) for rate in swinging)
    return tuple(sorted(modes, key=lambda mode: mode.frequency))
