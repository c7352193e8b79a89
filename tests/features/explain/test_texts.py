"""Keys of machine files, explained from the schema."""

import json

import pytest

from abu_calc.features.explain.texts import file_tables, keys_with, machine_keys
from abu_calc.inputs.reading.schema import schema_of
from tests.cli.runner import abu


@pytest.mark.few(1)
@pytest.mark.parametrize("asked", ["rolling_drag_per_s", "autobalancer.rolling_drag_per_s", "rolling_drag"])
def test_a_key_is_explained_by_each_of_its_names(asked: str) -> None:
    key = next(key for key in machine_keys(asked) if key.path == "autobalancer.rolling_drag_per_s")
    assert "Viscous drag" in key.meaning and "[1/s]" in key.meaning
    seen = abu("explain", asked, "--json")
    assert json.loads(seen.out)["result"]["keys"][key.path] == key.meaning


def test_every_key_of_every_table_is_found_by_its_path(monkeypatch: pytest.MonkeyPatch) -> None:
    """A key that a file may have has words that `abu explain` prints."""
    schema = schema_of("machine")
    tables = list(file_tables(schema))
    monkeypatch.setattr("abu_calc.inputs.reading.schema.schema_of", lambda _: schema)  # made once for all keys
    monkeypatch.setattr("abu_calc.features.explain.texts.file_tables", lambda _: tables)
    for header, table in tables:
        for name in table["properties"]:
            path = f"{header.strip('[]')}.{name}"
            assert any(key.header.strip("[]") == header.strip("[]") for key in machine_keys(path)), path


@pytest.mark.slow
def test_a_word_of_a_key_names_the_keys() -> None:
    assert keys_with("drag") == ["rolling_drag_per_s"]
    seen = abu("explain", "drag")
    assert seen.status == 2 and "Did you mean rolling_drag_per_s?" in seen.err
    assert machine_keys("nonsense") == [] and keys_with("nonsense") == []


@pytest.mark.slow
def test_a_table_is_explained_key_by_key() -> None:
    table = next(table for header, table in file_tables(schema_of("machine")) if header == "[limits]")
    names = [name for name, entry in table["properties"].items() if "x-canonical-key" not in entry]
    seen = abu("explain", "limits")
    assert seen.status == 0 and [key.name for key in machine_keys("limits")] == names
    assert all(f"[limits] {name}" in seen.out for name in names)


@pytest.mark.parametrize("key", ["costs", "expected", "format"])
def test_a_key_of_the_whole_file_is_explained(key: str) -> None:
    seen = abu("explain", key)
    assert seen.status == 0 and len(seen.out) > len(key) + 20
