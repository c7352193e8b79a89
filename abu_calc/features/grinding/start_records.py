"""Outcomes of the start cases of grinding as results hold them, and the mark of a level that is a lower bound."""

from typing import Annotated, Self

from abu_calc.features.grinding.outcomes import GrindingOutcomes
from abu_calc.foundation.quantity import Quantity, Record, record


@record
class LoadedOutcomeGroup(Record):
    """Start cases of one way of pressing that end with the same motion under load.

    `share`: of the start cases of that way of pressing, those without an answer included. Levels: the median, the
    lowest and the highest of the group.
    """

    pressed: Annotated[
        str, Quantity("pressed", "", 4, "settled: after the balls settled at idle, as one works; or at once")
    ]
    state: Annotated[
        str,
        Quantity("motion", "", 4, "balanced, held by friction, not balanced, swinging, stalled or bouncing"),
    ]
    count: Annotated[int, Quantity("start cases")]
    total: Annotated[int, Quantity("start cases of that way of pressing")]
    share: Annotated[float, Quantity("share", "", 3, "", percent=True)]
    level_db: Annotated[float, Quantity("level, median", "L")]
    lowest_db: Annotated[float, Quantity("lowest level", "L")]
    highest_db: Annotated[float, Quantity("highest level", "L")]
    apart: Annotated[float, Quantity("share of the time without contact, at most", "", 3, "", percent=True)]
    steady: Annotated[bool, Quantity("levels no longer change")]
    loudest_start: Annotated[str, Quantity("loudest start case")]


@record
class LoadedStarts(Record):
    """The start cases of grinding: how many there are, how many gave no answer, the highest level, and the outcomes."""

    count: Annotated[int, Quantity("start cases")]
    without_answer: Annotated[int, Quantity("without an answer")]
    worst_db: Annotated[float | None, Quantity("highest level", "L")]
    outcomes: tuple[LoadedOutcomeGroup, ...]

    @classmethod
    def of(cls, loads: GrindingOutcomes | None) -> Self | None:
        """None for a machine whose contact does not press in the plane of the wheel."""
        if loads is None:
            return None
        outcomes = tuple(map(LoadedOutcomeGroup.read, loads.groups))
        return cls.read(loads, count=loads.ensemble.count, without_answer=len(loads.lost), outcomes=outcomes)


@record
class LevelBound(Record):
    """Mark of a level under load that is a lower bound: what sets it in the model, and what the model lacks."""

    lower_bound: Annotated[bool, Quantity("the level is a lower bound")]
    total_m_per_s2: Annotated[float | None, Quantity("weighted vibration total of the level", "a_hv", 3)]
    set_by: Annotated[tuple[str, ...], Quantity("set by")]
    lacks: Annotated[tuple[str, ...], Quantity("the model lacks")]
