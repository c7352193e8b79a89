"""Costs by default and from [costs]; numbers by hand."""

import pytest

from abu_calc.features.optimise.costs import COUNT, DIAMETER, ECCENTRICITY, RADIUS, cost_of, items_of
from abu_calc.foundation.errors import InputError, Place

VALUES = {COUNT: 4, DIAMETER: 8.0, RADIUS: 31.0, ECCENTRICITY: 0.005}


def test_default_costs_by_hand() -> None:
    # balls 0.01·4·(1/2)³ = 0.005, housing 0.5, eccentricity 0.25·2 = 0.5
    assert cost_of(tuple(VALUES), VALUES, {}, Place()) == pytest.approx(1.005)


def test_costs_of_the_file_replace_defaults() -> None:
    given = {ECCENTRICITY: [[0.004, 2.0], [0.006, 1.0]], COUNT: 0.1}
    assert cost_of((ECCENTRICITY, COUNT), VALUES, given, Place()) == pytest.approx(1.5 + 0.4)


@pytest.mark.parametrize("value", [0.003, 0.007])
def test_a_value_beyond_the_list_is_refused(value: float) -> None:
    with pytest.raises(InputError, match="gives no cost of"):
        cost_of((ECCENTRICITY,), {ECCENTRICITY: value}, {ECCENTRICITY: [[0.004, 2.0], [0.006, 1.0]]}, Place())


def test_text_needs_a_list() -> None:
    key = "autobalancer.design"
    assert cost_of((key,), {key: "light"}, {key: [["light", 3], ["one-piece", 2]]}, Place()) == 3
    with pytest.raises(InputError, match="gives no cost of"):
        cost_of((key,), {key: "light"}, {key: 2.0}, Place())


def test_each_cost_has_a_source() -> None:
    items = items_of((*VALUES, "machine.mass_kg"), {COUNT: 1})
    assert {item.key for item in items} == {COUNT, RADIUS, ECCENTRICITY, "machine.mass_kg"}
    assert all(item.source for item in items)
