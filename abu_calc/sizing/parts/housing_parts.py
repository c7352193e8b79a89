"""Body, cover and race ring of a housing as turned parts, with their balls, for drawings, solids and checks alike."""

from typing import Final

from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import from_si
from abu_calc.sizing.balls import Candidate
from abu_calc.sizing.case import Case
from abu_calc.sizing.housing import ALUMINIUM, RULES, STEEL, HousingDimensions, dimensions
from abu_calc.sizing.manufacture.bearing_ring import ring_of
from abu_calc.sizing.parts.profile import Corner, Profile, closed, moments, polar_moment, volume
from abu_calc.sizing.parts.surfaces import Surface

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
