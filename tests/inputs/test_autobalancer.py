"""The autobalancer's table: a bore that leaves room, and keys that play no part."""

import pytest

from abu_calc.inputs.autobalancer import Autobalancer

ROOM = {"max_outer_diameter_mm": 68.0, "max_width_mm": 32.0}


def test_a_pinned_diameter_leaves_no_choice_of_stock() -> None:
    assert Autobalancer(**ROOM).unused() == frozenset()
    assert Autobalancer(**ROOM, ball_diameter_mm=16.0).unused() == {"ball_sizes"}


@pytest.mark.parametrize(("key", "value"), [
    ("capacity_margin", 0.99), ("max_mass_fraction", 0.0), ("race_hardness_HRC", 69.0), ("design", "heavy"),
    ("rolling_drag_per_s", float("inf")),
])  # fmt: skip
def test_what_no_autobalancer_has_is_refused(key: str, value: object) -> None:
    with pytest.raises(ValueError, match=key):
        Autobalancer.model_validate(ROOM | {key: value})
