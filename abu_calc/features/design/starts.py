"""Start cases of a design as results hold them, and those that are run again to be shown.

Shown are the worst start case, a typical one and one of each kind. They are run again on request only.

Start cases that decide checks, and the options of `abu simulate` that repeat them.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from operator import attrgetter
from typing import Annotated, Any, Final, Self

from abu_calc.dynamics.integrators.compiled.code import installed
from abu_calc.dynamics.scene import Scene
from abu_calc.features.design.band import BandRow, band
from abu_calc.features.design.start_rules import RULES
from abu_calc.features.design.start_search import SearchResult
from abu_calc.foundation.errors import NotTrustworthyError
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import from_si, in_file, turned_deg
from abu_calc.simulation.ensemble import TIGHTER, WORK, first_tolerance, run_of_start
from abu_calc.simulation.records import finite
from abu_calc.simulation.rotor_view import RotorView
from abu_calc.simulation.start_cases import Ensemble, Member, StartOutcome, Variation, ball_speed_rpm
from abu_calc.sizing.actions import set_options
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import level_at_loudest


def repeated(outcome: StartOutcome, design: Design) -> str:
    """The options of `abu simulate` that repeat a start of a design, which they pin."""
    member, balls = outcome.member, design.autobalancer
    entries: dict[str, object] = {
        "autobalancer.ball_count": balls.ball_count,
        **dict((in_file("autobalancer.ball_diameter_mm", balls.ball_diameter), *_other_values(member, design))),
    }
    if member.run_up and not member.by_motor:
        entries["run_up.time_s"] = member.run_up
    if member.angles:
        entries |= places(member.angles)
        if member.lag:
            entries["start.speeds_rpm"] = f"{[ball_speed_rpm(design, member)] * len(member.angles)}"
    scene = "--scene run-up " if member.run_up else f"--start {member.start} " if not member.angles else ""
    return scene + as_options(outcome, entries)


def places(angles: Iterable[float]) -> dict[str, str]:
    """The entry that places the balls at these angles [rad]."""
    degrees = ", ".join(f"{turned_deg(angle):.4f}" for angle in angles)
    return {"start.angles_deg": f"[{degrees}]"}


def as_options(outcome: StartOutcome, entries: Mapping[str, object]) -> str:
    """Options with the length of a run, the side of the race's centre, and entries."""
    lasts = f"--duration {outcome.duration:.6g} " if outcome.duration else ""
    return f"{lasts}--race-centre {outcome.member.race_centre_deg:.10g} {set_options(entries)}"


def _other_values(member: Member, design: Design) -> Iterator[tuple[str, object]]:
    """Entries of what a start has otherwise than the file, with race and imbalance as they are.

    A motor runs up to its idle speed, whatever is rated.
    """
    case, varied = design.case, member.varied
    at_speed = member.speed is not None and case.table.motor is None
    if at_speed:
        yield in_file("machine.speed_rpm", member.speed or 0.0)
    if at_speed or varied != Variation():
        yield in_file("autobalancer.race_radius_mm", design.autobalancer.race_radius)
        yield in_file("wheel.imbalance_g_mm", varied.imbalance * design.imbalance.value)
    if member.drag != case.drag:
        yield in_file("autobalancer.rolling_drag_per_s", member.drag)
    if varied.race_eccentricity != 1:
        yield in_file("autobalancer.race_eccentricity_mm", varied.race_eccentricity * case.race_eccentricity)
    if varied.friction_arm != 1:
        yield in_file("autobalancer.rolling_friction_mm", varied.friction_arm * case.friction_arm)
    if varied.spindle_axis is not None:
        yield "machine.spindle_axis", varied.spindle_axis
    given = case.table.suspension.frequencies
    if varied.natural_frequency != 1 and given is not None:
        values = ", ".join(f"{varied.natural_frequency * each:.10g}" for each in given)
        yield "suspension.natural_frequencies_hz", f"[{values}]"


def decisive(design: Any, ensemble: Ensemble, searched: SearchResult | None) -> StartOutcome | None:
    """The start case that decides the verdict: one that fails before one that breaks a limit, then the latest."""
    outcomes = (*ensemble.outcomes, *(() if searched is None else searched.outcomes))

    def order(outcome: StartOutcome) -> tuple[bool, bool, bool, float, float]:
        """The decisive one last."""
        broken = any(rule.breaks(outcome, design) for rule in RULES)
        clearly = not outcome.holds(design.case.table.limits, design.case.level_limit)
        return outcome.member.promised and clearly, clearly, broken, outcome.quiet_time_or_inf, outcome.level

    return max(outcomes, key=order, default=None)


@record
class RepeatedStart(Record):
    """The worst further start case for one check, with the options of `abu simulate` that repeat it."""

    check: Annotated[str, Quantity("check")]
    which: Annotated[str, Quantity("which")]
    options: Annotated[str, Quantity("options of `abu simulate`")]


def worst_further(searched: SearchResult, design: Design) -> Iterator[RepeatedStart]:
    """The worst further start case for each check that these break or come near to.

    Quiet times count, too, if one start case of 1000 would be late.
    """
    for rule in RULES:
        worst, _ = rule.worst(searched, design)
        if worst is not None:
            yield RepeatedStart(check=rule.code, which=rule.repeated, options=repeated(worst, design))


MOST: Final = 12
MOST_WORK, MOST_PLAIN = 400_000, 60_000
"""Work of all starts together, in compiled code and without: a second or two."""


def chosen_starts(ensemble: Ensemble) -> tuple[tuple[str, StartOutcome], ...]:
    """The worst of all; at the rated speed that of the median time among those that balance, then the slowest of each
    kind at the drag given.
    """
    choices = [] if ensemble.worst is None else [("worst", ensemble.worst)]
    settled = sorted(
        (start for start in ensemble.rated if start.balanced and math.isfinite(start.quiet_time_or_inf)),
        key=lambda start: start.quiet_time_or_inf,
    )
    if settled:
        choices.append(("typical", settled[len(settled) // 2]))
    given = [start for start in ensemble.given if start.member.speed is None]
    kinds = dict.fromkeys(start.member.name for start in given)
    choices += [("", max((start for start in given if start.member.name == kind), key=_slow)) for kind in kinds]
    first: dict[int, tuple[str, StartOutcome]] = {}
    for why, outcome in choices:
        first.setdefault(id(outcome), (why, outcome))
    return tuple(first.values())[:MOST]


def _slow(outcome: StartOutcome) -> tuple[bool, bool, float]:
    return outcome.hanging, not outcome.balanced, outcome.quiet_time_or_inf


SAMPLES: Final = 250
"""Samples of each start case, so few that a page with all of them stays small."""


@dataclass(frozen=True)
class StartView:
    """One start case as seen in the rotor.

    `why`: worst, typical or nothing. `quiet_time_s`: None if it is never quiet. `stalled`: whether balls do.
    `angles_deg`: angles of the balls from the imbalance, if the file or the search places them.
    """

    why: str
    start: str
    drag_per_s: float
    race_centre_deg: float
    angles_deg: tuple[float, ...]
    quiet_time_s: float | None
    level_db: float
    balanced: bool
    stalled: bool
    view: RotorView
    scene: Scene | None = None


def starts_again(design: Design, ensemble: Ensemble, accuracy: float) -> Iterator[StartView]:
    """Repeat the chosen start cases, as far as the allowed work permits, each by the run of its outcome."""
    left, first = MOST_WORK if installed() else MOST_PLAIN, first_tolerance(design)
    for why, outcome in chosen_starts(ensemble):
        if outcome.work > left:
            continue
        for tolerance in (TIGHTER * first, first) if outcome.confirmed else (first,):
            try:
                repeat, scene, trajectory = run_of_start(design, outcome.member, accuracy, tolerance)
            except NotTrustworthyError:
                left -= WORK
                continue
            left -= repeat.work
            if (repeat.hanging, repeat.balanced) == (outcome.hanging, outcome.balanced):
                view = RotorView.of(scene, trajectory, levels_of(design, scene), SAMPLES)
                if view is not None:
                    yield StartView(
                        why=why,
                        start=outcome.member.name,
                        drag_per_s=outcome.member.drag,
                        race_centre_deg=outcome.member.race_centre_deg,
                        angles_deg=tuple(map(turned_deg, outcome.member.angles)),
                        quiet_time_s=outcome.quiet_time,
                        level_db=outcome.level,
                        balanced=outcome.balanced,
                        stalled=outcome.hanging,
                        view=view,
                        scene=scene,
                    )
                break


def levels_of(design: Design, scene: Scene) -> Callable[[float], float]:
    """Function from an rms velocity of the axis [m/s] to the level [dB] at the loudest place.

    The level is that which an ensemble reports.
    """

    case = replace(design.case, speed=scene.speed)

    def level(velocity: float) -> float:
        return level_at_loudest(case, design.autobalancer, math.sqrt(2) * velocity / scene.speed)

    return level


@dataclass(frozen=True)
class Starts:
    """Start cases of an ensemble; `of`: design, ensemble and accuracy, None if there is no ensemble."""

    of: tuple[Design, Ensemble, float] | None
    searched: SearchResult | None = None
    """Further start cases, None if none were simulated."""

    @property
    def drag_per_s(self) -> float | None:
        """The drag given."""
        return None if self.of is None else self.of[1].drag

    @cached_property
    def views(self) -> tuple[StartView, ...]:
        """The worst, a typical one, and each kind at the drag given: at most a dozen, run again at the first look."""
        if self.of is None:
            return ()
        return tuple(starts_again(*self.of))


@record
class Spread(Record):
    """The median over all starts at the rated speed, and the worst of all; None where a start never gets there."""

    typical: Annotated[float | None, Quantity("typical")]
    worst: Annotated[float | None, Quantity("worst")]

    @classmethod
    def of(cls, ensemble: Ensemble, value: Callable[[StartOutcome], float]) -> Self:
        """Spread of one number over all start cases."""
        worst = max(map(value, ensemble.outcomes), default=None)
        return cls(typical=ensemble.typical(map(value, ensemble.rated)), worst=finite(worst))


@record
class WorstMember(Record):
    """Worst start case: stalled before not balanced, not balanced before loud; no speed: the rated one."""

    start: Annotated[str, Quantity("start")]
    drag_per_s: Annotated[float, Quantity("drag", "h₀", 3)]
    run_up_s: Annotated[float | None, Quantity("run-up", "", 3)]
    speed_rpm: Annotated[float | None, Quantity("speed", "", 6)]
    race_centre_deg: Annotated[float, Quantity("centre of the race from the imbalance", "", 3)]


@record
class SettlingOfStart(Record):
    """Times of one kind of start at one drag, from full speed: with the race off to the slower side.

    `race_centre_deg`: that side, the angle of the race's centre from the imbalance. None: never.
    """

    start: Annotated[str, Quantity("start")]
    drag: Annotated[float, Quantity("drag", "h₀", 3, unit="per_s")]
    quiet_time: Annotated[float | None, Quantity("quiet time", "t_q", 3, unit="s")]
    rest_time: Annotated[float | None, Quantity("rest time", "t_r", 3, unit="s")]
    settling_time: Annotated[float | None, Quantity("settling time", "t_s", 3, unit="s")]
    race_centre_deg: Annotated[float, Quantity("centre of the race from the imbalance", "", 3)]

    @classmethod
    def all_of(cls, ensemble: Ensemble) -> tuple[Self, ...]:
        """Each kind of start at each drag, in the order in which they ran."""
        slowest: dict[tuple[str, float], StartOutcome] = {}
        for outcome in ensemble.outcomes:
            key = outcome.member.name, outcome.member.drag
            slowest[key] = max(slowest.get(key, outcome), outcome, key=attrgetter("quiet_time_or_inf"))
        return tuple(
            cls.read(outcome, outcome.member, start=start, settling_time=outcome.settling_time_or_inf)
            for (start, _), outcome in slowest.items()
        )


@record
class FurtherStarts(Record):
    """Start cases beside the listed ones, over the band and where they are worst.

    A time of None: never. `rare_quiet_time_s`: one start case of 1000 takes longer, by the tail of the quiet times of
    those that no result chose.
    """

    members: Annotated[int, Quantity("further start cases")]
    quiet_time: Annotated[float | None, Quantity("slowest of them", "t_q", 3, unit="s")]
    rest_time: Annotated[float | None, Quantity("longest rest time of them", "t_r", 3, unit="s")]
    settling_time: Annotated[float | None, Quantity("longest settling time of them", "t_s", 3, unit="s")]
    rare_quiet_time: Annotated[float | None, Quantity("one start case of 1000 takes longer than", "t_q", 3, unit="s")]
    level_db: Annotated[float, Quantity("loudest of them", "L")]
    repeats: tuple[RepeatedStart, ...] = ()

    @classmethod
    def of(cls, searched: SearchResult | None, design: Design) -> Self | None:
        """Record of a search; None if there was none, or without an answer."""
        if searched is None or not searched.outcomes:
            return None
        return cls(
            members=len(searched.outcomes),
            quiet_time=max(outcome.quiet_time_or_inf for outcome in searched.outcomes),
            rest_time=max(outcome.rest_time_or_inf for outcome in searched.outcomes),
            settling_time=max(outcome.settling_time_or_inf for outcome in searched.outcomes),
            rare_quiet_time=searched.foreseen,
            level_db=max(outcome.loudest for outcome in searched.outcomes),
            repeats=tuple(worst_further(searched, design)),
        )


@record
class DecisiveRun(Record):
    """The start case that decides the verdict, and the options of `abu simulate` that repeat it."""

    start: Annotated[str, Quantity("start")]
    promised: Annotated[bool, Quantity("within what is promised")]
    quiet_time_s: Annotated[float | None, Quantity("quiet time", "t_q", 3)]
    level_db: Annotated[float, Quantity("level", "L")]
    options: Annotated[str, Quantity("options of `abu simulate`")]

    @classmethod
    def of(
        cls, design: Any, ensemble: Ensemble, searched: SearchResult | None = None,
        repeated: Callable[[Any, Any], str] = repeated,
    ) -> Self | None:  # fmt: skip
        """Record of the decisive start case, with the options that `repeated` gives; None without any."""
        outcome = decisive(design, ensemble, searched)
        return None if outcome is None else cls.read(
            outcome, outcome.member, start=outcome.member.name, options=repeated(outcome, design)
        )  # fmt: skip


@record
class EnsembleResult(Record):
    """The idle machine switched on in many ways: starts, run-ups, and the drag of oil that is hot, as meant, cold."""

    members: Annotated[int, Quantity("start cases")]
    runs: Annotated[int, Quantity("start cases, further ones included")]
    balanced: Annotated[int, Quantity("that balance")]
    hanging: Annotated[int, Quantity("with stalled balls")]
    quiet_time_s: Annotated[Spread, Quantity("quiet time", "t_q")]
    rest_time_s: Annotated[Spread, Quantity("rest time", "t_r")]
    settling_time_s: Annotated[Spread, Quantity("settling time", "t_s")]
    level_db: Annotated[Spread, Quantity("level", "L")]
    residual_um: Annotated[Spread, Quantity("residual", "w")]
    predicted_level_db: Annotated[
        float | None, Quantity("predicted level, median of the start cases, hot and cold oil included", "L")
    ]
    worst_member: Annotated[WorstMember | None, Quantity("worst start case")]
    settling_by_start: tuple[SettlingOfStart, ...]
    further_starts: FurtherStarts | None
    band: tuple[BandRow, ...]
    worst_run: DecisiveRun | None

    @classmethod
    def of(
        cls,
        ensemble: Ensemble,
        design: Design,
        predicted_level: float | None = None,
        searched: SearchResult | None = None,
    ) -> Self:
        """Record in user units; `predicted_level` [dB]: the one that measurements are compared with."""
        worst = None if ensemble.worst is None else ensemble.worst.member
        return cls.read(
            ensemble,
            hanging=len(ensemble.hanging),
            quiet_time_s=Spread.of(ensemble, lambda outcome: outcome.quiet_time_or_inf),
            rest_time_s=Spread.of(ensemble, lambda outcome: outcome.rest_time_or_inf),
            settling_time_s=Spread.of(ensemble, lambda outcome: outcome.settling_time_or_inf),
            level_db=Spread.of(ensemble, lambda outcome: outcome.level),
            residual_um=Spread.of(ensemble, lambda outcome: from_si(outcome.residual, "um")),
            predicted_level_db=predicted_level,
            worst_member=None
            if worst is None
            else WorstMember.read(worst, start=worst.way, run_up_s=worst.run_up or None),
            settling_by_start=SettlingOfStart.all_of(ensemble),
            further_starts=FurtherStarts.of(searched, design),
            runs=ensemble.members + (0 if searched is None else len(searched.outcomes) + searched.lost),
            band=() if searched is None else band(design),
            worst_run=DecisiveRun.of(design, ensemble, searched),
        )
