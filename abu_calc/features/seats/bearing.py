"""A bearing with its two seats, in SI, as the formulas of seats take it, and the ranges in which these hold."""

from typing import TYPE_CHECKING, Final

from abu_calc.features.seats.equivalent_load import equivalent_dynamic, equivalent_static, load_factors
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.foundation.validity import Range
from abu_calc.standards.bearing_catalogue import Series
from abu_calc.standards.catalogue import CatalogueBearing, Kind, Ratings
from abu_calc.standards.tolerance_classes import NORMAL_RATIO, BearingType, DeviationLimits, RingLoad

if TYPE_CHECKING:
    from abu_calc.inputs.rolling_bearing import Bearing

BEARING_SIZE: Final = Range("bearing size", 0.0, 10.0, "m", open_low=True)
SEAT_DIAMETER: Final = Range("diameter of the seat", 0.0, 10.0, "m", open_low=True)
SEAT_LENGTH: Final = Range("length of the seat", 0.0, 10.0, "m", open_low=True)
TUBE_RATIO: Final = Range("ratio of a tube's diameters", 0.0, 0.999)
ROUGHNESS: Final = Range("roughness Rz of the seat", 0.0, 1e-3, "m")
RADIAL_LOAD: Final = Range("radial load", 0.0, 1e9, "N")
SHARE: Final = Range("share of pairs", 0.0, 1.0)
STRENGTH: Final = Range("strength of the part", 0.0, 1e10, "Pa", open_low=True)
RING_SPEED: Final = Range("ring speed", 0.0, 1e5, "rad/s")
SEAT_FRICTION: Final = Range("friction coefficient of the seat", 0.0, 1.0)


@dataclass(frozen=True)
class Ring:
    """One ring: diameter of its seat, width and chamfer of one edge [m] (None: not known), how the load meets it.

    `measured`: limits [m] in place of those of its accuracy class.
    """

    diameter: float
    width: float
    chamfer: float | None
    load: RingLoad
    measured: DeviationLimits | None = None

    def __post_init__(self) -> None:
        BEARING_SIZE.check(self.diameter)
        BEARING_SIZE.check(self.width)

    @property
    def seat_length(self) -> float | None:
        """Length of the seat between the chamfers [m]; None if they are not known."""
        return None if self.chamfer is None else self.width - 2 * self.chamfer


@dataclass(frozen=True)
class MatingPart:
    """Shaft or housing that a ring sits on or in.

    `fit` tolerance class (None: to be advised), `measured` limits [m] in its place, roughness Rz [m] (None:
    not given), `other` the part's second diameter [m]: bore of a shaft (None: solid), outside of a housing
    (None: endless), `strength` [Pa] (None: that of its material), `split` of a housing in halves.
    """

    fit: str | None
    roughness: float | None = None
    other: float | None = None
    material: str = "steel"
    measured: DeviationLimits | None = None
    strength: float | None = None
    split: bool = False

    def __post_init__(self) -> None:
        _check(ROUGHNESS, self.roughness)
        _check(STRENGTH, self.strength)


@dataclass(frozen=True)
class SeatedBearing:
    """A bearing between its shaft and its housing, and what is asked of the two seats.

    `service`: its table in the file, with the conditions that the seats must stand (None there: not counted) and
    the load that the process gives. `type` by whose table its rings are toleranced, `kind` what it is (None: not
    told), `ratings` where they are known; `remarks`: what was taken from where the table does not say it;
    `designation` ISO's, where it is known. `entry`: the row of the makers' catalogue; `no_inner_ring`: the needles
    run on the shaft. `position` along the spindle from the wheel's centre [m]; `short_shares` of pairs above which
    a seat warns, and fails. `taken_as`: the bearing that stands for sizes without a type, in a sentence. `closed`:
    with seals or shields, and so with grease.
    """

    name: str
    type: BearingType
    inner: Ring
    outer: Ring
    shaft: MatingPart
    housing: MatingPart
    service: "Bearing"
    kind: Kind | None = None
    ratings: Ratings | None = None
    bearing_class: str = "0"
    series: Series = "light"
    internal_clearance: str | None = None
    asked_interference: tuple[float, float] | None = None
    remarks: tuple[str, ...] = ()
    designation: str | None = None
    entry: CatalogueBearing | None = None
    no_inner_ring: bool = False
    position: float | None = None
    short_shares: tuple[float, float] = (0.01, 0.05)
    taken_as: str | None = None
    closed: bool = False

    def __post_init__(self) -> None:
        for share in self.short_shares:
            SHARE.check(share)
        bore, outer = self.inner.diameter, self.outer.diameter
        _ascending("shaft bore", self.shaft.other or 0.0, "bearing bore", bore)
        _ascending("bearing bore", bore, "outside diameter", outer)
        if self.housing.other is not None:
            _ascending("outside diameter", outer, "housing diameter", self.housing.other)
        _ascending("two chamfers", 2 * (self.inner.chamfer or 0), "inner ring width", self.inner.width)
        _ascending("two chamfers", 2 * (self.outer.chamfer or 0), "outer ring width", self.outer.width)
        if self.asked_interference is not None and not self.asked_interference[0] < self.asked_interference[1]:
            raise InputError("the band of interference must ascend", place=Place(key="asked_interference_um"))

    @property
    def drawn_cup(self) -> bool:
        """True for drawn-cup needle bearings: the housing gives the cup its shape and holds it."""
        return self.kind == "drawn-cup"

    @property
    def equivalent_loads(self) -> tuple[float, float] | None:
        """Equivalent dynamic and static load [N]; None without a radial load or ratings.

        An axial load that is not given is taken as none.
        """
        radial, axial = self.service.radial_load, self.service.axial_load or 0.0
        if radial is None or self.ratings is None or self.ratings.static <= 0 or self.kind is None:
            return None if radial is None else (radial, radial)
        factors, _ = load_factors(self.kind, self.entry, self.ratings, axial)
        return equivalent_dynamic(radial, axial, factors), equivalent_static(radial, axial, factors)

    @property
    def normal_load(self) -> float | None:
        """Radial load [N] taken where none is given, that of normal loads; else None, also where C is not known."""
        if self.service.radial_load is not None or self.kind is None or self.ratings is None:
            return None
        return NORMAL_RATIO * self.ratings.dynamic

    @property
    def load_ratio(self) -> float | None:
        """P/C, the equivalent load by C; None where the load or C is not known."""
        if self.equivalent_loads is None or self.ratings is None:
            return None
        # freed of rounding, so that a twentieth of C is not above it
        return round(self.equivalent_loads[0] / self.ratings.dynamic, 9)


def _check(limits: Range, value: float | None) -> None:
    if value is not None:
        limits.check(value)


def _ascending(small: str, low: float, large: str, high: float) -> None:
    if not 0 <= low < high:
        raise InputError(
            f"{large} must be above {small}",
            found=f"{large} {shown(high, 'mm', 'g')}, {small} {shown(low, 'mm', 'g')}",
            remedy="Correct the one or the other.",
        )
