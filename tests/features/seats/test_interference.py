"""Probabilities against drawing parts, quadrature and the makers' rule.

Interference that a ring needs, and what it loses of it in service.
"""

import math
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from abu_calc.features.seats.interference import (
    SERIES_FACTORS,
    catalogue_smoothing_loss,
    centrifugal_loss,
    clearance_probability,
    creep_interference,
    load_loss,
    probability_below,
    probable_interference,
    smoothing_loss,
    temperature_loss,
    truncated_clearance_probability,
)
from abu_calc.foundation.errors import RangeError
from abu_calc.standards.balls import Material, seat_material
from abu_calc.standards.tolerance_classes import DeviationLimits, part_limits, ring_limits, tolerance_classes
from tests.standards.test_tolerance_classes import IT, LOWER, MAIN

PAIRS = 4000


def limits(lower: float, upper: float) -> DeviationLimits:
    return DeviationLimits(lower * 1e-6, upper * 1e-6)


FIELDS = st.tuples(st.integers(-40, 40), st.integers(0, 50)).map(lambda f: limits(f[0], f[0] + f[1]))
FITS = st.one_of(
    st.tuples(st.just("shaft"), st.sampled_from(tolerance_classes("shaft")), st.floats(10.0, 250.0)),
    st.tuples(st.just("housing"), st.sampled_from(tolerance_classes("housing")), st.floats(18.5, 250.0)),
)


def of_fit(fit) -> tuple[DeviationLimits, DeviationLimits]:
    seat, name, size = fit
    part = part_limits(seat, name, size * 1e-3)
    if seat == "shaft":
        return part, ring_limits("radial", "inner", "0", size * 1e-3)
    return ring_limits("radial", "outer", "0", size * 1e-3), part


def inside(draw: random.Random, field: DeviationLimits) -> float:
    """A part that inspection lets through."""
    while True:
        size = draw.gauss(field.middle, field.tolerance / 6)
        if field.lower <= size <= field.upper:
            return size


def agrees(probability: float, loose: int) -> bool:
    """Within 3 standard errors; where next to nothing is expected, within three pairs."""
    return abs(loose - PAIRS * probability) <= max(3 * math.sqrt(PAIRS * probability * (1 - probability)), 3)


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=60)
@given(FITS)
def test_any_fit_agrees_with_drawing_parts(fit):
    male, female = of_fit(fit)
    draw = random.Random(7)
    free = sum(
        draw.gauss(male.middle, male.tolerance / 6) < draw.gauss(female.middle, female.tolerance / 6)
        for _ in range(PAIRS)
    )
    sorted_out = sum(inside(draw, male) < inside(draw, female) for _ in range(PAIRS))
    assert agrees(clearance_probability(male, female), free)
    assert agrees(truncated_clearance_probability(male, female), sorted_out)


def truncated_by_midpoints(male: DeviationLimits, female: DeviationLimits, count: int = 1500) -> float:
    """Double sum over the sorted fields; the share of females above each male by running sums."""

    def weights(field: DeviationLimits) -> list[float]:
        steps = [6 * ((i + 0.5) / count - 0.5) for i in range(count)]
        raw = [math.exp(-(z**2) / 2) for z in steps]
        return [one / sum(raw) for one in raw]

    shares, running = weights(female), [0.0]
    for one in shares:
        running.append(running[-1] + one)
    total = 0.0
    for i, weight in enumerate(weights(male)):
        place = (male.lower + (i + 0.5) / count * male.tolerance - female.lower) / female.tolerance * count
        low = min(max(place, 0.0), float(count))
        whole = min(int(low), count - 1)
        total += weight * (1 - running[whole] - (low - whole) * shares[whole])
    return total


@settings(derandomize=True, deadline=None, max_examples=25)
@given(FIELDS.filter(lambda f: f.tolerance > 0), FIELDS.filter(lambda f: f.tolerance > 0))
@pytest.mark.slow
def test_truncated_agrees_with_a_double_sum(male, female):
    """The midpoint rule with 1500 steps over 6σ is good to about 1e-6, the jumps at the limits included."""
    assert truncated_clearance_probability(male, female) == pytest.approx(
        truncated_by_midpoints(male, female), abs=2e-6 * max(1.0, male.tolerance / female.tolerance)
    )


def test_simpson_has_converged(monkeypatch):
    """Ten times the panels change nothing within 1e-7."""
    pairs = [(limits(-18, 0), limits(-28, 12)), (limits(2, 21), limits(-15, 0)), (limits(0, 40), limits(11, 13))]
    coarse = [truncated_clearance_probability(*pair) for pair in pairs]
    monkeypatch.setattr("abu_calc.features.seats.interference._PANELS", 2000)
    assert coarse == pytest.approx([truncated_clearance_probability(*pair) for pair in pairs], abs=1e-7)


def test_certain_fits_are_certain():
    assert truncated_clearance_probability(limits(11, 30), limits(-15, 0)) == 0
    assert truncated_clearance_probability(limits(-18, 0), limits(0, 40)) == 1
    assert truncated_clearance_probability(limits(-30, -20), limits(-15, 0)) == 1


@pytest.mark.parametrize(("male", "female", "expected"), [((5, 5), (0, 10), 0.5), ((0, 10), (5, 5), 0.5),
                         ((12, 12), (0, 10), 0), ((3, 3), (4, 4), 1), ((4, 4), (4, 4), 0)])  # fmt: skip
def test_exact_parts(male, female, expected):
    assert truncated_clearance_probability(limits(*male), limits(*female)) == pytest.approx(expected)


@pytest.mark.slow
@settings(derandomize=True, deadline=None)
@given(FIELDS, FIELDS, st.integers(0, 30))
def test_shifting_tighter_never_loosens(male, female, shift):
    tighter = DeviationLimits(male.lower + shift * 1e-6, male.upper + shift * 1e-6)
    assert clearance_probability(tighter, female) <= clearance_probability(male, female)
    assert truncated_clearance_probability(tighter, female) <= truncated_clearance_probability(male, female) + 1e-7
    assert 0 <= truncated_clearance_probability(male, female) <= 1 + 1e-7
    below = [probability_below(limit * 1e-6, male, female) for limit in (-20, 0, 20)]
    assert below == sorted(below)
    assert below[1] == clearance_probability(male, female)


BORE_TOLERANCE = {(0, 18): 8, (18, 30): 10, (30, 50): 12}


def outward(middle_twice: int, spread_squared: int) -> tuple[int, int]:
    """⌊(m − √s)/2⌋ and ⌈(m + √s)/2⌉ in whole numbers alone."""
    low = high = middle_twice // 2
    while middle_twice - 2 * low < 0 or (middle_twice - 2 * low) ** 2 < spread_squared:
        low -= 1
    while 2 * high - middle_twice < 0 or (2 * high - middle_twice) ** 2 < spread_squared:
        high += 1
    return low, high


@pytest.mark.parametrize("name", ["k5", "k6", "m5", "m6", "n5"])
@pytest.mark.parametrize("size", [3, 4, 6, 8, 10, 15, 18, 20, 30, 40, 50])
def test_the_makers_rule_exactly(name, size):
    """Mean ∓ √Σ(T/2)², outward, from the fundamental deviations and grades and the bores of class Normal."""
    row = next(i for i, to in enumerate(MAIN) if size <= to)
    lower, width = LOWER[name[0]][row], IT[int(name[1])][row]
    bore = next(value for (over, to), value in BORE_TOLERANCE.items() if over < size <= to)
    expected = outward(2 * lower + width + bore, width**2 + bore**2)
    part = part_limits("shaft", name, size * 1e-3)
    found = probable_interference(part, ring_limits("radial", "inner", "0", size * 1e-3))
    assert tuple(round(1e6 * one, 6) for one in found) == expected


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
