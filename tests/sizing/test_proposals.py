"""Changes of the file that are proposed for checks of sizing, and what they mend.

A change in words: what changes, from what to what, and nothing that stays.
"""

from typing import Any

import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.sizing import size
from abu_calc.sizing.actions import PINS, overrides, pins, with_entries
from abu_calc.sizing.case import read_case
from abu_calc.sizing.proposals import PROPOSED, free, harder, in_words, mended, more_room, stronger
from tests.sizing.machines import DRUM, PINNED, check_of, machine

BODY = {"machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0}
HANDLE = {"machine__handle": [{"name": "front", "from_center_of_mass_mm": 100.0}]}
FIVE = {"autobalancer__ball_count": 5, "autobalancer__ball_diameter_mm": 10.0, "autobalancer__race_radius_mm": 25.5}
PRESSED = {"press_force_N": 45.0, "cutting_coefficient": 0.35}
RANGE = {"machine__speed_rpm": 5000, "machine__speed_range_rpm": [2500, 12000], "wheel__imbalance_g_mm": 100.0}
MOTOR = {"no_load_speed_rpm": 6500, "stall_torque_N_m": 5.0}


@pytest.mark.few(2)
@pytest.mark.parametrize(
    ("code", "given"),
    [
        ("ABU101", {"suspension__natural_frequencies_hz": [110.0, 110.0]}),
        ("ABU101", {"suspension__natural_frequencies_hz": [60.0, 60.0], "machine__speed_range_rpm": [3000, 6000]}),
        ("ABU102", {"machine__speed_range_rpm": [170, 5800], "suspension__natural_frequencies_hz": [0.5, 0.5]}),
        ("ABU104", {"motor": MOTOR}),
        ("ABU201", {"wheel__imbalance_g_mm": 2000.0}),
        ("ABU201", {"autobalancer__ball_count": 2, "autobalancer__ball_diameter_mm": 10.0}),
        ("ABU203", {"autobalancer__capacity_margin": 3.0, "autobalancer__max_mass_fraction": 0.025}),
        ("ABU205", {**BODY, "autobalancer__plane_offset_mm": -90.0, "limits": {"vibration_level_db": 98.0}}),
        ("ABU206", {"autobalancer__race_eccentricity_mm": 0.002}),
        ("ABU302", {"autobalancer__race_hardness_HRC": 45.0}),
        ("ABU304", DRUM),
        ("ABU308", {"autobalancer__clamp_force_N": 5.0}),
        ("ABU401", {**RANGE, **PINNED, "limits": {"vibration_level_db": 104.5}}),
        ("ABU402", {"wheel__imbalance_g_mm": 80.0, "autobalancer__rolling_friction_mm": 0.004}),
        ("ABU403", {"machine__power_W": 100.0, "grinding": PRESSED}),
        ("ABU404", {**BODY, **HANDLE, **FIVE, "limits": {"a_hv_m_per_s2": 0.45}}),
        ("ABU431", {**BODY, **HANDLE, **FIVE, "autobalancer__race_eccentricity_mm": 0.04}),
    ],
)  # fmt: skip
def test_a_check_is_mended_by_what_is_proposed(code: str, given: dict[str, Any]) -> None:
    """All changes together come first, with balls and race pinned. The check passes with them, and none got worse."""
    before = size(machine(**given))
    assert check_of(before, code).status != "pass"
    first, *others = mended(before)
    after = size(with_entries(machine(**given), first))
    assert check_of(after, code).status == "pass"
    assert pins(after.autobalancer).items() <= first.items()
    assert all(entries.keys() <= first.keys() for entries in others)


def test_what_nothing_mends_has_no_change() -> None:
    assert mended(size(machine(autobalancer__max_mass_fraction=0.001))) == []
    assert mended(size(machine())) == []


def test_a_race_that_its_balls_cannot_enter_gets_others() -> None:
    pinned = [f"autobalancer.{key}={value}" for key, value in zip(PINS, (4, 15.875, 29.4), strict=True)]
    design = size(read_machine("avtovaz-707-222", pinned).tables)
    after = size(with_entries(design.case.table, mended(design)[0]))
    assert (check_of(design, "ABU305").status, check_of(after, "ABU305").status) == ("fail", "pass")


def test_only_what_is_pinned_is_freed() -> None:
    wall = machine(autobalancer__ball_count=4, autobalancer__min_wall_mm=2.0)
    assert list(free(read_case(machine()))) == list(stronger(size(machine()))) == []
    (found,) = stronger(size(wall))
    assert found == pins(size(machine(autobalancer__min_wall_mm=2.0)).autobalancer)


def test_more_room_enlarges_width_and_diameter_alike() -> None:
    design = size(machine(autobalancer__capacity_margin=1.0, autobalancer__max_outer_diameter_mm=60.0))
    sizes = [tuple(change.values()) for change in more_room(design)]
    assert sizes == [(66.0, 35.2), (75.0, 40.0), (90.0, 48.0)]  # 10, 25 and 50 % above 60 by 32 mm


def test_a_race_as_hard_as_can_be_is_not_made_harder() -> None:
    assert list(harder(size(machine(autobalancer__race_hardness_HRC=63.0)))) == []
    (change,) = harder(size(machine(autobalancer__race_hardness_HRC=60.0)))
    assert change == {"autobalancer.race_hardness_HRC": 63.0}


def test_a_background_that_is_too_loud_alone_is_said() -> None:
    """No truer race is proposed for it."""
    loud = size(machine(machine__background_level_db=112.0, limits={"vibration_level_db": 110.0}))
    assert "background alone is 112 dB" in (check_of(loud, "ABU401").remedy or "")
    assert not list(PROPOSED["idle_level"].changes(loud)) and mended(loud) == []


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
