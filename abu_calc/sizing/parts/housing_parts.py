"""Body, cover and race ring of a housing as turned parts, with their balls, for drawings, solids and checks alike.

Profiles of turned parts: closed lists of straight and circular segments in the half plane through the axis.

z runs along the axis from the closed web's face, r from the axis [m]. Profiles go round counter-clockwise in (z, r),
so that the material lies on the left.

Demands on a surface of a part: size, form, place, roughness. Drawings and checks read them here.
"""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import Final, Literal, NamedTuple

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, RULES, STEEL, HousingDimensions, dimensions
from abu_calc.sizing.manufacture.bearing_ring import ring_of
from abu_calc.standards.tolerance_classes import DeviationLimits

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


MATERIALS: Final = {STEEL: "steel", ALUMINIUM: "aluminium"}


@dataclass(frozen=True)
class TurnedPart:
    """A turned part: name, density [kg/m³], profile, and what is asked of its surfaces."""

    name: str
    density: float
    profile: Profile
    surfaces: tuple[Surface, ...] = ()

    @property
    def area(self) -> float:
        """Area of the half section [m²]."""
        return moments(self.profile).area

    @property
    def mass(self) -> float:
        """Mass [kg]."""
        return self.density * volume(self.profile)

    @property
    def inertia(self) -> float:
        """Polar moment of inertia [kg m²]."""
        return self.density * polar_moment(self.profile)

    @property
    def material(self) -> str:
        """Material in a word."""
        return MATERIALS[self.density]

    def surface(self, name: str) -> Surface | None:
        """Demands on the surface of that name; none: the general ones hold."""
        return next((surface for surface in self.surfaces if surface.name == name), None)


@dataclass(frozen=True)
class BallSet:
    """The balls (or rollers as long as wide): count, diameter, pitch radius, place of their plane [m]."""

    corrector: str
    count: int
    diameter: float
    mass: float
    pitch_radius: float
    z: float


@dataclass(frozen=True)
class HousingParts:
    """All parts of an autobalancer; `ring` None: the race is ground into the body."""

    design: str
    closure: str
    fastening: str
    dimensions: HousingDimensions
    body: TurnedPart
    cover: TurnedPart
    ring: TurnedPart | None
    balls: BallSet

    @property
    def turned(self) -> tuple[TurnedPart, ...]:
        """Body, ring if there is one, cover."""
        return (self.body, *((self.ring,) if self.ring else ()), self.cover)

    @property
    def race_part(self) -> TurnedPart:
        """The part that has the race."""
        return self.ring or self.body

    def thread_name(self, pitch: float) -> str:
        """The thread of the cover's seat, of a pitch [m]."""
        return f"M{from_si(2 * self.dimensions.seat_radius, 'mm'):g}×{from_si(pitch, 'mm'):g}"


def body_profile(size: HousingDimensions) -> Profile:
    """Profile of the body: hub, closed web and wall, open toward the cover."""
    hub = (
        Corner(0.0, size.bore_radius, "bore"),
        Corner(size.width, size.bore_radius, "hub end"),
        Corner(size.width, size.hub_radius, "hub"),
        Corner(size.web, size.hub_radius, "web inside"),
    )
    outside = (
        Corner(size.width, size.outer_radius, "rim"),
        Corner(0.0, size.outer_radius, "mounting face"),
    )
    if not size.has_ring:
        return closed((*hub, *_race(size), Corner(size.width, size.seat_radius, "open face"), *outside))
    # A cover that is seated beside the ring has a seat of its own on the same diameter.
    beside = size.ring_end <= size.cover_start
    seat = (
        Corner(size.web, size.ring_radius, "ring seat"),
        *((Corner(size.ring_end, size.ring_radius, "cover seat"),) if beside else ()),
        Corner(size.width, size.ring_radius, "open face"),
    )
    return closed((*hub, *seat, *outside))


def ring_profile(size: HousingDimensions) -> Profile | None:
    """Profile of the race ring; none where the race is in the body."""
    if not size.has_ring:
        return None
    end = size.ring_end
    return closed((
        *_race(size, end),
        *((Corner(end, size.seat_radius, "open face"),) if end > size.cover_start else ()),
        Corner(end, size.ring_radius, "outside"),
        Corner(size.web, size.ring_radius, "web face"),
    ))  # fmt: skip


def cover_profile(size: HousingDimensions) -> Profile:
    """Profile of the cover, a disc between the hub and its seat."""
    return closed((
        Corner(size.cover_start, size.hub_radius, "hole"),
        Corner(size.width, size.hub_radius, "outer face"),
        Corner(size.width, size.seat_radius, "outside"),
        Corner(size.cover_start, size.seat_radius, "inner face"),
    ))  # fmt: skip


def _race(size: HousingDimensions, end: float | None = None) -> tuple[Corner, ...]:
    """Corners from the closed web along the race to the cover, and along the cover's seat if the part goes on."""
    left, right = size.web, size.cover_start
    bulge = -2 * size.sagitta / size.inner_width
    start = Corner(left, size.shoulder_radius, "race", bulge)
    if end is not None and end <= right:
        return start, Corner(right, size.shoulder_radius, "open face")
    return (
        start,
        Corner(right, size.shoulder_radius, "shoulder"),
        Corner(right, size.seat_radius, "cover seat"),
    )


def housing_parts(case: Case, candidate: Candidate) -> HousingParts:
    """All parts of a candidate."""
    abu = case.autobalancer
    rules, size = RULES[abu.design], candidate_dimensions(case, candidate)
    density, ring = rules.body_density, ring_profile(size)
    return HousingParts(
        design=abu.design,
        closure=abu.closure,
        fastening=abu.fastening,
        dimensions=size,
        body=TurnedPart("body", density, body_profile(size)),
        cover=TurnedPart("cover", density, cover_profile(size)),
        ring=None if ring is None else TurnedPart("race ring", STEEL, ring),
        balls=BallSet(
            abu.corrector, candidate.ball_count, candidate.ball_diameter, candidate.ball_mass, candidate.pitch_radius,
            size.middle,
        ),
    )  # fmt: skip


def candidate_dimensions(case: Case, candidate: Candidate) -> HousingDimensions:
    """Lengths of a candidate's housing."""
    abu = case.autobalancer
    return dimensions(
        abu.design, candidate.race_radius, candidate.ball_diameter, abu.bore_diameter,
        abu.min_wall, abu.corrector == "ball", ring_of(case, candidate.race_radius),
    )  # fmt: skip
