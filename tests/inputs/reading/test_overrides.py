"""`--set table.key=value`."""

from pathlib import Path

import pytest

from abu_calc.inputs.bearing_file import BearingFile
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.overrides import parse_override
from tests.inputs.samples import BASIC, BEARINGS, read, refused


@pytest.mark.parametrize(
    ("written", "path", "value"),
    [
        ("machine.mass_kg=5.6", ("machine", "mass_kg"), 5.6),
        (" machine.mass_kg = 5 ", ("machine", "mass_kg"), 5),
        ("suspension.natural_frequencies_hz=[2.5,3]", ("suspension", "natural_frequencies_hz"), [2.5, 3]),
        ('bearing[0].shaft_fit="m6"', ("bearing", 0, "shaft_fit"), "m6"),
        ("bearing.0.shaft_fit=m6", ("bearing", 0, "shaft_fit"), "m6"),
        ("bearing[12].shaft_fit='m6'", ("bearing", 12, "shaft_fit"), "m6"),
        ("machine.name=MSh 230 # new", ("machine", "name"), "MSh 230 # new"),
        ("machine.name=a=b", ("machine", "name"), "a=b"),
        ("machine.name=2.5 kW", ("machine", "name"), "2.5 kW"),
        ('expected."a.b=c"=3', ("expected", "a.b=c"), 3),
        ("grinding={}", ("grinding",), {}),
        ("a.b=true", ("a", "b"), True),
    ],
)
def test_written_overrides(written: str, path: tuple[str | int, ...], value: object) -> None:
    parsed = parse_override(written)
    assert (parsed.path, parsed.value) == (path, value) and type(parsed.value) is type(value)


@pytest.mark.parametrize(
    ("override", "key", "words"),
    [
        ("machine.mass_kg=5,6", "--set machine.mass_kg", ("a comma in a number", "5.6")),
        ("machine.mass_kg=", "--set machine.mass_kg", ("value is missing",)),
        ("machine.mass_kg", "--set", ("not an override",)),
        ("=5", "--set", ("not an override",)),
        (".=5", "--set", ("not a key path",)),
        ("[0]=5", "--set", ("not a key path",)),
        ("machine..mass_kg=5", "--set", ("not a key path",)),
        ("wheel.runout_mm=[", "--set wheel.runout_mm", ("not a TOML value",)),
        ("machine.mass_kg=heavy", "--set machine.mass_kg", ("a number is expected",)),
        ("machine.mass_kg=0", "--set machine.mass_kg", ("at least 0.001 kg",)),
        ("machine.mas_kg=5", "--set machine.mas_kg", ("nearest known key is mass_kg",)),
        ("machine.mass_g=5600", "--set machine.mass_g", ("kg instead of g",)),
        ("whel.mass_kg=5", "--set whel.mass_kg", ("unknown table", "[wheel]")),
        ("machine.mass_kg.x=5", "--set machine.mass_kg.x", ("no table",)),
        ("bearing.shaft_fit=m6", "--set bearing.shaft_fit", ("[0]",)),
        ("bearing[1].shaft_fit=m6", "--set bearing[1].shaft_fit", ("has 1 of them",)),
        ("machine[0].name=a", "--set machine[0].name", ("not an array",)),
        ("bearing[0].shaft_fit=M6", "--set bearing[0].shaft_fit", ('write "m6"',)),
        ("bearing[0].designation=6203", "--set bearing[0].designation", ('write "6203" in quotes',)),
        ("grinding.contact=soft", "--set grinding.contact", ("compliant",)),
        ("motor.no_load_speed_rpm=100", "--set motor.no_load_speed_rpm", ("at least 5800 rpm",)),
        ("suspension.natural_frequencies_hz=[2,5,2,5]", "--set suspension.natural_frequencies_hz", ("too many",)),
    ],
)
def test_wrong_overrides_name_the_option(tmp_path: Path, override: str, key: str, words: tuple[str, ...]) -> None:
    error = refused(tmp_path, BASIC, [override])
    assert error.place.key == key and error.place.line is None and error.place.file is None, str(error)
    for word in words:
        assert word.casefold() in str(error).casefold()


def machine(folder: Path, overrides: list[str], text: str = BASIC) -> MachineFile:
    loaded = read(folder, text, overrides).tables
    assert isinstance(loaded, MachineFile)
    return loaded


def test_an_entry_is_replaced_and_the_rest_stays(tmp_path: Path) -> None:
    changed = machine(tmp_path, ["machine.mass_kg=4.2", "bearing[0].shaft_fit=m6", "machine.mass_kg=4.3"])
    assert changed.machine.mass_kg == 4.3 and changed.bearing[0].shaft_fit == "m6"
    assert changed.model_copy(update={"machine": None, "bearing": None}) == machine(tmp_path, []).model_copy(
        update={"machine": None, "bearing": None}
    )


def test_a_missing_table_is_made(tmp_path: Path) -> None:
    grinding = machine(tmp_path, ["grinding.press_force_N=30"]).grinding
    assert grinding is not None and grinding.press_force_N == 30


def test_one_source_of_imbalance_takes_the_place_of_another(tmp_path: Path) -> None:
    measured = BASIC.replace("imbalance_g_mm = 150.0", 'measured_level_db = 111\nmeasured_at = "front"')
    measured += '[[machine.handle]]\nname = "front"\nfrom_center_of_mass_mm = 100\n'
    loaded = read(tmp_path, measured, ["wheel.imbalance_g_mm=200"])
    assert isinstance(loaded.tables, MachineFile)
    wheel = loaded.tables.wheel
    assert (wheel.imbalance_g_mm, wheel.measured_level_db, wheel.measured_at) == (200, None, None)
    assert "--set wheel.imbalance_g_mm takes the place of wheel.measured_level_db" in loaded.warnings
    again = machine(tmp_path, ["wheel.measured_level_db=[109,110]"], measured).wheel
    assert again.measured_level_db == (109, 110) and again.measured_at == "front"


def test_two_sources_of_imbalance_set_at_once_are_refused(tmp_path: Path) -> None:
    error = refused(tmp_path, BASIC, ["wheel.imbalance_g_mm=200", "wheel.balance_grade=G16"])
    assert "exactly one source" in str(error)


def test_other_keys_that_exclude_each_other(tmp_path: Path) -> None:
    runout = BASIC.replace("diameter_mm = 150.0", "diameter_mm = 150.0\nrunout_mm = 0.04")
    assert machine(tmp_path, ["wheel.runout_tir_mm=0.1"], runout).wheel.runout == pytest.approx(5e-5)
    assert machine(tmp_path, ["suspension.model=hands"]).suspension.frequencies is None
    stiff = BASIC + "[grinding]\ncontact_stiffness_N_per_m = 1e6\n"
    grinding = machine(tmp_path, ["grinding.contact=rigid"], stiff).grinding
    assert grinding is not None and grinding.contact == "rigid"
    sized = machine(tmp_path, ["bearing[0].bore_mm=20", "bearing[0].outer_mm=47", "bearing[0].width_mm=14"])
    assert sized.bearing[0].designation is None


def test_bearings_alone_take_overrides_too(tmp_path: Path) -> None:
    loaded = read(tmp_path, BEARINGS, ["bearing[1].housing_fit=M7"]).tables
    assert isinstance(loaded, BearingFile) and loaded.bearing[1].housing_fit == "M7"
