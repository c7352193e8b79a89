"""Layout of the compiled loop's arrays, and the names of the traced equations that it calls."""

from collections.abc import MutableSequence
from typing import NamedTuple

Reals = MutableSequence[float]
Integers = MutableSequence[int]


class Run(NamedTuple):
    """The arrays of one run."""

    y: Reals
    """State."""
    numbers: Reals
    """Numbers of the scene, its modes among them."""
    par: Reals
    """Parameters that the equations use, which `setup` computes from the numbers."""
    lay: Integers
    """The layout."""
    con: Reals
    """Constants."""
    clock: Reals
    counts: Integers


class Step(NamedTuple):
    """A step of length `h` from the state `y` of `n` numbers at `t`."""

    t: float
    h: float
    n: int
    y: Reals
    par: Reals
    end: Reals
    """State at the end."""
    k: Reals
    """Rates at the stages, a row each."""
    between: Reals
    """Rows of the dense output."""
    at: Reals
    """Room for a state within the step."""


class Pairs(NamedTuple):
    """Touching pairs of balls that meet."""

    many: int
    matrix: Reals
    """Change of the speeds of all pairs by a unit impulse on each, a row each [1/(kg·m²)]."""
    near: Reals
    """1 for a pair whose speed is to become zero, otherwise 0."""
    speed: Reals
    """Speed at which each opens [rad/s]."""
    right: Reals
    work: Reals
    chosen: Integers
    """Room for the elimination."""


class Watch(NamedTuple):
    """Where the watched numbers of a step are looked up and put."""

    lay: Integers
    counts: Integers
    dy: Reals
    """Room for rates."""
    w: Reals
    """Watched numbers at the place that was looked at last."""
    rows: Reals
    """Watched numbers at the start and at each check, a row each."""


# The layout: where something of this scene is.
STATES, BALLS, RATES, WATCHED, VALUES, MODES, PUSH, NUMBERS = 0, 1, 2, 3, 4, 5, 6, 7
"""Numbers of states, of balls; where the balls' speeds are in the state; numbers watched, and these with the criteria;
where modes and the push are among the numbers, and how many these are."""
FRICTION, PULLS, DIRECTION, SIDE = 8, 9, 10, 11
"""Dry friction: its watched numbers (−1 without), its criteria, and its mode among the numbers."""
GAPS, PAIRS, TURNS, TOUCHING, LEAST, JOINED = 12, 13, 14, 15, 16, 17
"""Ball contact: its watched numbers (−1 without), how many gaps, and its mode among the numbers."""
ONE_SIDED, TOUCHES = 18, 19
"""One-sided contact: its watched number (−1 without) and its mode."""
APPARENT, SEEN, ORDER, BEHIND = 20, 21, 22, 23
"""Places of the numbers that `apparent` gives, of the watched numbers in order, and of neighbours.

APPARENT: from there on, for each watched number, the place of the count of states that it needs and of
these states (−1: it is not given). SEEN: how many numbers are given. ORDER: from there on the given
numbers, then all others. BEHIND: the ball behind each gap, then the ball ahead of each.
"""

# Constants of a run.
LONGEST, END, REST, SLOW, RESTITUTION, KICK, STALLED, UNIT, LIFTED = 0, 1, 2, 3, 4, 5, 6, 7, 8
"""Longest step, end, speed at rest, the balls' slow speed, e, size of a torque, time of a stall, and what counts as no
torque between balls; by how much balls must part for a rebound to be one."""
SCALES = 9
"""Absolute and relative tolerance of each state, then m R_p² of each ball."""

# The clock of a run.
TIME, STEP, BEGUN = 0, 1, 2
"""Time reached, step to try, and time at which the modes were last decided."""

# The counts of a run.
DONE, STEPS, EVALUATIONS, EVENTS, FOUND, STALLS, MOST, SAMPLES, GENERAL, START, PAUSE = 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10
"""Samples filled, steps, evaluations, events, the watched number that fell last, events in a row without progress, most
evaluations, samples asked for, decisions left to Python, 1 where modes have to be decided before the first step, and
the evaluations at which to come back, so that an interrupt is heard."""
COUNTS = 11

REACHED, UNDECIDED, TOO_MUCH, NOT_FINITE, TOO_SMALL, STALL, PAUSED = 0, 1, 2, 3, 4, 5, 6
"""Reasons for which a run returns."""


def setup(numbers: Reals, par: Reals) -> None:
    """Compute the parameters that the equations use from the numbers."""
    raise NotImplementedError


def rates(t: float, y: Reals, par: Reals, dy: Reals) -> None:
    """y'."""
    raise NotImplementedError


def watched(t: float, y: Reals, par: Reals, dy: Reals, w: Reals) -> None:
    """y', what is watched and the criteria of rules."""
    raise NotImplementedError


def apparent(t: float, y: Reals, par: Reals, w: Reals) -> None:
    """Write the watched numbers that the state gives nearly by itself; the others stay."""
    raise NotImplementedError
