"""The averaged equations of the balls of a scene: their coefficients, and where they hold.

Source: Kladiev 1996, (4)–(7), generalised; Blekhman 1988, ch. 2 (vibrational moments). The terms of the next order are
derived here.
"""

from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.support import SmallMotion
from abu_calc.frozen import dataclass

Complex = NDArray[np.complex128]
Array = NDArray[np.float64]

SLOW: Final = 0.3
"""Largest rate of the balls, relative to the distance of the speed from natural frequencies, that counts as slow."""

TURNED: Final = np.array((1, -1j))
"""Forces (cos, sin)(Ωt + φ) are Re{(1, −i) e^{i(Ωt + φ)}}."""


@dataclass(frozen=True)
class Averages:
    """Quantities of a scene that the averaged equations need; `race` of each ball."""

    masses: Array
    static_moments: Array
    radii: Array
    drags: Array
    factors: Array
    race: NDArray[np.intp]
    forward: Complex
    """h⁺ [m/N], races × sources: whirl of a race by a force that turns with the rotor; rotor, couple, races."""
    slope: Complex
    """dh⁺/dν, likewise."""
    own: Complex
    """m₀e e^{iφ}, the couple likewise, and what the races' offset adds to each race, m Δ e^{iφ}."""
    offset: complex
    speed: float
    kick: Array
    """Change of the balls' mean speeds by the support's free motion and gravity [rad/s].

    Both act from the start on.
    """
    free: Array
    """(q, q') of that motion at t = 0: the start less the steady whirl."""

    def whirl(self, theta: Array) -> Complex:
        """w_i of each race [m] for ball angles [ball], the balls being at rest."""
        sources = self.own.copy()
        np.add.at(sources, 2 + self.race, self.static_moments * np.exp(1j * theta))
        return np.asarray(self.speed**2 * self.forward @ sources, dtype=complex)


@lru_cache(maxsize=8)
def averages(scene: Scene) -> Averages:
    """The averaged equations of a scene; its effects other than an offset of the races are taken to average out."""
    balls, support = scene.balls, scene.small_motion
    offset = sum((effect.offset for effect in scene.effects), 0j)
    falling = sum(effect.falling for effect in scene.effects) / scene.speed
    own = [scene.imbalance * np.exp(1j * scene.imbalance_angle), scene.couple * np.exp(1j * scene.couple_angle)]
    own += [sum(race.ball_masses) * offset for race in scene.races]
    forward, slope = (_between(scene, support.frame @ moved) for moved in support.answer(scene.speed))
    free = _free_motion(scene, support, np.array(own), balls.race)
    # Gravity −g cos(Ωt + θ) along the race swings the balls, and from rest it gives their mean g sin θ/Ω.
    kick = _kick(scene, support, free, balls.race) + falling * np.sin(scene.start_angles)
    return Averages(
        masses=balls.masses,
        static_moments=balls.static_moments,
        radii=balls.radii,
        drags=balls.drags,
        factors=balls.factors,
        race=balls.race,
        forward=forward,
        slope=slope,
        own=np.array(own),
        offset=offset,
        speed=scene.speed,
        kick=kick / balls.radii / balls.factors,
        free=free,
    )


def _between(scene: Scene, h: Complex) -> Complex:
    """The forward part ½(h_xx + h_yy + i(h_yx − h_xy)) between the races and the sources."""
    pairs = len(h) // 2
    xx, xy, yx, yy = h[::2, ::2], h[::2, 1::2], h[1::2, ::2], h[1::2, 1::2]
    blocks = (xx + yy + 1j * (yx - xy)) / 2
    places = np.array([(1.0, race.plane_offset)[:pairs] for race in scene.races])
    sources = np.concatenate([np.eye(2)[:, :pairs], places])
    return np.asarray(places @ blocks @ sources.T, dtype=complex)


def _free_motion(scene: Scene, support: SmallMotion, own: Complex, race: NDArray[np.intp]) -> Array:
    """(q, q') of the support's start less its steady whirl under the imbalances as they are at the start."""
    sums = own.copy()
    np.add.at(sums, 2 + race, np.array(scene.static_moments) * np.exp(1j * np.array(scene.start_angles)))
    places = np.array([scene_race.plane_offset for scene_race in scene.races])
    planes = sums[:2] + np.array((sums[2:].sum(), places @ sums[2:]))
    forces = np.outer(planes, TURNED).ravel()[: len(support.frame)]
    steady = scene.speed**2 * support.answer(scene.speed)[0] @ forces
    start = np.concatenate([scene.start_position, scene.start_velocity])
    return np.asarray(start - np.concatenate([steady, 1j * scene.speed * steady]).real, dtype=float)


def dying(support: SmallMotion, free: Array, times: Array) -> tuple[Complex, Complex]:
    """V [2N, mode] and c e^{λt} [mode, time] of the free motion (q, q') = V c e^{λt} from `free` at t = 0."""
    values, V = np.linalg.eig(support.motion)
    return V, np.linalg.solve(V, free.astype(complex))[:, None] * np.exp(np.outer(values, times))


def _kick(scene: Scene, support: SmallMotion, free: Array, race: NDArray[np.intp]) -> Array:
    """−Im(e^{−iθ} ∫ a e^{−iΩt} dt) for each ball [m/s], a the acceleration of its race in the support's free motion.

    Seen from the rotor that motion goes round fast, so all it leaves on the balls, to leading order, is another speed.
    """
    A = support.motion
    total = A @ A @ np.linalg.solve(1j * scene.speed * np.eye(len(A)) - A, free)
    moved = support.frame @ total[: len(support.mass)]
    whirl = moved[::2] + 1j * moved[1::2]
    each = np.array([whirl @ np.array((1.0, scene_race.plane_offset))[: len(whirl)] for scene_race in scene.races])
    return np.asarray(-(each[race] * np.exp(-1j * np.array(scene.start_angles))).imag, dtype=float)
