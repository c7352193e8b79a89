"""Layout of the loop's arrays: no two things in one place."""

import pytest

from abu_calc.dynamics.integrators.compiled import arrays
from abu_calc.dynamics.integrators.compiled.program import EQUATIONS

GROUPS = {
    "layout": (
        "STATES BALLS RATES WATCHED VALUES MODES PUSH NUMBERS FRICTION PULLS DIRECTION SIDE GAPS PAIRS TURNS TOUCHING "
        "LEAST JOINED ONE_SIDED TOUCHES APPARENT SEEN ORDER BEHIND"
    ),
    "constants": "LONGEST END REST SLOW RESTITUTION KICK STALLED UNIT LIFTED SCALES",
    "clock": "TIME STEP BEGUN",
    "counts": "DONE STEPS EVALUATIONS EVENTS FOUND STALLS MOST SAMPLES GENERAL START PAUSE",
    "returns": "REACHED UNDECIDED TOO_MUCH NOT_FINITE TOO_SMALL STALL PAUSED",
}


@pytest.mark.parametrize("group", GROUPS)
def test_places_of_a_group_are_numbered_through(group: str) -> None:
    places = [getattr(arrays, name) for name in GROUPS[group].split()]
    assert sorted(places) == list(range(len(places)))


def test_every_place_belongs_to_a_group() -> None:
    """BEHIND and SCALES are the last of theirs, for rows of unknown length begin there."""
    named = {name for group in GROUPS.values() for name in group.split()}
    assert {name for name, value in vars(arrays).items() if name.isupper() and isinstance(value, int)} == {
        *named, "COUNTS",
    }  # fmt: skip
    assert len(GROUPS["counts"].split()) == arrays.COUNTS
    assert len(GROUPS["layout"].split()) - 1 == arrays.BEHIND and len(GROUPS["constants"].split()) - 1 == arrays.SCALES


@pytest.mark.parametrize("name", EQUATIONS)
def test_equations_of_no_scene_are_never_taken_for_zero(name: str) -> None:
    function = getattr(arrays, name)
    with pytest.raises(NotImplementedError):
        function(*[0.0] * function.__code__.co_argcount)
