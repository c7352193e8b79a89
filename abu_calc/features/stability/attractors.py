"""Attractors of a scene as a result: kinds, shares of starts, ball speeds, levels, examples that can be rerun.

Search for all attractors of a scene at constant speed: many starts followed to their ends, alike ends grouped.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Annotated, Final

from abu_calc.dynamics.scene import Scene, without
from abu_calc.dynamics.stability.stall import ClosedStuckSpeed, natural_frequencies, stuck_speeds
from abu_calc.features.stability.attractor_ends import (
    CHAOTIC,
    CLOSER,
    LOOKS,
    STEADY_LEVEL,
    STEADY_SPEED,
    STILL,
    BallStart,
    EndState,
    Follower,
    Kind,
    designed_starts,
    drawn_starts,
    touching,
)
from abu_calc.foundation import patience
from abu_calc.foundation.checks import Check, coded
from abu_calc.foundation.errors import InputError, Place, shell_word
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import processors, side_by_side
from abu_calc.foundation.progress import Progress, counted, silent
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.shares import interval
from abu_calc.foundation.units import level_from_velocity, shown
from abu_calc.foundation.validity import Range
from abu_calc.inputs.read_machine import Machine
from abu_calc.simulation.run_checks import SLIPPING
from abu_calc.simulation.subject import Subject, chosen
from abu_calc.sizing.places import level_at_loudest

ALIKE_SPEED: Final = 0.02
"""Share of the rotor's speed: ends whose balls turn at speeds nearer than this, and at `ALIKE_LEVEL`, are one."""

ALIKE_LEVEL: Final = 1.0
"""Difference of levels [dB] of moving balls in one attractor."""

TRIED: Final = 4
"""Starts of a group that are run once more, more closely, until the end of one is confirmed."""

ORDER: Final[tuple[Kind, ...]] = ("balanced", "stuck", "limit-cycle", "chaotic", "resting", "undecided")


@dataclass(frozen=True)
class EndGroup:
    """Ends that are one attractor; `example`: the one to show, `confirmed` if a closer run ends in the group, too."""

    kind: Kind
    ends: tuple[EndState, ...]
    example: EndState
    confirmed: bool

    @property
    def drawn(self) -> int:
        """Number of its starts that were drawn by lot."""
        return sum(end.start.drawn for end in self.ends)


@dataclass(frozen=True)
class FoundAttractors:
    """Groups in the order of `ORDER`; `undecided` ends belong to none."""

    groups: tuple[EndGroup, ...]
    undecided: tuple[EndState, ...]
    drawn: int
    designed: int

    @property
    def hurried(self) -> bool:
        """True if patience ended before all starts were followed."""
        return any(end.reason == "time was up" for end in self.undecided)


def search(
    scene: Scene, number: int, seed: int, progress: Progress = silent, *, designed: bool = True, only: str | None = None
) -> FoundAttractors:
    """Follow `number` drawn starts, and the designed ones, and group their ends. The scene has no run-up.

    `only`: name of the one start that is followed. Raises InputError for a name that these starts do not have.
    """
    follower = Follower.of(scene)
    starts = [*(designed_starts(scene) if designed else ()), *drawn_starts(scene, number, seed)]
    if only is not None:
        starts = [replace(start, drawn=True) for start in starts if start.name == only]
        if not starts:
            raise InputError("no such start", place=Place(key="only"), found=only,
                             allowed=f"designed-N, or drawn-N from 0 to {number - 1}")  # fmt: skip
    report = counted(progress, "attractors: {} of {} starts", len(starts))
    ends = list(side_by_side(_ended, [(follower, start) for start in starts], processors(), report))
    drawn = sum(start.drawn for start in starts)
    undecided = tuple(end for end in ends if end.kind == "undecided")
    parts = grouped(scene, [end for end in ends if end.kind != "undecided"])
    report = counted(progress, "attractors: {} of {} confirmed", max(len(parts), 1))
    groups = list(side_by_side(_confirmed, [(follower, part) for part in parts], processors(), report))
    groups.sort(key=lambda group: (ORDER.index(group.kind), -len(group.ends)))
    return FoundAttractors(tuple(groups), undecided, drawn, len(starts) - drawn)


def grouped(scene: Scene, ends: Sequence[EndState]) -> list[tuple[EndState, ...]]:
    """Ends of one kind whose balls turn at like speeds; of moving balls also at like levels (single linkage)."""
    labels = list(range(len(ends)))
    for k in range(len(ends)):
        for j in range(k):
            if labels[j] != labels[k] and alike(scene, ends[k], ends[j]):
                old, new = max(labels[k], labels[j]), min(labels[k], labels[j])
                labels = [new if label == old else label for label in labels]
    return [tuple(end for end, own in zip(ends, labels, strict=True) if own == label) for label in sorted(set(labels))]


def alike(scene: Scene, end: EndState, other: EndState) -> bool:
    """True if two ends belong to one attractor."""
    if end.kind != other.kind:
        return False
    if end.kind in ("balanced", "resting", "chaotic"):
        return True
    apart = max(abs(a - b) for a, b in zip(end.ball_speeds, other.ball_speeds, strict=True))
    quiet = max(min(end.velocity, other.velocity), 1e-300)
    louder = 20 * math.log10(max(end.velocity, other.velocity, 1e-300) / quiet)
    return apart <= ALIKE_SPEED * scene.speed and louder <= ALIKE_LEVEL


def _ended(follower: Follower, start: BallStart) -> EndState:
    """End of a start; one that stays unsteady and amplifies a disturbance is chaotic."""
    if patience.over():
        return EndState(start, "undecided", reason="time was up")
    end = follower.end_of(start)
    if end.kind == "undecided" and end.end and follower.grows(end) > CHAOTIC:
        return replace(end, kind="chaotic", reason="")
    return end


def _confirmed(follower: Follower, ends: tuple[EndState, ...]) -> EndGroup:
    """The group with an example whose closer run ends alike; cycles that amplify a disturbance are chaotic."""
    kind = ends[0].kind
    middle = sorted(ends, key=lambda end: end.velocity)[len(ends) // 2]
    order = sorted(ends, key=lambda end: (end.duration, abs(end.velocity - middle.velocity)))
    if kind == "limit-cycle" and follower.grows(middle) > CHAOTIC:
        kind = "chaotic"
    if kind == "chaotic":
        return EndGroup(kind, ends, middle, True)
    for end in order[:TRIED]:
        if patience.over():
            break
        closer = follower.end_of(end.start, CLOSER)
        if closer.kind == end.kind and alike(follower.scene, closer, end):
            return EndGroup(kind, ends, end, True)
    return EndGroup(kind, ends, order[0], False)


STARTS: Final = Range("number of drawn starts", 1, 100_000, key="starts", remedy="Ask for a number in this range.")
SEED: Final = Range("seed", 0, 2**32 - 1, key="seed", remedy="Give a whole number in this range.")

ACCURACY: Final = 0.01
"""Accuracy at which light effects are left out, as `abu simulate` does."""

ALWAYS: Final = ("dry_rolling_friction", "ball_contact")
"""Effects that are in whatever they weigh: they decide where balls stall or rest."""

RUNS_UP: Final = ("run_up", "motor")
"""Effects that change the rotor's speed: they are left out."""

CRITERION: Final = (
    f"Each start is followed for {', '.join(str(look) for look in LOOKS[:-1])} or {LOOKS[-1]} times the scene's "
    f"duration (60 revolutions at least), until the last quarter is steady: mean ball speeds of its halves within "
    f"{STEADY_SPEED:.1%} of the rotor's speed, velocity within {STEADY_LEVEL:.0%}. Balanced: no ball faster than "
    f"{SLIPPING:.0%} of the rotor's speed against the race, and mean residual imbalance at most a tenth of the "
    "imbalance plus what eccentricity and friction leave. Resting: balls at rest in the race "
    f"(within {STILL:.1%}) off balance. Stuck: balls turn near a natural frequency, or stand still. Limit cycle: any "
    "other steady motion. Chaotic: unsteady, and a disturbance of 1e-6 rad grows more than "
    f"{CHAOTIC:.0e} times. Ends of moving balls are one attractor if ball speeds differ by at most {ALIKE_SPEED:.0%} "
    f"of the rotor's speed and levels by at most {ALIKE_LEVEL:g} dB. Shares count drawn starts: each ball anywhere "
    "round the race, at any speed between standstill and the rotor's; the intervals hold 95 %."
)
"""Criterion of the search, in words."""


@record
class AttractorExample(Record):
    """A start that ends at the attractor; speeds are against the race."""

    start_angles_deg: Annotated[tuple[float, ...], Quantity("balls start at", "θ", 6)]
    start_speeds_rpm: Annotated[tuple[float, ...], Quantity("balls start with", "", 8)]
    duration: Annotated[float, Quantity("length of the run", "t", 6, unit="s")]
    confirmed: Annotated[bool, Quantity("a closer run ends there, too")]
    command: Annotated[str | None, Quantity("command that follows it again", "", 4, "None for a scene without a file")]
    simulate: Annotated[str | None, Quantity("command that shows its motion", "", 4, "refused if errors grow in it")]


@record
class Attractor(Record):
    """One attractor; `share` of the drawn starts with its 95 % interval `low` … `high` (Clopper-Pearson)."""

    kind: Annotated[str, Quantity("kind", "", 4, "balanced, stuck, limit-cycle, chaotic or resting")]
    share: Annotated[float, Quantity("share of drawn starts")]
    low: Annotated[float, Quantity("share, at least")]
    high: Annotated[float, Quantity("share, at most")]
    drawn_starts: Annotated[int, Quantity("drawn starts that end there")]
    designed_starts: Annotated[int, Quantity("designed starts that end there")]
    ball_speeds: Annotated[tuple[float, ...], Quantity("balls turn at", "", 5, "in space, slowest first", unit="rpm")]
    natural_frequency: Annotated[float | None, Quantity("stuck at the natural frequency", "", 5, unit="rpm")]
    level_db: Annotated[float | None, Quantity("level", "L", 4)]
    level_range_db: Annotated[tuple[float, float] | None, Quantity("levels of all its ends", "L", 4)]
    residual_imbalance: Annotated[float, Quantity("residual imbalance", "", 4, unit="g_mm")]
    example: AttractorExample
    text: Annotated[str, Quantity("in words")]


@record
class AttractorSearch(Record):
    """What was run to find the attractors."""

    drawn_starts: Annotated[int, Quantity("drawn starts")]
    designed_starts: Annotated[int, Quantity("designed starts")]
    seed: Annotated[int, Quantity("seed")]
    undecided_starts: Annotated[int, Quantity("starts without a decided end")]
    undecided_share: Annotated[float, Quantity("share of drawn starts without a decided end")]
    undecided_reasons: Annotated[tuple[str, ...], Quantity("their reasons")]
    natural_frequencies: Annotated[tuple[float, ...], Quantity("natural frequencies with the balls", "", 5, unit="rpm")]
    stuck_speeds: tuple[ClosedStuckSpeed, ...]
    criterion: Annotated[str, Quantity("criterion")]


def attractors_of(
    subject: Subject, count: int, seed: int, progress: Progress, only: str | None = None
) -> tuple[tuple[Attractor, ...], AttractorSearch, Check]:
    """All attractors that starts of a subject reach at its speed, what was run, and the check about them."""
    STARTS.check(count)
    SEED.check(seed)
    scene = searched_scene(subject)
    found = search(scene, count, seed, progress, only=only)
    reasons = Counter(end.reason for end in found.undecided)
    lost = sum(end.start.drawn for end in found.undecided)
    groups = tuple(_record(subject, scene, group, found.drawn, (count, seed)) for group in found.groups)
    summary = AttractorSearch(
        drawn_starts=found.drawn,
        designed_starts=found.designed,
        seed=seed,
        undecided_starts=len(found.undecided),
        undecided_share=lost / found.drawn,
        undecided_reasons=tuple(f"{reason} ({number})" for reason, number in reasons.most_common(5)),
        natural_frequencies=natural_frequencies(scene),
        stuck_speeds=stuck_speeds(scene, touching(scene)),
        criterion=CRITERION,
    )
    return groups, summary, _check(found)


def searched_scene(subject: Subject) -> Scene:
    """The scene of a subject at constant speed, with the effects it calls for; dry friction and contact always."""
    if not subject.scene.ball_masses:
        raise InputError("there are no balls whose motion could end anywhere", place=Place(key="attractors"))
    steady = without(subject.scene, RUNS_UP)
    scene = chosen(steady, ACCURACY, _always(steady)).scene
    # The time of a run-up is no part of a run at constant speed.
    return replace(scene, duration=max(scene.duration - subject.scene.full_speed, scene.revolution))


def _always(scene: Scene) -> list[str]:
    return [name for name in ALWAYS if scene.effect(name) is not None]


def _record(subject: Subject, scene: Scene, group: EndGroup, drawn: int, lot: tuple[int, int]) -> Attractor:
    """Record of a group; `lot`: how many starts were drawn by which seed."""
    levels = [level for end in group.ends if (level := _level(subject, end)) is not None]
    low, high = interval(group.drawn, drawn)
    example = group.example
    return Attractor(
        kind=group.kind,
        share=group.drawn / drawn,
        low=low,
        high=high,
        drawn_starts=group.drawn,
        designed_starts=len(group.ends) - group.drawn,
        ball_speeds=example.ball_speeds,
        natural_frequency=example.frequency,
        level_db=_level(subject, example),
        level_range_db=(min(levels), max(levels)) if levels else None,
        residual_imbalance=example.residual,
        example=AttractorExample(
            start_angles_deg=example.start.angles_deg,
            start_speeds_rpm=example.start.speeds_rpm,
            duration=example.duration,
            confirmed=group.confirmed,
            command=_again(subject, example, lot),
            simulate=_simulate(subject, example),
        ),
        text=_in_words(scene, group),
    )


def _level(subject: Subject, end: EndState) -> float | None:
    """Level [dB] of an end: of a machine at the loudest limited place, otherwise of the axis; None without motion."""
    design = subject.design
    if end.velocity <= 0:
        return None
    if design is None:
        return level_from_velocity(end.velocity)
    amplitude = math.sqrt(2) * end.velocity / design.case.speed
    return level_at_loudest(design.case, design.autobalancer, amplitude)


def _in_words(scene: Scene, group: EndGroup) -> str:
    kind, frequency, speeds = group.kind, group.example.frequency, group.example.ball_speeds
    stuck = sum(abs(speed - scene.speed) > SLIPPING * scene.speed for speed in speeds)
    balls = f"{stuck} of {len(speeds)} balls"
    if kind == "stuck" and frequency == 0:
        return f"{balls} stand still"
    if kind == "stuck" and frequency is not None:
        return f"{balls} stuck at the natural frequency {shown(frequency, 'rpm', '.4g')}"
    words = {
        "balanced": "balls at rest in the race, balanced",
        "resting": "balls at rest in the race, off balance",
        "chaotic": "balls move chaotically",
        "limit-cycle": f"{balls} go round against the race" if stuck else "balls swing about a mean place",
    }
    return words[kind]


def _again(subject: Subject, end: EndState, lot: tuple[int, int]) -> str | None:
    """Command that follows the same start; None without a file."""
    if subject.reading is None or not subject.reading.file:
        return None
    seed = f" --seed {lot[1]}" if lot[1] else ""
    drawn = f" --starts {lot[0]}{seed}" if end.start.name.startswith("drawn") else ""
    return f"{' '.join(_asked(subject, 'stability'))} --attractors{drawn} --only {end.start.name}"


def _simulate(subject: Subject, end: EndState) -> str | None:
    """Command that simulates a start again; None without a file and for machines with two races."""
    if subject.reading is None or not subject.reading.file:
        return None
    if subject.design is None and isinstance(subject.reading, Machine):
        return None
    return " ".join([*_asked(subject, "simulate"), *_parts(subject, end)])


def _asked(subject: Subject, command: str) -> Iterator[str]:
    """A command with the subject's file, scene and replaced entries."""
    reading = subject.reading
    assert reading is not None
    yield f"abu {command} {shell_word(reading.file)}"
    if isinstance(reading, Machine) and subject.scene.name != "idle":
        yield f"--scene {subject.scene.name}"
    for override in reading.overrides:
        yield f"--set {shell_word(f'{override.key}={_toml(override.value)}')}"


def _parts(subject: Subject, end: EndState) -> Iterator[str]:
    """Options of `abu simulate` that give a start, its effects and its duration."""
    scene, angles, speeds = subject.scene, end.start.angles_deg, end.start.speeds_rpm
    if subject.design is not None:
        yield f"--set {shell_word(f'start.angles_deg={_toml(angles)}')}"
        yield f"--set {shell_word(f'start.speeds_rpm={_toml(speeds)}')}"
    else:
        for index, ((_, own), (_, rates)) in enumerate(zip(scene.by_race(angles), scene.by_race(speeds), strict=True)):
            yield f"--set {shell_word(f'scene.race[{index}].start_angles_deg={_toml(own)}')}"
            yield f"--set {shell_word(f'scene.race[{index}].start_speeds_rpm={_toml(rates)}')}"
    for name in _always(subject.scene):
        yield f"--with {name}"
    for name in RUNS_UP:
        if subject.scene.effect(name) is not None:
            yield f"--without {name}"
    yield f"--duration {end.duration:.9g}"


def _toml(value: object) -> str:
    """A value as `--set` takes it."""
    if isinstance(value, (tuple, list)):
        return f"[{','.join(map(_toml, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _check(found: FoundAttractors) -> Check:
    """Do all decided starts end balanced?"""
    total = found.drawn + found.designed
    others = sum(len(group.ends) for group in found.groups if group.kind != "balanced")
    if found.hurried or not found.groups:
        lost = len(found.undecided)
        return coded("ABU804", "not-done", f"{lost} of {total} starts have no decided end", None)
    if not others and not found.undecided:
        return coded("ABU804", "pass", f"all {total} starts end balanced", 0.0, 0.0)
    message = f"{others} of {total} starts end elsewhere"
    if found.undecided:
        message += f", {len(found.undecided)} without a decided end"
    remedy = "Raise the viscous drag rate, or the damping of the support; the table lists where starts end."
    return coded("ABU804", "warn", message, float(others + len(found.undecided)), 0.0, remedy)
