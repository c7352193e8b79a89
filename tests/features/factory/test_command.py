"""`abu factory`: what the study returns is printed and written as JSON; it takes no file."""

import pytest

from tests.cli.runner import abu


def test_the_command_prints_and_writes_what_the_study_returns(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a single measured machine nothing is sized."""
    monkeypatch.setattr("abu_calc.features.factory.study.factory_rows", lambda: ())
    shown, written = abu("factory"), abu("factory", "--json")
    assert shown.status == written.status == 0
    assert "The model predicts 0 of 0 measurements" in " ".join(shown.out.split())
    assert written.document["abu"]["command"] == "factory" and written.document["result"]["rows"] == []


def test_a_file_is_refused() -> None:
    seen = abu("factory", "msh-230")
    assert seen.status == 2 and seen.out == "" and "msh-230" in seen.err
