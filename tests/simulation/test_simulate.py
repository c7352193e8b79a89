"""Results against their definitions, and whether the claimed accuracy is kept."""

import math
from dataclasses import replace

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators import scipy_solvers as scipy_
from abu_calc.dynamics.scene import Race, Scene, with_parted_balls
from abu_calc.dynamics.supports.planar import PlanarSupport
from abu_calc.dynamics.supports.steady_motion import receptance
from abu_calc.dynamics.trajectory import Trajectory
from abu_calc.foundation.errors import InputError, NotTrustworthyError
from abu_calc.simulation import simulate as simulate_module
from abu_calc.simulation.response import amplitude_window, evaluate, needed_times, settling_times
from abu_calc.simulation.simulate import difference, simulate
from tests.dynamics.scenes import dimensionless, straight_grinder
from tests.dynamics.transforms import in_units


def without_balls(stiffness: tuple[float, float] = (1.0, 3.0)) -> Scene:
    return replace(dimensionless(2.3, 0.05, 0.02, 0.2, 0.1, (), 150.0, stiffness=stiffness), imbalance_angle=1.1)


def test_without_balls_the_motion_is_the_receptance():
    """Anisotropic: an ellipse, its axes oblique through damping. Each direction by its own formula here."""
    scene = without_balls()
    response = simulate(scene, accuracy=1e-5).response
    force, W = scene.imbalance * scene.speed**2, scene.speed
    X = force / (1 - W**2 + 0.4j * W)
    Y = -1j * force / (3 - W**2 + 0.4j * W)
    turns = np.exp(1j * np.linspace(0, 2 * math.pi, 20001))
    largest = np.hypot((X * turns).real, (Y * turns).real).max()
    assert response.unbalanced_amplitude == pytest.approx(largest, rel=1e-6)
    assert response.axis_amplitude == pytest.approx(largest, rel=1e-5)
    assert response.velocity_rms == pytest.approx(W * max(abs(X), abs(Y)) / math.sqrt(2), rel=1e-5)
    assert response.level == pytest.approx(20 * math.log10(response.velocity_rms / 5e-8), rel=1e-12)
    assert response.residual_imbalance == pytest.approx(0.02)
    assert response.settling_time == 0.0
    turn = np.exp(1j * (W * scene.duration + scene.imbalance_angle))
    final = response.final
    assert (final.x, final.y) == pytest.approx(((X * turn).real, (Y * turn).real), rel=1e-4)
    assert (final.vx, final.vy) == pytest.approx(((1j * W * X * turn).real, (1j * W * Y * turn).real), rel=1e-4)


def test_receptance_of_a_mass_on_a_mass():
    """A hand on the wheel, m₂ on k₂, c₂: it adds the dynamic stiffness −Ω²m₂ s/(s − Ω²m₂), s = k₂ + iΩc₂."""
    m1, m2, k1, k2, c2, W = 2.0, 0.5, 7.0, 3.0, 0.4, 1.9

    def both(a: float, b: float, c: float) -> tuple[tuple[float, ...], ...]:
        return ((a, 0.0, c, 0.0), (0.0, a, 0.0, c), (c, 0.0, b, 0.0), (0.0, c, 0.0, b))

    support = PlanarSupport(
        mass=both(m1, m2, 0.0),
        damping=both(c2, c2, -c2),
        stiffness=both(k1 + k2, k2, -k2),
        race_map=((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0)),
        names=("x", "y", "hand x", "hand y"),
    )
    s = k2 + 1j * W * c2
    expected = 1 / (k1 - W**2 * m1 - W**2 * m2 * s / (s - W**2 * m2))
    np.testing.assert_allclose(receptance(support, W), expected * np.eye(2), rtol=1e-12, atol=1e-15)
    scene = Scene("hand", support, W, 0.1, 0.0, (Race(1.0, (), 0.0, 1.0, (), ()),), 300.0, (0.0,) * 4, (0.0,) * 4)
    assert simulate(scene).response.axis_amplitude == pytest.approx(abs(expected) * 0.1 * W**2, rel=1e-3)


def made_trajectory(scene: Scene, states) -> Trajectory:
    """A trajectory by formula, as an integrator would hand it on."""
    t = needed_times(scene)
    return Trajectory(t, states(t), "formula", 1e-6, 0, 0)


def test_results_follow_their_definitions():
    """A motion made up: circle of 2 mm about (3, −1) mm, balls closing in on ±120° and creeping in the rotor."""
    scene = dimensionless(2.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 400.0)
    creep = 1e-5

    def states(t):
        phase = 2.0 * t
        closing = np.exp(-t / 20)
        return np.array(
            [
                3e-3 + 2e-3 * np.cos(phase),
                -1e-3 + 2e-3 * np.sin(phase),
                -4e-3 * np.sin(phase),
                4e-3 * np.cos(phase),
                2 * math.pi / 3 + closing + creep * t,
                -2 * math.pi / 3 - closing + creep * t,
                creep - closing / 20,
                creep + closing / 20,
            ]
        )

    response = evaluate(scene, made_trajectory(scene, states))
    assert response.axis_amplitude == pytest.approx(2e-3, rel=1e-9)
    assert response.velocity_rms == pytest.approx(4e-3 / math.sqrt(2), rel=1e-9)
    assert response.final.ball_speeds == pytest.approx((creep, creep), rel=1e-3)
    assert response.final.x == pytest.approx(3e-3 + 2e-3 * math.cos(800.0), rel=1e-9)
    # |U| = 0.02·|1 + 2 cos(2π/3 + d) e^{i·creep·t}|; creep leaves about 2 sin(creep·t/2) of it, 0.0039 at the end.
    limit = np.mean(np.abs(residual(np.linspace(380.0, 400.0, 4001), creep))) + 0.1 * 0.02
    t = np.linspace(0, 400, 400001)
    crossing = t[np.flatnonzero(residual(t, creep) >= limit)[-1]]
    assert response.settling_time == pytest.approx(crossing, abs=0.01)
    # On an even circle it is quiet from the beginning. The balls turn by 1e-5 a second, 0.004 of 0.02 in the run: they
    # rest when they have closed in. By their directions, too: |1 + 2 cos e^{i·creep·t}| hides what that one adds.
    assert response.quiet_time == 0.0 and not response.creeping
    whole = 0.02 * (1 + 2 * np.cos(2 * math.pi / 3 + np.exp(-t / 20)) * np.exp(1j * creep * t))
    away = np.abs(whole - np.mean(whole[t >= 400.0 - 6 * math.pi]))
    assert response.rest_time == pytest.approx(t[np.flatnonzero(away >= 0.1 * 0.02)[-1]], abs=0.01)
    assert response.residual_imbalance == pytest.approx(residual(np.array([400.0]), creep)[0], rel=1e-9)


def residual(t, creep):
    return 0.02 * np.abs(1 + 2 * np.cos(2 * math.pi / 3 + np.exp(-t / 20)) * np.exp(1j * creep * t))


def test_the_window_begins_where_it_begins():
    """An axis that dies out is read at the window's very beginning, and its means count what dies out as it does."""
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (), 213.3 * math.pi)
    rate, length = 0.2, 213.3 * math.pi / 20

    def states(t):
        dying = 1e-3 * np.exp(-rate * (t - scene.duration + length))
        return np.array([dying, 0 * t, -rate * dying, 0 * t])

    response = evaluate(scene, made_trajectory(scene, states))
    whole = 10 * math.pi
    first = math.exp(-rate * (length - whole))
    mean = 1e-3 * first * (1 - math.exp(-rate * whole)) / (rate * whole)
    square = (rate * 1e-3 * first) ** 2 * (1 - math.exp(-2 * rate * whole)) / (2 * rate * whole)
    # Simpson's rule with 64 steps h a turn: (2·rate·h)⁴/180 = 8e-10 of it.
    assert response.axis_amplitude == pytest.approx(1e-3 - mean, rel=1e-8)
    assert response.velocity_rms == pytest.approx(math.sqrt(square), rel=1e-8)


def test_the_largest_place_is_read_between_samples():
    """A straight line swung along at 64 samples a turn: a sample may be 1e-3 below the crest, the quartic is not."""
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (), 213.0 * math.pi)

    def states(t):
        phase = 2 * t + 0.03
        return np.array([2e-3 * np.cos(phase), 0 * t, -4e-3 * np.sin(phase), 0 * t])

    # Half the square swings at twice the speed, h = 4π/64: h⁶/720 of it at the most.
    assert evaluate(scene, made_trajectory(scene, states)).axis_amplitude == pytest.approx(2e-3, rel=1e-7)


@pytest.mark.parametrize("turns", [1.0, 1.5, 19.9, 40.3, 213.0])
def test_amplitude_window(turns):
    scene = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (), turns * math.pi)
    window = amplitude_window(scene)
    length = max(turns / 20, 1.0)
    assert window.times[-1] == scene.duration
    assert window.times[0] >= 0
    assert window.times[-1] - window.times[0] == pytest.approx(length * math.pi, rel=1e-12)
    assert window.whole == int(length) * 64
    assert window.whole < len(window.times)
    assert settling_times(scene)[[0, -1]].tolist() == [0.0, scene.duration]


def test_straight_grinder_settles_as_known():
    """Known for such a grinder: 0.4–0.9 s at a drag of 15 1/s; the level falls to next to nothing on an ideal race."""
    simulation = simulate(straight_grinder())
    response, cost = simulation.response, simulation.cost
    assert response.settling_time is not None
    assert 0.4 < response.settling_time < 0.9
    assert response.axis_amplitude < 1e-3 * response.unbalanced_amplitude
    # m₀e/M without the balls, for a speed far above the suspension: 256 g·mm/6.333 kg.
    assert response.unbalanced_amplitude == pytest.approx(256e-6 / 6.333088, rel=1e-3)
    assert cost.evaluations < 14_000
    assert simulation.error_estimate <= 0.01
    assert simulation.warnings == ()


@pytest.mark.slow
@pytest.mark.parametrize(
    "scene",
    [
        straight_grinder(),
        dimensionless(3.0, 0.02, 0.02, 0.1, 0.2, (1.0, 1.0, 2.0, 4.0), 150.0, inertia_factor=1.4),
        dimensionless(2.0, 0.02, 0.02, 0.1, 0.2, (1.0, 2.0), 150.0, stiffness=(1.0, 2.0)),
        dimensionless(0.5, 0.02, 0.02, 0.1, 0.2, (1.0, 2.0), 150.0),
    ],
    ids=["grinder", "four balls", "anisotropic", "below resonance"],
)
def test_claimed_accuracy_is_kept(scene):
    """Against a run at a tolerance no user asks for. The finer of two runs is reported: the claim is generous."""
    simulation = simulate(scene)
    parted, _ = with_parted_balls(scene)
    exact = evaluate(parted, scipy_.integrate(assemble(parted), 1e-12, needed_times(parted)))
    assert difference(parted, simulation.response, exact) <= simulation.error_estimate <= 0.01


def test_more_accuracy_is_more_work_and_less_error():
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 100.0)
    coarse, fine = simulate(scene, 0.05), simulate(scene, 1e-5)
    assert fine.cost.tolerance < coarse.cost.tolerance
    assert fine.cost.evaluations > coarse.cost.evaluations
    assert fine.error_estimate <= 1e-5


def test_units_change_neither_the_work_nor_the_answer():
    """Powers of two change no digit of a number, so that every step is the same step."""
    scene = dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 60.0)
    one, other = simulate(scene), simulate(in_units(scene, length=2.0**-10, mass=2.0**5, time=2.0**-8))
    assert other.cost.evaluations == one.cost.evaluations
    assert other.response.ball_angles == pytest.approx(one.response.ball_angles, rel=1e-12)
    assert other.response.settling_time == pytest.approx(one.response.settling_time * 2.0**-8, rel=1e-9)
    assert other.response.axis_amplitude == pytest.approx(one.response.axis_amplitude * 2.0**-10, rel=1e-9)


def test_balls_in_one_place_are_parted_and_told():
    simulation = simulate(dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 1.0), 200.0))
    assert len(simulation.warnings) == 1
    a, b = simulation.response.ball_angles
    assert abs(math.remainder(a - b, 2 * math.pi)) == pytest.approx(2 * math.pi / 3, abs=0.01)


def test_accuracy_out_of_reach_is_told(monkeypatch):
    monkeypatch.setattr(simulate_module, "difference", lambda *_: 0.3)
    with pytest.raises(NotTrustworthyError, match=r"0\.3"):
        simulate(dimensionless(3.0, 0.02, 0.02, 0.2, 0.3, (1.0, 2.5), 10.0))


@pytest.mark.parametrize("accuracy", [0.0, 1.0, math.nan])
def test_wrong_accuracies_are_refused(accuracy):
    with pytest.raises(InputError, match="accuracy"):
        simulate(without_balls(), accuracy)


def test_more_samples_on_request():
    scene = without_balls()
    times = np.linspace(0, scene.duration, 11)
    assert simulate(scene, sample_times=times.tolist()).trajectory.at(times).shape == (4, 11)
    with pytest.raises(InputError, match="within the run"):
        simulate(scene, sample_times=[scene.duration * 1.01])


def test_no_imbalance_and_no_balls_leave_no_level():
    response = simulate(replace(without_balls(), imbalance=0.0, duration=10.0)).response
    assert response.level is None
    assert response.axis_amplitude == 0.0
    assert response.settling_time == 0.0


def test_the_end_has_the_speeds_of_that_moment() -> None:
    """Beside the means: those of the last sample, by which energy can be checked from outside."""
    scene = straight_grinder()
    run = simulate(replace(scene, duration=0.1), 1e-3)
    count = len(scene.ball_masses)
    assert run.response.final.ball_rates == tuple(run.trajectory.y[-count:, -1].tolist())
    assert run.response.final.ball_rates != run.response.final.ball_speeds
