"""Amplitude against speed in a run-up of one race, against an integration written out here."""

import cmath
import math
from dataclasses import replace
from itertools import pairwise

import pytest
from scipy.integrate import solve_ivp

from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.rotor import Race
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.supports.planar import planar
from abu_calc.simulation.rotor_view import MOST_POINTS, both_courses, course, until_shortly_after, without_balls

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
