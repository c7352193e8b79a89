"""Results of a simulation of a machine at its workpiece.

They are phasors of axis and contact force, and the normal force.
"""

import math
from dataclasses import replace

import numpy as np

from abu_calc.analysis.course import axis_place, total_imbalance
from abu_calc.analysis.idle import WORK
from abu_calc.analysis.ledger import chosen
from abu_calc.analysis.response import SAMPLES_PER_REVOLUTION, amplitude_window
from abu_calc.analysis.simulate import Simulation, simulate
from abu_calc.dynamics.effects.grinding_contact import GrindingContact
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Array, Samples
from abu_calc.frozen import dataclass
from abu_calc.progress import Progress, silent

TURNS = 20
"""Turns at the end of a run over which forces are examined."""


@dataclass(frozen=True)
class Working:
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
    velocity: float
    duration: float
    ball_angles: tuple[float, ...]
    path: Array
    settled: bool
    parts: bool
    error: float
    warnings: tuple[str, ...]
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
    return replace(scene, effects=tuple(each for each in scene.effects if isinstance(each, GrindingContact)))


def working(scene: Scene, accuracy: float, progress: Progress = silent, work: int = WORK) -> Working:
    """Simulate a scene of grinding and read the last turns.

    Raises NotTrustworthyError where no run reaches the accuracy within so much work, as a rule that of `abu size`.
    """
    ledger = chosen(scene, accuracy)
    return seen(simulate(ledger.scene, accuracy - ledger.spared, (), work, progress=progress))


@dataclass(frozen=True)
class Seen:
    """Results of a run besides its states: rms velocity [m/s], ball angles at the end [rad], quality."""

    velocity: float
    ball_angles: tuple[float, ...]
    settled: bool
    error: float
    warnings: tuple[str, ...]


def seen(run: Simulation) -> Working:
    """Results of the last turns of a simulated grinding scene."""
    window, response = amplitude_window(run.scene), run.response
    times = window.times[-1 - min(window.whole, TURNS * SAMPLES_PER_REVOLUTION) :]
    settled = response.settling_time is not None
    summary = Seen(response.velocity_rms, response.ball_angles, settled, run.error_estimate, run.warnings)
    return read(run.scene, times, run.trajectory.at(times), summary)


def read(scene: Scene, times: Array, states: Array, summary: Seen) -> Working:
    """Results from the states at equal steps over whole turns, both ends given."""
    place, count = axis_place(scene, states), 2 * len(scene.support.names)
    whole = place[:, :-1]
    away = np.abs(whole - whole.mean(axis=1, keepdims=True)).max(axis=1)
    balls = states[count : count + len(scene.ball_masses)]
    force = _forces(scene, times, states)
    return Working(
        axis=(_phasor(scene, place[0], times), _phasor(scene, place[1], times)),
        x=float(away[0]),
        y=float(away[1]),
        reaction=_phasor(scene, force, times) if len(force) else 0j,
        imbalance=complex(total_imbalance(scene, balls)[:-1].mean()),
        force=force[:-1],
        profile=_profile(scene, times, force) if len(force) else (),
        velocity=summary.velocity,
        duration=scene.duration,
        ball_angles=summary.ball_angles,
        path=place[:, -1 - SAMPLES_PER_REVOLUTION :] - whole.mean(axis=1, keepdims=True),
        settled=summary.settled,
        parts=bool(len(force)) and float(force.min()) <= 0,
        error=summary.error,
        warnings=summary.warnings,
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


def _forces(scene: Scene, times: Array, states: Array) -> Array:
    """N [N] at the rated speed, none where nothing presses in the plane."""
    contact = next((each for each in scene.effects if isinstance(each, GrindingContact)), None)
    if contact is None or contact.contact == "face":
        return np.empty(0)
    if contact.contact == "rigid":
        return contact.normal_forces(assemble(scene), Samples(times, states))
    gap = axis_place(scene, states)[1] + contact.runout * np.sin(scene.speed * times + contact.runout_angle)
    return np.asarray(np.maximum(contact.press_force - contact.contact_stiffness * gap, 0.0), dtype=float)


def harmonic_force(mean: float, pressure: complex, steps: int = 720) -> Array:
    """The force round the wheel [N] by steady contact, none where it would pull."""
    turn = np.arange(steps) * (2 * math.pi / steps)
    return np.asarray(np.maximum(mean + (pressure * np.exp(-1j * turn)).real, 0.0), dtype=float)
