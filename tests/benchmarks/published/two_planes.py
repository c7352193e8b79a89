"""Two races on a rigid rotor in anisotropic bearings: the equations of a public program, integrated by SciPy.

The public MATLAB program `tpsolvena` (non-dimensional, "see paper") gives all parameters, starts and the measure of
vibration, and no results. These are the equations that it states, written anew and solved by another integrator;
`python -m tests.benchmarks.published.two_planes` writes the results to `two_planes.json`.
"""

import json
import math
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]

RECORD: Final = Path(__file__).with_name("two_planes.json")
TRANSVERSE, POLAR, ECCENTRICITY, LEAN, PHASE = 3.25, 0.5, 5e-5, 5e-5, 1.0
BALL, DRAG, PLANES = 1e-4, 0.01, np.array((2.0, 2.0, -2.0, -2.0))
STIFFNESS = np.array((1.0, 5.0, 45.0, 9.0))
"""Along x, along y, about x, about y; the damping is a fiftieth of it."""

STARTS = np.array((1.0, -1.0, 1.0, -1.0)) * math.pi / 2
SPEEDS: Final = (0.5, 1.5, 2.5, 4.0, 6.0, 8.0)
WINDOWS: Final = tuple((float(low), float(low + 100)) for low in range(0, 800, 100))
SAMPLES: Final = 16_001


def rhs(t: float, state: Any, speed: float) -> Array:
    """q = (x, y, φ_x, φ_y, ball angles): mass matrix and forces of the program."""
    place, angles, velocity, rates = state[:4], state[4:8], state[8:12], state[12:]
    sine, cosine, swing = np.sin(speed * t + angles), np.cos(speed * t + angles), (speed + rates) ** 2
    A, b = np.zeros((8, 8)), np.zeros(8)
    moment, second = BALL * PLANES.sum(), BALL * (PLANES**2).sum()
    A[0, 0] = A[1, 1] = 1 + 4 * BALL
    A[2, 2] = A[3, 3] = TRANSVERSE + second
    A[0, 3] = A[3, 0] = moment
    A[1, 2] = A[2, 1] = -moment
    # A ball's place: x + z φ_y + cos γ, y − z φ_x + sin γ.
    A[0, 4:], A[1, 4:] = -BALL * sine, BALL * cosine
    A[2, 4:], A[3, 4:] = -BALL * PLANES * cosine, -BALL * PLANES * sine
    A[4:, 0], A[4:, 1], A[4:, 2], A[4:, 3] = -sine, cosine, -PLANES * cosine, -PLANES * sine
    A[range(4, 8), range(4, 8)] = 1.0
    turn = speed * t
    couple = speed**2 * LEAN * (TRANSVERSE - POLAR)
    b[:4] = -STIFFNESS * (place + velocity / 50)
    b[0] += speed**2 * ECCENTRICITY * math.cos(turn + PHASE) + BALL * (swing * cosine).sum()
    b[1] += speed**2 * ECCENTRICITY * math.sin(turn + PHASE) + BALL * (swing * sine).sum()
    b[2] += -speed * POLAR * velocity[3] - couple * math.sin(turn) - BALL * (PLANES * swing * sine).sum()
    b[3] += speed * POLAR * velocity[2] + couple * math.cos(turn) + BALL * (PLANES * swing * cosine).sum()
    b[4:] = -DRAG * rates
    return np.concatenate([velocity, rates, np.linalg.solve(A, b)])


def vibration(x: Array, y: Array, tilt_x: Array, tilt_y: Array) -> Array:
    """Mean displacement at one unit to either side of the middle."""
    return np.asarray((np.hypot(x + tilt_y, y - tilt_x) + np.hypot(x - tilt_y, y + tilt_x)) / 2)


def largest(speed: float) -> list[float]:
    """Largest vibration in each window."""
    times = np.linspace(0.0, 800.0, SAMPLES)
    start = np.concatenate([np.zeros(4), STARTS, np.zeros(8)])
    run = solve_ivp(rhs, (0.0, 800.0), start, "DOP853", times, args=(speed,), rtol=1e-9, atol=1e-13)
    levels = vibration(*run.y[:4])
    return [float(levels[(times >= low) & (times <= high)].max()) for low, high in WINDOWS]


if __name__ == "__main__":
    rows = {str(speed): [float(f"{level:.6g}") for level in largest(speed)] for speed in SPEEDS}
    RECORD.write_text(json.dumps({"windows": WINDOWS, "largest": rows}, indent=1) + "\n", encoding="utf-8")
