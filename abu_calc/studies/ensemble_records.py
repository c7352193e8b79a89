"""Results of many start cases of one design, as results hold them."""

from collections.abc import Callable
from operator import attrgetter
from typing import Annotated, Self

from abu_calc.analysis.outcomes import Ensemble, Outcome
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.simulated_scene import finite
from abu_calc.units import from_si


@record
class Spread(Record):
    """The median over all starts at the rated speed, and the worst of all; None where a start never gets there."""

    typical: Annotated[float | None, Quantity("typical")]
    worst: Annotated[float | None, Quantity("worst")]

    @classmethod
    def of(cls, ensemble: Ensemble, value: Callable[[Outcome], float]) -> Self:
        """Spread of one number over all start cases."""
        worst = max(map(value, ensemble.outcomes), default=None)
        return cls(typical=ensemble.typical(map(value, ensemble.rated)), worst=finite(worst))


@record
class WorstMember(Record):
    """The start that ended worst: with balls that hang, not balanced, or the loudest; no speed: the rated one."""

    start: Annotated[str, Quantity("start")]
    drag_per_s: Annotated[float, Quantity("drag", "h₀", 3)]
    run_up_s: Annotated[float | None, Quantity("run-up", "", 3)]
    speed_rpm: Annotated[float | None, Quantity("speed", "", 6)]
    race_centre_deg: Annotated[float, Quantity("centre of the race from the imbalance", "", 3)]

    @classmethod
    def of(cls, worst: Outcome) -> Self:
        """A start at full speed has no run-up."""
        speed = None if worst.member.speed is None else from_si(worst.member.speed, "rpm")
        return cls(
            start=worst.member.way, drag_per_s=worst.member.drag, run_up_s=worst.member.run_up or None, speed_rpm=speed,
            race_centre_deg=worst.member.race_centre_deg,
        )  # fmt: skip


@record
class SettlingOfStart(Record):
    """Settling time of one kind of start at one drag, from full speed: with the race off to the slower side.

    `race_centre_deg`: that side, the angle of the race's centre from the imbalance. None: it never settles.
    """

    start: Annotated[str, Quantity("start")]
    drag_per_s: Annotated[float, Quantity("drag", "h₀", 3)]
    settling_time_s: Annotated[float | None, Quantity("settling time", "t_s", 3)]
    race_centre_deg: Annotated[float, Quantity("centre of the race from the imbalance", "", 3)]

    @classmethod
    def all_of(cls, ensemble: Ensemble) -> tuple[Self, ...]:
        """Each kind of start at each drag, in the order in which they ran."""
        slowest: dict[tuple[str, float], Outcome] = {}
        for outcome in ensemble.outcomes:
            key = outcome.member.name, outcome.member.drag
            slowest[key] = max(slowest.get(key, outcome), outcome, key=attrgetter("time"))
        return tuple(
            cls(
                start=start, drag_per_s=drag, settling_time_s=finite(outcome.time),
                race_centre_deg=outcome.member.race_centre_deg,
            )
            for (start, drag), outcome in slowest.items()
        )  # fmt: skip


@record
class EnsembleResult(Record):
    """The idle machine switched on in many ways: starts, run-ups, and the drag of oil that is hot, as meant, cold."""

    members: Annotated[int, Quantity("starts")]
    balanced: Annotated[int, Quantity("that balance")]
    hanging: Annotated[int, Quantity("that leave balls hanging")]
    settling_time_s: Annotated[Spread, Quantity("settling time", "t_s")]
    level_db: Annotated[Spread, Quantity("level", "L")]
    residual_um: Annotated[Spread, Quantity("residual", "w")]
    worst_member: Annotated[WorstMember | None, Quantity("worst start")]
    settling_by_start: tuple[SettlingOfStart, ...]

    @classmethod
    def of(cls, ensemble: Ensemble) -> Self:
        """Record in user units."""
        return cls(
            members=ensemble.members,
            balanced=ensemble.balanced,
            hanging=len(ensemble.hanging),
            settling_time_s=Spread.of(ensemble, lambda outcome: outcome.time),
            level_db=Spread.of(ensemble, lambda outcome: outcome.level),
            residual_um=Spread.of(ensemble, lambda outcome: from_si(outcome.residual, "um")),
            worst_member=None if ensemble.worst is None else WorstMember.of(ensemble.worst),
            settling_by_start=SettlingOfStart.all_of(ensemble),
        )
