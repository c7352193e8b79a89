"""The wheel: either key of its runout, its balance grades, one source of its imbalance."""

from pathlib import Path

import pytest

from abu_calc.inputs.machine import MachineFile
from tests.inputs.samples import BASIC, read


def machine(folder: Path, text: str) -> MachineFile:
    loaded = read(folder, text).tables
    assert isinstance(loaded, MachineFile)
    return loaded


def test_runout_from_either_key(tmp_path: Path) -> None:
    gauge = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_tir_mm = 0.08")
    direct = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_mm = 0.04")
    assert machine(tmp_path, gauge).wheel.runout == machine(tmp_path, direct).wheel.runout == 0.04
    assert machine(tmp_path, BASIC).wheel.runout == 0


@pytest.mark.parametrize("grade", ["4000", "1600", "630", "250", "100", "40", "16", "6.3", "2.5", "1", "0.4"])
def test_balance_grades(tmp_path: Path, grade: str) -> None:
    wheel = machine(tmp_path, BASIC.replace("imbalance_g_mm = 150.0", f'balance_grade = "G{grade}"')).wheel
    assert wheel.grade == float(grade) and wheel.imbalance_g_mm is None
