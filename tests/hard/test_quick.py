"""A dozen of the hard cases, quick ones, in every run; the whole suite is `pytest -m hard`."""

from collections.abc import Callable
from functools import partial
from typing import Final

import pytest

from tests.hard import test_arm as arm
from tests.hard import test_balls as balls
from tests.hard import test_contact as contact
from tests.hard import test_extremes as extremes
from tests.hard import test_resonance as resonance

QUICK: Final[dict[str, Callable[[], None]]] = {
    "at resonance": partial(resonance.test_at_resonance_nothing_is_balanced, 1.0),
    "undamped resonance": resonance.test_growth_at_an_undamped_resonance,
    "between two resonances": partial(resonance.test_between_two_natural_frequencies, 460.0, True),
    "a ball that hangs": partial(resonance.test_a_ball_hangs_at_the_natural_frequency, 1.0, True),
    "all balls stuck": partial(balls.test_dry_friction_from_a_trace_to_a_brake, 1e-2),
    "balls from one place": partial(balls.test_balls_from_exactly_one_place, 3),
    "balls that overlap": balls.test_balls_that_overlap_or_fill_their_race,
    "too little capacity": partial(balls.test_too_little_capacity, 1.5),
    "a stiff contact": partial(contact.test_contact_stiffness, 7),
    "balls bounce to rest": partial(contact.test_balls_bounce_to_rest, 0.5),
    "an arm pushed away": arm.test_work_that_pushes_the_arm_away,
    "10 g at 300 000 rpm": partial(extremes.test_the_size_of_a_machine_does_not_matter, 0.01, 3e5),
}


@pytest.mark.few(2)
@pytest.mark.parametrize("case", QUICK.values(), ids=QUICK)
def test_quick(case: Callable[[], None]) -> None:
    """As the hard suite has it."""
    case()
