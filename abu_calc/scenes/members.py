"""The many ways in which one machine is switched on: from where its balls start, how fast, with oil warm or cold."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.effects.run_up import RunUp as RunUpEffect
from abu_calc.dynamics.scene import Scene
from abu_calc.scenes.from_design import Start, guided, running_up, scene_of_design
from abu_calc.sizing.design import Design
from abu_calc.spec.duty import RunUp

STARTS: tuple[Start, ...] = ("bunched", "behind", "spread", "standstill")

DRAGS = (1.0, 1 / 3, 3.0)
"""Of the drag given: as oil is meant, hot, and cold."""

RUN_UP, SLOW = 1.0, 4.0
"""Run-up [s] of a file that names none, and one slow enough to catch balls at a resonance."""

OPPOSITE, ALIKE = math.pi, 0.0
"""Where the centre of the race stands, from the imbalance: opposite it asks for the most capacity, on the same side
balls settle latest and friction leaves the loudest arrangements."""

LAGS = 3.0
"""Times J/h₀, in which balls that stand still take up the speed of the race, that a run is longer for them."""


@dataclass(frozen=True)
class Member:
    """One start: where from, the drag h₀ [1/s], and the time [s] from standstill to full speed, 0 at full speed.

    `eccentricity`: where the centre of the race stands, from the imbalance [rad].
    """

    start: Start
    drag: float
    run_up: float = 0.0
    eccentricity: float = OPPOSITE

    @property
    def name(self) -> str:
        """In words."""
        return f"run-up in {self.run_up:g} s" if self.run_up else str(self.start)


def members(design: Design, doubtful: float = 0.0, shares: tuple[float, ...] = DRAGS) -> Iterator[Member]:
    """All that are simulated, at these shares of the drag given; at that itself with the race off to either side.

    Below the drag `doubtful` [1/s] balls might hang, so that a slow run-up is tried, too.
    """
    given = design.case.table.run_up
    usual = given.time_s if given else RUN_UP
    for drag in dict.fromkeys(share * design.case.drag for share in shares):
        both = drag == design.case.drag and design.case.race_eccentricity > 0
        for angle in (ALIKE, OPPOSITE) if both else (ALIKE,):
            yield from (Member(start, drag, 0.0, angle) for start in STARTS)
            yield Member("bunched", drag, usual, angle)
            if drag < doubtful and usual < SLOW:
                yield Member("bunched", drag, SLOW, angle)


def scene_of_member(design: Design, member: Member) -> Scene:
    """The idle scene of a machine started so, with every effect its file has data for.

    Long enough for balls that stand still to take up the speed, beside what the scene lasts in any case.
    """
    own = _with(design, member)
    scene = scene_of_design(own, "run-up" if member.run_up else "idle", member.start)
    turned = (replace(one, angle=member.eccentricity) if isinstance(one, RaceEccentricity) else one
              for one in scene.effects)  # fmt: skip
    scene = replace(scene, effects=tuple(turned))
    if not member.run_up:
        scene = _paused(scene, guided(own, 0.0))
        if member.start != "standstill":
            return scene
    longest = own.case.table.limits.settling_time_s
    lag = LAGS * own.case.inertia_factor / member.drag if member.drag else longest
    return replace(scene, duration=scene.duration + min(lag, longest))


def full_speed_at(design: Design, member: Member) -> float:
    """When a member is at full speed for good [s]; a motor sets its own pace."""
    return running_up(_with(design, member)) if member.run_up else guided(design, 0.0).at_speed


def _paused(scene: Scene, pace: RunUpEffect) -> Scene:
    """A scene at full speed with the pause of its file, if there is one; longer by that."""
    if not pace.at_speed:
        return scene
    return replace(scene, effects=(pace, *scene.effects), duration=scene.duration + pace.at_speed)


def _with(design: Design, member: Member) -> Design:
    """The design with the drag and the run-up of a member."""
    table, given = design.case.table, design.case.table.run_up
    usual = given.time_s if given else RUN_UP
    if member.run_up and (given is None or member.run_up != usual):
        # A slow run-up is a guided one: a motor would set its own pace.
        motor = table.motor if member.run_up == usual else None
        slow = (given or RunUp()).model_copy(update={"time_s": member.run_up})
        table = table.model_copy(update={"run_up": slow, "motor": motor})
    rates = sorted(design.track.decay_rates, key=lambda one: abs(one[0] - member.drag))
    track = replace(design.track, decay_rates=tuple(rates))
    return replace(design, case=replace(design.case, drag=member.drag, table=table), track=track)
