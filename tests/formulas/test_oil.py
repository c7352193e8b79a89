"""Oil in a race: examples of the standards, second derivations, and limits."""

import math

import numpy as np
import pytest

from abu_calc.formulas.oil import (
    INDEX_CURVES,
    OilRace,
    oil_depth,
    oil_drag_rate,
    oil_viscosity,
    rolling_drag_coefficient,
    viscosity_at_100,
    viscosity_index,
)
from abu_calc.foundation.errors import RangeError
from tests.rows import for_each

RACE = OilRace(31e-3, 24.4e-3, 16.5e-3, 12.5e-3, 4, 7.9375e-3)


def test_viscosity_indices_are_those_of_the_examples_of_the_standard() -> None:
    # ASTM D2270, examples of procedures A and B.
    assert round(viscosity_index(73.30, 8.86)) == 92
    assert round(viscosity_index(22.83, 5.05)) == 156


# Table 1 of ASTM D2270 (viscosity at 100 °C, L, H) as the open package chemicals 1.x transcribes it.
TABLE = (
    (2.0, 7.994, 6.394), (3.0, 15.49, 12.15), (3.8, 23.13, 17.97), (4.0, 25.32, 19.56), (4.7, 35.13, 25.63),
    (5.5, 49.09, 33.34), (6.6, 69.16, 44.24), (6.8, 73.48, 46.44), (7.3, 84.53, 51.78), (8.0, 100.0, 59.6),
    (10.0, 147.7, 82.87), (12.0, 201.9, 108.0), (14.0, 263.3, 135.4), (17.0, 369.4, 180.2), (20.0, 493.2, 229.5),
    (25.0, 736.5, 320.9), (30.0, 1023.0, 421.7), (35.0, 1356.0, 532.5), (45.0, 2152.0, 780.9), (50.0, 2618.0, 919.6),
    (60.0, 3676.0, 1222.0), (70.0, 4905.0, 1558.0),
)  # fmt: skip


@for_each(TABLE)
def test_curves_of_the_index_are_those_of_the_table(at_100: float, low: float, high: float) -> None:
    """Oils of index 0 and 100 by definition; the table is rounded, and smoothed unlike its polynomials."""
    assert viscosity_index(low, at_100) == pytest.approx(0, abs=1.0)
    assert viscosity_index(high, at_100) == pytest.approx(100, abs=1.0)


def test_the_usual_hydraulic_oil_has_the_viscosity_between_rows_of_the_table() -> None:
    """46 mm²/s at 40 °C. Index 100: H is 45.33 at 6.7 and 46.44 at 6.8. Index 95: L − 0.95·(L − H) at 6.6 and 6.7."""
    by_hand = 6.7 + 0.1 * (46 - 45.33) / (46.44 - 45.33)
    assert viscosity_at_100(46.0, 100.0) == pytest.approx(by_hand, abs=0.02)
    low, high = 69.16 - 0.95 * (69.16 - 44.24), 71.29 - 0.95 * (71.29 - 45.33)
    assert viscosity_at_100(46.0, 95.0) == pytest.approx(6.6 + 0.1 * (46 - low) / (high - low), abs=0.02)


@pytest.mark.parametrize("place", range(1, len(INDEX_CURVES)))
def test_curves_of_the_index_meet(place: int) -> None:
    """A digit typed wrongly would tear the curve."""
    joint = INDEX_CURVES[place][0]
    for part in (1, 4):
        before, after = (float(np.polyval(INDEX_CURVES[k][part : part + 3], joint)) for k in (place - 1, place))
        assert after == pytest.approx(before, rel=3e-3)


@pytest.mark.parametrize("at_40", [10.0, 46.0, 220.0, 680.0])
@pytest.mark.parametrize("index", [60.0, 95.0, 100.0, 140.0])
def test_viscosity_at_100_inverts_the_index(at_40: float, index: float) -> None:
    assert viscosity_index(at_40, viscosity_at_100(at_40, index)) == pytest.approx(index, abs=0.5)


def test_the_line_of_walther_is_straight_in_its_own_scale() -> None:
    def scale(viscosity: float) -> float:
        return math.log(math.log(viscosity + 0.7))

    known = {t: scale(oil_viscosity(t, 46.0, 6.7)) for t in (5.0, 40.0, 80.0, 100.0)}
    logs = {t: math.log(t + 273.15) for t in known}
    slope = (known[100.0] - known[40.0]) / (logs[100.0] - logs[40.0])
    assert known[40.0] == pytest.approx(scale(46.0)) and known[100.0] == pytest.approx(scale(6.7))
    for t in (5.0, 80.0):
        assert known[t] == pytest.approx(known[40.0] + slope * (logs[t] - logs[40.0]))


def test_a_shallow_ring_has_the_volume_of_its_segment() -> None:
    depth, speed = oil_depth(0.5e-6, OilRace(31e-3, 24.4e-3, 16.5e-3, 12.5e-3, 0, 8e-3), 600.0), 600.0
    half = math.acos(1 - depth / 24.4e-3)
    segment = 24.4e-3**2 * (half - math.sin(half) * math.cos(half))
    assert segment * 2 * math.pi * (31e-3 - 0.4 * depth) == pytest.approx(0.5e-6, rel=0.01)
    assert oil_depth(0.5e-6, RACE, speed) > depth  # balls displace oil
    depths = [oil_depth(fill * 1e-6, RACE, speed) for fill in (0.2, 1.0, 5.0, 15.0)]
    assert depths == sorted(depths)


def test_branches_of_the_drag_coefficient_meet_and_fall() -> None:
    for joint in (10.0, 20_000.0):
        assert rolling_drag_coefficient(joint * 0.999) == pytest.approx(
            rolling_drag_coefficient(joint * 1.001), rel=0.01
        )
    values = [rolling_drag_coefficient(float(re)) for re in np.geomspace(0.01, 2e4, 60)]
    assert values == sorted(values, reverse=True)


def test_a_ball_wholly_in_oil_has_the_rate_of_its_definition() -> None:
    """Force over mass and slip; practice by Stokes with a wall factor of 5 gives 3, 17, 47 1/s: within 1.7."""
    radius, mass, density, viscosity = 8e-3, 16.7e-3, 870.0, 46.0
    for slip, usual in ((0.02, 3.0), (1.0, 17.0), (5.0, 47.0)):
        reynolds = 2 * radius * slip / 46e-6
        force = rolling_drag_coefficient(reynolds) * density / 2 * slip**2 * math.pi * radius**2
        rate = oil_drag_rate(slip, viscosity, density, 2 * radius, radius, mass)
        assert rate == pytest.approx(force / (mass * slip)) and max(rate / usual, usual / rate) < 1.7


def test_drag_grows_with_depth_viscosity_and_slip() -> None:
    def rate(slip: float = 0.5, viscosity: float = 46.0, depth: float = 2e-3) -> float:
        return oil_drag_rate(slip, viscosity, 870.0, depth, 8e-3, 16.7e-3)

    for name, values in (
        ("depth", (1e-7, 1e-6, 1e-4, 1e-3, 8e-3, 16e-3)), ("viscosity", (5.0, 46.0, 400.0)), ("slip", (1.0, 5.0, 20.0)),
    ):  # fmt: skip
        rates = [rate(**{name: value}) for value in values]
        assert rates == sorted(rates) and rates[-1] > rates[0]
    assert rate(depth=1e-7) < 0.01 * rate()
    assert rate(depth=30e-3) == rate(depth=16e-3)


def test_values_outside_the_ranges_are_refused() -> None:
    for call in (
        lambda: oil_viscosity(130.0, 46.0, 6.7),
        lambda: oil_viscosity(math.nan, 46.0, 6.7),
        lambda: oil_viscosity(120.0, 5.0, 2.0),
        lambda: viscosity_at_100(4.0, 95.0),
        lambda: viscosity_at_100(46.0, 300.0),
        lambda: oil_depth(1e-6, RACE, 20.0),
        lambda: rolling_drag_coefficient(0.0),
        lambda: rolling_drag_coefficient(1e6),
    ):
        with pytest.raises(RangeError):
            call()
