"""Numbers before and after a change, as text."""

import math

import pytest

from abu_calc.foundation.moved import Moved, figures


@pytest.mark.parametrize(
    ("before", "after", "limit", "unit", "texts"),
    [
        (113.49, 107.96, 109.0, "dB", ("113.5", "108.0")),
        (109.03, 108.98, 109.0, "dB", ("109.03", "108.98")),
        (1.0229, 0.65, 1.0, "s", ("1.02", "0.650")),
        (1.0004, 0.9996, 1.0, "s", ("1.0004", "0.99960")),
        (math.inf, 0.5, 1.0, "s", ("never", "0.500")),
        (13993.0, 15107.0, None, "rpm", ("14000", "15100")),
        (2.0, 0.0, 0.0, "", ("2", "0")),
    ],
)
def test_two_numbers_differ_and_none_is_shown_across_the_limit(
    before: float, after: float, limit: float | None, unit: str, texts: tuple[str, str]
) -> None:
    assert figures(before, after, limit, unit) == texts


def test_the_clause_tells_the_direction() -> None:
    assert Moved("the level", 113.49, 107.96, "dB", 109.0).text == "the level falls from 113.5 to 108.0 dB"
    assert Moved("the capacity", 100.0, 120.0, "g·mm").text == "the capacity rises from 100 to 120 g·mm"
    assert Moved("the capacity", 100.0, 100.0, "g·mm").text.startswith("the capacity stays at 100")
