"""Work side by side: in order, as it is asked for, and no more of it than that.

Signals end a command whatever it is at, and reach it although libraries swallow them.
"""

import json
import subprocess
import sys
import threading
from contextlib import closing
from functools import cache
from itertools import islice
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest

from abu_calc.cli import app
from abu_calc.foundation.parallel import meanwhile, side_by_side
from tests.cli.runner import abu

TASKS = [(k,) for k in range(12)]


@pytest.fixture(autouse=True)
def _every_task_is_long(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("abu_calc.foundation.parallel.LONG", 0.0)


def _nothing(done: int) -> None:
    pass


@pytest.mark.parametrize("workers", [1, 3])
def test_answers_come_in_the_order_of_the_tasks(workers: int) -> None:
    """Whoever is done first; and how many are done never falls and ends at all of them."""
    told: list[int] = []
    gates = [threading.Event() for _ in TASKS]

    def work(k: int) -> int:
        if workers > 1 and 0 < k < 3:
            gates[k + 1].wait(10)  # those behind it are done first
        gates[k].set()
        return k * k

    assert list(side_by_side(work, TASKS, workers, told.append)) == [k * k for (k,) in TASKS]
    assert told == sorted(told) and told[-1] == len(TASKS)


@pytest.mark.parametrize("workers", [1, 2])
def test_what_nobody_asks_for_is_not_begun(workers: int) -> None:
    """Of a dozen tasks, of which two are asked for, the last ones never run."""
    begun, enough = [], threading.Event()

    def work(k: int) -> int:
        begun.append(k)
        if k > 1:
            enough.wait(10)
        return k

    with closing(side_by_side(work, TASKS, workers, _nothing)) as answers:
        assert list(islice(answers, 2)) == [0, 1]
        enough.set()
    assert len(begun) < len(TASKS)


def test_errors_come_where_the_answer_would() -> None:
    """And those before it are there."""

    def work(k: int) -> float:
        return 1 / (k - 2)

    answers = side_by_side(work, TASKS, 2, _nothing)
    assert [next(answers), next(answers)] == [-0.5, -1.0]
    with pytest.raises(ZeroDivisionError):
        next(answers)


def test_short_tasks_are_done_one_after_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the thread that asks for them."""
    monkeypatch.setattr("abu_calc.foundation.parallel.LONG", 60.0)
    threads = side_by_side(lambda _: threading.get_ident(), TASKS, 3, _nothing)
    assert set(threads) == {threading.get_ident()}


def _broken() -> int:
    raise ZeroDivisionError


def test_a_task_goes_on_while_the_caller_does() -> None:
    """Its outcome is there when it is asked for, twice, too."""
    begun, free = threading.Event(), threading.Event()

    def work(a: int, b: int) -> int:
        begun.set()
        assert free.wait(10)
        return a * b

    product = meanwhile(work, 6, 7, workers=2)
    assert begun.wait(10)
    free.set()
    assert product() == product() == 42


@pytest.mark.parametrize("workers", [1, 2])
def test_the_error_of_a_task_is_that_of_its_outcome(workers: int) -> None:
    outcome = meanwhile(_broken, workers=workers)
    with pytest.raises(ZeroDivisionError):
        outcome()


def test_one_worker_does_a_task_when_its_outcome_is_asked_for() -> None:
    done: list[int] = []
    outcome = meanwhile(done.append, 1, workers=1)
    assert not done
    outcome()
    assert done == [1]


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
