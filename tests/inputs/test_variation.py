"""How a value varies, as people write it, and how they write it wrong."""

import pytest

from abu_calc.foundation.errors import InputError, Place
from abu_calc.inputs.variation import variation
from tests.rows import for_each

HERE = Place(key="vary x")


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("100:300:5", (100, 150, 200, 250, 300)),
        ("1:2:3", (1.0, 1.5, 2.0)),
        ("3:1:3", (3, 2, 1)),
        ("0.5:0.5:1", (0.5,)),
        ("4, 5,6", (4, 5, 6)),
        ("bunched,spread", ("bunched", "spread")),
        ("7", (7,)),
        ([[1.0, 2.0], 3.0], ((1.0, 2.0), 3.0)),
    ],
    ids=str,
)
def test_listed_values(text: object, values: tuple[object, ...]) -> None:
    found = variation(text, HERE)
    assert found.listed and found.values == values
    assert [type(one) for one in found.values] == [type(one) for one in values]


@pytest.mark.parametrize(
    ("text", "kind", "numbers"),
    [
        ("uniform(1,2)", "uniform", (1.0, 2.0)),
        (" Normal( 265 , 4e1 ) ", "normal", (265.0, 40.0)),
        ("lognormal(2.5,0.2)", "lognormal", (2.5, 0.2)),
        ("triangular(0,0,1)", "triangular", (0.0, 0.0, 1.0)),
    ],
)
def test_distributions(text: str, kind: str, numbers: tuple[float, ...]) -> None:
    found = variation(text, HERE)
    assert (found.kind, found.numbers, found.listed) == (kind, numbers, False)


def test_a_choice_is_drawn_not_listed() -> None:
    found = variation("choice(2, 3, roller)", HERE)
    assert found.values == (2, 3, "roller") and not found.listed


@for_each(
    [
        ("", "not a way"),
        ("about five", "not a way"),
        ("norml(1,2)", "unknown distribution"),
        ("normal(1)", "2 numbers"),
        ("normal(1,2,3)", "2 numbers"),
        ("normal(1,-2)", "negative"),
        ("normal(1,2", "bracket"),
        ("lognormal(0,1)", "above 0"),
        ("uniform(2,1)", "ascend"),
        ("uniform(1,1)", "ascend"),
        ("triangular(0,2,1)", "ascend"),
        ("uniform(0,nan)", "finite"),
        ("uniform(0,inf)", "finite"),
        ("uniform(0,big)", "no number"),
        ("uniform(0;1)", "no number"),
        ("1:2:0", "whole number"),
        ("1:2:2.5", "whole number"),
        ("1:2:-3", "whole number"),
        ("1:2:9999999", "whole number"),
        ("1:2:1", "both ends"),
        ("1,,2", "missing"),
        ("choice()", "missing"),
        ("1,nan", "finite"),
        ([], "no values"),
        (5.0, "not a way"),
        (True, "not a way"),
    ]
)
def test_wrong_ones_are_refused_with_the_place(text: object, part: str) -> None:
    with pytest.raises(InputError) as refused:
        variation(text, HERE)
    assert part in str(refused.value) and "vary x" in str(refused.value)
