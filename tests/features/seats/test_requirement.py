"""Interference that a ring needs, and what it loses of it in service."""

import math

import pytest

from abu_calc.features.seats.interference import (
    SERIES_FACTORS,
    catalogue_smoothing_loss,
    centrifugal_loss,
    creep_interference,
    load_loss,
    smoothing_loss,
    temperature_loss,
)
from abu_calc.foundation.errors import RangeError
from abu_calc.standards.balls import Material, seat_material

STEEL = seat_material("steel")


def test_creep_interference_in_the_units_of_the_source() -> None:
    """13·R·k/(10³·b) µm with R in kN and b in m; the print's 10⁶ gives millimetres."""
    assert creep_interference(3000, 0.029, 2.8) == pytest.approx(13 * 3 * 2.8 / (1e3 * 0.029) * 1e-6, rel=1e-12)
    assert creep_interference(3000, 0.029, 2.8) == pytest.approx(13 * 3 * 2.8 / (1e6 * 0.029) * 1e-3, rel=1e-12)
    assert 1e6 * creep_interference(6000, 0.029, SERIES_FACTORS["light"]) == pytest.approx(7.53, abs=5e-3)


@pytest.mark.parametrize(("load", "length"), [(-1, 0.03), (math.nan, 0.03), (1, 0), (1, -0.01), (1, math.nan)])
def test_requirements_refuse_impossible_values(load: float, length: float) -> None:
    with pytest.raises(RangeError):
        creep_interference(load, length, 2.8)
    with pytest.raises(RangeError):
        load_loss(load, 0.08, length)


def test_heavier_series_need_less() -> None:
    assert SERIES_FACTORS["light"] > SERIES_FACTORS["medium"] > SERIES_FACTORS["heavy"]


def growth_of_spinning_disc(inner: float, outer: float, at: float, speed: float, m: Material) -> float:
    """Radial growth u = r(σ_θ − ν·σ_r)/E from the stresses of the rotating annular disc."""
    c = (3 + m.poisson_ratio) / 8 * m.density * speed**2
    radial = c * (inner**2 + outer**2 - (inner * outer / at) ** 2 - at**2)
    share = (1 + 3 * m.poisson_ratio) / (3 + m.poisson_ratio)
    hoop = c * (inner**2 + outer**2 + (inner * outer / at) ** 2 - share * at**2)
    return at * (hoop - m.poisson_ratio * radial) / m.youngs_modulus


@pytest.mark.parametrize("bore", [0.0, 0.02])
def test_centrifugal_loss_is_the_difference_of_two_growths(bore: float) -> None:
    speed, d, d1 = 1000.0, 0.080, 0.0968
    ring = growth_of_spinning_disc(d / 2, d1 / 2, d / 2, speed, STEEL)
    # a solid disc is the limit of one with a vanishing hole, taken at the rim
    shaft = growth_of_spinning_disc(max(bore, 1e-9) / 2, d / 2, d / 2, speed, STEEL)
    assert centrifugal_loss(speed, d, d1, bore, STEEL) == pytest.approx(2 * (ring - shaft), rel=1e-9)


def test_warmth_takes_nothing_from_parts_that_grow_alike() -> None:
    assert temperature_loss(0.08, (12e-6, 40.0), (12e-6, 40.0)) == 0.0
    assert temperature_loss(0.08, (12e-6, 0.0), (12e-6, 10.0)) < 0  # a shaft that is warmer grows tighter


def test_smoothing_leaves_a_clearance_as_it_is() -> None:
    assert catalogue_smoothing_loss(-5e-6, 0.08) == 0.0
    assert catalogue_smoothing_loss(41e-6, 0.08) == pytest.approx(41e-6 * (1 - 80 / 82))  # d/(d + 2) is left
    assert smoothing_loss(0.0) == 0.0


def test_four_times_the_load_takes_twice_the_interference() -> None:
    assert load_loss(4000.0, 0.08, 0.033) == pytest.approx(2 * load_loss(1000.0, 0.08, 0.033))
