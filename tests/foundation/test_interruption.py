"""Signals end a command whatever it is at, and reach it although libraries swallow them."""

import contextlib
import importlib
import signal
import sys
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from abu_calc.cli import app
from abu_calc.features.sweep.time_limit import Overtime, limited
from abu_calc.foundation import interruption
from abu_calc.foundation.interruption import EndedBySignal, heed_signals, leave_signals, raise_pending, status_of
from tests.cli.runner import abu

pytestmark = pytest.mark.skipif(
    threading.current_thread() is not threading.main_thread(), reason="signals come to the main thread"
)


@pytest.fixture
def heeding() -> Iterator[None]:
    """Heed signals until the test is over, as a command does."""
    before, hook = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}, sys.unraisablehook
    for number in before:
        signal.signal(number, signal.SIG_DFL)
    heed_signals()
    yield
    leave_signals()
    sys.unraisablehook = hook
    for number, handler in before.items():
        signal.signal(number, handler)


def waiting() -> None:
    until = time.monotonic() + 20
    while time.monotonic() < until:
        time.sleep(0.01)


@pytest.mark.usefixtures("heeding")
def test_a_signal_during_an_import_waits_for_its_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Modules of C turn it into ImportError, and are broken for good: this one does the same."""
    code = """
import signal
try:
    signal.raise_signal(signal.SIGTERM)
    sum(range(1000))
except BaseException:
    raise ImportError("multiarray failed to import") from None
whole = True
"""
    (tmp_path / "converting.py").write_text(code, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(EndedBySignal) as ended:
        assert importlib.import_module("converting").whole
        waiting()
    assert status_of(ended.value) == 128 + signal.SIGTERM


def _swallowed() -> None:
    with contextlib.suppress(BaseException):
        signal.raise_signal(signal.SIGINT)
        waiting()


def _unraisable() -> None:
    class Deleted:
        def __del__(self) -> None:
            signal.raise_signal(signal.SIGINT)
            sum(range(1000))

    Deleted()


@pytest.mark.usefixtures("heeding")
@pytest.mark.parametrize("swallow", [_swallowed, _unraisable])
def test_a_signal_that_is_swallowed_comes_again(swallow: Callable[[], None], capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(EndedBySignal):
        swallow()
        waiting()
    assert "ignored in" not in capfd.readouterr().err


@pytest.mark.usefixtures("heeding")
def test_clean_up_is_not_disturbed_and_a_heeded_signal_does_not_come_again() -> None:
    cleaned = False
    with pytest.raises(EndedBySignal) as ended:
        try:
            signal.raise_signal(signal.SIGTERM)
            waiting()
        finally:
            time.sleep(0.3)
            signal.raise_signal(signal.SIGTERM)
            cleaned = True
    assert cleaned and status_of(ended.value) == 143
    time.sleep(0.3)
    raise_pending()


@pytest.mark.usefixtures("heeding")
def test_an_error_after_a_signal_is_told_as_the_signal(monkeypatch: pytest.MonkeyPatch) -> None:
    """A library without half of its modules fails at whatever it does next."""

    def build(_: object) -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
            waiting()
        except BaseException:
            raise AttributeError("module has no attribute") from None

    monkeypatch.setattr(app, "build", build)
    seen = abu("presets")
    assert seen.status == 143 and seen.err == "Interrupted; nothing was written.\n"


@pytest.mark.usefixtures("heeding")
def test_a_signal_during_the_last_import_gives_the_status(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The command is over before the signal is raised again."""
    (tmp_path / "last.py").write_text("import signal\nsignal.raise_signal(signal.SIGTERM)\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(interruption, "AGAIN_S", 10.0)
    monkeypatch.setattr(warnings, "showwarning", warnings.showwarning)
    monkeypatch.setattr(app, "make_safe", lambda: SimpleNamespace(fault=None))
    monkeypatch.setattr(app, "run", lambda _: 0 if importlib.import_module("last") else 1)
    with pytest.raises(SystemExit) as ended:
        app.main(["presets"])
    assert ended.value.code == 143 and "Interrupted at the end" in capsys.readouterr().err


@pytest.mark.parametrize("error", [ImportError("libscipy.so: failed to map segment"), MemoryError()])
def test_a_process_without_memory_says_so_in_one_line(error: Exception, monkeypatch: pytest.MonkeyPatch) -> None:
    def build(_: object) -> None:
        raise error

    monkeypatch.setattr(app, "build", build)
    seen = abu("presets")
    assert seen.status == 3 and "bug" not in seen.err and "memory" in seen.err and seen.err.count("\n") == 1


def test_a_time_limit_waits_for_the_end_of_an_import(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A module whose import is broken off half-way is broken for all members that follow."""
    (tmp_path / "slowly.py").write_text("import time\ntime.sleep(0.4)\nwhole = True\n", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(Overtime), limited(0.05):
        importlib.import_module("slowly")
        waiting()
    assert sys.modules["slowly"].whole


def test_a_limit_on_memory_is_seen_before_libraries_meet_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """Some of them wait for ever; what needs no numbers needs little."""
    resource = pytest.importorskip("resource")
    for limit in (400, 500, 600):
        monkeypatch.setattr(resource, "getrlimit", lambda _, limit=limit: (limit << 20, -1))
        seen = abu("size", "msh-230", "--quiet")
        assert seen.status == 3 and f"{limit} MB" in seen.err and seen.err.count("\n") == 1
        assert abu("presets").status == 0 and abu("size", "--help").status == 0
