"""Many machines like one: closed forms, stores that go on, and members that hang on nothing but their number."""

import math
import sqlite3
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import abu_calc
from abu_calc.features.sweep.samples import SweepStudy
from tests.features.sweep.test_store import rows
from tests.inputs.scenes import LIGHT_BALLS
from tests.remembered import recalled, remembered

ECCENTRICITY = "autobalancer.race_eccentricity_mm"
QUIET = {
    "machine.spindle_axis": "vertical",
    "autobalancer.rolling_friction_mm": 0.0,
    "limits.vibration_level_db": 100.0,
}
"""Nothing keeps balls from their places: what stays is the race's eccentricity."""
CALM = {
    "start.kind": "choice(bunched)",
    "start.angle_deg": "choice(20)",
    "autobalancer.rolling_drag_per_s": "choice(15)",
}


@pytest.fixture(scope="module")
def machine() -> abu_calc.Machine:
    return abu_calc.read("avtovaz-707-222").changed(QUIET)


@pytest.mark.hard
def test_the_share_that_meets_a_level_is_that_of_the_eccentricity(machine: abu_calc.Machine) -> None:
    """L = 20 lg(Ω·Δ/√2/v₀) for Δ uniform: members are strata of it, so the share is right to one and a half of them."""
    runs, low, high = 24, 0.004, 0.016
    found = abu_calc.sweep(machine, {ECCENTRICITY: f"uniform({low}, {high})", **CALM}, runs)
    speed, limit = 5800 * math.pi / 30, 5e-8 * 10 ** (100 / 20)
    share = (1e3 * math.sqrt(2) * limit / speed - low) / (high - low)
    assert 0.3 < share < 0.7
    assert found.meets_limits.each["meets_level"].share == pytest.approx(share, abs=1.5 / runs)
    off, level = found.members[ECCENTRICITY], found.members["level_db"]
    expected = 20 * np.log10(speed * 1e-3 * off / math.sqrt(2) / 5e-8)
    assert np.abs(level - expected).max() < 0.1
    assert found.sensitivity[0].key == ECCENTRICITY and found.sensitivity[0].total > 0.95
    low_end, high_end = found.meets_limits.confidence_interval
    assert low_end < share < high_end


@pytest.mark.slow
def test_percentiles_and_shares_are_those_of_the_members(machine: abu_calc.Machine) -> None:
    found = abu_calc.sweep(machine, {ECCENTRICITY: "uniform(0.004, 0.016)"}, 16, seed=3)
    level = found.members["level_db"]
    one = found.quantities["level_db"]
    assert (one.p05, one.p50, one.p95) == pytest.approx(tuple(np.percentile(level, (5, 50, 95))))
    assert one.mean == pytest.approx(level.mean())
    many = found.distributions["level_db"]
    assert many.values == pytest.approx(tuple(np.percentile(level, many.percent))) and many.limit == 100.0
    for basin in found.basins:
        these = found.members["start.kind"] == basin.start
        assert (basin.of, basin.met) == (these.sum(), int(found.members["balances"][these].sum()))
    assert found.meets_limits.met == int(found.members["meets_limits"].sum())
    assert len(found.members) == found.runs == 16 and found.members.units["level_db"] == "dB"
    assert {str(kind) for kind in found.members["start.kind"]} == {"bunched", "spread", "standstill", "run-up"}
    assert {one.key for one in found.varied} >= {"start.angle_deg", "start.eccentricity_deg"}
    assert (level <= 100).sum() == found.meets_limits.each["meets_level"].met


@pytest.mark.slow
def test_a_store_goes_on_to_the_same_members(
    machine: abu_calc.Machine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    vary = {ECCENTRICITY: "uniform(0.004, 0.016)"}
    whole, broken, threads = (tmp_path / f"{name}.sqlite" for name in ("whole", "broken", "threads"))
    abu_calc.sweep(machine, vary, 6, store=whole)
    computed = SweepStudy._row

    def stopped(self: SweepStudy, member: int, may_end_process: bool) -> Any:
        if member == 3:
            raise KeyboardInterrupt
        return computed(self, member, may_end_process)

    monkeypatch.setattr(SweepStudy, "_row", stopped)
    with pytest.raises(KeyboardInterrupt, match="of 6 samples"):
        abu_calc.sweep(machine, vary, 6, store=broken)
    assert 0 < len(rows(broken)) < 6
    monkeypatch.setattr(SweepStudy, "_row", computed)
    abu_calc.sweep(machine, store=broken, resume=True)
    abu_calc.sweep(machine, vary, 6, store=threads, executor=ThreadPoolExecutor(2))
    assert rows(whole) == rows(broken) == rows(threads)
    assert [row[0] for row in rows(whole)] == list(range(6))
    with pytest.raises(abu_calc.InputError, match="exists already"):
        abu_calc.sweep(machine, vary, 6, store=whole)
    for values, options, part in (
        ({"wheel.mass_kg": 0.7}, {}, r"file\.wheel\.mass_kg is 0\.6 there and 0\.7 here"),
        ({}, {"seed": 2}, "seed is 0 there and 2 here"),
        ({}, {"runs": 13}, "runs is 6 there and 13 here"),
    ):
        with pytest.raises(abu_calc.InputError, match=part):
            abu_calc.sweep(machine.changed(values), vary, **{"runs": 6, "store": whole, "resume": True, **options})
    database = sqlite3.connect(whole)
    assert database.execute("PRAGMA journal_mode").fetchone()[0] == "wal"
    assert dict(database.execute("SELECT name, unit FROM columns"))["residual_um"] == "µm"
    assert database.execute("SELECT members_before, members_after, seed FROM runs").fetchall() == [(0, 6, 0)]
    database.execute("UPDATE study SET value = '\"0.0.9\"' WHERE key = 'accuracy'")
    database.commit()
    database.close()
    with pytest.raises(abu_calc.InputError, match=r"accuracy is .0\.0\.9. there"):
        abu_calc.sweep(machine, vary, 6, store=whole, resume=True)


@pytest.mark.slow
def test_a_member_that_fails_or_hangs_is_recorded_and_the_others_go_on(
    machine: abu_calc.Machine, monkeypatch: pytest.MonkeyPatch
) -> None:
    from abu_calc.features.sweep.samples import Builds

    numbers = Builds.numbers

    def some(self: Builds, values: Any, seed: int) -> Any:
        off = values[ECCENTRICITY]
        if off == 0.005:
            while True:
                time.sleep(0.01)
        if off == 0.006:
            raise abu_calc.NotTrustworthyError("no number")
        if off == 0.007:
            raise ZeroDivisionError("division")
        return numbers(self, values, seed)

    monkeypatch.setattr(Builds, "numbers", some)
    found = abu_calc.sweep(machine, {ECCENTRICITY: [0.004, 0.005, 0.006, 0.007, 0.008]}, time_limit_s=10.0)
    assert {one.reason: one.members for one in found.failed.reasons} == {
        "not done within 10 s": 1,
        "no number": 1,
        "ZeroDivisionError: division": 1,
    }
    assert found.status == "not-done" and found.meets_limits.of == 5 and found.meets_limits.met <= 2
    assert np.isfinite(found.members["level_db"]).tolist() == [True, False, False, False, True]


@pytest.mark.slow
def test_no_member_with_a_number_is_no_answer(machine: abu_calc.Machine, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(*_: Any) -> Any:
        raise abu_calc.NotTrustworthyError("no number")

    monkeypatch.setattr("abu_calc.features.sweep.samples.Builds.numbers", none)
    with pytest.raises(abu_calc.NotTrustworthyError, match="none of 3 samples"):
        abu_calc.sweep(machine, {ECCENTRICITY: [0.004, 0.005, 0.006]})


@pytest.mark.hard
def test_designs_are_sized_anew() -> None:
    machine = abu_calc.read("avtovaz-707-222")
    with remembered():
        members = abu_calc.sweep(machine, {"wheel.imbalance_g_mm": [100.0, 300.0]}, what="design", workers=1).members
    light = recalled("size", machine.changed({"wheel.imbalance_g_mm": 100.0}))
    assert members["mass_g"][0] == pytest.approx(light.autobalancer.mass_g)
    assert members["mass_g"][1] > 1.1 * members["mass_g"][0]
    assert members["ball_count"][0] == light.autobalancer.ball_count
    assert members["meets_limits"][0] == (light.status == "pass")


SCENE = (
    LIGHT_BALLS
    + """\
[sweep]
grid = ["start.angle_deg", "scene.speed_rpm"]
[sweep.vary]
"start.angle_deg" = "0:120:3"
"scene.speed_rpm" = [6.0, 24.0]
"""
)


@pytest.mark.slow
def test_a_table_says_what_options_say(tmp_path: Path) -> None:
    """Below the resonance, at 9.5 rpm, balls go to the heavy side from wherever they start."""
    file = tmp_path / "scene.toml"
    file.write_text(SCENE)
    bare = tmp_path / "bare.toml"
    bare.write_text(SCENE.partition("[sweep]")[0])
    found = abu_calc.sweep(abu_calc.read_scene(file))
    given = abu_calc.sweep(
        abu_calc.read_scene(bare),
        ["start.angle_deg=0:120:3", "scene.speed_rpm=6.0, 24.0"],
        grid=("start.angle_deg", "scene.speed_rpm"),
    )
    assert found.to_dict() == given.to_dict()
    assert found.runs == 6 and found.chart is not None
    assert found.chart.x == (0, 60, 120) and found.chart.y == (6.0, 24.0)
    assert found.chart.shares == ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))


@pytest.mark.parametrize(
    ("options", "key"),
    [
        ({"runs": 0}, "runs"),
        ({"runs": 2, "vary": {"wheel.mass_kg": "0.5:0.7:3"}}, "runs"),
        ({"what": "desing"}, "what"),
        ({"sampling": "random"}, "sampling"),
        ({"seed": -1}, "seed"),
        ({"time_limit_s": 0.0}, "time_limit_s"),
        ({"grid": ("wheel.mass_kg", "machine.mass_kg")}, "grid"),
        ({"vary": {"wheel.mas_kg": "1:2:2"}}, "vary wheel.mas_kg"),
        ({"vary": {"wheel.mass_kg": 0.5}}, "vary wheel.mass_kg"),
        ({"vary": ["wheel.mass_kg"]}, "vary"),
        ({"vary": {"start.kind": "choice(asleep)"}}, "vary start.kind"),
        ({"vary": {"start.kind": "choice(spread)"}, "what": "design"}, "vary start.kind"),
        ({"vary": {"start.temperature_C": "uniform(0, 200)"}}, "start.temperature_C"),
        ({"vary": {"sweep.runs": "1:2:2"}}, "vary sweep.runs"),
        ({"store": "/no/such/folder/x.sqlite"}, "store"),
        ({"vary": 5}, "vary"),
        ({"executor": 5}, "executor"),
        ({"workers": 0}, "workers"),
    ],
    ids=str,
)
def test_wrong_arguments_are_refused_by_name(options: dict[str, Any], key: str) -> None:
    with pytest.raises(abu_calc.InputError) as refused:
        abu_calc.sweep(abu_calc.read("msh-230"), **options)
    assert refused.value.place.key == key


@pytest.mark.slow
def test_saltellis_design_spends_its_runs_and_counts_each_machine_once(machine: abu_calc.Machine) -> None:
    """Members of the mixed matrices repeat the values of others: shares and percentiles are those of the first two."""
    vary = {ECCENTRICITY: "uniform(0.004, 0.016)", "wheel.imbalance_g_mm": "choice(200, 260)", **CALM}
    found = abu_calc.sweep(machine, vary, 4, sensitivity=True)
    width = len(found.varied)
    assert found.runs == 4 * (width + 2) and found.meets_limits.of == 8
    level = found.members["level_db"]
    assert found.quantities["level_db"].p50 == pytest.approx(np.median(level[:8]))
    parts = found.members[ECCENTRICITY].reshape(width + 2, 4)
    place = [one.key for one in found.varied].index(ECCENTRICITY)
    assert (parts[2 + place] == parts[1]).all() and (parts[3 + place] == parts[0]).all()
    assert any("rough" in warning for warning in found.warnings)
