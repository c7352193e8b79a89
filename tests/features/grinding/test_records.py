"""Parts of a result at the work, in user units, from phasors that are known."""

import cmath
import math

import numpy as np
import pytest

from abu_calc.features.grinding.steady_contact import SteadyWork
from abu_calc.features.grinding.verdict import AxisMotion, Orbit, ProfilePoint, _nearest
from abu_calc.formulas.tilting_contact import SteadyContact

CONTACT = SteadyContact(600.0, (-2e6 + 0j, -2e6 + 0j), 0.0, 0.0)


def steady(imbalance: complex | None, runout: complex = 3e-5 + 0j) -> SteadyWork:
    return SteadyWork(CONTACT, runout, 1e-4 + 0j, imbalance)


def test_amplitudes_of_phasors_are_their_sizes() -> None:
    axis = AxisMotion.of((cmath.rect(3e-5, 1.0), cmath.rect(4e-5, -2.0)))
    assert (axis.x_amplitude_mm, axis.y_amplitude_mm) == pytest.approx((0.03, 0.04))
    assert axis.largest == pytest.approx(4e-5)
    assert AxisMotion.of(None) == AxisMotion(x_amplitude=None, y_amplitude=None) and AxisMotion.of(None).largest is None


def test_an_orbit_goes_round_an_ellipse_once() -> None:
    """On a rigid, frictionless contact X = Ω²U/D_x and Y = iE: a quarter turn apart, the axes of the ellipse."""
    state = steady(1e-4 + 0j)
    orbit = Orbit.steady("with", state)
    assert orbit is not None and orbit.points_um[0] == pytest.approx(orbit.points_um[-1])
    a, b = 1e6 * 600.0**2 * 1e-4 / 2e6, 30.0
    assert all((x / a) ** 2 + (y / b) ** 2 == pytest.approx(1.0) for x, y in orbit.points_um)
    assert Orbit.steady("with", steady(None)) is None
    through = Orbit.through("with", np.array([[1e-6, 2e-6], [0.0, -3e-6]]))
    assert through.simulated and through.points_um == (pytest.approx((1.0, 0.0)), pytest.approx((2.0, -3.0)))


def test_the_profile_averages_to_the_press_and_peaks_where_the_wheel_is_pressed() -> None:
    free, bare = steady(5e-5 + 2e-5j), steady(None)
    points = ProfilePoint.round(45.0, free, bare, {0.0: 7.0, 3.0: 9.0}, {})
    forces = [point.with_N for point in points if point.with_N is not None]
    assert len(forces) == 24 and sum(forces) / 24 == pytest.approx(45.0)
    assert free.pressure is not None
    peak = max(points, key=lambda point: point.with_N or 0.0).wheel_angle_deg
    assert abs(math.remainder(peak - math.degrees(cmath.phase(free.pressure)), 360)) <= 7.5
    assert {point.without_N for point in points} == {None} == {point.simulated_without_N for point in points}
    assert points[0].simulated_N == 7.0 and points[12].simulated_N == 9.0


def test_the_nearest_angle_is_found_across_the_turn() -> None:
    assert _nearest({0.1: 1.0, 3.0: 2.0}, math.tau - 0.1) == 1.0 and _nearest({}, 0.0) is None
