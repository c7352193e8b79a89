"""The averaged slow motion of the balls: what is left of the equations when everything that goes round is averaged out.

    J θ_k'' + h₀ θ_k' = (Ω²/R_p) Im(w_i e^{−iθ_k}),    w_i = Ω² Σ_j h⁺_ij U_j + Δ e^{iφ}

w_i is the forward part of the whirl of race i, seen from the rotor; U_j the imbalance of rotor, couple and balls in the
plane j, U of a race Σ m R_p e^{iθ} and m Δ e^{iφ} of its offset; h⁺ = ½(h_xx + h_yy + i(h_yx − h_xy)) the forward
receptance of the support with the balls' mass. It is as slow as the balls, so it costs a small share of the equations.

Range: constant speed, linear supports or a swing arm idling, steady response of the support: the balls' own rate must
be small against the distance of the speed from the natural frequencies, and no effect may switch. Source: Kladiev 1996,
(4)–(7), generalised; Blekhman 1988, ch. 2 (vibrational moments).
"""

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.receptance import receptance
from abu_calc.dynamics.scene import LinearSupport, Scene, SwingArm

Complex = NDArray[np.complex128]
Array = NDArray[np.float64]

AVERAGED: Final = frozenset({"gravity", "race_eccentricity"})
"""Effects the averages account for: gravity has none, an offset race is part of the whirl."""

SLOW: Final = 0.3
"""Largest rate of the balls, relative to the distance of the speed from natural frequencies, that counts as slow."""


@dataclass(frozen=True)
class Envelope:
    """The slow motion: `theta` [ball, moment] at `t` [s], amplitudes of the axis' whirl at the end, and the work."""

    t: Array
    theta: Array
    amplitude: float
    evaluations: int
    steps: int


@dataclass(frozen=True)
class Averages:
    """What the averaged equations need of a scene."""

    masses: Array
    moments: Array
    radii: Array
    drags: Array
    factors: Array
    race: NDArray[np.intp]
    forward: Complex
    """races × sources: whirl of a race by a force that turns with the rotor, sources rotor, couple, races."""
    own: Complex
    """m₀e e^{iφ}, the couple likewise."""
    offset: complex
    speed: float

    def whirl(self, theta: Array) -> Complex:
        """w_i of each race [m] for ball angles [ball, …]."""
        turned = np.exp(1j * theta)
        races = self.forward.shape[0]
        balls = np.array([self.moments[self.race == i] @ turned[self.race == i] for i in range(races)])
        held = np.array([self.masses[self.race == i].sum() for i in range(races)]) * self.offset
        shape = (-1,) + (1,) * (theta.ndim - 1)
        own = np.broadcast_to(self.own.reshape(shape), (len(self.own), *theta.shape[1:]))
        sources = np.concatenate([own, balls + held.reshape(shape)])
        return np.asarray(self.speed**2 * np.tensordot(self.forward, sources, axes=1), dtype=complex)

    def rhs(self, state: Array) -> Array:
        """(θ', θ'')."""
        theta, rate = np.split(state, 2)
        felt = (self.whirl(theta) + self.offset)[self.race]
        pull = self.speed**2 / self.radii * (felt * np.exp(-1j * theta)).imag
        return np.concatenate([rate, (pull - self.drags * rate) / self.factors])


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

    couple = scene.couple * np.exp(1j * scene.couple_angle)
    return Averages(
        masses=np.array(scene.ball_masses, dtype=float),
        moments=np.array(scene.ball_moments, dtype=float),
        radii=each("pitch_radius"),
        drags=each("drag"),
        factors=each("inertia_factor"),
        race=race,
        forward=_forward(scene),
        own=np.array((scene.imbalance * np.exp(1j * scene.imbalance_angle), couple)),
        offset=offset,
        speed=scene.speed,
    )


def _forward(scene: Scene) -> Complex:
    """h⁺ [m/N] of the races by forces on the centre of mass, the couple, and each race."""
    h = receptance(loaded(scene), scene.speed)
    pairs = len(h) // 2
    blocks = np.array(
        [[_circular(h[2 * i : 2 * i + 2, 2 * j : 2 * j + 2]) for j in range(pairs)] for i in range(pairs)]
    )
    places = np.array([(1.0, race.plane_offset)[:pairs] for race in scene.races])
    sources = np.concatenate([np.eye(2)[:, :pairs], places])
    return np.asarray(places @ blocks @ sources.T, dtype=complex)


def _circular(h: Complex) -> complex:
    return complex(h[0, 0] + h[1, 1] + 1j * (h[1, 0] - h[0, 1])) / 2


def loaded(scene: Scene) -> LinearSupport | SwingArm:
    """The support with the balls' mass on it."""
    support, masses = scene.support, np.array(scene.ball_masses, dtype=float)
    if isinstance(support, SwingArm):
        return replace(support, inertia=support.inertia + float(masses.sum()) * support.length**2)
    P = np.array(support.race_map)
    sizes = [len(race.ball_masses) for race in scene.races]
    z = np.repeat(np.array([race.plane_offset for race in scene.races]), sizes)
    m, mz, mzz = masses.sum(), (masses * z).sum(), (masses * z**2).sum()
    balls = np.kron(np.array(((m, mz), (mz, mzz))), np.eye(2))[: len(P), : len(P)]
    whole = np.array(support.mass) + P.T @ balls @ P
    return replace(support, mass=tuple(tuple(row) for row in whole.tolist()))


def not_averaged(scene: Scene) -> str | None:
    """Why the averages do not hold for a scene; None where they do."""
    others = [effect.name for effect in scene.effects if effect.name not in AVERAGED]
    if others:
        return f"{', '.join(others)} cannot be averaged"
    rate, gap = ball_rate(scene), natural_gap(scene)
    if rate > SLOW * gap:
        return (
            f"the balls' own rate, {rate:.3g} rad/s, is not small against the {gap:.3g} rad/s between the speed and "
            "the nearest natural frequency"
        )
    return None


def ball_rate(scene: Scene) -> float:
    """Fastest rate of the balls' slow motion [rad/s], √(κ n/J) with κ = m Ω⁴ |h⁺| of theory for each race."""
    model = averages(scene)
    races = model.forward.shape[0]
    sizes = [float((model.moments * (model.race == i) / model.radii / model.factors).sum()) for i in range(races)]
    return scene.speed**2 * math.sqrt(
        max((abs(model.forward[i, 2 + i]) * size for i, size in enumerate(sizes)), default=0)
    )


def natural_gap(scene: Scene) -> float:
    """Distance of the speed from the nearest natural frequency of the support with the balls' mass [rad/s]."""
    support = loaded(scene)
    if isinstance(support, SwingArm):
        natural = np.array([math.sqrt(max(support.stiffness, 0.0) * support.length**2 / support.inertia)])
    else:
        N = len(support.names)
        damping = np.array(support.damping) + (scene.speed * np.array(support.gyroscopic) if support.gyroscopic else 0)
        M = np.array(support.mass)
        A = np.block(
            [[np.zeros((N, N)), np.eye(N)], [-np.linalg.solve(M, support.stiffness), -np.linalg.solve(M, damping)]]
        )
        natural = np.abs(np.linalg.eigvals(A).imag)
    return float(np.abs(scene.speed - natural).min())


def envelope(scene: Scene, tolerance: float, sample_times: Array) -> Envelope:
    """The slow motion from the scene's start to the last of `sample_times` [s], by SciPy's DOP853.

    Balls that do not turn with the rotor at first are beyond it only in their first turns. `amplitude` is the larger
    semi-axis of the axis' whirl at the end.
    """
    from scipy.integrate import solve_ivp

    model = averages(scene)
    start = np.concatenate([scene.start_angles, [speed for race in scene.races for speed in race.start_speeds]])
    done = solve_ivp(
        lambda _, state: model.rhs(state), (0.0, float(sample_times[-1])), start, method="DOP853",
        t_eval=sample_times, rtol=tolerance, atol=tolerance,
    )  # fmt: skip
    theta = done.y[: len(model.masses)]
    return Envelope(sample_times, theta, _whirl_amplitude(scene, model, theta[:, -1]), done.nfev, len(done.t))


def _whirl_amplitude(scene: Scene, model: Averages, theta: Array) -> float:
    """(|X + iY| + |X − iY|)/2 of the axis at the centre of mass by all imbalances."""
    h = receptance(loaded(scene), scene.speed)
    turned = model.moments * np.exp(1j * theta) + model.masses * model.offset
    z = np.repeat([race.plane_offset for race in scene.races], [len(race.ball_masses) for race in scene.races])
    total = [model.own[0] + turned.sum(), model.own[1] + (turned * z).sum()]
    force = np.concatenate([value * np.array((1, -1j)) for value in total])[: len(h)]
    X, Y, *_ = (h @ force * scene.speed**2).tolist()
    return float(abs(X + 1j * Y) + abs(X - 1j * Y)) / 2
