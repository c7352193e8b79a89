"""Files of readings: schema, template, what is refused and with which words; the kinds of files told apart."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft4Validator

import abu_calc
from abu_calc.features.balancing.read import read_readings, readings_template
from abu_calc.features.balancing.tables import ReadingsFile
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import read_file
from abu_calc.inputs.reading import sources as presets
from abu_calc.inputs.reading.errors import SpecErrors
from abu_calc.inputs.reading.kinds import KINDS, kind_of
from abu_calc.inputs.reading.schema import WIDTH, schema_of
from abu_calc.inputs.reading.table import all_tables, usual_of
from tests.features.balancing.rig import BARE_ROTOR, RIG, ROTOR, Workshop, written
from tests.inputs.agreeing import check_schema, right_but_for_rules
from tests.inputs.reading.test_schema import VALUES, places
from tests.inputs.samples import document, mutated

RUN = """\
[[run]]
speed_rpm = 3000.0
quantity = "displacement"
left = { amplitude = 0.038109, phase_deg = 18.7489 }
right = { amplitude = 0.031642, phase_deg = 152.7485 }
sensor_to_mark_deg = 0.0
"""
FULL = "\n".join([
    RIG, "damping_ratio = 0.01", ROTOR, 'name = "screw"', "max_removable_g = 50.0", "left_places_deg = [0, 120, 240]",
    "right_places_deg = [10.0, 100.0]", 'turns_from_left = "clockwise"', "first_bending_speed_rpm = 9000.0", RUN,
    'trial = [{ plane = "left", mass_g = 10.0, angle_deg = 0.0, radius_mm = 100.0 }]', RUN,
    'trial = { plane = "right", mass_g = -10, angle_deg = 10 }', '[[run]]\nquantity = "velocity"\nfile = "run1.csv"',
    'mark_edge = "leading"', "[errors]\namplitude_percent = 2.0", '[tolerance]\nbalance_grade = "G6.3"',
    "service_speed_rpm = 1500.0", '[expected]\n"left.mass_g" = 12.0\n[expected.tolerance]\n"left.mass_g" = 0.1',
])  # fmt: skip
SCHEMA = schema_of("readings")
VALIDATOR = Draft4Validator(SCHEMA)
SAMPLES = [document(FULL.split("[expected.tolerance]")[0]), document(RIG + ROTOR + RUN)]
PLACES = [(number, path) for number, sample in enumerate(SAMPLES) for path in places(sample)]


def refused(folder: Path, *parts: str) -> InputError:
    with pytest.raises(InputError) as error:
        read_readings(written(folder, *parts))
    return error.value


def test_the_schema_is_of_draft_4_with_a_description_of_every_key() -> None:
    check_schema(SCHEMA)


@pytest.mark.parametrize("text", [FULL, readings_template(), RIG + ROTOR + RUN], ids=["full", "template", "least"])
def test_good_files_validate(text: str) -> None:
    VALIDATOR.validate(document(text))


@pytest.mark.slow
@settings(deadline=None, derandomize=True, max_examples=300)
@given(place=st.sampled_from(PLACES), how=st.sampled_from(["replace", "remove", "add"]), value=st.sampled_from(VALUES))
def test_schema_and_models_agree(place: tuple[int, tuple[Any, ...]], how: str, value: Any) -> None:
    number, path = place
    data = mutated(SAMPLES[number], path, how, value)
    assert VALIDATOR.is_valid(data) == right_but_for_rules(ReadingsFile, data)


def test_the_template_reads_back_and_names_every_key(tmp_path: Path) -> None:
    text = readings_template()
    found = read_readings(written(tmp_path, text))
    assert found.warnings == () and found.defaults_used == () and found.tables.rig is not None
    assert max(map(len, text.splitlines())) <= WIDTH + 2
    rows = [row.lstrip("#") for row in text.splitlines() if not row.startswith("# ")]
    for path, table in all_tables(ReadingsFile):
        if table.inline:
            assert any(row.startswith(f"{path[-1]} = {{") for row in rows), path
            continue
        header = next(row for row in rows if row.strip("[]") == ".".join(path) and row.startswith("["))
        block = rows[rows.index(header) + 1 :]
        end = next((index for index, row in enumerate(block) if row.startswith("[")), len(block))
        assert [row.split(" = ")[0] for row in block[:end] if row] == list(table.model_fields), path


def test_examples_are_usual_and_usual_is_allowed() -> None:
    seen = 0
    for _, table in all_tables(ReadingsFile):
        for field in table.model_fields.values():
            if usual := usual_of(field):
                values = [one for one in (*(field.examples or ()), field.default) if isinstance(one, (int, float))]
                assert all(map(usual.holds, values)) and usual.low < usual.high
                seen += 1
    assert seen > 25


WRONG = [
    ("damping_ratio = 0.01", "damping_ratio = 2", "rig.damping_ratio", "out of range"),
    ("left_stiffness_N_per_m = 3.0e5", "left_stiffness_N_per_m = 0", "rig.left_stiffness_N_per_m", "above 0"),
    ("left_stiffness_N_per_m = 3.0e5", "left_stiffness = 3.0e5", "rig.left_stiffness", "left_stiffness_N_per_m"),
    ("right_support_mass_kg = 21.0", 'right_support_mass_kg = "21"', "rig.right_support_mass_kg", "a number"),
    ("\nmass_kg = 64.0", "", "rotor.mass_kg", "add mass_kg"),
    ("left_plane_to_centre_m = 0.52", "left_plane_to_centre_m = -520", "rotor.left_plane_to_centre_m", "at least -100"),
    ("left_plane_to_centre_m = 0.52", "left_plane_to_centre_m = 520", "rotor.left_plane_to_centre_m", "meant in mm"),
    ("left_correction_radius_mm = 120.0", "", "rotor.left_correction_radius_mm", "missing"),
    ("[0, 120, 240]", "[0, 180]", "rotor.left_places_deg", "one line"),
    ("[0, 120, 240]", "[30]", "rotor.left_places_deg", "too few"),
    ('"clockwise"', '"left"', "rotor.turns_from_left", "clockwise"),
    ('"displacement"', '"shift"', "run[0].quantity", "displacement"),
    ('quantity = "displacement"', "", "run[0].quantity", "missing"),
    ("speed_rpm = 3000.0", "", "run[0].speed_rpm", "or file"),
    ("speed_rpm = 3000.0", "speed_rpm = true", "run[0].speed_rpm", "a number"),
    ("speed_rpm = 3000.0", "speed_rpm = nan", "run[0].speed_rpm", "finite"),
    ("left = { amplitude = 0.038109, phase_deg = 18.7489 }", "", "run[0].left", "or file"),
    ("amplitude = 0.038109", "amplitude = -1.0", "run[0].left.amplitude", "at least 0"),
    ("phase_deg = 18.7489", "phase = 18.7489", "run[0].left.phase", "belongs in [[run]]"),
    ("phase_deg = 18.7489", "phase_deg = 1e9", "run[0].left.phase_deg", "at most 360"),
    ('plane = "left"', 'plane = "middle"', "run[0].trial[0].plane", "left"),
    ("mass_g = 10.0", "mass_g = 0", "run[0].trial[0].mass_g", "nothing"),
    ('file = "run1.csv"', "", "run[2].speed_rpm", "or file"),
    ('file = "run1.csv"', 'file = "run2.csv"', "run[2].file", "not there"),
    ('"G6.3"', '"G6"', "tolerance.balance_grade", "G6.3"),
    ("amplitude_percent = 2.0", "amplitude_percent = -2.0", "errors.amplitude_percent", "at least 0"),
    ("[tolerance]", "[limits]", "limits", "unknown table"),
    (
        'trial = [{ plane = "left", mass_g = 10.0, angle_deg = 0.0, radius_mm = 100.0 }]',
        "trial = [5]",
        "run[0].trial[0]",
        "table",
    ),
    ("left = { amplitude = 0.038109, phase_deg = 18.7489 }", "left = 0.038", "run[0].left", "a table is expected"),
]


@pytest.mark.parametrize(("old", "new", "key", "words_"), WRONG, ids=[f"{one[2]}: {one[1][:20]}" for one in WRONG])
def test_wrong_files_are_refused_with_key_line_and_remedy(
    tmp_path: Path, old: str, new: str, key: str, words_: str
) -> None:
    (tmp_path / "run1.csv").write_text("time,left,right,mark\n")
    assert old in FULL
    error = refused(tmp_path, FULL.replace(old, new, 1))
    faults = error.errors if isinstance(error, SpecErrors) else (error,)
    fault = next((one for one in faults if one.place.key == key), None)
    assert fault is not None, str(error)
    assert words_.casefold() in str(fault).casefold() and fault.place.line is not None


def test_rules_between_tables(tmp_path: Path) -> None:
    assert "two planes coincide" in str(
        refused(tmp_path, RIG, ROTOR.replace("= 0.52", "= 0").replace("= 0.61", "= 0"), RUN)
    )
    with pytest.raises(InputError, match=r"without \[rig\] the rig is not known"):
        abu_calc.balance(written(tmp_path, BARE_ROTOR, RUN))
    assert "balance grade needs" in str(
        refused(tmp_path, BARE_ROTOR, RUN, 'trial = { plane = "left", mass_g = 1, angle_deg = 0 }',
                '[tolerance]\nbalance_grade = "G6.3"')
    )  # fmt: skip
    assert "[run]" in str(refused(tmp_path, RIG, ROTOR)) or "run" in str(refused(tmp_path, RIG, ROTOR))
    assert "read or recorded" in str(refused(tmp_path, RIG, ROTOR, RUN, 'file = "x.csv"'))
    assert "mark_edge goes with file" in str(refused(tmp_path, RIG, ROTOR, RUN, 'mark_edge = "leading"'))


def test_what_is_unusual_is_warned_of(tmp_path: Path) -> None:
    file = written(tmp_path, RIG.replace("= 3.0e5", "= 300"), ROTOR.replace("= 9.5", "= 95"), RUN)
    first, second = read_readings(file).warnings
    assert "left_stiffness_N_per_m = 300 (line" in first and "N/mm (300000 N/m)" in first
    assert "transverse_inertia_kg_m2 = 95" in second and "the two ends would have" in second


# Kinds of files


@pytest.mark.parametrize("name", presets.names())
def test_every_preset_is_of_a_kind_and_has_a_title(name: str) -> None:
    found = read_file(name)
    assert kind_of(found.document.content) in KINDS and found.title


def test_a_file_of_another_kind_is_refused_with_the_command_that_takes_it(tmp_path: Path) -> None:
    readings = written(tmp_path, RIG, ROTOR, RUN)
    with pytest.raises(InputError, match=r"readings of a rig, not a machine\n  `abu balance FILE`"):
        abu_calc.read(readings)
    with pytest.raises(InputError, match=r"readings of a rig, not a scene"):
        abu_calc.read_scene(readings)
    with pytest.raises(InputError, match=r"a machine, not readings of a rig\n  `abu size FILE`"):
        abu_calc.balance("msh-230")
    with pytest.raises(InputError, match="not the name of a file"):
        abu_calc.balance(abu_calc.read("msh-230"))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("entry", "key"),
    [
        ('{ plane = "Left", mass_g = 5.0, angle_deg = 0.0 }', "run[0].trial.plane"),
        ('{ plane = "left", mass_kg = 0.005, angle_deg = 0.0 }', "run[0].trial.mass_kg"),
        ("{ mass_g = 5.0, angle_deg = 0.0 }", "run[0].trial.plane"),
        ('{ plane = "left", mass_g = "5", angle_deg = 0.0 }', "run[0].trial.mass_g"),
    ],
)
def test_the_key_of_a_single_trial_is_named(tmp_path: Path, entry: str, key: str) -> None:
    text = "\n".join([BARE_ROTOR, Workshop().run(f"trial = {entry}")])
    file = tmp_path / "readings.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        abu_calc.balance(file)
    assert f"{key}: " in str(refused.value) and "[[run.trial]]" not in str(refused.value)
