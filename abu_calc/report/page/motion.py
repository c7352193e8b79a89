"""The balls on their way from start to rest, and the imbalance that is left meanwhile."""

from typing import TYPE_CHECKING

from abu_calc.report.page.chart import Axis, Plot, plot
from abu_calc.report.page.document import script
from abu_calc.report.page.figure import Figure, text

if TYPE_CHECKING:
    from abu_calc.studies.design_records import Autobalancer
    from abu_calc.studies.rotor_view import Array, RotorView

PACES = {"1": "as it is", "0.2": "5 × slower", "0.05": "20 × slower", "0.01": "100 × slower"}
USUAL = "0.2"


def player(view: "RotorView", one: "Autobalancer", section: str) -> Figure:
    """A canvas with what plays it: button, slider, pace; keys on the canvas too."""
    end = float(view.t_s[-1])
    options = "".join(
        f'<option value="{value}"{" selected" if value == USUAL else ""}>{text(name)}</option>'
        for value, name in PACES.items()
    )
    alternative = f"The balls and the axis, seen in the rotor, from 0 to {end:.3g} s; space plays, arrows move in time"
    data = {
        "t": _rounded(view.t_s, 6), "x": _rounded(view.x_um, 3), "y": _rounded(view.y_um, 3),
        "balls": [_rounded(row, 2) for row in view.ball_angles_deg], "rest": _rounded(view.residual_g_mm, 4),
        "imbalance": view.imbalance_angle_deg, "race": one.race_radius_mm, "pitch": one.pitch_radius_mm,
        "ball": one.ball_diameter_mm / 2,
    }  # fmt: skip
    drawn = (
        f'<div class="player"><canvas id="motion" width="640" height="310" tabindex="0" role="img" '
        f'aria-label="{text(alternative)}"></canvas><div class="keys">'
        '<button type="button" id="motion-play">Play</button>'
        f'<input type="range" id="motion-time" min="0" max="{end:.6g}" step="any" value="0" aria-label="Time">'
        f'<select id="motion-pace" aria-label="Pace">{options}</select></div><p id="motion-told"></p></div>'
        + script("motion.js", **data)
    )
    caption = (
        "The simulated run, seen in the rotor, which turns anticlockwise: the balls leave the imbalance (red) and come "
        "to rest against it; beside them how the axis goes round, drift taken off. Space plays, arrows move in time."
    )
    return Figure(section, drawn, caption, 640)


def settling(view: "RotorView", limit: float | None, section: str) -> Figure:
    """Imbalance left against time."""
    course = list(zip(view.t_s.tolist(), view.residual_g_mm.tolist(), strict=True))
    across = Axis("time [s]", 0.0, course[-1][0])
    up = Axis.around("imbalance left [g·mm]", [*(rest for _, rest in course), limit or 0.0], zero=True)
    bound = None if limit is None else (limit, f"permitted {limit:.4g} g·mm")
    told = f"From {course[0][1]:.3g} g·mm at the start to {course[-1][1]:.3g} g·mm at {course[-1][0]:.3g} s"
    caption = "Imbalance of rotor and balls together: it should fall below the dashed line, and stay there."
    drawing = plot("settling", "Imbalance left against time", told, Plot(across, up, (course,), (), bound))
    return Figure(section, drawing, caption)


def _rounded(values: "Array", digits: int) -> list[float]:
    return [round(value, digits) for value in values.tolist()]
