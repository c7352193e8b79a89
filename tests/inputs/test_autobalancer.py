"""The autobalancer's table: a bore that leaves room, and keys that play no part."""

from pathlib import Path

import pytest

from abu_calc.inputs.autobalancer import Autobalancer
from tests.inputs.samples import BASIC, refused

ROOM = {"max_outer_diameter_mm": 68.0, "max_width_mm": 32.0}


@pytest.mark.parametrize("bore", ["68.0", "70"])
def test_a_bore_without_room_about_it_is_refused(tmp_path: Path, bore: str) -> None:
    error = refused(tmp_path, BASIC.replace("max_width_mm = 32.0", f"max_width_mm = 32.0\nbore_diameter_mm = {bore}"))
    assert error.place.key == "autobalancer.bore_diameter_mm" and error.place.file == str(tmp_path / "m.toml")
    assert error.allowed == "bore_diameter_mm below max_outer_diameter_mm" and "68" in (error.found or "")


def test_room_that_the_default_bore_fills_is_refused_by_its_own_key(tmp_path: Path) -> None:
    error = refused(tmp_path, BASIC.replace("max_outer_diameter_mm = 68.0", "max_outer_diameter_mm = 20"))
    assert error.place.key == "autobalancer.max_outer_diameter_mm"


def test_a_pinned_diameter_leaves_no_choice_of_stock() -> None:
    assert Autobalancer(**ROOM).unused() == frozenset()
    assert Autobalancer(**ROOM, ball_diameter_mm=16.0).unused() == {"ball_sizes"}


@pytest.mark.parametrize(("key", "value"), [
    ("capacity_margin", 0.99), ("max_mass_fraction", 0.0), ("race_hardness_HRC", 69.0), ("ball_count", 1),
    ("ball_count", 4.0), ("design", "heavy"), ("rolling_drag_per_s", float("inf")),
])  # fmt: skip
def test_what_no_autobalancer_has_is_refused(key: str, value: object) -> None:
    with pytest.raises(ValueError, match=key):
        Autobalancer.model_validate(ROOM | {key: value})
