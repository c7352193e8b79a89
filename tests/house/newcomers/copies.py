"""A copy of the package into which newcomers are put, and which files that takes."""

import json
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tests.house.structure import ROOT

NEWCOMERS = Path(__file__).parent
COPIED = (
    "abu_calc",
    "tests/dynamics",
    "tests/__init__.py",
    "tests/conftest.py",
    "tests/remembered.py",
    "pyproject.toml",
)


@dataclass(frozen=True)
class Copy:
    """A copy of what is asked for, in which files are added and changed."""

    folder: Path

    def add(self, name: str, path: str) -> None:
        """A newcomer's own file, in a place where none was."""
        assert not (self.folder / path).exists()
        shutil.copy(NEWCOMERS / name, self.folder / path)

    def change(self, path: str, *changes: tuple[str, str]) -> None:
        """Put text behind a line that begins like this, the only one that does."""
        file = self.folder / path
        text = file.read_text(encoding="utf-8")
        for line, more in changes:
            text, count = re.subn(
                rf"^({re.escape(line)}.*\n)", lambda found, more=more: found[1] + more, text, flags=re.M
            )
            assert count == 1, (path, line)
        file.write_text(text, encoding="utf-8")

    def replace(self, path: str, old: str, new: str) -> None:
        """Put other text in the place of text that stands there once."""
        file = self.folder / path
        text = file.read_text(encoding="utf-8")
        assert text.count(old) == 1, (path, old)
        file.write_text(text.replace(old, new), encoding="utf-8")

    @property
    def touched(self) -> set[str]:
        """Files that were there before and are not as they were, as recipes name them."""
        both = ((file.relative_to(self.folder), file) for file in self.folder.rglob("*.py"))
        changed = (name for name, file in both if (ROOT / name).is_file() and not same(ROOT / name, file))
        return {name.as_posix().removeprefix("abu_calc/") for name in changed}

    def run(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Python with this copy of the package."""
        surroundings = os.environ | {"PYTHONPATH": str(self.folder), "PYTHONIOENCODING": "utf-8"}
        return subprocess.run([sys.executable, *arguments], cwd=self.folder, env=surroundings, capture_output=True,
                              text=True, encoding="utf-8", check=False)  # fmt: skip

    def simulated(self, scene: str, accuracy: float) -> dict[str, Any]:
        """What `abu simulate` answers to a scene file."""
        (self.folder / "scene.toml").write_text(scene, encoding="utf-8")
        command = ("-m", "abu_calc", "simulate", "scene.toml", "--accuracy", str(accuracy), "--json")
        done = self.run(*command)
        assert done.returncode == 0, done.stdout + done.stderr
        found: dict[str, Any] = json.loads(done.stdout)["result"]
        return found


def same(one: Path, other: Path) -> bool:
    """Byte by byte."""
    return one.read_bytes() == other.read_bytes()


def copied(folder: Path) -> Copy:
    """All of it, without what other processes compile meanwhile."""
    for name in COPIED:
        source, target = ROOT / name, folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copy(source, target)
    found = Copy(folder)
    assert found.touched == set()
    return found
