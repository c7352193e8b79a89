"""Places where balls come to rest in the slow motion with dry rolling friction, from many random starts.

    J θ_k'' + h₀ θ_k' = (Ω²/R_p) [Im(c e^{−iθ_k}) + f_k],    |f_k| ≤ b,    f_k = −b sgn θ_k' while ball k rolls
    c = T − g m R_p Σ e^{iθ_k},    b = k_r R_p/r

c is the displacement of the race's centre that the balls feel, T the displacement without balls (imbalance and race
eccentricity), g the forward displacement per imbalance at the race. Friction is set-valued: a ball at rest stays at
rest while |Im(c e^{−iθ})| ≤ b. Balls are points: equal balls that collide elastically exchange their places.

The step is that of Moreau (1988): places at half a step, then speeds with the friction that stops a ball or opposes it.
Balls that have all stopped stay where they are for ever, so each run has an end.

Range: constant speed, speed well above the natural frequencies, balls light against the machine; without gravity.
Source: derived by averaging; Kladiev 1996, (4)–(7), generalised.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.validity import Range

Complex = NDArray[np.complex128]

SEED: Final = 28927
"""Seed of the random starts, so that a result is the same whenever it is computed."""
STEP: Final = 0.15
"""Step of time, in units of the shortest time of the slow motion; half of it changes means by less than 0.1 %."""
MOST_STEPS: Final = 20_000
"""Steps after which balls that still move are taken where they are."""
STILL: Final = 1e-9
"""Speed, in units of the fastest rate, of balls that have stopped: some creep toward the limit of friction for ever."""
LOOK: Final = 25
"""Steps between two looks for runs that have ended."""
_BAND: Final = Range("friction band", 0.0, unit="m", open_low=True)


@dataclass(frozen=True)
class SlowBalls:
    """Equal balls of one race [SI]: how many, m·R_p of one, pitch radius, viscous drag rate, inertia factor J.

    `band`: b = k_r·R_p/r [m]; `receptance`: g, displacement of the race per imbalance [m/(kg m)]; `speed`: Ω [rad/s].
    """

    count: int
    moment: float
    pitch_radius: float
    drag: float
    inertia_factor: float
    band: float
    receptance: complex
    speed: float

    @property
    def fastest_rate(self) -> float:
        """Largest rate of the slow motion [rad/s]: √(n·κ/J), all balls in line."""
        stiffness = self.speed**2 / self.pitch_radius * abs(self.receptance) * self.moment * self.count
        return math.sqrt(stiffness / self.inertia_factor)


@dataclass(frozen=True)
class RestingPlaces:
    """Displacement c [m] of the race's centre that friction leaves in each run; `moving`: runs without an end.

    `angles`: of the balls at the end [rad], balls × runs; none if there is no friction to hold them.
    """

    displacements: Complex
    moving: int
    angles: NDArray[np.float64]


def resting_places(balls: SlowBalls, undisturbed: Complex, seed: int = SEED) -> RestingPlaces:
    """The end of a run for each displacement T [m], from balls at rest in the race at random places.

    Without friction the ends are known: c = 0 where the balls can balance T.

    >>> balls = SlowBalls(4, 4.084e-3 * 26e-3, 26e-3, 15.0, 1.4, 10.4e-6, 1 / 2.038, 607.4)
    >>> ends = resting_places(balls, np.full(200, 30e-6 + 0j))
    >>> ends.moving, bool(np.sqrt((abs(ends.displacements) ** 2).mean()) < 3 * balls.band)
    (0, True)
    """
    band, runs = _BAND.check(balls.band), len(undisturbed)
    random = np.random.default_rng(seed)
    angles = random.uniform(-math.pi, math.pi, (balls.count, runs))
    speeds, ends, places = np.zeros_like(angles), np.zeros(runs, dtype=complex), np.zeros_like(angles)
    open_runs, target = np.arange(runs), np.asarray(undisturbed, dtype=complex)
    rate = balls.fastest_rate
    step = STEP * max(1 / rate, balls.drag / (balls.inertia_factor * rate**2))  # heavily damped balls creep
    pull = step * balls.speed**2 / (balls.pitch_radius * balls.inertia_factor)
    kept = 1 / (1 + step * balls.drag / balls.inertia_factor)
    weight = complex(balls.receptance * balls.moment)
    for number in range(1, MOST_STEPS + 1):
        angles += step / 2 * speeds
        cosines, sines = np.cos(angles), np.sin(angles)
        real = target.real - weight.real * cosines.sum(axis=0) + weight.imag * sines.sum(axis=0)
        imaginary = target.imag - weight.real * sines.sum(axis=0) - weight.imag * cosines.sum(axis=0)
        pushed = speeds + pull * (imaginary * cosines - real * sines)
        now = kept * (pushed - np.clip(pushed, -pull * band, pull * band))
        stopped = None
        if number % LOOK == 0:
            stopped = np.maximum(np.abs(now), np.abs(speeds)).max(axis=0) < STILL * rate
        speeds = now
        angles += step / 2 * speeds
        if stopped is not None and stopped.any():
            ends[open_runs[stopped]] = real[stopped] + 1j * imaginary[stopped]
            places[:, open_runs[stopped]] = angles[:, stopped]
            going = ~stopped
            open_runs, target = open_runs[going], target[going]
            angles, speeds = angles[:, going], speeds[:, going]
            if not len(open_runs):
                break
    ends[open_runs], places[:, open_runs] = target - weight * np.exp(1j * angles).sum(axis=0), angles
    return RestingPlaces(ends, len(open_runs), places)
