"""The machine and its suspension: springs or hands, and a range that holds the rated speed."""

from pathlib import Path

import pytest

from abu_calc.inputs.machine import MachineFile
from tests.inputs.samples import BASIC, document, read, refused


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


def test_a_range_that_falls_or_misses_the_rated_speed_is_refused(tmp_path: Path) -> None:
    for written, remedy in (("[6000, 5000]", "write speed_range_rpm = [5000, 6000]"), ("[100, 200]", "widen")):
        error = refused(tmp_path, BASIC.replace("speed_rpm = 5800", f"speed_rpm = 5800\nspeed_range_rpm = {written}"))
        assert error.place.key == "machine.speed_range_rpm" and remedy in (error.remedy or "")


@pytest.mark.parametrize("key", ["transverse_inertia_kg_m2", "center_of_mass_to_wheel_mm"])
def test_half_a_rigid_body_is_refused(tmp_path: Path, key: str) -> None:
    error = refused(tmp_path, BASIC.replace("mass_kg = 5.6", f"mass_kg = 5.6\n{key} = 100"))
    assert error.place.key == f"machine.{key}" and "only together" in error.message


def test_two_handles_of_one_name_are_refused_at_the_second(tmp_path: Path) -> None:
    handle = '[[machine.handle]]\nname = "front"\nfrom_center_of_mass_mm = 1\n'
    assert refused(tmp_path, BASIC + 2 * handle).place.key == "machine.handle[1].name"


def test_hands_take_no_frequencies_and_springs_need_them(tmp_path: Path) -> None:
    hands = refused(tmp_path, BASIC.replace('"springs"', '"hands"'))
    assert hands.place.key == "suspension.natural_frequencies_hz" and "ISO 10068" in hands.message
    assert refused(tmp_path, BASIC.replace("damping_ratios", "# ")).place.key == "suspension.damping_ratios"
