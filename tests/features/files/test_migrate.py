"""`abu migrate`: keys renamed, all else as it was, the old file kept, whole or not at all."""

from pathlib import Path

import pytest

from abu_calc.features.files import migrate
from abu_calc.features.files.migrate import migrated_text
from abu_calc.foundation.errors import InputError
from abu_calc.inputs.reading.document import document_of_text
from abu_calc.inputs.reading.format import FORMAT, KeyChange
from abu_calc.inputs.reading.sources import text_of
from tests.cli.runner import abu

TEXT = text_of("avtovaz-707-222")
OLD = TEXT.replace("power_W = ", "input_power_W = ", 1)
CHANGES = (KeyChange(1, ("machine", "input_power_W"), "power_W", "one name for power"),)


@pytest.fixture
def changed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(migrate.migrated_text, "__defaults__", (CHANGES,))


def test_the_key_is_renamed_and_nothing_else(changed: None, tmp_path: Path) -> None:
    assert OLD != TEXT
    file = tmp_path / "m.toml"
    file.write_text(OLD, encoding="utf-8")
    seen = abu("migrate", str(file))
    assert seen.status == 0, seen.err
    assert "-input_power_W = " in seen.out and "+power_W = " in seen.out
    after = file.read_text("utf-8")
    assert after.replace(f"format = {FORMAT}\n\n", "", 1) == TEXT
    assert (tmp_path / "m.toml.bak").read_text("utf-8") == OLD
    again = abu("migrate", str(file))
    assert again.status == 0 and "nothing to change" in again.out and file.read_text("utf-8") == after


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_ends_of_lines_stay(newline: str, tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    file.write_bytes(TEXT.replace("\n", newline).encode())
    assert abu("migrate", str(file), "--quiet").status == 0
    raw = file.read_bytes().decode()
    assert raw.count("\r\n") == (raw.count("\n") if newline == "\r\n" else 0)
    assert (tmp_path / "m.toml.bak").read_bytes().decode() == TEXT.replace("\n", newline)


def test_dry_run_writes_nothing(tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    file.write_text(TEXT, encoding="utf-8")
    assert "nothing written" in abu("migrate", str(file), "--dry-run").out
    assert file.read_text("utf-8") == TEXT and len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("broken", ["mass_kg = 5.6\nfoo = 1", 'mass_kg = "heavy"', "format = 7\nmass_kg = 5.6"])
def test_a_file_that_stays_wrong_is_left_as_it_is(broken: str, changed: None, tmp_path: Path) -> None:
    file = tmp_path / "m.toml"
    text = OLD.replace("mass_kg = 5.6", broken, 1) if "format" not in broken else f"format = 7\n{OLD}"
    file.write_text(text, encoding="utf-8")
    seen = abu("migrate", str(file))
    assert seen.status == 2 and file.read_text("utf-8") == text and len(list(tmp_path.iterdir())) == 1


def test_a_backup_that_is_there_is_not_overwritten(tmp_path: Path) -> None:
    file, backup = tmp_path / "m.toml", tmp_path / "m.toml.bak"
    file.write_text(TEXT, encoding="utf-8")
    backup.write_text("mine", encoding="utf-8")
    seen = abu("migrate", str(file))
    assert seen.status == 2 and "exists already" in seen.err
    assert file.read_text("utf-8") == TEXT and backup.read_text("utf-8") == "mine"
    assert abu("migrate", str(file), "--force").status == 0 and backup.read_text("utf-8") == TEXT


def test_presets_and_missing_files_are_refused() -> None:
    assert abu("migrate", "avtovaz-707-222").status == 2
    assert abu("migrate", "no-such-file.toml").status == 2


def test_a_key_under_both_names_is_refused() -> None:
    both = document_of_text(OLD.replace("input_power_W = ", "power_W = 1.0\ninput_power_W = ", 1))
    with pytest.raises(InputError, match="stands twice"):
        migrated_text(both, CHANGES)


def test_a_key_in_an_inline_table_is_named() -> None:
    document = document_of_text('machine = { name = "x", input_power_W = 3.0 }\n')
    with pytest.raises(InputError, match="is now power_W") as caught:
        migrated_text(document, CHANGES)
    assert caught.value.place.line == 1


def test_arrays_of_tables_quoted_keys_and_comments() -> None:
    text = '[[bearing]] # first\n"old" = 1 # old = 2\n[[bearing]]\nold=3\n[machine]\nold = 4\nname = "old = 5"\n'
    change = KeyChange(1, ("bearing", "old"), "new", "why")
    after, notes = migrated_text(document_of_text(text), (change,))
    want = '[[bearing]] # first\n"new" = 1 # old = 2\n[[bearing]]\nnew=3\n[machine]\nold = 4\nname = "old = 5"\n'
    assert after == f"format = {FORMAT}\n\n{want}" and len(notes) == 3


def test_a_file_of_a_later_format_needs_no_earlier_change() -> None:
    change = KeyChange(1, ("machine", "old"), "new", "why")
    after, notes = migrated_text(document_of_text("format = 1\n[machine]\nold = 4\n"), (change,))
    assert after == "format = 1\n[machine]\nold = 4\n" and notes == []
