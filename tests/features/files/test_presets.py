"""`abu presets` lists the files that come with abu-calc, and prints one."""

import json

import pytest

from abu_calc.features.files.presets import presets
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.sources import names, text_of
from tests.cli.runner import abu


def test_presets_say_where_each_value_comes_from() -> None:
    for preset in json.loads(abu("presets", "--json").out)["result"]["presets"]:
        text, *measured = abu("presets", preset["name"]).out.split("[expected]")[0].split("[[measured]]")
        assert all("\nsource = " in table for table in measured)
        for line in text.splitlines():
            if "=" in line and not line.startswith(("#", "name", "model")):
                origins = ("assumed: ", "fitted: ", "worked example")
                named = any(origin in line for origin in origins)
                assert "#" in line and (named or any(c.isdigit() for c in line.split("#")[1])), line


def test_the_list_has_every_preset_with_its_machine() -> None:
    listed = presets().result["presets"]
    assert [entry["name"] for entry in listed] == list(names())
    assert all(entry["machine"] for entry in listed)


def test_a_preset_is_printed_as_its_file_is() -> None:
    outcome = presets("msh-230")
    assert outcome.plain == text_of("msh-230") == outcome.result["text"]
    assert outcome.plain_suffix == ".toml"


def test_an_unknown_preset_is_refused() -> None:
    with pytest.raises(InputError, match="no preset of this name"):
        presets("msh-231")
