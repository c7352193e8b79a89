"""Solids of revolution and where they stand: what a file of solids says, whatever its format.

Profiles lie in the half plane above the axis, in mm: x along the axis, r from it. The bulge of a corner is that of the
edge that leaves it: the tangent of a quarter of its arc, positive counter-clockwise.
"""

import math
from itertools import pairwise

from abu_calc.foundation.frozen import dataclass

ProfileCorner = tuple[float, float, float]
"""Place along the axis, distance from it, bulge of the edge that leaves."""
SAME = 1e-9
"""Two lengths [mm] closer than this are one."""


@dataclass(frozen=True)
class RevolvedSolid:
    """A solid of revolution: its closed profile [mm], counter-clockwise, turned round the axis once.

    `density` in kg/m³; `material` in words. Raises ValueError for a profile that bounds no solid.
    """

    name: str
    profile: tuple[ProfileCorner, ...]
    material: str
    density: float

    def __post_init__(self) -> None:
        if len(self.profile) < 2:
            raise ValueError(f"{self.name}: a profile needs two corners at least")
        if any(not math.isfinite(value) for corner in self.profile for value in corner):
            raise ValueError(f"{self.name}: a corner is not finite")
        if any(r < -SAME for _, r, _ in self.profile):
            raise ValueError(f"{self.name}: a corner lies below the axis")
        if any(math.dist(here[:2], there[:2]) < SAME for here, there in self.edges):
            raise ValueError(f"{self.name}: two neighbouring corners are one point")
        if self.volume_mm3 <= 0:
            raise ValueError(f"{self.name}: the profile does not run counter-clockwise")

    @property
    def edges(self) -> tuple[tuple[ProfileCorner, ProfileCorner], ...]:
        """Pairs of corners, an edge each; the first corner holds its bulge."""
        return tuple(pairwise((*self.profile, self.profile[0])))

    @property
    def volume_mm3(self) -> float:
        """Volume [mm³], π·∮r² dx along the profile, against its sense.

        Each straight edge is a frustum of a cone; each arc of radius a about (c, h) adds, from angle α to β,
        −π∫(h + a·sin t)²·a·sin t dt.
        """
        return -math.pi * sum(_square_under(here, there) for here, there in self.edges)

    @property
    def mass_g(self) -> float:
        """Mass [g]."""
        return self.volume_mm3 * self.density * 1e-6


@dataclass(frozen=True)
class PlacedSolid:
    """One item of an assembly: a solid, the name of this item, and the shift [mm] of its origin from the assembly's.

    The assembly's axis is z, and profiles lie along it; shifts are x, y, z.
    """

    name: str
    solid: RevolvedSolid
    shift: tuple[float, float, float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class SolidAssembly:
    """Items of a named assembly; items of one solid share its shape."""

    name: str
    description: str
    items: tuple[PlacedSolid, ...]

    @property
    def solids(self) -> tuple[RevolvedSolid, ...]:
        """Each solid once, in the order of the items."""
        return tuple(dict.fromkeys(item.solid for item in self.items))


def arc_of(here: ProfileCorner, there: ProfileCorner) -> tuple[tuple[float, float], float, float, float]:
    """Centre, radius, first angle and turn [rad] of an edge with a bulge; the turn is positive counter-clockwise."""
    (x, r, bulge), (x2, r2, _) = here, there
    height = (1 - bulge**2) / (4 * bulge)
    centre = (x + x2) / 2 - height * (r2 - r), (r + r2) / 2 + height * (x2 - x)
    start = math.atan2(r - centre[1], x - centre[0])
    return centre, math.dist(centre, (x, r)), start, 4 * math.atan(bulge)


def _square_under(here: ProfileCorner, there: ProfileCorner) -> float:
    """∫r² dx along an edge."""
    if not here[2]:
        return (there[0] - here[0]) * (here[1] ** 2 + here[1] * there[1] + there[1] ** 2) / 3
    (_, height), radius, start, turn = arc_of(here, there)

    def primitive(t: float) -> float:
        # Of (h + a·sin t)²·(−a·sin t).
        cosine, sine = math.cos(t), math.sin(t)
        return (
            height**2 * radius * cosine
            - height * radius**2 * (t - sine * cosine)
            + radius**3 * (cosine - cosine**3 / 3)
        )

    return primitive(start + turn) - primitive(start)


def ball_profile(diameter: float) -> tuple[ProfileCorner, ...]:
    """Profile [mm] of a ball about the origin: a half circle, and the axis.

    >>> ball = RevolvedSolid("ball", ball_profile(2.0), "steel", 7800.0)
    >>> round(ball.volume_mm3, 6)
    4.18879
    """
    return (-diameter / 2, 0.0, 0.0), (diameter / 2, 0.0, 1.0)


def cylinder_profile(diameter: float, length: float) -> tuple[ProfileCorner, ...]:
    """Profile [mm] of a full cylinder about the origin."""
    x, r = length / 2, diameter / 2
    return (-x, 0.0, 0.0), (x, 0.0, 0.0), (x, r, 0.0), (-x, r, 0.0)
