"""`abu factory`: what the study returns is printed and written as JSON; files hold [[measured]]."""

from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.features.factory.test_study import MEASURED, MINE


def test_the_command_prints_and_writes_what_the_study_returns(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a single measured machine nothing is sized."""
    monkeypatch.setattr("abu_calc.features.factory.study.factory_machines", lambda: ())
    monkeypatch.setattr("abu_calc.features.factory.study._soft_races", lambda *_: ())
    shown, written = abu("factory"), abu("factory", "--json")
    assert shown.status == written.status == 0
    assert "The model predicts 0 of 0 measurements" in " ".join(shown.out.split())
    assert written.document["abu"]["command"] == "factory" and written.document["result"]["rows"] == []


def test_a_file_without_measurements_is_refused() -> None:
    seen = abu("factory", "swing-arm-grinder")
    assert seen.status == 2 and seen.out == "" and "swing-arm-grinder: measured" in seen.err


def test_a_wrong_measurement_is_refused_with_file_line_and_key(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    wrong = MEASURED.format(place="front", axis="y", octave=120, levels="level_db = [80, 81]")
    file.write_text(MINE + wrong, encoding="utf-8")
    line = (MINE + wrong).splitlines().index("octave_hz = 120") + 1
    seen = abu("factory", str(file))
    assert seen.status == 2 and f"mine.toml:{line}: measured[0].octave_hz" in seen.err and "octave_hz = 125" in seen.err
