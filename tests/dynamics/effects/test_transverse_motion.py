"""Motion across the race against the mechanics of a ball in space, its energy, and Kladiev 1996, (12)."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.effects.transverse_motion import TransverseMotionEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Race, Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude, weighing_amplitude
from abu_calc.foundation.errors import NotTrustworthyError, RangeError
from tests.dynamics.scenes import ROTORS, scene_on

STEP = 1e-100
R, BALL = 0.030, 0.008
PITCH = R - BALL
KLADIEV = BALL + 5 / 7 * PITCH
"""ρ of (12): 5 (R − r) = 7 (ρ − r)."""


def machine(effect: TransverseMotionEffect, *, drag: float = 0.0, duration: float = 0.2) -> Scene:
    """Two balls opposite each other, in balance: nothing moves but across the race."""
    race = Race(PITCH, (0.0167,) * 2, drag, 7 / 5, (0.4, 0.4 + math.pi), (0.0, 0.0), ball_radius=BALL)
    support = planar(5.6, (4e4, 4e4), (100.0, 100.0))
    return Scene("across", support, 600.0, 1e-6, 0.0, (race,), duration, (0.0,) * 2, (0.0,) * 2, effects=(effect,))


def thrown(equations: Equations, rate: float) -> Equations:
    """Both balls started across at w': then their resultant stays what it is."""
    initial = list(equations.initial)
    place = equations.states.index("across'1")
    initial[place : place + 2] = [rate, rate]
    return replace(equations, initial=tuple(initial))


def frequency(equations: Equations, end: float) -> float:
    """Of the first ball's way across, by its zero crossings."""
    t = np.linspace(0, end, 6001)
    w = scipy_.integrate(equations, 1e-9, t).y[equations.states.index("across1")]
    down = np.flatnonzero(np.diff(np.sign(w)))
    crossings = t[down] - w[down] * (t[1] - t[0]) / (w[down + 1] - w[down])
    return float(math.pi * (len(crossings) - 1) / (crossings[-1] - crossings[0]))


@pytest.mark.few(1)
@pytest.mark.parametrize("groove", [KLADIEV, 0.0105, 0.030, 0.1])
@pytest.mark.parametrize("free", [False, True])
def test_frequency_across(groove, free):
    """ω_t² = Ω² [(5/7)(R − r)/(ρ − r) + (2/7 with free spin)]: Ω at (12) locked, 1.1339 Ω free, Ω at ρ = R free."""
    effect = TransverseMotionEffect(groove, BALL, free_spin=free)
    expected = math.sqrt(5 / 7 * PITCH / (groove - BALL) + (2 / 7 if free else 0.0))
    ratio = frequency(thrown(assemble(machine(effect)), 1e-3), 0.2) / 600
    # The tiny imbalance moves the balls a little.
    assert ratio == pytest.approx(expected, rel=1e-5)
    if groove == KLADIEV:
        assert ratio == pytest.approx(1.1339 if free else 1.0, abs=5e-5)
    if groove == R and free:
        assert ratio == pytest.approx(1.0, abs=1e-5)


def test_axial_runout_meets_the_resonance():
    """At (12) without drag w = (a_z/2J) Ωt sin Ωt: it grows, turn by turn, while with another groove it does not."""
    t = np.linspace(0, 20 * math.pi / 600, 1001)
    equations = assemble(machine(TransverseMotionEffect(KLADIEV, BALL, 1e-6)))
    w = scipy_.integrate(equations, 1e-8, t).y[equations.states.index("across1")]
    np.testing.assert_allclose(w, 1e-6 / 2.8 * 600 * t * np.sin(600 * t), atol=2e-8)
    equations = assemble(machine(TransverseMotionEffect(0.016, BALL, 1e-6)))
    assert np.abs(scipy_.integrate(equations, 1e-8, t).y[equations.states.index("across1")]).max() < 2e-6


@pytest.mark.parametrize("free", [False, True])
def test_weight_is_the_steady_way(free):
    effect = TransverseMotionEffect(0.025, BALL, 5e-5, free)
    scene = machine(effect, drag=60.0, duration=0.4)
    equations = assemble(scene)
    times = 0.4 - np.arange(100) * scene.revolution / 100
    y = scipy_.integrate(equations, 1e-7, times[::-1]).y[equations.states.index("across1")]
    lost = 2 * 0.0167 * np.abs(y).max() ** 2 / (2 * (0.025 - BALL))
    expected = unbalanced_amplitude(scene, lost) / weighing_amplitude(scene)
    assert effect.weight(scene).value == pytest.approx(expected, rel=0.01)
    assert replace(effect, axial_runout=0.0).weight(scene).value == 0
    resonant = TransverseMotionEffect(KLADIEV, BALL, 5e-5)
    assert resonant.weight(machine(resonant)).value is None


def test_a_ball_that_climbs_out_is_told():
    equations = thrown(assemble(machine(TransverseMotionEffect(KLADIEV, BALL))), 15.0)
    with pytest.raises(NotTrustworthyError, match=r"ball [12] climbs out of its groove at t = 0.00"):
        scipy_.integrate(equations, 1e-6, [0.2])


@pytest.mark.parametrize("support", ["planar", "coupled", "hand", "tilting", "swing arm"])
@pytest.mark.parametrize("rotor", ROTORS)
@pytest.mark.parametrize("free", [False, True])
def test_in_the_middle_of_the_groove_nothing_changes(support, rotor, free):
    """Where races do not carry the balls along the spindle as they tilt."""
    effect = TransverseMotionEffect(1.1, 0.3, free_spin=free)
    bare, scene = scene_on(support, *ROTORS[rotor]), scene_on(support, *ROTORS[rotor], effect)
    plain, equations = assemble(bare), assemble(scene)
    first = 2 * len(scene.support.names) + 10
    y = np.random.default_rng(2).normal(size=len(plain.initial))
    both = np.concatenate([y[:first], np.zeros(5 * len(effect.ball_states)), y[first:]])
    found = equations.rhs(np, 0.3, both, equations.acting)
    rest = np.concatenate([found[:first], found[first + 5 * len(effect.ball_states) :]])
    np.testing.assert_allclose(rest, plain.rhs(np, 0.3, y, plain.acting), rtol=1e-12, atol=1e-12)
    assert not found[first : first + 5 * len(effect.ball_states)].any()


@pytest.mark.parametrize("free", [False, True])
def test_mirrored_along_the_spindle(free):
    """w → −w, ν → −ν: the same in the plane."""
    effect = TransverseMotionEffect(1.1, 0.3, free_spin=free)
    equations = assemble(scene_on("coupled", RaceEccentricityEffect(0.1, 0.3), effect, GravityEffect()))
    y = np.random.default_rng(4).normal(size=len(equations.initial)) * 0.3
    mirror = np.ones(len(y))
    mirror[16:] = -1
    here, there = (equations.rhs(np, 0.3, state, equations.acting) for state in (y, mirror * y))
    np.testing.assert_allclose(there, mirror * here, rtol=1e-12, atol=1e-14)


def free_scene(free: bool, drag: float = 0.0) -> Scene:
    """A round, undamped support, an imbalance, an eccentric race: in the rotor's frame nothing depends on time."""
    effects = (RaceEccentricityEffect(0.05, 0.7), TransverseMotionEffect(0.5, 0.1, free_spin=free))
    race = Race(0.8, (0.2, 0.05, 0.1), drag, 1.4, (0.0, 1.5, 3.0), (0.1, 0.0, -0.2), ball_radius=0.1)
    return Scene("free", planar(2.0, (5.0, 5.0), (0.0, 0.0)), 1.7, 0.3, 0.4, (race,), 20.0, (0.1, 0.0), (0.0, 0.2),
                 effects=effects)  # fmt: skip


def parts(y: np.ndarray, free: bool) -> list[np.ndarray]:
    """q, q', θ, θ', w, w', ν."""
    found = np.split(y, [2, 4, 7, 10, 13, 16])
    return found if free else [*found[:6], 0.0 * found[4]]


@pytest.mark.parametrize("rotor", [(), (RunUpEffect(3.0, 2.0),)], ids=["steady", "guided"])
def test_a_point_ball_is_pushed_by_its_surface_alone(rotor):
    """J = 1, with gravity, eccentricity, runout and drag: what acceleration and weight leave is normal to the race.

    Places in space, their accelerations by the complex step; the frame's balance of forces likewise.
    """
    effects = (*rotor, RaceEccentricityEffect(0.05, 0.7), TransverseMotionEffect(0.5, 0.1, 0.2), GravityEffect())
    race = Race(0.8, (0.2, 0.05, 0.1), 0.3, 1.0, (0.0, 1.5, 3.0), (0.1, 0.0, -0.2), ball_radius=0.1)
    scene = replace(free_scene(False), races=(race,), effects=effects)
    equations = assemble(scene)
    y = np.random.default_rng(8).normal(size=len(equations.initial)) * 0.3
    slope = equations.rhs(np, 0.4, y, equations.acting)
    b = 0.4

    def velocity(t: complex, y: np.ndarray) -> np.ndarray:
        _, v, theta, rate, w, w_rate, _ = parts(y[:16], False)
        turn, speed = (y[-2], y[-1]) if rotor else (1.7 * t, 1.7)
        gamma, swing, radius, nearer = theta + turn, rate + speed, 0.8 - w**2 / (2 * b), -w * w_rate / b
        c, s = np.cos(gamma), np.sin(gamma)
        return np.array((
            v[0] - 0.05 * speed * np.sin(turn + 0.7) + nearer * c - radius * swing * s,
            v[1] + 0.05 * speed * np.cos(turn + 0.7) + nearer * s + radius * swing * c,
            w_rate - 0.2 * speed * np.sin(turn),
        ))  # fmt: skip

    acceleration = velocity(0.4 + 1j * STEP, y + 1j * STEP * slope).imag / STEP
    turn = y[-2] if rotor else 0.68
    theta, rate, w, w_rate = y[4:7], y[7:10], y[10:13], y[13:16]
    along = np.array((-np.sin(theta + turn), np.cos(theta + turn), 0 * w))
    over = np.array((-w / b * np.cos(theta + turn), -w / b * np.sin(theta + turn), 1 + 0 * w))
    pushed = acceleration + 9.80665 * np.array((0.0, 1.0, 0.0))[:, None]
    np.testing.assert_allclose((pushed * along).sum(axis=0), -0.3 * 0.8 * rate, atol=1e-12)
    np.testing.assert_allclose((pushed * over).sum(axis=0), -0.3 * w_rate, atol=1e-12)
    m, speed, speeding = np.array((0.2, 0.05, 0.1)), y[-1] if rotor else 1.7, slope[-1] if rotor else 0.0
    place = turn + 0.4
    thrown = 0.3 * (speed**2 * np.array((np.cos(place), np.sin(place)))
                    - speeding * np.array((-np.sin(place), np.cos(place))))  # fmt: skip
    np.testing.assert_allclose(2.0 * slope[2:4] + 5.0 * y[:2] + acceleration[:2] @ m, thrown, atol=1e-12)


@pytest.mark.parametrize("free", [False, True])
def test_a_rolling_ball_is_turned_by_friction_alone(free):
    """I ω' = r n × friction about both tangents, nothing about the normal where spin is free: Newton and Euler.

    Small ways across: the equations are of second order in w/b, so to that order they must agree.
    """
    equations = assemble(replace(free_scene(free), imbalance=0.0))
    small = 1e-4
    y = np.random.default_rng(9).normal(size=len(equations.initial)) * 0.3
    y[10:] *= small
    slope = equations.rhs(np, 0.4, y, equations.acting)
    r, b, W = 0.1, 0.4, 1.7

    def frame(t: complex, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """Contact normal, along, across: unit vectors, one column for each ball."""
        _, _, theta, _, w, _, _ = parts(y, free)
        gamma, lean = theta + W * t, np.arctan(w / b)
        out, zero = np.array((np.cos(gamma), np.sin(gamma), 0 * w)), 0 * w
        up = np.array((zero, zero, 1 + zero))
        return (
            np.cos(lean) * out + np.sin(lean) * up,
            np.array((-np.sin(gamma), np.cos(gamma), zero)),
            -np.sin(lean) * out + np.cos(lean) * up,
        )

    def spin(t: complex, y: np.ndarray) -> np.ndarray:
        _, _, _, rate, w, w_rate, turned = parts(y, free)
        normal, along, over = frame(t, y)
        radius = 0.8 - w**2 / (2 * b)
        rolling = w_rate / r * along - radius * rate / r * over + turned / r * normal
        return rolling + W * np.array((0.0, 0.0, 1.0))[:, None]

    def velocity(t: complex, y: np.ndarray) -> np.ndarray:
        _, v, theta, rate, w, w_rate, _ = parts(y, free)
        gamma, swing, radius, nearer = theta + W * t, rate + W, 0.8 - w**2 / (2 * b), -w * w_rate / b
        c, s, turn = np.cos(gamma), np.sin(gamma), W * t + 0.7
        return np.array((
            v[0] - 0.05 * W * np.sin(turn) + nearer * c - radius * swing * s,
            v[1] + 0.05 * W * np.cos(turn) + nearer * s + radius * swing * c,
            w_rate,
        ))  # fmt: skip

    moved = (0.4 + 1j * STEP, y + 1j * STEP * slope)
    turning, push = spin(*moved).imag / STEP, velocity(*moved).imag / STEP
    normal, along, over = frame(0.4, y)
    torque = np.cross(r * normal, push, axis=0)
    left = torque - 0.4 * r**2 * turning
    about = [along, over, *([normal] if free else [])]
    for direction in about:
        np.testing.assert_allclose((left * direction).sum(axis=0), 0, atol=30 * small**2 * r)
    # What is left without the gyroscopic terms would be of first order.
    assert np.abs(0.4 * r**2 * turning * along).max() > 100 * small**2 * r


@pytest.mark.parametrize(
    "numbers", [(0.008, 0.008), (0.02, 0.0), (0.02, 0.008, -1e-3), (math.nan, 0.008), (0.02, 0.008, math.inf)]
)
def test_what_is_no_groove_is_refused(numbers):
    with pytest.raises(RangeError):
        TransverseMotionEffect(*numbers)
