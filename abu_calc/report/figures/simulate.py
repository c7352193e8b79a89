"""Figures of `abu simulate`: path of the balls; imbalance, level and speed against time; the formulas."""

from collections.abc import Iterator
from typing import Final

from abu_calc.report.explain import step_blocks
from abu_calc.report.figures.figure import Extras, Figure
from abu_calc.report.figures.motion import Motion, level, run_up, settling
from abu_calc.report.numbers import number
from abu_calc.report.steps import STEPS
from abu_calc.studies.rotor_view import RotorView
from abu_calc.studies.simulate import SimulateResult

SECTION: Final = "Motion"


def simulate_extras(result: SimulateResult) -> Extras:
    """Figures where the run is held from its beginning, and the calculation note."""
    figures = () if result.view is None else tuple(_figures(result, result.view))
    return Extras(figures, tuple(step_blocks(STEPS["simulation"], _numbers(result))))


def _figures(result: SimulateResult, view: RotorView) -> Iterator[Figure]:
    limits = {check.code: check.limit for check in result.checks}
    if view.pitch_radii_mm:
        whole = view.t_s[-1] > 0.9 * result.duration_s
        seen = "The run" if whole else "The beginning of the run"
        caption = (
            f"{seen}, seen in the rotor, which turns anticlockwise: balls and imbalance (red); beside them how the "
            "axis goes round, drift taken off. Space plays, arrows move in time."
        )
        yield Figure("motion", SECTION, Motion(view), caption)
        limit = limits.get("ABU701")
        below = ": it should fall below the dashed line, and stay there" if limit is not None else ""
        yield Figure("settling", SECTION, settling(view, limit), f"Imbalance of rotor and balls together{below}.")
    limit = limits.get("ABU401")
    below = ", at the loudest place: it should end below the dashed line" if limit is not None else ""
    place = result.level_at if result.handles is None else "where the machine is held"
    caption = f"Velocity level over each revolution, {place}, 0 dB = 5e-8 m/s rms{below}."
    measured = None if result.measured_after is None else result.measured_after.measured_level_db
    caption += "" if measured is None else " Lozenge: as measured with the autobalancer."
    yield Figure("level", SECTION, level(view, limit, measured), caption)
    if view.speed_rpm is not None:
        caption = "Speed of the rotor: the balls settle when it is up."
        yield Figure("run-up", SECTION, run_up(view, view.speed_rpm), caption)


def _numbers(result: SimulateResult) -> tuple[str, ...]:
    """Values of settling and accuracy for this result."""
    settled = result.settling_time_s
    since = "" if result.full_speed_s is None else f", from full speed at {number(result.full_speed_s)} s"
    return (
        f"settling time{since}: {'none' if settled is None else f'{number(settled)} s'}, imbalance left "
        f"{number(result.residual_imbalance_g_mm)} g·mm",
        f"error estimate {number(result.error_estimate, 2)}, by {result.cost.integrator} at tolerance "
        f"{result.cost.tolerance:g}",
    )
