"""Start cases of a machine with two races: phases of the imbalances, places of the balls, oil, run-up; one run each."""

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.dynamics.race import Race
from abu_calc.dynamics.scene import Effect, Scene, with_parted_balls
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.dynamics.trajectory import Samples
from abu_calc.features.two_races.case import TwoRaceCase
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.formulas.balls import half_angle
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.formulas.two_races import PlacedImbalance
from abu_calc.foundation import patience
from abu_calc.foundation.errors import ChaoticError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted
from abu_calc.foundation.units import from_si, level_from_velocity, velocity_from_level
from abu_calc.inputs.bearing_file import Limits
from abu_calc.simulation.quiet import PER_TURN, last_crossing, turn_velocities
from abu_calc.simulation.response import amplitude_window
from abu_calc.simulation.scene_of_file import in_order
from abu_calc.simulation.simulate import simulate

Start = Literal["bunched", "spread", "standstill", "run-up"]
STARTS: Final[tuple[Start, ...]] = ("bunched", "spread", "standstill", "run-up")
AHEAD: Final = math.radians(20)
"""Middle of bunched balls, ahead of what the race has to balance."""
DRAGS: Final = (1.0, 1 / 3, 3.0)
"""Factors on the viscous drag rate: oil as given, hot, cold."""
PHASES: Final = (0.0, math.pi / 2, math.pi, 3 * math.pi / 2)
"""Phases of an imbalance of unknown phase against the first one."""
RUN_UP: Final = 1.0
"""Run-up [s] of a file that gives none."""
RESTITUTION: Final = 0.5
LIMITS: Final = 4.0
"""A scene lasts as many quiet times permitted, from full speed."""
STILL: Final = 0.05
"""Share of the rotor's speed: balls stall if their mean speed against the race stays above it."""
SMALLEST: Final = 1e-12
"""Displacement [m] that counts as none."""
ACCURACY: Final = 0.05
"""Accuracy of a start case: many of them are simulated."""
MOST_WORK, MOST_ONE, AT_ONCE, MOST_LOST = 7_000_000, 2_000_000, 4, 2
"""Work of all start cases together, most work of one, how many begin before what is left is counted, and how many may
be lost until no others are tried. The first is half a minute of compiled code, more where Python decides many
events."""
NOT_TRIED: Final = "not tried, since others gave no answer"
DOUBTFUL: Final = 0.2
"""Largest difference of runs of a chaotic start case that counts all the same, all of which end balanced."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StartCase:
    """One start: where the balls are, factor on the drag, phases of the imbalances of unknown phase [rad].

    `speed` [rad/s]: the full one, None: the rated speed. `ahead` [rad]: middle of bunched balls, or the first of balls
    spread, from what the race has to balance. `race_centre` [rad]: side of the race centres, from the resultant of
    the imbalances.
    """

    start: Start
    drag_factor: float = 1.0
    phases: tuple[float, ...] = ()
    speed: float | None = None
    ahead: float | None = None
    race_centre: float = 0.0

    @property
    def name(self) -> str:
        """Start case in words."""
        phase = f", phase {', '.join(f'{math.degrees(each):.0f}°' for each in self.phases)}" if self.phases else ""
        speed = "" if self.speed is None else f", {from_si(self.speed, 'rpm'):.6g} rpm"
        return f"{self.start}{phase}{speed}"


@dataclass(frozen=True)
class TwoRaceRun:
    """Outcome of one start case [SI]: displacement 0–peak of each race and place, times, slip of the balls.

    `balances`: every race rests below half its displacement without balls, or what eccentricity and friction may
    leave, with all balls at rest. A time of None: not within 95 % of the run.
    """

    case: StartCase
    race_displacements: tuple[float, float]
    displacements: tuple[float, ...]
    displacements_without: tuple[float, ...]
    settling_time: float | None
    quiet_time: float | None
    rest_time: float | None
    slip: float
    balances: bool
    speed: float
    residuals: tuple[float, float] = (0.0, 0.0)
    """Residual imbalance [kg m] of each race at the end."""
    work: int = 0

    @property
    def stalls(self) -> bool:
        """True if balls stall."""
        return self.slip > STILL

    def in_time(self, limits: Limits) -> bool:
        """True if it is quiet in time, and at rest, if the file limits that."""
        quiet, rest, longest = self.quiet_time, self.rest_time, limits.rest_time_s
        rests = longest is None or (rest is not None and rest <= longest)
        return quiet is not None and quiet <= limits.longest_quiet_time and rests

    @property
    def level(self) -> float:
        """Velocity level [dB] of the loudest place, at the speed of the run."""
        return level_of(max(self.displacements), self.speed)


@dataclass(frozen=True)
class LostRun:
    """A start case without an answer, why, and the work that it may have taken; `short`: more work would give one."""

    case: StartCase
    reason: str
    work: int = 0
    short: bool = False


def start_cases(design: TwoRaceDesign) -> Iterator[StartCase]:
    """All start cases: at the drag given over all phases, at hot and cold oil where imbalances are in and out of phase.

    Several imbalances of unknown phase turn together: each by the phase times its number. Both ends of a speed range
    are tried with imbalances in and out of phase: at the lowest speed balls stall first and settle latest, at the
    highest they are loudest.
    """
    unknown = design.case.unknown_phases
    turned = [tuple(phase * k for k in range(1, unknown + 1)) for phase in PHASES] if unknown else [()]
    few = turned[:: max(1, len(turned) // 2)]
    for speed in (None, *speed_ends(design.case)):
        for factor in DRAGS:
            for phases in turned if factor == 1 and speed is None else few:
                yield from (StartCase(start, factor, phases, speed) for start in STARTS)


def speed_ends(case: TwoRaceCase) -> tuple[float, ...]:
    """Ends of the speed range [rad/s] other than the rated speed."""
    return tuple(end for end in dict.fromkeys(case.speed_range) if not math.isclose(end, case.speed))


def at_speed(design: TwoRaceDesign, speed: float | None) -> TwoRaceDesign:
    """The design with this speed as the rated one [rad/s]; None: as it is."""
    return design if speed is None else replace(design, case=replace(design.case, speed=speed))


def scene_of(design: TwoRaceDesign, start: StartCase) -> Scene:
    """The scene of a start case, with gravity (horizontal spindle), friction, ball contact and race eccentricity.

    The race centres are off toward the resultant of the imbalances, which asks the balls of both races for more,
    unless the start case gives another side.
    """
    design = at_speed(design, start.speed)
    case = design.case
    wheels = _wheels(design, start)
    static = sum((wheel.imbalance for wheel in wheels), 0j)
    couple = sum((wheel.place * wheel.imbalance for wheel in wheels), 0j)
    bearings = case.rotor.bearings
    support = tilting(
        case.rotor.mass, case.rotor.transverse_inertia, case.rotor.polar_inertia,
        [bearing.place for bearing in bearings], [(bearing.stiffness, bearing.stiffness) for bearing in bearings],
        [(bearing.damping, bearing.damping) for bearing in bearings],
    )  # fmt: skip
    run_up = _run_up(design) if start.start == "run-up" else 0.0
    freedoms = (0.0,) * len(support.names)
    scene = Scene(
        name="idle",
        support=support,
        speed=case.speed,
        imbalance=abs(static),
        imbalance_angle=cmath.phase(static) if static else 0.0,
        races=tuple(_race(design, k, start, wheels_share(design, k, start)) for k in (0, 1)),
        duration=run_up + LIMITS * case.table.limits.longest_quiet_time,
        start_position=freedoms,
        start_velocity=freedoms,
        couple=abs(couple),
        couple_angle=cmath.phase(couple) if couple else 0.0,
        effects=in_order(_effects(design, run_up, race_centre(design, start))),
    )
    return with_parted_balls(scene)[0]


def race_centre(design: TwoRaceDesign, start: StartCase) -> float:
    """Angle [rad] of the race centres from the zero mark in this start case."""
    static = sum((wheel.imbalance for wheel in _wheels(design, start)), 0j)
    return start.race_centre + (cmath.phase(static) if static else 0.0)


def _wheels(design: TwoRaceDesign, start: StartCase) -> tuple[PlacedImbalance, ...]:
    """Imbalances at the phases of this start case."""
    return design.case.turned(start_phases(design, start))


def start_phases(design: TwoRaceDesign, start: StartCase) -> tuple[float, ...]:
    """Phases of all imbalances whose phase is unknown, the first among them at 0 if none is given."""
    none_known = all(angle is None for angle in design.case.angles)
    return (0.0, *start.phases) if none_known else start.phases


def wheels_share(design: TwoRaceDesign, race: int, start: StartCase) -> complex:
    """Imbalance [kg m] that a race has to balance in this start case."""
    wheels = _wheels(design, start)
    shares = design.races[race].shares
    return sum((share * wheel.imbalance for share, wheel in zip(shares, wheels, strict=True)), 0j)


def _run_up(design: TwoRaceDesign) -> float:
    given = design.case.table.run_up
    return given.time_s if given else RUN_UP


def _effects(design: TwoRaceDesign, run_up: float, toward: float) -> Iterator[Effect]:
    case, radius = design.case, design.races[0].design.autobalancer.ball_diameter / 2
    if case.horizontal:
        yield GravityEffect()
    if case.friction_arm:
        yield DryRollingFrictionEffect(case.friction_arm, radius)
    yield BallContactEffect(radius, RESTITUTION)
    if case.eccentricity:
        yield RaceEccentricityEffect(case.eccentricity, toward)
    if run_up:
        yield RunUpEffect(run_up)


def _race(design: TwoRaceDesign, race: int, start: StartCase, imbalance: complex) -> Race:
    sized = design.races[race]
    abu = sized.design.autobalancer
    count, heavy = abu.ball_count, cmath.phase(imbalance) if imbalance else 0.0
    ahead = AHEAD if start.ahead is None else start.ahead
    beta = half_angle(abu.ball_diameter / 2, abu.pitch_radius) * (1 + 1e-9)
    if start.start == "spread":
        first = heavy + (0.0 if start.ahead is None else start.ahead)
        angles = [first + 2 * math.pi * k / count for k in range(count)]
    else:
        # A run-up of a horizontal spindle begins with the balls at the bottom of the race.
        middle = -math.pi / 2 if start.start == "run-up" and design.case.horizontal else heavy + ahead
        angles = [middle + beta * (2 * k - count + 1) for k in range(count)]
    standing = start.start == "standstill"
    return Race(
        pitch_radius=abu.pitch_radius,
        ball_masses=(abu.ball_mass,) * count,
        drag=design.case.drags[race] * start.drag_factor,
        inertia_factor=design.case.inertia_factor,
        start_angles=tuple(angles),
        start_speeds=(-design.case.speed if standing else 0.0,) * count,
        plane_offset=sized.place,
        ball_radius=abu.ball_diameter / 2,
    )


def run_of(design: TwoRaceDesign, start: StartCase, accuracy: float, work: int | None = None) -> TwoRaceRun | LostRun:
    """One start case to an accuracy, and what came of both races; `work`: its most, None: that of a simulation."""
    design, scene = at_speed(design, start.speed), scene_of(design, start)
    try:
        return _observed(design, start, scene, accuracy, work)
    except NotTrustworthyError as error:
        return LostRun(start, str(error).splitlines()[0], work or 0, isinstance(error, TooMuchWorkError))


def all_work() -> int:
    """Work that all start cases together may take; no bound with --patience."""
    return patience.UNBOUNDED if patience.given() else MOST_WORK


def runs_of(
    design: TwoRaceDesign, accuracy: float, progress: Progress, workers: int, work: int
) -> Iterator[TwoRaceRun | LostRun]:
    """All start cases, by about this work together; those for which none is left are lost.

    What is left is counted after each few starts, so that the answer does not depend on how many run side by side.
    """
    starts, lost = list(start_cases(design)), 0
    counting = counted(progress, "{} of {} starts", len(starts))
    for first in range(0, len(starts), AT_ONCE):
        few = starts[first : first + AT_ONCE]
        if work <= 0 or lost >= MOST_LOST:
            yield from (LostRun(start, NOT_TRIED, short=True) for start in few)
            continue
        tasks = [(design, start, accuracy, min(MOST_ONE, work // 2)) for start in few]
        for run in side_by_side(run_of, tasks, workers, counting):
            work -= run.work
            lost += isinstance(run, LostRun)
            yield LostRun(run.case, "the time of --patience was over") if patience.over() else run


def _observed(design: TwoRaceDesign, start: StartCase, scene: Scene, accuracy: float, work: int | None) -> TwoRaceRun:
    """A run and what came of both races."""
    times, doubt = revolution_times(scene), 0.0
    try:
        run = simulate(scene, accuracy, times, work)
    except ChaoticError as error:
        # All runs end with balls at rest that balance: what the numbers are in doubt by is added to them.
        if error.ended is None or not error.ended.error_estimate <= DOUBTFUL:
            raise
        run, doubt = error.ended, error.ended.error_estimate
    case = design.case
    wheels = _wheels(design, start)
    bare = [abs(case.rotor.whirl(place, wheels, case.speed)) for place in case.races]
    window = amplitude_window(scene).times
    ends = [(1 + doubt) * _amplitude(scene, run.trajectory, window, place) for place in case.races]
    speeds = run.response.final.ball_speeds
    slip = max(map(abs, speeds), default=0.0) / case.speed
    states, needs = run.trajectory.at(times), (wheels_share(design, 0, start), wheels_share(design, 1, start))
    left = residual_imbalances(scene, states, needs)
    at = [held.place for held in case.places]
    without = tuple(abs(case.rotor.whirl(place, wheels, case.speed)) for place in at)
    times_of = (
        settling_time(scene, states, needs), quiet_time(scene, states, case, max(without)),
        rest_time(scene, states, needs),
    )  # fmt: skip
    settled, quiet, rested = (None if time is None else time * (1 + doubt) for time in times_of)
    return TwoRaceRun(
        case=start,
        race_displacements=(ends[0], ends[1]),
        displacements=tuple((1 + doubt) * _amplitude(scene, run.trajectory, window, place) for place in at),
        displacements_without=without,
        settling_time=settled,
        quiet_time=quiet,
        rest_time=rested,
        slip=slip,
        speed=case.speed,
        work=run.cost.work,
        residuals=(_end(left[0]), _end(left[1])),
        balances=slip <= STILL and all(
            end <= max(without / 2, allowed_displacement(design, k))
            for k, (end, without) in enumerate(zip(ends, bare, strict=True))
        ),
    )  # fmt: skip


def allowed_displacement(design: TwoRaceDesign, race: int) -> float:
    """Displacement [m] that eccentricity and friction may leave at a race whose balls balance."""
    budget = design.races[race].design.autobalancer.budget
    return budget.race_eccentricity + budget.rolling_friction


def level_of(displacement: float, speed: float) -> float:
    """Velocity level [dB] of a circle of this radius [m] at a speed [rad/s]; no less than that of SMALLEST."""
    return level_from_velocity(max(displacement, SMALLEST) * speed / math.sqrt(2))


def _amplitude(scene: Scene, run: Samples, times: Array, place: float) -> float:
    at = scene.axis_place(run.at(times), place)
    mean = at.mean(axis=1, keepdims=True)
    return float(np.sqrt(((at - mean) ** 2).sum(axis=0)).max())


def revolution_times(scene: Scene) -> Array:
    """Times [s] of all whole revolutions at full speed, PER_TURN for each."""
    turns = int((scene.duration - scene.full_speed) / scene.revolution)
    return np.asarray(scene.full_speed + scene.revolution / PER_TURN * np.arange(turns * PER_TURN), dtype=float)


def settling_time(scene: Scene, states: Array, needs: tuple[complex, complex]) -> float | None:
    """Settling time [s] from full speed of the slower race: residual imbalance of each race as of one race alone.

    That is |S_i + Σ m·R_p·e^{iθ}|, S_i what the race has to balance [kg m]. The race has settled when it stays below
    its mean over the last twentieth plus a tenth of S_i, or of a hundredth of what its balls could carry.
    """
    last = 0
    for race, need, residual in zip(scene.races, needs, residual_imbalances(scene, states, needs), strict=True):
        limit = _end(residual) + SETTLED * max(abs(need), HARDLY * race.static_moment)
        above = np.flatnonzero(residual > limit)
        last = max(last, int(above[-1]) + 1 if len(above) else 0)
    time = last * scene.revolution / PER_TURN
    return time if time <= 0.95 * (scene.duration - scene.full_speed) else None


def residual_imbalances(scene: Scene, states: Array, needs: tuple[complex, complex]) -> tuple[Array, Array]:
    """Residual imbalance [kg m] of each race at these states: |S_i + Σ m·R_p·e^{iθ}|."""
    first, second = _left(scene, states, needs)
    return np.abs(first), np.abs(second)


def _left(scene: Scene, states: Array, needs: tuple[complex, complex]) -> tuple[Any, Any]:
    """The same with its direction in the rotor."""
    first, found = 2 * len(scene.support.names), []
    for race, need in zip(scene.races, needs, strict=True):
        count = len(race.ball_masses)
        moments = np.array(race.ball_masses) * race.pitch_radius
        found.append(need + moments @ np.exp(1j * states[first : first + count]))
        first += count
    return found[0], found[1]


def quiet_time(scene: Scene, states: Array, case: TwoRaceCase, without: float) -> float | None:
    """Quiet time [s] from full speed: from then on the loudest place stays at or below the limit of the level, and
    below its displacement [m] without balls.
    """
    size = len(scene.support.names)
    limit = min(velocity_from_level(case.table.limits.vibration_level_db), without * case.speed / math.sqrt(2))
    # The axis of a spindle that tilts is linear in its coordinates.
    rates = [scene.support.axis(states[size : 2 * size], held.place) for held in case.places]
    loudest = np.max([turn_velocities(rate) for rate in rates], axis=0)
    return last_crossing(scene.revolution / PER_TURN * np.arange(len(loudest)), loudest, limit)


def rest_time(scene: Scene, states: Array, needs: tuple[complex, complex]) -> float | None:
    """Rest time [s] from full speed of the slower race: its imbalance, in the rotor, stays near that of the end."""
    times: list[float | None] = []
    for race, need, left in zip(scene.races, needs, _left(scene, states, needs), strict=True):
        away = np.abs(left - left[-max(1, len(left) // 20) :].mean())
        band = SETTLED * max(abs(need), HARDLY * race.static_moment)
        times.append(last_crossing(scene.revolution / PER_TURN * np.arange(len(left)), away, band))
    first, second = times
    return None if first is None or second is None else max(first, second)


def _end(residual: Array) -> float:
    """Mean over the last twentieth."""
    return float(residual[-max(1, len(residual) // 20) :].mean())


def stability_scene(design: TwoRaceDesign, phases: tuple[float, ...]) -> Scene:
    """The scene of small motions about the balanced state: no effects, imbalances at these phases."""
    return replace(scene_of(design, StartCase("spread", 1.0, phases)), effects=())
