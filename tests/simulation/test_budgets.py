"""Budgets are kept: what runs when the time is over is broken off, and all runs of a command share their work."""

import time
from typing import Any

import pytest

import abu_calc
from abu_calc.dynamics.integrators import choice
from abu_calc.features.accuracy import study as accuracy
from abu_calc.simulation import subject as effect_selection
from abu_calc.simulation.simulate import WORK, WORK_PLAIN, usual_work
from abu_calc.simulation.subject import subject_of

ENDLESS_S = 60.0


def endless(name: str, equations: Any, tolerance: float, times: Any, most: int) -> Any:
    """A run longer than any budget here, which tells how far it is; a test that waits for its end fails."""
    until = time.monotonic() + ENDLESS_S
    while time.monotonic() < until:
        if tell := getattr(times, "report", None):
            tell(0.0)
    raise AssertionError("nobody broke it off")


@pytest.mark.slow
def test_a_reference_without_end_is_broken_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accuracy, "_load", lambda *_: None)
    monkeypatch.setattr(choice, "integrate_with", endless)
    with pytest.raises(abu_calc.NotTrustworthyError, match=r"takes more than 0\.4 s\n  give more time"):
        abu_calc.accuracy(abu_calc.read("msh-230"), budget_s=0.2)


@pytest.mark.slow
def test_a_method_without_end_is_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    """And so are tighter tolerances of it."""
    scene = subject_of(abu_calc.read("msh-230"), None, None).scene
    monkeypatch.setattr(choice, "integrate_with", endless)
    group = [accuracy._integration("equations", scene, "slow", tolerance) for tolerance in (1e-3, 1e-4)]
    end = time.perf_counter() + 0.2
    points, left = accuracy._measured(scene, group, None, "amplitude", end, lambda _: None)  # type: ignore[arg-type]
    assert points == [] and left == ["equations slow 0.001", "equations slow 0.0001"]


def test_loading_is_no_part_of_the_time(monkeypatch: pytest.MonkeyPatch) -> None:
    def load(*_: Any) -> None:
        time.sleep(0.5)

    monkeypatch.setattr(accuracy, "_load", load)
    begun = list[float]()

    def reference(*_: Any) -> Any:
        begun.append(time.perf_counter())
        raise abu_calc.NotTrustworthyError("seen")

    monkeypatch.setattr(accuracy, "_reference", reference)
    with pytest.raises(abu_calc.NotTrustworthyError, match="seen"):
        abu_calc.accuracy(abu_calc.read("msh-230"), budget_s=0.2)
    assert len(begun) == 1


@pytest.mark.slow
def test_an_audit_has_what_the_run_leaves_of_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    allowed = list[int]()

    simulate = effect_selection.simulate

    def simulated(full: Any, asked: float, times: Any, most: int | None, *more: Any, **others: Any) -> Any:
        if not full.effect("dry_rolling_friction"):
            return simulate(full, asked, times, most, *more, **others)
        assert most is not None
        allowed.append(most)
        raise abu_calc.NotTrustworthyError("seen")

    monkeypatch.setattr(effect_selection, "simulate", simulated)
    machine = abu_calc.read("msh-230")
    for most in (None, 5_000_000):
        with pytest.raises(abu_calc.NotTrustworthyError, match="seen"):
            abu_calc.simulate(machine, without_effects=["dry_rolling_friction"], audit=True, most_evaluations=most)
    assert 0 < WORK - allowed[0] == 5_000_000 - allowed[1] < 1_000_000


def test_plain_code_that_is_asked_for_has_the_time_of_the_others() -> None:
    scene = subject_of(abu_calc.read("msh-230"), None, None).scene
    assert usual_work(scene, "auto") == WORK and usual_work(scene, "plain") == WORK_PLAIN < WORK / 10
