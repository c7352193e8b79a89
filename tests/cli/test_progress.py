"""What long work shows, and to whom."""

import contextlib
import io
import re
import threading
from pathlib import Path

import pytest

from abu_calc.cli import output as module
from abu_calc.cli.app import run
from abu_calc.cli.output import progress
from abu_calc.foundation.progress import Stage, share_of, silent, within
from tests.cli.runner import abu


class Terminal(io.StringIO):
    """Somebody watches; `written` is set when something that is waited for is there."""

    def __init__(self, awaited: str = "") -> None:
        super().__init__()
        self.awaited = awaited
        self.written = threading.Event()

    def isatty(self) -> bool:
        return True

    def write(self, text: str) -> int:
        count = super().write(text)
        if self.awaited in text:
            self.written.set()
        return count

    @property
    def seen(self) -> str:
        """What is on the screen in the end: each carriage return writes over what stood there."""
        line = ""
        for part in self.getvalue().split("\r"):
            line = part + line[len(part) :]
        return line.rstrip()


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "80")
    monkeypatch.setattr(module, "SOON", 0.0)
    monkeypatch.setattr(module, "EACH", 0.01)


def test_who_watches_sees_the_last_text_until_the_work_ends() -> None:
    terminal = Terminal("idle")
    with contextlib.redirect_stderr(terminal), progress(quiet=False) as tell:
        tell("idle: scipy-dop853, tolerance 2e-05 [mm]\x1b[2J")
        assert terminal.written.wait(10)
    assert "idle: scipy-dop853, tolerance 2e-05 [mm]\\x1b[2J, 0 s" in terminal.getvalue()
    assert "\n" not in terminal.getvalue() and terminal.seen == ""


def test_how_far_it_is_and_how_long_it_still_takes(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [100.0]
    monkeypatch.setattr(module, "monotonic", lambda: now[0])
    terminal = Terminal("30 s left")
    with contextlib.redirect_stderr(terminal), progress(quiet=False) as tell:
        tell(Stage("idle: 0 of 20 starts", 0.0))
        now[0] = 110.0
        tell(Stage("idle: 5 of 20 starts", 0.25))
        assert terminal.written.wait(10)
        terminal.awaited = "closer"
        terminal.written.clear()
        tell(Stage("closer", 0.1))  # less is another stage, whose pace is not known
        assert terminal.written.wait(10)
    assert "idle: 5 of 20 starts, 25 %, 10 s, 30 s left" in terminal.getvalue()
    assert re.search(r"closer, 10 %, 10 s +\r", terminal.getvalue())


def test_a_narrow_terminal_keeps_the_numbers(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "30")
    terminal = Terminal("50 %")
    with contextlib.redirect_stderr(terminal), progress(quiet=False) as tell:
        tell(Stage("a machine of a very long name: idle", 0.5))
        assert terminal.written.wait(10)
    assert re.search(r"\r. a machine of a …, 50 %, 0 s", terminal.getvalue())
    assert max(map(len, terminal.getvalue().split("\r"))) < 30


@pytest.mark.parametrize(
    ("quiet", "soon", "term"),
    [(False, 60.0, "xterm"), (True, 0.0, "xterm"), (False, 0.0, "dumb")],
)
def test_what_is_done_soon_or_quiet_shows_nothing(
    quiet: bool, soon: float, term: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "SOON", soon)
    monkeypatch.setenv("TERM", term)
    terminal = Terminal()
    with contextlib.redirect_stderr(terminal), progress(quiet=quiet) as tell:
        tell("idle")
        assert not terminal.written.wait(0.1)


def test_an_interrupt_ends_it_too() -> None:
    terminal = Terminal("idle")
    with contextlib.redirect_stderr(terminal), pytest.raises(KeyboardInterrupt), progress(quiet=False) as tell:
        tell("idle")
        assert terminal.written.wait(10)
        raise KeyboardInterrupt
    assert terminal.seen == ""


def test_a_terminal_that_goes_away_ends_the_line_alone() -> None:
    terminal = Terminal("idle")
    with contextlib.redirect_stderr(terminal), progress(quiet=False) as tell:
        tell("idle")
        assert terminal.written.wait(10)
        terminal.close()
        tell("more")


@pytest.mark.slow
def test_nothing_of_it_in_a_pipe() -> None:
    assert abu("simulate", "avtovaz-707-305", "--duration", "0.05").err == ""


def test_shares_are_told_by_hundredths_and_go_through_a_part() -> None:
    told: list[str] = []
    share = share_of(within(told.append, "whole"), "part")
    assert share is not None
    for step in range(1001):
        share(step / 1000)
    assert 90 < len(told) <= 101 and told[0] == "whole: part" and isinstance(told[-1], Stage)
    assert share_of(silent, "part") is None and within(silent, "whole") is silent


@pytest.mark.slow
@pytest.mark.parametrize("more", [(), ("--quiet",)])
def test_a_run_in_a_terminal_shows_how_far_it_is(more: tuple[str, ...], tmp_path: Path) -> None:
    terminal = Terminal("%")
    file = tmp_path / "motion.csv"
    with contextlib.redirect_stderr(terminal), contextlib.redirect_stdout(io.StringIO()):
        command = ["simulate", "avtovaz-707-305", "--duration", "0.1", "--trajectory", str(file), "--samples", "20000"]
        assert run([*command, *more]) in (0, 1)
    assert terminal.written.is_set() != bool(more) and terminal.seen == ""
