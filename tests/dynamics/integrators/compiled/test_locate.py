"""Which watched numbers are looked at within a step: those left alone would have told nothing."""

import numpy as np
import pytest

from abu_calc.dynamics.effects.ball_contact import BallContactEffect
from abu_calc.dynamics.effects.dry_rolling_friction import DryRollingFrictionEffect
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.effects.race_eccentricity import RaceEccentricityEffect
from abu_calc.dynamics.effects.run_up import RunUpEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.integrators.compiled import locate, run
from abu_calc.dynamics.integrators.compiled.arrays import (
    BALLS,
    COUNTS,
    FRICTION,
    ORDER,
    SEEN,
    VALUES,
    WATCHED,
    Integers,
    IntegrationStep,
    Reals,
    Watch,
)
from abu_calc.dynamics.integrators.compiled.locate import CHECKS
from abu_calc.dynamics.scene import Scene
from abu_calc.dynamics.trajectory import Trajectory
from tests.dynamics.random_scenes import random_scene
from tests.dynamics.scenes import scene_on

FRICTION_, MEETING = DryRollingFrictionEffect(0.002, 0.1), BallContactEffect(0.1, 0.5)

SCENES = {
    "friction": scene_on("planar", FRICTION_),
    "from standstill": scene_on("planar", RunUpEffect(12.0), GravityEffect(0.3), FRICTION_),
    "contact": scene_on("hand", MEETING),
    "friction and contact": scene_on("planar", GravityEffect(0.3), MEETING, FRICTION_),
    "on an arm": scene_on("swing arm", MEETING, FRICTION_),
    "eccentric": scene_on("tilting", RaceEccentricityEffect(0.05, 0.3), MEETING, FRICTION_),
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


@pytest.mark.few(2)
@pytest.mark.parametrize("name", SCENES)
def test_looking_at_all_numbers_finds_the_same_events(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With more evaluations."""
    found, every = both(SCENES[name], monkeypatch)
    assert found.events and found.evaluations < every.evaluations


@pytest.mark.few(1)
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


STEP = IntegrationStep(0.0, 1.0, 1, *([0.0] for _ in range(6)))
"""A step from 0 to 1, of whose motion nothing is asked."""


@pytest.mark.parametrize("lowest", [0.02, 0.1, 0.3, 0.5, 0.9, 1.1, 1.7, 1.95])
@pytest.mark.parametrize("check", [2, 3, 4])
def test_a_dip_anywhere_within_two_quarters_is_found(
    check: int, lowest: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """(u − lowest)² less a hair, u in quarters: it falls where it is first zero, also right after the first look."""
    depth = 1e-6

    def value(x: float) -> float:
        return (CHECKS * x - (check - 2) - lowest) ** 2 - depth

    def peeked(index: int, x: float, step: IntegrationStep, watch: Watch) -> float:
        watch.w[index] = value(x)
        return value(x)

    monkeypatch.setattr(locate, "peek", peeked)
    lay: Integers = [0] * 40
    lay[VALUES], lay[ORDER] = 1, 30
    rows = [value(quarter / CHECKS) for quarter in range(CHECKS + 1)]
    assert min(rows[check - 2 : check + 1]) > 0
    found = locate.dips(1, check, STEP, Watch(lay, [0] * COUNTS, [0.0], [0.0], rows))
    assert found == pytest.approx((check - 2 + lowest - depth**0.5) / CHECKS, abs=1e-12)


@pytest.mark.parametrize("lowest", [-0.5, -0.01, 2.01, 3.0])
def test_no_dip_is_looked_for_outside(lowest: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A parabola that only rises or only falls between the looks costs no look."""
    monkeypatch.setattr(locate, "peek", lambda *_: pytest.fail("looked at"))
    lay: Integers = [0] * 40
    lay[VALUES], lay[ORDER] = 1, 30
    rows = [(quarter - lowest) ** 2 - 1e-6 for quarter in range(CHECKS + 1)]
    assert locate.dips(1, 2, STEP, Watch(lay, [0] * COUNTS, [0.0], [0.0], rows)) == locate.NEVER


def test_balls_that_graze_each_other_at_the_start_of_a_step() -> None:
    """A ball that has just been hit falls back on the next for a share of a step: long steps see it like short ones."""
    equations = assemble(random_scene(212))
    end = [equations.scene.duration]
    long, short = (run.integrate(equations, tolerance, end, method="dop853") for tolerance in (1e-7, 1e-11))
    assert long.events == short.events
    assert long.y == pytest.approx(short.y, abs=1e-6)
