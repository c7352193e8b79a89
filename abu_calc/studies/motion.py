"""How a scene moved, at equally spaced times."""

from dataclasses import dataclass, replace
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.course import axis_place
from abu_calc.analysis.simulate import Simulation
from abu_calc.dynamics.scene import Scene
from abu_calc.units import from_si
from abu_calc.validity import Range

SAMPLES: Final = Range("number of samples", 2, 1_000_000, remedy="ask for fewer samples", key="samples")

MOST_NUMBERS: Final = 2**25
"""Samples times states that are held: 256 MB."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Axis and balls over time; ball angles in the rotor, a row for each ball, not wrapped."""

    t_s: NDArray[np.float64]
    x_mm: NDArray[np.float64]
    y_mm: NDArray[np.float64]
    ball_angles_deg: NDArray[np.float64]

    @classmethod
    def of(cls, run: Simulation, times: NDArray[np.float64]) -> Self:
        """That of a run which was sampled at these times."""
        scene, states = run.scene, run.trajectory.at(times)
        size, balls = len(scene.support.names), len(scene.ball_masses)
        x, y = from_si(1.0, "mm") * axis_place(scene, states)
        return cls(times, x, y, from_si(1.0, "deg") * states[2 * size : 2 * size + balls])


def equally_spaced(scene: Scene, samples: int | None) -> NDArray[np.float64]:
    """So many times [s] of a run, both ends included; none where none are asked for."""
    if samples is None:
        return np.empty(0)
    fitting = MOST_NUMBERS // (1000 * scene.state_count) * 1000
    replace(SAMPLES, high=min(SAMPLES.high, fitting)).check(samples)
    return np.linspace(0.0, scene.duration, samples)
