"""One machine pressed to its workpiece from many start cases: the level and the motion that each ends with.

Each start case of the idle machine is pressed in two ways: after its balls have settled at idle, as in practice, and at
once. From the same start case, contact and friction may lead to different motions, which one run cannot show.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, Literal

import numpy as np

from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Array
from abu_calc.features.grinding.simulation import read
from abu_calc.features.grinding.steady_contact import contact_presses
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import side_by_side
from abu_calc.foundation.progress import Progress, counted, silent
from abu_calc.simulation.ensemble import ALWAYS, WORK, first_tolerance, integrated, start_once
from abu_calc.simulation.response import SAMPLES_PER_REVOLUTION
from abu_calc.simulation.run_checks import SLIPPING
from abu_calc.simulation.start_cases import Lost, Member, StartOutcome, grinding_scene_of_member, members
from abu_calc.simulation.subject import chosen
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import handle_levels

Pressed = Literal["settled", "at once"]

TOLERANCE: Final = 2e-5
"""Tolerance of the runs. Levels of the presets and of an angle grinder are the same at 2e-4, to 0.1 dB."""

LONGEST: Final = 6.0
"""Seconds that a run lasts which has not come to a steady level, or bounces."""

MOST_LONGER: Final = 8
"""Start cases that are run again for so long."""

FEW_LONGER: Final = 2
"""The same where only a few start cases are run."""

STEADY: Final = 0.5
"""A level [dB] that changes by less from one half of the observed time to the other is steady."""

OBSERVED: Final = 1 / 3
"""Share of a run, at its end, whose motion counts."""

MOVING: Final = 0.05
"""Angle [rad] through which a ball swings in the race that counts as swinging: three degrees."""

FEW: Final = 4
"""Start cases of each way of pressing when a machine is sized: each kind once, the race off to either side in turn."""


@dataclass(frozen=True)
class LoadedStart:
    """An idle start case, and when the wheel is pressed to the workpiece: its balls settled, or at once."""

    member: Member
    pressed: Pressed

    @property
    def name(self) -> str:
        """Name of the start case in words."""
        return f"{self.member.name}, race centre {self.member.race_centre_deg:g}°, pressed {WHEN[self.pressed]}"


WHEN: Final[dict[str, str]] = {"settled": "after the balls settled", "at once": "before the balls settled"}


@dataclass(frozen=True)
class LoadedOutcome:
    """Outcome of one start case: the level [dB] at the loudest handle over the last third of the run.

    `velocity` [m/s] rms, the larger of both axes; `drift` [dB]: change of the level within that time; `apart`: share
    of it in which wheel and workpiece do not touch; `imbalance` [kg m] of wheel and balls in the race plane; `slip`:
    largest mean speed of a ball in the race over the rotor's; `swing` [rad]: largest travel of a ball in the race
    within the last sixth of the run; `duration` [s] of the run.
    """

    start: LoadedStart
    level: float
    velocity: float
    drift: float
    apart: float
    parts: bool
    imbalance: complex
    slip: float
    swing: float
    duration: float

    @property
    def stalls(self) -> bool:
        """True if a ball keeps going round in the race."""
        return self.slip > SLIPPING

    @property
    def swings(self) -> bool:
        """True if a ball keeps swinging in the race."""
        return self.swing > MOVING


@dataclass(frozen=True)
class LoadedEnsemble:
    """All start cases of one machine at its workpiece."""

    outcomes: tuple[LoadedOutcome, ...]
    lost: tuple[Lost, ...]

    @property
    def count(self) -> int:
        """Number of start cases, those without an answer included."""
        return len(self.outcomes) + len(self.lost)

    def pressed(self, when: Pressed) -> tuple[LoadedOutcome, ...]:
        """The outcomes of one way of pressing."""
        return tuple(outcome for outcome in self.outcomes if outcome.start.pressed == when)

    def without_answer(self, when: Pressed) -> tuple[Lost, ...]:
        """The start cases of one way of pressing that have no answer."""
        return tuple(lost for lost in self.lost if lost.member.pressed == when)


def loaded_ensemble(
    design: Design, accuracy: float, progress: Progress = silent, workers: int = 1,
    idle: Sequence[StartOutcome | Lost] | None = None, most: int | None = None,
) -> LoadedEnsemble | None:  # fmt: skip
    """Run every start case of grinding; None for a machine whose contact does not press in the plane of the wheel.

    `idle`: outcomes of the idle start cases, where they were simulated before; None: they are simulated here. `most`:
    at most so many of each way of pressing. The outcome does not depend on `workers`.
    """
    if not contact_presses(design.case) or not design.autobalancer.ball_count:
        return None
    settled = list(_settled(design, accuracy, idle, most))
    starts = [start for start in settled if isinstance(start, LoadedStart)] + _at_once(design, most)
    lost = [start for start in settled if isinstance(start, Lost)]
    tasks = [(design, start, accuracy) for start in starts]

    watched = counted(progress, "grinding: {} of {} starts", len(tasks))
    outcomes = list(side_by_side(loaded_start, tasks, workers, watched))
    longer = MOST_LONGER if most is None else FEW_LONGER
    outcomes = _longer(design, outcomes, accuracy, progress, workers, longer)
    lost += [outcome for outcome in outcomes if isinstance(outcome, Lost)]
    return LoadedEnsemble(tuple(outcome for outcome in outcomes if isinstance(outcome, LoadedOutcome)), tuple(lost))


def _settled(
    design: Design, accuracy: float, idle: Sequence[StartOutcome | Lost] | None, most: int | None
) -> Iterator[LoadedStart | Lost]:
    """The idle start cases at their ends, as starts of grinding; or why one has no end to start from."""
    every = [member for member in members(design, shares=(1.0,)) if member.speed is None or member.by_motor]
    known = {outcome.member: outcome for outcome in idle or ()}
    for member in _kinds(every, most, 0):
        outcome = known.get(member) or start_once(design, member, accuracy, first_tolerance(design))
        start = LoadedStart(member, "settled")
        if isinstance(outcome, Lost):
            yield Lost(start, f"idle: {outcome.reason}")
        elif outcome.hanging:
            yield Lost(start, "idle: balls stall and never settle")
        else:
            yield replace(start, member=replace(member, angles=outcome.ball_angles))


def _at_once(design: Design, most: int | None) -> list[LoadedStart]:
    """The start cases at full speed, pressed before any ball has moved."""
    every = [member for member in members(design, shares=(1.0,)) if member.speed is None and not member.run_up]
    return [LoadedStart(member, "at once") for member in _kinds(every, most, 1)]


def _kinds(starts: Sequence[Member], most: int | None, first: int) -> list[Member]:
    """All of them; or at most so many kinds, each once, with the race off to either side in turn, from that side on."""
    if most is None:
        return list(starts)
    kinds: dict[str, list[Member]] = {}
    for start in starts:
        kinds.setdefault(start.name, []).append(start)
    return [sides[(first + k) % len(sides)] for k, sides in enumerate(kinds.values())][:most]


def loaded_start(design: Design, start: LoadedStart, accuracy: float, least: float = 0.0) -> LoadedOutcome | Lost:
    """Run one start case; `least` [s]: it lasts so long at least."""
    member = start.member
    if start.pressed == "settled":
        member = replace(member, start="placed", run_up=0.0, by_motor=False, speed=None)
    try:
        scene = grinding_scene_of_member(design, member)
        scene = replace(scene, duration=max(scene.duration, least))
        outcome = _observed(design, start, with_parted_balls(chosen(scene, accuracy, ALWAYS).scene)[0])
    except NotTrustworthyError as error:
        return Lost(start, str(error).splitlines()[0])
    if outcome.parts and design.case.contact is not None and design.case.contact.contact == "rigid":
        return Lost(start, "the contact is taken as rigid, and would have to pull")
    return outcome


def _observed(design: Design, start: LoadedStart, scene: Scene) -> LoadedOutcome:
    """Integrate the scene and read the end of it."""
    turns = max(int(OBSERVED * scene.duration / scene.revolution), 2)
    step = scene.revolution / SAMPLES_PER_REVOLUTION
    times = np.asarray(scene.duration - step * np.arange(turns * SAMPLES_PER_REVOLUTION, -1, -1), dtype=float)
    states = integrated(scene, times, TOLERANCE, WORK)[0].at(times)
    half = turns // 2 * SAMPLES_PER_REVOLUTION
    squares = scene.axis_velocity(states[:, :-1]) ** 2
    first, last = (_level(design, _rms(part)) for part in (squares[:, :half], squares[:, -half:]))
    count, balls = 2 * len(scene.support.names), len(scene.ball_masses)
    angles = states[count : count + balls]
    motion = read(scene, times, states)
    velocity = _rms(squares)
    return LoadedOutcome(
        start=start,
        level=_level(design, velocity),
        velocity=velocity,
        drift=abs(last - first),
        apart=motion.apart,
        parts=motion.parts,
        imbalance=motion.imbalance,
        slip=float(np.abs(angles[:, -1] - angles[:, -1 - half]).max()) / (half * step * scene.speed),
        swing=float(np.ptp(angles[:, -1 - half :], axis=1).max()),
        duration=scene.duration,
    )


def _rms(squares: Array) -> float:
    """The larger of both axes [m/s]."""
    return math.sqrt(float(squares.mean(axis=1).max()))


def _level(design: Design, velocity: float) -> float:
    """Level at the loudest handle [dB]."""
    moved = math.sqrt(2) * velocity / design.case.speed
    level = handle_levels(design.case, None, moved, design.autobalancer.mass).worst.after
    return -math.inf if level is None else level


def _longer(
    design: Design, outcomes: list[LoadedOutcome | Lost], accuracy: float, progress: Progress, workers: int,
    most: int,
) -> list[LoadedOutcome | Lost]:  # fmt: skip
    """Run at most so many again for longer whose level is not steady, or that bounce louder than the quietest.

    They may go over to another motion yet. A run that fails leaves the first one.
    """
    levels = [outcome.level for outcome in outcomes if isinstance(outcome, LoadedOutcome)]
    if not levels:
        return outcomes
    doubtful = [
        (k, outcome.start)
        for k, outcome in enumerate(outcomes)
        if isinstance(outcome, LoadedOutcome) and outcome.duration < LONGEST
        and (outcome.drift > STEADY or (outcome.parts and outcome.level > min(levels) + 2 * STEADY))
    ][:most]  # fmt: skip
    tasks = [(design, start, accuracy, LONGEST) for _, start in doubtful]

    watched = counted(progress, "grinding, longer: {} of {} starts", len(tasks))
    again = side_by_side(loaded_start, tasks, workers, watched)
    longer = {k: later for (k, _), later in zip(doubtful, again, strict=True) if isinstance(later, LoadedOutcome)}
    return [longer.get(k, outcome) for k, outcome in enumerate(outcomes)]
