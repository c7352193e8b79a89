"""Reasons of members without numbers: those that lie in the computer are no results."""

import sqlite3
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.samples import Builds
from tests.features.sweep.conftest import Sweeps


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


def test_a_failed_import_is_no_members_result(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    seeds = sweeps.run(sweeps.folder / "whole.sqlite").members["seed"].astype(int).tolist()
    with monkeypatch.context() as patch:
        failing(patch, {seeds[3]: ImportError("numpy._core.multiarray failed to import")})
        with pytest.raises(abu_calc.NotTrustworthyError, match=r"library cannot be loaded.*multiarray") as ended:
            sweeps.run()
    assert ended.value.__notes__ == ["3 of 12 samples"] and reasons(sweeps) == {}
    assert (sweeps.run(resume=True).members["level_db"] > 80).all()


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


def test_a_member_that_took_too_long_is_tried_again_with_more_time(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    from abu_calc.features.sweep.sample_run import Overtime

    seeds = sweeps.run(sweeps.folder / "whole.sqlite").members["seed"].astype(int).tolist()
    with monkeypatch.context() as patch:
        failing(patch, {seeds[4]: Overtime()})
        sweeps.run(time_limit_s=9.0)
    assert reasons(sweeps) == {4: "not done within 9 s"}
    assert sweeps.run(resume=True, time_limit_s=9.0).failed.members == 1
    assert sweeps.run(resume=True, time_limit_s=10.0).failed.members == 0
