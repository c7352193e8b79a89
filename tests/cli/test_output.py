"""Delivery of outcomes and errors: streams, exit statuses, and figures refused before anything is computed.

What long work shows, and to whom.
"""

import contextlib
import io
import json
import re
import threading
from pathlib import Path
from typing import Annotated, ClassVar

import pytest

from abu_calc.cli import output as module
from abu_calc.cli.app import BUG, fail, run
from abu_calc.cli.output import Delivery, asked_figures, deliver, progress
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.progress import Stage, share_of, silent, within
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.reporting.blocks import Paragraph
from abu_calc.reporting.outcome import Outcome
from abu_calc.simulation.result import Provenance, Result
from tests.cli.runner import abu


@record
class Sample(Result):
    """A result with one number, whose check fails."""

    command: ClassVar[str] = "sample"

    a: Annotated[float, Quantity("a")] = 1.0


OUTCOME = Outcome(
    Sample.command,
    Sample(
        title="sample", checks=(Check("ABU201", "capacity", "fail", "too little"),), warnings=("careful",),
        provenance=Provenance.today(),
    ),
    lambda: (Paragraph("whole"),),
    short=lambda: (Paragraph("short"),),
)  # fmt: skip


@pytest.mark.parametrize(
    ("how", "out", "err"),
    [
        (Delivery(), "  short\n", ""),
        (Delivery(full=True), "  whole\n", ""),
        (Delivery(quiet=True), "", ""),
    ],
)
def test_people_read_the_screen_or_the_whole_report(
    how: Delivery, out: str, err: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert deliver(OUTCOME, how) == 1
    assert capsys.readouterr() == (out, err)


def test_programs_read_one_document_and_warnings_beside_it(capsys: pytest.CaptureFixture[str]) -> None:
    assert deliver(OUTCOME, Delivery(json=True)) == 1
    out, err = capsys.readouterr()
    assert json.loads(out)["result"] == {"a": 1.0} and err == "warning: careful\n"
    deliver(OUTCOME, Delivery(json=True, quiet=True))
    assert capsys.readouterr().err == ""


def test_a_text_that_stands_for_itself_is_printed_as_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert deliver(Outcome("presets", {}, (), plain="[machine]\n"), Delivery()) == 0
    assert capsys.readouterr().out == "[machine]\n"


def test_an_interrupt_after_writing_says_that_the_files_are_there(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("abu_calc.cli.output._print", interrupted)
    with pytest.raises(SystemExit) as ended:
        deliver(OUTCOME, Delivery(), wrote=True)
    assert ended.value.code == 130 and capsys.readouterr().err == "Interrupted; the files were written.\n"
    with pytest.raises(KeyboardInterrupt):
        deliver(OUTCOME, Delivery())


def test_errors_have_their_status_and_bugs_another(capsys: pytest.CaptureFixture[str]) -> None:
    wrong = InputError("out of range", place=Place("m.toml", 3, "wheel.mass_kg"))
    assert fail("size", wrong, as_json=False) == 2
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("abu size: m.toml:3: wheel.mass_kg: out of range")
    assert fail("size", ValueError("odd \x1b"), as_json=True) == BUG == 3
    out, err = capsys.readouterr()
    assert json.loads(out)["error"]["kind"] == "bug"
    assert "this is a bug in abu-calc: ValueError: odd \\x1b" in err and "ABU_DEBUG=1" in err


def test_a_figure_is_a_name_and_a_file() -> None:
    assert asked_figures([" levels = a=b.svg"]) == (("levels", Path("a=b.svg")),)
    for text in ("levels", "=a.svg", "levels=", " = "):
        with pytest.raises(InputError) as caught:
            asked_figures([text])
        assert (caught.value.place.key, caught.value.found) == ("--figure", text)


def test_commands_without_figures_have_no_option_for_them() -> None:
    assert "--figure" not in abu("presets", "--help").out
    assert re.search(r"(?s)--figure NAME=FILE .*\blevels,.*--force", abu("size", "--help").out)


def test_several_outputs_are_all_written(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("fit.json", "fit.html", "fit.txt")]
    words = [word for file in files for word in ("--output", str(file))]
    assert abu("check-fit", "mmg-3200k-knife-shaft", "--quiet", *words).status == 1
    assert all(file.stat().st_size > 500 for file in files)


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
