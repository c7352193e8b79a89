"""Outcomes of the start cases of one design: the worst, and those to be confirmed because they decide checks."""

import math
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import product
from operator import attrgetter
from typing import Any, Final

from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.bearing_file import Limits
from abu_calc.simulation.residual_criteria import SLIPPING, balances
from abu_calc.simulation.start_cases import Member
from abu_calc.sizing.vibration import LEVEL_ERROR


@dataclass(frozen=True)
class StartOutcome:
    """Outcome of one start case.

    `quiet_time`, `rest_time` and `settling_time` [s] from full speed on, None: never; `creeping`: balls still drift at
    the end; `residual`: axis amplitude [m]; `level` [dB] at the loudest place; `slip`: the largest mean speed of a ball
    against its race over the rotor's. Of several races the largest displacement counts, and `imbalance`, `allowed` and
    `moved` are those of the race that is farthest from balancing.
    """

    member: Member
    settling_time: float | None
    quiet_time: float | None
    rest_time: float | None
    creeping: bool
    residual: float
    level: float
    slip: float
    imbalance: float
    allowed: float
    work: int = 0
    confirmed: bool = False
    rise: float = 0.0
    """Possible further rise of the level [dB] if the run ended early."""
    ball_angles: tuple[float, ...] = ()
    """Angles of the balls in the rotor at the end [rad]."""
    duration: float = 0.0
    """Duration [s] of a run that went on longer than its scene, since the balls were not at rest by then; else 0."""
    velocity: float = 0.0
    """Rms velocity [m/s] of the axis at the end, at the race."""
    moved: float = math.inf
    """Imbalance [kg m] at the race without balls."""
    displacements: tuple[float, ...] = ()
    """Displacement 0–peak [m] of each place on a spindle with several races."""

    @property
    def hanging(self) -> bool:
        """True if balls stall: they keep turning more slowly than the rotor."""
        return self.slip > SLIPPING

    @property
    def balanced(self) -> bool:
        """True if the balls are at rest in their race and the imbalance left is allowed [kg m]."""
        return balances(self.imbalance, self.allowed, self.slip)

    @property
    def settling_time_or_inf(self) -> float:
        """Until it settled where it balances [s]; infinite if never."""
        return self.settling_time if self.settling_time is not None and self.balanced else math.inf

    @property
    def quiet_time_or_inf(self) -> float:
        """From when it is quiet [s]; infinite if never."""
        return math.inf if self.quiet_time is None else self.quiet_time

    @property
    def rest_time_or_inf(self) -> float:
        """From when the balls rest [s]; infinite if never."""
        return math.inf if self.rest_time is None else self.rest_time

    def in_time(self, limits: Limits) -> bool:
        """True if it is quiet in time, and at rest, if the file limits that."""
        rests = limits.rest_time_s is None or self.rest_time_or_inf <= limits.rest_time_s
        return self.quiet_time_or_inf <= limits.longest_quiet_time and rests

    def holds(self, limits: Limits, level: float) -> bool:
        """True if it balances, in time, and at most at a level [dB]."""
        return self.balanced and self.in_time(limits) and self.level <= level

    @property
    def loudest(self) -> float:
        """The level it might have risen to [dB]."""
        return self.level + self.rise

    @property
    def badness(self) -> tuple[bool, bool, float]:
        """Sorts the worst last."""
        return self.hanging, not self.balanced, self.level


@dataclass(frozen=True)
class Lost:
    """A start, of whatever kind, that gave no number to be trusted, and why; `work`: the evaluations it was allowed.

    `short`: whether more work would have given one, as far as is known.
    """

    member: Any
    reason: str
    work: int = 0
    short: bool = False


@dataclass(frozen=True)
class Ensemble:
    """All starts of one design; `drag` [1/s]: the one given, which decides what fails."""

    drag: float
    outcomes: tuple[StartOutcome, ...]
    lost: tuple[Lost, ...]
    temperatures: tuple[float, float, float] | None = None
    """Of the oil [°C] at work, hot and cold; None: the drag rates are given, not those of an oil."""

    @property
    def members(self) -> int:
        """Number of start cases."""
        return len(self.outcomes) + len(self.lost)

    @property
    def work(self) -> int:
        """Work of all of them."""
        return sum(outcome.work for outcome in self.outcomes) + sum(lost.work for lost in self.lost)

    @property
    def given(self) -> tuple[StartOutcome, ...]:
        """Outcomes at the given drag rate."""
        return tuple(outcome for outcome in self.outcomes if outcome.member.drag == self.drag)

    @property
    def rated(self) -> tuple[StartOutcome, ...]:
        """Outcomes at the rated speed."""
        return tuple(outcome for outcome in self.outcomes if outcome.member.speed is None)

    @property
    def balanced(self) -> int:
        """Number of start cases that balance."""
        return sum(outcome.balanced for outcome in self.outcomes)

    @property
    def hanging(self) -> tuple[StartOutcome, ...]:
        """Outcomes in which balls stall."""
        return tuple(outcome for outcome in self.outcomes if outcome.hanging)

    @property
    def worst(self) -> StartOutcome | None:
        """Worst outcome: stalled ranks before not balanced, and not balanced before loud."""
        return max(self.outcomes, key=lambda outcome: outcome.badness, default=None)

    def typical(self, values: Iterable[float]) -> float | None:
        """Median of the values; None if most are infinite."""
        middle = statistics.median(list(values) or [math.inf])
        return middle if math.isfinite(middle) else None


SLACK: Final = LEVEL_ERROR
"""A difference in level [dB] that decides nothing."""

Order = tuple[Callable[[StartOutcome], Any], float, bool]
"""Criterion that ranks start cases, its insignificant difference, and whether early end is allowed.

The criterion ends in a number; a smaller difference of that number decides nothing. The last item
applies to the confirming run: the level is that at the very end, the settling time is known earlier.
"""

ORDERS: tuple[Order, ...] = (
    (attrgetter("badness"), SLACK, False),
    (lambda outcome: (outcome.level,), SLACK, False),
    (lambda outcome: (outcome.quiet_time_or_inf,), 0.0, True),
)


def deciding(results: Sequence[StartOutcome | Lost], drag: float) -> dict[int, bool]:
    """Outcomes to confirm: the worst ones that are neither confirmed nor as bad as a confirmed one.

    The worst are found at the given drag rate and among all. Outcomes that might have become the loudest
    are included. The value tells whether the confirming run may end early.
    """
    done = [(k, outcome) for k, outcome in enumerate(results) if isinstance(outcome, StartOutcome)]
    groups = [group for group in (done, [(k, outcome) for k, outcome in done if outcome.member.drag == drag]) if group]
    undecided: dict[int, bool] = {}
    for group in groups:
        most = max(outcome.level for _, outcome in group)
        # Half of it: what is near would be asked for next, by itself.
        undecided.update((k, False) for k, outcome in group if outcome.loudest > most + SLACK / 2)
    for (order, slack, early_end), group in product(ORDERS, groups):
        k, worst = max(group, key=lambda pair: order(pair[1]))
        *kind, value = order(worst)
        confirmed = [order(outcome) for _, outcome in group if outcome.confirmed]
        if not any([*same] == kind and (near == value or near >= value - slack) for *same, near in confirmed):
            undecided.setdefault(k, early_end)
    return undecided


def worse(loose: StartOutcome | Lost, tight: StartOutcome | Lost) -> StartOutcome | Lost:
    """The tighter of two runs of a start; where they end differently the worse: less than any error decides there."""
    if isinstance(loose, Lost) or isinstance(tight, Lost):
        return tight if isinstance(tight, Lost) else loose
    if (loose.hanging, loose.balanced) == (tight.hanging, tight.balanced):
        return replace(tight, confirmed=True)
    return replace(max(loose, tight, key=lambda outcome: outcome.badness), confirmed=True)
