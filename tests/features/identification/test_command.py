"""`abu identify` as people run it: too few starts, files to write, help."""

from pathlib import Path

import pytest

from abu_calc.features.identification.written import identified_text
from tests.cli.runner import abu
from tests.features.identification.test_study import starts


class Value:
    """An identified value."""

    def __init__(self, value: float) -> None:
        self.value, self.low, self.high = value, 0.9 * value, 1.1 * value


class Known:
    """A result with every value."""

    starts = 8
    rolling_drag_per_s = Value(12.34)
    rolling_friction_mm = Value(0.00131)
    race_eccentricity_mm = Value(0.0121)
    race_eccentricity_angle_deg = Value(69.7)


@pytest.mark.slow
def test_too_few_starts_end_with_1_and_say_what_to_do(tmp_path: Path) -> None:
    path, files = starts(tmp_path, 3)
    seen = abu("identify", str(path), *files)
    assert seen.status == 1 and "not evaluated" in seen.out and "eight starts" in seen.out and seen.width <= 80
    result = abu("identify", str(path), *files, "--json").document["result"]
    assert result["rolling_drag_per_s"] is None and result["starts"] == 3 and result["mark"] is True
    seen = abu("identify", str(path), *files, "--write", str(tmp_path / "new.toml"))
    assert seen.status == 2 and "no value was identified" in seen.err and not (tmp_path / "new.toml").exists()


def test_values_are_written_into_scene_and_machine(tmp_path: Path) -> None:
    path, _ = starts(tmp_path, 1)
    text = identified_text(str(path), Known())  # type: ignore[arg-type]
    assert "rolling_drag_per_s = 12.34" in text and "lever_arm_mm = 0.00131" in text
    assert "magnitude_mm = 0.0121, angle_deg = 69.7" in text
    machine = identified_text("avtovaz-707-222", Known())  # type: ignore[arg-type]
    assert machine.count("rolling_drag_per_s = 12.34") == 1 and "race_eccentricity_mm = 0.0121" in machine
    assert "[identified]\nstarts = 8\nrolling_drag_per_s = [11.09, 13.6]" in machine
    copy = tmp_path / "machine.toml"
    copy.write_text(machine, encoding="utf-8")
    assert abu("validate", str(copy)).status == 0
    again = identified_text(str(copy), Known())  # type: ignore[arg-type]
    assert again == machine  # no second table
    copy.write_text(machine.replace("rolling_drag_per_s = 12.34", "rolling_drag_per_s = 20.0"), encoding="utf-8")
    seen = abu("validate", str(copy))
    assert seen.status == 0 and "does not hold autobalancer.rolling_drag_per_s = 20" in " ".join(seen.out.split())


def test_a_plan_stands_on_one_screen_and_gives_the_command_that_follows() -> None:
    seen = abu("measure-plan", "avtovaz-707-222", "--run-up", "0.5")
    lines = seen.out.splitlines()
    assert seen.status == 0 and len(lines) <= 40 and seen.width <= 80
    assert "  abu identify avtovaz-707-222 start*.csv --without no-balls.csv --run-up 0.5" in lines
