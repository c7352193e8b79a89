"""Prediction where sensors are: at the handles, along any axis, by the rigid body that is estimated of a machine.

The plane model has no motion along the spindle. A rigid body has: its handles move along z, too.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any, Final

from abu_calc.features.design.study import SizeResult
from abu_calc.formulas.body_estimate import Layout, PlacedBody, estimated_body
from abu_calc.formulas.body_motion import BodyMotion, HandsOnHandles
from abu_calc.formulas.rigid_body import Vector
from abu_calc.foundation.frozen import dataclass
from abu_calc.inputs.machine import MachineFile
from abu_calc.standards.vibration import hand

Span = tuple[float, float]
LEAST: Final = 1e-9
"""Ratio that stands for no motion."""
SLOW: Final = 100 * math.pi
"""Below this speed [rad/s], 3000 rpm, the hands change the levels at handles; above it the body is free."""


@dataclass(frozen=True)
class HandleGeometry:
    """Lengths [m] by their names L and H, and the places of the handles from the centre of mass [m]; assumed."""

    lengths: dict[str, float]
    handles: dict[str, Vector]

    @classmethod
    def of(cls, row: dict[str, Any]) -> "HandleGeometry | None":
        """The geometry of an entry of `factory_machines`; None if it has none."""
        lengths = {name: row[key] / 1000 for name, key in (("L", "length_mm"), ("H", "height_mm")) if key in row}
        handles = {name: (x / 1000, y / 1000, z / 1000) for name, (x, y, z) in row.get("handles", {}).items()}
        return cls(lengths, handles) if lengths and handles else None


@dataclass(frozen=True)
class AtHandles:
    """Levels at the handles against those of the plane model [dB]: bands of the estimate, over all handles.

    `carried`: along x, y and z, the level at a handle minus that of the race. `lowered`: how much more an imbalance
    that is given, not measured, is lowered than a point mass shows.
    """

    carried: dict[str, Span]
    lowered: Span


def at_handles(table: MachineFile, design: SizeResult, geometry: HandleGeometry) -> AtHandles:
    """Motion of the handles per motion of the race, of the estimated body (theory of the rigid body in space).

    The balls leave the race a displacement, whatever the body is; a load at the race that causes it moves the handles.
    """
    speed, mass = table.machine.speed, design.system_mass_kg
    polar = table.wheel.mass_kg * table.wheel.diameter**2 / 8
    layout: Layout = table.machine.layout
    estimate = estimated_body(layout, mass, geometry.lengths, polar)
    places = tuple(geometry.handles.values())
    hands = HandsOnHandles(places, (hand("x"), hand("y"), hand("z"))) if speed < SLOW else None

    def ratio(place: Vector, index: int) -> Callable[[PlacedBody], float]:
        def level(placed: PlacedBody) -> float:
            motion = BodyMotion(placed.body, speed, hands)
            race = abs(motion.forward(placed.wheel, placed.wheel)) / 2
            moved = abs(motion.response(place, placed.wheel)[index]) / race
            return 20 * math.log10(max(moved, LEAST))

        return level

    def lighter(placed: PlacedBody) -> float:
        return 20 * math.log10(mass / BodyMotion(placed.body, speed, hands).effective_mass(placed.wheel))

    carried = {
        axis: _span([estimate.band(ratio(place, index)) for place in places]) for index, axis in enumerate("xyz")
    }
    return AtHandles(carried, estimate.band(lighter))


def _span(bands: Iterable[Span]) -> Span:
    """Lowest and highest of bands."""
    lows, highs = zip(*bands, strict=True)
    return min(lows), max(highs)
