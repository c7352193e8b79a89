"""Which watched numbers are looked at within a step: those left alone would have told nothing."""

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContact
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFriction
from abu_calc.dynamics.effects.gravity import Gravity
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricity
from abu_calc.dynamics.effects.run_up import RunUp
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import locate, run
from abu_calc.dynamics.integrators.compiled.arrays import BALLS, FRICTION, ORDER, SEEN, WATCHED, Integers, Reals
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from tests.dynamics.random_scenes import random_scene
from tests.dynamics.scenes import scene_on

FRICTION_, MEETING = DryRollingFriction(0.002, 0.1), BallContact(0.1, 0.5)

SCENES = {
    "friction": scene_on("planar", FRICTION_),
    "from standstill": scene_on("planar", RunUp(12.0), Gravity(0.3), FRICTION_),
    "contact": scene_on("hand", MEETING),
    "friction and contact": scene_on("planar", Gravity(0.3), MEETING, FRICTION_),
    "on an arm": scene_on("swing arm", MEETING, FRICTION_),
    "eccentric": scene_on("tilting", RaceEccentricity(0.05, 0.3), MEETING, FRICTION_),
}

SWINGING = (30, 104)
"""Random scenes whose race presses on some balls many times as much as the rotor's speed asks, and lets go of others
within a step."""


def through(scene: Scene) -> Trajectory:
    """The scene in the plain loop, in long steps."""
    times = np.linspace(0, min(scene.duration, 20 * scene.revolution), 17)
    return run.integrate(assemble(scene), 1e-3, times, compiled=False)


def both(scene: Scene, monkeypatch: pytest.MonkeyPatch) -> tuple[Trajectory, Trajectory]:
    """As it is and with all numbers looked at: the same to the last bit."""
    found = through(scene)
    monkeypatch.setattr(locate, "moving", lambda lay, before, after: lay[WATCHED])
    monkeypatch.setattr(run, "_written", {})  # loops of the functions as they were
    every = through(scene)
    assert np.array_equal(found.y, every.y)
    assert (found.events, found.steps) == (every.events, every.steps)
    return found, every


@pytest.mark.parametrize("name", SCENES)
def test_looking_at_all_numbers_finds_the_same_events(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With more evaluations."""
    found, every = both(SCENES[name], monkeypatch)
    assert found.events and found.evaluations < every.evaluations


@pytest.mark.parametrize("seed", SWINGING)
def test_a_race_that_lets_go_within_a_step_is_seen(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """However much it presses on other balls."""
    found, _ = both(random_scene(seed), monkeypatch)
    assert found.events


def looked_at(before: Reals, after: Reals) -> int:
    """By the numbers at both ends, of which the state gives 3 and 0; 4 and 5 are forces of the race."""
    lay: Integers = [0] * 40
    lay[WATCHED], lay[SEEN], lay[ORDER], lay[BALLS], lay[FRICTION] = 6, 2, 30, 2, 0
    lay[30:36] = [3, 0, 1, 2, 4, 5]
    return locate.moving(lay, before, after)


@pytest.mark.parametrize(
    ("before", "after", "many"),
    [
        ([1.0, 1.0, 1.0, 1.0, 1.0, 1.0], [0.2, 1.0, 1.0, -3.0, 1.0, 1.0], 2),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0, 0.9, 1.7], 2),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0, 0.4, 1.0], 6),
        ([1.0, 1.0, 1.0, 1.0, 0.4, 1.0], [1.0, 1.0, 1.0, 1.0, 0.9, 1.0], 6),
        ([1.0, 1.0, 1.0, 1.0, 3.2, 3.2], [1.0, 1.0, 1.0, 1.0, 56.0, 3.2], 6),
        ([1.0, 1.0, 1.0, 1.0, 6.0, 150.0], [1.0, 1.0, 1.0, 1.0, 5.0, 90.0], 6),
        ([1.0, 1.0, 7.0, 1.0, 1.0, 1.0], [1.0, 1.0, 8.0, 1.0, 1.0, 1.0], 6),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 1.0, 1.0, 1.0, float("nan")], 6),
    ],
)
def test_numbers_are_left_alone_that_cannot_fall(before: Reals, after: Reals, many: int) -> None:
    """Those that stay, balls that the race goes on pressing alike; one that moves or is none has all looked at."""
    assert looked_at(before, after) == many
