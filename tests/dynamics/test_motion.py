"""Loads that effects add or own.

Sums over chains of joined balls against sums written out, for any rings and gaps.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from abu_calc.dynamics.motion import Across, Chains, Levers, Loads
from abu_calc.foundation.errors import InputError


def test_forces_add_and_owned_slots_have_one_owner():
    loads = Loads()
    loads.add(pull=1.0, frame=2.0)
    loads.add(pull=0.5)
    assert (loads.pull, loads.press, loads.frame) == (1.5, None, 2.0)
    for slot in ("grip", "free", "hold", "mates", "leads", "across", "bound"):
        loads.own(**{slot: np.zeros(2)})
        with pytest.raises(InputError, match=slot):
            loads.own(**{slot: np.zeros(2)})


def test_what_carries_races_adds_up() -> None:
    levers = Levers(np.zeros((2, 1)), np.zeros((2, 1)), None)
    assert levers.carried_along is None
    for _ in range(2):
        levers.carry(np.array([1.5]), np.array([-0.5]))
    assert (levers.carried_along.tolist(), levers.carried_outward.tolist()) == ([3.0], [-1.0])


def test_a_second_direction_gives_way_by_its_inertia_unless_it_is_held() -> None:
    across = Across(np.zeros((2, 2)), np.array([2.0, 4.0]), np.zeros(2), np.zeros(2))
    assert across.give.tolist() == [0.5, 0.25]
    across.free = np.array([1.0, 0.0])
    assert across.give.tolist() == [0.5, 0.0]


@st.composite
def chains(draw: st.DrawFn) -> tuple[Chains, np.ndarray]:
    """Up to three rings, none of whose gaps are all joined; beside them a ball without any."""
    sizes = draw(st.lists(st.integers(2, 6), min_size=1, max_size=3))
    balls = draw(st.permutations(range(sum(sizes) + 1)))
    rings, joined, first = [], [], 0
    for size in sizes:
        rings.append(tuple(balls[first : first + size]))
        gaps = draw(st.lists(st.sampled_from((0.0, 1.0)), min_size=size, max_size=size).filter(lambda one: 0.0 in one))
        joined += gaps
        first += size
    return Chains(tuple(rings), np.array(joined)), np.array([2.0**k for k in range(len(balls))])


def behind(ring: tuple[int, ...], gaps: list[float], ball: int) -> list[int]:
    """The balls of its chain behind one, and itself."""
    found, place = [ball], ring.index(ball)
    while gaps[place - 1]:
        place = (place - 1) % len(ring)
        found.append(ring[place])
    return found


@given(chains())
@pytest.mark.slow
def test_sums_are_those_of_the_chains(case: tuple[Chains, np.ndarray]) -> None:
    """Exactly: powers of two."""
    mates, x = case
    expected = {"behind": x.copy(), "ahead": x.copy(), "sums": x.copy()}
    first = 0
    for ring in mates.rings:
        gaps = mates.joined[first : first + len(ring)].tolist()
        turned = [*gaps[-2::-1], gaps[-1]]
        for ball in ring:
            before, after = behind(ring, gaps, ball), behind(ring[::-1], turned, ball)
            expected["behind"][ball], expected["ahead"][ball] = x[before].sum(), x[after].sum()
            expected["sums"][ball] = x[[*before, *after[1:]]].sum()
        first += len(ring)
    for name, sums in expected.items():
        assert getattr(mates, name)(x).tolist() == sums.tolist()


def test_what_is_not_joined_adds_nothing() -> None:
    """Not even rounding: a sum is the ball's own then."""
    x = np.array([0.1, 1e17, -1e17, 0.3])
    assert Chains(((0, 1, 2, 3),), np.zeros(4)).sums(x).tolist() == x.tolist()
