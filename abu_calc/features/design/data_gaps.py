"""Assumed values of a machine file, ranked by how far their usual range moves the verdict of its design.

A value counts as assumed if the file leaves it to the default, or gives just that figure. Each end of its usual range
is followed with the balls and the race of the design: levels and checks are calculated, and the start cases
that are slowest today are simulated again.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Annotated, Final, NamedTuple, Self

from abu_calc.features.design.changes import design_with
from abu_calc.foundation import patience
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.inputs.machine import MachineFile
from abu_calc.simulation.ensemble import first_tolerance, run_of_start
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.simulation.records import finite
from abu_calc.sizing.actions import followed, pins
from abu_calc.sizing.balls import sound
from abu_calc.sizing.design import Design
from abu_calc.sizing.vibration import level_of

MOST: Final = 3
"""Assumed values that are listed."""

MOST_WORK: Final = 20_000
"""Evaluations of a start case above which its quiet time at the ends is not simulated."""

SLOWEST: Final = 3
"""Start cases, the slowest of all that are promised, that are simulated at the ends."""

ALIKE_DB, ALIKE_FACTOR = 3.0, 2.0
"""A level that moves by so much and a quiet time that changes by this factor rank alike."""

DRAG: Final = "autobalancer.rolling_drag_per_s"


class UsualRange(NamedTuple):
    """Usual range of a value that is mostly assumed; `assumed`: the figure that stands for one that is not known."""

    assumed: float
    low: float
    high: float
    moves_levels: bool = True
    moves_times: bool = True
    """True if the calculated idle levels, and the quiet times, depend on it."""


RANGES: Final[Mapping[str, UsualRange]] = {
    "autobalancer.race_eccentricity_mm": UsualRange(0.010, 0.005, 0.020),
    "autobalancer.rolling_friction_mm": UsualRange(0.002, 0.0005, 0.005),
    DRAG: UsualRange(15.0, 3.75, 150.0, moves_levels=False),
    "suspension.natural_frequencies_hz": UsualRange(2.5, 1.6, 2.6),
    "suspension.damping_ratios": UsualRange(0.5, 0.25, 0.9),
    "grinding.cutting_coefficient": UsualRange(0.35, 0.3, 0.5, moves_levels=False, moves_times=False),
    "grinding.contact_stiffness_N_per_m": UsualRange(2e5, 2e4, 1e6, moves_levels=False, moves_times=False),
}
"""Usual ranges by engineering practice (unverified). Drag rates are those of the usual oil that changes most from 80 to
5 °C, VG 68: from a quarter to ten times; the springs stand for two hands (ISO 10068:2012)."""


@dataclass(frozen=True)
class RangeEnd:
    """The design at one end of a usual range; levels [dB] and the quiet time [s] of the slowest start case of
    those simulated, infinite: it is never quiet, NaN: that was not simulated.

    `holds`: whether the autobalancer meets every requirement of sizing and level and quiet time their limits.
    """

    level: float
    quiet_time: float
    holds: bool


@record
class DataGap(Record):
    """An assumed value, and the results at both ends of its usual range: balls and race as designed.

    `decides`: at one end alone the design meets every requirement, and level and quiet time keep their limits.
    `quiet_time_s` is the longest of the start cases which are the slowest as the file stands. An end of
    None: it is never quiet. None: it was not simulated.
    """

    key: Annotated[str, Quantity("key")]
    value: Annotated[float, Quantity("assumed value", "", 3)]
    usual_range: Annotated[tuple[float, float], Quantity("usual range", "", 3)]
    decides: Annotated[bool, Quantity("decides the verdict")]
    level_db: Annotated[tuple[float, float], Quantity("expected level at both ends", "L")]
    quiet_time_s: Annotated[
        tuple[float | None, float | None] | None,
        Quantity("quiet time at both ends of the start cases that are slowest now", "t_q", 3),
    ]

    @classmethod
    def of(cls, key: str, usual: UsualRange, ends: tuple[RangeEnd, RangeEnd]) -> Self:
        """Record of both ends."""
        low, high = ends
        low_time, high_time = low.quiet_time, high.quiet_time
        times = None if math.isnan(low_time + high_time) else (finite(low_time), finite(high_time))
        return cls(
            key=key, value=usual.assumed, usual_range=(usual.low, usual.high), decides=low.holds != high.holds,
            level_db=(low.level, high.level),
            quiet_time_s=times,
        )  # fmt: skip

    @property
    def movement(self) -> float:
        """Movement of the result that moves most between the ends: 1 for 3 dB or a factor of 2."""
        low, high = self.level_db
        low_time, high_time = self.quiet_time_s or (None, None)
        ratio = math.log(high_time / low_time) / math.log(ALIKE_FACTOR) if low_time and high_time else 0.0
        return max(abs(high - low) / ALIKE_DB, abs(ratio))


def data_gaps(
    design: Design, ensemble: Ensemble | None, further: Sequence[StartOutcome], accuracy: float
) -> tuple[DataGap, ...]:
    """The three assumed values that most move the verdict, the first one most; none if the balls do not balance.

    `further`: outcomes of start cases beside the ensemble.
    """
    if ensemble is None or not ensemble.given or not design.frequency.balancing_possible:
        return ()
    promised = [*ensemble.given, *(outcome for outcome in further if outcome.member.promised)]
    gaps, slowest = list[DataGap](), sorted(promised, key=lambda outcome: -outcome.quiet_time_or_inf)[:SLOWEST]
    for key, usual in assumed_values(design.case.table):
        if slowest[0].member.on_arm and key.startswith("suspension"):
            continue
        ends = [_end(design, slowest, key, value, accuracy) for value in (usual.low, usual.high)]
        if ends[0] is not None and ends[1] is not None:
            gaps.append(DataGap.of(key, usual, (ends[0], ends[1])))
    moving = (gap for gap in gaps if gap.decides or gap.movement > 0)
    return tuple(sorted(moving, key=lambda gap: (not gap.decides, -gap.movement))[:MOST])


def assumed_values(file: MachineFile) -> Iterator[tuple[str, UsualRange]]:
    """The values of a file that are assumed: left to the default, or just that figure."""
    known = {} if file.identified is None else file.identified.in_force(file.autobalancer)
    for key, usual in RANGES.items():
        table, name = key.split(".")
        if (key == DRAG and file.oil is not None) or (table == "autobalancer" and name in known):
            continue
        value = getattr(getattr(file, table), name, None)
        figures = set(value) if isinstance(value, tuple) else {value}
        if figures == {usual.assumed}:
            yield key, usual


def _end(design: Design, slowest: Sequence[StartOutcome], key: str, value: float, accuracy: float) -> RangeEnd | None:
    """The design with one value replaced; None if the file refuses it."""
    entries = {key: [value, value] if key.startswith("suspension") else value}
    after = followed(design.case, {**entries, **pins(design.autobalancer)})
    if after is None:
        return None
    levels, moves = design.speed_levels, RANGES[key].moves_levels
    level = level_of(after) if moves or levels is None else levels.highest.level_after_db
    if RANGES[key].moves_times:
        times = [quiet_time_with(design, each, entries, accuracy) for each in slowest]
        time = max((each for each in times if not math.isnan(each)), default=math.nan)
    else:
        time = slowest[0].quiet_time_or_inf
    limits = design.case.table.limits
    holds = (
        sound(after.case, after.candidate) and level <= after.case.level_limit and not time > limits.longest_quiet_time
    )
    return RangeEnd(level, time, holds)


def quiet_time_with(design: Design, start: StartOutcome, entries: Mapping[str, object], accuracy: float) -> float:
    """Quiet time [s] of a start case with entries replaced; infinite: never; NaN: not known."""
    other = None if start.work > MOST_WORK or patience.over() else design_with(design, entries)
    if other is None:
        return math.nan
    try:
        member = replace(
            start.member, drag=other.case.drag if start.member.drag == design.case.drag else start.member.drag
        )
        run = run_of_start(other, member, accuracy, first_tolerance(other), early_end=True)
        return run.outcome.quiet_time_or_inf
    except NotTrustworthyError:
        return math.nan
