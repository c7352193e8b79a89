"""Clearance after mounting against Monte Carlo, over joints whose fits cross zero."""

import numpy as np
import pytest

from abu_calc.features.seats.clearance import Mounting
from abu_calc.features.seats.joints import housing_joint, shaft_joint
from abu_calc.features.seats.seats import seat_bearing
from abu_calc.standards.bearing_catalogue import bearing as dimensions
from abu_calc.standards.bearing_catalogue import radial_clearance
from abu_calc.standards.tolerance_classes import part_limits, ring_limits
from tests.features.seats.samples import bearing, by_designation

SAMPLES, JOINTS = 400_000, 30
NAMES = ("608", "6000", "6203", "6205", "6208", "6212", "6216", "6304", "6307", "6311", "6315", "6320")
SHAFTS = ("h5", "h6", "js5", "js6", "j5", "j6", "k5", "k6", "m5")
HOUSINGS = ("H7", "J6", "J7", "JS6", "JS7", "K6", "K7", "M7", "N7")
GROUPS = ("C2", "CN", "C3", "C4")


def drawn(rng: np.random.Generator) -> list[np.ndarray]:
    """Normal numbers in strata, shuffled: of shaft or ring and of housing or ring in one each, and of the clearance."""
    from scipy.special import ndtri

    places = (np.arange(SAMPLES) + 0.5) / SAMPLES
    return [rng.permutation(ndtri(places)) for _ in range(5)]


@pytest.mark.slow
def test_ends_and_means_of_random_joints_agree_with_monte_carlo():
    """Within 0.3 µm at the 0.135 % and 99.865 % ends; each raceway takes q·max(interference − losses, 0), q the ring's
    ratio as a plain tube, on solid steel shafts and in endless steel housings."""
    rng = np.random.default_rng(14)
    normal, worst, crossed = drawn(rng), 0.0, 0
    for _ in range(JOINTS):
        name, shaft, housing, group = (str(rng.choice(one)) for one in (NAMES, SHAFTS, HOUSINGS, GROUPS))
        rough, warm, inside = float(rng.uniform(0, 4)), float(rng.uniform(-10, 10)), float(rng.uniform(0, 8))
        given = by_designation(name, shaft_fit=shaft, housing_fit=housing, internal_clearance=group, shaft_rz_um=rough,
                               ring_temperature_difference_K=warm, raceway_temperature_difference_K=inside)  # fmt: skip
        left = seat_bearing(given).clearance
        size = dimensions(name)
        d, D = size.bore, size.outer
        d1, D1 = d + 0.28 * (D - d), D - 0.28 * (D - d)
        parts = [part_limits("shaft", shaft, d), ring_limits("radial", "inner", "0", d),
                 ring_limits("radial", "outer", "0", D), part_limits("housing", housing, D),
                 radial_clearance(group, d)]  # fmt: skip
        a, b, c, e, start = (
            (low + high) / 2 + (high - low) / 6 * one for (low, high), one in zip(parts, normal, strict=True)
        )
        inner, outer = a - b - 0.4e-6 * rough - 12e-6 * d * warm, c - e
        crossed += bool((inner < 0).any() and (inner > 0).any()) or bool((outer < 0).any() and (outer > 0).any())
        taken = d / d1 * np.maximum(inner, 0) + D1 / D * np.maximum(outer, 0)
        kept = start - taken - 12e-6 * (d1 + D1) / 2 * inside
        ends = np.quantile(kept, [0.00135, 0.99865])
        worst = max(worst, *(abs(1e6 * (one - other)) for one, other in zip(ends, left.probable, strict=True)))
        assert 1e6 * left.mean == pytest.approx(1e6 * kept.mean(), abs=0.02)
        assert left.below_zero_probability == pytest.approx((kept < 0).mean(), abs=0.002)
    assert crossed > 0.9 * JOINTS
    assert worst < 0.3


def test_the_case_of_record():
    """6205, k5/J7, C3: 2.0 … 20.7 µm by Monte Carlo; the middle of the clipped span gave −1.2 … 18.6."""
    left = seat_bearing(by_designation("6205", shaft_fit="k5", housing_fit="J7", internal_clearance="C3")).clearance
    assert [1e6 * end for end in left.probable] == pytest.approx([2.0, 20.7], abs=0.06)


def test_warmth_that_loosens_a_ring_gives_its_growth_back():
    """m6 keeps its grip at 10 K: the raceway shrinks by d/d₁·α·d·ΔT and the clearance grows by it."""
    plain, warm = (
        seat_bearing(by_designation("6216", shaft_fit="m6", internal_clearance="C3", ring_temperature_difference_K=one))
        for one in (0.0, 5.0)
    )
    expected = 80 / (80 + 0.28 * 60) * 12e-6 * 0.080 * 5
    assert warm.clearance.mean - plain.clearance.mean == pytest.approx(expected, rel=1e-3)


def test_shares_add_up_and_rise():
    given = bearing(bearing_type="ball", shaft_fit="k6", housing_fit="K7")
    mounting = Mounting(given, shaft_joint(given), housing_joint(given))
    assert sum(share for _, share in mounting.law) == pytest.approx(1, abs=1e-6)
    shares = [mounting.share_below("CN", 1e-6 * one) for one in range(-60, 61, 5)]
    assert (
        shares == sorted(shares)
        and shares[0] == pytest.approx(0, abs=1e-6)
        and shares[-1] == pytest.approx(1, abs=1e-6)
    )
    assert mounting.share_below("C2") > mounting.share_below("CN") > mounting.share_below("C3")
