"""The comparison of told and seen residuals: its machines, its counts, and what its record may say."""

import json
import tomllib
from pathlib import Path

import pytest

from abu_calc.formulas.friction_band import friction_number
from tests.benchmarks.measuring import RECORDS
from tests.studies.shaken_friction import FRICTION_NUMBERS, Comparison, horizontal_machine, summary


def one(seed: int, told: float, largest: float) -> Comparison:
    """A machine with two residuals [um]."""
    return Comparison(seed, 1.0, 4, 5800.0, told, 2 * told, largest, largest / 2, 0)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [100, 104])
def test_the_machine_that_runs_lies_horizontal_and_is_the_one_whose_residual_is_told(seed: int, tmp_path: Path) -> None:
    text, design, number = horizontal_machine(seed, tmp_path / "machine.toml")
    lever = tomllib.loads(text)["autobalancer"]["rolling_friction_mm"] / 1e3
    assert design.case.friction_arm == pytest.approx(lever)
    balls, case = design.autobalancer, design.case
    radius = balls.ball_diameter / 2
    assert (
        case.table.machine.spindle_axis == "horizontal" and FRICTION_NUMBERS[0] / 2 < number < 2 * FRICTION_NUMBERS[1]
    )
    assert friction_number(case.friction_arm, balls.pitch_radius, radius, case.speed) == pytest.approx(number, rel=1e-6)


def test_counts_by_hand() -> None:
    """3 % and 8 % above, equal, 4 % and 60 % below."""
    told = summary([one(k, 10.0, seen) for k, seen in enumerate((10.3, 10.8, 10.0, 9.6, 4.0))])
    assert (told["machines"], told["above"]) == (5, 2)
    assert (told["above_by_more_than_5_percent"], told["above_by_more_than_10_percent"]) == (1, 0)
    assert (told["within_5_percent"], told["within_10_percent"]) == (3, 4)
    assert (told["highest"], told["lowest"]) == pytest.approx((0.08, -0.6)) and told["median"] == pytest.approx(0)


def test_no_machine_of_the_record_lies_far_above_the_residual_told() -> None:
    record = json.loads((RECORDS / "shaken-friction.json").read_text(encoding="utf-8"))
    machines = [
        Comparison(**{key: value for key, value in each.items() if key != "above"})
        for each in record["cases"]["machines"]
    ]
    assert len(machines) == record["cases"]["summary"]["machines"]
    assert summary(machines)["above_by_more_than_10_percent"] == 0
    assert summary(machines)["above"] == record["cases"]["summary"]["above"]
