"""Passages of a mark whose times are known by construction."""

import numpy as np
import pytest

from abu_calc.features.balancing.recorded_run import passages, smooth
from abu_calc.foundation.errors import InputError

RATE, TURN, WIDTH, FIRST = 10_000.0, 0.02037, 0.00105, 0.0049
TIME = np.arange(0, 1, 1 / RATE)


def pulses(sign: float = 1.0, width: float = WIDTH) -> np.ndarray:
    return 2.0 + sign * 5.0 * ((width > (TIME - FIRST) % TURN) & (TIME >= FIRST))


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_square_pulses_pass_by_their_leading_edge(sign: float) -> None:
    marks = passages(TIME, pulses(sign))
    true = FIRST + TURN * np.arange(len(marks.times))
    assert marks.edge == "leading" and marks.square and marks.step == pytest.approx(1 / RATE)
    assert len(marks.times) in (48, 49)  # (1 − 0.0049)/0.02037 = 48.9; a pulse that is cut off does not count
    assert np.abs(marks.times - true).max() < 0.2 / RATE  # finer than a sample, by all edges together
    assert marks.width == pytest.approx(WIDTH, abs=1 / RATE)


def test_the_edges_of_a_pulse_lie_its_width_apart() -> None:
    leading, middle, trailing = (passages(TIME, pulses(), edge).times for edge in ("leading", "middle", "trailing"))
    assert trailing - leading == pytest.approx(WIDTH, abs=0.5 / RATE)
    assert middle == pytest.approx((leading + trailing) / 2)


def test_a_rounded_pulse_passes_by_its_middle() -> None:
    away = (TIME - FIRST + TURN / 2) % TURN - TURN / 2
    marks = passages(TIME, np.exp(-((away / 0.0008) ** 2)))
    assert marks.edge == "middle" and not marks.square
    true = FIRST + TURN * np.arange(len(marks.times))
    assert np.abs(marks.times - true).max() < 0.05 / RATE


def test_a_polynomial_course_of_times_is_left_as_it_is() -> None:
    """A speed that falls evenly: times are no straight line, and scatter of 1e-4 falls below a third of itself."""
    counts = np.arange(60)
    true = 0.02 * counts + 3e-5 * counts**2
    assert smooth(true) == pytest.approx(true, abs=1e-9)
    noise = 1e-4 * np.random.default_rng(1).standard_normal(60)
    assert np.std(smooth(true + noise) - true) < np.std(noise) / 3


@pytest.mark.parametrize(
    ("mark", "part"),
    [
        (np.full_like(TIME, 3.0), "no pulses"),
        (pulses(width=TURN / 2), "as long up as down"),
        ((np.abs(TIME - 0.5) < 0.01) * 1.0, "a single one"),
    ],
)
def test_marks_without_passages_are_refused(mark: np.ndarray, part: str) -> None:
    with pytest.raises(InputError, match=part):
        passages(TIME, mark)
