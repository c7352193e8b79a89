"""Averaged slow motion of the balls: the equations of motion, averaged over a revolution.

    J θ_k'' + h₀ θ_k' = (1/R_p) Im((Σ_j K_ij U_j − i K'_ij U_j' + Ω² Δ e^{iφ}) e^{−iθ_k}),    K_ij = ν⁴ h⁺_ij at ν = Ω

i is the race of ball k; U_j the imbalance of rotor, couple and balls in the plane j, U of a race Σ m R_p e^{iθ} and
m Δ e^{iφ} of its offset; h⁺ = ½(h_xx + h_yy + i(h_yx − h_xy)) the forward receptance of the support with the balls'
mass, K' = dK/dν. The second term is the change by slowly moving balls. It is of the order of their rate over the
distance of the speed from the natural frequencies, as is the change of their speed by the support's free motion at the
start. `order` 1 leaves out both. The motion is as slow as the balls, so it costs a small share of the equations.

    averages        coefficients of the equations for a scene
    not_averaged    the reason why they do not hold, if any
    envelope        the slow motion by LSODA
    motion          states of the full equations that the envelope stands for
    followed        both, sampled as the runs of the integrators are

Range: constant speed, linear supports or a swing arm idling, and no effect may switch: see `not_averaged`.

Source: Kladiev 1996, (4)–(7), generalised; Blekhman 1988, ch. 2 (vibrational moments). The terms of the next order are
derived here.
"""

import cmath
import math
import warnings
from collections.abc import Callable
from functools import lru_cache
from typing import Any, Final, cast

import numpy as np
from numpy.typing import NDArray

from abu_calc.dynamics.integrators.run import Recorder
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.support import SmallMotion
from abu_calc.dynamics.trajectory import Sampling, Times, Trajectory
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass

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


RESONANT = 1e-9
"""Distance from a natural frequency, as a share of the speed, that is none."""

MOST_STEPS = 100_000
"""Most steps between two times."""


@dataclass(frozen=True)
class EnvelopeMotion:
    """The slow motion: `theta` and `rate` [ball, time] at `t` [s], and the work."""

    t: Array
    theta: Array
    rate: Array
    evaluations: int
    steps: int


def envelope(
    scene: Scene, tolerance: float, sample_times: Array, order: int = 2, start: Array | None = None
) -> EnvelopeMotion:
    """The slow motion through `sample_times` [s] by LSODA, from the scene's start at the first, 0, or from another.

    Balls that do not turn with the rotor at first are beyond it only in their first turns. Raises NotTrustworthyError
    when the integration fails.
    """
    import scipy.integrate

    solve: Any = scipy.integrate.odeint  # it takes a tolerance for each state, though its type stubs know one only
    model, balls = averages(scene), len(scene.ball_masses)
    speeds = np.array([speed for race in scene.races for speed in race.start_speeds])
    if start is None:
        start = np.concatenate([scene.start_angles, speeds + model.kick if order > 1 else speeds])
    scales = tolerance * np.repeat((1.0, ball_rate(scene)), balls)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # what went wrong is asked for
        y, report = solve(slow_motion(model, order), start, sample_times, rtol=tolerance, atol=scales, tfirst=True,
                        full_output=True, mxstep=MOST_STEPS)  # fmt: skip
    if "successful" not in report["message"] or not np.isfinite(y).all():
        raise NotTrustworthyError("the averaged motion is lost: it needs too many steps\n  take the equations instead")
    theta, rate = y.T[:balls], y.T[balls:]
    return EnvelopeMotion(sample_times, theta, rate, int(report["nfe"][-1]), int(report["nst"][-1]))


Rates = Callable[[float, Array], list[float]]


def slow_motion(model: Averages, order: int = 2) -> Rates:
    """(t, (θ, θ')) → (θ', θ''), in plain numbers: for a few balls that takes a tenth of the time of arrays."""
    W, of_race = model.speed, 2 + model.race
    held, slope = W**4 * model.forward, 4 * W**3 * model.forward + W**4 * model.slope
    still = held @ model.own + W**2 * model.offset
    # What each ball does to each race, by its place and by its speed.
    places = held[:, of_race] * model.static_moments
    speeds = slope[:, of_race] * model.static_moments if order > 1 else 0.0 * places
    shares, drags = 1 / (model.radii * model.factors), model.drags / model.factors
    numbers = [part.ravel().tolist() for part in (still, places, speeds, shares, drags)]
    return _written(tuple(model.race.tolist()), len(still))(*numbers)


@lru_cache(maxsize=32)
def _written(race: tuple[int, ...], races: int) -> Callable[..., Rates]:
    """A maker of rates from their numbers, for balls in these races; without loops, which take as long as the rest."""
    balls, pairs = range(len(race)), [(i, k) for i in range(races) for k in range(len(race))]

    def names(*kinds: str) -> str:
        return ", ".join(f"{kind}{k}" for kind in kinds for k in balls)

    felt = [" + ".join(f"e{k} * (p{i}_{k} + v{i}_{k} * w{k})" for k in balls) for i in range(races)]
    pulled = [
        f"(f{i}.imag * e{k}.real - f{i}.real * e{k}.imag) * c{k} - d{k} * w{k}" for k, i in enumerate(race)
    ]  # fmt: skip
    text = [
        "def make(still, places, velocities, shares, drags):",
        f" [{', '.join(f's{i}' for i in range(races))}] = still",
        *(f" [{', '.join(f'{of[0]}{i}_{k}' for i, k in pairs)}] = {of}" for of in ("places", "velocities")),
        f" [{names('c')}], [{names('d')}] = shares, drags",
        " def rates(_, state):",
        f"  [{names('a', 'w')}] = state.tolist()",
        *(f"  e{k} = rect(1.0, a{k})" for k in balls),
        *(f"  f{i} = s{i} + {sum_}" for i, sum_ in enumerate(felt)),
        f"  return [{names('w')}, {', '.join(pulled)}]",
        " return rates",
    ]
    scope: dict[str, Any] = {"rect": cmath.rect}
    exec(compile("\n".join(text), "<slow motion>", "exec"), scope)
    return cast(Callable[..., Rates], scope["make"])


def whirl(scene: Scene, theta: Array, rate: Array) -> tuple[Complex, Complex]:
    """Q, Q' [coordinate, time]: the support moves as Re(Q e^{iΩt}), with the balls at θ and moving."""
    model, support, W = averages(scene), scene.small_motion, scene.speed
    planes = np.array([(1.0, race.plane_offset) for race in scene.races]).T
    turned = model.static_moments[:, None] * np.exp(1j * theta)
    still = model.own[:2] + planes @ model.own[2:]
    sums, changes = still[:, None] + planes[:, model.race] @ turned, planes[:, model.race] @ (1j * rate * turned)
    answer, slope = support.answer(W)

    def by(unbalances: Complex, answers: Complex) -> Complex:
        """Answer of the support to unbalances in both planes, as a phasor."""
        forces = (unbalances[:, None] * TURNED[:, None]).reshape(4, -1)[: answers.shape[1]]
        return np.asarray(answers @ forces, dtype=complex)

    rates = by(changes, W**2 * answer)
    return by(sums, W**2 * answer) - 1j * by(changes, 2 * W * answer + W**2 * slope), rates


def motion(scene: Scene, slow: EnvelopeMotion) -> Array:
    """The states of the equations that it stands for: whirl and free motion of the support, the balls."""
    model, support = averages(scene), scene.small_motion
    Q, rates = whirl(scene, slow.theta, slow.rate)
    turn = np.exp(1j * scene.speed * slow.t)
    V, dying_out = dying(support, model.free, slow.t)
    held = np.concatenate([Q * turn, (rates + 1j * scene.speed * Q) * turn]) + V @ dying_out
    return np.concatenate([held.real, slow.theta, slow.rate])


def free_amplitude(scene: Scene, t: float) -> float:
    """The most the free motion of the support still moves the axis at the time t [m]."""
    support = scene.small_motion
    V, dying_out = dying(support, averages(scene).free, np.array([t]))
    return float(np.abs((support.frame[:2] @ V[: len(support.mass)]) * dying_out[:, 0]).sum())


def not_averaged(scene: Scene) -> str | None:
    """Why the averages do not hold for a scene; None where they do."""
    others = [effect.name for effect in scene.effects if not effect.averaged]
    if others:
        return f"{', '.join(others)} cannot be averaged"
    if away := scene.support.not_averaged(scene.start_position, scene.start_velocity):
        return away
    gap = natural_gap(scene)
    # At a resonance that nothing damps there is no whirl to average.
    rate = ball_rate(scene) if gap > RESONANT * scene.speed else math.inf
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
    sizes = [
        float((model.static_moments * (model.race == i) / model.radii / model.factors).sum()) for i in range(races)
    ]
    return scene.speed**2 * math.sqrt(
        max((abs(model.forward[i, 2 + i]) * size for i, size in enumerate(sizes)), default=0)
    )


def natural_gap(scene: Scene) -> float:
    """Distance of the speed from the nearest natural frequency of the support with the balls' mass [rad/s]."""
    return float(np.abs(scene.speed - np.abs(np.linalg.eigvals(scene.small_motion.motion).imag)).min())


AT_ONCE = 2**17
"""Samples between which the slow motion is begun anew where not all are held; each takes some hundred bytes."""


def followed(scene: Scene, tolerance: float, times: Times) -> Trajectory:
    """The slow motion through all times, the first of which is 0, and the states of the equations at them.

    Raises NotTrustworthyError when the integration fails.
    """
    recorder = Recorder(Sampling.of(times))
    wanted = recorder.sampling.times
    room = len(wanted) if recorder.sampling.held is None else AT_ONCE
    state, evaluations, steps = None, 0, 0
    for first in range(0, len(wanted), room):
        before = max(first - 1, 0)
        slow = envelope(scene, tolerance, wanted[before : first + room], start=state)
        state = np.concatenate([slow.theta[:, -1], slow.rate[:, -1]])
        recorder.fill(motion(scene, slow)[:, first - before :])
        evaluations, steps = evaluations + slow.evaluations, steps + slow.steps
    samples = recorder.samples()
    return Trajectory(samples.t, samples.y, "scipy-lsoda", tolerance, evaluations, steps)
