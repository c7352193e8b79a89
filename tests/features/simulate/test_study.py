"""One scene simulated: times, sampled motion, the check of accuracy, arguments that are refused."""

import math
from types import SimpleNamespace
from typing import Any

import pytest

from abu_calc.features.simulate.study import MOST_NUMBERS, _reached, equally_spaced
from abu_calc.foundation.errors import InputError
from tests.dynamics.scenes import dimensionless


def test_times_are_equally_spaced_with_both_ends() -> None:
    scene = dimensionless(3.0, 0.01, 0.01, 0.3, 0.05, (1.5, -1.7), 20.0)
    assert equally_spaced(scene, 5).tolist() == [0.0, 5.0, 10.0, 15.0, 20.0] and len(equally_spaced(scene, None)) == 0
    with pytest.raises(InputError) as refused:
        equally_spaced(scene, 1)
    assert refused.value.place.key == "samples"
    with pytest.raises(InputError):
        equally_spaced(scene, MOST_NUMBERS // scene.state_count + 1000)


@pytest.mark.parametrize(
    ("error", "spared", "status", "value"),
    [(0.004, 0.005, "pass", 0.009), (0.006, 0.005, "fail", 0.011), (math.inf, 0.0, "fail", None)],
)
def test_what_the_effects_left_out_may_change_counts_as_error(
    error: float, spared: float, status: str, value: float | None
) -> None:
    run: Any = SimpleNamespace(rung="equations", error_estimate=error)
    check = _reached(run, spared, 0.01)
    assert (check.status, check.limit) == (status, 0.01)
    assert check.value == (None if value is None else pytest.approx(value))
