"""Lookup of the bearing that a table describes, if the table leaves it to the standards."""

import math
from typing import TYPE_CHECKING, Final, NamedTuple

from abu_calc.features.seats.bearing import MatingPart, Ring, SeatedBearing
from abu_calc.foundation.errors import InputError, Place
from abu_calc.foundation.formula import formula
from abu_calc.foundation.units import in_file, shown
from abu_calc.foundation.validity import Range
from abu_calc.standards.bearing_catalogue import Dimensions, all_of_size, of_size, read_designation
from abu_calc.standards.catalogue import (
    ESTIMATE_ERROR,
    CatalogueBearing,
    Kind,
    Ratings,
    catalogue_bearing,
    closed,
    estimated_ratings,
)
from abu_calc.standards.internal_clearance import groups_of
from abu_calc.standards.tolerance_classes import BearingType, DeviationLimits

CUTTING_FORCE: Final = Range("cutting force", 0.0, 1e8, "N")

if TYPE_CHECKING:
    from abu_calc.inputs.rolling_bearing import Bearing as BearingTable


class _Found(NamedTuple):
    """Sizes, and what the designation says beside them; a bearing given by sizes has no designation."""

    size: Dimensions
    kind: Kind | None
    group: str | None
    accuracy: str | None
    closure: str | None = None


def from_table(table: "BearingTable") -> SeatedBearing:
    """The bearing that a table describes; a designation is looked up, what the table gives goes before it.

    A bearing given by sizes has the tolerances of radial ones unless bearing_type says tapered. If a tabulated bearing
    has its sizes, it has that one's load ratings and chamfer; else its ratings are estimated from its sizes and type.
    InputError: neither designation nor all sizes, sizes that contradict the designation or each other, an unknown
    designation, a clearance group of a bearing that has none or whose type is not told, a suffix that contradicts a
    key.
    """
    identity = _by_designation(table) if table.designation is not None else _by_sizes(table)
    size = identity.size
    like = size if size.designation else of_size(size.bore, size.outer, size.inner_width, table.bearing_type)
    inner_chamfer, outer_chamfer = _chamfers(table, like)
    group = _agreed("internal_clearance", table.internal_clearance, identity.group, table)
    _check_group(group, identity._replace(kind=identity.kind or (like.kind if like else None)))
    accuracy = _agreed("bearing_class", table.bearing_class, identity.accuracy, table) or "0"
    entry = catalogue_bearing(like.designation) if like else None
    ratings, rated = _ratings(table, size, entry)
    if entry is not None and identity.closure is not None:
        entry = closed(entry, identity.closure)
    lent = like if not size.designation and table.chamfer_mm is None else None
    service, process = _with_load(table)
    return SeatedBearing(
        name=table.name,
        type=size.type,
        kind=identity.kind or (like.kind if like else None),
        ratings=ratings,
        inner=Ring(size.bore, size.inner_width, inner_chamfer, table.inner_ring_load, _limits(table.ring_bore_limits)),
        outer=Ring(
            size.outer, size.outer_width, outer_chamfer, table.outer_ring_load, _limits(table.ring_outer_limits)
        ),
        shaft=MatingPart(
            table.shaft_fit,
            table.shaft_rz,
            table.shaft_bore,
            table.shaft_material,
            _limits(table.shaft_limits),
            table.shaft_strength,
        ),
        housing=MatingPart(
            table.housing_fit,
            table.housing_rz,
            table.housing_outer,
            table.housing_material,
            _limits(table.housing_limits),
            table.housing_strength,
            table.housing_split,
        ),
        service=service,
        bearing_class=accuracy,
        series=table.series or (size.series if size.designation else "light"),
        internal_clearance=group,
        asked_interference=table.asked_interference,
        remarks=(*process, *_angle(identity, group), *_lent(lent), *rated),
        taken_as=_taken_as(table, size, like),
        designation=size.designation or None,
        closed=identity.closure is not None,
        entry=entry,
        no_inner_ring=identity.kind == "drawn-cup" or size.designation.startswith("RNA"),
        position=table.position,
        short_shares=(table.short_pairs_warn, table.short_pairs_fail),
    )


RATIO: Final = 2.8
"""Force normal to the work over the cutting force in grinding, where none is given (Afanasiev 2015)."""


@formula(
    "Radial load of a bearing by the process",
    "F_r = F_c·√(1 + k_n²)/n",
    "N",
    where="k_n is the normal force over the cutting force; n bearings share the load alike.",
    checked=(CUTTING_FORCE,),
    assumed="forces at right angles, bearings alike",
    source="Afanasiev 2015",
)
def process_load(cutting_force: float, ratio: float, bearings: int) -> float:
    """
    >>> round(process_load(4100.0, 2.8, 4))
    3048
    """
    return CUTTING_FORCE.check(cutting_force) * math.hypot(1.0, ratio) / bearings


def _with_load(table: "BearingTable") -> "tuple[BearingTable, tuple[str, ...]]":
    """The table with the radial load that its process gives, and the process in a sentence."""
    force = table.cutting_force_N
    if force is None:
        return table, ()
    ratio = RATIO if table.normal_to_cutting_ratio is None else table.normal_to_cutting_ratio
    bearings = table.bearings_sharing or 1
    key, load = in_file("radial_load_kN", process_load(force, ratio, bearings))
    share = f", shared by {bearings} bearings" if bearings > 1 else ""
    taken = " (assumed)" if table.normal_to_cutting_ratio is None else ""
    return table.model_copy(update={key: load}), (
        f"Radial load {load:.3g} kN: cutting force {force:g} N, {ratio:g} times it normal to the work{taken}{share}.",
    )


def _by_designation(table: "BearingTable") -> _Found:
    designation = read_designation(table.designation or "")
    size = designation.size
    for key, length in (("bore_mm", size.bore), ("outer_mm", size.outer), ("width_mm", size.inner_width)):
        given, (_, value) = getattr(table, key), in_file(key, length)
        if given is not None and abs(given - value) > 1e-6:
            raise InputError(
                f"{key} contradicts the designation {table.designation}",
                found=f"{given:g}",
                allowed=f"{value:g}",
                remedy="Give the designation, or the sizes alone.",
            )
    _agreed("bearing_type", table.bearing_type, size.kind, table)
    return _Found(size, size.kind, designation.group, designation.accuracy, designation.closure)


def _by_sizes(table: "BearingTable") -> _Found:
    if table.bore_mm is None or table.outer_mm is None or table.width_mm is None:
        raise InputError(
            "the size of the bearing is not known",
            allowed="designation, or bore_mm, outer_mm and width_mm",
            remedy="Give the one or the other.",
        )
    rings: BearingType = "tapered" if table.bearing_type == "tapered" else "radial"
    size = Dimensions("", rings, table.bore, table.outer, table.width, 0.0, table.width, 0.0)
    return _Found(size, table.bearing_type, None, None)


def _chamfers(table: "BearingTable", like: Dimensions | None) -> tuple[float | None, float | None]:
    """Chamfers of the inner and the outer ring.

    They are not known if neither the table nor a tabulated bearing gives them.
    """
    if table.chamfer_mm is not None or like is None:
        return table.chamfer, table.chamfer
    return like.inner_chamfer, like.outer_chamfer


def _lent(like: Dimensions | None) -> tuple[str, ...]:
    if like is None:
        return ()
    return (f"No chamfer is given: that of {like.designation}, which has the same sizes, is taken.",)


def _angle(identity: _Found, group: str | None) -> tuple[str, ...]:
    if identity.kind != "angular-contact" or group is None or identity.size.designation:
        return ()
    return ("The contact angle of the pair is taken as 40°.",)


def _taken_as(table: "BearingTable", size: Dimensions, like: Dimensions | None) -> str | None:
    """The bearing that stands for sizes without a type, and the others that have them."""
    if size.designation or table.bearing_type is not None or like is None:
        return None
    taken = f"No bearing_type is given: {like.designation} ({like.kind}) is taken"
    same_size = all_of_size(size.bore, size.outer, size.inner_width)
    kinds = [kind for kind in dict.fromkeys(each.kind for each in same_size) if kind != like.kind]
    if not kinds:
        return f"{taken}, which has these sizes."
    others = (f"{', '.join(each.designation for each in same_size if each.kind == kind)} ({kind})" for kind in kinds)
    return f"{taken}. Other bearings have these sizes: {'; '.join(others)}. Specify bearing_type."


def _ratings(
    table: "BearingTable", size: Dimensions, entry: CatalogueBearing | None
) -> tuple[Ratings | None, tuple[str, ...]]:
    """Ratings and where they are from: what the table gives wins, then the catalogue's row, then the estimate."""
    listed = entry.ratings if entry else None
    given = table.dynamic_load_rating, table.static_load_rating
    if given[0] is not None and given[1] is not None:
        return Ratings(given[0], given[1]), ()
    named = size.kind if size.designation else table.bearing_type
    kind = entry.kind if entry else named
    if listed is None and kind is not None:
        listed = estimated_ratings(kind, size.bore, size.outer, size.inner_width)
        source = (
            f"{_both(listed)} are estimated from the sizes of the {kind} bearing, within {ESTIMATE_ERROR[kind]:.0%}."
        )
        if entry is None:
            missing = f"No ratings of {size.designation} are" if size.designation else "No bearing of these sizes is"
            source = f"{missing} in the catalogues here: {source}"
    elif listed is not None and entry is not None:
        source = f"{_both(listed)} are those of {entry.designation} ({entry.source})."
    else:
        return (None if given[0] is None else Ratings(given[0], given[1] or 0.0)), ()
    return listed._replace(dynamic=given[0] or listed.dynamic, static=given[1] or listed.static), (source,)


def _both(ratings: Ratings) -> str:
    return f"C = {shown(ratings.dynamic, 'kN')} and C0 = {shown(ratings.static, 'kN')}"


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


def _check_group(group: str | None, identity: _Found) -> None:
    if group is None:
        return
    if identity.kind is None:
        raise InputError(
            "a group of internal clearance says nothing without the type of the bearing",
            place=Place(key="bearing_type"),
            found="none",
            allowed="ball, angular-contact, cylindrical, tapered, spherical, needle",
            remedy='Give bearing_type = "ball" where it is a deep groove ball bearing, or its designation.',
        )
    designation = identity.size.designation
    if identity.kind == "angular-contact" and designation and not designation.endswith("B"):
        raise InputError(
            "the groups of pairs are tabulated for a contact angle of 40° alone (suffix B)",
            place=Place(key="internal_clearance"),
            found=f"{group} of {designation}",
            remedy="Leave internal_clearance out: its maker gives the preload of this pair.",
        )
    known = groups_of(identity.kind)
    if group in known:
        return
    article = "an" if identity.kind[0] == "a" else "a"
    what = identity.size.designation or f"{article} {identity.kind} bearing"
    why = f"that of {what} is one of {', '.join(known)}" if known else f"{what} has no group: its housing sets it"
    raise InputError(
        f"{what} has no clearance group of this name",
        place=Place(key="internal_clearance"),
        found=group,
        remedy=f"Leave internal_clearance out, or correct it: {why}.",
    )


def _limits(pair: tuple[float, ...] | None) -> DeviationLimits | None:
    return None if pair is None else DeviationLimits(*pair)
