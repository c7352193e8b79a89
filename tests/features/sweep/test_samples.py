"""Reasons of members without numbers: those that lie in the computer are no results; one run of a scene.

Work that takes too long is given up in any thread.
"""

import contextlib
import math
import sqlite3
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest

import abu_calc
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.features.sweep.batches import drag_ratio
from abu_calc.features.sweep.plan import asked, planned
from abu_calc.features.sweep.samples import Builds, Overtime, limited, scene_once, started
from abu_calc.simulation.run_checks import allowed_of_scene
from abu_calc.simulation.start_cases import OPPOSITE, Variation
from abu_calc.sizing import size
from tests.dynamics.scenes import dimensionless
from tests.features.sweep.conftest import Sweeps
from tests.sizing.machines import PINNED, machine


def reasons(sweeps: Sweeps) -> dict[int, str]:
    database = sqlite3.connect(sweeps.store)
    try:
        return dict(database.execute("SELECT member, reason FROM members WHERE reason IS NOT NULL"))
    finally:
        database.close()


def failing(monkeypatch: pytest.MonkeyPatch, seeds: dict[int, BaseException]) -> list[int]:
    """Members of these seeds raise; the seeds of all that are computed, in their order."""
    numbers, computed = Builds.numbers, []

    def some(self: Builds, values: Any, seed: int) -> Any:
        computed.append(seed)
        if seed in seeds:
            raise seeds[seed]
        return numbers(self, values, seed)

    monkeypatch.setattr(Builds, "numbers", some)
    return computed


@pytest.mark.slow
def test_a_failed_import_is_no_members_result(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    seeds = sweeps.run(sweeps.folder / "whole.sqlite").members["seed"].astype(int).tolist()
    with monkeypatch.context() as patch:
        failing(patch, {seeds[3]: ImportError("numpy._core.multiarray failed to import")})
        with pytest.raises(abu_calc.NotTrustworthyError, match=r"library cannot be loaded.*multiarray") as ended:
            sweeps.run()
    assert ended.value.__notes__ == ["3 of 12 samples"] and reasons(sweeps) == {}
    assert (sweeps.run(resume=True).members["level_db"] > 80).all()


@pytest.mark.slow
def test_members_that_failed_in_the_computer_are_tried_again_and_no_others(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    seeds = sweeps.run(sweeps.folder / "whole.sqlite").members["seed"].astype(int).tolist()
    faults = {3: OSError("no space"), 5: MemoryError("none"), 7: abu_calc.NotTrustworthyError("no number")}
    with monkeypatch.context() as patch:
        failing(patch, {seeds[member]: error for member, error in faults.items()})
        failed = sweeps.run().failed
    assert failed.members == 3
    assert reasons(sweeps) == {
        3: "not computed: OSError: no space", 5: "not computed: MemoryError: none", 7: "no number",
    }  # fmt: skip
    with monkeypatch.context() as patch:
        computed = failing(patch, {})
        assert sweeps.run(resume=True).failed.members == 1
    assert computed == [seeds[3], seeds[5]] and reasons(sweeps) == {7: "no number"}


@pytest.mark.slow
def test_a_member_that_took_too_long_is_tried_again_with_more_time(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    from abu_calc.features.sweep.samples import Overtime

    seeds = sweeps.run(sweeps.folder / "whole.sqlite").members["seed"].astype(int).tolist()
    with monkeypatch.context() as patch:
        failing(patch, {seeds[4]: Overtime()})
        sweeps.run(time_limit_s=9.0)
    assert reasons(sweeps) == {4: "not done within 9 s"}
    assert sweeps.run(resume=True, time_limit_s=9.0).failed.members == 1
    assert sweeps.run(resume=True, time_limit_s=10.0).failed.members == 0


def test_a_scene_above_its_resonance_balances_and_one_below_does_not() -> None:
    """Two balls of 0.02 each balance 0.02 above the natural frequency of 1; below it they join it.

    All three side by side make 0.06; drag holds the balls a little behind.
    """
    above, balances = scene_once(dimensionless(3.0, 0.02, 0.02, 0.1, 0.2, (1.5, -1.7), 200.0), 1e-6)
    below, balances_below = scene_once(dimensionless(0.5, 0.02, 0.02, 0.1, 0.2, (1.5, -1.7), 200.0), 1e-6)
    assert balances and above.residual_imbalance < 1e-4
    assert not balances_below and 0.055 < below.residual_imbalance <= 0.06


def test_values_of_a_sample_make_its_start_case() -> None:
    """The middle of the bunch lies 20° ahead of the imbalance unless the sample says otherwise."""
    driven, factors = size(machine(**PINNED, run_up={"time_s": 0.7})), (1.0, 1.01, 0.99, 1.0)
    usual = started(driven, {}, factors)
    assert (usual.start, usual.drag, usual.turned) == ("bunched", driven.case.drag, 0.0)
    assert usual.eccentricity == OPPOSITE and usual.varied == Variation(ball_masses=factors)
    values = {"start.temperature_C": 70.0, "start.angle_deg": 110.0, "start.eccentricity_deg": 90.0}
    member = started(driven, {"start.kind": "run-up", **values}, factors)
    assert member.run_up == 0.7 and member.turned == pytest.approx(math.pi / 2)
    assert member.eccentricity == pytest.approx(math.pi / 2)
    assert member.drag == pytest.approx(drag_ratio(70.0) * driven.case.drag)


def test_a_sample_is_followed_until_its_balls_rest() -> None:
    """A ball that lingers on the heavy side leaves it some time after the scene of the machine ends."""
    grinder = abu_calc.read("avtovaz-707-305")
    study = planned(grinder, asked(grinder, None, runs=300, seed=1, tolerances=True), 0.01).study
    ((_, _, *values),), _ = study.rows((165,))
    level, _, rest_time, *_ = values[len(study.sample.factors) :]
    # By the scene alone it has no rest time, and 102 dB.
    assert rest_time is not None and rest_time > 2.0 and level < 92.0


def test_dry_friction_and_eccentricity_widen_what_is_allowed() -> None:
    """A tenth of the imbalance, and M·Δ of a race that is off by Δ."""
    scene = dimensionless(3.0, 0.1, 0.1, 0.3, 0.05, (1.5, -1.7), 3.0)
    response = SimpleNamespace(ball_angles=(2.0, -2.0))
    plain = allowed_of_scene(scene, response.ball_angles)
    off = replace(scene, effects=(RaceEccentricityEffect(1e-3, 0.0),))
    assert allowed_of_scene(off, response.ball_angles) - plain == pytest.approx(scene.support.felt_mass * 1e-3)


def test_work_without_end_is_given_up() -> None:
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.1):
        while True:
            pass
    assert time.perf_counter() - begun < 60
    with limited(0.05):
        pass
    time.sleep(0.1)  # nothing arrives afterwards


@pytest.mark.slow
def test_the_end_of_the_time_is_told_again_if_something_swallows_it() -> None:
    """As callbacks of the garbage collector do."""
    begun = time.perf_counter()
    with pytest.raises(Overtime), limited(0.05):
        with contextlib.suppress(BaseException):
            while time.perf_counter() - begun < 60:
                pass
        while time.perf_counter() - begun < 60:
            pass


def test_time_is_limited_in_other_threads_too() -> None:
    def endless() -> str:
        try:
            with limited(0.1):
                while True:
                    pass
        except Overtime:
            return "given up"

    with ThreadPoolExecutor(1) as pool:
        assert pool.submit(endless).result(timeout=60) == "given up"
