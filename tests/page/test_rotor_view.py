"""The thinned run of a page: the end is that of the result, the beginning that of the start."""

import math

import numpy as np
import pytest

from abu_calc.spec.read import read_machine
from abu_calc.studies.rotor_view import MOST
from tests.remembered import recalled


def test_thinned_run_is_the_one_that_was_made() -> None:
    result = recalled("size", read_machine("avtovaz-707-222"))
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
