"""The options of `abu simulate` that repeat a start case of a machine with two races."""

from collections.abc import Iterator
from itertools import chain
from typing import Any

from abu_calc.features.design.repeats import as_options, places
from abu_calc.features.two_races.choice import TwoRaceDesign
from abu_calc.features.two_races.start_cases import horizontal, scene_of, start_phases
from abu_calc.foundation.units import from_si, wrapped_deg
from abu_calc.simulation.ensemble_results import StartOutcome


def repeated(outcome: StartOutcome, design: TwoRaceDesign) -> str:
    """The options of `abu simulate` that repeat a start case, with balls, races and imbalances as they are."""
    member = outcome.member
    start = f"--start {'run-up' if member.run_up else member.start} " if member.run_up or not member.turned else ""
    entries = dict(chain(_made(design), _of_start(outcome, design)))
    if member.turned:
        entries |= places(chain.from_iterable(race.start_angles for race in scene_of(design, member).races))
    return start + as_options(outcome, entries)


def _made(design: TwoRaceDesign) -> Iterator[tuple[str, Any]]:
    """Entries that pin balls, races and their places."""
    for k, race in enumerate(design.races):
        balls, own = race.design.autobalancer, f"autobalancer.{k}."
        yield f"{own}ball_count", balls.ball_count
        yield f"{own}ball_diameter_mm", from_si(balls.ball_diameter, "mm")
        yield f"{own}race_radius_mm", from_si(balls.race_radius, "mm")
        if design.case.table.autobalancer[k].plane_range_mm is not None:
            place = from_si(race.place, "mm")
            yield from ((f"{own}plane_mm", place), (f"{own}plane_range_mm", [place, place]))


def _of_start(outcome: StartOutcome, design: TwoRaceDesign) -> Iterator[tuple[str, Any]]:
    """Entries of what this start case has otherwise than the file, and of the imbalances at its phases."""
    case, member = design.case, outcome.member
    varied = member.varied
    if member.speed is not None:
        yield "machine.speed_rpm", from_si(member.speed, "rpm")
    if member.run_up:
        yield "run_up.time_s", member.run_up
    if varied.spindle_axis is not None:
        yield "machine.spindle_axis", "horizontal" if horizontal(design, member) else "vertical"
    phases = iter(start_phases(design, member))
    for k, (wheel, angle) in enumerate(zip(case.wheels, case.angles, strict=True)):
        if member.speed is not None or varied.imbalance != 1:
            yield f"wheel.{k}.imbalance_g_mm", varied.imbalance * from_si(abs(wheel.imbalance), "g_mm")
        if angle is None:
            yield f"wheel.{k}.imbalance_angle_deg", wrapped_deg(next(phases, 0.0))
    for k, drag in enumerate(case.drags):
        if member.drag != case.drag:
            yield f"autobalancer.{k}.rolling_drag_per_s", drag * member.drag / case.drag
        if varied.friction_arm != 1:
            yield f"autobalancer.{k}.rolling_friction_mm", varied.friction_arm * from_si(case.friction_arm, "mm")
        if varied.race_eccentricity != 1:
            yield (
                f"autobalancer.{k}.race_eccentricity_mm",
                varied.race_eccentricity * from_si(case.eccentricity, "mm"),
            )
