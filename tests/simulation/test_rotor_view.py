"""The thinned run of a page: the end is that of the result, the beginning that of the start.

Amplitude against speed in a run-up of one race, against an integration written out here.
"""

import cmath
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.rotor_view import MOST, MOST_POINTS, both_courses, course, until_shortly_after, without_balls
from tests.reporting.page.sized import sized


def test_thinned_run_is_the_one_that_was_made() -> None:
    result = sized()
    view, idle = result.idle_run, result.simulation[0]
    assert view is not None
    assert 100 < len(view.t_s) <= MOST
    assert (view.t_s[0], view.t_s[-1]) == (pytest.approx(0, abs=0.01), pytest.approx(idle.duration_s, abs=0.01))
    assert view.residual_g_mm[-1] == pytest.approx(idle.residual_imbalance_g_mm, rel=0.05)
    # Vectors of balls and imbalance added anew; balls sit on the pitch circle.
    one = result.autobalancer
    parts = one.ball_mass_g * one.pitch_radius_mm * np.exp(1j * np.radians(view.ball_angles_deg))
    total = parts.sum(axis=0) + result.imbalance_g_mm * np.exp(1j * math.radians(view.imbalance_angle_deg))
    assert view.residual_g_mm == pytest.approx(np.abs(total), rel=1e-6)
    # The amplitude is the largest of a window, its drift left in; the view has the last moment alone.
    radius = np.hypot(view.x_um, view.y_um)
    assert 0.4e3 * idle.axis_amplitude_mm < radius[-1] < 1.1e3 * idle.axis_amplitude_mm
    # Far above resonance the mass turns about its centre: at the start the axis goes round by the imbalance over mass.
    first = view.residual_g_mm[0] / result.effective_mass_kg
    assert radius[0] == pytest.approx(first, rel=0.3)
    # It swings, it does not drift: from one sample to the next it moves by little of that.
    assert np.max(np.hypot(np.diff(view.x_um), np.diff(view.y_um))) < 0.3 * radius.max()
    assert "idle_run" not in result.to_dict()


@pytest.mark.slow
def test_of_a_long_run_the_beginning_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same as of the run held whole, as far as it goes."""
    from abu_calc.features.simulate.study import simulate
    from abu_calc.simulation import response

    machine = read_machine("avtovaz-707-222")
    whole = simulate(machine, duration_s=0.5).view
    monkeypatch.setattr(response, "HELD", 0)
    monkeypatch.setattr(response, "BEGINNING", 300)
    first = simulate(machine, duration_s=0.5).view
    assert whole is not None and first is not None
    assert 0.15 < first.t_s[-1] < 0.2 < 0.45 < whole.t_s[-1]
    np.testing.assert_allclose(
        np.interp(first.t_s, whole.t_s, whole.residual_g_mm), first.residual_g_mm, rtol=0.02, atol=2.0
    )  # fmt: skip


def test_level_in_the_end_is_that_of_the_run_and_speed_that_of_the_run_up() -> None:
    from abu_calc.features.simulate.study import simulate

    machine = read_machine("avtovaz-707-222", ["run_up.time_s=0.2"])
    result = simulate(machine, "run-up")
    view, handles = result.view, result.handles
    assert view is not None and handles is not None and view.speed_rpm is not None
    assert view.level_db[-1] == pytest.approx(max(one.level_db for one in handles), abs=0.3)
    # At a given acceleration the speed goes up evenly.
    rising = view.t_s < 0.19
    np.testing.assert_allclose(view.speed_rpm[rising], 5800 * view.t_s[rising] / 0.2, rtol=1e-6)
    assert view.speed_rpm[-1] == pytest.approx(5800)


SPEED, UP = 60.0, 3.0
MASS, STIFFNESS, DAMPING, IMBALANCE = 4.0, 4.0 * 20.0**2, 4.0 * 2 * 0.1 * 20.0, 4e-3


def scene_of() -> Scene:
    race = Race(
        pitch_radius=0.1, ball_masses=(0.03, 0.03), drag=5.0, inertia_factor=1.4, start_angles=(2.5, 3.6),
        start_speeds=(0.0, 0.0), ball_radius=0.008,
    )  # fmt: skip
    return Scene(
        name="run-up", support=planar(MASS, (STIFFNESS, STIFFNESS), (DAMPING, DAMPING)), speed=SPEED,
        imbalance=IMBALANCE, imbalance_angle=0.0, races=(race,), duration=30.0, start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0), effects=(RunUpEffect(UP),),
    )  # fmt: skip


@pytest.mark.slow
def test_the_machine_without_balls_runs_up_as_an_own_integration_does() -> None:
    """M·r'' + c·r' + k·r = U·(Ω² − iΩ')·e^{iφ}, φ = ½·(Ω/t_u)·t²: largest distance from the mean of each revolution."""

    def turned(t: float) -> float:
        return SPEED * t**2 / (2 * UP) if t < UP else SPEED * (t - UP / 2)

    def rhs(t: float, s: list[complex]) -> list[complex]:
        rate, gain = (SPEED * t / UP, SPEED / UP) if t < UP else (SPEED, 0.0)
        force = IMBALANCE * (rate**2 - 1j * gain) * cmath.exp(1j * turned(t))
        return [s[1], (force - DAMPING * s[1] - STIFFNESS * s[0]) / MASS]

    scene = until_shortly_after(without_balls(scene_of()))
    points = course(scene, (0.0,), 0.01)
    assert points is not None and len(points) <= MOST_POINTS
    times = [k * 2 * math.pi / SPEED / 60 for k in range(int(scene.duration * SPEED / 2 / math.pi * 60))]
    own = solve_ivp(rhs, (0, times[-1]), [0j, 0j], "DOP853", times, rtol=1e-9, atol=1e-12).y[0]
    for number in (2, 5, 9, len(points) - 1):
        path = [own[k] for k, t in enumerate(times) if int(turned(t) / 2 / math.pi) == number]
        mean = sum(path) / len(path)
        assert points[number][1] == pytest.approx(max(abs(place - mean) for place in path), rel=0.03)


def test_balls_help_at_full_speed_only() -> None:
    with_balls, bare = both_courses(scene_of(), 0.02)
    assert all(slow[0] <= fast[0] + 1e-9 for slow, fast in pairwise(with_balls))
    assert with_balls[-1][0] == pytest.approx(SPEED, rel=1e-6) == bare[-1][0]
    assert with_balls[-1][1] < 0.5 * bare[-1][1]
    resonance = [max(amplitude for speed, amplitude in points if 15 < speed < 35) for points in (with_balls, bare)]
    assert resonance[0] > 0.5 * resonance[1]


def test_a_run_too_long_for_a_figure_has_none() -> None:
    assert both_courses(replace(scene_of(), effects=(RunUpEffect(3e4),), duration=4e4), 0.02) == ([], [])
