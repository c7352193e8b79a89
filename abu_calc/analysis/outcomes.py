"""What the starts of one design came to: which are worst, and which decide its checks and have to be confirmed."""

import math
import statistics
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import product
from operator import attrgetter
from typing import Any

from abu_calc.analysis.balanced import SLIPPING, balances
from abu_calc.frozen import dataclass
from abu_calc.scenes.members import Member


@dataclass(frozen=True)
class Outcome:
    """What one start came to. Settling [s] from full speed on, None: never; `residual`: axis amplitude [m].

    `level` [dB] at the loudest place; `slip`: the largest mean speed of a ball against its race over the rotor's.
    """

    member: Member
    settling: float | None
    residual: float
    level: float
    slip: float
    imbalance: float
    allowed: float
    work: int = 0
    confirmed: bool = False
    rise: float = 0.0
    """By how much the level might still have risen [dB] where the run ended early."""
    ball_angles: tuple[float, ...] = ()
    """Of the balls in the rotor at the end [rad]."""
    duration: float = 0.0
    """Of a run [s] that went on for longer than its scene, since the balls were not at rest by then; 0 of others."""

    @property
    def hanging(self) -> bool:
        """Whether balls keep going round behind the rotor."""
        return self.slip > SLIPPING

    @property
    def balanced(self) -> bool:
        """Whether the balls are at rest in their race, and what they leave is allowed [kg m]."""
        return balances(self.imbalance, self.allowed, self.slip)

    @property
    def time(self) -> float:
        """Until it settled where it balances [s]; infinite if never."""
        return self.settling if self.settling is not None and self.balanced else math.inf

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
    """A start that gave no number to be trusted, and why; `work`: the evaluations it was allowed.

    `short`: whether more work would have given one, as far as is known.
    """

    member: Member
    reason: str
    work: int
    short: bool = False


@dataclass(frozen=True)
class Ensemble:
    """All starts of one design; `drag` [1/s]: the one given, which decides what fails."""

    drag: float
    outcomes: tuple[Outcome, ...]
    lost: tuple[Lost, ...]

    @property
    def members(self) -> int:
        """How many starts there are."""
        return len(self.outcomes) + len(self.lost)

    @property
    def work(self) -> int:
        """Evaluations of all of them, in SciPy's."""
        return sum(one.work for one in self.outcomes) + sum(one.work for one in self.lost)

    @property
    def given(self) -> tuple[Outcome, ...]:
        """Those at the drag given."""
        return tuple(one for one in self.outcomes if one.member.drag == self.drag)

    @property
    def rated(self) -> tuple[Outcome, ...]:
        """Those at the rated speed."""
        return tuple(one for one in self.outcomes if one.member.speed is None)

    @property
    def balanced(self) -> int:
        """How many balance."""
        return sum(one.balanced for one in self.outcomes)

    @property
    def hanging(self) -> tuple[Outcome, ...]:
        """Those whose balls hang."""
        return tuple(one for one in self.outcomes if one.hanging)

    @property
    def worst(self) -> Outcome | None:
        """Of all: hanging before not balanced before loud."""
        return max(self.outcomes, key=lambda one: one.badness, default=None)

    def typical(self, values: Iterable[float]) -> float | None:
        """Their median; None where most are infinite."""
        middle = statistics.median(list(values) or [math.inf])
        return middle if math.isfinite(middle) else None


SLACK = 0.3
"""A difference in level [dB] that decides nothing."""

Order = tuple[Callable[[Outcome], Any], float, bool]
"""By what starts are judged, the last of it a number; a difference of that number that decides nothing; and whether a
run that confirms one may end early: its level is that at the very end, when it settled is known before."""

ORDERS: tuple[Order, ...] = (
    (attrgetter("badness"), SLACK, False),
    (lambda one: (one.level,), SLACK, False),
    (lambda one: (one.time,), 0.0, True),
)


def deciding(found: Sequence[Outcome | Lost], drag: float) -> dict[int, bool]:
    """Which are worst, among those at the drag given and among all, and not confirmed, nor as bad as one that is.

    And those that might have become the loudest. With whether the run that confirms it may end early.
    """
    done = [(k, one) for k, one in enumerate(found) if isinstance(one, Outcome)]
    groups = [group for group in (done, [(k, one) for k, one in done if one.member.drag == drag]) if group]
    undecided: dict[int, bool] = {}
    for group in groups:
        most = max(one.level for _, one in group)
        # Half of it: what is near would be asked for next, by itself.
        undecided.update((k, False) for k, one in group if one.loudest > most + SLACK / 2)
    for (order, slack, early_end), group in product(ORDERS, groups):
        k, worst = max(group, key=lambda pair: order(pair[1]))
        *kind, value = order(worst)
        confirmed = [order(one) for _, one in group if one.confirmed]
        if not any([*same] == kind and (near == value or near >= value - slack) for *same, near in confirmed):
            undecided.setdefault(k, early_end)
    return undecided


def worse(loose: Outcome | Lost, tight: Outcome | Lost) -> Outcome | Lost:
    """The tighter of two runs of a start; where they end differently the worse: less than any error decides there."""
    if isinstance(loose, Lost) or isinstance(tight, Lost):
        return tight if isinstance(tight, Lost) else loose
    if (loose.hanging, loose.balanced) == (tight.hanging, tight.balanced):
        return replace(tight, confirmed=True)
    return replace(max(loose, tight, key=lambda one: one.badness), confirmed=True)
