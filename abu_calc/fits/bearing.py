"""A bearing with its two seats, in SI, as the formulas of this room take it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from abu_calc.errors import InputError, Place
from abu_calc.standards.bearings import Dimensions, bearing, of_size
from abu_calc.standards.limits import BearingType
from abu_calc.units import from_si, to_si
from abu_calc.validity import Range

if TYPE_CHECKING:
    from abu_calc.spec.bearing import Bearing as BearingTable

RingLoad = Literal["rotating", "stationary", "indeterminate"]
Series = Literal["light", "medium", "heavy"]

_SIZE = Range("bearing size", 0.0, 10.0, "m", open_low=True)
_OTHERS = (
    ("radial_load", Range("radial load", 0.0, 1e9, "N")),
    ("shaft_roughness", Range("shaft roughness Rz", 0.0, 1e-3, "m")),
    ("housing_roughness", Range("housing roughness Rz", 0.0, 1e-3, "m")),
    ("temperature_difference", Range("ring temperature difference", 0.0, 500.0, "K")),
    ("raceway_temperature_difference", Range("raceway temperature difference", 0.0, 500.0, "K")),
    ("starting_torque", Range("starting torque", 0.0, 1e7, "N·m")),
    ("seat_friction", Range("friction coefficient of the seat", 0.0, 1.0)),
    ("speed", Range("ring speed", 0.0, 1e5, "rad/s")),
)


@dataclass(frozen=True)
class Bearing:
    """A bearing and its seats. Lengths [m], load [N], speed [rad/s], temperature [K]; None: not given.

    `temperature_difference` is by how much the inner ring is warmer than its shaft, `raceway_temperature_difference`
    by how much it is warmer than the outer ring. `chamfer_from` names the tabulated bearing of the same sizes that
    lends its chamfers.
    """

    name: str
    type: BearingType
    bore: float
    outer: float
    inner_width: float
    outer_width: float
    inner_chamfer: float | None
    outer_chamfer: float | None
    shaft_fit: str
    housing_fit: str
    bearing_class: str = "0"
    series: Series = "light"
    inner_ring_load: RingLoad = "rotating"
    outer_ring_load: RingLoad = "stationary"
    radial_load: float | None = None
    shaft_roughness: float | None = None
    housing_roughness: float | None = None
    temperature_difference: float | None = None
    speed: float | None = None
    shaft_bore: float = 0.0
    housing_outer: float | None = None
    housing_material: str = "steel"
    internal_clearance: str | None = None
    raceway_temperature_difference: float | None = None
    starting_torque: float | None = None
    seat_friction: float = 0.12
    asked_interference: tuple[float, float] | None = None
    chamfer_from: str | None = None

    def __post_init__(self) -> None:
        for size in (self.bore, self.outer, self.inner_width, self.outer_width):
            _SIZE.check(size)
        for attribute, limits in _OTHERS:
            value = getattr(self, attribute)
            if value is not None:
                limits.check(value)
        _ascending("shaft bore", self.shaft_bore, "bearing bore", self.bore)
        _ascending("bearing bore", self.bore, "outside diameter", self.outer)
        if self.housing_outer is not None:
            _ascending("outside diameter", self.outer, "housing diameter", self.housing_outer)
        _ascending("two chamfers", 2 * (self.inner_chamfer or 0), "inner ring width", self.inner_width)
        _ascending("two chamfers", 2 * (self.outer_chamfer or 0), "outer ring width", self.outer_width)
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
        bore=size.bore,
        outer=size.outer,
        inner_width=size.inner_width,
        outer_width=size.outer_width,
        inner_chamfer=inner_chamfer,
        outer_chamfer=outer_chamfer,
        shaft_fit=table.shaft_fit,
        housing_fit=table.housing_fit,
        bearing_class=table.bearing_class,
        series=table.series,
        inner_ring_load=table.inner_ring_load,
        outer_ring_load=table.outer_ring_load,
        radial_load=_si(table.radial_load_kN, "kN"),
        shaft_roughness=_si(table.shaft_rz_um, "um"),
        housing_roughness=_si(table.housing_rz_um, "um"),
        temperature_difference=_si(table.ring_temperature_difference_K, "K"),
        speed=_si(table.speed_rpm, "rpm"),
        shaft_bore=_si(table.shaft_bore_mm, "mm") or 0.0,
        housing_outer=_si(table.housing_outer_mm, "mm"),
        housing_material=table.housing_material,
        internal_clearance=table.internal_clearance,
        raceway_temperature_difference=_si(table.raceway_temperature_difference_K, "K"),
        starting_torque=_si(table.starting_torque_N_m, "N_m"),
        seat_friction=table.seat_friction,
        asked_interference=None if asked is None else (to_si(asked[0], "um"), to_si(asked[1], "um")),
        chamfer_from=like.designation if lent and like else None,
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
    """Of the inner and the outer ring; not known where neither the table nor a tabulated bearing tells."""
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


def _si(value: float | None, unit: str) -> float | None:
    return None if value is None else to_si(value, unit)


def _ascending(small: str, low: float, large: str, high: float) -> None:
    if not 0 <= low < high:
        raise InputError(
            f"{large} must be above {small}",
            found=f"{large} {from_si(high, 'mm'):g} mm, {small} {from_si(low, 'mm'):g} mm",
            remedy="Correct the one or the other.",
        )
