"""The study that a file and a request ask for: what varies, how many members, what is refused."""

from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.plan import DRAG, asked, of_starts, planned
from abu_calc.foundation.errors import InputError
from tests.features.sweep.conftest import ECCENTRICITY


def test_tolerances_come_from_the_drawing_and_the_file() -> None:
    machine = abu_calc.read("avtovaz-707-222")
    plan = planned(machine, asked(machine, {ECCENTRICITY: "uniform(0, 0.02)"}, tolerances=True), 0.01)
    ways = {factor.key: factor.variation.text for factor in plan.study.sample.factors}
    assert ways["autobalancer.race_radius_mm"] == "uniform(30.95, 31.05)"  # R 31.00 ± 0.05 on the drawing
    assert ways[ECCENTRICITY] == "uniform(0, 0.02)"
    assert ways["autobalancer.rolling_friction_mm"].startswith("lognormal(0.002")
    assert {
        "wheel.imbalance_g_mm",
        "start.temperature_C",
        "start.kind",
        "suspension.natural_frequencies_hz",
    } <= ways.keys()
    assert "autobalancer.rolling_drag_per_s" not in ways  # the temperature makes it


@pytest.fixture(scope="module")
def machine() -> abu_calc.Machine:
    return abu_calc.read("avtovaz-707-222")


@pytest.mark.slow
def test_listed_values_make_as_many_members_as_combinations(machine: abu_calc.Machine) -> None:
    """Three by two; four are too few; Saltelli's design has a power of two for each value and two more."""
    vary = {"wheel.mass_kg": "0.5:0.7:3", "machine.mass_kg": [5.5, 5.7]}
    sample = planned(machine, asked(machine, vary), 0.01).study.sample
    assert (sample.runs, sample.scheme) == (6, "latin-hypercube")
    with pytest.raises(InputError) as refused:
        planned(machine, asked(machine, vary, runs=4), 0.01)
    assert refused.value.place.key == "runs" and "at least 6" in str(refused.value)
    width = len(sample.factors)
    saltelli = planned(machine, asked(machine, vary, runs=5, sensitivity=True), 0.01).study.sample
    assert (saltelli.runs, saltelli.base) == (8 * (width + 2), 8)


def test_starts_vary_in_every_build_but_in_no_design(machine: abu_calc.Machine) -> None:
    vary = {"wheel.imbalance_g_mm": "normal(260, 10)"}
    built = {factor.key for factor in planned(machine, asked(machine, vary), 0.01).study.sample.factors}
    assert built == {*vary, "start.kind", "start.angle_deg", "start.eccentricity_deg", DRAG}
    designed = planned(machine, asked(machine, vary, what="design"), 0.01)
    assert [factor.key for factor in designed.study.sample.factors] == [*vary]
    warm = dict(of_starts(machine, frozenset({"start.temperature_C"})))
    assert DRAG not in warm  # the temperature makes it
    assert "start.eccentricity_deg" not in dict(
        of_starts(machine.changed({"autobalancer.race_eccentricity_mm": 0.0}), frozenset())
    )


@pytest.mark.parametrize(
    ("vary", "options", "key"),
    [
        (["wheel.mass_kg=0.5:0.7:3", "wheel.mass_kg=0.6"], {}, "vary wheel.mass_kg"),
        ({"wheel.mass_kg": "0.5:0.7:3"}, {"grid": ("wheel.mass_kg", "wheel.mass_kg")}, "grid"),
        ({"wheel.mass_kg": "uniform(0.5, 0.7)"}, {"grid": ("wheel.mass_kg", "machine.mass_kg")}, "grid"),
        ({"start.angle_deg": [400.0]}, {}, "vary start.angle_deg"),
        ({"start.speed": [1.0]}, {}, "vary start.speed"),
        ({"expected.status": ["pass"]}, {}, "vary expected.status"),
    ],
)
def test_what_cannot_vary_is_refused_by_its_key(
    machine: abu_calc.Machine, vary: Any, options: dict[str, Any], key: str
) -> None:
    with pytest.raises(InputError) as refused:
        planned(machine, asked(machine, vary, **options), 0.01)
    assert refused.value.place.key == key


def test_a_key_is_the_same_however_its_unit_is_written(machine: abu_calc.Machine) -> None:
    """97 Hz are 5820 rpm."""
    given = ["machine.speed=90 Hz, 97 Hz", "wheel.imbalance_g_mm=200, 300"]
    ask = asked(machine, given, grid=("machine.speed", "wheel.imbalance"))
    assert dict(ask.vary)["machine.speed_rpm"].values == pytest.approx((5400.0, 5820.0))
    assert ask.grid == ("machine.speed_rpm", "wheel.imbalance_g_mm")
    with pytest.raises(InputError, match="stands twice"):
        asked(machine, ["machine.speed=90 Hz, 97 Hz", "machine.speed_rpm=5000, 6000"])
