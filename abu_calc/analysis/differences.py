"""Differences between two runs of one scene, measured as accuracy measures errors."""

import math
from collections.abc import Callable
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.receptance import weighing_amplitude


class Measures(Protocol):
    """Compared quantities of a run: of a response, or of an estimate that integrates no equations."""

    @property
    def axis_amplitude(self) -> float:
        """0–peak [m]."""

    @property
    def velocity_rms(self) -> float:
        """RMS velocity in the larger of x and y [m/s]."""

    @property
    def settling_time(self) -> float | None:
        """Settling time, from full speed [s]; None if later than the run."""

    @property
    def ball_angles(self) -> tuple[float, ...]:
        """Ball angles at the end [rad]."""


def difference(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """The largest of the differences in amplitude, settling time and ball angles."""
    return max(measure(scene, coarse, fine) for measure in (amplitude, settling, angles))


def amplitude(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer amplitude, but at least to 1 % of that without balls."""
    apart = abs(coarse.axis_amplitude - fine.axis_amplitude)
    # Nothing at all to drive the axis leaves nothing to compare with.
    return apart / max(fine.axis_amplitude, weighing_amplitude(scene)) if apart > 0 else 0.0


def level(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Difference of the rms velocities, likewise relative: 0.01 is 0.09 dB."""
    apart = abs(coarse.velocity_rms - fine.velocity_rms)
    least = weighing_amplitude(scene) * scene.speed / math.sqrt(2)
    return apart / max(fine.velocity_rms, least) if apart > 0 else 0.0


def settling(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Relative to the finer time, but at least to one revolution; infinite where only one of them has settled."""
    a, b = coarse.settling_time, fine.settling_time
    if a is None or b is None:
        return 0.0 if a is b else math.inf
    return abs(a - b) / max(b, scene.revolution)


def angles(scene: Scene, coarse: Measures, fine: Measures) -> float:
    """Largest difference on the circle [rad]; balls of one mass on one race may have changed places."""
    a, b, worst, first = np.array(coarse.ball_angles), np.array(fine.ball_angles), 0.0, 0
    for race in scene.races:
        masses = np.array(race.ball_masses)
        here = slice(first, first + len(masses))
        for mass in set(race.ball_masses):
            worst = max(worst, _circular_distance(a[here][masses == mass], b[here][masses == mass]))
        first += len(masses)
    return worst


QUANTITIES: Final[dict[str, Callable[[Scene, Measures, Measures], float]]] = {
    "amplitude": amplitude,
    "level": level,
    "settling": settling,
    "angles": angles,
}
"""Quantities for which the error of a computation can be requested."""


def _circular_distance(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
    """Largest distance on the circle between two sets of angles, in the best pairing.

    On a circle the best pairing keeps the order round it, so only the rotations of one order have to be tried.

    >>> round(_circular_distance(np.array([0.1, 3.0]), np.array([3.0, 4 * math.pi - 0.1])), 9)
    0.2
    """
    a, b = np.sort(a % (2 * math.pi)), np.sort(b % (2 * math.pi))
    shifts = (np.angle(np.exp(1j * (a - np.roll(b, k)))) for k in range(len(b)))
    return min(float(np.abs(shift).max()) for shift in shifts)
