"""Scenes the hard cases share, and the judges that hold a run to what must hold."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from abu_calc.dynamics.effect import Effect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators.choice import available, integrate_with
from abu_calc.dynamics.integrators.run import MOST_EVALUATIONS
from abu_calc.dynamics.scene import Race, Scene, with_parted_balls
from abu_calc.dynamics.support import Support
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.switching.modes import at_break, settled
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.simulation.model_level import difference
from abu_calc.simulation.response import evaluate, needed_times
from abu_calc.simulation.simulate import Simulation, simulate
from tests.dynamics.energy import Bodies, energy, power

RPM = math.pi / 30
CLAIM = 3.0
"""A run may be wrong by so many times the error it claims."""

ROUNDING = 1e-6
"""A claim below this is met by anything as near: what it is compared with has an error of its own."""


def machine(
    speed: float,
    angles: Sequence[float],
    duration: float,
    *effects: Effect,
    mass: float = 5.0,
    frequencies: tuple[float, float] = (80.0, 80.0),
    damping_ratio: float = 0.1,
    imbalance: float = 200e-6,
    ball_mass: float = 0.0167,
    drag: float = 20.0,
    pitch_radius: float = 0.024,
    inertia_factor: float = 1.4,
    start_speeds: Sequence[float] | None = None,
) -> Scene:
    """A hand grinder of 5 kg without its balls, whose natural frequencies [rad/s] are those of this mass."""
    stiffness = mass * frequencies[0] ** 2, mass * frequencies[1] ** 2
    damping = 2 * damping_ratio * mass * frequencies[0], 2 * damping_ratio * mass * frequencies[1]
    speeds = tuple(start_speeds) if start_speeds else (0.0,) * len(angles)
    race = Race(pitch_radius, (ball_mass,) * len(angles), drag, inertia_factor, tuple(angles), speeds)
    return scene_of(planar(mass, stiffness, damping), speed, imbalance, (race,), duration, *effects)


def scene_of(
    support: Support, speed: float, imbalance: float, races: tuple[Race, ...], duration: float, *effects: Effect
) -> Scene:
    """From rest at the middle, the imbalance at the zero mark."""
    rest = (0.0,) * len(support.names)
    return Scene("hard", support, speed, imbalance, 0.0, races, duration, rest, rest, effects=tuple(effects))


def run(
    scene: Scene, times: Sequence[float] | np.ndarray, way: str = "scipy-dop853", tolerance: float = 1e-9
) -> Trajectory:
    """By one integrator."""
    return integrate_with(way, assemble(scene), tolerance, np.asarray(times, dtype=float), MOST_EVALUATIONS)


def apart(equations: Equations, one: np.ndarray, other: np.ndarray) -> float:
    """The largest difference of two runs' states, in the scales of the states."""
    return float((np.abs(one - other) / np.array(equations.scales)[:, None]).max())


def second_way(equations: Equations) -> tuple[str, float]:
    """An integrator of another kind than DOP853, tight: the loop's of order 5 where compiled, else Radau."""
    return ("compiled-rk45", 1e-11) if "compiled-rk45" in available(equations) else ("scipy-radau", 1e-9)


def check_agreement(scene: Scene, within: float, samples: int = 41) -> Trajectory:
    """Integrators of two kinds, and two tolerances, go the same way; returns the motion by the second kind."""
    equations, times = assemble(scene), np.linspace(0, scene.duration, samples)
    other, tight = second_way(equations)
    reference = run(scene, times, other, tight)
    for tolerance in (1e-8, 1e-10):
        assert apart(equations, run(scene, times, tolerance=tolerance).y, reference.y) < within
    return reference


def check_claim(scene: Scene, accuracy: float = 0.01, claim: float = CLAIM) -> Simulation:
    """A result is as near to an independent, tight run as was asked for, and as it claims but for a factor of three."""
    simulation = simulate(scene, accuracy, integrator="scipy")
    parted, _ = with_parted_balls(scene)
    other, tight = second_way(assemble(parted))
    exact = evaluate(parted, run(parted, needed_times(parted), other, tight))
    assert simulation.error_estimate <= accuracy
    wrong = difference(parted, simulation.response, exact)
    assert wrong <= accuracy
    assert wrong <= claim * max(simulation.error_estimate, ROUNDING)
    return simulation


def check_energy(scene: Scene, begin: float, end: float, within: float, samples: int = 161) -> None:
    """Between two moments the energy changes by the work done, the drive's included.

    By Simpson's rule over an odd number of samples; relative to all work that goes in and out.
    """
    equations, stored, rates = assemble(scene), [], []
    times = np.linspace(begin, end, samples)
    for t, y in zip(times, run(scene, times, tolerance=1e-10).y.T, strict=True):
        state, modes = settled(equations, t, y, at_break(equations, t, equations.first_modes))
        stored.append(float(energy(scene, t, state, modes)))
        rates.append(power(scene, t, state, modes))
    E, P, step = np.array(stored), np.array(rates), times[1] - times[0]
    work = np.concatenate([[0.0], np.cumsum(step / 3 * (P[:-2:2] + 4 * P[1:-1:2] + P[2::2]))])
    moved = step * np.abs(P).sum()
    assert moved > 0
    assert np.abs(E[::2] - E[0] - work).max() <= within * moved


def jacobi(scene: Scene, trajectory: Trajectory) -> np.ndarray:
    """E − Ω L of all samples: constant where nothing is damped and the support is isotropic, seen from the rotor."""
    bodies, found = Bodies(scene), []
    for t, y in zip(trajectory.t, trajectory.y.T, strict=True):
        x, v = bodies.split(t, y)
        momenta = bodies.mass(x) @ v
        turning = momenta[-1] + x[0] * momenta[1] - x[1] * momenta[0]
        found.append(float(energy(scene, t, y)) - scene.speed * turning)
    return np.array(found)


def resultant(scene: Scene, angles: np.ndarray) -> complex:
    """Imbalance of rotor and balls [kg m]."""
    own = scene.imbalance * np.exp(1j * scene.imbalance_angle)
    return complex(own + np.array(scene.static_moments) @ np.exp(1j * angles))


def balls_at_end(scene: Scene, trajectory: Trajectory) -> np.ndarray:
    """Angles of the balls at the last sample."""
    first = 2 * len(scene.support.names)
    return trajectory.y[first : first + len(scene.ball_masses), -1]


def standing(scene: Scene) -> Scene:
    """The scene started with its balls at rest in space while the rotor turns at full speed."""
    races = tuple(replace(race, start_speeds=(-scene.speed,) * len(race.ball_masses)) for race in scene.races)
    return replace(scene, races=races)
