"""Search for all attractors of a scene at constant speed: many starts followed to their ends, alike ends grouped."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.features.stability.attractor_ends import (
    CHAOTIC,
    CLOSER,
    EndState,
    Follower,
    Kind,
)
from abu_calc.features.stability.attractor_starts import BallStart, designed_starts, drawn_starts
from abu_calc.foundation import patience
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.parallel import processors, side_by_side
from abu_calc.foundation.progress import Progress, counted, silent

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
