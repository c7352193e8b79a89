"""The scenes that are measured, and references for them that two integrators of different kinds agree on."""

import math
from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cache

import numpy as np

from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import choice
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS
from abu_calc.dynamics.scene import Scene, only
from abu_calc.dynamics.supports.swing_arm import SwingArmSupport
from abu_calc.dynamics.switching.modes import watches
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.read_machine import read_machine
from abu_calc.inputs.reading.document import open_document
from abu_calc.inputs.reading.kinds import kind_of
from abu_calc.inputs.reading.sources import names
from abu_calc.simulation.scene_of_design import scene_of_design
from abu_calc.sizing import size
from abu_calc.sizing.design import Design
from tests.benchmarks.equations import grinder
from tests.benchmarks.measuring import Array, Run

SMOOTH = ("race_eccentricity", "gravity")
"""Effects without events, which peers have too."""

MOMENTS = 51
"""Of the common grid, from the start to the end."""

BALLS = (2, 4, 8, 16, 32, 64)


@dataclass(frozen=True)
class Case:
    """A scene with what all candidates share."""

    name: str
    scene: Scene
    equations: Equations
    moments: Array

    @property
    def rows(self) -> list[int]:
        """Which states are compared: the support's coordinates and the ball angles."""
        size, balls = self.equations.parameters.size, self.equations.parameters.balls
        return [*range(size), *range(2 * size, 2 * size + balls)]

    @property
    def scales(self) -> Array:
        """Of these."""
        return np.array(self.equations.scales)[self.rows]

    def run(self, candidate: str, tolerance: float) -> Run:
        """One run of the library itself, `candidate` as it names its integrators."""

        def go() -> tuple[Array, int]:
            run = choice.integrate_with(candidate, self.equations, tolerance, self.moments, MOST_EVALUATIONS)
            return run.y[self.rows], run.evaluations

        return Run(f"abu-calc {candidate}", tolerance, go)

    def reference(self) -> tuple[Array, float]:
        """Coordinates by the loop, and how far SciPy, which vouches for them by a method of its own, is from these."""
        name, tight = ("scipy-rk45", 1e-11) if watches(self.equations) else ("scipy-lsoda", 1e-12)
        loop, other = self.run("compiled-dop853", 1e-13).go()[0], self.run(name, tight).go()[0]
        return loop, float((np.abs(loop - other) / self.scales[:, None]).max())


def case(name: str, scene: Scene) -> Case:
    """A case on the common grid."""
    return Case(name, scene, assemble(scene), np.linspace(0.0, scene.duration, MOMENTS))


@cache
def design(preset: str) -> Design:
    """A preset, sized."""
    machine = read_machine(preset).tables
    if not isinstance(machine, MachineFile):
        raise TypeError(f"{preset} holds bearings alone")
    return size(machine)


def presets() -> list[str]:
    """The presets of whole machines that can be sized."""
    return [
        name for name in names() if kind_of(open_document(name).content).name == "machine"
        and isinstance(read_machine(name).tables, MachineFile)
    ]  # fmt: skip


def with_effects(scene: Scene, wanted: Collection[str]) -> Scene:
    """The scene with those of these effects that it has."""
    return only(scene, [effect.name for effect in scene.effects if effect.name in wanted])


def smooth(preset: str) -> Case:
    """A preset idling, balls bunched, with eccentricity and gravity."""
    return case(preset, with_effects(scene_of_design(design(preset), "idle"), SMOOTH))


def friction(preset: str = "avtovaz-707-222") -> Case:
    """Balls that find their places and stick there, without gravity, which would shake them loose."""
    scene = scene_of_design(design(preset), "idle")
    return case("stuck by friction", with_effects(scene, ("race_eccentricity", "dry_rolling_friction")))


def contact(preset: str = "avtovaz-707-222") -> Case:
    """Wheel and work touch and part."""
    scene = scene_of_design(design(preset), "grinding")
    return case("contact", with_effects(scene, (*SMOOTH, "grinding_contact")))


def resonance(preset: str = "swing-arm-grinder") -> Case:
    """The arm pressed to the work, at the speed at which it resonates with its balls."""
    scene = with_effects(scene_of_design(design(preset), "swing-arm-cutting"), SMOOTH)
    arm = scene.support
    if not isinstance(arm, SwingArmSupport):
        raise TypeError("the resonance is that of a swing arm")
    square = arm.length**2
    speed = math.sqrt(arm.stiffness * square / (arm.inertia + sum(scene.ball_masses) * square))
    return case("arm in resonance", replace(scene, speed=speed))


def many_balls(count: int) -> Case:
    """The straight grinder with so many balls round its race."""
    return case(f"{count} balls", grinder(count))
