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
        assert list(machine(tmp_path, text).machine.speeds_rpm) == document(f"a = {written}")["a"]


BODY = "center_of_mass_from_wheel_mm = [-95, 0, -48]\ninertia_kg_m2 = [0.004, 0.02, 0.019]\n"
"""A body in space, as lines of [machine]."""


def with_lines(lines: str, text: str = BASIC) -> str:
    return text.replace("mass_kg = 5.6", f"mass_kg = 5.6\n{lines.strip()}")


def test_body_in_space_reads(tmp_path: Path) -> None:
    table = machine(tmp_path, with_lines(f"{BODY}inertia_xz_kg_m2 = -0.0015\nrotor_polar_inertia_kg_m2 = 0")).machine
    assert table.center_of_mass_from_wheel_mm == (-95, 0, -48) and table.inertia_kg_m2 == (0.004, 0.02, 0.019)
    assert not table.estimates


def test_handle_in_space_and_one_along_the_spindle(tmp_path: Path) -> None:
    handles = '[[machine.handle]]\nname = "a"\nposition_mm = [1, 2, 3]\n[[machine.handle]]\nname = "b"\n'
    first, second = machine(tmp_path, BASIC + handles + "from_center_of_mass_mm = -4\n").machine.handle
    assert first.position == (1e-3, 2e-3, 3e-3) and second.position == (0, 0, -4e-3)


@pytest.mark.parametrize(
    ("layout", "lines", "estimates"),
    [
        ("straight", "length_mm = 450", True),
        ("straight", "height_mm = 450", False),
        ("face", "height_mm = 300", True),
        ("face", "length_mm = 300", False),
        ("angle", "length_mm = 300\nheight_mm = 60", True),
        ("angle", "length_mm = 300", True),
        ("angle", "height_mm = 60", False),
        ("angle", "length_mm = 300\ncenter_of_mass_from_wheel_mm = [-90, 0, -50]", True),
        ("straight", f"length_mm = 450\n{BODY}", False),
    ],
)
def test_lengths_that_make_an_estimate(tmp_path: Path, layout: str, lines: str, estimates: bool) -> None:
    text = with_lines(lines).replace('layout = "straight"', f'layout = "{layout}"')
    assert machine(tmp_path, text).machine.estimates == estimates


@pytest.mark.parametrize(
    ("lines", "key", "words"),
    [
        ("inertia_kg_m2 = [0.004, 0.02, 0.019]", "inertia_kg_m2", "center_of_mass_from_wheel_mm"),
        ("center_of_mass_from_wheel_mm = [-95, 0, -48]", "center_of_mass_from_wheel_mm", "length_mm"),
        ("inertia_xz_kg_m2 = 0.001", "inertia_xz_kg_m2", "inertia_kg_m2"),
        ("rotor_polar_inertia_kg_m2 = 0.001", "rotor_polar_inertia_kg_m2", "length_mm"),
        (f"{BODY}transverse_inertia_kg_m2 = 0.1\ncenter_of_mass_to_wheel_mm = 200", "inertia_kg_m2", "two ways"),
        (BODY.replace("0.004", "0"), "inertia_kg_m2[0]", "above 0"),
        (BODY.replace("0.004", "-1"), "inertia_kg_m2[0]", "above 0"),
        (BODY.replace("0.004", "nan"), "inertia_kg_m2[0]", ""),
        (BODY.replace("0.004, ", ""), "inertia_kg_m2", ""),
        (BODY.replace("-95, ", ""), "center_of_mass_from_wheel_mm", ""),
        (BODY.replace("-95", "true"), "center_of_mass_from_wheel_mm[0]", ""),
        ('length_mm = "450"', "length_mm", ""),
        ("length_mm = 0", "length_mm", "above 0"),
        ("height_mm = -3", "height_mm", "above 0"),
    ],
)
def test_odd_bodies_are_refused(tmp_path: Path, lines: str, key: str, words: str) -> None:
    error = refused(tmp_path, with_lines(lines))
    assert error.place.key == f"machine.{key}"
    assert words in f"{error.message} {error.allowed} {error.remedy}"


@pytest.mark.parametrize(
    "place", ["", "from_center_of_mass_mm = 1\nposition_mm = [1, 2, 3]\n", "position_mm = [1, 2]\n"]
)
def test_handle_has_one_place(tmp_path: Path, place: str) -> None:
    error = refused(tmp_path, f'{BASIC}[[machine.handle]]\nname = "a"\n{place}')
    assert (error.place.key or "").startswith("machine.handle[0]")


@pytest.mark.parametrize("limit", ["0", "-1", "nan", "true"])
def test_odd_limits_of_acceleration_are_refused(tmp_path: Path, limit: str) -> None:
    text = BASIC.replace("[limits]", f"[limits]\na_hv_m_per_s2 = {limit}")
    text = text if "[limits]" in BASIC else f"{BASIC}[limits]\na_hv_m_per_s2 = {limit}\n"
    assert refused(tmp_path, text).place.key == "limits.a_hv_m_per_s2"
