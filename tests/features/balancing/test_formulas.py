"""Formulas of two planes against matrices, derivatives and the printed source."""

import math

import numpy as np
import pytest

from abu_calc.features.balancing.formulas import (
    condition_number,
    displacement,
    imbalances,
    influence,
    published_answer,
)
from tests.features.balancing.rig import Workshop, shown
from tests.features.balancing.test_methods import OMEGA, QUANTITIES, RADII, ROLL, run_of


def test_the_condition_number_is_that_of_the_matrix() -> None:
    for hz in (5.0, 13.0, 21.0, 50.0):
        matrix = influence(ROLL, math.tau * hz)
        assert condition_number(matrix) == pytest.approx(np.linalg.cond(np.array(matrix)), rel=1e-9)
    assert condition_number(((1, 1), (1, 1))) == math.inf


def test_the_printed_formula_taken_at_its_word_doubles_the_vibration() -> None:
    """Carried out on the simulated rig, the masses brought back to scale: twice the vibration instead of none."""
    shop = Workshop(quantity="acceleration")
    run = run_of(shop)
    worse = shop
    for plane, (mass, angle) in enumerate(published_answer(ROLL, OMEGA, run.readings, RADII)):
        worse = worse.put_on(plane, -1e3 * mass / OMEGA**2, math.degrees(angle))
    assert np.abs(worse.motion()) == pytest.approx(2 * np.abs(shop.motion()), rel=1e-9)


def test_the_printed_arctan_loses_the_quadrant() -> None:
    shop = Workshop(masses=(10.0, 7.0), angles=(200.0, 90.0))
    (mass, angle), (_, other) = published_answer(ROLL, OMEGA, run_of(shop).readings, RADII)
    assert (1e3 * mass, math.degrees(angle)) == pytest.approx((-10.0, 20.0), rel=1e-9)
    assert abs(math.degrees(other)) == pytest.approx(90.0, abs=1e-6)
    (_, none), _ = published_answer(ROLL, OMEGA, (0j, 0j), RADII)
    assert math.isnan(none)


def test_readings_are_derivatives_of_the_displacement() -> None:
    motion = np.array([1e-5 * np.exp(1j), 2e-5 * np.exp(-2j)])
    for quantity in QUANTITIES:
        scale = 1.0 if quantity == "acceleration" else 1e-3
        for (amplitude, phase), true in zip(shown(motion, quantity, 80.0), motion, strict=True):
            assert displacement(quantity, amplitude * scale, math.radians(phase), 80.0) == pytest.approx(
                true, rel=1e-12
            )
    assert imbalances(ROLL, OMEGA, (0j, 0j)) == (0j, 0j)
