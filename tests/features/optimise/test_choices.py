"""Costs by default and from [costs]; numbers by hand."""

from types import SimpleNamespace

import pytest

import abu_calc
from abu_calc.features.optimise.choices import COUNT, DIAMETER, ECCENTRICITY, RADIUS, cost_entries, cost_of, options_of
from abu_calc.features.optimise.result import written_text
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
    items = cost_entries((*VALUES, "machine.mass_kg"), {COUNT: 1})
    assert {item.key for item in items} == {COUNT, RADIUS, ECCENTRICITY, "machine.mass_kg"}
    assert all(item.source for item in items)


PRICED = abu_calc.read("avtovaz-707-222").to_toml() + "\n[costs]\n"


def test_a_chosen_value_costs_the_same_however_its_unit_is_written() -> None:
    """Half of the usual 10 µm costs 0.25·2, the usual 0.25; ε = 5 µm is 0.005 mm."""
    machine = abu_calc.read(PRICED + '"autobalancer.race_eccentricity" = [["10 µm", 3.0], ["5 µm", 4.0]]')
    for choice in ("autobalancer.race_eccentricity=choice(5 µm, 10 µm)", f"{ECCENTRICITY}=choice(0.005, 0.010)"):
        [option] = options_of(machine, [choice], Place())
        assert option.values == ({ECCENTRICITY: 0.005}, {ECCENTRICITY: 0.010})
        assert [cost_of((ECCENTRICITY,), value, {}, Place()) for value in option.values] == [0.5, 0.25]
        costs = machine.whole().costs
        assert [cost_of((ECCENTRICITY,), value, costs, Place()) for value in option.values] == [4.0, 3.0]


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('"autobalancer.race_excentricity_mm" = 1', "nearest is .autobalancer.race_eccentricity_mm"),
        ("balls = 1", "no key of a machine"),
        ('"autobalancer.race_eccentricity" = 1', "names no unit"),
        ('"autobalancer.race_eccentricity" = [["5 kg", 1]]', "not a unit of length"),
        (f'"{ECCENTRICITY}" = 1\n"autobalancer.race_eccentricity" = [["5 µm", 1]]', "two costs"),
    ],
)
def test_a_key_without_meaning_in_costs_is_refused_when_the_file_is_read(line: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        abu_calc.read(PRICED + line)


def test_a_written_file_has_each_value_once() -> None:
    text = PRICED.removesuffix("\n[costs]\n").replace("race_eccentricity_mm = 0.01", 'race_eccentricity = "10 µm" #')
    assert 'race_eccentricity = "10 µm"' in text
    made = written_text(abu_calc.read(text), {ECCENTRICITY: 0.005}, SimpleNamespace(written_tolerances=False))
    assert abu_calc.read(made).whole().autobalancer.race_eccentricity_mm == 0.005 and "10 µm" not in made
