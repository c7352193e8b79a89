"""Stock diameters and materials of balls."""

import math

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.standards.balls import material, seat_material, stock_diameter, stock_diameters
from abu_calc.standards.tables import toml_table


def test_stock_ascends_within_3_to_30_mm():
    stock = stock_diameters()
    assert list(stock) == sorted(set(stock))
    assert (stock[0], stock[-1]) == (0.003, 0.030)


@pytest.mark.parametrize("size", [4.762, 8, 10, 12.7, 13.494, 13.5, 15.875, 16, 19.05, 19.844, 20, 25.4])
def test_common_sizes_are_stocked(size):
    assert min(abs(d - size / 1e3) for d in stock_diameters()) < 1e-6


def test_inch_sizes_are_sixty_fourths():
    """ISO 3290 writes them to 0.01 µm."""
    for size in toml_table("balls")["inch"]:
        assert size == pytest.approx(round(size / 25.4 * 64) * 25.4 / 64, abs=1e-5)


@pytest.mark.parametrize(("given_mm", "meant"), [(19.84, 19.84375), (19.85, 19.84375), (16.0, 16.0), (4.76, 4.7625)])
def test_a_rounded_size_means_its_stock_size(given_mm, meant):
    assert stock_diameter(given_mm / 1e3) == pytest.approx(meant / 1e3, abs=1e-12)


@pytest.mark.parametrize("given_mm", [19.83, 15.7, 2.98, 31.0])
def test_other_sizes_mean_none(given_mm):
    assert stock_diameter(given_mm / 1e3) is None


@pytest.mark.parametrize(("size", "mass"), [(4.76, 0.440), (8, 2.091), (10, 4.084), (12.7, 8.366), (16, 16.728)])
def test_masses_of_steel_balls(size, mass):
    """Published masses, printed to a milligram."""
    assert 1e3 * material("steel").density * math.pi / 6 * (size / 1e3) ** 3 == pytest.approx(mass, abs=6e-4)


def test_unknown_materials_are_refused():
    with pytest.raises(InputError, match="unknown material"):
        material("glass")
    with pytest.raises(InputError, match="aluminium"):
        seat_material("aluminum")


@pytest.mark.parametrize("name", ["steel", "cast-iron", "aluminium"])
def test_seat_materials_are_sane(name):
    found = seat_material(name)
    assert 2000 < found.density < 9000
    assert 5e10 < found.youngs_modulus < 2.2e11
    assert 0.2 < found.poisson_ratio < 0.5
    assert 5e-6 < found.expansion < 3e-5
