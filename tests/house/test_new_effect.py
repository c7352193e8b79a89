"""A new effect goes the whole way, by as few files as docs/contributing.md says."""

import math
import re
from pathlib import Path

import pytest

from tests.house.newcomers.copies import Copy, copied
from tests.house.test_recipes import MOST, named_by

CHURNED = """\
[scene]
mass_kg = 5.0
stiffness_N_per_m = [1500.0, 1500.0]
damping_N_s_per_m = [60.0, 60.0]
speed_rpm = 3000.0
imbalance_g_mm = 0.0
duration_s = 0.4
rolling_inertia = true
[[scene.race]]
pitch_radius_mm = 25.0
ball_masses_g = [10.0, 10.0]
rolling_drag_per_s = 0.0
start_angles_deg = [30.0, 210.0]
start_speeds_rpm = [120.0, 120.0]
[scene.effects]
"""


def add_churning(copy: Copy) -> None:
    copy.add("churning.py", "abu_calc/dynamics/effects/churning.py")
    imported = "from abu_calc.dynamics.effects.churning import Churning\n"
    behind = "from abu_calc.dynamics.effects.ball_contact import"
    copy.change(
        "abu_calc/dynamics/effects/registry.py",
        (behind, imported),
        ("    GravityEffect,", "    Churning,\n"),
    )
    copy.change(
        "tests/dynamics/examples.py",
        (behind, imported),
        ("EXAMPLES: dict", '    "churning": Churning(0.4),\n'),
        ("UNITS: dict", '    "coefficient": (0, 0, 1),\n'),
        ("NOTHING: list", "    Churning(0.0),\n"),
    )


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    """Of the package and the tests of its dynamics."""
    return copied(tmp_path)


@pytest.mark.slow
def test_a_new_effect_goes_the_whole_way(copy: Copy) -> None:
    """Two balls across from each other leave the axis at rest, so each moves as it would alone."""
    add_churning(copy)
    assert copy.touched == named_by("an effect") and len(copy.touched) <= MOST["an effect"]
    J, c, start, duration = 7 / 5, 0.05, 120 * math.pi / 30, 0.4
    grown = math.sqrt(1 + 2 * c * start**2 * duration / J)
    found = copy.simulated(CHURNED + f"churning = {{ coefficient_s = {c} }}\n", 1e-5)
    assert [(each["name"], each["included"]) for each in found["effects"]] == [("churning", True)]
    way = math.degrees(J * (grown - 1) / (c * start))
    assert way < 0.8 * math.degrees(start * duration)  # without it balls would go on as they started
    for angle, first in zip(found["final"]["ball_angles_deg"], (30.0, 210.0), strict=True):
        assert math.remainder(angle - first - way, 360) == pytest.approx(0.0, abs=0.01)
    assert found["axis_amplitude_mm"] < 1e-6


HONEST = "        return -self.coefficient * (m.static_moments"


@pytest.mark.slow
@pytest.mark.parametrize("lie", [None, "        return 0.0\n"], ids=["honest", "lies of its power"])
def test_a_new_effect_is_held_to_the_contract_of_effects(copy: Copy, lie: str | None) -> None:
    """By its example alone."""
    add_churning(copy)
    if lie is not None:
        copy.replace("abu_calc/dynamics/effects/churning.py", HONEST, lie + HONEST)
    done = copy.run("-m", "pytest", "-n", "0", "tests/dynamics/effects/test_contract.py", "-k", "churning and not +")
    assert done.returncode == (0 if lie is None else 1), done.stdout + done.stderr
    failed = set(re.findall(r"^FAILED .*::(\w+)", done.stdout, re.M))
    expected = {"test_dissipative_effects_take_energy_only", "test_energy_changes_by_the_power_alone"}
    assert failed == (set() if lie is None else expected)
