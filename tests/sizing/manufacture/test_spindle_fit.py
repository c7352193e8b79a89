"""Standard fits of bore and spindle."""

import pytest

from abu_calc.sizing.manufacture.cover import standard_fits


def test_fits_at_twenty_millimetres_by_the_rows_of_the_standard() -> None:
    """ISO 286-2, over 18 up to 30: H6 0/+13, m5 +8/+17, H7 0/+21, h6 −13/0, p6 +22/+35."""
    fits = {fit.named: fit for fit in standard_fits(20e-3)}
    assert fits["H6/m5"].eccentricity == pytest.approx(2.5e-6)
    assert fits["H7/h6"].eccentricity == pytest.approx(17e-6)
    assert fits["H7/p6"].eccentricity == 0.0
    assert fits["H6/m5"].tightest == pytest.approx(17e-6)
    assert fits["H7/p6"].loosest == pytest.approx(1e-6)


def test_fits_are_ordered_by_the_force_that_mounting_takes() -> None:
    tightest = [fit.tightest for fit in standard_fits(20e-3)]
    assert tightest == sorted(tightest)


def test_a_bore_that_outgrows_its_spindle_adds_half_of_it() -> None:
    cold, warm = standard_fits(20e-3), standard_fits(20e-3, 9e-6)
    for one, other in zip(cold, warm, strict=True):
        expected = max(0.0, one.bore.upper - one.spindle.lower + 9e-6) / 2
        assert other.eccentricity == pytest.approx(expected)


def test_no_fit_outside_the_tables() -> None:
    assert standard_fits(0.6) == () and standard_fits(0.2e-3) == ()
