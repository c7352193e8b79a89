"""The averaged equations of the balls of a scene: their coefficients, and where they hold.

Source: Kladiev 1996, (4)–(7), generalised; Blekhman 1988, ch. 2 (vibrational moments). The terms of the next order are
derived here.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.kinds import SwingArm

Complex = NDArray[np.complex128]
Array = NDArray[np.float64]

AVERAGED: Final = frozenset({"gravity", "race_eccentricity"})
"""Effects the averages account for: gravity has none, an offset race is part of the whirl."""

SLOW: Final = 0.3
"""Largest rate of the balls, relative to the distance of the speed from natural frequencies, that counts as slow."""

STILL: Final = 1e-6
"""Rates of motions, as a share of the fastest, that are none, or the same."""

TURNED: Final = np.array((1, -1j))
"""Forces (cos, sin)(Ωt + φ) are Re{(1, −i) e^{i(Ωt + φ)}}."""


@dataclass(frozen=True)
class Loaded:
    """M q'' + C q' + K q = Pᵀ F, with the balls' mass in M and what the speed adds in C."""

    mass: Array
    damping: Array
    stiffness: Array
    frame: Array

    def dynamic(self, speed: float) -> Complex:
        """D = K − ν²M + iνC at the frequency ν [rad/s]."""
        return np.asarray(self.stiffness - speed**2 * self.mass + 1j * speed * self.damping, dtype=complex)

    def answer(self, speed: float) -> tuple[Complex, Complex]:
        """D⁻¹ Pᵀ and its slope over ν: motion of the coordinates by unit forces on the frame [m/N, m s/N]."""
        D = self.dynamic(speed)
        right = np.linalg.solve(D, self.frame.T)
        slope = np.linalg.solve(D, (2 * speed * self.mass - 1j * self.damping) @ right)
        return np.asarray(right, dtype=complex), np.asarray(slope, dtype=complex)

    @property
    def motion(self) -> Array:
        """A of the free motion z' = A z, z = (q, q')."""
        size = len(self.mass)
        lower = -np.linalg.solve(self.mass, np.hstack([self.stiffness, self.damping]))
        return np.vstack([np.eye(size, 2 * size, size), lower])


@dataclass(frozen=True)
class Averages:
    """What the averaged equations need of a scene; `race` of each ball."""

    masses: Array
    moments: Array
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
    """What the support's free motion and gravity, both from the start on, add to the balls' mean speeds [rad/s]."""
    free: Array
    """(q, q') of that motion at t = 0: the start less the steady whirl."""

    def whirl(self, theta: Array) -> Complex:
        """w_i of each race [m] for ball angles [ball], the balls being at rest."""
        sources = self.own.copy()
        np.add.at(sources, 2 + self.race, self.moments * np.exp(1j * theta))
        return np.asarray(self.speed**2 * self.forward @ sources, dtype=complex)


@lru_cache(maxsize=8)
def averages(scene: Scene) -> Averages:
    """The averaged equations of a scene; its effects other than an offset of the races are taken to average out."""
    sizes = [len(race.ball_masses) for race in scene.races]
    race = np.repeat(np.arange(len(sizes)), sizes)
    eccentricity = scene.effect("race_eccentricity")
    offset = 0j
    if isinstance(eccentricity, RaceEccentricity):
        offset = complex(eccentricity.magnitude * np.exp(1j * eccentricity.angle))

    def each(name: str) -> Array:
        return np.repeat(np.array([getattr(one, name) for one in scene.races], dtype=float), sizes)

    support = loaded(scene)
    masses, radii, factors = np.array(scene.ball_masses, dtype=float), each("pitch_radius"), each("inertia_factor")
    own = [scene.imbalance * np.exp(1j * scene.imbalance_angle), scene.couple * np.exp(1j * scene.couple_angle)]
    own += [sum(one.ball_masses) * offset for one in scene.races]
    forward, slope = (_between(scene, support.frame @ moved) for moved in support.answer(scene.speed))
    free = _free_motion(scene, support, np.array(own), race)
    falling = scene.effect("gravity")
    weight = falling.acceleration / scene.speed if isinstance(falling, Gravity) else 0.0
    return Averages(
        masses=masses,
        moments=np.array(scene.ball_moments, dtype=float),
        radii=radii,
        drags=each("drag"),
        factors=factors,
        race=race,
        forward=forward,
        slope=slope,
        own=np.array(own),
        offset=offset,
        speed=scene.speed,
        # Gravity −g cos(Ωt + θ) along the race swings the balls, and from rest it gives their mean g sin θ/Ω.
        kick=(_kick(scene, support, free, race) + weight * np.sin(scene.start_angles)) / radii / factors,
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


def _free_motion(scene: Scene, support: Loaded, own: Complex, race: NDArray[np.intp]) -> Array:
    """(q, q') of the support's start less its steady whirl under the imbalances as they are at the start."""
    sums = own.copy()
    np.add.at(sums, 2 + race, np.array(scene.ball_moments) * np.exp(1j * np.array(scene.start_angles)))
    places = np.array([one.plane_offset for one in scene.races])
    planes = sums[:2] + np.array((sums[2:].sum(), places @ sums[2:]))
    forces = np.outer(planes, TURNED).ravel()[: len(support.frame)]
    steady = scene.speed**2 * support.answer(scene.speed)[0] @ forces
    start = np.concatenate([scene.start_position, scene.start_velocity])
    return np.asarray(start - np.concatenate([steady, 1j * scene.speed * steady]).real, dtype=float)


def dying(support: Loaded, free: Array, moments: Array) -> tuple[Complex, Complex]:
    """V [2N, mode] and c e^{λt} [mode, moment] of the free motion (q, q') = V c e^{λt} from `free` at t = 0."""
    values, V = np.linalg.eig(support.motion)
    return V, np.linalg.solve(V, free.astype(complex))[:, None] * np.exp(np.outer(values, moments))


def swinging(support: Loaded, force: Array, t: float) -> float:
    """The most the axis [m] swings at t about the place to which a force on the frame moves it from t = 0 on."""
    values, V = np.linalg.eig(support.motion)
    push = np.linalg.solve(support.mass, support.frame.T @ force)
    shares = np.linalg.solve(V, np.concatenate([0 * push, push]).astype(complex))
    limit = STILL * np.abs(values).max()
    moving = np.abs(values) > limit  # a coordinate that nothing holds goes away
    values, shares, places = values[moving], shares[moving], V[: len(push), moving]
    left = support.frame[:2] @ places * (shares / values * np.exp(values * t))
    # Motions of one rate are one, however they are told apart.
    alike = np.abs(values[:, None] - values) < limit
    return float((np.abs(left @ alike) / alike.sum(axis=0)).sum())


def _kick(scene: Scene, support: Loaded, free: Array, race: NDArray[np.intp]) -> Array:
    """−Im(e^{−iθ} ∫ a e^{−iΩt} dt) for each ball [m/s], a the acceleration of its race in the support's free motion.

    Seen from the rotor that motion goes round fast, so all it leaves on the balls, to leading order, is another speed.
    """
    A = support.motion
    total = A @ A @ np.linalg.solve(1j * scene.speed * np.eye(len(A)) - A, free)
    moved = support.frame @ total[: len(support.mass)]
    whirl = moved[::2] + 1j * moved[1::2]
    each = np.array([whirl @ np.array((1.0, one.plane_offset))[: len(whirl)] for one in scene.races])
    return np.asarray(-(each[race] * np.exp(-1j * np.array(scene.start_angles))).imag, dtype=float)


@lru_cache(maxsize=8)
def loaded(scene: Scene) -> Loaded:
    """The support with the balls' mass on it."""
    support, masses = scene.support, np.array(scene.ball_masses, dtype=float)
    if isinstance(support, SwingArm):
        square = support.length**2
        return Loaded(
            np.array([[support.inertia + float(masses.sum()) * square]]),
            np.array([[support.damping * square]]),
            np.array([[support.stiffness * square]]),
            np.array([[0.0], [support.length]]),
        )
    P = np.array(support.race_map)
    sizes = [len(race.ball_masses) for race in scene.races]
    z = np.repeat(np.array([race.plane_offset for race in scene.races]), sizes)
    m, mz, mzz = masses.sum(), (masses * z).sum(), (masses * z**2).sum()
    balls = np.kron(np.array(((m, mz), (mz, mzz))), np.eye(2))[: len(P), : len(P)]
    turning = scene.speed * np.array(support.gyroscopic) if support.gyroscopic else 0.0
    return Loaded(
        np.array(support.mass) + P.T @ balls @ P,
        np.array(support.damping) + turning,
        np.array(support.stiffness),
        P,
    )
