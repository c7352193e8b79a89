"""The JSON Schema: Draft 4 throughout, and of one mind with the models.

The file that `abu init` writes.
"""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from jsonschema import Draft4Validator
from pydantic import ValidationError

from abu_calc.inputs.bearing_file import BearingFile
from abu_calc.inputs.machine import MachineFile
from abu_calc.inputs.reading.schema import WIDTH, schema_of, template_of
from abu_calc.inputs.reading.table import RULE, all_tables
from abu_calc.inputs.wheel import QUANTITIES
from tests.inputs.samples import BASIC, BEARINGS, document, full_text, mutated, read

SCHEMA = schema_of("machine")
VALIDATOR = Draft4Validator(SCHEMA)
DRAFT4 = {
    "$schema", "$ref", "title", "description", "default", "type", "enum", "anyOf", "allOf", "oneOf", "not",
    "definitions", "properties", "patternProperties", "additionalProperties", "required", "minProperties",
    "maxProperties", "items", "additionalItems", "minItems", "maxItems", "uniqueItems", "minimum", "maximum",
    "exclusiveMinimum", "exclusiveMaximum", "multipleOf", "minLength", "maxLength", "pattern", "format",
    "id", "x-usual", "x-canonical-key",
}  # fmt: skip
"""The words of Draft 4, and our own, which editors pass over."""


def words(node: Any) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every keyword of a schema, with the schema it stands in; names of properties are none."""
    if isinstance(node, list):
        for item in node:
            yield from words(item)
    elif isinstance(node, dict):
        for word, value in node.items():
            yield word, node
            if word in ("properties", "definitions", "patternProperties"):
                for body in value.values():
                    yield from words(body)
            elif word not in ("enum", "default"):
                yield from words(value)


def test_it_is_a_schema_of_draft_4_and_json() -> None:
    Draft4Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "http://json-schema.org/draft-04/schema#"
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA


def test_no_word_of_a_later_draft_remains() -> None:
    for word, node in words(SCHEMA):
        assert word in DRAFT4, word
        if word.startswith("exclusive"):
            assert node[word] is True and word.replace("exclusiveM", "m") in node
        if word == "$ref":
            assert node == {"$ref": node["$ref"]} and node["$ref"].split("/")[-1] in SCHEMA["definitions"]
        if word == "anyOf":
            assert len(node[word]) > 1  # editors show the kinds of an anyOf, so a single one would be noise
        if word == "type":
            assert node[word] != "null"


def test_every_key_keeps_its_description_and_its_default() -> None:
    wheel = SCHEMA["definitions"]["Wheel"]["properties"]
    assert wheel["runout_mm"]["default"] == 0 and "[mm]" in wheel["runout_mm"]["description"]
    for name, body in SCHEMA["definitions"].items():
        if name not in ("Machine", "TwoRaceFile", "BearingFile"):
            assert all(key.get("description") for key in body["properties"].values()), name
        assert body["additionalProperties"] is False


@pytest.mark.parametrize(
    "text", [BASIC, BEARINGS, full_text()[0], template_of("machine")], ids=["basic", "bearings", "full", "template"]
)
def test_good_files_validate(text: str) -> None:
    VALIDATOR.validate(document(text))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("mass_kg = 5.6", "mass_kg = 0"),
        ("mass_kg = 5.6", "mass_kg = '5.6'"),
        ("mass_kg = 5.6", "mass_g = 5.6"),
        ("mass_kg = 5.6", ""),
        ("[2.5, 2.5]", "[2.5, 0]"),
        ("[2.5, 2.5]", "[2, 2, 2]"),
        ('"straight"', '"strait"'),
        ("[[bearing]]", "[bearing]"),
        ("k6", "K6"),
        ("[limits]", "[foo]"),
    ],
)
def test_wrong_files_do_not(old: str, new: str) -> None:
    assert not VALIDATOR.is_valid(document(BASIC.replace(old, new, 1)))


def structurally_good(model: type[MachineFile] | type[BearingFile], data: dict[str, Any]) -> bool:
    """Whether a model finds nothing but rules between keys broken, which a schema does not tell."""
    try:
        model.model_validate(data)
    except ValidationError as error:
        return all(detail["type"] == RULE for detail in error.errors())
    return True


VALUES: list[Any] = [-1, 0, 1, 2.0, 0.5, 1e9, 1e13, "x", "k6", "", True, False, [], [1], [1.0, 2], [1, 2, 3], ["x"], {}]


def places(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, inner in items:
        yield (*path, key)
        yield from places(inner, (*path, key))


SAMPLES = [document(full_text()[0]), document(BEARINGS), document(BASIC)]
PLACES = [(number, path) for number, sample in enumerate(SAMPLES) for path in places(sample)]


@settings(deadline=None, derandomize=True, max_examples=250)
@given(place=st.sampled_from(PLACES), how=st.sampled_from(["replace", "remove", "add"]), value=st.sampled_from(VALUES))
@pytest.mark.slow
def test_schema_and_models_agree(place: tuple[int, tuple[Any, ...]], how: str, value: Any) -> None:
    number, path = place
    data = mutated(SAMPLES[number], path, how, value)
    assert VALIDATOR.is_valid(data) == (structurally_good(MachineFile, data) or structurally_good(BearingFile, data))


OPTIONAL = [
    "[grinding]",
    "[run_up]",
    "[motor]",
    "[swing_arm]",
    "[[bearing]]",
    "[sweep]",
    "[expected]",
]
REPLACED = {"imbalance_g_mm": ("balance_grade", *QUANTITIES), "runout_mm": ("runout_tir_mm",)}


def test_it_reads_back_and_shows_every_default(tmp_path: Path) -> None:
    loaded = read(tmp_path, template_of("machine"))
    assert [path for path, _ in loaded.defaults_used] == ["machine.speed_range_rpm"]
    assert isinstance(loaded.tables, MachineFile) and loaded.tables.autobalancer is not None


def test_it_names_every_table_and_key_once() -> None:
    rows = [row.lstrip("#") for row in template_of("machine").splitlines() if not row.startswith("# ")]
    for path, table in all_tables(MachineFile):
        header = next(row for row in rows if row.strip("[]") == ".".join(path) and row.startswith("["))
        block = rows[rows.index(header) + 1 :]
        end = next((index for index, row in enumerate(block) if row.startswith("[")), len(block))
        keys = [row.split(" = ")[0] for row in block[:end] if row]
        assert keys == [key for key in table.model_fields if key != "handle"], path


def test_a_new_file_is_a_rigid_body_with_a_handle(tmp_path: Path) -> None:
    tables = read(tmp_path, template_of("machine")).tables
    assert isinstance(tables, MachineFile)
    assert tables.machine.estimates and [handle.name for handle in tables.machine.handle] == ["front"]


@pytest.mark.parametrize("header", OPTIONAL)
def test_an_optional_table_reads_once_its_marks_are_taken_away(tmp_path: Path, header: str) -> None:
    before, mark, after = template_of("machine").partition(f"\n#{header}")
    assert mark
    block, gap, rest = after.partition("\n\n")
    # The sizes of a bearing stand beside its designation, its load beside that of the process: one may be used.
    others = r"#(bore_mm|outer_mm|width_mm|position_mm|cutting_force_N|normal_to_cutting_ratio|bearings_sharing)"
    lines = [row for row in block.split("\n") if not re.match(others, row)]
    used = "\n".join(row[1:] if re.match(r"#[a-z]", row) else row for row in lines)
    text = f"{before}\n{header}{used}{gap}{rest}"
    assert read(tmp_path, text).tables != read(tmp_path, template_of("machine")).tables or header == "[expected]"


@pytest.mark.parametrize(("shown", "other"), [(shown, other) for shown, all_ in REPLACED.items() for other in all_])
def test_an_alternative_key_reads_in_place_of_the_one_shown(tmp_path: Path, shown: str, other: str) -> None:
    text = re.sub(rf"(?m)^{shown} = ", f"#{shown} = ", template_of("machine"))
    wheel = document(re.sub(rf"(?m)^#{other} = ", f"{other} = ", text, count=1))["wheel"]
    assert isinstance(wheel, dict) and other in wheel and shown not in wheel
    read(tmp_path, re.sub(rf"(?m)^#{other} = ", f"{other} = ", text, count=1))


def test_comments_are_wrapped() -> None:
    assert max(map(len, template_of("machine").splitlines())) <= WIDTH + 2
