"""Changes of a file that may help start cases to balance, in time and below the level: oil, balls, run-up, damping.

Assumed values of a machine file, ranked by how far their usual range moves the verdict of its design.

A value counts as assumed if the file leaves it to the default, or gives just that figure. Each end of its usual range
is followed with the balls and the race of the design: levels and checks are calculated, and the start cases
that are slowest today are simulated again.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Annotated, Final, NamedTuple, Self

from abu_calc.features.design.band import turned_in_use
from abu_calc.features.design.start_rules import StartFacts
from abu_calc.formulas.suspension import Springs
from abu_calc.foundation import patience
from abu_calc.foundation.errors import AbuError, NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si
from abu_calc.inputs.duty import RunUp
from abu_calc.inputs.machine import MachineFile
from abu_calc.simulation.ensemble import first_tolerance, run_of_start
from abu_calc.simulation.records import finite
from abu_calc.simulation.start_cases import Ensemble, StartOutcome
from abu_calc.sizing import usable
from abu_calc.sizing.actions import followed, pins, with_entries
from abu_calc.sizing.balls import sound
from abu_calc.sizing.design import Design, built
from abu_calc.sizing.oil import FLAT, usual_oils
from abu_calc.sizing.vibration import level_of, truer_races

MOST_OTHERS: Final = 3
"""Runners-up that are tried where a listed start case fails."""
MOST_OILS: Final = (6, 3)
"""Oils of each viscosity index that are tried."""
FASTER, DAMPED = 0.5, 2.0
"""Factors on the time of the run-up and on the damping of the suspension."""
BEFORE: Final = 2
"""Oils that are tried before what leaves the oil as it is."""
BELOW, LEAST = 2 / 3, 0.05
"""Share of the stalling speed to which the rotor is slowed, and least stalling speed, as a share of the rotor's speed.
Slower balls hardly turn.
"""


def design_with(design: Design, entries: Mapping[str, object]) -> Design | None:
    """A design with entries of its file replaced, its balls and race pinned; None if the file refuses them."""
    try:
        table = with_entries(design.case.table, {**entries, **pins(design.autobalancer)})
        return replace(built(design, table), swing_arm=design.swing_arm)
    except (AbuError, ValueError):
        return None


def changes_for_starts(facts: StartFacts, *, loud: bool) -> Iterator[dict[str, object]]:
    """Changes for start cases, each with the balls and the race that it was tried with.

    Another oil, other balls if a listed start case fails, a temporary speed reduction if balls stall, a
    faster run-up if run-ups alone fail, more damping, a truer race; this first if start cases are too `loud`.
    """
    design, ensemble = facts.design, facts.ensemble
    if ensemble is None:
        return
    table = design.case.table
    oils = list(_other_oils(facts))
    truer = list(truer_races(design.case, design.eccentricity.least))
    ways = [*truer, *oils[:BEFORE]] if loud else oils[:BEFORE]
    if not facts.listed_pass:
        others = (runner_up for runner_up, _ in design.choice.runners_up if usable(design.case, runner_up))
        ways += map(pins, islice(others, MOST_OTHERS))
    bad = [start for start in ensemble.given if not start.balanced]
    ways += _pause(design, ensemble)
    if table.run_up and not table.motor and bad and all(start.member.run_up for start in bad):
        ways.append({"run_up.time_s": _rounded(FASTER * table.run_up.time_s)})
    ways += filter(None, [more_damping(design)])
    ways += oils[BEFORE:] if loud else [*oils[BEFORE:], *truer]
    yield from ({**pins(design.autobalancer), **entries} for entries in ways)


def more_damping(design: Design) -> dict[str, object] | None:
    """Entries that double the damping of springs; None for another suspension, and for hands, which nobody sets."""
    dampings = design.case.table.suspension.dampings
    if dampings is None or not isinstance(design.case.suspension, Springs) or turned_in_use(design):
        return None
    return {"suspension.damping_ratios": [float(f"{DAMPED * damping:.6g}") for damping in dampings]}


def _pause(design: Design, ensemble: Ensemble) -> Iterator[dict[str, object]]:
    """Temporary speed reduction that brings stalled balls to rest in their race.

    The rotor is slowed below the speed at which the balls stall, then speeds up again as in a run-up. Above that speed
    the balls go on stalling, the more so the nearer the rotor is to it. None for a motor, which sets its own pace, for
    balls that hardly turn, and if that speed is in the working range.
    """
    table, speed = design.case.table, design.case.speed
    caught = min(((1 - run.slip) * (run.member.speed or speed) for run in ensemble.given if run.hanging), default=0.0)
    given = table.run_up or RunUp()
    low, lowest = _rounded(from_si(BELOW * caught, "rpm")), from_si(design.case.speed_range[0], "rpm")
    if table.motor or caught < LEAST * speed or low >= min(given.pause_speed_rpm or math.inf, lowest):
        return
    rise = _rounded((1 - low / from_si(speed, "rpm")) * given.time_s)
    yield {"run_up.pause_speed_rpm": low, "run_up.pause_rise_s": rise}


def _rounded(value: float) -> float:
    return float(f"{value:.2g}")


def _other_oils(facts: StartFacts) -> Iterator[dict[str, object]]:
    """Other oils, the nearest first, also in place of a drag rate that the file gives.

    More viscous ones alone if balls stall, or if only start cases in hot oil fail; less viscous ones if only those in
    cold oil do.
    """
    design, ensemble = facts.design, facts.ensemble
    case, limits = design.case, design.case.table.limits
    assert ensemble is not None
    bad = [run.member.drag for run in ensemble.outcomes if not run.holds(limits, case.level_limit)]
    more, less = bool(ensemble.hanging) or max(bad, default=case.drag) < case.drag, min(bad, default=0.0) > case.drag
    oils = [(entries, drag) for entries, drag in usual_oils(case, design.autobalancer)
            if not ((more and drag < case.drag) or (less and drag > case.drag))]  # fmt: skip
    for index, most in zip(FLAT, MOST_OILS, strict=True):
        yield from islice((entries for entries, _ in oils if entries["oil.viscosity_index"] == index), most)


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
