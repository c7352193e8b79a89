"""The level compared with a measurement: one number in every command, the median of the start cases."""

import math
import statistics

import pytest

import abu_calc
from abu_calc.simulation.ensemble import simulate_members
from abu_calc.simulation.predicted_level import compared_starts, predicted_level, starts_for_measurement
from abu_calc.sizing import size
from tests.cli.runner import once
from tests.remembered import recalled
from tests.sizing.machines import PINNED, machine

PRESET = "avtovaz-707-222"


@pytest.mark.slow
def test_every_command_predicts_the_same_level() -> None:
    """Idle and at the workpiece; the run itself stands beside it under a name of its own."""
    predicted = set()
    for command, options in (
        ("size", ()), ("levels", ()), ("simulate", ()), ("grinding", ()), ("levels", ("--scene", "grinding")),
    ):  # fmt: skip
        record = once(command, PRESET, *options, "--json").document["result"]["measured_after"]
        predicted.add(round(record["predicted_level_db"], 6))
        assert ("this_run_db" in record) is (command in ("levels", "simulate") and not options)
    assert len(predicted) == 1


def test_it_is_the_median_of_all_start_cases() -> None:
    """By the levels of the start cases, at all drag rates; the same number as the typical level of the ensemble."""
    result = recalled("size", abu_calc.read(PRESET))
    _, ensemble, _ = result.starts.of
    levels = sorted(outcome.level for outcome in ensemble.outcomes)
    assert {outcome.member.drag for outcome in ensemble.outcomes} == {5.0, 15.0, 45.0}
    assert result.ensemble.level_db.typical == pytest.approx(result.ensemble.predicted_level_db, abs=1e-6)
    assert result.ensemble.predicted_level_db == pytest.approx(statistics.median(levels), abs=0.01)
    assert result.measured_after.predicted_level_db == pytest.approx(result.ensemble.predicted_level_db, abs=1e-6)
    mean = 20 * math.log10((10 ** (102 / 20) + 10 ** (103 / 20)) / 2)
    assert result.measured_after.difference_db == pytest.approx(mean - result.ensemble.predicted_level_db, abs=1e-6)


@pytest.mark.slow
def test_no_start_case_is_simulated_without_a_measurement() -> None:
    assert starts_for_measurement(size(machine(**PINNED))) is None
    weak = size(machine(**PINNED, wheel__imbalance_g_mm=5000.0, measured_after={"measured_level_db": 100.0}))
    assert starts_for_measurement(weak) is None
    compared = compared_starts(weak, None)
    assert compared is not None and compared.predicted_level_db is None and predicted_level(weak, None) is None


@pytest.mark.slow
def test_a_place_elsewhere_has_its_own_level() -> None:
    handles = [{"name": name, "from_center_of_mass_mm": at} for name, at in (("rear", -200.0), ("front", 50.0))]
    body = {
        "machine__transverse_inertia_kg_m2": 0.1, "machine__center_of_mass_to_wheel_mm": 200.0,
        "machine__handle": handles,
    }  # fmt: skip
    design = size(machine(**PINNED, **body, measured_after={"measured_level_db": 100.0, "measured_at": "rear"}))
    ensemble = simulate_members(design, shares=(1.0,))
    compared, loudest = compared_starts(design, ensemble), predicted_level(design, ensemble)
    assert compared is not None and compared.predicted_level_db is not None and loudest is not None
    assert compared.place == "rear" and compared.predicted_level_db <= loudest + 1e-9
