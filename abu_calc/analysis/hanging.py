"""The closed bounds on hanging balls of a design, idle, over its whole speed range."""

from abu_calc.dynamics.balanced.hanging import HangingBounds
from abu_calc.dynamics.balanced.hanging import hanging_bounds as bounds_of
from abu_calc.scenes.from_design import contact_half_angle, idle_scene
from abu_calc.sizing.design import Design


def hanging_bounds(design: Design) -> HangingBounds:
    """Drags [1/s] above which no balls of a design hang at any speed of its range; `doubt(drag)` asks of one."""
    horizontal = design.case.table.machine.spindle_axis == "horizontal"
    return bounds_of(idle_scene(design), contact_half_angle(design), design.case.speed_range, horizontal=horizontal)
