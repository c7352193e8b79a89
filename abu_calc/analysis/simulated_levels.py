"""Levels of a simulated motion: at the axis of a scene, or where a machine is held."""

import math
from typing import Final

import numpy as np

from abu_calc.analysis.levels import PlaceLevels, axis_levels, carried, with_tone
from abu_calc.analysis.octaves import LEAST, RAMP, SETTLED, Array, Signal
from abu_calc.analysis.response import axis_velocity
from abu_calc.analysis.simulate import Simulation
from abu_calc.dynamics.scene import Scene
from abu_calc.sizing.design import Design
from abu_calc.standards.vibration import hand_arm_response, octaves

SLOWEST: Final = 4096.0
"""Samples a second at least: enough for all octaves."""
PER_REVOLUTION: Final = 40
LAST: Final = 0.95
"""Share of a run from which on means are taken: the amplitude window is the last twentieth."""


def duration_for(scene: Scene) -> float:
    """Time [s] to simulate so that every octave of the motion left after the scene's own time is known."""
    return scene.duration + LEAST * _slowest_period()


def times_for(scene: Scene) -> Array:
    """Equally spaced times [s] of a run, often enough for its fastest octave and its revolutions; as much of its end
    as the slowest octave asks for.
    """
    rate, end, period = max(SLOWEST, PER_REVOLUTION / scene.revolution), scene.duration, _slowest_period()
    begin = max(0.0, min(LAST * end, end - 2 * RAMP * period) - SETTLED * period)
    return np.linspace(begin, end, math.ceil((end - begin) * rate) + 1)


def _slowest_period() -> float:
    return 2 * math.pi / octaves()[0].centre


def axis_place_levels(run: Simulation, times: Array, name: str) -> PlaceLevels:
    """Levels of the axis along x and y, from the states of a run sampled at these times."""
    velocities = axis_velocity(run.scene, run.trajectory.at(times))
    rate, start = (len(times) - 1) / float(times[-1] - times[0]), LAST * run.scene.duration - float(times[0])
    signals = [Signal(np.asarray(values), rate, 0, start, whole=True) for values in velocities]
    return PlaceLevels(name, tuple(map(axis_levels, "xy", signals)))


def held_levels(design: Design, at_race: PlaceLevels) -> tuple[PlaceLevels, ...]:
    """Levels at the handles, or in the wheel plane, carried there from the race as by a free rigid body.

    Balls in another plane than the imbalance leave a tone of the spindle. It is added as energy, as in
    sizing. The background is left out, since its octaves are not known.
    """
    case = design.case
    held = [(handle.name, handle.place) for handle in case.handles] or [("wheel plane", case.body.wheel)]
    return tuple(moved_at(design, at_race, name, place) for name, place in held)


def moved_at(design: Design, at_race: PlaceLevels, name: str, place: float) -> PlaceLevels:
    """Levels at one place [m] from the centre of mass, computed like `held_levels`."""
    case, added = design.case, design.autobalancer.mass
    body, race = case.body, case.race_place
    imbalance, balls = design.imbalance.value, design.imbalance.value * design.autobalancer.requirement.plane_ratio
    moved = carried(at_race, name, abs(body.inertance(place, race, added)) / body.inertance(race, race, added))
    rest = imbalance * body.inertance(place, body.wheel, added) - balls * body.inertance(place, race, added)
    tone = abs(rest) * case.speed / math.sqrt(2)
    return with_tone(moved, tone, abs(hand_arm_response(1j * case.speed)), case.speed) if tone else moved
