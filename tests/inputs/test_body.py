"""The machine and its suspension: springs or hands, and a range that holds the rated speed."""

from pathlib import Path

import pytest

from abu_calc.inputs.machine import MachineFile
from tests.inputs.samples import BASIC, document, read


def machine(folder: Path, text: str) -> MachineFile:
    loaded = read(folder, text).tables
    assert isinstance(loaded, MachineFile)
    return loaded


@pytest.mark.parametrize(("written", "pair"), [("2", (2, 2)), ("[2]", (2, 2)), ("[2, 3.5]", (2, 3.5))])
def test_one_number_or_two(tmp_path: Path, written: str, pair: tuple[float, float]) -> None:
    text = BASIC.replace("[2.5, 2.5]", written).replace("[0.5, 0.5]", written)
    suspension = machine(tmp_path, text).suspension
    assert (suspension.frequencies, suspension.dampings) == (pair, pair)


def test_hands_bring_their_own_numbers(tmp_path: Path) -> None:
    start, end = BASIC.index("[suspension]"), BASIC.index("[wheel]")
    suspension = machine(tmp_path, BASIC[:start] + '[suspension]\nmodel = "hands"\n' + BASIC[end:]).suspension
    assert suspension.frequencies is None and suspension.dampings is None


def test_a_range_holds_the_rated_speed_at_its_ends_too(tmp_path: Path) -> None:
    for written in ("[5800, 6000]", "[5000, 5800]", "[5000, 6000]"):
        text = BASIC.replace("speed_rpm = 5800", f"speed_rpm = 5800\nspeed_range_rpm = {written}")
        assert list(machine(tmp_path, text).machine.speed_range) == document(f"a = {written}")["a"]
