"""Files for bearing seats alone, and the values that any file expects of its results."""

from pathlib import Path

import pytest

from abu_calc.inputs.bearing_file import BearingFile, expected_tolerances, expected_values
from abu_calc.inputs.machine import MachineFile
from tests.inputs.samples import BASIC, BEARINGS, read, refused


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


@pytest.mark.parametrize(("line", "key"), [
    ('"a.b" = inf', 'expected."a.b"'), ('"a.b" = [1, [nan]]', 'expected."a.b"'),
    ('"a.b" = 2020-01-01', 'expected."a.b"'),
    ('a.b = 3', "expected.a"), ('"a..b" = 3', 'expected."a..b"'), ('"a.1234567" = 3', 'expected."a.1234567"'),
    ('x = 1\n[expected.tolerance]\nx = -0.1', "expected.tolerance.x"),
    ('x = 1\n[expected.tolerance]\ny = 0.1', "expected.tolerance.y"),
])  # fmt: skip
def test_what_no_result_can_hold_is_not_expected(tmp_path: Path, line: str, key: str) -> None:
    assert refused(tmp_path, f"{BEARINGS}[expected]\n{line}\n").place.key == key
