"""A wheel of a machine with races along its spindle, pressed to its workpiece: closed forms, and simulated runs.

Closed forms are those of one phase of the imbalances. Runs have the whole tilting rotor with the balls of all races,
gravity, friction, collisions and a contact that may part; balls settled before, or not, or none.
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.features.grinding.simulation import contact_forces
from abu_calc.features.grinding.start_cases import TOLERANCE
from abu_calc.features.grinding.steady_contact import even_fan
from abu_calc.features.spindle.case import LevelPlaceOnSpindle, PressedWheel, SpindleDesign, eccentric_needs
from abu_calc.features.spindle.start_cases import (
    ACCURACY,
    all_phases,
    imbalances_left,
    scene_of,
    start_of,
    start_once,
    start_phases,
)
from abu_calc.formulas.tilting_contact import TiltingContact
from abu_calc.formulas.tilting_rotor import PlacedImbalance, balancing_resultants, lever_shares
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import level_from_velocity
from abu_calc.simulation.ensemble import MORE, WORK, integrated
from abu_calc.simulation.rotor_view import without_balls
from abu_calc.simulation.run_checks import SLIPPING
from abu_calc.simulation.scene_of_file import in_order
from abu_calc.simulation.start_cases import Kind, Lost, Member

ARRANGEMENTS: Final = 12
"""Arrangements of the balls that are judged besides the even one, drawn at random with a fixed seed."""
SEED: Final = 41
STEPS: Final = 200
"""Newton steps that bring random balls to a resultant."""
GROWS: Final = 1e-3
"""Growth [1/s] that counts as such: arrangements of more than two balls have neutral motions."""


def contact_of(
    design: SpindleDesign, wheel: PressedWheel, phases: Sequence[float] = (), *, bare: bool = False
) -> TiltingContact:
    """The steady contact of a wheel; `bare`: of the machine without autobalancers. Without `phases` all are 0."""
    case = design.bare if bare else design.case
    swings = 1 - 1 / (8 * case.inertia_factor)  # balls swing at twice the speed in a backward whirl
    balls = () if bare else design.balls(swings)
    return wheel.contact(case.rotor, case.speed, wheel.runout_at(case, phases), balls)


def resultants_at_work(design: SpindleDesign, wheel: PressedWheel, phases: Sequence[float] = ()) -> tuple[complex, ...]:
    """Resultants [kg m] with which all races balance at work, races without eccentricity."""
    acting = PlacedImbalance(wheel.place, contact_of(design, wheel, phases).acting_imbalance())
    return balancing_resultants(design.case.races, [*design.case.turned(phases), acting])


def capacities_at_work(design: SpindleDesign, wheel: PressedWheel) -> tuple[float, ...]:
    """Capacities [kg m] that work requires of the races, over all unknown phases, with the worst eccentricities."""
    case, acting = design.case, contact_of(design, wheel).acting_imbalance()
    turned, needs = case.turned(()), list[float]()
    for race, off in enumerate(eccentric_needs(case, case.speed)):
        parts = [lever_shares(case.races, load.place)[race] * load.imbalance for load in turned]
        parts[wheel.index] += lever_shares(case.races, wheel.place)[race] * acting
        needs.append((sum(map(abs, parts)) if case.unknown_phases else abs(sum(parts))) + off)
    return tuple(needs)


def ball_angles(design: SpindleDesign, resultants: Sequence[complex]) -> tuple[tuple[float, ...], ...] | None:
    """Angles [rad] of the balls of both races, evenly spread about each resultant; None beyond a capacity."""
    angles = []
    for own, resultant in zip(design.autobalancers, resultants, strict=True):
        if abs(resultant) > own.capacity:
            return None
        fan = even_fan(own.ball_count, abs(resultant) / own.ball_moment, own.half_angle)
        angles.append(tuple(cmath.phase(resultant) + angle for angle in fan))
    return tuple(angles)


def growth_rates(design: SpindleDesign, wheel: PressedWheel) -> tuple[float, ...] | None:
    """Largest growth rates [1/s] of small motions of light balls: evenly spread, then in other arrangements.

    Imbalances of unknown phase are in phase. None if a race cannot carry its resultant.
    """
    resultants = resultants_at_work(design, wheel)
    even = ball_angles(design, resultants)
    if even is None:
        return None
    contact, random = contact_of(design, wheel), np.random.default_rng(SEED)
    drawn = (
        tuple(
            _drawn(own.ball_count, resultant / own.ball_moment, random)
            for own, resultant in zip(design.autobalancers, resultants, strict=True)
        )
        for _ in range(ARRANGEMENTS)
    )
    return tuple(_growth(design, contact, arrangement) for arrangement in (even, *drawn))


def _drawn(count: int, total: complex, random: np.random.Generator) -> tuple[float, ...]:
    """Random angles whose unit vectors add up to `total`; balls may overlap."""
    angles = random.uniform(-math.pi, math.pi, count)
    for _ in range(STEPS):
        off = np.exp(1j * angles).sum() - total
        if abs(off) < 1e-10:
            break
        slope = np.stack([-np.sin(angles), np.cos(angles)])
        step = np.linalg.lstsq(slope, -np.array([off.real, off.imag]), rcond=None)[0]
        angles = angles + step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-12))
    return tuple(angles.tolist())


def _growth(design: SpindleDesign, contact: TiltingContact, angles: Sequence[Sequence[float]]) -> float:
    """Largest real part of the roots of J·δ'' + h₀·δ' + κ·δ = 0, κ_jl = −(Ω²/R_j)·m·R_l·Re(G·e^{i(θ_l − θ_j)})."""
    case, made = design.case, design.autobalancers
    which = [race for race, own in enumerate(angles) for _ in own]
    flat = np.array([angle for own in angles for angle in own])
    whirl = [[contact.whirl_per_imbalance(at, force_at) for force_at in case.races] for at in case.races]
    G = np.array([[whirl[i][k] for k in which] for i in which])
    radii = np.array([made[k].pitch_radius for k in which])
    moments = np.array([made[k].ball_moment for k in which])
    turned = np.exp(1j * (flat[None, :] - flat[:, None]))
    stiffness = -(case.speed**2 / radii)[:, None] * moments[None, :] * (G * turned).real
    J, size = case.inertia_factor, len(flat)
    drag = np.diag([case.drags[k] for k in which])
    system = np.block([[np.zeros((size, size)), np.eye(size)], [-stiffness / J, -drag / J]])
    return float(np.linalg.eigvals(system).real.max())


Pressed = Literal["settled", "at once", "without"]
OBSERVED: Final = 1 / 3
"""Share of a run, at its end, whose level counts."""
PER_TURN: Final = 32
"""Samples of a revolution."""
LEAST: Final = 1e-12
"""Velocity [m/s] that counts as none."""
IDEAL_S: Final = 3.0
"""Seconds of a run with ideal races and balls, which is compared with the closed form."""

EARLY: Final[tuple[Kind, ...]] = ("bunched", "standstill")
"""Starts of balls that have not settled when the wheel is pressed."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class WorkCase:
    """One run: which wheel works, when it is pressed, the idle start of the balls, oil, phases of the imbalances."""

    wheel: PressedWheel
    pressed: Pressed
    start: Member


@dataclass(frozen=True)
class WorkRun:
    """Outcome of one run: level [dB] of each place over its last third, and how it changes within that time.

    `force_amplitude`: of the contact once per turn [N]; `apart`: share of the time in which wheel and workpiece part.
    """

    case: WorkCase
    levels: tuple[float, ...]
    drift: float
    axis: tuple[float, float]
    force_amplitude: float
    apart: float
    slip: float
    resultants: tuple[complex, ...] = ()
    """Resultant of the balls of each race at the end [kg m]."""

    @property
    def level(self) -> float:
        """Level of the loudest place."""
        return max(self.levels)

    @property
    def pulls(self) -> bool:
        """True if a rigid contact, which never parts, would have to pull."""
        return self.case.wheel.table.contact == "rigid" and self.apart > 0

    @property
    def stalls(self) -> bool:
        """True if balls keep going round in a race."""
        return self.slip > SLIPPING


def work_run(design: SpindleDesign, case: WorkCase) -> WorkRun | Lost:
    """Simulate one run."""
    try:
        return _observed(design, case, work_scene(design, case))
    except NotTrustworthyError as error:
        return Lost(case, str(error).splitlines()[0])


def work_scene(design: SpindleDesign, case: WorkCase) -> Scene:
    """The scene of a run; balls that settle before are simulated at idle first. Raises NotTrustworthyError."""
    member, wheel = case.start, case.wheel
    if case.pressed == "without":
        bare = without_balls(scene_of(replace(design, case=design.bare), member))
        return _pressed(bare, wheel, design, member)
    scene = scene_of(design, member)
    if case.pressed == "settled":
        idle = start_once(design, member, ACCURACY, TOLERANCE)
        if isinstance(idle, Lost):
            raise NotTrustworthyError(idle.reason)
        scene = scene.started(idle.ball_angles)
    return _pressed(with_parted_balls(scene)[0], wheel, design, member)


def _pressed(scene: Scene, wheel: PressedWheel, design: SpindleDesign, member: Member) -> Scene:
    contact = wheel.effect(design.case, start_phases(design, member))
    return replace(scene, name="grinding", effects=in_order([*scene.effects, contact]))


def _observed(design: SpindleDesign, case: WorkCase, scene: Scene) -> WorkRun:
    turns = max(2, int(OBSERVED * scene.duration / scene.revolution / 2))
    first = scene.duration - 2 * turns * scene.revolution
    steps = np.arange(2 * turns * PER_TURN) * (scene.revolution / PER_TURN)
    times = np.asarray(first + steps, dtype=float)
    states = integrated(scene, times, TOLERANCE, MORE * WORK)[0].at(times)
    halves = [_levels(scene, part, design.case.places) for part in np.split(states, 2, axis=1)]
    # The louder half counts with balls, the quieter one without: neither is flattered.
    fairer = min if case.pressed == "without" else max
    levels = tuple(fairer(pair) for pair in zip(*halves, strict=True))
    force = contact_forces(scene, times, states)
    wheel = scene.axis_place(states, case.wheel.place)
    x, y = np.abs(wheel - wheel.mean(axis=1, keepdims=True)).max(axis=1)
    count, half = 2 * len(scene.support.names), len(times) // 2
    balls = states[count : count + len(scene.ball_masses)]
    slip = float(np.abs(balls[:, -1] - balls[:, half]).max(initial=0.0) / ((times[-1] - times[half]) * scene.speed))
    once = 2 * abs(complex((force * np.exp(-1j * scene.speed * times)).mean())) if len(force) else 0.0
    return WorkRun(
        case, levels, abs(max(halves[1]) - max(halves[0])), (float(x), float(y)), once,
        float(np.mean(force <= 0)) if len(force) else 0.0, slip,
        tuple(complex(own[0]) for own in imbalances_left(scene, states[:, -1:], [0j] * len(scene.races))),
    )  # fmt: skip


def _levels(scene: Scene, states: Array, places: Sequence[LevelPlaceOnSpindle]) -> tuple[float, ...]:
    """Velocity level [dB] of each place: rms of the larger of both axes."""
    size = len(scene.support.names)
    each = (scene.support.axis(states[size : 2 * size], held.place) for held in places)
    return tuple(level_from_velocity(max(float(np.sqrt((v**2).mean(axis=1)).max()), LEAST)) for v in each)


def agreement(design: SpindleDesign, wheel: PressedWheel, member: Member) -> float | str | None:
    """Largest relative difference of force and ball resultants from the closed form, with ideal races and balls.

    Balls start where the closed form has them, and must stay. Text: why it is not known. None: nothing presses in the
    plane, or a race cannot carry its resultant.
    """
    phases = start_phases(design, member)
    resultants = resultants_at_work(design, wheel, phases)
    angles = ball_angles(design, resultants)
    if angles is None or not wheel.presses or not wheel.runout:
        return None
    scene = scene_of(design, member).started([angle for own in angles for angle in own])
    ideal = replace(scene, effects=(wheel.effect(design.case, phases),), duration=IDEAL_S)
    expected = abs(contact_of(design, wheel, phases).balanced_force())
    try:
        run = _observed(design, WorkCase(wheel, "settled", member), ideal)
    except NotTrustworthyError as error:
        return str(error).splitlines()[0]
    if run.apart:
        return "wheel and workpiece part"
    off = [abs(run.force_amplitude - expected) / expected]
    ends = zip(run.resultants, resultants, design.races, strict=True)
    off += [abs(end - closed) / race.autobalancer.capacity for end, closed, race in ends]
    return max(off)


def work_cases(design: SpindleDesign, wheel: PressedWheel) -> tuple[WorkCase, ...]:
    """All runs of a wheel: phases of the imbalances; balls settled or not; hot and cold oil where they are settled."""
    case, turned = design.case, all_phases(design.case)
    spread = [start_of(design, "spread", phases) for phases in turned]
    few = spread[:: max(1, len(turned) // 2)]
    oils = [replace(each, drag=share * case.drag, promised=False) for share in case.drag_shares[1:] for each in few]
    early = [start_of(design, kind, phases) for kind in EARLY for phases in turned]
    return (
        *(WorkCase(wheel, "without", each) for each in spread),
        *(WorkCase(wheel, "settled", each) for each in (*spread, *oils)),
        *(WorkCase(wheel, "at once", each) for each in early),
    )
