"""Effects of a scene at an accuracy: what is left out together weighs no more than half of it.

Effects as text: the list of those there are, and the ledger of a scene.
"""

from dataclasses import replace

import pytest

import abu_calc
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.features.effects.study import effects, effects_blocks, effects_grid, effects_screen
from abu_calc.reporting.screen import as_text, height
from abu_calc.simulation.subject import EffectEntry
from tests.dynamics.scenes import dimensionless


@pytest.mark.parametrize("accuracy", [0.001, 0.01, 0.1])
def test_what_is_left_out_weighs_at_most_half_the_accuracy(accuracy: float) -> None:
    result = effects(abu_calc.read("avtovaz-707-222"), "grinding", accuracy=accuracy)
    left_out = [effect.weight for effect in result.effects if not effect.included]
    assert all(weight is not None for weight in left_out)
    assert sum(weight for weight in left_out if weight) == pytest.approx(result.promise)
    assert result.promise <= accuracy / 2


SCENE = dimensionless(3.0, 0.05, 0.05, 0.2, 0.3, (1.0, 2.5), 100.0)
WEIGHED = replace(SCENE, effects=(GravityEffect(1e-9),))


def entry(name: str, weight: float | None, *, included: bool) -> EffectEntry:
    (first,) = effects(WEIGHED).effects
    return replace(first, name=name, weight=weight, included=included)


def test_an_effect_without_an_estimate_has_a_question_mark() -> None:
    grid = effects_grid([entry("gravity", 0.00234, included=False), entry("motor", None, included=True)])
    assert [row[:3] for row in grid.rows] == [("gravity", "no", "0.0023"), ("motor", "yes", "?")]


def test_the_screen_leaves_out_the_rule_that_the_whole_report_tells() -> None:
    result = effects(WEIGHED)
    whole, screen = as_text(effects_blocks(result)), as_text(effects_screen(result))
    assert "The estimated influence says" in whole and "The estimated influence says" not in screen
    assert "Left out: 1 effect" in whole and "gravity" in screen
    assert height(effects_screen(result)) <= 48
