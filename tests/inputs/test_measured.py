"""Levels measured by octaves: what a table of them may hold, and what is refused with its key."""

from pathlib import Path

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.measured import MeasuredOctave
from tests.inputs.samples import BASIC, read

GOOD = {"place": '"handle"', "axis": '"y"', "state": '"idle"', "octave_hz": "125", "level_db": "[102, 103]",
        "source": '"own"'}  # fmt: skip


def text(**changes: str | None) -> str:
    lines = [f"{key} = {value}" for key, value in (GOOD | changes).items() if value is not None]
    return BASIC + "\n[[measured]]\n" + "\n".join(lines) + "\n"


def test_levels_of_several_kinds(tmp_path: Path) -> None:
    file = read(tmp_path, text(lowered_db="[-3, 2.5]", level_without_db="[108, 111]")).tables
    assert isinstance(file, MachineFile)
    [measured] = file.measured
    assert dict(measured.spans) == {"level_db": (102, 103), "level_without_db": (108, 111), "lowered_db": (-3, 2.5)}
    assert isinstance(measured, MeasuredOctave) and measured.remark is None


def test_a_peak_without_a_number_needs_a_remark(tmp_path: Path) -> None:
    file = read(tmp_path, text(level_db=None, remark='"A peak is named without a number."')).tables
    assert isinstance(file, MachineFile) and not list(file.measured[0].spans)


@pytest.mark.parametrize(("changes", "key", "word"), [
    ({"octave_hz": "100"}, "octave_hz", "octave_hz = 125"), ({"octave_hz": "nan"}, "octave_hz", ""),
    ({"octave_hz": '"125"'}, "octave_hz", ""), ({"octave_hz": "0"}, "octave_hz", ""),
    ({"level_db": "[103, 102]"}, "level_db", "[102, 103]"), ({"level_db": "[102]"}, "level_db", ""),
    ({"level_db": "102"}, "level_db", ""), ({"level_db": "[102, inf]"}, "level_db", ""),
    ({"level_db": "[102, 201]"}, "level_db", ""), ({"lowered_db": "[-70, 3]"}, "lowered_db", ""),
    ({"axis": '"w"'}, "axis", ""), ({"state": '"pressed"'}, "state", ""), ({"source": None}, "source", ""),
    ({"place": '""'}, "place", ""), ({"level_db": None}, "", "level_db"), ({"level": "[1, 2]"}, "level", "level_db"),
])  # fmt: skip
def test_wrong_values_are_refused_with_line_and_key(
    tmp_path: Path, changes: dict[str, str | None], key: str, word: str
) -> None:
    with pytest.raises(InputError) as refused:
        read(tmp_path, text(**changes))
    told = str(refused.value)
    assert f"measured[0].{key}".rstrip(".") in told and word in told, told
