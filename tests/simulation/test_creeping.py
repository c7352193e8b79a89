"""Creeping balls: the bound on the imbalance they leave on their way, and the runs that it ends early."""

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from abu_calc.inputs.read_machine import read_machine
from abu_calc.simulation.creeping import SOON, harmless_way, linger
from abu_calc.simulation.ensemble import TOLERANCE, start_once
from abu_calc.simulation.ensemble_results import StartOutcome
from abu_calc.simulation.start_cases import Member, scene_of_member
from abu_calc.sizing import size
from abu_calc.sizing.design import Design

MACHINES = Path(__file__).parents[1] / "machines"


@cache
def design(name: str) -> Design:
    """Of a preset or a machine of the tests."""
    file = MACHINES / f"{name}.toml"
    return size(read_machine(str(file) if file.exists() else name).whole("size"))


@pytest.mark.slow
def test_balls_that_creep_without_inertia_stay_within_the_circle_of_their_way() -> None:
    """θ_k' = −∂/∂θ_k ½|U − U_b|² from 300 random starts of 2 to 8 balls, in units of the imbalance."""
    rng = np.random.default_rng(3)
    for _ in range(300):
        count = int(rng.integers(2, 9))
        moment = rng.uniform(1.1, 2.5) / count
        balanced = rng.uniform(0, 0.35) * np.exp(1j * rng.uniform(0, math.tau))
        theta, path = rng.uniform(0, math.tau, count), []
        for _ in range(600):
            left = 1 + moment * np.exp(1j * theta).sum()
            path.append(left)
            theta = theta - 0.1 / (count * moment) * np.real(np.conj(left - balanced) * 1j * np.exp(1j * theta))
        way = np.array(path)
        ahead = np.maximum.accumulate(np.abs(way)[::-1])[::-1]
        bound = (np.abs(way + balanced) + np.abs(way - balanced)) / 2
        assert (ahead <= bound + 0.01).all()


def outcome(found: Design, left: float, **changed: float) -> StartOutcome:
    """Of a start that settled soon and leaves so much [kg m]."""
    numbers = {"settling_time": 0.1, "level": 90.0, "slip": 0.0, "allowed": 1.0} | changed
    return StartOutcome(Member("bunched", found.case.drag), residual=0.0, imbalance=left, **numbers)


@pytest.mark.parametrize(
    "changed", [{"settling_time": 0.9}, {"level": 108.5}, {"allowed": 1e-9}, {"slip": 0.5}, {"settling_time": math.inf}]
)
def test_a_way_is_harmless_unless_a_verdict_may_change_on_it(changed: dict[str, float]) -> None:
    """Balls of the arm that now leave a quarter of what they leave where they balance: they only leave more."""
    found = design("swing-arm-grinder")
    scene = scene_of_member(found, Member("bunched", found.case.drag, 0.0, math.pi))
    balanced = -found.autobalancer.requirement.effective_mass * found.case.race_eccentricity
    left = complex(0.25 * balanced)
    good, bad = outcome(found, abs(left)), outcome(found, abs(left), **changed)
    way = harmless_way(found, scene, left, lambda creep: good)
    assert way is not None and way.down == pytest.approx(0, abs=1e-9)
    assert way.up == pytest.approx(0.75 * abs(balanced), rel=1e-6)
    assert harmless_way(found, scene, left, lambda creep: bad) is None
    assert found.case.table.limits.settling_time_s * SOON < 0.9


def test_balls_far_from_where_they_balance_are_followed() -> None:
    """Their way may lead them past more than what counts as settled; without drag they swing, and may go farther."""
    found = design("swing-arm-grinder")
    scene = scene_of_member(found, Member("bunched", found.case.drag, 0.0, math.pi))
    good = outcome(found, scene.imbalance)
    assert harmless_way(found, scene, complex(scene.imbalance), lambda creep: good) is None
    near = complex(-0.25 * found.autobalancer.requirement.effective_mass * found.case.race_eccentricity)
    swinging = replace(found, case=replace(found.case, friction_arm=0.0))
    assert harmless_way(found, scene, near, lambda creep: good) is not None
    assert harmless_way(swinging, scene, near, lambda creep: good) is None


def test_only_balls_that_nothing_holds_linger() -> None:
    found = design("swing-arm-grinder")  # gravity shakes them
    scene = scene_of_member(found, Member("bunched", found.case.drag, 0.0, math.pi))
    balanced = found.autobalancer.requirement.effective_mass * found.case.race_eccentricity
    assert linger(found, scene, outcome(found, 0.0)) and not linger(found, scene, outcome(found, balanced))
    machine = found.case.table.machine.model_copy(update={"spindle_axis": "vertical"})
    table = found.case.table.model_copy(update={"machine": machine})
    assert not linger(replace(found, case=replace(found.case, table=table)), scene, outcome(found, 0.0))


def test_a_run_that_ends_early_on_a_harmless_way_gives_the_verdict_of_the_whole() -> None:
    """The bunched start of the arm's machine, its race opposite: half the run, the same settling time within 2 %."""
    found = design("swing-arm-grinder")
    member = Member("bunched", found.case.drag, 0.0, math.pi)
    early, whole = (start_once(found, member, 0.01, TOLERANCE, early_end=end) for end in (True, False))
    assert isinstance(early, StartOutcome) and isinstance(whole, StartOutcome)
    assert early.work < 0.6 * whole.work and early.balanced and whole.balanced
    assert early.settling_time_or_inf == pytest.approx(whole.settling_time_or_inf, rel=0.02)
    assert early.loudest < found.case.level_limit and whole.level < found.case.level_limit
