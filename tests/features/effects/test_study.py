"""Effects of a scene at an accuracy: what is left out together weighs no more than half of it."""

import pytest

import abu_calc
from abu_calc.features.effects.study import effects


@pytest.mark.parametrize("accuracy", [0.001, 0.01, 0.1])
def test_what_is_left_out_weighs_at_most_half_the_accuracy(accuracy: float) -> None:
    result = effects(abu_calc.read("avtovaz-707-222"), "grinding", accuracy=accuracy)
    left_out = [effect.weight for effect in result.effects if not effect.included]
    assert all(weight is not None for weight in left_out)
    assert sum(weight for weight in left_out if weight) == pytest.approx(result.promise)
    assert result.promise <= accuracy / 2
