"""The balls on their way from start to rest, and the imbalance that is left meanwhile."""

from typing import TYPE_CHECKING, NamedTuple

from abu_calc.report.figures.chart import Axis, Line, Plot

if TYPE_CHECKING:
    from abu_calc.studies.design_records import Autobalancer
    from abu_calc.studies.rotor_view import RotorView


class Motion(NamedTuple):
    """A run as seen in the rotor, and the race in which the balls move."""

    view: "RotorView"
    race: "Autobalancer"


def settling(view: "RotorView", limit: float | None) -> Plot:
    """Imbalance left against time."""
    course = list(zip(view.t_s.tolist(), view.residual_g_mm.tolist(), strict=True))
    across = Axis("time [s]", 0.0, course[-1][0])
    up = Axis.around("imbalance left [g·mm]", [*(rest for _, rest in course), limit or 0.0], zero=True)
    bound = None if limit is None else (limit, f"permitted {limit:.4g} g·mm")
    told = f"From {course[0][1]:.3g} g·mm at the start to {course[-1][1]:.3g} g·mm at {course[-1][0]:.3g} s"
    return Plot("Imbalance left against time", told, across, up, (Line(course),), (), bound)
