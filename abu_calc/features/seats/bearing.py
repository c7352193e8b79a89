"""A bearing with its two seats, in SI, as the formulas of seats take it, and the ranges in which these hold.

Equivalent dynamic and static load of a bearing under a radial and an axial load (ISO 281, ISO 76).
"""

from bisect import bisect_left
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.units import shown
from abu_calc.foundation.validity import Range
from abu_calc.standards.bearing_catalogue import Series
from abu_calc.standards.catalogue import CatalogueBearing, Kind, Ratings
from abu_calc.standards.tolerance_classes import NORMAL_RATIO, BearingType, DeviationLimits, RingLoad

if TYPE_CHECKING:
    from abu_calc.inputs.rolling_bearing import Bearing


LOADS: Final = Range("load of the bearing", 0.0, 1e9, "N")


class LoadFactors(NamedTuple):
    """Factors of the equivalent loads: P = F_r up to e, X·F_r + Y·F_a above; P0 = X0·F_r + Y0·F_a, F_r at least.

    `below`: Y up to e, which spherical roller bearings have.
    """

    e: float
    X: float
    Y: float
    X0: float
    Y0: float
    below: float = 0.0


_BALL: Final = (
    (0.172, 0.19, 2.30), (0.345, 0.22, 1.99), (0.689, 0.26, 1.71), (1.03, 0.28, 1.55), (1.38, 0.30, 1.45),
    (2.07, 0.34, 1.31), (3.45, 0.38, 1.15), (5.17, 0.42, 1.04), (6.89, 0.44, 1.00),
)  # fmt: skip
"""f0·F_a/C0, e and Y of deep groove ball bearings."""
_FIFTEEN: Final = (
    (0.178, 0.38, 1.47), (0.357, 0.40, 1.40), (0.714, 0.43, 1.30), (1.07, 0.46, 1.23), (1.43, 0.47, 1.19),
    (2.14, 0.50, 1.12), (3.57, 0.55, 1.02), (5.35, 0.56, 1.00), (7.14, 0.56, 1.00),
)  # fmt: skip
"""The same of angular contact ball bearings of 15°."""
_USUAL_F0: Final = 14.0
_TAPERED: Final = LoadFactors(0.37, 0.4, 1.6, 0.5, 0.9)
"""Factors of a usual tapered bearing (302, 322 of middle size), where no row gives them."""


def load_factors(
    kind: Kind, entry: CatalogueBearing | None, ratings: Ratings, axial: float
) -> tuple[LoadFactors | None, bool]:
    """Factors of a bearing, and whether they are its own; None for bearings that carry no axial load.

    Source: ISO 281:2007, table 3 and ISO 76:2006, as the makers print them; tapered and spherical ones by their rows.
    """
    own = entry is not None
    if kind == "ball":
        f0 = entry.f0 if entry and entry.f0 else _USUAL_F0
        e, Y = _between(_BALL, f0 * axial / ratings.static)
        return LoadFactors(e, 0.56, Y, 0.6, 0.5), own
    if kind == "angular-contact":
        if entry is None or (entry.e is None and entry.f0 is not None):
            f0 = entry.f0 if entry and entry.f0 else _USUAL_F0
            e, Y = _between(_FIFTEEN, f0 * axial / ratings.static)
            return LoadFactors(e, 0.44, Y, 0.5, 0.46), own
        steep = entry.e is not None and entry.e > 1
        return (LoadFactors(1.14, 0.35, 0.57, 0.5, 0.26) if steep else LoadFactors(0.68, 0.41, 0.87, 0.5, 0.38)), own
    row = entry if entry and entry.e is not None and entry.Y is not None and entry.Y0 is not None else None
    if kind == "tapered":
        if row is None or row.e is None or row.Y is None or row.Y0 is None:
            return _TAPERED, False
        return LoadFactors(row.e, 0.4, row.Y, 0.5, row.Y0), True
    if kind == "spherical":
        if row is None or row.e is None or row.Y is None or row.Y0 is None:
            return LoadFactors(0.3, 0.67, 3.3, 1.0, 2.2, 2.2), False
        return LoadFactors(row.e, 0.67, 1.5 * row.Y, 1.0, row.Y0, row.Y), True
    if carries_by_flanges(entry):
        # Other series than 10, 2, 3 and 4 are wide.
        wide = entry is not None and entry.designation.lstrip("NJUP")[:2] in ("22", "23")
        return (LoadFactors(0.3, 0.92, 0.4, 1.0, 0.0) if wide else LoadFactors(0.2, 0.92, 0.6, 1.0, 0.0)), own
    return None, own


def carries_by_flanges(entry: CatalogueBearing | None) -> bool:
    """True for cylindrical roller bearings whose flanges carry axial loads: NJ in one direction, NUP in both."""
    return entry is not None and entry.designation.startswith(("NJ", "NUP"))


def _between(table: tuple[tuple[float, float, float], ...], place: float) -> tuple[float, float]:
    """e and Y at f0·F_a/C0, linear between the rows, constant outside."""
    if place <= table[0][0]:
        return table[0][1:]
    if place >= table[-1][0]:
        return table[-1][1:]
    upper = bisect_left(table, place, key=lambda row: row[0])
    (low, e_low, Y_low), (high, e_high, Y_high) = table[upper - 1], table[upper]
    share = (place - low) / (high - low)
    return e_low + share * (e_high - e_low), Y_low + share * (Y_high - Y_low)


@formula(
    "Equivalent dynamic load of a bearing",
    "P = X_b·F_r + Y_b·F_a",
    "N",
    where=(
        "Up to F_a/F_r = e, X_b is 1 and Y_b is 0 (spherical roller bearings: Y1). Above it, X_b and Y_b are the "
        "factors of the type. Those of ball bearings depend on f0·F_a/C0. NU, N and needle roller bearings carry no "
        "axial load, so that P is F_r. NJ and NUP carry up to half of F_r (SKF General Catalogue, 2006)."
    ),
    checked=(LOADS,),
    source="ISO 281:2007",
)
def equivalent_dynamic(radial: float, axial: float, factors: LoadFactors | None) -> float:
    """
    >>> round(equivalent_dynamic(2500.0, 1000.0, LoadFactors(0.268, 0.56, 1.666, 0.6, 0.5)))
    3066
    """
    LOADS.check(radial)
    if factors is None or not LOADS.check(axial):
        return radial
    if axial <= factors.e * radial:
        return radial + factors.below * axial
    return factors.X * radial + factors.Y * axial


@formula(
    "Equivalent static load of a bearing",
    "P_0 = max(X_0·F_r + Y_0·F_a, F_r)",
    "N",
    checked=(LOADS,),
    source="ISO 76:2006",
)
def equivalent_static(radial: float, axial: float, factors: LoadFactors | None) -> float:
    """
    >>> equivalent_static(1000.0, 2000.0, LoadFactors(0.3, 0.56, 1.5, 0.6, 0.5))
    1600.0
    """
    if factors is None:
        return LOADS.check(radial)
    return max(factors.X0 * LOADS.check(radial) + factors.Y0 * LOADS.check(axial), radial)


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
