"""Test wheels, the factor and K, against the numbers as the secondary source quotes them."""

import pytest

from abu_calc.foundation.errors import RangeError
from abu_calc.foundation.units import from_si, to_si
from abu_calc.standards.vibration import (
    balancing_factor,
    declared_uncertainty,
    reproducibility,
    uncertainty_source,
    usual_orientations,
)
from abu_calc.standards.vibration import (
    test_wheel as wheel_of,
)
from abu_calc.standards.vibration import (
    test_wheels as wheels,
)

QUOTED = {25: (3.6, 15), 50: (14.5, 15), 80: (18, 15), 100: (29, 30), 125: (45, 30), 150: (65, 30), 200: (115, 45)}


def test_wheels_are_those_of_the_source() -> None:
    rows = {
        round(from_si(each.diameter, "mm")): (from_si(each.imbalance, "g_mm"), each.feed_force)
        for each in wheels()
        if each.status == "secondary"
    }
    assert rows.keys() == QUOTED.keys()
    for diameter, (imbalance, force) in QUOTED.items():
        assert rows[diameter] == pytest.approx((imbalance, force), rel=1e-12)


@pytest.mark.parametrize(("diameter", "imbalance"), [(115.0, 38.088), (180.0, 93.312), (230.0, 152.352)])
def test_usual_wheels_that_no_source_lists_follow_the_rule_and_say_so(diameter: float, imbalance: float) -> None:
    wheel = wheel_of(to_si(diameter, "mm"))
    assert wheel is not None and from_si(wheel.imbalance, "g_mm") == pytest.approx(imbalance)
    assert (wheel.status, wheel.feed_force) == ("rule", None) and "within 3 %" in wheel.source


def test_the_rule_holds_the_rows_from_80_mm_alone_within_3_percent() -> None:
    off = {diameter: abs(2.88e-3 * diameter**2 / imbalance - 1) for diameter, (imbalance, _) in QUOTED.items()}
    assert all((error < 0.03) == (diameter >= 80) for diameter, error in off.items())


@pytest.mark.parametrize("diameter", [24.9, 60.0, 149.0, 178.0, 229.0])
def test_other_diameters_have_no_test_wheel(diameter: float) -> None:
    assert wheel_of(to_si(diameter, "mm")) is None


def test_sources_say_that_nobody_has_seen_the_standard() -> None:
    assert uncertainty_source()[1] == "unverified"
    assert (balancing_factor(), usual_orientations()) == (1.3, 5)


@pytest.mark.parametrize(("value", "uncertainty"), [(0.95121, 0.589), (0.862, 0.580), (1.45775, 0.639), (0.717, 0.566)])
def test_uncertainty_of_the_reference_machines(value: float, uncertainty: float) -> None:
    """Four values of a table with three digits."""
    assert declared_uncertainty(reproducibility(value)) == pytest.approx(uncertainty, abs=5e-4)


def test_a_larger_measured_spread_counts() -> None:
    assert reproducibility(1.0, 0.36) == pytest.approx(0.36)
    assert reproducibility(1.0, 0.35) == pytest.approx(0.36)


@pytest.mark.parametrize("bad", [-1.0, float("nan"), 1e9])
def test_numbers_that_are_no_accelerations_are_refused(bad: float) -> None:
    with pytest.raises(RangeError):
        reproducibility(bad)
    with pytest.raises(RangeError):
        reproducibility(1.0, bad)
