"""Notes beside the numbers of a seat: the list of losses, the source of advice, sorting."""

from typing import TYPE_CHECKING, NamedTuple

from abu_calc.fits.bearing import Bearing
from abu_calc.fits.intensity import advised_class
from abu_calc.fits.interference import Interval
from abu_calc.fits.joint import MEASURED, WARMTH, Joint, Loss
from abu_calc.fits.pairing import makers_classes
from abu_calc.fits.requirement import catalogue_smoothing_loss
from abu_calc.standards.maker_fits import SOURCE
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.selective import Selection
    from abu_calc.fits.whole import SeatAdvice


class Item(NamedTuple):
    """An entry of the ledger of losses; `counted` in the required interference, or shown beside it."""

    loss: Loss
    counted: bool


def ledger(joint: Joint) -> tuple[Item, ...]:
    """The load by both rules, of which the larger counts, then the losses given, each by its formula; gains by warmth
    do not count."""
    needs = joint.required.by if joint.required else None
    items = [Item(Loss("load", bound.value, bound.by), bound.by == needs) for bound in joint.criteria]
    for loss in joint.losses:
        items.append(Item(loss, loss.value > 0 or loss.name != WARMTH))
        if loss.name == "smoothing":
            value = catalogue_smoothing_loss(joint.interference.smallest, joint.diameter)
            items.append(Item(Loss("smoothing", value, "δ·2/(d + 2) (bearing catalogues, unverified)"), False))
    return tuple(items)


def seat_notes(
    bearing: Bearing,
    joint: Joint,
    own: "SeatAdvice",
    given: bool,
    intensity: float | None,
    asked: Interval | None,
    selection: "Selection | None",
) -> tuple[str, ...]:
    """The notes of a seat, what concerns the bearing alike for both."""
    return (
        *_needs(joint),
        *_load(bearing, joint, intensity),
        *bearing.remarks,
        *_advised(bearing, joint, own, given),
        *_sorting(joint, asked, selection),
    )


def _needs(joint: Joint) -> tuple[str, ...]:
    if not joint.must_grip or not joint.criteria:
        return ()
    needs = ", ".join(f"{from_si(criterion.value, 'um'):.2f} µm by {criterion.by}" for criterion in joint.criteria)
    return (f"A ring under a rotating load needs, losses aside: {needs}; the larger counts.",)


def _load(bearing: Bearing, joint: Joint, intensity: float | None) -> tuple[str, ...]:
    if intensity is None:
        return ()
    static = bearing.ratings.static if bearing.ratings else 0.0
    heavy = joint.must_grip and joint.radial_load is not None and 0 < static < 4 * joint.radial_load
    field = advised_class(joint.seat, joint.diameter, intensity)
    advice = f"handbook tables advise {field}" if field else "outside the handbook tables"
    return (
        f"k = {joint.factor:g} of the {bearing.series} series is an unverified handbook value.",
        f"Load intensity {from_si(intensity, 'kN_per_m'):.0f} kN/m with strong shocks: {advice} (unverified advice).",
        *(("The load is above a quarter of C0: catalogues then take 0.02·F_r/B for what it takes.",) if heavy else ()),
    )


def _advised(bearing: Bearing, joint: Joint, own: "SeatAdvice", given: bool) -> tuple[str, ...]:
    best = own.best.tolerance_class if own.best else None
    notes = (
        [] if given or best is None else [f"No fit of the {joint.seat} is given: {best}, the one to write, is judged."]
    )
    if joint.maker is not None and bearing.load_ratio is not None:
        remark = f"; {joint.maker.note}" if joint.maker.note else ""
        named = (*joint.maker.classes[1:], *joint.maker.special)
        others = f", also {', '.join(named)}" if named else ""
        notes.append(
            f"{SOURCE}: {joint.maker.classes[0]}{others} for a {bearing.kind} bearing, P/C = {bearing.load_ratio:.2g}, "
            f"load {joint.ring.load}, seat of {from_si(joint.diameter, 'mm'):g} mm{remark}."
        )
        if best not in (None, *joint.maker.classes, *joint.maker.special):
            notes.append(f"{best} is written in place of {joint.maker.classes[0]}, whose grip or stress does not do.")
    elif (usual := makers_classes(bearing, joint.seat)) is not None and best in usual.classes:
        kind = bearing.kind or "ball"
        what = "the load" if joint.radial_load is None else "C"
        if not joint.must_grip or joint.required is None:
            notes.append(
                f"{what.capitalize()} is not known: {best} is {SOURCE}'s for a {kind} bearing under normal load."
            )
    if joint.fit_name == MEASURED:
        notes.append(f"The limits of the {joint.seat} are as measured, the ring's are those of a new bearing.")
    return tuple(notes)


def _sorting(joint: Joint, asked: Interval | None, selection: "Selection | None") -> tuple[str, ...]:
    if asked is None:
        return ()
    band = f"{from_si(asked.smallest, 'um'):g} … {from_si(asked.largest, 'um'):g} µm"
    if selection is None:
        male, female = joint.male_and_female
        ends = sorted((male.lower - female.lower, male.upper - female.upper))
        reach = " … ".join(f"{from_si(end, 'um'):g}" for end in ends)
        return (
            f"Sorting cannot keep {joint.fit_name} within {band}: however fine the groups, they spread over "
            f"{reach} µm, the band must reach beyond both.",
        )
    if selection.groups == 1:
        return (f"{joint.fit_name} keeps within {band} without sorting.",)
    reached = (
        f"{from_si(selection.interference.smallest, 'um'):.3g} … {from_si(selection.interference.largest, 'um'):.3g}"
    )
    return (
        f"Selective assembly: sorted into {selection.groups} equal groups and matched by number, "
        f"{joint.fit_name} keeps within {reached} µm (asked {band}){_after(joint, selection)}.",
    )


def _after(joint: Joint, selection: "Selection") -> str:
    """The verdict on the pairs after sorting."""
    if not joint.must_grip or joint.required is None:
        return ""
    least, needed = selection.interference.smallest, joint.required.value
    if least >= needed:
        return f": every pair holds, {from_si(needed, 'um'):.3g} µm are needed"
    lack, all_of_it = from_si(needed - least, "um"), from_si(needed, "um")
    return f": the loosest pairs still lack {lack:.2g} µm of the {all_of_it:.3g} needed"
