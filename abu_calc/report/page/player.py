"""A motion as a canvas with what plays it: button, slider, pace; keys on the canvas too."""

from typing import TYPE_CHECKING, Any

from abu_calc.report.figures.motion import Motion
from abu_calc.report.page.beside import script
from abu_calc.report.page.words import text

if TYPE_CHECKING:
    from abu_calc.studies.rotor_view import Array, RotorView

PACES = {"1": "as it is", "0.2": "5 × slower", "0.05": "20 × slower", "0.01": "100 × slower"}
USUAL = "0.2"


def player(motion: Motion) -> str:
    """The element, with its data and its script."""
    runs = [(motion.name, motion.view), *motion.others]
    end = float(motion.view.t_s[-1])
    options = "".join(
        f'<option value="{value}"{" selected" if value == USUAL else ""}>{text(name)}</option>'
        for value, name in PACES.items()
    )
    alternative = f"The balls and the axis, seen in the rotor, from 0 to {end:.3g} s; space plays, arrows move in time"
    data = {
        "runs": [_run(view) for _, view in runs], "race": motion.race_mm, "ball": list(motion.balls_mm),
        "pitch": list(motion.view.pitch_radii_mm),
    }  # fmt: skip
    starts = "".join(f'<option value="{index}">{text(name)}</option>' for index, (name, _) in enumerate(runs))
    chosen = f'<select id="motion-start" aria-label="Start">{starts}</select>' if motion.others else ""
    return (
        f'<div class="player"><canvas id="motion" width="640" height="310" tabindex="0" role="img" '
        f'aria-label="{text(alternative)}"></canvas><div class="keys">'
        '<button type="button" id="motion-play">Play</button>'
        f'<input type="range" id="motion-time" min="0" max="{end:.6g}" step="any" value="0" aria-label="Time">'
        f'<select id="motion-pace" aria-label="Pace">{options}</select>{chosen}</div><p id="motion-told"></p></div>'
        + script("motion.js", **data)
    )


def _run(view: "RotorView") -> dict[str, Any]:
    return {
        "t": _rounded(view.t_s, 6), "x": _rounded(view.x_um, 3), "y": _rounded(view.y_um, 3),
        "balls": [_rounded(row, 2) for row in view.ball_angles_deg], "rest": _rounded(view.residual_g_mm, 4),
        "imbalance": view.imbalance_angle_deg,
    }  # fmt: skip


def _rounded(values: "Array", digits: int) -> list[float]:
    return [round(value, digits) for value in values.tolist()]
