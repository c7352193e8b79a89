"""Schema and template of scene files, made from the models."""

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft4Validator

from abu_calc.inputs.reading.schema import WIDTH, schema_of, template_of
from abu_calc.inputs.reading.table import all_tables
from abu_calc.simulation.scene_file import SceneFile
from tests.inputs.agreeing import check_schema, right_but_for_rules
from tests.inputs.reading.test_schema import VALUES, places
from tests.inputs.samples import document, mutated
from tests.inputs.scenes import ARM, PLANAR, SCENE, TILTING, read

SCHEMA = schema_of("scene")
VALIDATOR = Draft4Validator(SCHEMA)
SAMPLES = [document(text) for text in (PLANAR, TILTING, ARM)]
PLACES = [(number, path) for number, sample in enumerate(SAMPLES) for path in places(sample)]


def test_it_is_a_schema_of_draft_4_with_a_description_of_every_key() -> None:
    check_schema(SCHEMA)
    assert all(body["description"] for name, body in SCHEMA["definitions"].items() if name != "SceneFile")


@pytest.mark.parametrize("text", [SCENE, PLANAR, TILTING, ARM, template_of("scene")])
def test_good_scenes_validate(text: str) -> None:
    VALIDATOR.validate(document(text))


@settings(deadline=None, derandomize=True, max_examples=300)
@given(place=st.sampled_from(PLACES), how=st.sampled_from(["replace", "remove", "add"]), value=st.sampled_from(VALUES))
@pytest.mark.slow
def test_schema_and_models_agree(place: tuple[int, tuple[Any, ...]], how: str, value: Any) -> None:
    number, path = place
    data = mutated(SAMPLES[number], path, how, value)
    assert VALIDATOR.is_valid(data) == right_but_for_rules(SceneFile, data)


def test_the_template_reads_back_and_names_every_key(tmp_path: Path) -> None:
    text = template_of("scene")
    assert read(tmp_path, text).scene.support == "planar"
    assert max(map(len, text.splitlines())) <= WIDTH + 2
    rows = [row.lstrip("#") for row in text.splitlines() if not row.startswith("# ")]
    for path, table in all_tables(SceneFile):
        header = next(row for row in rows if row.strip("[]") == ".".join(path) and row.startswith("["))
        block = rows[rows.index(header) + 1 :]
        end = next((index for index, row in enumerate(block) if row.startswith("[")), len(block))
        keys = [row.split(" = ")[0] for row in block[:end] if row]
        inner = {path_[-1] for path_, _ in all_tables(SceneFile) if path_[:-1] == path}
        assert keys == [key for key in table.model_fields if key not in inner], path


def test_an_optional_table_reads_once_its_marks_are_taken_away(tmp_path: Path) -> None:
    names = ("gravity", "dry_rolling_friction", "ball_contact", "race_eccentricity", "run_up", "motor")
    for name in (*names, "grinding_contact", "transverse_motion"):
        before, _, after = template_of("scene").partition(f"#[scene.effects.{name}]")
        block, gap, rest = after.partition("\n\n")
        used = "\n".join(row[1:] if row.startswith("#") and row[1:2] != " " else row for row in block.split("\n"))
        assert read(tmp_path, f"{before}[scene.effects.{name}]{used}{gap}{rest}").scene.effects.names == (name,)
