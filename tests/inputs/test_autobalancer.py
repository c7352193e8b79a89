"""The autobalancer's table: a bore that leaves room, and keys that play no part.

The table [oil]: what it refuses, and what its numbers stand for.
"""

from pathlib import Path

import pytest

from abu_calc.inputs.autobalancer import Autobalancer, Oil, oil_name
from tests.inputs.samples import BASIC, read, refused

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


GOOD = 'grade = "VG 46"\nfill_ml = 2.0\n'
BAD = [
    ("fill_ml = 2.0", "grade"),
    ('grade = "VG 46"', "fill_ml"),
    (GOOD + "viscosity_mm2_per_s = 46.0", "viscosity_mm2_per_s"),
    ('grade = "VG 47"\nfill_ml = 2.0', "grade"),
    ('grade = "46"\nfill_ml = 2.0', "grade"),
    ('grade = "VG 46"\nfill_ml = 0.0', "fill_ml"),
    ('grade = "VG 46"\nfill_ml = -1.0', "fill_ml"),
    ('grade = "VG 46"\nfill_ml = nan', "fill_ml"),
    ('grade = "VG 46"\nfill_ml = "2 ml of oil"', "fill_ml"),
    ("viscosity_mm2_per_s = 1.0\nfill_ml = 2.0", "viscosity_mm2_per_s"),
    ("viscosity_mm2_per_s = 46.0\nviscosity_100C_mm2_per_s = 50.0\nfill_ml = 2.0", "viscosity_100C_mm2_per_s"),
    (GOOD + "viscosity_index = 300.0", "viscosity_index"),
    (GOOD + "density_g_per_cm3 = 870.0", "density_g_per_cm3"),
    (GOOD + "temperature_C = 90.0", "hot_temperature_C"),
    (GOOD + "cold_temperature_C = 60.0", "cold_temperature_C"),
    (GOOD + "temperature_C = 313.0", "temperature_C"),
    (GOOD + "slip_m_per_s = 0.0", "slip_m_per_s"),
    (GOOD + "temprature_C = 40.0", "temprature_C"),
]


@pytest.mark.parametrize(("table", "key"), BAD)
def test_bad_oil_is_refused_with_its_key(tmp_path: Path, table: str, key: str) -> None:
    assert f"oil.{key}" in str(refused(tmp_path, f"{BASIC}\n[oil]\n{table}\n"))


def test_oil_without_a_race_is_refused(tmp_path: Path) -> None:
    text = BASIC.replace("[autobalancer]\nmax_outer_diameter_mm = 68.0\nmax_width_mm = 32.0\n", "")
    assert "needs a race" in str(refused(tmp_path, f"{text}\n[oil]\n{GOOD}"))


def test_the_default_drag_is_no_default_in_force_beside_oil(tmp_path: Path) -> None:
    drag = ("autobalancer", "rolling_drag_per_s")
    assert drag in dict(read(tmp_path, BASIC, ()).whole("size").defaults())
    assert drag not in dict(read(tmp_path, f"{BASIC}\n[oil]\n{GOOD}", ()).whole("size").defaults())


def test_names_and_viscosities() -> None:
    grade, sheet = Oil(grade="VG 68", fill_ml=1.0), Oil(viscosity_mm2_per_s=30.0, fill_ml=1.0)
    assert (grade.viscosity_at_40, oil_name(grade)) == (68.0, "VG 68")
    assert (sheet.viscosity_at_40, oil_name(sheet)) == (30.0, "oil of 30 mm²/s at 40 °C")
    assert Oil(grade="VG 68", fill_ml=1.0, viscosity_100C_mm2_per_s=9.0).unused() == {"viscosity_index"}
