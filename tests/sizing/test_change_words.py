"""A change in words: what changes, from what to what, and nothing that stays."""

import pytest

from abu_calc.sizing.actions import overrides
from abu_calc.sizing.proposals import in_words
from tests.sizing.machines import machine

MADE = overrides(
    {"autobalancer.ball_count": 4, "autobalancer.ball_diameter_mm": 15.875, "autobalancer.race_radius_mm": 31.0}
)
OTHER = (*MADE[:1], "autobalancer.ball_diameter_mm=16", *MADE[2:])
OIL = ("oil.grade=VG 100", "oil.viscosity_index=120")


@pytest.mark.parametrize(
    ("given", "entries", "expected"),
    [
        ({}, OIL, "oil VG 100 (viscosity index 120) instead of the assumed one"),
        ({"oil": {"grade": "VG 68", "fill_ml": 1.0}}, OIL,
         "oil VG 100 (viscosity index 120) instead of VG 68 (viscosity index 95)"),
        ({"autobalancer__rolling_drag_per_s": 15.0}, (*OIL, "oil.fill_ml=1"),
         "oil VG 100 (viscosity index 120, 1 ml) instead of a drag rate of 15 1/s"),
        ({"autobalancer__rolling_drag_per_s": 15.0, "identified": {"rolling_drag_per_s": [11.0, 19.0]}}, OIL,
         "oil VG 100 (viscosity index 120) instead of the measured drag rate of 15 1/s"),
        ({}, ("autobalancer.race_eccentricity_mm=0.008", "run_up.time_s=0.5"),
         "race eccentricity 0.008 instead of 0.01 mm and run-up time 0.5 s"),
        ({}, ("machine.speed_range_rpm=[5000,5800]", "bearing.0.shaft_fit=j5"),
         "speed range [5000, 5800] rpm and bearing 1 shaft fit j5"),
    ],
)  # fmt: skip
def test_a_change_tells_what_it_replaces(given: dict[str, object], entries: tuple[str, ...], expected: str) -> None:
    """Balls and race that stay are not named, whatever pins them."""
    table = machine(**given)
    assert in_words((*MADE, *entries), table, MADE) == in_words((*entries, *MADE), table, MADE) == expected


def test_other_balls_are_named_beside_the_present_ones() -> None:
    expected = "4 balls Ø16 mm in a race R 31 mm instead of 4 balls Ø15.875 mm in a race R 31 mm"
    assert in_words(OTHER, machine(), MADE) == expected
    assert in_words(("oil.grade=VG 100", *OTHER), machine(), MADE).endswith(f" and {expected}")
