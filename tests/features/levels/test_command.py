"""Options of `abu levels` that are refused, each by its name."""

from pathlib import Path

import pytest

from tests.cli.runner import abu
from tests.features.levels.test_study import sine_file


@pytest.mark.few(3)
@pytest.mark.parametrize("arguments", [
    ("--minutes", "0"), ("--minutes", "1500"), ("--from", "7"), ("--from", "-1"), ("--scene", "idle"),
    ("--duration", "3"), ("--set", "machine.mass_kg=5"), ("--quantity", "force"), ("--scale", "0"), ("--channels", "9"),
    ("--handle", "front"), ("--handle", "=1"), ("--handle", "front=9"), ("--sensitivity", "10"),
    ("--sensitivity", "ax=ten"), ("--full-scale-mV", "5000"),
])  # fmt: skip
def test_wrong_options_are_refused(tmp_path: Path, arguments: tuple[str, str]) -> None:
    seen = abu("levels", sine_file(tmp_path, seconds=0.1), *arguments)
    assert seen.status == 2 and "bug" not in seen.err and arguments[0] in seen.err


def test_a_rate_too_low_for_any_octave_is_refused(tmp_path: Path) -> None:
    seen = abu("levels", sine_file(tmp_path, 2.0, 30.0, rate=20.0))
    assert seen.status == 2 and "too slowly" in seen.err
