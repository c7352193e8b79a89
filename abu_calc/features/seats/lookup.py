"""Lookup of the bearing that a table describes, if the table leaves it to the standards."""

from typing import TYPE_CHECKING, NamedTuple

from abu_calc.features.seats.bearing import MatingPart, Ring, SeatedBearing, Service
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.units import from_si, to_si
from abu_calc.standards.bearing_catalogue import GROUPS, Dimensions, of_size, read_designation
from abu_calc.standards.tables import unknown
from abu_calc.standards.tolerance_classes import BearingType, DeviationLimits, Kind, Ratings, load_ratings

if TYPE_CHECKING:
    from abu_calc.inputs.rolling_bearing import Bearing as BearingTable


class _Found(NamedTuple):
    """Sizes, and what the designation says beside them; a bearing given by sizes has no designation."""

    size: Dimensions
    kind: Kind | None
    group: str | None
    accuracy: str | None


def from_table(table: "BearingTable") -> SeatedBearing:
    """The bearing that a table describes; a designation is looked up, what the table gives goes before it.

    A bearing given by sizes has the tolerances of radial ones unless bearing_type says tapered; without a chamfer it
    has that of the tabulated bearing of its sizes, if there is one. InputError: neither designation nor all sizes,
    sizes that contradict the designation or each other, an unknown designation, a clearance group of a bearing that
    has none or whose type is not told, a suffix that contradicts a key.
    """
    identity = _by_designation(table) if table.designation is not None else _by_sizes(table)
    size = identity.size
    like = size if size.designation else of_size(size.bore, size.outer, size.inner_width)
    inner_chamfer, outer_chamfer = _chamfers(table, like)
    group = _agreed("internal_clearance", table.internal_clearance, identity.group, table)
    _check_group(group, identity, table)
    accuracy = _agreed("bearing_class", table.bearing_class, identity.accuracy, table) or "0"
    ratings, rated = _ratings(table, size)
    lent = like if not size.designation and table.chamfer_mm is None else None
    asked = table.asked_interference_um
    return SeatedBearing(
        name=table.name,
        type=size.type,
        kind=identity.kind,
        ratings=ratings,
        inner=Ring(size.bore, size.inner_width, inner_chamfer, table.inner_ring_load),
        outer=Ring(size.outer, size.outer_width, outer_chamfer, table.outer_ring_load),
        shaft=MatingPart(
            table.shaft_fit,
            _si(table.shaft_rz_um, "um"),
            _si(table.shaft_bore_mm, "mm"),
            table.shaft_material,
            _limits(table.shaft_limits_um),
            _si(table.shaft_strength_MPa, "MPa"),
        ),
        housing=MatingPart(
            table.housing_fit,
            _si(table.housing_rz_um, "um"),
            _si(table.housing_outer_mm, "mm"),
            table.housing_material,
            _limits(table.housing_limits_um),
            _si(table.housing_strength_MPa, "MPa"),
            table.housing_split,
        ),
        service=_service(table),
        bearing_class=accuracy,
        series=table.series or (size.series if size.designation else "light"),
        internal_clearance=group,
        asked_interference=None if asked is None else (to_si(asked[0], "um"), to_si(asked[1], "um")),
        remarks=(*_lent(lent), *rated),
        designation=size.designation or None,
    )


def _service(table: "BearingTable") -> Service:
    return Service(
        radial_load=_si(table.radial_load_kN, "kN"),
        speed=_si(table.speed_rpm, "rpm"),
        ring_over_shaft=_si(table.ring_temperature_difference_K, "K"),
        inner_over_outer=_si(table.raceway_temperature_difference_K, "K"),
        housing_over_ring=_si(table.housing_temperature_difference_K, "K"),
        over_mounting=_si(table.temperature_rise_K, "K"),
        starting_torque=_si(table.starting_torque_N_m, "N_m"),
        seat_friction=table.seat_friction,
    )


def _by_designation(table: "BearingTable") -> _Found:
    designation = read_designation(table.designation or "")
    size = designation.size
    for key, value in (("bore_mm", size.bore), ("outer_mm", size.outer), ("width_mm", size.inner_width)):
        given = getattr(table, key)
        if given is not None and abs(given - from_si(value, "mm")) > 1e-6:
            raise InputError(
                f"{key} contradicts the designation {table.designation}",
                found=f"{given:g}",
                allowed=f"{from_si(value, 'mm'):g}",
                remedy="Give the designation, or the sizes alone.",
            )
    _agreed("bearing_type", table.bearing_type, size.kind, table)
    return _Found(size, size.kind, designation.group, designation.accuracy)


def _by_sizes(table: "BearingTable") -> _Found:
    if table.bore_mm is None or table.outer_mm is None or table.width_mm is None:
        raise InputError(
            "the size of the bearing is not known",
            allowed="designation, or bore_mm, outer_mm and width_mm",
            remedy="Give the one or the other.",
        )
    bore, outer, width = (to_si(size, "mm") for size in (table.bore_mm, table.outer_mm, table.width_mm))
    rings: BearingType = "tapered" if table.bearing_type == "tapered" else "radial"
    size = Dimensions("", rings, bore, outer, width, 0.0, width, 0.0)
    return _Found(size, table.bearing_type, None, None)


def _chamfers(table: "BearingTable", like: Dimensions | None) -> tuple[float | None, float | None]:
    """Chamfers of the inner and the outer ring.

    They are not known if neither the table nor a tabulated bearing gives them.
    """
    if table.chamfer_mm is not None or like is None:
        given = _si(table.chamfer_mm, "mm")
        return given, given
    return like.inner_chamfer, like.outer_chamfer


def _lent(like: Dimensions | None) -> tuple[str, ...]:
    if like is None:
        return ()
    return (f"No chamfer is given: that of {like.designation}, which has the same sizes, is taken.",)


def _ratings(table: "BearingTable", size: Dimensions) -> tuple[Ratings | None, tuple[str, ...]]:
    """Given ones win; with C0 alone given, C is still looked up."""
    listed = load_ratings(size.designation)
    dynamic = _si(table.dynamic_load_rating_kN, "kN") or (listed.dynamic if listed else None)
    static = _si(table.static_load_rating_kN, "kN") or (listed.static if listed else None)
    if dynamic is None:
        return None, ()
    if table.dynamic_load_rating_kN is not None:
        return Ratings(dynamic, static or 0.0), ()
    return Ratings(dynamic, static or 0.0), (
        f"C = {from_si(dynamic, 'kN'):g} kN of {size.designation} is the SKF General Catalogue's of 2006.",
    )


def _agreed(key: str, given: str | None, named: str | None, table: "BearingTable") -> str | None:
    """Value that the key gives or the designation names; refused if they differ."""
    if given is not None and named is not None and given != named:
        raise InputError(
            f"{key} contradicts the designation {table.designation}",
            place=Place(key=key),
            found=given,
            allowed=named,
            remedy=f"Leave {key} out, or mend the designation.",
        )
    return given if given is not None else named


def _check_group(group: str | None, identity: _Found, table: "BearingTable") -> None:
    if group is None or (identity.kind == "ball" and group in GROUPS):
        return
    if identity.kind == "ball":
        raise unknown("clearance group", group, GROUPS)
    if identity.kind is None:
        raise InputError(
            "a group of radial clearance says nothing without the type of the bearing",
            place=Place(key="bearing_type"),
            found="none",
            allowed="ball, angular-contact, cylindrical, tapered, spherical",
            remedy='Give bearing_type = "ball" where it is a deep groove ball bearing, or its designation.',
        )
    what = identity.size.designation or f"a {identity.kind} bearing"
    settled = identity.kind in ("tapered", "angular-contact")
    why = "the clearance of such a bearing is set when it is mounted" if settled else "its table is not held here"
    raise InputError(
        f"the groups of radial clearance are those of deep groove ball bearings, {what} is none",
        place=Place(key="internal_clearance"),
        found=group,
        remedy=f"Leave internal_clearance out: {why}.",
    )


def _limits(pair: tuple[float, ...] | None) -> DeviationLimits | None:
    return None if pair is None else DeviationLimits(to_si(pair[0], "um"), to_si(pair[1], "um"))


def _si(value: float | None, unit: str) -> float | None:
    return None if value is None else to_si(value, unit)
