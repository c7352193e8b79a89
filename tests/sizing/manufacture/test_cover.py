"""Growth of the wall round a pressed cover, by a second derivation from the displacements of two thick rings."""

import numpy as np
import pytest

from abu_calc.formulas.press_fit import SMOOTHING
from abu_calc.sizing.manufacture.cover import axial_load, cover_rings, seat_growth
from tests.reporting.drawings.samples import result


def displaced(young: float, poisson: float, inner: float, outer: float, p_in: float, p_out: float, r: float) -> float:
    """Radial displacement A·r + B/r of a ring in plane stress, A and B from the pressures at its edges."""
    a, b = young / (1 - poisson), young / (1 + poisson)
    constants = np.linalg.solve([[a, -b / inner**2], [a, -b / outer**2]], [-p_in, -p_out])
    return float(constants[0] * r + constants[1] / r)


@pytest.mark.parametrize("name", ["one-piece", "tiny", "thick wall"])
@pytest.mark.parametrize("interference", [10e-6, 37e-6, 80e-6])
def test_the_wall_grows_by_its_share_of_the_interference(name: str, interference: float) -> None:
    parts = result(name).parts
    inside, outside = cover_rings(parts)
    r, left = outside.inner, (interference - SMOOTHING) / 2
    unit = 1e6
    out = displaced(outside.material.modulus, outside.material.poisson, r, outside.outer, unit, 0.0, r)
    back = displaced(inside.material.modulus, inside.material.poisson, inside.inner, r, 0.0, unit, r)
    wanted = 2 * out * left / (out - back)
    assert seat_growth(parts, interference) == pytest.approx(wanted, rel=1e-9)
    assert 0 < seat_growth(parts, interference) < interference


def test_clearance_widens_nothing() -> None:
    assert seat_growth(result("one-piece").parts, 0.0) == 0.0


def test_a_cover_is_pushed_by_all_balls_together_or_by_the_shock_of_handling() -> None:
    """Four balls of 100 N at a slope of one half are 200 N; 50 g on 1 kg are 490 N."""
    assert axial_load(4, 100.0, 0.5, 0.1) == pytest.approx(200.0)
    assert axial_load(8, 100.0, 0.5, 0.1) == pytest.approx(400.0)
    assert axial_load(4, 100.0, 0.5, 1.0) == pytest.approx(50 * 9.80665)
