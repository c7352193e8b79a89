"""Effects of a scene at an accuracy: what is left out together weighs no more than half of it."""

import pytest

import abu_calc
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.registry import REGISTRY
from abu_calc.features.effects.study import effects, known_effects
from abu_calc.foundation.errors import InputError, RangeError
from tests.dynamics.scenes import dimensionless

SCENE = dimensionless(3.0, 0.05, 0.05, 0.2, 0.3, (1.0, 2.5), 100.0)


def test_all_effects_come_in_the_order_of_the_registry() -> None:
    known = known_effects()
    assert [effect.name for effect in known.effects] == [name for name, _ in REGISTRY]
    assert known.status == "pass" and known.checks == ()


@pytest.mark.parametrize("accuracy", [0.001, 0.01, 0.1])
def test_what_is_left_out_weighs_at_most_half_the_accuracy(accuracy: float) -> None:
    result = effects(abu_calc.read("avtovaz-707-222"), "grinding", accuracy=accuracy)
    left_out = [effect.weight for effect in result.effects if not effect.included]
    assert all(weight is not None for weight in left_out)
    assert sum(weight for weight in left_out if weight) == pytest.approx(result.promise)
    assert result.promise <= accuracy / 2


def test_a_scene_without_effects_has_none() -> None:
    result = effects(SCENE)
    assert (result.effects, result.promise, result.status) == ((), 0, "pass")


def test_an_effect_that_is_asked_for_is_in() -> None:
    from dataclasses import replace

    scene = replace(SCENE, effects=(GravityEffect(1e-9),))
    assert [effect.included for effect in effects(scene).effects] == [False]
    assert [effect.included for effect in effects(scene, with_effects=["gravity"]).effects] == [True]


def test_an_effect_without_data_and_a_wrong_accuracy_are_refused_by_their_argument() -> None:
    with pytest.raises(InputError) as caught:
        effects(SCENE, with_effects=["motor"])
    assert "motor" in str(caught.value)
    with pytest.raises(RangeError):
        effects(SCENE, accuracy=0.0)
