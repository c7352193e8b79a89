"""Clearance left in roller bearings and in pairs, against Monte Carlo; the preload of pairs."""

import math

import numpy as np
import pytest

from abu_calc.features.seats.seats import seat_bearing
from abu_calc.foundation.errors import InputError
from abu_calc.standards.bearing_catalogue import bearing as dimensions
from abu_calc.standards.internal_clearance import groups_of, internal_clearance, pair_preload, usual_group
from abu_calc.standards.tolerance_classes import part_limits, ring_limits
from tests.features.seats.samples import by_designation

SAMPLES, JOINTS = 300_000, 24
NAMES = ("NU208", "NJ310", "NU2212", "22210", "22316", "NA4906", "30208", "32212", "31308", "7208B", "7310B")
SHAFTS = ("h5", "j6", "k5", "k6", "m5", "m6", "n6", "p6")
HOUSINGS = ("H7", "J7", "K7", "M7", "N7", "P7")


@pytest.mark.slow
def test_rollers_and_pairs_agree_with_monte_carlo() -> None:
    """Within 0.3 µm at the ends. Each raceway takes q·max(interference, 0); a pair of 40° loses that over tan 40°."""
    from scipy.special import ndtri

    rng = np.random.default_rng(35)
    places = (np.arange(SAMPLES) + 0.5) / SAMPLES
    normal, worst = [rng.permutation(ndtri(places)) for _ in range(5)], 0.0
    for _ in range(JOINTS):
        name, shaft, housing = (str(rng.choice(one)) for one in (NAMES, SHAFTS, HOUSINGS))
        size = dimensions(name)
        group = str(rng.choice(groups_of(size.kind)))
        left = seat_bearing(
            by_designation(name, shaft_fit=shaft, housing_fit=housing, internal_clearance=group)
        ).clearance
        assert left is not None and left.axial == (size.kind == "angular-contact")
        d, D = size.bore, size.outer
        d1, D1 = d + 0.28 * (D - d), D - 0.28 * (D - d)
        parts = [part_limits("shaft", shaft, d), ring_limits(size.type, "inner", "0", d),
                 ring_limits(size.type, "outer", "0", D), part_limits("housing", housing, D),
                 internal_clearance(size.kind, group, d)]  # fmt: skip
        a, b, c, e, start = (
            (low + high) / 2 + (high - low) / 6 * one for (low, high), one in zip(parts, normal, strict=True)
        )
        taken = d / d1 * np.maximum(a - b, 0) + D1 / D * np.maximum(c - e, 0)
        kept = start - taken / (math.tan(math.radians(40)) if left.axial else 1)
        ends = np.quantile(kept, [0.00135, 0.99865])
        worst = max(worst, *(abs(1e6 * (one - other)) for one, other in zip(ends, left.probable, strict=True)))
        assert left.below_zero_probability == pytest.approx((kept < 0).mean(), abs=0.003)
    assert worst < 0.3


def test_groups_of_rollers_are_those_of_the_standard() -> None:
    """ISO 5753-1 as a maker's page prints it (cylindrical, 50 mm), and SKF 2006 (spherical, 100 mm)."""
    assert [
        tuple(round(1e6 * end) for end in internal_clearance("cylindrical", group, 0.050))
        for group in groups_of("cylindrical")
    ] == [(5, 35), (30, 60), (50, 80), (70, 100), (95, 125)]
    assert [
        tuple(round(1e6 * end) for end in internal_clearance("spherical", group, 0.100))
        for group in groups_of("spherical")
    ] == [(35, 60), (60, 100), (100, 135), (135, 180), (180, 225)]
    assert internal_clearance("needle", "C3", 0.03) == internal_clearance("cylindrical", "C3", 0.03)


@pytest.mark.parametrize("kind", ["ball", "cylindrical", "spherical", "tapered", "needle"])
def test_groups_ascend(kind) -> None:
    for bore in (0.025, 0.05, 0.1, 0.19):
        rows = [internal_clearance(kind, group, bore) for group in groups_of(kind)]
        assert rows == sorted(rows) and all(low < high for low, high in rows)


def test_preload_rises_as_the_clearance_falls_and_meets_the_table() -> None:
    """SKF, 30 … 50 mm: GA 0 … 160 N at −4 µm, GB 330 … 630 at −10, GC 1280 at −16 (ends of the groups)."""
    loads = [pair_preload(-1e-6 * um, 0.040) for um in range(0, 30)]
    assert loads == sorted(loads) and loads[0] == 0
    assert [loads[4], loads[10], loads[16]] == pytest.approx([160, 630, 1280])
    assert pair_preload(-5e-6, 0.3) is None


@pytest.mark.parametrize(("shaft", "status"), [("h5", "pass"), ("k5", "warn"), ("p6", "fail")])
def test_a_pair_s_preload_is_judged_after_mounting(shaft: str, status: str) -> None:
    """7208B, GA: every µm of raceway growth takes 1.19 µm of axial clearance."""
    found = seat_bearing(
        by_designation("7208B", radial_load_kN=1.0, internal_clearance="GA", shaft_fit=shaft, housing_fit="H7")
    )
    check = next(check for check in found.checks if check.code == "ABU621")
    assert check.status == status and check.unit == "N" and found.clearance is not None
    assert found.clearance.preload is not None and found.clearance.preload[1] == pytest.approx(check.value, abs=0.1)


def test_a_group_of_another_type_is_refused() -> None:
    for name, group in (("NU208", "CA"), ("7208B", "C3"), ("HK2016", "C3"), ("6205", "GA")):
        with pytest.raises(InputError, match="clearance group"):
            seat_bearing(by_designation(name, internal_clearance=group))
    assert usual_group("angular-contact") == "CB" and usual_group("cylindrical") == "CN"
