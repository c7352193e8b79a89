"""Start cases of a machine with two races: phases of the imbalances, places of the balls, oil, run-up; one run each."""

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import cycle, islice
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.integrators.run import TooMuchWorkError
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Effect, Scene, with_parted_balls
from abu_calc.dynamics.supports.tilting import tilting
from abu_calc.dynamics.trajectory import Samples, Sampling, Until, merged
from abu_calc.features.design.band import FRICTION, NEW_WHEEL, SPEED, axes_in_use, between, sequence
from abu_calc.features.spindle.case import SpindleCase, SpindleDesign, felt_mass, size_races
from abu_calc.formulas.motion import HARDLY, SETTLED
from abu_calc.formulas.tilting_rotor import PlacedImbalance, eccentricity_resultants
from abu_calc.foundation.errors import InputError, NotTrustworthyError, Place
from abu_calc.foundation.progress import Progress
from abu_calc.foundation.units import level_from_velocity, velocity_from_level
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.early_stopping import LOOKS, SEEN, movement
from abu_calc.simulation.ensemble import (
    LONGEST_CREEPING,
    MORE,
    MOST_MORE,
    TIGHTER,
    TOLERANCE,
    WORK,
    Runner,
    Watch,
    integrated,
    simulate_starts,
)
from abu_calc.simulation.quiet import LAST, PER_TURN, last_crossing
from abu_calc.simulation.response import Course, amplitude_window, drift, evaluate, needed_times, settling_times
from abu_calc.simulation.run_checks import MARGIN, slip
from abu_calc.simulation.scene_of_design import AHEAD
from abu_calc.simulation.scene_of_file import in_order
from abu_calc.simulation.start_cases import (
    ALIKE,
    KINDS,
    RUN_UP,
    Axis,
    Ensemble,
    Kind,
    Lost,
    Member,
    StartOutcome,
    Variation,
)
from abu_calc.simulation.subject import Subject, checked_centre

OF_BAND: Final = 12
"""Start cases of machines within what the file promises."""
OF_USUAL: Final = 8
"""Of these, so many once more with usual friction, oil and speed."""
PHASES: Final = (0.0, math.pi / 2, math.pi, 3 * math.pi / 2)
"""Phases of an imbalance of unknown phase against the first one."""
RESTITUTION: Final = 0.5
LIMITS: Final = 4.0
"""A scene lasts as many quiet times permitted, from full speed."""
SMALLEST: Final = 1e-12
"""Displacement [m] that counts as none."""
FIRST_TOLERANCE: Final = TIGHTER * TOLERANCE
"""Tolerance of the first run of a start case: at ten times this the median level of a drum is 0.15 dB off."""
STILL: Final = 0.003
"""Share of what a race has to balance that may still change where a run ends early."""
ACCURACY: Final = 0.05
"""Accuracy of a simulation of two races: many of them are done."""

Array = NDArray[np.float64]


def start_of(design: SpindleDesign, kind: Kind = "bunched", phases: tuple[float, ...] = (), **values: Any) -> Member:
    """A start of one kind; `values`: of a `Member`, else those of the file and the phases 0 of unknown imbalances."""
    given = design.case.table.run_up
    run_up = 0.0 if kind != "run-up" else given.time_s if given else RUN_UP
    values = {"drag": design.case.drag, "eccentricity": ALIKE, **values}
    phases = phases or (0.0,) * design.case.unknown_phases
    return Member("bunched" if kind == "run-up" else kind, run_up=run_up, phases=phases, **values)


def start_cases(design: SpindleDesign) -> Iterator[Member]:
    """All start cases: at the drag given over all phases, at hot and cold oil where imbalances are in and out of phase.

    Several imbalances of unknown phase turn together: each by the phase times its number. Both ends of a speed range
    are tried with imbalances in and out of phase: at the lowest speed balls stall first and settle latest, at the
    highest they are loudest.
    """
    turned = all_phases(design.case)
    few = turned[:: max(1, len(turned) // 2)]
    for speed in (None, *speed_ends(design.case)):
        for drag in dict.fromkeys(factor * design.case.drag for factor in design.case.drag_shares):
            given = drag == design.case.drag
            for phases in turned if given and speed is None else few:
                for kind in KINDS:
                    yield start_of(design, kind, phases, drag=drag, speed=speed, promised=given)
    yield from promised(design)
    yield from usual(design)


def promised(design: SpindleDesign) -> Iterator[Member]:
    """Starts of machines within what the file promises: truer races, lighter imbalances, at any angles."""
    kinds: Iterator[Kind] = cycle(("bunched", "spread", "spread", "bunched"))
    axes: Iterator[Axis | None] = cycle(axes_in_use(design))
    for kind, axis, point in zip(kinds, axes, islice(sequence(slice(5)), OF_BAND), strict=False):
        eccentricity, imbalance, *angles = point
        side, turned, phase = (math.tau * angle for angle in angles)
        phases = tuple(phase * k for k in range(1, design.case.unknown_phases + 1))
        varied = Variation(eccentricity, NEW_WHEEL + (1 - NEW_WHEEL) * imbalance, spindle_axis=axis)
        yield start_of(design, kind, phases, eccentricity=side, turned=turned, varied=varied)


def usual(design: SpindleDesign) -> Iterator[Member]:
    """The first of them with another friction arm, another oil and another speed, within what is usual."""
    case, oils = design.case, (min(design.case.drag_shares), max(design.case.drag_shares))
    for start, point in zip(islice(promised(design), OF_USUAL), sequence(slice(5, 8)), strict=False):
        friction, oil, speed = map(between, (FRICTION, oils, SPEED), point)
        varied = replace(start.varied, friction_arm=friction)
        yield replace(start, varied=varied, drag=oil * case.drag, speed=speed * case.speed, promised=False)


def all_phases(case: SpindleCase) -> list[tuple[float, ...]]:
    """Phases [rad] of the imbalances of unknown phase that are tried; one empty tuple without any."""
    unknown = case.unknown_phases
    return [tuple(phase * k for k in range(1, unknown + 1)) for phase in PHASES] if unknown else [()]


def speed_ends(case: SpindleCase) -> tuple[float, ...]:
    """Ends of the speed range [rad/s] other than the rated speed."""
    return tuple(end for end in dict.fromkeys(case.speed_range) if not math.isclose(end, case.speed))


def at_speed(design: SpindleDesign, speed: float | None) -> SpindleDesign:
    """The design with this speed as the rated one [rad/s]; None: as it is."""
    return design if speed is None else replace(design, case=replace(design.case, speed=speed))


def scene_of(design: SpindleDesign, member: Member) -> Scene:
    """The scene of a start case, with gravity (horizontal spindle), friction, ball contact and race eccentricity.

    The race centres are off toward the resultant of the imbalances, which asks the balls of both races for more,
    unless the start case gives another side.
    """
    design = at_speed(design, member.speed)
    case = design.case
    wheels = _wheels(design, member)
    static = sum((wheel.imbalance for wheel in wheels), 0j)
    couple = sum((wheel.place * wheel.imbalance for wheel in wheels), 0j)
    bearings = case.rotor.bearings
    support = tilting(
        case.rotor.mass, case.rotor.transverse_inertia, case.rotor.polar_inertia,
        [bearing.place for bearing in bearings], [(bearing.stiffness, bearing.stiffness) for bearing in bearings],
        [(bearing.damping, bearing.damping) for bearing in bearings],
    )  # fmt: skip
    freedoms = (0.0,) * len(support.names)
    scene = Scene(
        name="idle",
        support=support,
        speed=case.speed,
        imbalance=abs(static),
        imbalance_angle=cmath.phase(static) if static else 0.0,
        races=tuple(_race(design, k, member, need) for k, need in enumerate(race_needs(design, member))),
        duration=member.run_up + LIMITS * case.table.limits.longest_quiet_time,
        start_position=freedoms,
        start_velocity=freedoms,
        couple=abs(couple),
        couple_angle=cmath.phase(couple) if couple else 0.0,
        effects=in_order(_effects(design, member)),
        quiet_velocity=quiet_velocity(design, member),
        quiet_places=tuple(held.place for held in case.places),
    )
    return with_parted_balls(scene)[0]


def quiet_velocity(design: SpindleDesign, member: Member) -> float:
    """Rms velocity [m/s] up to which the loudest place is quiet: that of the limit of the level, and no more than
    without balls, by the imbalances of the file however little there is.
    """
    case, wheels = design.case, _wheels(design, replace(member, varied=Variation()))
    without = max(abs(case.rotor.whirl(held.place, wheels, case.speed)) for held in case.places)
    return min(velocity_from_level(case.table.limits.vibration_level_db), without * case.speed / math.sqrt(2))


def race_centre(design: SpindleDesign, member: Member) -> float:
    """Angle [rad] of the race centres from the zero mark in this start case."""
    static = sum((wheel.imbalance for wheel in _wheels(design, member)), 0j)
    return member.eccentricity + (cmath.phase(static) if static else 0.0)


def _wheels(design: SpindleDesign, member: Member) -> tuple[PlacedImbalance, ...]:
    """Imbalances of this start case at its phases."""
    wheels, share = design.case.turned(start_phases(design, member)), member.varied.imbalance
    return wheels if share == 1 else tuple(wheel._replace(imbalance=share * wheel.imbalance) for wheel in wheels)


def start_phases(design: SpindleDesign, member: Member) -> tuple[float, ...]:
    """Phases of all imbalances whose phase is unknown, the first among them at 0 if none is given."""
    none_known = all(angle is None for angle in design.case.angles)
    return (*[0.0] * none_known, *(member.phases or ()))


def race_needs(design: SpindleDesign, member: Member) -> tuple[complex, ...]:
    """Imbalance [kg m] that each race has to balance in this start case."""
    wheels = _wheels(design, member)
    return tuple(
        sum((share * wheel.imbalance for share, wheel in zip(race.shares, wheels, strict=True)), 0j)
        for race in design.races
    )


def _effects(design: SpindleDesign, member: Member) -> Iterator[Effect]:
    case, radius = design.case, design.autobalancers[0].ball_diameter / 2
    if horizontal(design, member):
        yield GravityEffect()
    if friction_arm := member.varied.friction_arm * case.friction_arm:
        yield DryRollingFrictionEffect(friction_arm, radius)
    yield BallContactEffect(radius, RESTITUTION)
    if eccentricity := member.varied.race_eccentricity * case.eccentricity:
        yield RaceEccentricityEffect(eccentricity, race_centre(design, member))
    if member.run_up:
        yield RunUpEffect(member.run_up)


def horizontal(design: SpindleDesign, member: Member) -> bool:
    """True if gravity acts in the plane of the races."""
    return (member.varied.spindle_axis or design.case.table.machine.spindle_axis) == "horizontal"


def _race(design: SpindleDesign, race: int, member: Member, imbalance: complex) -> Race:
    sized = design.races[race]
    abu = sized.autobalancer
    count, heavy = abu.ball_count, cmath.phase(imbalance) if imbalance else 0.0
    beta = abu.half_angle * (1 + 1e-9)
    if member.angles:
        angles = list(member.angles[:count] if race == 0 else member.angles[-count:])
    elif member.start == "spread":
        first = heavy + member.turned
        angles = [first + 2 * math.pi * k / count for k in range(count)]
    else:
        # A run-up of a horizontal spindle begins with the balls at the bottom of the race.
        middle = -math.pi / 2 if member.run_up and horizontal(design, member) else heavy + AHEAD + member.turned
        angles = [middle + beta * (2 * k - count + 1) for k in range(count)]
    standing, given = member.start == "standstill", design.case.drag
    scale = member.drag / given if given else 1.0
    return Race(
        pitch_radius=abu.pitch_radius,
        ball_masses=(abu.ball_mass,) * count,
        drag=design.case.drags[race] * scale,
        inertia_factor=design.case.inertia_factor,
        start_angles=tuple(angles),
        start_speeds=(-design.case.speed * (1.0 if standing else member.lag),) * count,
        plane_offset=sized.place,
        ball_radius=abu.ball_diameter / 2,
    )


def start_once(
    design: SpindleDesign, member: Member, accuracy: float, tolerance: float, work: int = WORK, early_end: bool = False,
    wanted: str = "auto",
) -> StartOutcome | Lost:  # fmt: skip
    """One start, by one run, once more for longer if its balls still creep; `work`: what a run may take; `early_end`:
    whether it may end early.
    """
    design, scene = at_speed(design, member.speed), scene_of(design, member)
    try:
        outcome = _run(design, member, scene, tolerance, work, wanted, early_end)
        if not outcome.creeping or outcome.hanging:
            return outcome
        longest = member.run_up + LONGEST_CREEPING * design.case.table.limits.longest_quiet_time
        longer = _run(design, member, replace(scene, duration=longest), tolerance, MORE * work, wanted)
        return replace(longer, work=outcome.work + longer.work, duration=longest)
    except NotTrustworthyError as error:
        return Lost(member, str(error).splitlines()[0], work, isinstance(error, TooMuchWorkError))


def _run(
    design: SpindleDesign, member: Member, scene: Scene, tolerance: float, work: int, wanted: str,
    early_end: bool = False,
) -> StartOutcome:  # fmt: skip
    """Outcome of one run. Raises NotTrustworthyError."""
    turns, times = revolution_times(scene), settling_times(scene)
    # Of what is seen then, several turns must be whole.
    ends = [int(share * len(turns)) for share in LOOKS if early_end and SEEN * share * len(turns) > 4 * PER_TURN]
    looks = tuple(float(times[np.searchsorted(times, turns[end])]) for end in ends)
    windows = [amplitude_window(replace(scene, duration=look)).times for look in looks]
    until = Until(looks, partial(_enough, design, member, scene))
    run, spent = integrated(
        scene, Sampling(merged(needed_times(scene), turns, *windows), until=until), tolerance, work, wanted
    )
    return _observed(design, member, scene, run, spent)


def _enough(design: SpindleDesign, member: Member, scene: Scene, samples: Samples) -> bool:
    """True if both races balance in time and nothing that still moves will change that, as for one race."""
    end, of_file = float(samples.t[-1]), replace(member, varied=Variation())
    turns = revolution_times(replace(scene, duration=end))
    late = turns[-int(SEEN * len(turns)) :]
    ahead = (scene.duration - end) / (late[-1] - late[0])
    left = imbalances_left(scene, samples.at(late), race_needs(design, member))
    moved = references(scene, race_needs(design, of_file))
    if any(movement(each, ahead) > STILL * most for each, most in zip(left, moved, strict=True)):
        return False
    outcome, limits = _observed(design, member, scene, samples, 0), design.case.table.limits
    return not outcome.creeping and outcome.holds(limits, limits.vibration_level_db - MARGIN)


ON_SPINDLE: Final = Runner(start_once, lambda design, member, _: scene_of(design, member), MOST_MORE // 6)
"""An evaluation with two races takes three to four times as long as its balls alone say."""


def ensemble_of(
    design: SpindleDesign, accuracy: float, progress: Progress, workers: int, watch: Watch | None = None
) -> Ensemble:
    """All start cases, each once; those that decide a check once more at a tighter tolerance."""
    starts, runner = list(start_cases(design)), ON_SPINDLE._replace(watch=watch)
    return simulate_starts(design, starts, accuracy, FIRST_TOLERANCE, progress, workers, runner)


def _observed(design: SpindleDesign, member: Member, scene: Scene, samples: Samples, work: int) -> StartOutcome:
    """What came of both races in a run of a scene, as far as it went.

    A race balances if it leaves at most half of what it has to balance, or what eccentricity and friction ask for.
    """
    case, course, end = design.case, Course(scene), float(samples.t[-1])
    course(samples)
    scene = replace(scene, duration=end)
    window, response = amplitude_window(scene).times, evaluate(scene, samples, course.until(end))
    # Whether it balances is judged by the imbalances of the file, however little there is.
    needs, of_file = race_needs(design, member), race_needs(design, replace(member, varied=Variation()))
    left, small = imbalances_left(scene, samples.at(revolution_times(scene)), needs), references(scene, of_file)
    ends = [float(_end(np.abs(own))) for own in left]
    creeping = any(drift(own, len(own)) > SETTLED * most for own, most in zip(left, small, strict=True))
    allowed = [max(abs(need) / 2, unavoidable_imbalance(design, k)) for k, need in enumerate(of_file)]
    farther = max(range(len(ends)), key=lambda k: ends[k] / allowed[k] if allowed[k] else ends[k])
    displacements = tuple(_amplitude(scene, samples, window, held.place) for held in case.places)
    return StartOutcome(
        member=member,
        settling_time=settling_time(scene, left, references(scene, needs)),
        quiet_time=response.quiet_time,
        rest_time=None if creeping else rest_time(scene, left, small),
        creeping=creeping,
        residual=max(_amplitude(scene, samples, window, place) for place in case.races),
        level=level_of(max(displacements), case.speed),
        slip=slip(response, case.speed),
        ball_angles=response.ball_angles,
        imbalance=ends[farther],
        allowed=allowed[farther],
        work=work,
        moved=abs(of_file[farther]),
        displacements=displacements,
    )


def unavoidable_imbalance(design: SpindleDesign, race: int) -> float:
    """Imbalance [kg m] that eccentricity of both races and friction may leave at a race whose balls balance."""
    case = design.case
    eccentric = eccentricity_resultants(case.rotor, case.races, (case.eccentricity,) * 2, case.speed)
    friction = design.autobalancers[race].budget.rolling_friction
    return abs(eccentric[race]) + felt_mass(case, race) * friction


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


def settling_time(scene: Scene, left: Sequence[Array], small: Sequence[float]) -> float | None:
    """Settling time [s] from full speed of the slowest race by the imbalances [kg m] that races leave at each step.

    A race has settled when it stays below its mean over the last twentieth plus a tenth of what is `small`, as one race
    alone.
    """
    last = 0
    for own, most in zip(left, small, strict=True):
        above = np.flatnonzero(np.abs(own) > _end(np.abs(own)) + SETTLED * most)
        last = max(last, int(above[-1]) + 1 if len(above) else 0)
    time = last * scene.revolution / PER_TURN
    return time if time <= LAST * (scene.duration - scene.full_speed) else None


def rest_time(scene: Scene, left: Sequence[Array], small: Sequence[float]) -> float | None:
    """Rest time [s] from full speed of the slowest race: its imbalance, in the rotor, stays near that of the end."""
    steps = scene.revolution / PER_TURN * np.arange(len(left[0]))
    times = [
        last_crossing(steps, np.abs(own - _end(own)), SETTLED * most) for own, most in zip(left, small, strict=True)
    ]
    return None if None in times else max(time for time in times if time is not None)


def imbalances_left(scene: Scene, states: Array, needs: Sequence[complex]) -> list[Array]:
    """Imbalance [kg m] that each race leaves at these states, in the rotor: S_i + Σ m·R_p·e^{iθ}."""
    first = 2 * len(scene.support.names)
    return [
        need + ((np.array(race.ball_masses) * race.pitch_radius)[:, None] * np.exp(1j * own)).sum(axis=0)
        for (race, own), need in zip(scene.by_race(states[first:]), needs, strict=True)
    ]


def references(scene: Scene, needs: Sequence[complex]) -> list[float]:
    """What an imbalance [kg m] that each race leaves is small against, as `reference_imbalance` of one race."""
    return [max(abs(need), HARDLY * race.static_moment) for race, need in zip(scene.races, needs, strict=True)]


def _end(values: Array) -> Any:
    """Mean over the last twentieth."""
    return values[-max(1, len(values) // 20) :].mean()


SCENE: Final = "idle"
IN_WORDS: Final = {
    "bunched": "balls at rest in both races, neighbours touching, their middle 20° ahead of what the race balances",
    "spread": "balls at rest in both races, evenly round them, the first at what the race balances",
    "standstill": "balls not turning at all, neighbours touching, their middle 20° ahead of what the race balances",
    "run-up": "rotor and balls at standstill; the rotor runs up",
}


def spindle_subject(
    machine: Machine, scene: str | None = None, start: str | None = None, race_centre_deg: float | None = None
) -> Subject:
    """Subject of a machine with two races: its idle scene in a start case, by default with bunched balls.

    Imbalances of unknown phase take the phase 0. The race centres are off toward the resultant of the imbalances, or by
    `race_centre_deg` from it. The balls start where [start] of the file places them, unless another start is asked for.
    Raises InputError for another scene or start, and for what cannot be sized.
    """
    for key, given, allowed in (("scene", scene, (SCENE,)), ("start", start, KINDS)):
        if given is not None and given not in allowed:
            raise InputError(
                f"a machine with two races has no such {key}", place=Place(machine.file, key=key), found=given,
                allowed=", ".join(allowed),
            )  # fmt: skip
    centre = checked_centre(race_centre_deg, ALIKE)
    with machine.located():
        design = size_races(machine)
    table, unknown = design.case.table, design.case.unknown_phases
    kind = next(each for each in KINDS if each == (start or "bunched"))
    placed = table.start if start in (None, "run-up") else None
    balls = sum(made.ball_count for made in design.autobalancers)
    if placed is not None and (len(placed.angles_deg) != balls or placed.speeds_rpm is not None):
        with machine.located():
            raise InputError(
                "one angle for each ball, those of the first race first, without speeds",
                place=Place(key="start.angles_deg"), found=f"{len(placed.angles_deg)}", allowed=f"{balls}",
            )  # fmt: skip
    angles = () if placed is None else placed.angles
    notes = ("Imbalances of unknown phase are taken in phase; `abu size` simulates four phases",) if unknown else ()
    return Subject(
        title=table.machine.name,
        reading=machine,
        scene=scene_of(design, start_of(design, kind, eccentricity=centre, angles=angles)),
        start="as the file places the balls" if placed else IN_WORDS[kind],
        half_angle=max(made.half_angle for made in design.autobalancers),
        warnings=(*machine.warnings, *notes),
    )
