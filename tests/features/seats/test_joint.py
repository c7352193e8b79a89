"""Interference, requirement and stress, each against a second route."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.features.seats.interference import clearance_probability, probable_interference, theoretical_interference
from abu_calc.features.seats.joint import Tube, contact_pressure, inner_ring_stress, outer_ring_stress
from abu_calc.features.seats.notes import advised_class
from abu_calc.foundation.errors import RangeError
from abu_calc.standards.balls import Material, seat_material
from abu_calc.standards.tolerance_classes import DeviationLimits

STEEL = seat_material("steel")
ALUMINIUM = seat_material("aluminium")


def limits(lower: float, upper: float) -> DeviationLimits:
    return DeviationLimits(lower * 1e-6, upper * 1e-6)


FIELDS = st.tuples(st.integers(-60, 60), st.integers(1, 60)).map(lambda f: limits(f[0], f[0] + f[1]))


def density(x: float, field: DeviationLimits) -> float:
    sigma = field.tolerance / 6
    return math.exp(-(((x - field.middle) / sigma) ** 2) / 2) / (sigma * math.sqrt(2 * math.pi))


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=60)
@given(FIELDS, FIELDS)
def test_probability_agrees_with_quadrature(male, female):
    """P = ∫ f_male(x)·P(female > x) dx by the midpoint rule over ±9σ, P(female > x) summed along the way."""
    low = min(one.middle - 1.5 * one.tolerance for one in (male, female))
    high = max(one.middle + 1.5 * one.tolerance for one in (male, female))
    step = min(male.tolerance, female.tolerance) / 60
    count = math.ceil((high - low) / step)
    larger, probability = 1.0, 0.0
    for i in range(count):
        x = low + (i + 0.5) * step
        half = density(x, female) * step / 2
        probability += density(x, male) * step * (larger - half)
        larger -= 2 * half
    assert clearance_probability(male, female) == pytest.approx(probability, abs=1e-4)


def test_the_tail_is_exact():
    """No digits are lost far out: erfc(x) → e^(−x²)/(x√π)·(1 − 1/(2x²) + …) there."""
    male, female = limits(100, 130), limits(-40, 0)  # mean 135, σ = 25/3: 16.2σ
    x = 135 / (25 / 3) / math.sqrt(2)
    series = math.exp(-(x**2)) / (2 * x * math.sqrt(math.pi)) * (1 - 1 / (2 * x**2) + 3 / (4 * x**4))
    assert clearance_probability(male, female) == pytest.approx(series, rel=1e-4)


def test_parts_without_tolerance():
    assert clearance_probability(limits(0, 0), limits(1, 1)) == 1
    assert clearance_probability(limits(0, 0), limits(0, 0)) == 0


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(FIELDS, FIELDS)
def test_intervals_are_ordered_and_complete(male, female):
    extreme, probable = theoretical_interference(male, female), probable_interference(male, female)
    corners = [m - f for m in (male.lower, male.upper) for f in (female.lower, female.upper)]
    assert extreme.smallest == pytest.approx(min(corners), abs=1e-12)
    assert extreme.largest == pytest.approx(max(corners), abs=1e-12)
    for found, exact in ((probable.smallest, extreme.smallest), (-probable.largest, -extreme.largest)):
        assert found >= exact - 0.5e-6 - 1e-12  # outward to whole µm may pass the corner of half a µm
        assert 1e6 * found == pytest.approx(round(1e6 * found), abs=1e-6)


@pytest.mark.parametrize(("shaft", "expected"), [((2, 18), (6, 26)), ((9, 25), (13, 33))])
def test_probable_interference_of_the_bearing_makers(shaft, expected):
    """Published rows, shafts 30–50 mm k6 and m6, bore 0/−12, in whole µm."""
    found = probable_interference(limits(*shaft), limits(-12, 0))
    assert (1e6 * found.smallest, 1e6 * found.largest) == pytest.approx(expected)


def displacement(r: float, a: float, b: float, inside: float, outside: float, m: Material) -> float:
    """Lamé's radial displacement of a tube a … b under pressures inside and outside (a = 0: solid)."""
    mean = (inside * a**2 - outside * b**2) / (b**2 - a**2)
    swing = (inside - outside) * a**2 * b**2 / (b**2 - a**2)
    nu = m.poisson_ratio
    return ((1 - nu) * mean * r + (1 + nu) * swing / r) / m.youngs_modulus


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(st.floats(0.0, 0.9), st.floats(0.1, 0.95), st.sampled_from([STEEL, ALUMINIUM]))
def test_the_pressed_parts_close_the_interference(inner_ratio, outer_ratio, material):
    d, interference = 0.080, 40e-6
    male, female = Tube(inner_ratio, STEEL), Tube(outer_ratio, material)
    pressure = contact_pressure(interference, d, male, female)
    bore, outside = inner_ratio * d, d / outer_ratio
    widened = displacement(d / 2, d / 2, outside / 2, pressure, 0, material)
    squeezed = displacement(d / 2, bore / 2, d / 2, 0, pressure, STEEL)
    assert 2 * (widened - squeezed) == pytest.approx(interference, rel=1e-9)


def test_ring_on_a_solid_shaft_of_its_own_steel():
    """E·δ·(1+q²)/(2d), and Lamé's 184.6 µm for 400 MPa, printed with q to three digits."""
    ring = Tube(0.826, STEEL)
    stress = inner_ring_stress(45e-6, 0.080, Tube(0.0, STEEL), ring)
    assert stress == pytest.approx(206e9 * 45e-6 * (1 + 0.826**2) / 0.160, rel=1e-12)
    assert 45 * 400e6 / stress == pytest.approx(184.6, abs=0.2)


def test_outer_ring_in_an_endless_housing():
    """E·δ/(D·(1−q²)) for one steel: p = E·δ/(2D)·(1−q²) of the mirror joint, hoop 2p/(1−q²)."""
    ring = Tube(0.85, STEEL)
    found = outer_ring_stress(30e-6, 0.140, ring, Tube(0.0, STEEL))
    pressure = 206e9 * 30e-6 / 0.140 * (1 - 0.85**2) / 2
    assert found == pytest.approx(2 * pressure / (1 - 0.85**2), rel=1e-12)
    assert outer_ring_stress(30e-6, 0.140, ring, Tube(0.8, STEEL)) < found
    assert outer_ring_stress(30e-6, 0.140, ring, Tube(0.0, ALUMINIUM)) < found


def test_clearance_presses_nothing():
    assert contact_pressure(-10e-6, 0.080, Tube(0.0, STEEL), Tube(0.8, STEEL)) == 0


@pytest.mark.parametrize("ratio", [1.0, -0.1, math.nan])
def test_impossible_tubes_are_refused(ratio):
    with pytest.raises(RangeError):
        contact_pressure(10e-6, 0.080, Tube(0.0, STEEL), Tube(ratio, STEEL))


@pytest.mark.parametrize(
    ("seat", "diameter", "intensity", "expected"),
    [("shaft", 80, 300, "js6"), ("shaft", 80, 301, "k6"), ("shaft", 80.1, 301, "js6"), ("shaft", 50, 3001, None),
     ("shaft", 18, 1, None), ("housing", 140, 1200, "N7"), ("housing", 1601, 1, None)],
)  # fmt: skip
def test_handbook_advice(seat, diameter, intensity, expected):
    assert advised_class(seat, diameter / 1e3, intensity * 1e3) == expected
