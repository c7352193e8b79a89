"""The verdict at the work in words: remedies with their levels, reasons that fit the numbers.

Parts of a result at the work, in user units, from phasors that are known.
"""

import cmath
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from abu_calc.features.grinding.steady_contact import SteadyWork
from abu_calc.features.grinding.verdict import (
    NOTHING,
    AxisMotion,
    Orbit,
    ProfilePoint,
    _nearest,
    changes,
    in_words,
    shortest,
)
from abu_calc.features.grinding.work import TriedRemedy
from abu_calc.formulas.tilting_contact import SteadyContact

LEVELS: Any = SimpleNamespace(before=111.04, after=104.96)
RUNOUT = TriedRemedy(runout=2e-5, level_before_db=111.04, level_after_db=104.96)
STIFFNESS = TriedRemedy(contact_stiffness=4.5e5, level_before_db=111.04, level_after_db=104.96)
PRESS = TriedRemedy(press_force=90.0, level_before_db=111.04, level_after_db=104.96)


def side(**values: Any) -> SimpleNamespace:
    steady = SimpleNamespace(balls=None, amplitude=None, reaction=None)
    return SimpleNamespace(
        **({"scatter": 0.0, "parts": False, "failure": None, "run": None, "steady": steady} | values)
    )


def work(**values: Any) -> Any:
    face = SimpleNamespace(contact=SimpleNamespace(contact="face", press_force=45.0))
    usual = {
        "levels": LEVELS, "lowered": True, "always": True, "fitted": side(), "without": side(), "at_once": side(),
        "design": SimpleNamespace(case=face), "level_at_once": 104.96, "stays_loud": False,
    }  # fmt: skip
    return SimpleNamespace(**(usual | values))


def test_each_remedy_says_its_bound_and_its_levels() -> None:
    text = changes((RUNOUT, STIFFNESS, PRESS))
    assert "Reduce wheel.runout_mm to 0.02: 105.0 dB at most, 111.0 dB without." in text
    assert "Reduce grinding.contact_stiffness_N_per_m to 4.5e5: " in text
    assert shortest((PRESS, RUNOUT)) == (
        "Raise grinding.press_force_N to 90: loudest case 105.0 dB, without autobalancer 111.0 dB (simulated)."
    )
    assert changes(()) == "" and shortest(()) is None


def test_a_machine_that_is_quieter_in_every_case_needs_no_remedy() -> None:
    words = in_words(work(), ())
    assert words.startswith("The autobalancer helps under load: 105.0 dB with it, 111.0 dB without. A face ")
    assert NOTHING not in words and "pressed" not in words


def test_a_start_that_stays_loud_is_told_with_what_prevents_it() -> None:
    loud = work(
        always=False, level_at_once=119.6, stays_loud=True, at_once=side(run=SimpleNamespace(duration=6.0), parts=True)
    )
    words = in_words(loud, (RUNOUT,))
    assert "keep bouncing at 119.6 dB, still after 6 s." in words and "Reduce wheel.runout_mm to 0.02: " in words
    unknown = work(always=None, level_at_once=None, at_once=side(failure="too much work"))
    assert "Pressed before the balls have settled: not known, too much work." in in_words(unknown, ())
    assert in_words(unknown, ()).endswith(NOTHING)


def test_levels_within_their_scatter_are_not_told_apart() -> None:
    words = in_words(work(lowered=None, fitted=side(scatter=4.0), without=side(scatter=3.0)), ())
    assert (
        "not known whether the autobalancer helps under load: 105.0 ± 4.0 dB with it and 111.0 ± 3.0 dB without differ"
        in words
    )


@pytest.mark.parametrize(
    ("failure", "said"), [("chaotic", "no simulation can be trusted, chaotic"), (None, "no method of calculation")]
)
def test_a_level_that_is_missing_has_its_reason(failure: str | None, said: str) -> None:
    missing = work(lowered=None, levels=SimpleNamespace(before=None, after=104.0), fitted=side(failure=failure))
    assert said in in_words(missing, ())


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
