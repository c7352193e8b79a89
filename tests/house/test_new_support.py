"""A new support goes the whole way, by as few files as docs/contributing.md says."""

import math
from pathlib import Path

import pytest

from tests.house.newcomers.copies import Copy, copied
from tests.house.test_recipes import MOST, named_by

ON_RAIL = """\
[scene]
support = "rail"
mass_kg = 5.0
speed_rpm = 1200.0
imbalance_g_mm = 400.0
duration_s = 2.0
[scene.rail]
stiffness_N_per_m = 20000.0
damping_N_s_per_m = 60.0
angle_deg = 25.0
[[scene.race]]
pitch_radius_mm = 25.0
ball_masses_g = []
rolling_drag_per_s = 10.0
start_angles_deg = []
"""


def add_rail(copy: Copy) -> None:
    copy.add("rail.py", "abu_calc/dynamics/supports/rail.py")
    copy.change(
        "abu_calc/dynamics/supports/registry.py",
        ("from abu_calc.dynamics.supports.planar import", "from abu_calc.dynamics.supports.rail import Rail\n"),
    )
    copy.replace("abu_calc/dynamics/supports/registry.py", "(PlanarSupport, ", "(PlanarSupport, Rail, ")


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    """Of the package and the tests of its dynamics."""
    return copied(tmp_path)


@pytest.mark.slow
def test_a_new_support_goes_the_whole_way(copy: Copy) -> None:
    """The rotor without balls swings along its rail as one mass on one spring does."""
    add_rail(copy)
    assert copy.touched == named_by("a support") and len(copy.touched) <= MOST["a support"]
    mass, stiffness, damping, speed, angle = 5.0, 2e4, 60.0, 40 * math.pi, math.radians(25)
    answer = 400e-6 * speed**2 / complex(stiffness - mass * speed**2, damping * speed)
    found = copy.simulated(ON_RAIL, 1e-4)
    assert found["axis_amplitude_mm"] == pytest.approx(1e3 * abs(answer), rel=1e-3)
    place = (answer * complex(math.cos(speed * 2 - angle), math.sin(speed * 2 - angle))).real * 1e3
    end = found["final"]["x_mm"], found["final"]["y_mm"]
    assert end == pytest.approx((place * math.cos(angle), place * math.sin(angle)), abs=1e-3 * abs(answer) * 1e3)
