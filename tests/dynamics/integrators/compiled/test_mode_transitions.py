"""The natural next mode of dry friction: what rolls, what sticks, and to which side."""

from typing import Any

import numpy as np
import pytest

from abu_calc.dynamics.integrators.compiled import arrays
from abu_calc.dynamics.integrators.compiled.mode_transitions import rested, rubbed, switched, together

BALLS, RATES, DIRECTION, SIDE, JOINED = 3, 3, 0, 3, 6
"""A state of three angles and three speeds; modes: directions, sides, and the two gaps ahead of balls 0 and 1."""


def layout(**places: int) -> list[int]:
    """The layout of three balls, with dry friction."""
    lay = [-1] * 40
    for name, place in {"BALLS": BALLS, "RATES": RATES, "DIRECTION": DIRECTION, "SIDE": SIDE, "FRICTION": 0,
                        "PULLS": 9, "STATES": 6, "GAPS": -1, "ONE_SIDED": -1, **places}.items():  # fmt: skip
        lay[getattr(arrays, name)] = place
    lay[arrays.BEHIND : arrays.BEHIND + 4] = [0, 1, 1, 2]
    return lay


def test_balls_that_move_roll_their_way_and_others_rest_exactly() -> None:
    y, numbers, con = np.array((0, 0, 0, 0.5, -0.5, 1e-9)), np.array((0.0, 0.0, 1.0, 1, 1, 1)), [0.0] * 8
    con[arrays.REST] = 1e-6
    rested(y, numbers, layout(), con)
    assert y[RATES:].tolist() == [0.5, -0.5, 0.0] and numbers[:3].tolist() == [1.0, -1.0, 0.0]


@pytest.mark.parametrize(("pull", "direction", "next_direction"), [
    (0.9, 0.0, 0.0), (1.1, 0.0, 1.0), (-1.1, 0.0, -1.0), (-0.9, 0.0, 0.0), (5.0, 1.0, 1.0), (5.0, -1.0, 0.0),
])  # fmt: skip
def test_a_ball_at_rest_starts_where_it_is_pulled_harder_than_friction_holds(
    pull: float, direction: float, next_direction: float
) -> None:
    """One that was to roll the other way than it is accelerated sticks instead; one that moves is left alone."""
    y, numbers = np.array((0, 0, 0, 0.0, 7.0, 0.0)), np.array((direction, -1.0, 0.0, 1, 1, 1))
    w = np.zeros(15)
    w[6:9], w[9], w[12] = 1.0, pull, 1.0  # sides hold; the pull and the most that friction takes
    k = np.array((0, 0, 0, pull, 3.0, 0.0))
    changed = rubbed(y, numbers, layout(), k, w)
    assert (numbers[0], changed) == (next_direction, next_direction != direction) and numbers[1] == -1.0


def test_a_ball_pulled_from_its_side_of_the_race_goes_to_the_other() -> None:
    y, numbers, w = np.array((0, 0, 0, 1.0, 1.0, 1.0)), np.array((1.0, 1, 1, 1, -1, 1)), np.zeros(15)
    w[6:9] = 1.0, -1.0, 1.0
    assert rubbed(y, numbers, layout(), np.zeros(6), w)
    assert numbers[3:6].tolist() == [1, 1, 1]


def test_joined_balls_go_the_way_of_the_last_of_them() -> None:
    y, numbers = np.array((0, 0, 0, 0.0, 0.3, 0.3)), np.array((-1.0, 1, 1, 1, 1, 1, 1.0, 1.0))
    together(y, numbers, layout(GAPS=20, PAIRS=2, JOINED=JOINED))
    assert numbers[:3].tolist() == [-1, -1, -1] and not y[RATES:].any()


def test_work_and_wheel_change_between_touching_and_apart() -> None:
    lay, count, numbers = layout(ONE_SIDED=4, TOUCHES=2, FRICTION=-1), [0] * arrays.COUNTS, np.array((0.0, 0.0, 1.0))
    count[arrays.FOUND] = 4
    nothing: Any = np.zeros(6)
    run = arrays.RunArrays(nothing, numbers, nothing, lay, [0.0] * 8, nothing, count)  # type: ignore[arg-type]
    for touching in (0.0, 1.0):
        assert switched(0.0, run, nothing, nothing)
        assert numbers[2] == touching
    count[arrays.FOUND] = 5  # of an effect whose modes are not known here
    assert not switched(0.0, run, nothing, nothing)


def test_friction_watches_three_numbers_of_each_ball_and_what_follows_is_not_its_own() -> None:
    """Speed, pull and side of three balls are the numbers 4 to 12 from place 4 on; a speed that falls to nothing turns
    the direction round.
    """
    lay, count = layout(FRICTION=4), [0] * arrays.COUNTS
    nothing: Any = np.zeros(6)
    known = []
    for fell in range(16):
        y, numbers = np.array((0, 0, 0, 0.5, 0.5, 0.5)), np.array((1.0, 1.0, 1.0, 1, 1, 1))
        count[arrays.FOUND] = fell
        run = arrays.RunArrays(y, numbers, nothing, lay, [0.0] * 8, nothing, count)  # type: ignore[arg-type]
        known.append(switched(0.0, run, nothing, nothing))
        at_rest = [k == fell - 4 for k in range(3)]
        assert y[RATES:].tolist() == [0.0 if still else 0.5 for still in at_rest]
        assert numbers[:3].tolist() == [-1.0 if still else 1.0 for still in at_rest]
    assert known == [4 <= fell < 13 for fell in range(16)]
