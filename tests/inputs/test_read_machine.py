"""Files that cannot be read, presets, and what is imported on the way."""

import subprocess
import sys
from pathlib import Path

import pytest

from abu_calc.foundation.errors import InputError
from abu_calc.inputs.read_machine import LARGEST_FILE, read_machine
from abu_calc.inputs.reading import sources as presets
from tests.inputs.samples import BASIC, refused


@pytest.mark.parametrize(
    ("raw", "line", "word"),
    [
        (b"", None, "empty"),
        (b" \r\n\t\n", None, "empty"),
        (b"\xef\xbb\xbf", None, "empty"),
        (b"# nothing but words\n", None, "comments only"),
        (BASIC.encode("utf-16"), None, "UTF-16"),
        (BASIC.encode("utf-16-le"), None, "UTF-16"),
        (BASIC.encode("utf-32"), None, "UTF-16"),
        ('[machine]\nname = "станок"\n'.encode("cp1251"), 2, "0xf1"),
        (b"#" * (LARGEST_FILE + 1), None, "too large"),
        (b"[scene]\nsupport = 'planar'\n", None, "abu simulate"),
        (b"[rig]\n[rotor]\n", None, "readings of a rig"),
        (b'checks = []\n[abu]\ncommand = "size"\n[input]\n[result]\n', None, "a result that --output wrote"),
    ],
)
def test_files_that_hold_no_machine(tmp_path: Path, raw: bytes, line: int | None, word: str) -> None:
    error = refused(tmp_path, raw)
    assert word in str(error) and error.place.line == line and error.place.file == str(tmp_path / "m.toml")


def test_a_folder_is_no_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="a folder"):
        read_machine(str(tmp_path))


@pytest.mark.parametrize("name", ["", "nowhere/at all.toml", "\0", "x" * 5000])
def test_names_of_no_file(name: str) -> None:
    with pytest.raises(InputError):
        read_machine(name)


@pytest.fixture
def preset(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "presets"
    folder.mkdir()
    (folder / "straight-grinder.toml").write_text(BASIC, encoding="utf-8")
    monkeypatch.setattr(presets, "folder", lambda: folder)
    monkeypatch.chdir(tmp_path)
    return folder


def test_a_preset_is_read_by_its_name(preset: Path) -> None:
    assert presets.names() == ("straight-grinder",)
    loaded = read_machine("straight-grinder")
    assert loaded.file == "straight-grinder" and loaded.text == BASIC


def test_a_file_wins_over_a_preset(preset: Path) -> None:
    Path("straight-grinder").write_text(BASIC.replace("5.6", "4.2"), encoding="utf-8")
    assert "4.2" in read_machine("straight-grinder").text


def test_the_nearest_preset_is_told(preset: Path) -> None:
    with pytest.raises(InputError, match=r'[Nn]earest preset is "straight-grinder"'):
        read_machine("strait-grinder")
    with pytest.raises(InputError, match="Presets: straight-grinder"):
        read_machine("zzz")


def test_presets_stand_in_the_package_or_beside_it() -> None:
    import abu_calc

    package = Path(abu_calc.__file__).resolve().parent
    assert presets.folder() in (package / "presets", package.parent / "presets")


def test_reading_imports_nothing_heavy() -> None:
    """A command must answer at once; these libraries take longer to import than the reading itself."""
    heavy = ["numpy", "scipy", "jsonschema", "tomlkit", "rich", "typer", "matplotlib"]
    code = f"import sys, abu_calc.inputs.read_machine; print([name for name in {heavy} if name in sys.modules])"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "[]"
