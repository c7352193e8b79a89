"""What long work shows, and to whom."""

import contextlib
import io
import threading

import pytest

from abu_calc.cli import progress as module
from abu_calc.cli.deliver import Delivery
from abu_calc.cli.progress import progress
from tests.cli.runner import abu

GONE = "\x1b[?25h\r\x1b[1A\x1b[2K"
"""The cursor is back, and the line is not."""


class Terminal(io.StringIO):
    """Somebody watches; `written` is set with the first characters."""

    def __init__(self) -> None:
        super().__init__()
        self.written = threading.Event()

    def isatty(self) -> bool:
        return True

    def write(self, text: str) -> int:
        self.written.set()
        return super().write(text)


@pytest.fixture(autouse=True)
def at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(module, "SOON", 0.0)


def test_who_watches_sees_the_last_text_until_the_work_ends() -> None:
    terminal = Terminal()
    with contextlib.redirect_stderr(terminal), progress(Delivery()) as tell:
        tell("idle: scipy-dop853, tolerance 2e-05 [mm]")
        assert terminal.written.wait(10)
    shown = terminal.getvalue()
    assert "idle: scipy-dop853, tolerance 2e-05 [mm]" in shown
    assert shown.endswith(GONE)


@pytest.mark.parametrize(("how", "soon"), [(Delivery(), 60.0), (Delivery(quiet=True), 0.0)])
def test_what_is_done_soon_or_quiet_shows_nothing(how: Delivery, soon: float, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "SOON", soon)
    terminal = Terminal()
    with contextlib.redirect_stderr(terminal), progress(how) as tell:
        tell("idle")
        assert not terminal.written.wait(0.2)


def test_an_interrupt_ends_it_too() -> None:
    terminal = Terminal()
    with contextlib.redirect_stderr(terminal), pytest.raises(KeyboardInterrupt), progress(Delivery()) as tell:
        tell("idle")
        assert terminal.written.wait(10)
        raise KeyboardInterrupt
    assert terminal.getvalue().endswith(GONE)


def test_nothing_of_it_in_a_pipe() -> None:
    assert abu("simulate", "avtovaz-707-305", "--duration", "0.05").err == ""
