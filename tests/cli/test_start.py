"""Entry point of `abu`: an interrupt before or after the command ends it in good order."""

import gc
import os
from collections.abc import Iterator

import pytest

from abu_calc.cli import app, start
from abu_calc.foundation.parallel import EndedBySignal


@pytest.fixture(autouse=True)
def process(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Which of the process's settings were changed, each undone."""
    calls: list[str] = []
    thresholds = gc.get_threshold()
    monkeypatch.setattr(start, "heed_signals", lambda: calls.append("heed"))
    monkeypatch.setattr(start, "leave_signals", lambda: calls.append("leave"))
    monkeypatch.setattr(gc, "freeze", lambda: calls.append("freeze"))
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "7")
    monkeypatch.delenv("PYDANTIC_DISABLE_PLUGINS", raising=False)
    yield calls
    gc.set_threshold(*thresholds)
    os.environ.pop("PYDANTIC_DISABLE_PLUGINS", None)


def test_a_command_runs_between_heeding_and_leaving_signals(
    process: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(app, "main", lambda: process.append("run"))
    start.main()
    assert process == ["heed", "run", "leave", "freeze"]
    assert gc.get_threshold()[0] == start.OBJECTS


def test_settings_of_the_user_win(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(app, "main", lambda: None)
    start.main()
    assert os.environ["OPENBLAS_NUM_THREADS"] == "7" and os.environ["PYDANTIC_DISABLE_PLUGINS"] == "__all__"


@pytest.mark.parametrize(("ended", "status"), [(KeyboardInterrupt(), 130), (EndedBySignal(15), 143)])
def test_an_interrupt_is_one_line_and_128_with_its_number(
    ended: BaseException, status: int, process: list[str], monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    def interrupted() -> None:
        raise ended

    monkeypatch.setattr(app, "main", interrupted)
    with pytest.raises(SystemExit) as exited:
        start.main()
    assert exited.value.code == status and capsys.readouterr().err == "Interrupted.\n"
    assert process == ["heed", "leave", "freeze"]
