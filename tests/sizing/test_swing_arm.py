"""Bounds of a swing arm, and the changes of its table that keep them."""

import pytest

from abu_calc.foundation.checks import CHECK_CODES, coded
from abu_calc.sizing import size
from abu_calc.sizing.actions import with_entries
from abu_calc.sizing.design import Design
from abu_calc.sizing.proposals import mended, on_arm
from abu_calc.sizing.swing_arm import doubted, up
from tests.sizing.machines import check_of, machine

TABLE = {
    "arm_length_mm": 350.0,
    "moment_of_inertia_kg_m2": 0.62,
    "joint_stiffness_N_per_m": 2000.0,
    "joint_damping_N_s_per_m": 40.0,
    "contact_stiffness_N_per_m": 1e5,
    "cutting_coefficient": 0.45,
    "contact_angle_deg": 90.0,
    "touch_angle_deg": 2.0,
    "pressing_moment_N_m": 40.0,
}


def test_the_autobalancer_adds_its_mass_at_the_end_of_the_arm() -> None:
    design = size(machine(swing_arm=TABLE))
    assert design.swing_arm is not None
    assert design.swing_arm.arm.inertia == pytest.approx(0.62 + design.autobalancer.mass * 0.35**2)


def test_the_contact_is_held_against_the_smaller_of_two_limits() -> None:
    design = size(machine(swing_arm=TABLE))
    bounds, check = design.swing_arm, check_of(design, "ABU501")
    assert bounds is not None and check.status == "pass"
    assert check.limit == pytest.approx(min(bounds.contact_stiffness_limit, bounds.contact_stiffness_limit_exact))
    stiff = size(machine(swing_arm=TABLE | {"contact_stiffness_N_per_m": 1.01 * check.limit}))
    assert check_of(stiff, "ABU501").status == "fail"


def on(**changed: float) -> Design:
    return size(machine(swing_arm=TABLE | changed))


def test_an_arm_within_its_bounds_needs_no_change() -> None:
    assert not any(key.startswith("swing_arm.") for entries in mended(on()) for key in entries)


@pytest.mark.parametrize(
    ("code", "changed"),
    [
        ("ABU501", {"contact_stiffness_N_per_m": 5e6}),
        ("ABU501", {"contact_stiffness_N_per_m": 5e6, "joint_stiffness_N_per_m": 3e6}),
        ("ABU502", {"joint_damping_N_s_per_m": 1e-3}),
        ("ABU503", {"pressing_moment_N_m": 1.0}),
        ("ABU503", {"pressing_moment_N_m": 0.0, "touch_angle_deg": 0.0}),
        ("ABU503", {"contact_angle_deg": 0.0}),
        ("ABU503", {"contact_angle_deg": 180.0}),
        ("ABU504", {"contact_angle_deg": 8.0}),
    ],
)
def test_every_change_mends_its_check(code: str, changed: dict[str, float]) -> None:
    """Each by itself, with few digits, the nearer before the farther."""
    design = on(**changed)
    assert check_of(design, code).status in ("fail", "not-done")
    ways = list(on_arm(CHECK_CODES[code].key, design))
    assert ways
    for entries in ways:
        assert check_of(size(with_entries(design.case.table, entries)), code).status in ("pass", "warn"), entries
    by_key: dict[str, list[float]] = {}
    for ((key, new),) in (entries.items() for entries in ways):
        assert isinstance(new, float) and len(f"{new:.10g}".replace(".", "").strip("0")) <= 3
        by_key.setdefault(key, []).append(abs(new - changed.get(key.partition(".")[2], 0.0)))
    for code_key, steps in by_key.items():
        assert steps == sorted(steps) or code == "ABU502", code_key


def test_what_the_bounds_miss_by_a_little_is_changed_by_a_little() -> None:
    """A twentieth above the bound, rounded up to three digits."""
    weak = on(joint_damping_N_s_per_m=1e-3, pressing_moment_N_m=1.0)
    assert weak.swing_arm is not None
    entries = mended(weak)[0]
    bounds = weak.swing_arm
    assert 1.05 <= entries["swing_arm.pressing_moment_N_m"] / bounds.least_pressing_moment <= 1.06
    assert 1.05 <= entries["swing_arm.joint_damping_N_s_per_m"] / (bounds.damping_limit_bunched or 1.0) <= 1.06


def test_example_data_turn_a_pass_into_a_warning_but_no_failure() -> None:
    checks = coded("ABU501", "pass", "m"), coded("ABU502", "fail", "m")
    assert doubted(checks, ()) == checks
    doubtful = doubted(checks, ("arm_length_mm",))
    assert [check.status for check in doubtful] == ["warn", "fail"]
    assert "example data" in doubtful[0].message and doubtful[1] == checks[1]


@pytest.mark.parametrize("value", [1.2341, 0.5, 2046.1, 99.95, 1e-7])
def test_rounding_up_is_never_below_and_never_far_above(value: float) -> None:
    assert value <= up(value) <= 1.01 * value
