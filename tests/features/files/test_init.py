"""`abu init` writes files that their commands take, and copies presets alone."""

import json
import math
import re
import tomllib
from pathlib import Path

import jsonschema
import pytest

from abu_calc.features.files.init import completed
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


MINE = ("--layout", "angle", "--wheel", "125 mm", "--mass", "2.25 kg", "--speed", "10999.123", "--room", "Ø52 × 16")


def test_the_short_file_holds_what_was_given_exactly_and_marks_what_is_assumed(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    assert abu("init", str(file), *MINE, "--handle", 'a"b = 62, 120.5,-8').status == 0
    text = file.read_text(encoding="utf-8")
    tables = tomllib.loads(text)
    machine, own = tables["machine"], tables["autobalancer"]
    assert (machine["mass_kg"], machine["speed_rpm"], tables["wheel"]["diameter_mm"]) == (2.25, 10999.123, 125.0)
    assert machine["handle"] == [{"name": 'a"b', "position_mm": [62.0, 120.5, -8.0]}]
    assert (own["max_outer_diameter_mm"], own["max_width_mm"]) == (52.0, 16.0) and len(text.splitlines()) <= 30
    assert not re.search(r"(?m)^(mass_kg = 2.25|speed_rpm|max_outer).*assumed", text) and text.count("assumed") >= 4
    assert abu("validate", str(file)).status == 0
    bare = tmp_path / "bare.toml"
    assert abu("init", str(bare), *MINE, "--level", "111").status == 0
    assert "handle" not in bare.read_text("utf-8") and tomllib.loads(bare.read_text("utf-8"))["wheel"] == {
        "diameter_mm": 125.0, "mass_kg": 0.18, "measured_level_db": 111.0
    }  # fmt: skip


@pytest.mark.parametrize(
    ("option", "value", "words"),
    [
        ("--layout", "angel", "no such layout"), ("--room", "1.2.3x4", "outer diameter and width"),
        ("--mass", "-2", "above zero"), ("--mass", "nan", "above zero"), ("--speed", "8500 Hz", "a number in rpm"),
        ("--room", "0x16", "out of range"), ("--handle", "side=1,2", "three lengths"),
    ],
)  # fmt: skip
def test_a_wrong_answer_is_refused_and_nothing_is_written(option: str, value: str, words: str, tmp_path: Path) -> None:
    file, given = tmp_path / "mine.toml", [*MINE]
    if option in given:
        del given[(place := given.index(option)) : place + 2]
    seen = abu("init", str(file), *given, f"{option}={value}")
    assert seen.status == 2 and words in seen.err and not file.exists()


def test_what_is_missing_is_named_where_nobody_can_be_asked(tmp_path: Path) -> None:
    seen = abu("init", str(tmp_path / "mine.toml"), "--layout", "angle", "--wheel", "125")
    assert seen.status == 2 and "missing: --mass, --speed, --room" in seen.err
    assert abu("init", str(tmp_path / "mine.toml"), "--preset", "msh-230", "--mass", "3").status == 2


def test_a_terminal_asks_again_and_takes_usual_answers() -> None:
    replies = iter(["angel", "angle", "180 mm", "", "", "", "", "side=1,2,3"])
    given, usual = completed({}, lambda words, proposed: next(replies))
    assert (given["layout"], given["wheel"], given["handle"]) == ("angle", 180.0, [("side", [1.0, 2.0, 3.0])])
    assert usual == {"mass", "speed", "room"} and "level" not in given
    # 72 m/s at the rim of the wheel.
    assert given["speed"] == pytest.approx(72 / (math.pi * 0.18) * 60, abs=50)


def test_help_names_the_axes_of_a_handle() -> None:
    told = " ".join(abu("init", "--help").out.split())
    assert "mm from the centre of mass: x to the spindle, y across, z to the wheel" in told
