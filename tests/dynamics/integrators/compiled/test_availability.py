"""Whether compiled code runs here: the trial on systems on which nobody has tried it."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from abu_calc.dynamics.integrators.compiled import availability as trial
from abu_calc.dynamics.integrators.compiled import llvm_engine as machine
from abu_calc.foundation import disk_cache as cache


@pytest.fixture
def untried(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """A system of which nothing is known, with a folder of its own; the statuses with which trials end."""
    statuses: list[int] = []

    def run(words: list[str], **_: object) -> subprocess.CompletedProcess[str]:
        assert words[1:] == ["-m", trial.__name__]
        return subprocess.CompletedProcess(words, statuses.pop(0))

    monkeypatch.setattr(trial, "TRIED", ())
    monkeypatch.setattr(trial.subprocess, "run", run)
    monkeypatch.setenv(cache.FOLDER, str(tmp_path / "untried"))
    trial.passed.cache_clear()
    yield statuses
    trial.passed.cache_clear()


def test_a_trial_is_made_once(untried: list[int]) -> None:
    untried.append(0)
    for _ in range(2):
        trial.passed()
        trial.passed.cache_clear()  # as another process


def test_a_crash_is_known_to_later_processes(untried: list[int]) -> None:
    untried.append(-11)
    for _ in range(2):
        with pytest.raises(machine.CompilerError, match="its trial: it ended with status -11"):
            trial.passed()
        trial.passed.cache_clear()


@pytest.mark.filterwarnings("ignore:compiled code is not kept")
def test_a_trial_that_cannot_be_kept_is_not_made_again_and_again(
    untried: list[int], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    monkeypatch.setenv(cache.FOLDER, str(tmp_path / "file"))
    untried.append(0)
    with pytest.raises(machine.CompilerError, match="cannot be kept"):
        trial.passed()


@pytest.mark.slow
def test_the_trial_itself() -> None:
    words = [sys.executable, "-m", trial.__name__]
    assert subprocess.run(words, check=False).returncode == 0
