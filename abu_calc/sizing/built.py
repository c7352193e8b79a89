"""One machine built to a design: its own balls, race, wheel and hands, the choice of the design kept."""

from dataclasses import replace

from abu_calc.sizing.balls import evaluate
from abu_calc.sizing.case import read_case
from abu_calc.sizing.design import Design
from abu_calc.sizing.frequency import frequency_region
from abu_calc.sizing.imbalance import find_imbalance
from abu_calc.sizing.track import track
from abu_calc.sizing.worst import worst_residuals
from abu_calc.spec.machine import MachineFile
from abu_calc.units import to_si


def built(design: Design, machine: MachineFile) -> Design:
    """The design as it came out in one machine, whose file may pin the balls and the race that were made.

    What judges a design (checks, runners-up, advice, levels over the speed range) is left out, and the worst
    arrangement of balls, too, which takes longer than all the rest: see `with_worst`.
    """
    case = read_case(machine)
    imbalance, chosen, own = find_imbalance(case), design.autobalancer, case.autobalancer
    made = evaluate(
        case,
        imbalance.value,
        chosen.ball_count if own.ball_count is None else own.ball_count,
        chosen.ball_diameter if own.ball_diameter_mm is None else to_si(own.ball_diameter_mm, "mm"),
        chosen.race_radius if own.race_radius_mm is None else to_si(own.race_radius_mm, "mm"),
    )
    frequency = frequency_region(case, made.ball_mass, made.mass)
    return replace(
        design, case=case, frequency=frequency, imbalance=imbalance, choice=replace(design.choice, best=made),
        track=track(case, made, frequency.natural_frequencies), runner_up_tracks=(), worst=(), speed_levels=None,
        loaded=None, seats=(), swing_arm=None, drawing=(), checks=(), warnings=(),
    )  # fmt: skip


def with_worst(design: Design) -> Design:
    """The same with the arrangements at which friction holds the axis farthest off."""
    return replace(design, worst=worst_residuals(design.case, design.imbalance.value, design.autobalancer))
