"""One quiet and one rest time for one start and drag, by each command: `abu size`, its tables, `abu simulate`."""

import math
from functools import cache

import pytest

import abu_calc
from abu_calc.features.design.starts import SettlingOfStart
from abu_calc.features.design.study import SizeResult
from abu_calc.features.simulate.study import SimulateResult
from abu_calc.inputs.read_machine import Machine
from tests.remembered import recalled

PRESETS = ("avtovaz-707-222", "avtovaz-707-305", "avtovaz-707-370", "msh-230")

SETTINGS: dict[str, dict[str, object]] = {
    "run-up": {"run_up.time_s": 1.5},
    "vertical": {"machine.spindle_axis": "vertical", "autobalancer.rolling_drag_per_s": 8.0},
    "pause": {"run_up.time_s": 0.8, "run_up.pause_speed_rpm": 1100.0, "run_up.pause_s": 0.5},
    "motor": {
        "run_up.time_s": 0.8, "motor.stall_torque_N_m": 3.0, "motor.no_load_speed_rpm": 6200.0,
        "motor.rotor_inertia_kg_m2": 1e-3,
    },
}  # fmt: skip
"""Entries of machines beside the presets."""

NAMES = [
    name if name in ("avtovaz-707-222", "run-up") else pytest.param(name, marks=pytest.mark.slow)
    for name in (*PRESETS, *SETTINGS)
]
"""A preset and a run-up of a file stand for all others, which take long."""

NEAR = 0.03
"""Of the times: one run in the ensemble against two that agree; by the pause 2 % apart, elsewhere below 1 %."""


@cache
def sized(name: str) -> tuple[Machine, SizeResult]:
    """The machine with the design pinned that it was sized to, and its result."""
    source = abu_calc.read("avtovaz-707-222" if name in SETTINGS else name).changed(SETTINGS.get(name, {}))
    result = recalled("size", source)
    one = result.autobalancer
    pins = {
        "ball_count": one.ball_count,
        "ball_diameter_mm": one.ball_diameter_mm,
        "race_radius_mm": one.race_radius_mm,
    }
    return source.changed({f"autobalancer.{key}": value for key, value in pins.items()}), result


def simulated(source: Machine, row: SettlingOfStart) -> SimulateResult:
    """The start of a row of the table by `abu simulate`."""
    run_up = row.start.startswith("run-up")
    return abu_calc.simulate(
        source.changed({"autobalancer.rolling_drag_per_s": row.drag_per_s}), "run-up" if run_up else "idle",
        "bunched" if run_up else row.start, race_centre_deg=row.race_centre_deg,
    )  # fmt: skip


@pytest.mark.few(0, 2)
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.hard if name in ("pause", "vertical", "motor") else pytest.mark.slow)
        for name in (*PRESETS, *SETTINGS)
    ],
)
def test_simulate_repeats_the_times_of_size(name: str) -> None:
    source, result = sized(name)
    assert result.ensemble is not None
    drag = result.starts.drag_per_s
    rows = [row for row in result.ensemble.settling_by_start if "rpm" not in row.start or "by the motor" in row.start]
    assert len(rows) >= 12
    compared = 0
    for row in rows:
        given = row.drag_per_s == drag
        if row.start.startswith("run-up") and "run_up" not in str(SETTINGS.get(name)):
            continue  # its file has no run-up, which the scene of `abu simulate` needs
        if not given and row.start != "standstill":
            continue
        run = simulated(source, row)
        revolution = 60 / run.final.rotor_speed_rpm
        assert run.quiet_time_s == pytest.approx(row.quiet_time_s, rel=NEAR, abs=revolution), row
        assert run.rest_time_s == pytest.approx(row.rest_time_s, rel=NEAR, abs=revolution), row
        (check,) = (one for one in run.checks if one.code == "ABU702")
        assert check.value == run.quiet_time_s
        compared += 1
    assert compared >= 6


@pytest.mark.few(0, 3)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.slow
def test_one_result_holds_one_time_for_one_start(name: str) -> None:
    """The idle scene of `abu size`, the table, the check, the spread and the starts shown."""
    source, result = sized(name)
    many, idle = result.ensemble, result.simulation[0]
    assert many is not None
    alone = abu_calc.simulate(source)
    for name in ("quiet_time_s", "rest_time_s", "settling_time_s"):
        assert getattr(idle, name) == pytest.approx(getattr(alone, name), rel=1e-6)
    table = {(row.start, row.drag_per_s): row.quiet_time_s for row in many.settling_by_start}
    assert len({drag for _, drag in table}) == 3
    assert many.quiet_time_s.worst == max(time if time is not None else math.inf for time in table.values())
    rested = max(math.inf if row.rest_time_s is None else row.rest_time_s for row in many.settling_by_start)
    assert many.rest_time_s.worst is not None and many.rest_time_s.worst >= rested
    (check,) = (one for one in result.checks if one.code == "ABU702")
    drag = result.starts.drag_per_s
    assert check.value == max(time for (_, given), time in table.items() if given == drag and time is not None)
    for view in result.starts.views:
        if not view.why:
            assert view.quiet_time_s == table[view.start, view.drag_per_s]


@pytest.mark.slow
def test_times_count_from_full_speed_in_a_scene_file_too() -> None:
    """The same run-up, as a scene of a machine and given outright."""
    source = abu_calc.read("avtovaz-707-222").changed({"run_up.time_s": 1.5})
    run = abu_calc.simulate(source, "run-up")
    outright = abu_calc.simulate(run.run.scene)
    assert run.full_speed_s == outright.full_speed_s == 1.5
    for name in ("quiet_time_s", "rest_time_s", "settling_time_s"):
        assert getattr(outright, name) == pytest.approx(getattr(run, name), rel=1e-3) and getattr(run, name) < 1
    assert abu_calc.simulate(source).full_speed_s is None


@pytest.mark.slow
def test_samples_change_no_time() -> None:
    """Balls creep by friction at the end of this scene, so that the run is followed for longer, to its last sample."""
    source = abu_calc.read("avtovaz-707-305")
    hot = source.changed({"autobalancer.rolling_drag_per_s": 45.0})
    plain, sampled = (abu_calc.simulate(hot, "idle", "standstill", race_centre_deg=0.0, samples=n) for n in (None, 50))
    for name in ("quiet_time_s", "rest_time_s", "settling_time_s"):
        assert getattr(sampled, name) == pytest.approx(getattr(plain, name), rel=1e-9)
    assert sampled.motion is not None and plain.final.t_s == sampled.final.t_s == sampled.motion.t_s[-1]
