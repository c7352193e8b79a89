"""`abu init` writes files that their commands take, and copies presets alone."""

import json
import tomllib
from pathlib import Path

import jsonschema
import pytest

from tests.cli.runner import abu
from tests.inputs.samples import BEARINGS


@pytest.mark.slow
def test_init_writes_what_size_takes(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    assert abu("init", "--all-keys", str(file)).status == 0
    assert abu("validate", str(file)).status == 0
    assert abu("size", str(file), "--quiet").status == 0
    assert abu("init", "--all-keys", str(file)).status == 2
    copy = tmp_path / "copy.toml"
    copied = abu("init", "--preset", "msh-230", str(copy))
    assert copied.status == 0 and "abu verify --update" in copied.out
    assert copy.read_text(encoding="utf-8") == abu("presets", "msh-230").out
    schema = json.loads(abu("schema").out)
    jsonschema.Draft4Validator(schema).validate(tomllib.loads(file.read_text(encoding="utf-8")))


def test_presets_are_copied_and_files_are_not(tmp_path: Path) -> None:
    secret = tmp_path / "secret.toml"
    secret.write_text(BEARINGS + "# password\n", encoding="utf-8")
    for arguments in (("init", "--preset", str(secret), str(tmp_path / "new.toml")), ("presets", str(secret))):
        seen = abu(*arguments)
        assert seen.status == 2 and "no preset of this name" in seen.err and "password" not in seen.out + seen.err
    assert list(tmp_path.iterdir()) == [secret]


def test_kinds_exclude_each_other(tmp_path: Path) -> None:
    target = tmp_path / "new.toml"
    for options in (("--scene", "--readings"), ("--scene", "--preset", "msh-230")):
        seen = abu("init", *options, str(target))
        assert seen.status == 2 and "exclude each other" in seen.err and not target.exists()


def test_another_suffix_and_a_file_that_is_there_are_refused(tmp_path: Path) -> None:
    (tmp_path / "there.toml").write_text("mine", encoding="utf-8")
    assert "a name ending in .toml" in abu("init", str(tmp_path / "new.txt")).err
    assert "--force" in abu("init", str(tmp_path / "there.toml")).err
    assert (tmp_path / "there.toml").read_text(encoding="utf-8") == "mine"


def test_only_a_copied_preset_speaks_of_what_it_expects(tmp_path: Path) -> None:
    own, copied = tmp_path / "own.toml", tmp_path / "copied.toml"
    assert "[expected]" not in abu("init", "--all-keys", str(own)).out
    assert "[expected] holds the preset's results" in " ".join(
        abu("init", str(copied), "--preset", "msh-230").out.split()
    )
