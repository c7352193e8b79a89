"""The checks of a seat, and of the clearance left in its bearing."""

import math
from typing import TYPE_CHECKING, Final

from abu_calc.features.seats.bearing import SeatedBearing, carries_by_flanges
from abu_calc.features.seats.clearance import MOST
from abu_calc.features.seats.creep import Creep
from abu_calc.features.seats.interference import Interval, of_all, um
from abu_calc.features.seats.joint import ARTICLE, BEYOND_ROWS, LOOSE_ENOUGH, TEMPERATURE, Joint
from abu_calc.features.seats.joints import ROOM, USUAL_RISE, assumes_warmth
from abu_calc.features.seats.notes import selective_groups
from abu_calc.features.seats.rating_life import GUIDE_LIFE, RatingLife
from abu_calc.foundation.checks import Action, Check, Finding, coded, verdict
from abu_calc.foundation.units import shown, to_si
from abu_calc.standards.balls import seat_material
from abu_calc.standards.catalogue import ROLLERS
from abu_calc.standards.internal_clearance import groups_of, preload_limits
from abu_calc.standards.tolerance_classes import source_of

if TYPE_CHECKING:
    from abu_calc.features.seats.clearance import Clearance

_CODES: Final = {
    "shaft": ("ABU601", "ABU602", "ABU603", "ABU604", "ABU605"),
    "housing": ("ABU611", "ABU612", "ABU613", "ABU614", "ABU615"),
}
_LIKE_STEEL: Final = 3e-6
"""Difference of expansion [1/K] from the ring's that is nothing to warn of: cast iron's."""
_KEPT: Final = 0.995
_SHOWN: Final = 0.05
"""Losses [µm] below it are not named: they would read 0.0."""
_LIFE_STEP: Final = 360.0
_SPEED_STEP: Final = to_si(0.001, "rpm")
"""Steps [s, rad/s] to which lives and speeds are rounded."""
_SMALL: Final = 0.006
"""Bores [m] of rings that are bonded rather than pressed."""
_ROLLER_SAFETY: Final = 1.5
"""C0/P0 that the makers advise for roller bearings in normal running (SKF General Catalogue, 2006, table 10)."""


def seat_checks(
    bearing: SeatedBearing, joint: Joint, recommended: str | None, rule: str | None = None
) -> tuple[Check, ...]:
    """Check the interference where it is needed, the stress of the tightest pair and the thermal effect.

    `rule`: the class that the rules for the load alone ask for.
    """
    if joint.must_grip:
        first = _grip(bearing, joint, recommended, rule)
    else:
        first = _raceway(bearing, joint) if joint.runs_on_needles else _loose(bearing, joint, recommended)
    return (
        first,
        _stress(bearing.name, joint, recommended),
        *_expansion(bearing, joint),
    )


def life_checks(bearing: SeatedBearing, life: RatingLife) -> tuple[Check, ...]:
    """Check static safety, rating lives, speed and axial load; those without their data are not requested."""
    of, service = bearing.name, bearing.service
    unknown = "the type of the bearing or its load ratings are not known"
    missing = "no radial load is given" if service.radial_load is None else unknown
    wanted = "Specify radial_load_kN." if service.radial_load is None else "Specify designation or bearing_type."
    checks = [_static(bearing, life)] if life.static_safety is not None else [
        coded("ABU631", "not-done", missing, None, 1.0, wanted, of=of, requested=False)
    ]  # fmt: skip
    if life.basic is None:
        speed = "no speed is given" if not service.speed else missing
        action = "Specify speed_rpm." if not service.speed else wanted
        checks += [
            coded(code, "not-done", speed, None, remedy=action, of=of, requested=False) for code in ("ABU632", "ABU633")
        ]
    else:
        checks += [_basic(bearing, life), _modified(bearing, life)]
    return (*checks, _speed(bearing, life), _axial(bearing, life))


def _static(bearing: SeatedBearing, life: RatingLife) -> Check:
    safety, least = life.static_safety or 0.0, _ROLLER_SAFETY if bearing.kind in ROLLERS else 1.0
    C0 = bearing.ratings.static if bearing.ratings else 0.0
    bearable = "" if safety >= 1 else ". The load leaves permanent dents, whatever the tolerance class"
    return coded("ABU631", verdict(safety >= 1, safety >= least),
        f"C0/P0 = {shown(C0, 'kN')}/{shown(life.static_load or 0.0, 'kN')}{_axial_remark(bearing)}{bearable}",
        round(safety, 6), least if safety >= 1 else 1.0,
        None if safety >= least else "Specify a larger bearing or reduce the load.",
        of=bearing.name,
    )  # fmt: skip


def _axial_remark(bearing: SeatedBearing) -> str:
    return "" if bearing.service.axial_load is not None else " (no axial load given: none taken)"


def life_finding(
    bearing: SeatedBearing, life: float, message: str, action: str = "Specify a larger bearing."
) -> Finding:
    """A rating life [s] against the required one, or against the makers' guide."""
    required = bearing.service.required_life
    least = GUIDE_LIFE if required is None else required
    passed = life >= least or required is None
    grade, shown_life = verdict(passed, life >= least), _rounded(life, _LIFE_STEP)
    return Finding(grade, message, shown_life, least, None if life >= least else action)


def _basic(bearing: SeatedBearing, life: RatingLife) -> Check:
    P, C = life.dynamic_load or 0.0, bearing.ratings.dynamic if bearing.ratings else 0.0
    heavy = ". P is above C/2, where ISO 281 does not hold: the life is shorter" if 2 * P > C else ""
    guide = "" if bearing.service.required_life is not None else ". The limit is the makers' guide for hand-held tools"
    ratio = f"P = {shown(P, 'kN')}, C = {shown(C, 'kN')}"
    message = f"90 of 100 bearings reach it under {ratio}{_axial_remark(bearing)}{heavy}{guide}"
    return coded("ABU632", *life_finding(bearing, life.basic or 0.0, message), of=bearing.name)


def _modified(bearing: SeatedBearing, life: RatingLife) -> Check:
    if life.modified is None or life.kappa is None or life.a_iso is None:
        return coded("ABU633", "not-done", "no viscosity is given", None,
            remedy="Specify lubricant_viscosity_mm2_per_s.", of=bearing.name, requested=False,
        )  # fmt: skip
    message = (
        f"basic rating life times a_ISO = {life.a_iso:.3g} (κ = {life.kappa:.3g}, e_C = "
        f"{bearing.service.contamination_factor:g})"
    )
    found = life_finding(bearing, life.modified, message, "Specify a lubricant of higher viscosity.")
    return coded("ABU633", *found, of=bearing.name)


def _speed(bearing: SeatedBearing, life: RatingLife) -> Check:
    speed, most = bearing.service.speed, life.limiting_speed
    if not speed or most is None:
        why = "no speed is given" if not speed else "no catalogue bearing gives a limiting speed"
        action = "Specify speed_rpm." if not speed else "Specify designation."
        return coded("ABU634", "not-done", why, None, remedy=action, of=bearing.name, requested=False)
    entry = bearing.entry
    where = (
        f"limit of {entry.designation}{' with grease' if entry.with_grease else ''} ({entry.source})" if entry else ""
    )
    passed = speed <= most * (1 + 1e-9)
    return coded("ABU634", verdict(passed), f"speed of the shaft against the {where}",
        _rounded(speed, _SPEED_STEP), most, None if passed else "Specify a bearing for this speed.", of=bearing.name,
    )  # fmt: skip


def _axial(bearing: SeatedBearing, life: RatingLife) -> Check:
    axial, ratings = bearing.service.axial_load, bearing.ratings
    if axial is None or ratings is None or not ratings.static:
        why = "no axial load is given" if axial is None else "C0 is not known"
        action = "Specify axial_load_kN." if axial is None else "Specify static_load_rating_kN."
        return coded("ABU635", "not-done", why, None, remedy=action, of=bearing.name, requested=False)
    most = ratings.static / 2 if life.carries_axial else 0.0
    passed = axial <= 0 or life.carries_axial
    action = "Specify an angular contact or tapered bearing."
    if carries_by_flanges(bearing.entry):
        radial = bearing.service.radial_load or 0.0
        passed, most = axial <= radial / 2, radial / 2
        way = "in one direction" if bearing.entry and bearing.entry.designation.startswith("NJ") else "either way"
        message = f"the flanges carry it {way}, at most half of F_r"
    elif passed:
        message = f"a {bearing.kind} bearing carries at most half of C0"
    elif bearing.kind == "cylindrical":
        message = "NU and N bearings have no flanges that carry it"
        action = "Specify designation NJ or NUP, if they carry it, or an angular contact or tapered bearing."
    else:
        message = "the bearing carries no axial load"
    rough = "" if life.axial_factors_known else ". Its factors e, X and Y are those of a usual bearing of its type"
    return coded("ABU635", verdict(passed, axial <= most), f"{message}{rough}", axial, most,
        None if passed and axial <= most else action, of=bearing.name,
    )  # fmt: skip


def short_pair_checks(bearing: str, joint: Joint, recommended: str | None) -> tuple[Check, ...]:
    """Check the share of pairs with less interference than the specified rule demands."""
    if not joint.must_grip:
        return ()
    code, (warn, fail) = _CODES[joint.seat][4], joint.short_shares
    if joint.short_pairs is None or joint.demand is None:
        missing = "radial load" if joint.radial_load is None else "chamfer"
        key = "radial_load_kN" if joint.radial_load is None else "chamfer_mm"
        why = f"no {missing} is given, so the interference that the ring needs is not known"
        action = f"Specify {key}."  # the check of the seat itself is not evaluated for this, and decides
        return (coded(code, "not-done", why, None, warn, action, of=bearing, requested=False),)
    grade, share, demand = joint.short_grade, joint.short_pairs, um(joint.demand.value)
    limit = fail if grade == "fail" else warn
    least = f"less than the {demand:.3g} µm" if demand >= 0 else f"more clearance than the {-demand:.2g} µm"
    return (coded(code, grade,
                  f"{of_all(share)} in {joint.class_text} have {least} demanded by {joint.demand.by}{_losses(joint)}",
                  round(share, 8), limit,
                  None if grade == "pass" else _no_class(joint, recommended), of=bearing),)  # fmt: skip


def _raceway(bearing: SeatedBearing, joint: Joint) -> Check:
    """The shaft of a bearing without inner ring: the needles run on it with clearance."""
    least = _rounded(-joint.interference.largest)
    passed = least >= 0
    return coded(_CODES[joint.seat][0], verdict(passed),
        f"least operating clearance of the needles on {joint.class_text}. The "
        "shaft is the raceway: ground, at least 58 HRC", least, 0.0, of=bearing.name,
    )  # fmt: skip


def start_checks(
    bearing: str, joint: Joint, creep: Creep, torque: float | None, recommended: str | None
) -> tuple[Check, ...]:
    """Check that the least interference carries the starting torque.

    Empty without a starting torque, or if no interference is needed.
    """
    if torque is None or not joint.must_grip:
        return ()
    code = _CODES[joint.seat][2]
    if creep.friction_moment is None:
        why = "no chamfer is given, so the length of the seat is not known"
        return (coded(code, "not-done", why, None, torque, "Specify chamfer_mm.", of=bearing),)
    passed = bool(creep.holds_at_start)
    return (coded(code, verdict(passed), f"slip torque of {joint.class_text} at its least "
                  "interference after losses, against the starting torque", creep.friction_moment[0], torque,
                  None if passed else _no_class(joint, recommended), of=bearing),)  # fmt: skip


def clearance_checks(bearing: SeatedBearing, left: "Clearance | None", few: float) -> tuple[Check, ...]:
    """Check that bearings keep clearance after mounting: pass if few do not, warn if some, fail if most do not.

    Of a preloaded pair the preload is checked. `few`: share of bearings without clearance with which a group is still
    the one to order.
    """
    if left is None:
        return ()
    if left.group in groups_of("angular-contact")[:3]:
        return (_preload(bearing, left),)
    share = left.below_zero_probability
    passed, safe = share < MOST, share <= few
    direction = "axial" if left.axial else "radial"
    things = "pairs" if left.axial or bearing.kind == "tapered" else "bearings"
    message = (
        f"{direction} clearance of group {left.group} after mounting: {of_all(share, things)} have none left, and "
    )
    message += f"the least probable is {um(left.probable.smallest):.3g} µm"
    return (coded("ABU621", verdict(passed, safe), message, round(share, 8), few if passed else MOST,
                  None if safe else NO_GROUP, of=bearing.name),)  # fmt: skip


NO_GROUP: Final = "No clearance group suits these tolerance classes. Specify a larger bearing or reduce the load."


def _preload(bearing: SeatedBearing, left: "Clearance") -> Check:
    """The probable preload of a pair against that of the next heavier group, and twice that of the heaviest."""
    heavier, most = groups_of("angular-contact"), left.preload[1] if left.preload else None
    place, limits = heavier.index(left.group), preload_limits(left.group, bearing.inner.diameter)
    if most is None or limits is None:
        return coded("ABU621", "not-done", "no preload is tabulated for this bore", None, of=bearing.name,
            unit="N",
        )  # fmt: skip
    safe_most, heaviest = limits
    passed, safe = most <= heaviest, most <= safe_most
    return coded("ABU621", verdict(passed, safe),
        f"largest probable preload of a pair of group {left.group} after mounting. "
        f"The limit is {'the' if passed else 'twice the'} most of group {heavier[max(place - 1, 0) if passed else 0]} "
        "before mounting", round(most, 1), round(safe_most if passed else heaviest, 1), None if safe else NO_GROUP,
        of=bearing.name, unit="N",
    )  # fmt: skip


def _grip(bearing: SeatedBearing, joint: Joint, recommended: str | None, rule: str | None) -> Check:
    code = _CODES[joint.seat][0]
    smallest, required, short = _rounded(joint.interference.smallest), joint.required, joint.short
    if required is None or short is None:
        missing = "radial load" if joint.radial_load is None else "chamfer"
        key = "radial_load_kN" if joint.radial_load is None else "chamfer_mm"
        return coded(code, "not-done", f"no {missing} is given, so the interference that the ring needs is not "
            "known", smallest, remedy=f"Specify {key}.", of=bearing.name, bound="most",
        )  # fmt: skip
    normal = f" of {shown(joint.radial_load or 0.0, 'kN')} (normal, assumed)" if joint.load_assumed else ""
    limit = f"the interference required under {ARTICLE[joint.ring.load]} load{normal} by {required.by}{_losses(joint)}"
    mean = f"The mean, {um(joint.mean):.3g} µm, {'reaches' if joint.mean >= required.value else 'is below'} it"
    remark = "" if joint.grip == "pass" else f". {mean}; {of_all(short)} are below it"
    if joint.loosens_hot:
        hot = um(joint.mean - max(case.loss for case in joint.thermal_cases))
        remark = f". Hot, {ROOM + USUAL_RISE:g} °C assumed, the mean is {hot:.3g} µm"
    return coded(code, joint.grip,
        f"least interference of {joint.class_text} against {limit}{remark}{_makers(bearing, joint)}"
        f"{_other_class(joint, rule)}", smallest, _rounded(required.value),
        _no_class(joint, recommended) if joint.grip == "fail" else None, of=bearing.name,
    )  # fmt: skip


def _loose(bearing: SeatedBearing, joint: Joint, recommended: str | None) -> Check:
    share = f"{of_all(joint.clearance_probability)} have clearance"
    if bearing.drawn_cup and joint.seat == "housing":
        return _cup(bearing, joint, recommended, share)
    tightest = joint.coldest_or_hottest
    if joint.turns_tight:
        low, high = (um(end - tightest.loss) for end in joint.interference)
        when = "at work" if tightest.rise is None else f"at {ROOM + tightest.rise:g} °C"
        judgement = f"A load fixed in direction requires none, but the seat is {low:.3g} … {high:.3g} µm tight then"
        return coded(_CODES[joint.seat][0], "warn", f"largest interference of {joint.class_text} {when}. {judgement}",
            _rounded(joint.interference.largest - tightest.loss),
            remedy=_ways_out(joint) if joint.light_alloy else None, of=bearing.name,
        )  # fmt: skip
    if joint.clearance_probability >= LOOSE_ENOUGH:
        judgement = f"A load fixed in direction requires none; {share}, so the ring can creep and be moved"
    else:
        judgement = (
            f"A load fixed in direction requires none. Only {share}: the ring hardly creeps, so its wear is not "
            "spread, and it is hard to move along its seat"
        )
    return coded(_CODES[joint.seat][0], "pass",
        f"least interference of {joint.class_text}. {judgement}{_makers(bearing, joint)}",
        _rounded(joint.interference.smallest), of=bearing.name,
    )  # fmt: skip


def _ways_out(joint: Joint) -> str:
    """What helps a light-alloy housing that no class suits cold and hot."""
    low, high = (um(end) for end in joint.interference)
    gap = um(max(case.loss for case in joint.thermal_cases) - joint.interference.smallest)
    return (
        f"No tabulated class is free cold and close hot. Put a steel sleeve into the housing: {low:.3g} … {high:.3g} "
        f"µm at every temperature. Or hold the ring by an O-ring or adhesive: the gap is up to {gap:.3g} µm hot. Or "
        "let it be tight cold, with a larger clearance in the bearing."
    )


def _cup(bearing: SeatedBearing, joint: Joint, recommended: str | None, share: str) -> Check:
    """The housing of a drawn cup: warn if it is looser than all classes of the catalogue's row, or split."""
    classes = joint.cup_classes
    held = joint.mean >= min((joint.with_class(name).mean for name in classes), default=math.inf)
    asked = f"The makers specify {' or '.join(classes)}, which" if classes else "A one-piece housing must"
    cup = (
        f"A drawn cup gets its shape and hold from the housing; {share}. {asked} press it"
        if not held
        else ("A drawn cup gets its shape and hold from the housing, as the makers specify")
    )
    action = None if held or recommended else "Specify a one-piece housing."
    return coded(_CODES[joint.seat][0], verdict(True, held), f"least interference of {joint.class_text}. {cup}",
        _rounded(joint.interference.smallest), remedy=action, of=bearing.name,
    )  # fmt: skip


def _makers(bearing: SeatedBearing, joint: Joint) -> str:
    if joint.maker is None or bearing.load_ratio is None:
        return ""
    adapted = ""
    if joint.catalogue_class is None:
        adapted = f", which does not count here. {BEYOND_ROWS[joint.seat]}"
    elif joint.catalogue_class != joint.maker.classes[0]:
        adapted = f", on this hollow shaft {joint.catalogue_class}"
    gives = f"the catalogue ({source_of(bearing.kind)}) gives {joint.maker.classes[0]}{adapted}"
    return f". For P/C = {bearing.load_ratio:.2g} {gives}"


def _other_class(joint: Joint, rule: str | None) -> str:
    """What the rule alone asks for, where the catalogue gives another class."""
    if joint.catalogue_class in (None, rule):
        return ""
    return f". The rule alone asks for {rule}" if rule else ". The rule alone finds no class"


def _stress(bearing: str, joint: Joint, recommended: str | None) -> Check:
    grade, limit = joint.stress, joint.stress_limit if joint.stress == "fail" else joint.permitted
    warm = " when warm" if joint.tightest > joint.interference.largest else ""
    remark = ". The halves of a split housing pinch a ring in a class tighter than J7" if joint.pinched else ""
    stresses = [shown(stress, "MPa", ".0f") for stress in (joint.hoop_stress, joint.part_stress)]
    return coded(_CODES[joint.seat][1], "warn" if joint.pinched and grade == "pass" else grade,
        f"largest interference of {joint.class_text}{warm} against the limit by {limit.by}. Hoop stress of the "
        f"ring {stresses[0]}, of the {joint.seat} {stresses[1]}{remark}",
        _rounded(joint.tightest), _rounded(limit.value),
        _no_class(joint, recommended) if grade == "fail" else None, of=bearing,
    )  # fmt: skip


def _expansion(bearing: SeatedBearing, joint: Joint) -> tuple[Check, ...]:
    """The change of a part that expands otherwise than its ring, which the usual temperature at work is taken for."""
    part = bearing.shaft if joint.seat == "shaft" else bearing.housing
    more = seat_material(part.material).expansion - seat_material("steel").expansion
    if abs(more) < _LIKE_STEEL or not assumes_warmth(bearing):
        return ()
    change = _rounded(more * joint.diameter * 10)
    verb = "gains" if joint.seat == "shaft" else "loses"
    return (coded(_CODES[joint.seat][3], "pass",
                  f"the seat in {part.material} {verb} {shown(change, 'um')} of interference for every "
                  f"10 K. No temperature is given: {ROOM + USUAL_RISE:g} °C is assumed at work", change,
                  of=bearing.name),)  # fmt: skip


def _losses(joint: Joint) -> str:
    parts = [(loss.name, loss.amount) for loss in joint.losses if loss.name != TEMPERATURE]
    warm = max(case.loss for case in joint.thermal_cases)
    named = [*parts, (TEMPERATURE, warm)] if warm > 0 else parts
    kept = f", over the {joint.pressure_kept:.0%} of the pressure that is kept" if joint.pressure_kept < _KEPT else ""
    return kept + "".join(f" + {name} {um(value):.1f} µm" for name, value in named if um(value) >= _SHOWN)


def _no_class(joint: Joint, recommended: str | None) -> str | None:
    """Action if no tolerance class is recommended; None if one is."""
    if recommended is not None:
        return None
    if joint.split:
        return "A split housing cannot hold a ring whose load turns round it. Specify a one-piece housing."
    if joint.diameter < _SMALL and joint.must_grip:
        return "A class that holds so small a ring overstresses it. Specify h5 and bond the ring."
    if joint.light_alloy and joint.is_lost_to_warmth:
        gap = um(joint.loss_by_warmth - joint.interference.smallest)
        return (
            "No tabulated class both holds the ring hot and is permitted. Specify a housing of steel: warmth then "
            f"takes nothing from its seat. Or hold the ring by adhesive: the gap is up to {gap:.3g} µm hot."
        )
    if joint.maker is not None and joint.catalogue_class is None:
        wall = "shaft with a smaller bore" if joint.seat == "shaft" else "housing with a thicker wall, or of steel"
        return f"No tabulated class both holds the ring and is permitted. Specify a {wall}."
    return "No tabulated class both holds the ring and is permitted. Specify a longer seat or a larger bearing."


def no_better(check: Check, joint: Joint) -> Action:
    """What to do about a warning of the recommended class: no other one is better."""
    if check.code == _CODES[joint.seat][1]:
        return Action("No tabulated class holds the ring with less. Mount it by heat, not by a press.")
    if joint.loosens_hot:
        return Action(_ways_out(joint))
    if joint.turns_tight:
        return Action("No tabulated class stays free at every temperature. A part of steel keeps its fit.")
    groups = None
    if joint.required is not None and joint.required.value < joint.permitted.value:
        band = Interval(joint.required.value, joint.permitted.value)
        groups = selective_groups(*joint.male_and_female, band)
    if groups is None or groups.groups < 2:
        return Action("No tabulated class does better.")
    least = um(groups.interference.smallest)
    return Action(
        f"No tabulated class does better. Sort both parts into {groups.groups} groups: every pair then has at least "
        f"{least:.3g} µm (calculated)."
    )


def _rounded(value: float, step: float = 1e-12) -> float:
    """A value in whole steps, a length in those of a millionth of a micrometre."""
    return step * round(value / step)
