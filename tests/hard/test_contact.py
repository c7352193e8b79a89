"""Wheel and work, ball and ball: soft to rigid, grazing, bouncing, coming to rest, and friction flutter."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.scene import Scene
from tests.dynamics.effects.test_grinding_contact import (
    BALL,
    CX,
    CY,
    EPS,
    PHI,
    PITCH_RADIUS,
    E,
    M,
    W,
    grinder,
    normal_forces,
)
from tests.hard.scenes import check_agreement, check_claim, check_energy, machine, run

pytestmark = pytest.mark.hard

CUTTING = 0.35


def flutter(drag: float, duration: float) -> tuple[Scene, np.ndarray]:
    """Rigid contact, f = 0.5, two balls that balance 90° apart, one of them 1° off its place; and their places.

    Ω²U = E (D_x − isf D_y)/(1 + isf) is what they leave; the imbalance is such that |U − m₀e| = √2 m R_p.
    """
    f, sense, damping = 0.5, -1, 45.0
    contact = GrindingContactEffect(400.0, f, "rigid", rotation_sense=sense, runout=EPS, runout_angle=PHI)
    Dx, Dy = (c - M * W**2 + 1j * damping * W for c in (CX, CY))
    U = E * (Dx - 1j * sense * f * Dy) / (1 + 1j * sense * f) / W**2
    own = U.real + math.sqrt(2 * (BALL * PITCH_RADIUS) ** 2 - U.imag**2)
    places = cmath.phase(U - own) + np.array((-1, 1)) * math.pi / 4
    angles = (places + np.array((math.radians(1), 0.0))).tolist()
    scene = grinder(
        contact, tuple(angles), imbalance=own, drag=drag, inertia_factor=1.0, damping=damping, duration=duration,
        start=(E, 0.0),
    )  # fmt: skip
    return scene, places


def growth(drag: float) -> float:
    """Of the slow motion λ² + h₀ λ + κ (1 ± if sin 90°) = 0, κ = m Ω⁴/(2M (Ω² − ω_x²)) [1/s]."""
    kappa = BALL * W**4 / (2 * M * (W**2 - CX / M))
    assert kappa == pytest.approx(560.7, rel=1e-3)
    return float(np.roots([1, drag, kappa * (1 + 0.5j)]).real.max())


@pytest.mark.parametrize("share", [0.9, 0.95, 1.05, 1.1])
def test_friction_flutter_just_below_and_above_its_limit(share: float) -> None:
    """Balls 90° apart and f = 0.5 need h₀ > f √(Jκ) = 11.84 1/s: 5 % below the swing grows, 5 % above it dies.

    Growth by the averaged equation, without balls heavy beside 5.6 kg, which is worth 0.1 1/s of it.
    """
    limit = 0.5 * math.sqrt(560.7)
    assert growth(limit) == pytest.approx(0, abs=1e-3)
    scene, places = flutter(share * limit, 3.0)
    y = run(scene, np.linspace(0, 3, 1501), tolerance=1e-8).y
    swing = np.abs(y[4:6] - places[:, None]).max(axis=0).reshape(-1)[:-1].reshape(10, -1).max(axis=1)
    found = math.log(swing[7] / swing[1]) / (6 * 0.3)
    assert (found > 0) is (share < 1)
    assert found == pytest.approx(growth(share * limit), abs=0.12)


@pytest.mark.parametrize(("drag", "swings"), [(5.92, True), (17.8, False)])
def test_flutter_far_from_the_limit(drag: float, swings: bool) -> None:
    """Half the limit: swings of tens of degrees for good. One and a half times: nothing is left but 2Ω jitter."""
    scene, places = flutter(drag, 2.0)
    left = np.abs(run(scene, np.linspace(1.5, 2, 501), tolerance=1e-8).y[4:6] - places[:, None]).max()
    assert left > math.radians(20) if swings else left < math.radians(0.1)
    check_agreement(replace(scene, duration=0.2), 1e-2)


def touching(stiffness: float, press: float, duration: float) -> tuple[Scene, complex]:
    """Runout drives the wheel on the work, without balls and next to no imbalance, from its steady motion; and N.

    N = −c_n (Y − iE) = i c_n E D/(D + c_n), D = c_η − MΩ², as long as wheel and work touch.
    """
    D = CY - M * W**2
    Y = 1j * stiffness * E / (D + stiffness)
    N = -stiffness * (Y - 1j * E)
    assert pytest.approx(1j * stiffness * E * D / (D + stiffness)) == N
    X = -CUTTING * N / (CX - M * W**2)
    contact = GrindingContactEffect(
        press, CUTTING, "compliant", contact_stiffness=stiffness, runout=EPS, runout_angle=PHI
    )  # fmt: skip
    return grinder(contact, (), imbalance=1e-7, duration=duration, start=(X, Y)), N


@pytest.mark.parametrize("exponent", [4, 5, 6, 7, 8, 9, 10])
def test_contact_stiffness(exponent: int) -> None:
    """1e4 … 1e10 N/m, pressed so hard that they never part: no event, and N swings by |c_n E D/(D + c_n)|.

    At 1e10 N/m that is the rigid contact's |E D| to 0.03 %, at seventy times the frequency of the rotor.
    """
    scene, N = touching(10.0**exponent, 400.0, 0.05)
    motion = run(scene, np.linspace(0, 0.05, 1001), tolerance=1e-8)
    swing = normal_forces(assemble(scene), motion) - 400.0
    assert motion.events == 0
    # The imbalance of 0.1 g·mm adds what it does; at most so much.
    assert swing.max() == pytest.approx(abs(N), rel=2e-3)
    assert swing.min() == pytest.approx(-abs(N), rel=2e-3)
    if exponent == 10:
        assert abs(N) == pytest.approx(abs(E * (CY - M * W**2)), rel=3e-4)


@pytest.mark.parametrize("stiffness", [3e5, 1e7])
@pytest.mark.parametrize("press", [1.001, 1.0, 0.999])
def test_grazing(stiffness: float, press: float) -> None:
    """The press force equal to the swing of N but for a thousandth: they all but part, graze, or just part, every turn.

    The run goes on at each graze, two or a few switches a turn, and the motion is the linear one to within what a
    thousandth of the force can change.
    """
    _, N = touching(stiffness, 1.0, 0.05)
    scene, _ = touching(stiffness, press * abs(N), 0.1)
    scene = replace(scene, imbalance=1e-10)
    times = np.linspace(0, 0.1, 501)
    turns = 0.1 / scene.revolution
    for way, tolerance in (("scipy-dop853", 1e-9), ("scipy-rk45", 1e-8)):
        motion = run(scene, times, way, tolerance)
        assert motion.events <= 6 * turns
        assert (motion.events == 0) or press < 1.0005
        force = normal_forces(assemble(scene), motion)
        linear = press * abs(N) + (N * np.exp(1j * W * times)).real
        assert np.abs(force - np.maximum(linear, 0)).max() < 0.01 * abs(N)


@pytest.mark.parametrize("stiffness", [1e6, 1e8, 1e10])
def test_a_bouncing_wheel(stiffness: float) -> None:
    """30 N do not keep a runout of 40 µm on the work: the wheel jumps. Three integrators go through the same bounces.

    Bounces multiply errors: the run is as short as that.
    """
    contact = GrindingContactEffect(
        30.0, CUTTING, "compliant", contact_stiffness=stiffness, runout=EPS, runout_angle=PHI
    )
    scene = grinder(contact, (1.0, 2.5), damping=200.0, duration=0.05)
    motion = check_agreement(scene, 1e-4)
    assert motion.events >= 4
    assert run(scene, [0.05], "scipy-radau", 1e-8).events == motion.events
    found = check_claim(scene)
    assert found.cost.events == motion.events
    if stiffness == 1e6:
        check_energy(scene, 0.0, 0.04, 1e-3)


def test_a_dropped_wheel_comes_to_rest() -> None:
    """From 2 mm above, pressed by 30 N on 1e7 N/m: ever lower bounces, then contact, at the place of equilibrium, 0.

    A bounce of a spring takes a finite time, so their number is finite: it is the same at two tolerances.
    """
    contact = GrindingContactEffect(30.0, 0.0, "compliant", contact_stiffness=1e7)
    scene = replace(grinder(contact, (), imbalance=1e-9, damping=500.0, duration=1.0), start_position=(0.0, 2e-3))
    runs = [run(scene, np.linspace(0, 1, 101), tolerance=tolerance) for tolerance in (1e-6, 1e-8)]
    assert runs[0].events == runs[1].events > 8
    assert runs[0].events % 2 == 1
    for motion in runs:
        assert np.abs(motion.y[1, -10:]).max() < 1e-9
    apart = np.flatnonzero(runs[1].y[1] > 30.0 / 1e7)
    assert 0 in apart
    assert apart.max() < 100


@pytest.mark.parametrize("restitution", [0.0, 0.5, 0.9])
def test_balls_bounce_to_rest(restitution: float) -> None:
    """Below resonance two balls meet on the heavy side: infinitely many bounces in a finite time, e + e² + … (Zeno).

    A finite number of events is counted, fewer without restitution; then they touch for good, 2β apart, at places two
    tolerances and two integrators agree on. Where a pair parts within what events are located by, it may dip by 1e-6.
    """
    scene = machine(50.0, (2.5, -2.0), 3.0, BallContactEffect(0.008, restitution), damping_ratio=0.2, drag=5.0)
    motion = check_agreement(scene, 1e-3, 301)
    gap = 2 * math.pi - (motion.y[4] - motion.y[5]) - 2 * math.asin(0.008 / 0.024)
    assert (gap > -1e-6).all()
    assert motion.events < 60
    if restitution < 0.9:
        assert gap[-100:].max() < 1e-11
    else:
        assert gap[-1] < 1e-4
    found = check_claim(scene)
    assert found.response.residual_imbalance > scene.imbalance
