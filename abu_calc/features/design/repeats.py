"""Start cases that decide checks, and the options of `abu simulate` that repeat them."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Annotated, Any

from abu_calc.features.design.start_rules import RULES
from abu_calc.features.design.start_search import SearchResult
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import in_file, turned_deg
from abu_calc.simulation.ensemble_results import Ensemble, StartOutcome
from abu_calc.simulation.start_cases import Member, Variation, ball_speed_rpm
from abu_calc.sizing.actions import set_options
from abu_calc.sizing.design import Design


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
