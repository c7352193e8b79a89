"""Stalling of balls beside the balanced state, as results hold it: bounds with the drag rate's margin."""

from typing import Annotated, Self

from abu_calc.dynamics.balanced.hanging import HangingBounds, hanging_bounds
from abu_calc.dynamics.scene import Scene
from abu_calc.studies.quantity import Quantity, Record, record
from abu_calc.studies.simulated_scene import finite

STATES = ("at a resonance", "above a heavily damped resonance", "at rest under gravity")
"""Stalled states of balls, in the order of the bounds."""


@record
class HangingBound(Record):
    """A drag above which balls do not hang in one of three ways; null where no drag is enough."""

    state: Annotated[str, Quantity("balls hang")]
    drag_per_s: Annotated[float | None, Quantity("not above a drag of")]
    margin: Annotated[float | None, Quantity("the drag over it")]


@record
class Hanging(Record):
    """Closed bounds at the scene's speed: they suffice and are not necessary."""

    drag_per_s: Annotated[float, Quantity("drag of the race", "h₀")]
    hanging_drag_per_s: Annotated[float | None, Quantity("drag above which no balls hang")]
    doubt: Annotated[bool, Quantity("balls may hang")]
    bounds: tuple[HangingBound, ...]

    @classmethod
    def of(cls, scene: Scene, half_angle: float) -> Self | None:
        """Record of a scene with balls; `half_angle` [rad] of touching ones, 0 without size."""
        if not scene.ball_masses:
            return None
        bounds = hanging_bounds(scene, half_angle, horizontal=scene.effect("gravity") is not None)
        drags = zip(STATES, (bounds.resonance, bounds.damped, bounds.gravity), strict=True)
        return cls(
            drag_per_s=bounds.drag,
            hanging_drag_per_s=finite(bounds.largest),
            doubt=bounds.doubt(),
            bounds=tuple(_bound(bounds, state, drag) for state, drag in drags if drag > 0),
        )


def _bound(bounds: HangingBounds, state: str, drag: float) -> HangingBound:
    return HangingBound(state=state, drag_per_s=finite(drag), margin=bounds.margin(drag))
