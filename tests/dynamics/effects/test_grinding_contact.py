"""Grinding contact against closed solutions (Kladiev 1996, corrected): E = ε e^{iφ₀}, D = c − MΩ² + ibΩ per axis."""

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.effects.grinding_contact import GrindingContactEffect
from abu_calc.dynamics.effects.motor import MotorEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import Equations, assemble
from abu_calc.dynamics.equations.right_hand_side import accelerations, with_states
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Race, Scene, placed
from abu_calc.dynamics.supports.planar import planar
from abu_calc.dynamics.supports.steady_motion import unbalanced_amplitude, weighing_amplitude
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from tests.dynamics.scenes import hand_support, scene_on

W = 5800 * math.pi / 30
M, BALL, PITCH_RADIUS = 5.6, 16.728353e-3, 24e-3
CX, CY = M * 80.0**2, M * 120.0**2
EPS, PHI = 4e-5, 0.6
E = cmath.rect(EPS, PHI)


def normal_forces(equations: Equations, trajectory: Trajectory) -> np.ndarray:
    contact = equations.scene.effect("grinding_contact")
    assert isinstance(contact, GrindingContactEffect)
    return contact.normal_forces(equations, trajectory)


def grinder(
    contact: GrindingContactEffect,
    angles: tuple[float, ...] = (),
    *,
    imbalance: float = 100e-6,
    drag: float = 20.0,
    inertia_factor: float = 7 / 5,
    damping: float = 0.0,
    duration: float = 0.5,
    start: tuple[complex, complex] = (0.0, 0.0),
) -> Scene:
    """The grinder of the golden numbers, 5.6 kg with its balls, moving at t = 0 as Re{X e^{iΩt}}, Re{Y e^{iΩt}}."""
    X, Y = start
    own, shift = M - len(angles) * BALL, contact.drag * contact.press_force / CX
    races = (Race(PITCH_RADIUS, (BALL,) * len(angles), drag, inertia_factor, angles, (0.0,) * len(angles)),)
    scene = Scene(
        "grinding",
        planar(own, (CX, CY), (damping, damping)),
        W,
        imbalance,
        0.0,
        races,
        duration,
        ((X + shift).real, Y.real),
        (-W * X.imag, -W * Y.imag),
        effects=(contact,),
    )
    return placed(scene)


def run(scene: Scene, tolerance: float = 1e-7, turns: int = 10) -> tuple[Equations, Trajectory, np.ndarray]:
    """The last whole turns of a scene."""
    equations = assemble(scene)
    times = scene.duration - turns * scene.revolution + np.arange(turns * 60 + 1) * scene.revolution / 60
    return equations, scipy_.integrate(equations, tolerance, times), times


def harmonic(values: np.ndarray, times: np.ndarray, order: int = 1) -> complex:
    """C of Re{C e^{i order Ω t}} over whole turns."""
    return complex(2 * np.mean((values * np.exp(-1j * order * W * times))[:-1]))


GOLDEN = [
    (0.0, -1, (136.3550, 271.2639), 160.6097, -55.623),
    (0.35, -1, (161.0753, 302.2060), 151.5928, -36.332),
    (0.35, 1, (110.8259, 243.9415), 151.5928, -74.913),
]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("f", "sense", "angles", "reaction", "phase"), [pytest.param(*GOLDEN[0], marks=pytest.mark.slow), *GOLDEN[1:]]
)
def test_rigid_contact_with_free_balls(f, sense, angles, reaction, phase):
    """Places and reaction of the averaged equations; the balls' swing at 2Ω, 0.017°, and its square are beyond them."""
    contact = GrindingContactEffect(200.0, f, "rigid", rotation_sense=sense, runout=EPS, runout_angle=PHI)
    start = tuple(math.radians(angle + 0.3) for angle in angles)
    equations, trajectory, times = run(grinder(contact, start, duration=1.0, start=(E, 0.0)))
    assert np.degrees(trajectory.y[4:6].mean(axis=1)) == pytest.approx(angles, abs=0.03)
    N = normal_forces(equations, trajectory)
    found = harmonic(N, times)
    assert abs(found) == pytest.approx(reaction, rel=1e-3)
    assert math.degrees(cmath.phase(found)) == pytest.approx(phase, abs=0.03)
    assert N.mean() == pytest.approx(200.0, rel=2e-3)
    # The constraint is kept, not only its second derivative.
    assert np.abs(trajectory.y[1] + EPS * np.sin(W * times + PHI)).max() < 1e-6 * EPS
    swing = abs(harmonic(trajectory.y[4], times, 2))
    assert swing == pytest.approx(EPS / (4 * 7 / 5 * PITCH_RADIUS), rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("sense", [1, pytest.param(-1, marks=pytest.mark.slow)])
def test_axis_goes_backward_round_the_runout_circle(sense):
    """x = ε cos, y = −ε sin(Ωt + φ₀) from balls far off, damped: Ω²U = E (D_x − isf D_y)/(1 + isf)."""
    f, damping = 0.35, 45.0
    contact = GrindingContactEffect(200.0, f, "rigid", rotation_sense=sense, runout=EPS, runout_angle=PHI)
    _, trajectory, times = run(grinder(contact, (1.0, 5.0), damping=damping, duration=1.5))
    assert harmonic(trajectory.y[0], times) == pytest.approx(E, rel=1e-3)
    assert harmonic(trajectory.y[1], times) == pytest.approx(1j * E, rel=1e-6)
    Dx, Dy = (c - M * W**2 + 1j * damping * W for c in (CX, CY))
    U = E * (Dx - 1j * sense * f * Dy) / (1 + 1j * sense * f) / W**2
    resultant = 100e-6 + BALL * PITCH_RADIUS * np.exp(1j * trajectory.y[4:6].mean(axis=1)).sum()
    assert resultant == pytest.approx(U, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("inertia_factor", [1.0, 7 / 5])
def test_balls_swing_twice_a_turn(inertia_factor):
    """ε/(4 J R_p): 4.17e-4 rad for a point ball."""
    contact = GrindingContactEffect(200.0, 0.0, "rigid", runout=EPS, runout_angle=PHI)
    angles = tuple(math.radians(angle) for angle in GOLDEN[0][2])
    scene = grinder(contact, angles, inertia_factor=inertia_factor, duration=1.0, start=(E, 0.0))
    _, trajectory, times = run(scene, 1e-6)
    swing = abs(harmonic(trajectory.y[5], times, 2))
    assert swing == pytest.approx({1.0: 4.17e-4, 7 / 5: 2.98e-4}[inertia_factor], rel=5e-3)


@pytest.mark.slow
@pytest.mark.parametrize("sense", [-1, 1])
def test_balls_fixed_in_place(sense):
    """Balanced at idle: x = Re{isf E (D_y/D_x) e^{iΩt}}, 13.69 µm, y = −ε sin: a line inclined at δ."""
    X = 1j * sense * 0.35 * E * (CY - M * W**2) / (CX - M * W**2)
    assert abs(X) == pytest.approx(13.69e-6, abs=5e-9)
    contact = GrindingContactEffect(200.0, 0.35, "rigid", rotation_sense=sense, runout=EPS, runout_angle=PHI)
    # No imbalance and no balls leave no length for the tolerance but a rounding error's.
    equations, trajectory, times = run(grinder(contact, imbalance=1e-12, duration=0.11, start=(X, 0.0)))
    turns = np.exp(1j * W * times)
    shift = sense * 0.35 * 200.0 / CX
    np.testing.assert_allclose(trajectory.y[0] - shift, (X * turns).real, atol=1e-5 * abs(X))
    expected = 200.0 + (1j * (CY - M * W**2) * E * turns).real
    np.testing.assert_allclose(normal_forces(equations, trajectory), expected, atol=1e-5)


@pytest.mark.slow
def test_compliant_contact_without_balls():
    """H = −iN_c = c_n E (c_η − MΩ²)/(c_η + c_n − MΩ²) where U = 0, and with an imbalance alike."""
    stiffness, U = 4.9e5, 30e-6
    contact = GrindingContactEffect(200.0, 0.35, "compliant", stiffness, runout=EPS, runout_angle=PHI)
    D = CY + stiffness - M * W**2
    Y = (1j * stiffness * E - 1j * W**2 * U) / D
    Nc = -stiffness * (Y - 1j * E)
    without_imbalance = stiffness * E * (CY - M * W**2) / D
    assert -1j * Nc == pytest.approx(without_imbalance + stiffness * W**2 * U / D)
    X = (W**2 * U - 0.35 * Nc) / (CX - M * W**2)
    equations, trajectory, times = run(grinder(contact, imbalance=U, duration=0.11, start=(X, Y)), 1e-9)
    turns = np.exp(1j * W * times)
    np.testing.assert_allclose(normal_forces(equations, trajectory), 200.0 + (Nc * turns).real, rtol=1e-6)
    np.testing.assert_allclose(trajectory.y[0] + 0.35 * 200.0 / CX, (X * turns).real, atol=1e-6 * abs(X))
    assert trajectory.events == 0
    assert contact.remarks(equations, trajectory) == ()


@pytest.mark.few(1)
@pytest.mark.parametrize(("stiffness", "stable"), [(4.9e5, True), (3e6, False), (6e6, True)])
def test_compliant_contact_with_free_balls(stiffness, stable):
    """H = c_n E (c_ξ + c_η − 2MΩ²)/(c_ξ + c_η + c_n − 2MΩ²); between MΩ² − c_η and 2MΩ² − c_ξ − c_η balls leave it."""
    eps = 2e-5 * cmath.exp(1j * PHI)
    Dx, Dy = CX - M * W**2, CY + stiffness - M * W**2
    U = stiffness * eps * Dx / (Dx + Dy) / W**2
    V = U - 200e-6
    half = math.acos(abs(V) / (2 * BALL * PITCH_RADIUS))
    angles = tuple(cmath.phase(V) + sign * half + 0.01 for sign in (-1, 1))
    start = (W**2 * U / Dx, 1j * (stiffness * eps - W**2 * U) / Dy)
    contact = GrindingContactEffect(400.0, 0.0, "compliant", stiffness, runout=2e-5, runout_angle=PHI)
    equations, trajectory, times = run(grinder(contact, angles, imbalance=200e-6, start=start))
    H = stiffness * eps * (CX + CY - 2 * M * W**2) / (CX + CY + stiffness - 2 * M * W**2)
    off = abs(-1j * harmonic(normal_forces(equations, trajectory), times) / H - 1)
    assert off < 0.01 if stable else off > 0.1


@pytest.mark.slow
@pytest.mark.parametrize(("drag", "flutters"), [(0.5 * 11.84, True), (1.5 * 11.84, False)])
def test_balls_at_right_angles_flutter_below_the_limit_of_drag(drag, flutters):
    """h₀ > √(J κ (f²S² − C²)) = 11.84 1/s for 90°, f = 0.5, J = 1: below it they swing by some 35°."""
    contact = GrindingContactEffect(100.0, 0.5, "rigid")
    angles = (0.75 * math.pi + 0.02, 1.25 * math.pi)
    imbalance = math.sqrt(2) * BALL * PITCH_RADIUS
    scene = grinder(contact, angles, imbalance=imbalance, drag=drag, inertia_factor=1.0, damping=2.0, duration=4.0)
    swung = np.ptp(np.degrees(run(scene, 1e-5, turns=60)[1].y[4:6]), axis=1)
    assert swung.min() > 20 if flutters else swung.max() < 0.5


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [1e4, 1e6, 1e8, 1e10])
def test_bounces_are_elastic_and_on_time(stiffness):
    """A wheel dropped by the press: flight 2√(2hM/N₀), in the work 2(π − arccos(y₀/A))/ω, and back to its height."""
    height, mass, press = 1e-3, 2.0, 20.0
    unloaded, impact, frequency = press / stiffness, math.sqrt(2 * height * press / mass), math.sqrt(stiffness / mass)
    reach = math.hypot(unloaded, impact / frequency)
    period = 2 * math.sqrt(2 * height * mass / press) + 2 * (math.pi - math.acos(unloaded / reach)) / frequency
    scene = Scene(
        "bounce", planar(mass, (1.0, 0.0), (0.0, 0.0)), 7 / period, 1e-13, 0.0, (), 5 * period,
        (0.0, unloaded + height), (0.0, 0.0), effects=(GrindingContactEffect(press, 0.0, "compliant", stiffness),),
    )  # fmt: skip
    trajectory = scipy_.integrate(assemble(scene), 1e-9, np.linspace(0, 5 * period, 6))
    assert trajectory.events == 10
    np.testing.assert_allclose(trajectory.y[1] - unloaded, height, rtol=1e-7)


def grazing(share: float) -> Trajectory:
    """The wheel on its steady motion in the work, its runout `share` of that at which N just reaches zero."""
    stiffness, press = 4.9e5, 100.0
    D = CY + stiffness - M * W**2
    runout = share * press / abs(stiffness * (CY - M * W**2) / D)
    contact = GrindingContactEffect(press, 0.0, "compliant", stiffness, runout=runout)
    scene = grinder(contact, imbalance=1e-9, duration=0.1, start=(0.0, 1j * stiffness * runout / D))
    return scipy_.integrate(assemble(scene), 1e-9, [0.1])


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.98, 1 - 1e-12, 1.0, 1 + 1e-12, 1 + 1e-6, 1.02])
def test_a_graze_is_passed(share):
    events = grazing(share).events
    if abs(share - 1) > 0.01:  # less is over between two looks, and weighs as little
        assert (events > 0) == (share > 1)


@pytest.mark.parametrize("stiffness", [1e5, 1e7, 1e9])
def test_bouncing_wheel(stiffness):
    """N is never negative, and two tolerances agree before chaos parts them."""
    contact = GrindingContactEffect(45.0, 0.35, "compliant", stiffness, runout=3e-4, runout_angle=PHI)
    scene = grinder(contact, (2.0, 4.0), damping=50.0, duration=0.05)
    samples = np.linspace(0, 0.05, 501)
    fine, loose = (scipy_.integrate(assemble(scene), tolerance, samples) for tolerance in (1e-10, 1e-6))
    assert fine.events == loose.events >= 2
    np.testing.assert_allclose(loose.y[:2], fine.y[:2], atol=1e-3 * np.abs(fine.y[:2]).max())
    equations = assemble(scene)
    N = normal_forces(equations, fine)
    assert N.min() == 0
    part = N[fine.t >= 0.95 * fine.t[-1]].min() == 0
    assert bool(contact.remarks(equations, fine)) == part


@pytest.mark.slow
def test_what_would_part_is_told():
    """No separation iff |N_c| ≤ N₀: 160.6 N in the first golden row."""
    angles = tuple(math.radians(angle) for angle in GOLDEN[0][2])
    for press, parts in ((158.0, True), (164.0, False)):
        contact = GrindingContactEffect(press, 0.0, "rigid", runout=EPS, runout_angle=PHI)
        equations, trajectory, _ = run(grinder(contact, angles, duration=0.2, start=(E, 0.0)))
        assert bool(contact.remarks(equations, trajectory)) == parts


@pytest.mark.parametrize("rotor", [(), (MotorEffect(2.0, 3.0, 6.0),)], ids=["steady", "driven"])
@pytest.mark.parametrize("contact", ["compliant", "rigid", "face"])
@pytest.mark.parametrize("support", ["planar", "coupled", "hand", "tilting"])
def test_power_is_what_the_energy_gains(support, contact, rotor):
    """Without balls and imbalance: (M q'' + C q' + K q)·q' + J_r Ω'Ω = power of motor and contact, at any state."""
    tilts = support == "tilting"
    effect = GrindingContactEffect(0.7, 0.4, contact, 3.0, runout=0.2, runout_angle=0.5, wheel_radius=0.3,
                             plane_offset=0.6 if tilts else 0.0)  # fmt: skip
    scene = replace(scene_on(support, *rotor, effect), races=(), imbalance=0.0, couple=0.0)
    equations = assemble(scene)
    y = np.random.default_rng(3).normal(size=len(equations.initial))
    acting, size = equations.acting, len(scene.support.names)
    q, v = y[:size], y[size : 2 * size]
    motion, _, solved = accelerations(np, 0.4, y, acting)
    held = scene.support
    spun = np.array(held.gyroscopic) * motion.speed if held.gyroscopic else 0.0
    gained = v @ (np.array(held.mass) @ solved.support + (np.array(held.damping) + spun) @ v + held.stiffness @ q)
    if rotor:
        gained += 6.0 * solved.rotor * motion.speed
    p = equations.parameters
    put_in = sum(effect.power(motion, mode, own, solved, p) for effect, mode, own in with_states(y, acting))
    assert put_in == pytest.approx(gained, rel=1e-10)


@pytest.mark.parametrize(("sense", "sign"), [(-1, -1), (1, 1)])
def test_cutting_brakes_a_driven_rotor(sense, sign):
    """Rigid, on the constraint: N does no work, T = s f N does it at the rim, and the press on the axis."""
    contact = GrindingContactEffect(
        45.0, 0.35, "rigid", rotation_sense=sense, runout=EPS, runout_angle=PHI, wheel_radius=0.075
    )
    scene = grinder(contact)
    scene = replace(
        scene, effects=(MotorEffect(3.0, 628.0, 2e-3), contact), start_velocity=(0.3, scene.start_velocity[1])
    )
    equations = assemble(scene)
    y = np.array(equations.initial)
    motion, _, solved = accelerations(np, 0.0, y, equations.acting)
    rim = y[2] + motion.speed * (0.075 - EPS * math.sin(PHI))
    expected = -45.0 * y[3] + sense * 0.35 * solved.reaction * rim
    assert contact.power(motion, None, None, solved, equations.parameters) == pytest.approx(expected, rel=1e-9)
    face = replace(contact, contact="face")
    equations = assemble(replace(scene, imbalance=0.0, effects=(MotorEffect(3.0, W, 2e-3), face)))
    _, _, solved = accelerations(np, 0.0, np.array(equations.initial), equations.acting)
    assert solved.rotor == pytest.approx(sign * 0.35 * 45.0 * 0.075 / 2e-3)


def test_a_face_wheel_leaves_the_plane_alone():
    bare, ground = scene_on("planar"), scene_on("planar", GrindingContactEffect(45.0, 0.35, "face", runout=0.1))
    y = np.random.default_rng(1).normal(size=len(assemble(bare).initial))
    derivatives = [assemble(scene).rhs(np, 0.3, y, assemble(scene).acting) for scene in (bare, ground)]
    assert np.array_equal(*derivatives)


@pytest.mark.parametrize("support", ["planar", "coupled", "tilting"])
def test_a_start_is_placed_on_the_constraint_by_the_shortest_way(support):
    contact = GrindingContactEffect(1.0, 0.3, "rigid", runout=0.1, runout_angle=0.5,
                              plane_offset=0.4 if support == "tilting" else 0.0)  # fmt: skip
    scene = scene_on(support, contact)
    started = placed(scene)
    P = np.array(scene.support.race_map)
    row = P[1] + 0.4 * P[3] if support == "tilting" else P[1]
    assert row @ started.start_position == pytest.approx(-0.1 * math.sin(0.5))
    assert row @ started.start_velocity == pytest.approx(-0.1 * math.cos(0.5) * scene.speed)
    moved = np.array(started.start_position) - scene.start_position
    assert abs(row @ moved) == pytest.approx(np.linalg.norm(row) * np.linalg.norm(moved))
    assert placed(started).start_position == pytest.approx(started.start_position)
    resting = replace(scene, effects=(RunUpEffect(3.0), contact))
    assert row @ placed(resting).start_velocity == pytest.approx(0)
    soft = replace(scene, effects=(replace(contact, contact="compliant", contact_stiffness=1.0),))
    assert placed(soft) is soft


@pytest.mark.slow
def test_balls_that_run_away_are_told():
    """A rigid contact feeds heavy balls without drag until their speed is infinite; one that can part does not."""
    rigid = GrindingContactEffect(1.0, 0.5, "rigid", rotation_sense=1)
    scene = grinder(rigid, (0.3, 1.2, 2.5), drag=0.0, inertia_factor=1.0)
    race = replace(scene.races[0], ball_masses=(1.0,) * 3, start_speeds=(30 * W, -20 * W, 10 * W))
    with pytest.raises(NotTrustworthyError, match=r"ball \d runs away at t = 0\.\d+ s: a rigid contact cannot part"):
        scipy_.integrate(assemble(replace(scene, races=(race,))), 1e-4, [scene.duration])
    compliant = replace(rigid, contact="compliant", contact_stiffness=M * W**2)
    end = scipy_.integrate(assemble(replace(scene, races=(race,), effects=(compliant,))), 1e-4, [scene.duration / 50])
    assert np.abs(end.y[-3:]).max() < 200 * W


def test_constraint_holds_behind_hands():
    contact = GrindingContactEffect(1.0, 0.3, "rigid", runout=0.1, runout_angle=0.5)
    scene = placed(replace(scene_on("hand", contact), support=hand_support()))
    trajectory = scipy_.integrate(assemble(scene), 1e-8, np.linspace(0, 10, 50))
    np.testing.assert_allclose(trajectory.y[1], -0.1 * np.sin(1.7 * trajectory.t + 0.5), atol=1e-7)


def test_weight_is_the_change_of_the_axis():
    """Without friction along y alone: |ΔY| of the two steady motions; face wheels change nothing in the plane."""
    stiffness, U = 3e5, 100e-6
    contact = GrindingContactEffect(45.0, 0.0, "compliant", stiffness, runout=EPS, runout_angle=PHI)
    scene = grinder(contact, imbalance=U)
    D = CY - M * W**2
    change = 1j * (stiffness * E - W**2 * U) / (D + stiffness) + 1j * W**2 * U / D
    assert contact.weight(scene).value == pytest.approx(abs(change) / weighing_amplitude(scene))
    assert weighing_amplitude(scene) == pytest.approx(0.01 * unbalanced_amplitude(scene))
    rigid = replace(contact, contact="rigid").weight(scene).value
    assert replace(contact, contact_stiffness=1e14).weight(scene).value == pytest.approx(rigid, rel=1e-6)
    face = replace(contact, contact="face")
    assert face.weight(scene).value == 0
    driven = face.weight(replace(scene, effects=(MotorEffect(3.0, W, 2e-3), face)))
    assert driven.value is None
    assert "no wheel radius" in driven.why


def test_what_no_contact_can_be_is_refused():
    contact = GrindingContactEffect(1.0, 0.3, "compliant", 1.0)
    with pytest.raises(InputError, match="swing arm"):
        assemble(scene_on("swing arm", contact))
    with pytest.raises(InputError, match="tilts"):
        assemble(scene_on("planar", replace(contact, plane_offset=0.1)))
    with pytest.raises(InputError, match="rotation sense"):
        replace(contact, rotation_sense=0)
    with pytest.raises(InputError, match="contact stiffness"):
        replace(contact, contact_stiffness=0.0)


def test_forces_at_a_wheel_off_the_middle():
    """M q'' + (C + ΩG) q' + K q = (T, N − N₀, z T, z (N − N₀)), N by the wheel's own height y + z (−θ_x)."""
    z, f = 0.6, 0.4
    effect = GrindingContactEffect(2.0, f, "compliant", 3.0, runout=0.2, runout_angle=0.5, plane_offset=z)
    scene = replace(scene_on("tilting", effect), races=(), imbalance=0.0, couple=0.0)
    equations, support = assemble(scene), scene.support
    y = np.random.default_rng(5).normal(size=8) * 0.2
    q, v = y[:4], y[4:]
    pushed = equations.rhs(np, 0.4, y, equations.acting)[4:]
    found = np.array(support.mass) @ pushed + np.array(support.stiffness) @ q
    found += (np.array(support.damping) + 1.7 * np.array(support.gyroscopic)) @ v
    N = 2.0 - 3.0 * (q[1] + z * q[3] + 0.2 * math.sin(1.7 * 0.4 + 0.5))
    assert N > 0
    np.testing.assert_allclose(found, [-f * N, N - 2.0, -z * f * N, z * (N - 2.0)], atol=1e-12)


def test_constraint_holds_through_a_run_up():
    """y = −ε sin(turn + φ₀) while the speed changes, to far below what the speeding alone moves it."""
    contact = GrindingContactEffect(1.0, 0.3, "rigid", runout=0.1, runout_angle=0.5)
    scene = placed(scene_on("planar", RunUpEffect(3.0, 2.0), contact))
    trajectory = scipy_.integrate(assemble(scene), 1e-9, np.linspace(0, 20, 101))
    np.testing.assert_allclose(trajectory.y[1], -0.1 * np.sin(trajectory.y[-2] + 0.5), atol=1e-8)


def test_what_the_cutting_force_moves_at_once_swings_on():
    """T/c as free motion dies out with 2M/b; a run much longer does not know of it. Light damping, so 1 % does."""
    contact = GrindingContactEffect(45.0, 0.35, "compliant", 1e5)
    short, long = (grinder(contact, damping=20.0, duration=duration) for duration in (0.5, 50.0))
    more = (contact.weight(short).value - contact.weight(long).value) * weighing_amplitude(short)
    assert more == pytest.approx(0.35 * 45.0 / CX * math.exp(-20.0 * 0.95 * 0.5 / (2 * M)), rel=0.01)
