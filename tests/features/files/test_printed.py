"""`abu presets` lists the files that come with abu-calc, and prints one; `abu schema` prints a schema of each kind."""

import json

import pytest

from abu_calc.features.files.printed import KINDS, presets, schema
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.sources import names, text_of
from tests.cli.runner import abu, once


def test_presets_say_where_each_value_comes_from() -> None:
    for preset in json.loads(abu("presets", "--json").out)["result"]["presets"]:
        text = abu("presets", preset["name"]).out.split("[[measured]]")[0].split("[expected]")[0]
        for line in text.splitlines():
            if "=" in line and not line.startswith(("#", "name", "model")):
                why = line.partition("#")[2]
                told = any(word in why for word in ("published: ", "assumed: ", "fitted: ", "worked example"))
                assert told or any(sign.isdigit() for sign in why), line


def test_the_list_has_every_preset_with_its_machine() -> None:
    listed = presets().result["presets"]
    assert [entry["name"] for entry in listed] == list(names())
    assert all(entry["machine"] for entry in listed)


def test_a_preset_is_printed_as_its_file_is() -> None:
    outcome = presets("msh-230")
    assert outcome.plain == text_of("msh-230") == outcome.result["text"]
    assert outcome.plain_suffix == ".toml"


@pytest.mark.few(2)
@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_has_a_schema_that_is_printed_as_it_is(kind: str) -> None:
    outcome = schema(kind)
    assert outcome.plain is not None and json.loads(outcome.plain) == outcome.result
    draft = "2020-12" if kind == "result" else "draft-04"
    assert draft in outcome.result["$schema"]


@pytest.mark.slow
def test_machines_are_the_usual_kind() -> None:
    assert schema().result == schema("machine").result != schema("scene").result


def test_another_kind_is_refused_with_those_there_are() -> None:
    with pytest.raises(InputError, match="no schema of this kind") as caught:
        schema("recording")
    assert (caught.value.found, caught.value.allowed) == ("recording", ", ".join(KINDS))
    assert once("schema", "recording").status == 2
