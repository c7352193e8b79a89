"""The thinned run of a page: the end is that of the result, the beginning that of the start."""

import math

import numpy as np
import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.rotor_view import MOST
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
