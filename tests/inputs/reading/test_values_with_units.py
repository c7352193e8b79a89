"""Values with units in files: taken in every table, echoed, never in both forms, and a hundred wrong ones refused.

Values that scripts give are those a file would hold; nothing is nested without end.
"""

import datetime
import re
import subprocess
import sys
from collections import OrderedDict
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft4Validator

import abu_calc
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.written_units import written_unit
from abu_calc.inputs.reading.kinds import KINDS
from abu_calc.inputs.reading.schema import CANONICAL, schema_of
from abu_calc.inputs.reading.sources import text_of
from abu_calc.inputs.reading.table import Table, all_tables, subtable
from abu_calc.inputs.reading.values_with_units import (
    DEEPEST,
    canonical_keys,
    check_nesting,
    found_as,
    plain_number,
    plain_value,
)
from tests.cli.runner import again
from tests.rows import for_each

PRESET = "avtovaz-707-222"
TEXT = text_of(PRESET)
SCHEMA = {kind.name: schema_of(kind.name) for kind in KINDS}


def with_entry(key: str, entry: str) -> tuple[str, int]:
    """The preset with the line of a key replaced, and the number of that line."""
    text, count = re.subn(rf"(?m)^{key} = .*$", entry, TEXT, count=1)
    assert count == 1
    return text, next(k for k, line in enumerate(text.split("\n"), 1) if line == entry)


def models() -> dict[str, type[Table]]:
    from abu_calc.features.balancing.tables import ReadingsFile
    from abu_calc.features.declare.read import RecordingsFile
    from abu_calc.inputs.bearing_file import BearingFile
    from abu_calc.inputs.machine import MachineFile
    from abu_calc.simulation.scene_file import SceneFile

    return {model.__name__: model for model in (MachineFile, BearingFile, SceneFile, ReadingsFile, RecordingsFile)}


def test_a_value_with_its_unit_is_the_value_of_the_key() -> None:
    text, _ = with_entry("mass_kg", 'mass = "5600 g"')
    machine = abu_calc.read(text)
    assert machine.tables == abu_calc.read(PRESET).tables
    assert [str(each) for each in machine.converted] == ['machine.mass = "5600 g": machine.mass_kg = 5.6']


def test_every_key_with_a_unit_takes_one_and_no_two_share_a_name() -> None:
    """In every table of every kind of file; no key without its unit is another key's name."""
    count = 0
    for root in models().values():
        for _, table in (((), root), *all_tables(root)):
            keys = canonical_keys(table)
            united = [key for key in table.model_fields if written_unit(key) and subtable(table, key) is None]
            assert sorted(keys.values()) == sorted(united), table
            assert not set(keys) & set(table.model_fields)
            count += len(keys)
    assert count > 150


def test_lists_tables_and_arrays_of_tables() -> None:
    scene = abu_calc.read_scene(
        """
[scene]
support = "planar"
mass = "100 g"
speed = "100 Hz"
duration = "50 ms"
stiffness = ["4 N/mm", "4000 N/m"]
damping = ["0.2 N·s/m", "0.2 N·s/m"]
imbalance = "1 g·cm"
[[scene.race]]
pitch_radius = "1 in"
ball_masses = ["1 g", "1000 mg"]
rolling_drag = "600 1/min"
start_angles = ["1.5 rad", "-90 deg"]
start_speeds = ["0 rpm", "0 rpm"]
[scene.effects]
dry_rolling_friction = { lever_arm = "2 µm", ball_radius = "8 mm" }
"""
    ).scene
    race = scene.race[0]
    assert (scene.mass_kg, scene.speed_rpm, scene.duration_s, scene.imbalance_g_mm) == (0.1, 6000.0, 0.05, 10.0)
    assert scene.stiffness_N_per_m == (4000.0, 4000.0)
    assert (race.pitch_radius_mm, race.ball_masses_g, race.rolling_drag_per_s) == (25.4, (1.0, 1.0), 10.0)
    assert race.start_angles_deg == pytest.approx((85.94366926962348, -90.0))
    assert scene.effects.dry_rolling_friction.lever_arm_mm == 0.002  # type: ignore[union-attr]


def test_readings_and_recordings_take_them_too() -> None:
    from abu_calc.features.balancing.read import readings_template

    text = readings_template()
    united = text.replace("left_support_mass_kg = 18.0", 'left_support_mass = "18000 g"', 1)
    assert united != text
    assert abu_calc.read_readings(united).tables.rig == abu_calc.read_readings(text).tables.rig  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "entries",
    [
        {"wheel.diameter": "5 in"},
        {"wheel": {**abu_calc.read(PRESET).document.content["wheel"], "diameter_mm": 127.0}},  # type: ignore[dict-item]
    ],
)
def test_changed_takes_them(entries: dict[str, Any]) -> None:
    assert abu_calc.read(PRESET).changed(entries).whole().wheel.diameter_mm == 127.0


def test_a_later_change_replaces_an_earlier_one_in_the_other_form() -> None:
    machine = abu_calc.read(with_entry("mass_kg", 'mass = "5 kg"')[0])
    assert machine.changed({"machine.mass_kg": 6.0}).whole().machine.mass_kg == 6.0
    assert machine.changed({"machine.mass_kg": 6.0}).converted == ()
    twice = machine.changed({"machine.mass": "7000 g"}).changed({"machine.mass": "8000 g"})
    assert twice.whole().machine.mass_kg == 8.0 and len(twice.overrides) == 1
    assert abu_calc.read(twice.to_toml()).tables == twice.tables


def test_an_element_of_a_list() -> None:
    changed = abu_calc.read(PRESET).changed({"suspension.natural_frequencies[0]": "150 rpm"})
    assert changed.whole().suspension.natural_frequencies_hz[0] == 2.5  # type: ignore[index]


def test_never_both_forms_at_once() -> None:
    text, line = with_entry("mass_kg", 'mass = "5.6 kg"')
    with pytest.raises(InputError, match="stands twice") as caught:
        abu_calc.read(text.replace('mass = "5.6 kg"', 'mass = "5.6 kg"\nmass_kg = 5.6'))
    assert (caught.value.place.line, caught.value.place.key) == (line, "machine.mass")
    with pytest.raises(InputError, match="given twice"):
        abu_calc.read(PRESET).changed({"machine.mass": "5 kg", "machine.mass_kg": 5.0})


def test_a_number_out_of_range_is_told_with_what_was_written() -> None:
    text, line = with_entry("mass_kg", 'mass = "560 t"')
    with pytest.raises(InputError, match="out of range") as caught:
        abu_calc.read(text)
    assert caught.value.place.line == line and 'mass = "560 t"' in str(caught.value)


def test_what_is_no_text_stays_an_unknown_key() -> None:
    for entry in ("mass = 5.6", "mass = true", "mass = [5.6]"):
        with pytest.raises(InputError, match="unknown key"):
            abu_calc.read(with_entry("mass_kg", entry)[0])


WRONG_TEXTS = (
    "5.6", "kg", "", "5,6 kg", "5 KG", "5 pounds", "5 kg.", "5 kilo", "five kg", "5 kgf", "5e kg", "5 kg 3 g", "~5 kg",
    "5 ± 1 kg", "5…6 kg", "> 5 kg", "5 'kg'", "NaN kg", "-inf kg", "5 μkg",
)  # fmt: skip
WRONG_BY_KEY = {
    ("speed_rpm", "machine.speed"):
        "97 1/s|97 rps|97 hz|97 Hertz|97 U/min|97 rad|97 °/s|97 rpm.|97 m/s|97 min",
    ("power_W", "machine.power"):
        "1 hp|1 PS|1 kw|1 kVA|1000 watt|1 J/s|1000|1 MW|1 kW·h|1 W/s",
    ("diameter_mm", "wheel.diameter"):
        "5\"|5 inches|5 ''|5 mm TIR|5 Ø|Ø150 mm|150mm.|0.15 km|150 MM|150 ㎜",
    ("imbalance_g_mm", "wheel.imbalance"):
        "256 g/mm|256 gmm|256 g·mm²|256 mm·g|256 N·m|256 kg|256 G6.3|1 g·mm TIR|256 g-mm|256 g x mm",
    ("max_outer_diameter_mm", "autobalancer.max_outer_diameter"):
        "70|70 mm mm|7 dm|70 um mm|0.07 yd|70 mils|70 %|70 °|70 K|70 dB",
    ("bore_diameter_mm", "autobalancer.bore_diameter"):
        "20 H6|20 mm H6|20 h6|20±0.1 mm|20 Mm|20 m m|20 mm/s|20 mm2|2 cm cm|20mm 5",
    ("race_eccentricity_mm", "autobalancer.race_eccentricity"):
        "10 µm TIR|10 micron|10 μ|0.01|0,01 mm|10 nm|10 µ m|ten µm|10 um TIR|10 um/m",
    ("rolling_drag_per_s", "autobalancer.rolling_drag"):
        "15|15 Hz|15 s|15/s|15 s^-1|15 per s|15 1/h|151/s|15 1 / s|15 rpm",
}  # fmt: skip
WRONG = [("mass_kg", "machine.mass", text) for text in WRONG_TEXTS]
WRONG += [(key, path, text) for (key, path), texts in WRONG_BY_KEY.items() for text in texts.split("|")]


@for_each(WRONG)
def test_a_wrong_unit_is_refused_with_line_key_and_the_allowed_units(key: str, path: str, written: str) -> None:
    quoted = "'" + written + "'" if "'" not in written else '"' + written + '"'
    entry, table = f"{path.split('.')[1]} = {quoted}", path.split(".")[0]
    tables = re.sub(rf"(?m)^{key} = .*\n", "", TEXT.partition("[expected]")[0])
    text = tables.replace(f"[{table}]", f"[{table}]\n{entry}", 1)
    line = next(k for k, row in enumerate(text.split("\n"), 1) if row == entry)
    with pytest.raises(InputError) as caught:
        abu_calc.read(text)
    error, unit = caught.value, written_unit(key)
    assert unit is not None
    assert (error.place.line, error.place.key) == (line, path), error
    assert error.allowed is not None and all(each in error.allowed for each in unit.allowed)
    assert key in str(error.remedy)


def test_several_wrong_ones_are_told_together() -> None:
    text = with_entry("mass_kg", 'mass = "5 stone"')[0].replace("speed_rpm = 5800", 'speed = "97 hz"')
    with pytest.raises(InputError) as caught:
        abu_calc.read(text)
    assert str(caught.value).count("not a unit of") == 2


def test_commands_take_them_and_echo_the_conversion() -> None:
    seen = again("validate", PRESET, "--set", "wheel.diameter=5 in")
    assert seen.status == 0 and 'wheel.diameter = "5 in": wheel.diameter_mm = 127' in seen.out
    refused = again("validate", PRESET, "--set", "wheel.diameter=5 inches")
    assert refused.status == 2 and "--set wheel.diameter" in refused.err and "mm, m, cm, µm, in, mil" in refused.err
    document = again("check-fit", "mmg-3200k-knife-shaft", "--set", "bearing[0].radial_load=3000 N", "--json").document
    assert document["input"]["converted"] == {
        "bearing[0].radial_load_kN": {"written": 'bearing[0].radial_load = "3000 N"', "value": 3.0}
    }
    assert document["input"]["overrides"] == {"bearing[0].radial_load_kN": 3.0}


@pytest.mark.parametrize(
    ("entry", "valid"),
    [
        ('mass = "5.6 kg"', True), ('mass = "5600 g"', True), ("mass_kg = 5.6", True), ('mass = "5.6 Kg"', False),
        ("mass = 5.6", False), ('mass = "5.6 kg"\nmass_kg = 5.6', False), ("", False),
    ],
)  # fmt: skip
def test_the_schema_is_of_one_mind_with_the_reader(entry: str, valid: bool) -> None:
    import tomllib

    text = re.sub(r"(?m)^mass_kg = 5.6.*$", entry, TEXT, count=1)
    assert Draft4Validator(SCHEMA["machine"]).is_valid(tomllib.loads(text)) == valid
    try:
        abu_calc.read(text)
    except InputError:
        assert not valid
    else:
        assert valid


@pytest.mark.parametrize("kind", SCHEMA)
def test_the_schema_has_each_key_without_its_unit(kind: str) -> None:
    for body in SCHEMA[kind]["definitions"].values():
        for name, entry in body.get("properties", {}).items():
            if CANONICAL in entry:
                unit = written_unit(entry[CANONICAL])
                assert unit is not None and unit.stem == name and entry[CANONICAL] in body["properties"]
                pattern = (entry if "pattern" in entry else entry["anyOf"][0])["pattern"]
                for symbol in unit.allowed:
                    assert re.search(pattern, f"1.5 {symbol}"), symbol
                    assert unit.value(f"1.5 {symbol}") is not None
                assert not re.search(pattern, "1.5 furlong")


def test_a_dictionary_takes_them_and_errors_have_no_line() -> None:
    content = abu_calc.read(PRESET).document.content
    content["machine"]["mass"] = "5600 g"  # type: ignore[index]
    del content["machine"]["mass_kg"]  # type: ignore[attr-defined]
    assert abu_calc.read(content).tables == abu_calc.read(PRESET).tables
    content["machine"]["mass"] = "5600 grams"  # type: ignore[index]
    with pytest.raises(InputError) as caught:
        abu_calc.read(content)
    assert (caught.value.place.line, caught.value.place.key) == (None, "machine.mass")


@pytest.mark.slow
def test_files_without_them_load_nothing_for_them() -> None:
    """The table of units is not even imported."""
    code = (
        "import sys\nfrom abu_calc.inputs.read_machine import read\n"
        f"read({PRESET!r})\nprint('abu_calc.foundation.written_units' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["False"]


@pytest.mark.parametrize(("given", "plain"), [
    (np.float64(2.5), 2.5), (np.int32(3), 3), (Decimal("0.5"), 0.5), (Fraction(1, 4), 0.25), (np.str_("mm"), "mm"),
    ((1, (2.0, "x")), [1, [2.0, "x"]]), (OrderedDict(a=np.float32(1.5)), {"a": 1.5}), (True, True),
    (datetime.date(2020, 1, 2), datetime.date(2020, 1, 2)),
])  # fmt: skip
def test_values_of_other_libraries_become_pythons_own(given: object, plain: object) -> None:
    value = plain_value(given, "key")
    assert value == plain and type(value) is type(plain)


@pytest.mark.parametrize("given", [True, "2", None, 2j, Decimal("sNaN"), Fraction(10**400), [1]])
def test_what_is_no_real_number_is_none(given: object) -> None:
    assert plain_number(given) is None


@pytest.mark.parametrize(("given", "key"), [
    (None, "a"), ({"b": {"c": None}}, "a.b.c"), ({"b": [1, object()]}, "a.b"), ({"b": {1: 2}}, "a.b"), ({1, 2}, "a"),
])  # fmt: skip
def test_what_no_file_can_hold_is_refused_by_its_key(given: object, key: str) -> None:
    with pytest.raises(InputError) as refused:
        plain_value(given, "a")
    assert refused.value.place.key == key and refused.value.allowed


def test_a_value_that_holds_itself_is_refused() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(InputError, match="nested too deeply"):
        plain_value(endless, "a")


@pytest.mark.parametrize("text", ["a = " + "[" * 33 + "]" * 33, "a" + ".a" * 40 + " = 1", "a = " + "{a=" * 33])
def test_a_text_nested_too_deeply_is_refused_at_its_line(text: str) -> None:
    with pytest.raises(InputError) as refused:
        check_nesting("# first\n\n" + text, "m.toml")
    assert (refused.value.place.file, refused.value.place.line) == ("m.toml", 3)


@pytest.mark.parametrize("text", [
    "a = " + "[" * DEEPEST + "]" * DEEPEST, "a" + ".a" * (DEEPEST - 1) + " = 1", "a = [1]\n" * 100,
    'a = "' + "[." * 50 + '"',
    "# " + "[" * 50, "a.b = 1\n" * 50, "x = 1.5\n" * 50,
])  # fmt: skip
def test_brackets_in_a_row_or_in_texts_are_not_nested(text: str) -> None:
    check_nesting(text, "m.toml")


def test_a_value_without_a_form_of_its_own_is_shown_by_its_type() -> None:
    class Silent:
        def __repr__(self) -> str:
            raise RuntimeError

    assert found_as(Silent()) == "a value of type Silent"
    assert found_as(10**5000) == "a value of type int"
    assert len(found_as("x" * 100)) == 60
