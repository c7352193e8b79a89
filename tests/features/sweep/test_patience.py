"""`--patience` of a sweep: members that are not computed in time are told so, and the next run computes them."""

import time
from dataclasses import replace
from typing import Any

import pytest

import abu_calc
from abu_calc.features.sweep.batches import IMPATIENT, Row, in_batches, processes
from abu_calc.features.sweep.plan import asked, planned
from abu_calc.features.sweep.samples import Builds, Overtime, SweepStudy
from abu_calc.foundation import patience
from abu_calc.inputs.read_machine import read
from tests.cli.runner import abu
from tests.features.sweep.conftest import Sweeps
from tests.features.sweep.test_samples import failing, reasons


def statuses(result: abu_calc.SweepResult) -> dict[str, str]:
    return {check.code: check.status for check in result.checks}


@pytest.mark.slow
def test_members_left_out_are_no_answers_and_are_computed_later(
    sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = sweeps.run(sweeps.folder / "whole.sqlite")
    seeds = whole.members["seed"].astype(int).tolist()
    with monkeypatch.context() as patch, patience.limited(50.0):  # less than one member may take
        failing(patch, {seed: Overtime() for seed in seeds[5:]})
        hasty = sweeps.run()
    assert reasons(sweeps) == dict.fromkeys(range(5, 12), IMPATIENT)
    assert statuses(hasty) == {"ABU821": "not-done", "ABU822": "not-done"} and hasty.status == "not-done"
    assert hasty.meets_limits.of == 5 and hasty.quantities["level_db"].p50 is not None
    with monkeypatch.context() as patch:
        computed = failing(patch, {})
        again = sweeps.run(resume=True)
    assert computed == seeds[5:] and reasons(sweeps) == {}
    assert again.members["level_db"].tolist() == whole.members["level_db"].tolist()
    assert statuses(again) == statuses(whole) and again.meets_limits == whole.meets_limits


@pytest.mark.slow
def test_more_patience_computes_what_less_left_out(sweeps: Sweeps) -> None:
    """With none at all no member gives a number, yet each stands in the store with the reason."""
    with patience.limited(1e-9), pytest.raises(abu_calc.NotTrustworthyError, match="--patience"):
        sweeps.run()
    assert set(reasons(sweeps).values()) == {IMPATIENT} and len(reasons(sweeps)) == 12
    with patience.limited(600.0):
        found = sweeps.run(resume=True)
    assert found.failed.members == 0 and reasons(sweeps) == {}


def test_a_member_does_not_depend_on_patience(sweeps: Sweeps, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its runs are bounded by counts of work, as without: a wall of seconds would take their place."""
    numbers, walls = Builds.numbers, []

    def seen(self: Builds, values: Any, seed: int) -> Any:
        walls.append(patience.given())
        return numbers(self, values, seed)

    monkeypatch.setattr(Builds, "numbers", seen)
    with patience.limited(600.0):
        sweeps.run()
        assert patience.given()
    assert len(walls) == 12 and not any(walls)


def late(until: float) -> SweepStudy:
    """A study of four members whose patience is over at a time."""
    machine = read("avtovaz-707-222")
    ask = asked(machine, ["wheel.imbalance_g_mm=uniform(200, 300)"], runs=4)
    return replace(planned(machine, ask, 0.01).study, until=until)


@pytest.mark.slow
def test_worker_processes_know_when_it_is_over() -> None:
    """A time long past, and one to come, in one process each."""
    found: dict[bool, list[Row]] = {True: [], False: []}
    for over, rows in found.items():
        workers = processes(1)
        in_batches(late(1.0 if over else time.time() + 600), iter(range(4)), workers, rows.extend)
        workers.close()
    assert [row[-1] for row in found[True]] == [IMPATIENT] * 4
    assert [row[-1] for row in found[False]] == [None] * 4


@pytest.mark.slow
def test_the_command_has_the_option() -> None:
    given = ("--vary", "wheel.imbalance_g_mm=uniform(200, 300)", "--runs", "4", "--workers", "1")
    hasty = abu("sweep", "avtovaz-707-222", *given, "--patience", "1e-6")
    assert hasty.status == 3 and "--patience" in hasty.err
    patient = abu("sweep", "avtovaz-707-222", *given, "--patience", "600", "--json")
    assert patient.status == 0 and patient.document["result"]["failed"]["members"] == 0
