"""Profiles of turned parts: closed lists of straight and circular segments in the half plane through the axis.

z runs along the axis from the closed web's face, r from the axis [m]. Profiles go round counter-clockwise in (z, r),
so that the material lies on the left.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Final, NamedTuple

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si

LEAST_BULGE: Final = 1e-12
"""Bulges below are straight."""


def drawn(length: float) -> float:
    """A length [m] in the millimetres of drawings, freed of the noise of binary fractions."""
    return round(from_si(length, "mm"), 9)


class Point(NamedTuple):
    """A point of the half plane [m]."""

    z: float
    r: float


@dataclass(frozen=True)
class Segment:
    """A straight line or an arc from one point to the next, and the name of the surface that it generates.

    `bulge`: tangent of a quarter of the arc, positive counter-clockwise; 0 is straight.
    """

    start: Point
    end: Point
    surface: str
    bulge: float = 0.0

    @property
    def straight(self) -> bool:
        """True of a line."""
        return abs(self.bulge) < LEAST_BULGE

    @property
    def chord(self) -> float:
        """Distance between both ends [m]."""
        return math.dist(self.start, self.end)

    @property
    def radius(self) -> float:
        """Radius of the arc [m]; infinite for a line."""
        if self.straight:
            return math.inf
        return self.chord * (1 + self.bulge**2) / (4 * abs(self.bulge))

    @property
    def centre(self) -> Point:
        """Centre of the arc [m].

        >>> Segment(Point(0.0, 1.0), Point(2.0, 1.0), "bowl", 1.0).centre
        Point(z=1.0, r=1.0)
        """
        if self.straight:
            raise ValueError("a straight segment has no centre")
        (z, r), (to_z, to_r) = self.start, self.end
        # From the chord's middle to the left of the way by R·cos of half the angle.
        along = (1 - self.bulge**2) / (4 * self.bulge)
        return Point((z + to_z) / 2 - along * (to_r - r), (r + to_r) / 2 + along * (to_z - z))


Profile = tuple[Segment, ...]
"""Closed and counter-clockwise: each segment starts where the one before ends."""


class Corner(NamedTuple):
    """A corner from which a named segment leaves."""

    z: float
    r: float
    surface: str
    bulge: float = 0.0


def closed(corners: Sequence[Corner]) -> Profile:
    """The profile through corners, each with the surface of the segment that leaves it; empty segments are left out."""
    return tuple(
        Segment(Point(here.z, here.r), Point(there.z, there.r), here.surface, here.bulge)
        for here, there in pairwise((*corners, corners[0]))
        if (here.z, here.r) != (there.z, there.r)
    )


class Moments(NamedTuple):
    """∫dA, ∫r dA, ∫r² dA and ∫r³ dA of a half section [m², m³, m⁴, m⁵]."""

    area: float
    first: float
    second: float
    third: float


def moments(profile: Profile) -> Moments:
    """Moments of the half section by Green's theorem: −∮ r dz, −∮ r²/2 dz, and so on; exact for lines and arcs."""
    area = first = second = third = 0.0
    for segment in profile:
        for z, r, weight in _nodes(segment):
            area -= weight * r * z
            first -= weight * r**2 / 2 * z
            second -= weight * r**3 / 3 * z
            third -= weight * r**4 / 4 * z
    return Moments(area, first, second, third)


_GAUSS: Final = (
    (0.0, 0.4179591836734694), (0.4058451513773972, 0.3818300505051189), (0.7415311855993945, 0.2797053914892767),
    (0.9491079123427585, 0.1294849661688697),
)  # fmt: skip
_PIECES: Final = 4
"""Pieces of an arc; seven nodes in each are exact to 1e-15."""


def _nodes(segment: Segment) -> list[tuple[float, float, float]]:
    """dz/dt, r and weight at Gauss's nodes along a segment."""
    nodes = [(sign * x, weight) for x, weight in _GAUSS for sign in ((1, -1) if x else (1,))]
    (z, r), (to_z, to_r) = segment.start, segment.end
    if segment.straight:
        return [(to_z - z, r + (1 + x) / 2 * (to_r - r), weight / 2) for x, weight in nodes]
    centre, radius, sweep = segment.centre, segment.radius, 4 * math.atan(segment.bulge)
    begin, step = math.atan2(r - centre.r, z - centre.z), sweep / _PIECES
    return [
        (-radius * math.sin(angle) * step, centre.r + radius * math.sin(angle), weight / 2)
        for piece in range(_PIECES)
        for x, weight in nodes
        for angle in (begin + (piece + (1 + x) / 2) * step,)
    ]


def volume(profile: Profile) -> float:
    """Volume of revolution [m³], 2π·∫r dA (Pappus–Guldin)."""
    return 2 * math.pi * moments(profile).first


def polar_moment(profile: Profile) -> float:
    """Polar moment of inertia per density [m⁵], 2π·∫r³ dA."""
    return 2 * math.pi * moments(profile).third
