"""Five hundred scenes at random: each is answered, or refused with its reason; two integrators agree on the answers."""

import math
from dataclasses import dataclass, fields

import numpy as np
import pytest

from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.simulation.response import Response
from abu_calc.simulation.simulate import Simulation, difference, simulate
from tests.dynamics.random_scenes import random_scene

ACCURACY = 0.01
MOST_EVALUATIONS = 300_000
"""Of one simulation, all its runs together; tens of seconds."""

CHEAP = (2, 3, 5, 7, 11, 12, 14, 15, 17, 19, 23, 28, 31, 33, 36, 39, 42, 46, 55, 58, 68, 92, 101, 108, 112)
"""Seeds of scenes that are answered in a fraction of a second: chosen for that, so they say nothing of how many are."""


BOUNCING = (20, 65, 182, 221, 340, 354, 408)
"""Seeds of scenes whose balls meet and part by next to nothing, change sides, or are pressed together by others."""

RUNAWAYS = {81: "runs away", 130: "climbs out of its groove", 210: "runs away", 263: "has turned right round"}
"""Seeds of scenes that nothing can answer, and why."""


def by_hand(seeds, few):
    """The first of them for slow runs, the others by hand."""
    marks = [pytest.mark.slow] * few + [pytest.mark.hard] * (len(seeds) - few)
    return [pytest.param(seed, marks=mark) for seed, mark in zip(seeds, marks, strict=True)]


@dataclass(frozen=True)
class Outcome:
    """What became of a scene: an answer or a reason."""

    simulation: Simulation | None
    reason: str


def outcome(seed: int, integrator: str) -> Outcome:
    """Simulate; anything but an answer or NotTrustworthyError passes on and fails the test."""
    try:
        return Outcome(
            simulate(random_scene(seed), ACCURACY, most_evaluations=MOST_EVALUATIONS, integrator=integrator), ""
        )
    except NotTrustworthyError as error:
        return Outcome(None, str(error))


def check_answer(simulation: Simulation) -> None:
    """Every number is one, and what is claimed is what was asked for."""
    assert np.isfinite(simulation.trajectory.y).all()
    assert simulation.error_estimate <= ACCURACY
    numbers: list[float] = []
    for part in (simulation.response, simulation.response.final):
        for field in fields(part):
            value = getattr(part, field.name)
            numbers += value if isinstance(value, tuple) else [value] if isinstance(value, float) else []
    assert all(math.isfinite(number) for number in numbers)
    assert isinstance(simulation.response, Response)


def check_reason(reason: str) -> None:
    """It says what, and what to do about it."""
    assert len(reason.splitlines()) > 1
    assert len(reason) > 40


def test_a_seed_is_a_scene():
    assert random_scene(7) == random_scene(7)
    scenes = [random_scene(seed) for seed in range(60)]
    assert len({scene.name.rstrip("0123456789") for scene in scenes}) == 4
    assert len({effect.name for scene in scenes for effect in scene.effects}) == 8
    for scene in scenes:
        assert len(assemble(scene).initial) == len(assemble(scene).states)


@pytest.mark.few(3)
@pytest.mark.parametrize("seed", CHEAP)
def test_cheap_scenes_are_answered(seed):
    """These are none of the few that may be refused."""
    found = outcome(seed, "scipy")
    assert found.simulation is not None, found.reason
    check_answer(found.simulation)


@pytest.mark.parametrize("seed", by_hand(BOUNCING, 3))
def test_bouncing_balls_come_to_an_end(seed):
    """Thousands of events at most, and an answer."""
    found = outcome(seed, "scipy")
    assert found.simulation is not None, found.reason
    check_answer(found.simulation)


@pytest.mark.parametrize("seed", by_hand(tuple(RUNAWAYS), 3))
def test_what_runs_away_is_refused_for_that(seed):
    """Not because steps become too small."""
    found = outcome(seed, "scipy")
    assert RUNAWAYS[seed] in found.reason
    check_reason(found.reason)


@dataclass(frozen=True)
class Study:
    """Of five hundred scenes: what was refused; where both integrators answered, by how much they differ and may."""

    refused: dict[int, str]
    differences: dict[int, float]
    claims: dict[int, float]

    def beyond(self, allowed: dict[int, float]) -> dict[int, tuple[float, float]]:
        """Scenes whose answers differ by more than allowed."""
        return {seed: (d, allowed[seed]) for seed, d in self.differences.items() if not d <= allowed[seed]}


@pytest.fixture(scope="module")
def study() -> Study:
    """The work of all hard tests."""
    found = Study({}, {}, {})
    for seed in range(500):
        one = outcome(seed, "scipy")
        if one.simulation is None:
            check_reason(one.reason)
            found.refused[seed] = one.reason.splitlines()[0]
            continue
        check_answer(one.simulation)
        other = outcome(seed, "compiled").simulation
        if other is not None:
            check_answer(other)
            found.differences[seed] = difference(one.simulation.scene, one.simulation.response, other.response)
            found.claims[seed] = one.simulation.error_estimate + other.error_estimate
    return found


@pytest.mark.hard
def test_few_scenes_are_refused_and_each_with_its_reason(study):
    """At most 3 %."""
    assert len(study.refused) <= 15, f"{len(study.refused)} of 500: {study.refused}"


@pytest.mark.hard
def test_integrators_agree_within_the_accuracy_asked_for(study):
    assert study.beyond(dict.fromkeys(study.differences, 2 * ACCURACY)) == {}


@pytest.mark.hard
def test_integrators_agree_within_the_errors_they_claim(study):
    """A claim that is broken is a wrong number in the report, though the answer may be as accurate as asked for."""
    assert study.beyond(study.claims) == {}
