"""Delivery of outcomes and errors: streams, exit statuses, and figures refused before anything is computed."""

import json
import re
from pathlib import Path
from typing import Annotated, ClassVar

import pytest

from abu_calc.cli.app import BUG, fail
from abu_calc.cli.output import Delivery, asked_figures, deliver
from abu_calc.foundation.checks import Check
from abu_calc.foundation.errors import InputError, Place
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
