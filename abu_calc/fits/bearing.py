"""A bearing with its two seats, in SI, as the formulas of this room take it."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from abu_calc.errors import InputError, Place
from abu_calc.fits.ranges import (
    BEARING_SIZE,
    RADIAL_LOAD,
    RING_SPEED,
    ROUGHNESS,
    SEAT_FRICTION,
    STARTING_TORQUE,
    WARMER_INSIDE,
    WARMER_RING,
)
from abu_calc.standards.bearings import Dimensions, bearing, of_size
from abu_calc.standards.limits import BearingType
from abu_calc.units import from_si, to_si
from abu_calc.validity import Range

if TYPE_CHECKING:
    from abu_calc.spec.bearing import Bearing as BearingTable

RingLoad = Literal["rotating", "stationary", "indeterminate"]
Series = Literal["light", "medium", "heavy"]


@dataclass(frozen=True)
class Ring:
    """One ring: diameter of its seat, width and chamfer of one edge [m] (None: not known), how the load meets it."""

    diameter: float
    width: float
    chamfer: float | None
    load: RingLoad

    def __post_init__(self) -> None:
        BEARING_SIZE.check(self.diameter)
        BEARING_SIZE.check(self.width)

    @property
    def seat_length(self) -> float | None:
        """Between the chamfers [m]; None where they are not known."""
        return None if self.chamfer is None else self.width - 2 * self.chamfer


@dataclass(frozen=True)
class Shaft:
    """What the inner ring sits on: tolerance class, roughness Rz [m] (None: not given), bore [m] (0: solid)."""

    fit: str
    roughness: float | None = None
    bore: float = 0.0

    def __post_init__(self) -> None:
        _check(ROUGHNESS, self.roughness)


@dataclass(frozen=True)
class Housing:
    """What the outer ring sits in: tolerance class, roughness Rz and outer diameter [m] (None: not given), material."""

    fit: str
    roughness: float | None = None
    outer: float | None = None
    material: str = "steel"

    def __post_init__(self) -> None:
        _check(ROUGHNESS, self.roughness)


@dataclass(frozen=True)
class Service:
    """What the seats must stand [SI]; None: not given, and then not counted.

    `ring_over_shaft` and `inner_over_outer` are by how much the inner ring is warmer [K], `seat_friction` the
    coefficient of friction between ring and seat.
    """

    radial_load: float | None = None
    speed: float | None = None
    ring_over_shaft: float | None = None
    inner_over_outer: float | None = None
    starting_torque: float | None = None
    seat_friction: float = 0.12

    def __post_init__(self) -> None:
        _check(RADIAL_LOAD, self.radial_load)
        _check(RING_SPEED, self.speed)
        _check(WARMER_RING, self.ring_over_shaft)
        _check(WARMER_INSIDE, self.inner_over_outer)
        _check(STARTING_TORQUE, self.starting_torque)
        SEAT_FRICTION.check(self.seat_friction)


@dataclass(frozen=True)
class Bearing:
    """A bearing between its shaft and its housing, and what is asked of the two seats.

    `chamfer_from` names the tabulated bearing of the same sizes that lends its chamfers.
    """

    name: str
    type: BearingType
    inner: Ring
    outer: Ring
    shaft: Shaft
    housing: Housing
    service: Service = field(default_factory=Service)
    bearing_class: str = "0"
    series: Series = "light"
    internal_clearance: str | None = None
    asked_interference: tuple[float, float] | None = None
    chamfer_from: str | None = None

    def __post_init__(self) -> None:
        bore, outer = self.inner.diameter, self.outer.diameter
        _ascending("shaft bore", self.shaft.bore, "bearing bore", bore)
        _ascending("bearing bore", bore, "outside diameter", outer)
        if self.housing.outer is not None:
            _ascending("outside diameter", outer, "housing diameter", self.housing.outer)
        _ascending("two chamfers", 2 * (self.inner.chamfer or 0), "inner ring width", self.inner.width)
        _ascending("two chamfers", 2 * (self.outer.chamfer or 0), "outer ring width", self.outer.width)
        if self.asked_interference is not None and not self.asked_interference[0] < self.asked_interference[1]:
            raise InputError("the band of interference must ascend", place=Place(key="asked_interference_um"))


def from_table(table: "BearingTable") -> Bearing:
    """The bearing that a table describes; a designation is looked up, an explicit chamfer goes before its own.

    A bearing given by sizes alone is taken as radial; without a chamfer it has that of the tabulated bearing of its
    sizes, if there is one. InputError: neither designation nor all sizes, sizes that contradict the designation or
    each other, an unknown designation, a clearance group of a bearing that has none.
    """
    size = _by_designation(table) if table.designation is not None else _by_sizes(table)
    like = size if table.designation is not None else of_size(size.bore, size.outer, size.inner_width)
    inner_chamfer, outer_chamfer = _chamfers(table, like)
    _check_group(table, size)
    lent = table.designation is None and table.chamfer_mm is None and like is not None
    asked = table.asked_interference_um
    return Bearing(
        name=table.name,
        type=size.type,
        inner=Ring(size.bore, size.inner_width, inner_chamfer, table.inner_ring_load),
        outer=Ring(size.outer, size.outer_width, outer_chamfer, table.outer_ring_load),
        shaft=Shaft(table.shaft_fit, _si(table.shaft_rz_um, "um"), _si(table.shaft_bore_mm, "mm") or 0.0),
        housing=Housing(
            table.housing_fit,
            _si(table.housing_rz_um, "um"),
            _si(table.housing_outer_mm, "mm"),
            table.housing_material,
        ),
        service=_service(table),
        bearing_class=table.bearing_class,
        series=table.series,
        internal_clearance=table.internal_clearance,
        asked_interference=None if asked is None else (to_si(asked[0], "um"), to_si(asked[1], "um")),
        chamfer_from=like.designation if lent and like else None,
    )


def _service(table: "BearingTable") -> Service:
    return Service(
        radial_load=_si(table.radial_load_kN, "kN"),
        speed=_si(table.speed_rpm, "rpm"),
        ring_over_shaft=_si(table.ring_temperature_difference_K, "K"),
        inner_over_outer=_si(table.raceway_temperature_difference_K, "K"),
        starting_torque=_si(table.starting_torque_N_m, "N_m"),
        seat_friction=table.seat_friction,
    )


def _by_designation(table: "BearingTable") -> Dimensions:
    found = bearing(table.designation or "")
    for key, value in (("bore_mm", found.bore), ("outer_mm", found.outer), ("width_mm", found.inner_width)):
        given = getattr(table, key)
        if given is not None and abs(given - from_si(value, "mm")) > 1e-6:
            raise InputError(
                f"{key} contradicts the designation {table.designation}",
                found=f"{given:g}",
                allowed=f"{from_si(value, 'mm'):g}",
                remedy="Give the designation, or the sizes alone.",
            )
    return found


def _by_sizes(table: "BearingTable") -> Dimensions:
    if table.bore_mm is None or table.outer_mm is None or table.width_mm is None:
        raise InputError(
            "the size of the bearing is not known",
            allowed="designation, or bore_mm, outer_mm and width_mm",
            remedy="Give the one or the other.",
        )
    bore, outer, width = (to_si(size, "mm") for size in (table.bore_mm, table.outer_mm, table.width_mm))
    return Dimensions("", "radial", bore, outer, width, 0.0, width, 0.0)


def _chamfers(table: "BearingTable", like: Dimensions | None) -> tuple[float | None, float | None]:
    """Of the inner and the outer ring; not known where neither the table nor a tabulated bearing has them."""
    if table.chamfer_mm is not None or like is None:
        given = _si(table.chamfer_mm, "mm")
        return given, given
    return like.inner_chamfer, like.outer_chamfer


def _check_group(table: "BearingTable", size: Dimensions) -> None:
    if table.internal_clearance is not None and size.designation and not size.deep_groove:
        raise InputError(
            f"the groups of radial clearance are those of deep groove ball bearings, {size.designation} is none",
            place=Place(key="internal_clearance"),
            found=table.internal_clearance,
            remedy="Leave internal_clearance out: the clearance of such a bearing is set when it is mounted.",
        )


def _check(limits: Range, value: float | None) -> None:
    if value is not None:
        limits.check(value)


def _si(value: float | None, unit: str) -> float | None:
    return None if value is None else to_si(value, unit)


def _ascending(small: str, low: float, large: str, high: float) -> None:
    if not 0 <= low < high:
        raise InputError(
            f"{large} must be above {small}",
            found=f"{large} {from_si(high, 'mm'):g} mm, {small} {from_si(low, 'mm'):g} mm",
            remedy="Correct the one or the other.",
        )
