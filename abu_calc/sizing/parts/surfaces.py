"""Demands on a surface of a part: size, form, place, roughness. Drawings and checks read them here."""

from typing import Literal

from abu_calc.foundation.frozen import dataclass
from abu_calc.standards.tolerance_classes import DeviationLimits

Kind = Literal["cylinder", "plane", "torus", "sphere", "thread"]
Tolerance = Literal["circularity", "cylindricity", "flatness", "perpendicularity", "parallelism", "run-out"]


@dataclass(frozen=True)
class GeometricalTolerance:
    """A frame of ISO 1101: what is toleranced, its value [m], and the datum letter, if it needs one."""

    kind: Tolerance
    value: float
    datum: str = ""


@dataclass(frozen=True)
class Surface:
    """A named surface of a part.

    `size`: diameter of a cylinder, thread or race at its bottom, radius across of a torus or sphere is `groove` [m].
    `tolerance_class` with `limits` [m] by ISO 286-2, or `plus_minus` [m] on the diameter. `roughness`: Ra [m], null:
    the general one. `datum`: letter by which other surfaces refer to this one.
    """

    name: str
    kind: Kind
    size: float | None = None
    groove: float | None = None
    tolerance_class: str = ""
    limits: DeviationLimits | None = None
    plus_minus: float | None = None
    groove_plus_minus: float | None = None
    roughness: float | None = None
    geometrical: tuple[GeometricalTolerance, ...] = ()
    datum: str = ""
    thread: str = ""
    """Designation of a thread, such as M62×1."""
    hardness: str = ""
