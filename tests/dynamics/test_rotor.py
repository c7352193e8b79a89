"""Ways in which a rotor turns: their states, and what a changing speed does.

A race and its balls: what it refuses, and what the balls weigh.

The numbers that the equations read, from those of a scene.
"""

import math
from dataclasses import replace
from typing import ClassVar

import numpy as np
import pytest

from abu_calc.dynamics.effect import Effect, Kind
from abu_calc.dynamics.effects.gravity import GravityEffect
from abu_calc.dynamics.equations.assemble import assemble
from abu_calc.dynamics.equations.right_hand_side import motion_of
from abu_calc.dynamics.rotor import DRIVEN, GUIDED, STEADY, Race, Rotation, balls_of, most_demanding
from abu_calc.foundation.errors import InputError
from abu_calc.foundation.frozen import dataclass
from tests.dynamics.scenes import ROTORS, SUPPORTS, dimensionless, scene_on


def test_a_torque_asks_for_more_than_a_given_acceleration_and_that_for_more_than_none() -> None:
    assert most_demanding([]) is STEADY
    assert most_demanding([STEADY, GUIDED, STEADY]) is GUIDED
    assert most_demanding([GUIDED, DRIVEN, STEADY]) is most_demanding([DRIVEN, GUIDED]) is DRIVEN


@pytest.mark.parametrize("rotor", [STEADY, GUIDED, DRIVEN], ids=lambda rotor: type(rotor).__name__)
def test_states_of_a_rotor_start_with_its_speed_and_their_rates_are_speed_and_acceleration(rotor: Rotation) -> None:
    start = np.array(rotor.start(3.0))
    assert len(start) == len(rotor.states)
    assert rotor.turning(0.0, start, 3.0) == (0.0, 3.0)
    assert np.concatenate([*rotor.rates(start, 0.7), []]).tolist() == ([3.0, 0.7] if rotor.states else [])


def test_a_steady_rotor_turns_by_speed_times_time() -> None:
    assert STEADY.turning(2.0, np.zeros(0), 3.0) == (6.0, 3.0)


@pytest.mark.parametrize("way", ["guided", "driven"])
def test_a_race_that_speeds_up_carries_its_balls_along(way: str) -> None:
    """A ball's place is accelerated by R_p Ω' along the race: as given, or as one more row of the frame."""
    equations = assemble(scene_on("planar", *ROTORS[way]))
    p, y = equations.parameters, np.array(equations.initial)
    m = motion_of(np, 0.0, y, p)
    m.acceleration = 0.7
    levers = p.geometry.levers(m, p)
    if way == "guided":
        np.testing.assert_allclose(levers.carried_along, 0.7 * p.radii)
        assert levers.along.shape == (2, 5)
    else:
        np.testing.assert_array_equal(levers.along[-1], p.radii)
        assert levers.carried_along is None and not levers.outward[-1].any()


def test_a_torque_turns_a_driven_rotor_alone() -> None:
    assert DRIVEN.on_frame([1.0, 2.0], 3.0).tolist() == [1.0, 2.0, 3.0]
    assert GUIDED.on_frame([1.0, 2.0], 3.0).tolist() == STEADY.on_frame([1.0, 2.0], 3.0).tolist() == [1.0, 2.0]


SCENE = dimensionless(2.0, 0.05, 0.01, 0.01, 0.01, (0.0, 1.0), 10.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -1.0])
@pytest.mark.parametrize("name", ["pitch_radius", "drag", "inertia_factor"])
def test_race_refuses_what_is_no_quantity(name, value):
    with pytest.raises(InputError):
        replace(SCENE.races[0], **{name: value})


@pytest.mark.parametrize(
    "change",
    [
        {"ball_masses": (0.05,)},
        {"ball_masses": (0.05, 0.0)},
        {"start_angles": (0.0, math.nan)},
        {"start_speeds": (0.0, math.inf)},
        {"start_speeds": (0.0,)},
    ],
)
def test_race_refuses_wrong_balls(change):
    with pytest.raises(InputError):
        replace(SCENE.races[0], **change)


def test_all_balls_stand_race_by_race() -> None:
    races = (
        Race(0.8, (0.2, 0.1), 0.7, 1.4, (0.0, 1.0), (0.0, 0.0), 0.4, 0.15),
        Race(0.6, (0.3,), 0.5, 1.5, (2.0,), (0.0,)),
    )
    balls = balls_of(races)
    assert balls.race.tolist() == [0, 0, 1] and balls.radii.tolist() == [0.8, 0.8, 0.6]
    assert balls.factors.tolist() == [1.4, 1.4, 1.5] and balls.places.tolist() == [0.4, 0.4, 0.0]
    assert balls.static_moments.tolist() == pytest.approx([0.16, 0.08, 0.18])
    assert races[0].static_moment == pytest.approx(0.24)
    assert len(balls_of(()).masses) == 0


def test_what_balls_weigh_gives_their_kinetic_energy_in_a_frame_that_moves() -> None:
    """½ vᵀ M v = Σ ½ m |r' + z Θ'|² for balls at the centres of their races."""
    races = (replace(SCENE.races[0], plane_offset=0.4), replace(SCENE.races[0], plane_offset=-0.3))
    balls, v = balls_of(races), np.array((0.3, -0.7, 1.1, 0.2))
    energy = sum(m / 2 * ((v[:2] + z * v[2:]) ** 2).sum() for m, z in zip(balls.masses, balls.places, strict=True))
    assert v @ balls.mass(4) @ v / 2 == pytest.approx(energy, rel=1e-14)
    np.testing.assert_array_equal(balls.mass(2), balls.mass(4)[:2, :2])


@dataclass(frozen=True)
class Branching(Effect):
    """An effect that decides by values."""

    name: ClassVar[str] = "branching"
    kind: ClassVar[Kind] = "driven"
    traceable: ClassVar[bool] = False


def test_numbers_of_balls_are_those_of_their_races() -> None:
    """R_p h₀, 1/J, m/J and (J − 1) r: 0.8·0.7 and 0.6·0.5; 1.4 and 1.5; 0.4·0.15 and 0.5·0.1."""
    p = assemble(scene_on("planar")).parameters
    assert (p.size, p.balls, len(p.effects)) == (2, 5, 0)
    np.testing.assert_allclose(p.drags, [0.56] * 3 + [0.3] * 2)
    np.testing.assert_array_equal(p.braking, -p.drags)
    np.testing.assert_allclose(p.mobilities * p.inertia_factors, 1.0)
    np.testing.assert_allclose(p.reduced_masses, np.array((0.2, 0.05, 0.1, 0.15, 0.25)) / p.inertia_factors)
    np.testing.assert_allclose(p.spins, [0.06] * 3 + [0.05] * 2)


@pytest.mark.parametrize("support", SUPPORTS)
def test_only_a_support_that_turns_its_rotor_has_a_turn_of_its_own(support: str) -> None:
    p = assemble(scene_on(support)).parameters
    carried = p.geometry.turning(np.arange(1.0, 2 * p.size + 1))
    assert (carried is None) == (not SUPPORTS[support].turns) == (p.frame.turning == ())
    assert (p.spin_inertia is None) == (carried is None)


def test_equations_are_traced_if_all_effects_are_plain_arithmetic() -> None:
    for effects, traceable in (((), True), ((GravityEffect(),), True), ((GravityEffect(), Branching()), False)):
        assert assemble(scene_on("planar", *effects)).parameters.traceable is traceable
