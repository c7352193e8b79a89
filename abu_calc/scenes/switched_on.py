"""One machine built and switched on once: where its balls lie, how warm the oil is, which way the race stands off."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass
from abu_calc.scenes.from_design import AHEAD
from abu_calc.scenes.members import OPPOSITE, Member, idle_speed, scene_of_member, usual_run_up
from abu_calc.sizing.design import Design

KINDS: Final = ("bunched", "spread", "standstill", "run-up")
"""Starts that are drawn: balls at rest in the race, touching or evenly round it; not turning at all; a run-up."""


@dataclass(frozen=True)
class SwitchedOn:
    """A start: one of KINDS, where the middle of the bunch (or the first of balls spread) lies, and the centre of the
    race, both from the imbalance [rad].
    """

    kind: str = "bunched"
    angle: float = AHEAD
    eccentricity: float = OPPOSITE

    def member(self, design: Design) -> Member:
        """The same as one of those that every design is tried with."""
        if self.kind == "run-up":
            return replace(usual_run_up(design), eccentricity=self.eccentricity)
        start = next(kind for kind in KINDS if kind == self.kind)
        return Member(start, design.case.drag, 0.0, self.eccentricity, idle_speed(design.case))  # type: ignore[arg-type]


def scene_switched_on(design: Design, start: SwitchedOn, lighter: Sequence[float] = ()) -> Scene:
    """The idle scene of a machine switched on so, with every effect its file has data for.

    `lighter`: the share by which each ball's mass is off that of the lot.
    """
    scene = scene_of_member(design, start.member(design))
    races = tuple(
        replace(
            race,
            start_angles=tuple(angle + start.angle - AHEAD for angle in race.start_angles),
            ball_masses=tuple(
                mass * (1 + off)
                for mass, off in zip(race.ball_masses, lighter or (0.0,) * len(race.ball_masses), strict=True)
            ),
        )
        for race in scene.races
    )
    return replace(scene, races=races)


def turned(scene: Scene, angle: float, drag_ratio: float) -> Scene:
    """A scene given outright, its balls started further round by an angle [rad], in oil of another drag."""
    races = tuple(
        replace(
            race,
            start_angles=tuple(
                math.remainder(each + angle, 2 * math.pi) if angle else each for each in race.start_angles
            ),
            drag=race.drag * drag_ratio,
        )
        for race in scene.races
    )
    return replace(scene, races=races)
