"""heyoka's compiled code on disk: a folder that is damaged is emptied, one that cannot be used is done without."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from abu_calc.dynamics.integrators.compiled.cache import FOLDER
from abu_calc.dynamics.integrators.heyoka_ import _keep_apart
from tests.cli.test_simulate import SCENE


class State:
    """As much of heyoka's as is asked; opening its folder fails with these errors, one after the other."""

    def __init__(self, folder: Path, *errors: str) -> None:
        self.path, self.errors, self.enabled = str(folder / "heyoka"), list(errors), True

    def get_diskcache_path(self) -> str:
        return self.path

    def set_diskcache_path(self, path: str) -> None:
        self.path = path

    def set_diskcache_limit(self, _: int) -> None:
        if self.errors:
            raise RuntimeError(self.errors.pop(0))

    def set_diskcache_enabled(self, enabled: bool) -> None:
        self.enabled = enabled


@pytest.mark.parametrize("error", ["database disk image is malformed", "file is not a database", "it is corrupt."])
def test_a_damaged_folder_is_emptied(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: str) -> None:
    monkeypatch.setenv(FOLDER, str(tmp_path / "ours"))
    (tmp_path / "ours").mkdir()
    for name in ("cache.db", "cache.db-wal", "others.txt"):
        (tmp_path / "ours" / name).write_text("junk", encoding="utf-8")
    state = State(tmp_path, error)
    _keep_apart(state)
    assert state.enabled and state.path == str(tmp_path / "ours")
    assert [file.name for file in (tmp_path / "ours").iterdir()] == ["others.txt"]


@pytest.mark.parametrize("errors", [("cannot create directories",), ("is malformed", "is malformed")])
def test_an_unusable_folder_is_done_without(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, errors: tuple) -> None:
    monkeypatch.delenv(FOLDER, raising=False)
    state = State(tmp_path, *errors)
    with pytest.warns(RuntimeWarning, match="abu-calc") as warned:
        _keep_apart(state)
        _keep_apart(state)
    assert not state.enabled and len(warned) == 1


def test_a_folder_that_somebody_chose_stays(tmp_path: Path) -> None:
    state = State(tmp_path)
    state.path = str(tmp_path / "theirs")
    _keep_apart(state)
    assert state.path == str(tmp_path / "theirs")


@pytest.mark.slow
@pytest.mark.parametrize("how", ["junk", "a file in its place"])
def test_a_simulation_goes_on(tmp_path: Path, how: str) -> None:
    pytest.importorskip("heyoka")
    scene, folder = tmp_path / "scene.toml", tmp_path / "cache"
    scene.write_text(SCENE.replace("700.0", "20.0"), encoding="utf-8")
    if how == "junk":
        folder.mkdir()
        (folder / "cache.db").write_bytes(b"junk" * 5000)
    else:
        folder.write_text("a file", encoding="utf-8")
    words = [sys.executable, "-m", "abu_calc", "simulate", str(scene), "--integrator", "heyoka", "--quiet"]
    seen = subprocess.run(words, env={**os.environ, FOLDER: str(folder)}, capture_output=True, text=True, check=False)
    assert seen.returncode == 0 and seen.stdout == ""
    assert ("is not kept" in seen.stderr) is (how != "junk")
