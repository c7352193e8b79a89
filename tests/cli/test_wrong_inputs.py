"""Whatever is wrong: exit 2, the key named, no traceback, nothing on standard output, nothing written."""

from pathlib import Path

import pytest

import abu_calc
from tests.cli.runner import abu
from tests.inputs.samples import BASIC


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("size",), ("Missing argument", "size --help")),
        (("size", "nowhere.toml"), ("nowhere.toml", "no such file")),
        (("size", "avtovaz-707-223"), ("avtovaz-707-222",)),
        (("size", "/"), ("folder",)),
        (("size", "mmg-3200k-knife-shaft"), ("bearings only", "check-fit")),
        (("size", "avtovaz-707-222", "--accuracy", "0"), ("accuracy",)),
        (("size", "avtovaz-707-222", "--accuracy", "nan"), ("accuracy",)),
        (("size", "avtovaz-707-222", "--accuracy", "much"), ("accuracy", "valid")),
        (("size", "avtovaz-707-222", "--with", "gravity"), ("--with",)),
        (("size", "avtovaz-707-222", "--output", "design.docx"), ("design.docx", ".json")),
        (("size", "avtovaz-707-222", "--output", "no/folder/design.json"), ("folder does not exist",)),
        (("size", "avtovaz-707-222", "--set", "machine.mass_kg"), ("--set", "machine.mass_kg")),
        (("size", "avtovaz-707-222", "--set", "machine.mas_kg=5"), ("machine.mas_kg", "mass_kg")),
        (("size", "avtovaz-707-222", "--set", "machine.mass_kg=5,6", "--output", "design.json"), ("5.6",)),
        (("size", "avtovaz-707-222", "--set", "autobalancer.ball_count=80"), ("autobalancer.ball_count",)),
        (("size", "avtovaz-707-222", "--set", "autobalancer.race_radius_mm=40"), ("autobalancer.race_radius_mm",)),
        (("check-fit",), ("--bore", "--width")),
        (("check-fit", "--bore", "80"), ("--outer", "--width")),
        (
            ("check-fit", "--bore", "80", "--outer", "70", "--width", "33", "--shaft", "k6", "--housing", "K7"),
            ("--outer",),
        ),
        (("check-fit", "--designation", "6203", "--shaft", "k9", "--housing", "K7"), ("k9", "k6")),
        (("check-fit", "--designation", "99999", "--shaft", "k6", "--housing", "K7"), ("99999",)),
        (("check-fit", "mmg-3200k-knife-shaft", "--bore", "80"), ("exclude", "--bore")),
        (("explain", "capasity"), ("capasity", "capacity")),
        (("schema", "machines"), ("machines", "machine")),
        (("presets", "avtovaz"), ("avtovaz-707-370",)),
        (("verify", "nowhere.toml"), ("nowhere.toml",)),
        (("frobnicate",), ("frobnicate", "abu --help")),
        (("--frobnicate",), ("--frobnicate",)),
    ],
    ids=lambda value: " ".join(value)[:60],
)
def test_wrong_options(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], words: tuple[str, ...]
) -> None:
    monkeypatch.chdir(tmp_path)
    seen = abu(*arguments)
    assert seen.status == 2 and seen.out == "", seen
    assert "Traceback" not in seen.err and len(seen.err.strip().splitlines()) <= 3
    assert all(word in seen.err for word in words), seen.err
    assert list(tmp_path.iterdir()) == []


def test_an_error_in_json_is_the_same_envelope() -> None:
    seen = abu("size", "avtovaz-707-222", "--set", "machine.mass_kg=-1", "--json")
    document = seen.document
    assert seen.status == 2 and document["result"] is None and document["status"] == "not-done"
    assert document["error"]["kind"] == "input" and "machine.mass_kg" in document["error"]["key"]
    assert document["error"]["allowed"] and "machine.mass_kg" in seen.err


def test_an_error_of_a_later_step_names_the_line(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(BASIC.replace("max_width_mm = 32.0", "max_width_mm = 4.0"), encoding="utf-8")
    seen = abu("size", str(file))
    line = 1 + BASIC[: BASIC.index("max_width_mm")].count("\n")
    assert seen.status == 2 and f"{file}:{line}: autobalancer.max_width_mm" in seen.err


@pytest.mark.parametrize(
    ("override", "blamed"),
    [
        ("autobalancer.max_width_mm=4.0", "--set autobalancer.max_width_mm: "),
        (
            "autobalancer={max_outer_diameter_mm=68.0, max_width_mm=4.0}",
            "--set autobalancer: autobalancer.max_width_mm: ",
        ),
    ],
    ids=["key", "table"],
)
def test_an_error_of_a_later_step_names_the_override(tmp_path: Path, override: str, blamed: str) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(BASIC, encoding="utf-8")
    seen = abu("size", str(file), "--set", override)
    assert seen.status == 2 and seen.err.startswith(f"abu size: {blamed}"), seen.err
    assert str(file) not in seen.err


@pytest.mark.parametrize("values", [{"max_width_mm": 4.0}, {"": {"max_outer_diameter_mm": 68.0, "max_width_mm": 4.0}}])
def test_an_error_of_a_later_step_names_the_change(values: dict[str, object]) -> None:
    changed = abu_calc.read("msh-230").changed({f"autobalancer.{key}".strip("."): each for key, each in values.items()})
    with pytest.raises(abu_calc.InputError, match=r"too narrow.* in a value that replaces the file's") as caught:
        abu_calc.size(changed)
    assert (caught.value.place.file, caught.value.place.key) == (None, "autobalancer.max_width_mm")
