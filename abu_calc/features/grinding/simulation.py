"""Simulation of a machine at its workpiece: displacement, contact force and normal force of the last turns.

Displacements and forces are phasors. `bouncing` gives statistics of long runs of a wheel that bounces without
repeating. If errors grow without end, no run can be computed twice alike, nor does it happen twice on the shop floor.
The mean stays the same from run to run; the scatter of the runs shows how well it is known.
"""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.choice import choose
from abu_calc.dynamics.scene import Scene, with_parted_balls
from abu_calc.dynamics.trajectory import Array, Samples, Sampling
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.progress import Progress, silent
from abu_calc.foundation.units import level_from_velocity
from abu_calc.simulation.design_scenes import WORK
from abu_calc.simulation.response import (
    SAMPLES_PER_REVOLUTION,
    amplitude_window,
)
from abu_calc.simulation.simulate import Simulation
from abu_calc.simulation.subject import chosen, simulate_chosen

TURNS = 20
"""Turns at the end of a run over which forces are examined."""


@dataclass(frozen=True)
class WorkSimulation:
    """The end of a run: phasors X, Y [m] and N_c [N] once per turn, mean imbalance U [kg m] of rotor and balls.

    `x`, `y`: largest distance of the axis from its mean place along each axis [m]; `force`: of wheel and work [N] at
    equal steps over whole turns, none where nothing presses in the plane; `profile`: point of the wheel [rad from the
    imbalance] and mean force there [N]; `velocity` rms [m/s], the larger of both axes; `duration` [s] of the whole run;
    `ball_angles` [rad] in the rotor; `path`: the axis from its mean place over the last turn, x and y [m]. `scatter`
    [dB] of a level that is a mean of chaotic runs. `parts`: whether wheel and work part, or a rigid contact pulls.
    """

    axis: tuple[complex, complex]
    x: float
    y: float
    reaction: complex
    imbalance: complex
    force: Array
    profile: tuple[tuple[float, float], ...]
    duration: float
    path: Array
    parts: bool
    velocity: float = 0.0
    ball_angles: tuple[float, ...] = ()
    warnings: tuple[str, ...] = ()
    scatter: float = 0.0

    @property
    def pressure(self) -> complex:
        """H = −i·N_c [N]."""
        return -1j * self.reaction

    @property
    def apart(self) -> float:
        """Share of the time in which wheel and work are apart."""
        return float(np.mean(self.force <= 0)) if len(self.force) else 0.0


def only_contact(scene: Scene) -> Scene:
    """The same scene with nothing but wheel, work and balls of ideal race: what steady contact speaks of."""
    return replace(scene, effects=tuple(each for each in scene.effects if isinstance(each, GrindingContactEffect)))


def working(scene: Scene, accuracy: float, progress: Progress = silent, work: int = WORK) -> WorkSimulation:
    """Simulate a scene of grinding and read the last turns.

    Raises NotTrustworthyError where no run reaches the accuracy within so much work, as a rule that of `abu size`.
    """
    return seen(simulate_chosen(chosen(scene, accuracy), accuracy, (), work, progress=progress)[1])


def seen(run: Simulation) -> WorkSimulation:
    """Results of the last turns of a simulated grinding scene."""
    window, response = amplitude_window(run.scene), run.response
    times = window.times[-1 - min(window.whole, TURNS * SAMPLES_PER_REVOLUTION) :]
    motion = read(run.scene, times, run.trajectory.at(times))
    return replace(motion, velocity=response.velocity_rms, ball_angles=response.ball_angles, warnings=run.warnings)


def read(scene: Scene, times: Array, states: Array) -> WorkSimulation:
    """The motion by its states at equal steps over whole turns, both ends given."""
    place, count = scene.axis_place(states), 2 * len(scene.support.names)
    whole = place[:, :-1]
    away = np.abs(whole - whole.mean(axis=1, keepdims=True)).max(axis=1)
    balls = states[count : count + len(scene.ball_masses)]
    force = contact_forces(scene, times, states)
    return WorkSimulation(
        axis=(_phasor(scene, place[0], times), _phasor(scene, place[1], times)),
        x=float(away[0]),
        y=float(away[1]),
        reaction=_phasor(scene, force, times) if len(force) else 0j,
        imbalance=complex(scene.total_imbalance(balls)[:-1].mean()),
        force=force[:-1],
        profile=_profile(scene, times, force) if len(force) else (),
        duration=scene.duration,
        path=place[:, -1 - SAMPLES_PER_REVOLUTION :] - whole.mean(axis=1, keepdims=True),
        parts=bool(len(force)) and float(force.min()) <= 0,
    )


def _phasor(scene: Scene, values: Array, times: Array) -> complex:
    """C of Re{C e^{iΩt}} over whole turns, both ends given."""
    turned = values * np.exp(-1j * scene.speed * times)
    return complex(2 * turned[:-1].mean())


def _profile(scene: Scene, times: Array, force: Array) -> tuple[tuple[float, float], ...]:
    """The point ψ = −π/2 − Ωt of the wheel is at the work at the time t; mean force there over all turns."""
    mean = force[:-1].reshape(-1, SAMPLES_PER_REVOLUTION).mean(axis=0)
    points = -math.pi / 2 - scene.speed * times[:SAMPLES_PER_REVOLUTION]
    return tuple(sorted((math.remainder(point, 2 * math.pi), value) for point, value in zip(points.tolist(),
                        mean.tolist(), strict=True)))  # fmt: skip


def contact_forces(scene: Scene, times: Array, states: Array) -> Array:
    """Force of wheel and workpiece N [N] at the rated speed; none where nothing presses in the plane."""
    contact = next((each for each in scene.effects if isinstance(each, GrindingContactEffect)), None)
    if contact is None or contact.contact == "face":
        return np.empty(0)
    if contact.contact == "rigid":
        return contact.normal_forces(assemble(scene), Samples(times, states))
    moved = scene.axis_place(states, contact.plane_offset)[1]
    gap = moved + contact.runout * np.sin(scene.speed * times + contact.runout_angle)
    return np.asarray(np.maximum(contact.press_force - contact.contact_stiffness * gap, 0.0), dtype=float)


def harmonic_force(mean: float, pressure: complex, steps: int = 720) -> Array:
    """The force round the wheel [N] by steady contact, none where it would pull."""
    turn = np.arange(steps) * (2 * math.pi / steps)
    return np.asarray(np.maximum(mean + (pressure * np.exp(-1j * turn)).real, 0.0), dtype=float)


COPIES: Final = 4
"""Starts, each with balls and axis a little further than the one before."""
FURTHER: Final = 1e-3, 1e-6
"""Balls [rad] and axis [m]: chaos makes another run of less."""
SECONDS: Final = 6.0
WINDOW_TURNS: Final = 30
"""Least length of a run, in seconds and in turns.

A rotor so slow that the turns take longer is followed for longer, as far as the allowed work permits.
"""
DROPPED: Final = 1 / 3
"""Share of a run that is dropped, since the balls find their places in it."""
TOLERANCES: Final = 2e-6, 2e-5
"""Tolerances, used in turn: results that depend on the tolerance show as scatter."""
LEAST: Final = 0.5
"""Scatter [dB] that four runs do not rule out by being alike."""
WIDEST: Final = 3.0
"""Scatter [dB] beyond which there is no level to be told."""


def bounces(scene: Scene) -> bool:
    """True if wheel and workpiece may bounce in the scene."""
    return any(isinstance(effect, GrindingContactEffect) and effect.contact == "compliant" for effect in scene.effects)


def bouncing(scene: Scene, accuracy: float, progress: Progress = silent) -> WorkSimulation:
    """Mean motion of a chaotic scene of grinding, by four runs of 6 s; velocities averaged in energy.

    `scatter`: twice the standard deviation of their levels, at least what the farthest is off, and 0.5 dB. Phasors are
    those of the first run; forces those of all. Raises NotTrustworthyError where runs are further apart than 3 dB, so
    that starts decide, or take more work than one scene may.
    """
    scene = chosen(scene, accuracy).scene
    runs = []
    for number, copy in enumerate(_copies(scene)):
        progress(f"{scene.name}: chaotic, run {number + 1} of {COPIES}")
        runs.append(_run(copy, TOLERANCES[number % len(TOLERANCES)]))
    velocity = math.sqrt(sum(run.velocity**2 for run in runs) / COPIES)
    levels = [level_from_velocity(run.velocity) for run in runs]
    farthest = max(abs(each - level_from_velocity(velocity)) for each in levels)
    scatter = max(2 * float(np.std(levels, ddof=1)), farthest, LEAST)
    if scatter > WIDEST:
        raise NotTrustworthyError(
            f"{scene.name}: chaotic, and its level hangs on the start: {min(levels):.1f} to {max(levels):.1f} dB in "
            f"{COPIES} runs"
        )
    warning = (
        f"wheel and work bounce without ever repeating (chaotic): levels are means of {COPIES} runs of {SECONDS:g} s"
    )
    force = np.concatenate([run.force for run in runs])
    return replace(runs[0], velocity=velocity, force=force, parts=bool(force.min() <= 0), scatter=scatter,
                   warnings=(warning,))  # fmt: skip


def _copies(scene: Scene) -> Iterator[Scene]:
    """The same scene for whole turns, started a little further each."""
    whole = max(round(SECONDS / scene.revolution), WINDOW_TURNS) * scene.revolution
    ahead, aside = FURTHER
    for number in range(COPIES):
        races = tuple(
            replace(race, start_angles=tuple(angle + number * ahead for angle in race.start_angles))
            for race in scene.races
        )
        x, *rest = scene.start_position
        copy = replace(scene, duration=whole, races=races, start_position=(x + number * aside, *rest))
        yield with_parted_balls(copy)[0]


def _run(scene: Scene, tolerance: float) -> WorkSimulation:
    equations, times = assemble(scene), _times(scene)
    choice = choose(equations, "auto", tolerance)
    trajectory = choice.integrate(equations, tolerance, Sampling(times), choice.evaluations(WORK))
    states = trajectory.at(times)
    count, balls = 2 * len(scene.support.names), len(scene.ball_masses)
    velocity = float(np.sqrt((scene.axis_velocity(states[:, :-1]) ** 2).mean(axis=1)).max())
    angles = tuple(states[count : count + balls, -1].tolist())
    return replace(read(scene, times, states), velocity=velocity, ball_angles=angles)


def _times(scene: Scene) -> Array:
    """Whole turns up to the end."""
    turns = int((1 - DROPPED) * scene.duration / scene.revolution)
    step = scene.revolution / SAMPLES_PER_REVOLUTION
    return np.asarray(scene.duration - step * np.arange(turns * SAMPLES_PER_REVOLUTION, -1, -1), dtype=float)
