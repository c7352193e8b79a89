"""The one idle level that is compared with measurements: the median of all start cases."""

import math
import statistics

from abu_calc.foundation.parallel import processors
from abu_calc.foundation.progress import Progress, silent
from abu_calc.simulation.ensemble import simulate_members
from abu_calc.simulation.start_cases import Ensemble
from abu_calc.simulation.vibration_records import MeasuredAfterRecord, compared, measured_place
from abu_calc.sizing.budget import displacement_level, place_response
from abu_calc.sizing.design import Design
from abu_calc.sizing.places import level_at_loudest


def predicted_displacement(design: Design, ensemble: Ensemble) -> float | None:
    """Idle displacement 0–peak [m] of the race that measurements are compared with; None without start cases.

    It is the median over the start cases of the held machine at its rated speed, hot and cold oil included. The ends of
    a speed range and a swing arm do not count. A measured machine was switched on an unknown number of times with oil
    of an unknown temperature, so the median stands for it, neither the closed form nor the loudest start case.
    """
    velocities = [outcome.velocity for outcome in ensemble.rated if not outcome.member.on_arm]
    return math.sqrt(2) * statistics.median(velocities) / design.case.speed if velocities else None


def predicted_level(design: Design, ensemble: Ensemble | None) -> float | None:
    """The idle level [dB] of `predicted_displacement` at the loudest place, background included."""
    moved = None if ensemble is None else predicted_displacement(design, ensemble)
    return None if moved is None else level_at_loudest(design.case, design.autobalancer, moved)


def compared_starts(
    design: Design, ensemble: Ensemble | None, loaded: float | None = None, this_run: float | None = None
) -> MeasuredAfterRecord | None:
    """[measured_after] beside the predicted level at its place, see `compared`; None without a measurement."""
    moved = None if ensemble is None else predicted_displacement(design, ensemble)
    return compared(design.case, _level_where_measured(design, moved), loaded, this_run)


def _level_where_measured(design: Design, at_race: float | None) -> float | None:
    """Level [dB] at the place of [measured_after] of a displacement 0–peak [m] of the race; None without either."""
    case, table = design.case, design.case.table.measured_after
    if table is None or table.shown is None or not at_race:
        return None
    response = place_response(case, measured_place(case, table.shown)[1], design.autobalancer.mass)
    there = response.loudest(at_race, design.imbalance.value)
    return displacement_level(there, case.speed, case.background_level) if there else None


def starts_for_measurement(design: Design, progress: Progress = silent) -> Ensemble | None:
    """The start cases that `predicted_level` needs, for commands that simulate none; None without a measurement.

    They are those of `abu size`, so that every command predicts the same level of the same design.
    """
    table, autobalancer = design.case.table.measured_after, design.autobalancer
    carried = design.imbalance.value * abs(autobalancer.requirement.plane_ratio)
    if table is None or table.shown is None or autobalancer.capacity < carried:
        return None
    return simulate_members(design, progress=progress, workers=processors())
