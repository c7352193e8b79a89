"""Five hundred scenes at random: each is answered, or refused with its reason; two integrators agree on the answers."""

import math
from collections import Counter
from dataclasses import dataclass, fields

import numpy as np
import pytest

from abu_calc.analysis.response import Response
from abu_calc.analysis.simulate import Simulation, difference, simulate
from abu_calc.dynamics.assemble import assemble
from abu_calc.dynamics.integrators.choice import unfit
from abu_calc.errors import NotTrustworthyError
from tests.dynamics.random_scenes import random_scene

ACCURACY = 0.01
MOST_EVALUATIONS = 200_000
"""Of one simulation, all its runs together; tens of seconds."""

CHEAP = (2, 3, 5, 7, 11, 12, 13, 14, 15, 17, 19, 23, 25, 27, 28, 31, 33, 36, 39, 42, 46, 58, 68, 92, 112)
"""Seeds of scenes that take a fraction of a second."""


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


@pytest.mark.parametrize("seed", CHEAP)
def test_cheap_scenes_are_answered(seed):
    """These are none of the few that may be refused."""
    found = outcome(seed, "scipy")
    assert found.simulation is not None, found.reason
    check_answer(found.simulation)


def agreement(one: Simulation, other: Simulation) -> bool:
    """Whether two answers differ by no more than each is allowed to err."""
    return difference(one.scene, one.response, other.response) <= 2 * ACCURACY


@pytest.mark.hard
def test_every_scene_is_answered_or_refused_with_its_reason():
    """At most 3 % are refused; where heyoka is there, it agrees with SciPy."""
    refused: dict[int, str] = {}
    apart: list[int] = []
    for seed in range(500):
        found = outcome(seed, "scipy")
        if found.simulation is None:
            check_reason(found.reason)
            refused[seed] = found.reason.splitlines()[0]
            continue
        check_answer(found.simulation)
        if unfit(assemble(found.simulation.scene)) is None:
            other = outcome(seed, "heyoka").simulation
            if other is not None and not agreement(found.simulation, other):
                apart.append(seed)
    assert not apart, f"integrators disagree on the scenes {apart}"
    assert len(refused) <= 15, f"{len(refused)} of 500: {Counter(refused.values()).most_common(20)}"
