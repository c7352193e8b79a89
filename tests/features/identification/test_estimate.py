"""Regression and likelihood on a bank whose distribution is known in closed form."""

import numpy as np
import pytest

from abu_calc.features.identification.bank import Bank, Box
from abu_calc.features.identification.estimate import Regression, TrackReading, end_of, inside, narrowed

CENTRES = 0.5 + 1.5 * np.linspace(0, 1, 60) ** 1.7
BOX = Box(np.array([1.0, -1.0, -10.0, -10.0]), np.array([4.0, 3.0, 10.0, 10.0]))
READING = TrackReading(CENTRES, 0.5, 40e-6, 0.2e-6, marked=True)


def track(point: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """A decay with the rate e^point₀ to −Δ, and a random amplitude that grows with the second component."""
    offset = complex(point[2], point[3]) * 1e-6
    begin = 40e-6 * np.exp(1j * rng.uniform(0, 2 * np.pi)) * (1 + 0.05 * np.exp(point[1] / 3) * rng.normal())
    return np.asarray(-offset + begin * np.exp(-np.exp(point[0]) * (CENTRES - 0.5) / 2))


@pytest.mark.slow
def test_a_known_point_is_found_within_its_interval() -> None:
    rng = np.random.default_rng(4)
    points = BOX.low + (BOX.high - BOX.low) * rng.random((800, 4))
    regression = Regression(Bank(BOX, points, np.array([track(point, rng) for point in points])), READING)
    truth = np.array([2.5, 0.5, 4.0, -3.0])
    tracks = READING.noisy(np.array([track(truth, rng) for _ in range(12)]), 1)
    features = np.array([READING.features(each) for each in tracks])
    best = regression.best(features)
    assert best.point[0] == pytest.approx(2.5, abs=0.1)
    assert best.point[2:] == pytest.approx([4.0, -3.0], abs=0.3)
    low, high = regression.interval(features, best, 0, 1.92)
    assert low < best.point[0] < high and high - low < 0.4
    assert regression.likelihood(best.point, features)[0] >= regression.likelihood(truth, features)[0]
    assert inside(best, narrowed(best, 0.5)) and not inside(best, Box(best.point, best.point + 1))
    box = narrowed(best, 0.5, complex(-4.0, 3.0))
    assert (box.low + box.high)[2:] / 2 == pytest.approx([4.0, -3.0])


def test_features_of_an_exponential_are_those_of_the_equation() -> None:
    quiet = TrackReading(CENTRES, 0.5, 40e-6, 1e-9, marked=True)
    decay = 40e-6 * np.exp(-8.0 * (CENTRES - 0.5))
    features = quiet.features(decay.astype(complex))
    # |w| falls below 50, 25, 12 % of A₀ at ln 2/8, ln 4/8, ln(1/0.12)/8; interpolated between windows.
    assert features[:3] == pytest.approx(np.log(np.log([2, 4, 1 / 0.12]) / 8), abs=0.02)
    assert abs(end_of(decay.astype(complex))) < 1e-9 and features[-1] == pytest.approx(1)


@pytest.mark.slow
@pytest.mark.parametrize("sets", [10, pytest.param(40, marks=pytest.mark.slow)])
def test_intervals_hold_the_truth_wherever_in_a_narrow_box_it_lies(sets: int) -> None:
    """Sets of eight starts at random places: a drop of 4 has room for the regression."""
    rng = np.random.default_rng(8)
    box = Box(np.array([2.2, -0.5, -4.0, -4.0]), np.array([2.7, 1.5, 4.0, 4.0]))
    points = box.low + (box.high - box.low) * rng.random((1600, 4))
    regression = Regression(Bank(box, points, np.array([track(point, rng) for point in points])), READING)
    held = []
    for number in range(sets):
        truth = box.low + (box.high - box.low) * rng.uniform(0.25, 0.75, 4)
        tracks = READING.noisy(np.array([track(truth, rng) for _ in range(8)]), number)
        features = np.array([READING.features(each) for each in tracks])
        low, high = regression.interval(features, regression.best(features), 0, 4.0)
        held.append(bool(low <= truth[0] <= high))
    assert sum(held) >= 0.85 * sets


@pytest.mark.slow
def test_a_bank_with_far_values_gives_the_means_of_the_rest() -> None:
    """One start in twenty ends 30 µm away: ends of the others are −Δ."""
    rng = np.random.default_rng(9)
    points = BOX.low + (BOX.high - BOX.low) * rng.random((800, 4))
    tracks = np.array([track(point, rng) + (30e-6 if k % 20 == 0 else 0) for k, point in enumerate(points)])
    regression = Regression(Bank(BOX, points, tracks), READING)
    means, _ = regression.distribution(np.array([2.5, 0.5, 4.0, -3.0]))
    assert means[0, 6:8] == pytest.approx([-4.0, 3.0], abs=0.3)
