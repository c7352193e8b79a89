"""A new effect and a new support go the whole way, in a copy of the package, by as few files as the README says."""

import json
import math
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from tests.house.structure import ROOT
from tests.house.test_recipes import MOST, named_by

NEWCOMERS = Path(__file__).parent / "newcomers"
COPIED = ("abu_calc", "tests/dynamics", "tests/__init__.py", "tests/conftest.py", "pyproject.toml")


@dataclass(frozen=True)
class Copy:
    """A copy of what is asked for, in which files are added and changed."""

    folder: Path

    def add(self, name: str, path: str) -> None:
        """A newcomer's own file, in a place where none was."""
        assert not (self.folder / path).exists()
        shutil.copy(NEWCOMERS / name, self.folder / path)

    def change(self, path: str, *changes: tuple[str, str]) -> None:
        """Put text behind a line that begins like this, the only one that does."""
        file = self.folder / path
        text = file.read_text(encoding="utf-8")
        for line, more in changes:
            text, count = re.subn(
                rf"^({re.escape(line)}.*\n)", lambda found, more=more: found[1] + more, text, flags=re.M
            )
            assert count == 1, (path, line)
        file.write_text(text, encoding="utf-8")

    @property
    def touched(self) -> set[str]:
        """Files that were there before and are not as they were, as recipes name them."""
        both = ((file.relative_to(self.folder), file) for file in self.folder.rglob("*.py"))
        changed = (name for name, file in both if (ROOT / name).is_file() and not same(ROOT / name, file))
        return {name.as_posix().removeprefix("abu_calc/") for name in changed}

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Python with this copy of the package."""
        surroundings = os.environ | {"PYTHONPATH": str(self.folder), "PYTHONIOENCODING": "utf-8"}
        return subprocess.run([sys.executable, *arguments], cwd=self.folder, env=surroundings, capture_output=True,
                              text=True, encoding="utf-8", check=False)  # fmt: skip

    def simulated(self, scene: str, accuracy: float) -> dict[str, Any]:
        """What `abu simulate` answers to a scene file."""
        (self.folder / "scene.toml").write_text(scene, encoding="utf-8")
        command = ("-m", "abu_calc", "simulate", "scene.toml", "--accuracy", str(accuracy), "--json")
        done = self.run(*command)
        assert done.returncode == 0, done.stdout + done.stderr
        found: dict[str, Any] = json.loads(done.stdout)["result"]
        return found


def same(one: Path, other: Path) -> bool:
    """Byte by byte."""
    return one.read_bytes() == other.read_bytes()


@pytest.fixture
def copy(tmp_path: Path) -> Copy:
    """Without what other processes compile meanwhile."""
    for name in COPIED:
        source, target = ROOT / name, tmp_path / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, target)
    found = Copy(tmp_path)
    assert found.touched == set()
    return found


# An effect

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
        ('    ("gravity", Gravity),', '    ("churning", Churning),\n'),
    )
    copy.change(
        "abu_calc/spec/scene_effects.py",
        ("BALL_RADIUS = ", TABLE),
        ("    gravity: Gravity | None", "    churning: Churning | None = None\n"),
    )
    copy.change(
        "abu_calc/scenes/from_tables.py",
        ("NUMBERS: Final", '    "churning": lambda table: {"coefficient": table.coefficient_s},\n'),
    )
    copy.change(
        "tests/dynamics/examples.py",
        (behind, imported),
        ("EXAMPLES: dict", '    "churning": Churning(0.4),\n'),
        ("UNITS: dict", '    "coefficient": (0, 0, 1),\n'),
        ("NOTHING: list", "    Churning(0.0),\n"),
    )


TABLE = '''

class Churning(Table):
    """Grease that balls churn: a drag that grows with the third power of their speed along the race."""

    coefficient_s: float = Field(description="Torque over m·R_p²·speed³ [s]; {range}.", examples=[0.1], ge=0, le=1e6)
'''


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


@pytest.mark.parametrize("lie", [None, "        return 0.0\n"], ids=["honest", "lies of its power"])
def test_a_new_effect_is_held_to_the_contract_of_effects(copy: Copy, lie: str | None) -> None:
    """By its example alone."""
    add_churning(copy)
    if lie is not None:
        file = copy.folder / "abu_calc/dynamics/effects/churning.py"
        text = file.read_text(encoding="utf-8")
        assert text.count(HONEST) == 1
        file.write_text(text.replace(HONEST, lie + HONEST), encoding="utf-8")
    done = copy.run("-m", "pytest", "-n", "0", "tests/dynamics/test_contract.py", "-k", "churning and not +")
    assert done.returncode == (0 if lie is None else 1), done.stdout + done.stderr
    failed = set(re.findall(r"^FAILED .*::(\w+)", done.stdout, re.M))
    expected = {"test_dissipative_effects_take_energy_only", "test_energy_changes_by_the_power_alone"}
    assert failed == (set() if lie is None else expected)


# A support

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

RAIL_TABLE = '''

class Rail(Table):
    """A rotor that slides along one line: support = "rail"."""

    stiffness_N_per_m: Stiffness = Field(description="Stiffness along the rail [N/m]; {range}.", examples=[2e4])
    damping_N_s_per_m: Damping = Field(description="Damping along the rail [N·s/m]; {range}.", examples=[60.0])
    angle_deg: float = Field(default=0.0, description="From +x to it [degrees]; {range}. Default: {default}.", ge=-360,
                             le=360)
'''

RAIL_SCENE = '''

def _rail(table: SceneTable) -> Held:
    """On a rail, at the place of it that is next to where the file says."""
    rail, start = _given(table.rail), table.initial
    made = Rail(table.mass_kg or 0.0, rail.stiffness_N_per_m, rail.damping_N_s_per_m, to_si(rail.angle_deg, "deg"))
    along = made.unit[:, 0]
    place = along @ (to_si(start.x_mm, "mm"), to_si(start.y_mm, "mm"))
    velocity = along @ (to_si(start.vx_mm_per_s, "mm_per_s"), to_si(start.vy_mm_per_s, "mm_per_s"))
    return made, (float(place),), (float(velocity),)
'''


def add_rail(copy: Copy) -> None:
    copy.add("rail.py", "abu_calc/dynamics/supports/rail.py")
    copy.change("abu_calc/spec/scene_support.py", ("PER_BEARING: Final", RAIL_TABLE))
    copy.change(
        "abu_calc/spec/scene.py",
        ("from abu_calc.spec.scene_race import", "from abu_calc.spec.scene_support import Rail\n"),
        ("NEEDED: Final", '    "rail": ("mass_kg", "rail"),\n'),
        ("REFUSED: Final", '    "rail": (*SPRINGS, "tilting", "swing_arm", "body"),\n'),
        ("    body: Body | None", "    rail: Rail | None = None\n"),
    )
    file = copy.folder / "abu_calc/spec/scene.py"
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace('Literal["planar", ', 'Literal["rail", "planar", '), encoding="utf-8")
    copy.change(
        "abu_calc/scenes/from_scene.py",
        ("from abu_calc.dynamics.supports.planar import", "from abu_calc.dynamics.supports.rail import Rail\n"),
        ('"""A support, and places and velocities', RAIL_SCENE),
        ("SUPPORTS: Final", '    "rail": _rail,\n'),
    )


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
