"""Motion of a scene, at equally spaced times."""

from collections.abc import Iterator, Mapping
from dataclasses import field, replace
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from abu_calc.analysis.course import axis_place
from abu_calc.analysis.simulate import Simulation
from abu_calc.dynamics.effect import ACROSS
from abu_calc.dynamics.scene import Scene
from abu_calc.frozen import dataclass
from abu_calc.units import from_si
from abu_calc.validity import Range

Array = NDArray[np.float64]

SAMPLES: Final = Range("number of samples", 2, 1_000_000, remedy="ask for a number in this range", key="samples")

MOST_NUMBERS: Final = 2**25
"""Samples times states that are held: 256 MB."""


@dataclass(frozen=True, eq=False)
class Motion:
    """Axis and balls over time; ball angles in the rotor, a row for each ball, not wrapped.

    `further`: what else of the scene moves, by names with units: tilts, the axis at the bearings, the arm's angle, the
    balls' places along the spindle from the middle of their race, the rotor's speed against what carries it.
    """

    t_s: Array
    x_mm: Array
    y_mm: Array
    ball_angles_deg: Array
    further: Mapping[str, Array] = field(default_factory=dict)

    @classmethod
    def of(cls, run: Simulation, times: NDArray[np.float64]) -> Self:
        """Motion of a run, sampled at these times."""
        scene, states = run.scene, run.trajectory.at(times)
        size, balls = len(scene.support.names), len(scene.ball_masses)
        x, y = from_si(1.0, "mm") * axis_place(scene, states)
        angles = from_si(1.0, "deg") * states[2 * size : 2 * size + balls]
        return cls(times, x, y, angles, dict(_further(scene, times, states)))

    @property
    def columns(self) -> dict[str, Array]:
        """All of it, by names with units."""
        angles = {f"ball{k}_deg": row for k, row in enumerate(self.ball_angles_deg, 1)}
        return {"t_s": self.t_s, "x_mm": self.x_mm, "y_mm": self.y_mm, **angles, **self.further}


def _further(scene: Scene, times: Array, states: Array) -> Iterator[tuple[str, Array]]:
    """Columns of a scene beside axis and balls."""
    support, balls, q = scene.support, len(scene.ball_masses), states[: len(scene.support.names)]
    tilt, turned = support.tilt(q), support.turned(q)
    if tilt is not None:
        about_y, about_minus_x = (1000 * np.asarray(angle) for angle in tilt)
        yield from (("tilt_x_mrad", 0.0 - about_minus_x), ("tilt_y_mrad", about_y))
    for k, place in enumerate(support.bearings, 1):
        x, y = from_si(1.0, "mm") * axis_place(scene, states, place)
        yield from ((f"bearing{k}_x_mm", x), (f"bearing{k}_y_mm", y))
    if turned is not None:
        yield "arm_angle_mrad", 1000 * np.asarray(turned)
    if ACROSS in scene.ball_states:
        first = 2 * (len(q) + balls) + scene.ball_states.index(ACROSS) * balls
        for k in range(balls):
            yield f"ball{k + 1}_axial_mm", from_si(1.0, "mm") * states[first + k]
    if scene.rotor.states:
        yield "rotor_speed_rpm", from_si(1.0, "rpm") * scene.rotor.turning(times, states, scene.speed)[1]


def equally_spaced(scene: Scene, samples: int | None) -> NDArray[np.float64]:
    """Times [s] of a run, equally spaced, both ends included; none if none are asked for."""
    if samples is None:
        return np.empty(0)
    fitting = MOST_NUMBERS // (1000 * scene.state_count) * 1000
    replace(SAMPLES, high=min(SAMPLES.high, fitting)).check(samples)
    return np.linspace(0.0, scene.duration, samples)
