"""Signals end a command whatever it is at, and reach it although libraries swallow them."""

import json
import subprocess
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from abu_calc.cli import app
from tests.cli.runner import abu

ROOT = Path(__file__).parents[2]
INT, TERM = 128 + 2, 128 + 15


@cache
def seen() -> dict[str, Any]:
    """What became of the signals that a process of its own sent itself."""
    with TemporaryDirectory() as folder:
        command = sys.executable, "-m", "tests.foundation.signals", folder
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(done.stdout)


def test_a_signal_during_an_import_waits_for_its_end() -> None:
    assert seen()["importing"] == [TERM, True]


def test_a_signal_that_is_swallowed_comes_again() -> None:
    assert seen()["swallowed"] == seen()["swallowed_on_windows"] == INT
    assert seen()["unraisable"] == [INT, ""]


def test_clean_up_is_not_disturbed_and_a_heeded_signal_does_not_come_again() -> None:
    assert seen()["clean_up"] == [TERM, True, None]


def test_a_signal_breaks_off_clean_up_that_takes_long() -> None:
    assert seen()["clean_up_for_long"] == [TERM, False]


def test_an_error_after_a_signal_is_told_as_the_signal() -> None:
    assert seen()["error_afterwards"] == [TERM, "Interrupted; nothing was written.\n"]


def test_a_signal_during_the_last_import_gives_the_status() -> None:
    assert seen()["last_import"] == [TERM, "Interrupted at the end; everything was written.\n"]


def test_a_time_limit_waits_for_the_end_of_an_import() -> None:
    assert seen()["time_limit"] is True


@pytest.mark.parametrize("error", [ImportError("libscipy.so: failed to map segment"), MemoryError()])
def test_a_process_without_memory_says_so_in_one_line(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def build(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(app, "build", build)
    told = abu("presets")
    assert told.status == 3 and "bug" not in told.err and "memory" in told.err and told.err.count("\n") == 1


def test_a_limit_on_memory_is_seen_before_libraries_meet_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Some of them wait for ever; what needs no numbers needs little."""
    resource = pytest.importorskip("resource")
    for limit in (400, 500, 600):
        monkeypatch.setattr(resource, "getrlimit", lambda _, limit=limit: (limit << 20, -1))
        told = abu("size", "msh-230", "--quiet")
        assert told.status == 3 and f"{limit} MB" in told.err and told.err.count("\n") == 1
        assert abu("presets").status == 0 and abu("size", "--help").status == 0
