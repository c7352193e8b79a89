"""Tolerances of the drawing, each with the level it costs."""

import math

import pytest

from abu_calc.sizing import size
from abu_calc.sizing.drawing_requirements import extra_level
from tests.sizing.machines import machine


def test_costs_of_the_drawing_add_up_to_the_budget() -> None:
    """What the eccentricity costs is the budget with it against the budget without it."""
    design = size(machine(autobalancer__race_eccentricity_mm=0.02))
    line = next(each for each in design.drawing if each.feature == "race to bore, total")
    budget = design.autobalancer.budget
    others = math.hypot(budget.rolling_friction, budget.race_ovality)
    assert line.cost_db == pytest.approx(20 * math.log10(budget.residual / others))
    assert all(each.cost_db is None or each.cost_db >= 0 for each in design.drawing)


def test_a_part_as_large_as_the_rest_costs_three_decibels() -> None:
    assert extra_level(10e-6, 10e-6) == pytest.approx(10 * math.log10(2))
    assert extra_level(10e-6, 0.0) == 0.0
    assert extra_level(0.0, 1e-6) == math.inf


def test_what_costs_without_bound_has_no_number() -> None:
    """Without friction and eccentricity, the oval race is all; eccentricity costs nothing beside it."""
    design = size(machine(autobalancer__race_eccentricity_mm=0.0, autobalancer__rolling_friction_mm=0.0))
    costs = {each.feature: each.cost_db for each in design.drawing}
    assert costs["race to bore, total"] == 0.0 and costs["rolling friction"] == 0.0
    assert costs["oil"] is None
