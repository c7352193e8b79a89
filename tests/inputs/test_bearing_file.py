"""Files for bearing seats alone, and the values that any file expects of its results."""

from pathlib import Path

from abu_calc.inputs.machine import BearingFile, MachineFile, expected_tolerances, expected_values
from tests.inputs.samples import BASIC, BEARINGS, read


def machine(folder: Path, text: str) -> MachineFile:
    loaded = read(folder, text).tables
    assert isinstance(loaded, MachineFile)
    return loaded


def test_bearings_alone(tmp_path: Path) -> None:
    loaded = read(tmp_path, BEARINGS)
    assert isinstance(loaded.tables, BearingFile)
    assert [bearing.name for bearing in loaded.tables.bearing] == ["left", "bearing"]
    assert loaded.tables.limits.vibration_level_db == 109
    assert dict(loaded.defaults_used)["bearing[1].housing_material"] == "steel"
    assert loaded.tables.bearing[1].shaft_fit is None  # which to write is the answer, never a default


def test_expectations_and_their_tolerances(tmp_path: Path) -> None:
    more = '[expected]\n"a.b" = 3\nstatus = "pass"\n[expected.tolerance]\n"a.b" = 1e-6\n'
    file = machine(tmp_path, BASIC + more)
    assert expected_values(file) == {"a.b": 3, "status": "pass"} and expected_tolerances(file) == {"a.b": 1e-6}
    assert expected_tolerances(machine(tmp_path, BASIC)) == {}
