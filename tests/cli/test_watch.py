"""`--watch`: refusals, what counts as a save, and a whole session with the signal that ends it."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from abu_calc.cli.watch import EACH_S, GONE_S, Saves, Worker, child_arguments
from tests.cli.runner import abu

SEAT = """\
[machine]
name = "Spindle"
[[bearing]]
name = "front"
designation = "6203"
radial_load_kN = {load}
inner_ring_load = "rotating"
outer_ring_load = "stationary"
speed_rpm = 3000
shaft_fit = "{fit}"
housing_fit = "H7"
"""
REST_S = 1.01 * EACH_S
"""Seconds between two looks, and a little."""
PATIENCE = 60.0
"""Seconds that a machine under load may take."""


@pytest.mark.parametrize(
    "words", [("--designation", "6203", "-o", "{}/r.html"), ("mmg-3200k-knife-shaft", "-o", "{}/r.html")]
)
def test_only_a_file_that_can_be_edited_is_watched(words: tuple[str, ...], tmp_path: Path) -> None:
    seen = abu("check-fit", *(word.format(tmp_path) for word in words), "--watch")
    assert seen.status == 2
    assert "Name a file of your own" in seen.err


@pytest.mark.parametrize("output", [(), ("-o", "{}/r.json")])
def test_a_page_must_be_asked_for(output: tuple[str, ...], tmp_path: Path) -> None:
    file = tmp_path / "seat.toml"
    file.write_text(SEAT.format(load=1, fit="k5"))
    seen = abu("check-fit", str(file), "--watch", *(word.format(tmp_path) for word in output))
    assert seen.status == 2
    assert "Add -o report.html" in seen.err


def test_an_existing_page_is_kept_without_force(tmp_path: Path) -> None:
    file, page = tmp_path / "seat.toml", tmp_path / "r.html"
    file.write_text(SEAT.format(load=1, fit="k5"))
    page.write_text("another's")
    seen = abu("check-fit", str(file), "--watch", "-o", str(page))
    assert seen.status == 2 and "--force" in seen.err
    assert page.read_text() == "another's"


@pytest.mark.parametrize("command", ["size", "check-fit", "balance", "simulate"])
def test_help_lists_the_option(command: str) -> None:
    assert "--watch" in abu(command, "--help").out + abu(command, "--help-all").out


@pytest.mark.parametrize("output", [("-o", "r.html"), ("--output", "r.html"), ("--output=r.html",), ("-or.html",)])
def test_page_of_a_run_goes_elsewhere(output: tuple[str, ...]) -> None:
    words = child_arguments(["size", "r.html.toml", "--watch", *output], Path("r.html"), Path("/t/page.html"))
    assert words[:2] == ["size", "r.html.toml"]
    assert not [word for word in words if word.endswith("r.html")]
    assert sum(word.endswith("/t/page.html") for word in words) == 1


def test_a_save_counts_once_the_file_rests(tmp_path: Path) -> None:
    file = tmp_path / "a.toml"
    file.write_text("a")
    saves = Saves(file)
    assert [saves.saved(now) for now in (0.0, REST_S, 2 * REST_S)] == [False, True, False]
    file.write_text("b")
    assert not saves.saved(1.0)
    file.write_text("c")  # the editor is still writing
    assert not saves.saved(1.0 + REST_S)
    assert saves.saved(1.0 + 2 * REST_S)
    file.write_text("c")
    assert not saves.saved(2.0) and not saves.saved(2.0 + REST_S)


def test_a_file_replaced_or_deleted_for_a_moment_is_one_save(tmp_path: Path) -> None:
    file, other = tmp_path / "a.toml", tmp_path / "b"
    file.write_text("a")
    saves = Saves(file)
    saves.saved(0.0)
    assert saves.saved(1.0)
    file.unlink()
    assert not saves.saved(2.0) and not saves.saved(2.0 + REST_S)
    other.write_text("b")
    other.replace(file)
    assert not saves.saved(2.0 + 2 * REST_S)
    assert saves.saved(2.0 + 3 * REST_S)
    file.unlink()
    assert not saves.saved(4.0)
    assert saves.saved(4.0 + 1.01 * GONE_S)
    file.write_text("b")
    assert not saves.saved(6.0)
    assert saves.saved(6.0 + REST_S)


def test_other_files_that_were_read_are_watched_too(tmp_path: Path) -> None:
    file, recording = tmp_path / "a.toml", tmp_path / "run.csv"
    file.write_text("a")
    recording.write_text("1")
    saves = Saves(file)
    saves.saved(0.0)
    assert saves.saved(1.0)
    saves.follow([file, recording])
    assert not saves.saved(2.0)
    recording.write_text("2")
    assert not saves.saved(3.0)
    assert saves.saved(3.0 + REST_S)


def awaited(condition: Callable[[], object]) -> None:
    """Wait until a condition holds."""
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, "it did not come"
        time.sleep(0.05)


@contextmanager
def watching(*words: str, folder: Path) -> Iterator[subprocess.Popen[str]]:
    """A session, ended at the latest with the test."""
    # What runs in the background may have the signal ignored, and its children with it.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler); "
    process = subprocess.Popen(
        [sys.executable, "-c", f"{heed}from abu_calc.cli.start import main; main()", *words, "--watch"],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=os.environ | {"PYTHONUTF8": "1"},
    )  # fmt: skip
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_a_session_ends_by_ctrl_c_with_a_page_that_no_longer_follows(tmp_path: Path) -> None:
    file, page = tmp_path / "seat.toml", tmp_path / "r.html"
    file.write_text(SEAT.format(load=1, fit="k5"))

    def says(words: str) -> bool:
        return page.exists() and words in page.read_text("utf-8")

    with watching("check-fit", "seat.toml", "-o", "r.html", folder=tmp_path) as process:
        awaited(lambda: says("Result of"))
        assert says('"follows":true') and says("6203")
        file.write_text(SEAT.format(load=1, fit="k99"))
        awaited(lambda: says("No new result"))
        assert says("seat.toml:10") and says("The result below is old") and says("6203")
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130
    assert says('"follows":false') and says("No new result")
    first, result, *error, last = out.splitlines()
    assert first.startswith("Watching seat.toml") and last == "Ended; r.html holds the last result."
    assert re.match(r"\d\d:\d\d:\d\d  \w+", result) and "seat.toml:10" in error[0]
    assert not list(tmp_path.glob(".abu-*"))


def dawdle(arguments: list[str]) -> int:
    """A run that takes long as long as a file stands there."""
    if Path(arguments[0]).exists():
        time.sleep(10 * PATIENCE)
    print("{}")
    return 0


@pytest.mark.slow
def test_a_save_cancels_the_run_that_goes_on(tmp_path: Path) -> None:
    long = tmp_path / "long"
    long.touch()
    worker = Worker(dawdle, [str(long)])
    try:
        worker.begin()
        assert worker.answer(1.0) is None and worker.busy
        long.unlink()
        worker.begin()
        answer = worker.answer(PATIENCE)
        assert answer is not None and answer.document == {}
        assert not worker.busy
    finally:
        worker.end()
