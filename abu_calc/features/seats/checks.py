"""The checks of a seat, and of the clearance left in its bearing."""

from typing import TYPE_CHECKING, Final

from abu_calc.features.seats.advice import LOOSE_ENOUGH
from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.creep import CreepJudgement
from abu_calc.features.seats.interference import of_all
from abu_calc.features.seats.joint import ARTICLE, Joint
from abu_calc.foundation.checks import Check, coded, verdict
from abu_calc.foundation.moved import Moved
from abu_calc.foundation.units import from_si
from abu_calc.standards.balls import seat_material
from abu_calc.standards.tolerance_classes import SOURCE

if TYPE_CHECKING:
    from abu_calc.features.seats.clearance import ClearanceLeft

_CODES: Final = {
    "shaft": ("ABU601", "ABU602", "ABU603", "ABU604"),
    "housing": ("ABU611", "ABU612", "ABU613", "ABU614"),
}
_LIKE_STEEL: Final = 3e-6
"""Difference of expansion [1/K] from the ring's that is nothing to warn of: cast iron's."""
_MOST: Final = 0.5


def seat_checks(bearing: SeatedBearing, joint: Joint, recommended: str | None) -> tuple[Check, ...]:
    """Check the interference where it is needed, the stress of the tightest pair and the thermal effect."""
    first = _grip if joint.must_grip else _loose
    return (
        first(bearing, joint, recommended),
        _stress(bearing.name, joint, recommended),
        *_expansion(bearing, joint),
    )


def start_checks(
    bearing: str, joint: Joint, creep: CreepJudgement, torque: float | None, recommended: str | None
) -> tuple[Check, ...]:
    """Check that the least interference carries the starting torque.

    Empty without a starting torque, or if no interference is needed.
    """
    if torque is None or not joint.must_grip:
        return ()
    code = _CODES[joint.seat][2]
    if creep.least_torque is None:
        why = "no chamfer is given, so the length of the seat is not known"
        return (coded(code, "not-done", why, None, torque, "N·m", "Specify chamfer_mm.", "least", of=bearing),)
    passed = bool(creep.holds_at_start)
    return (coded(
        code, verdict(passed), f"slip torque of {joint.told} at its least "
        "interference after losses, against the starting torque", creep.least_torque, torque, "N·m",
        None if passed else _remedy(joint, recommended), "least", of=bearing,
    ),)  # fmt: skip


def clearance_checks(bearing: str, left: "ClearanceLeft | None") -> tuple[Check, ...]:
    """Check that bearings keep clearance after mounting: warn if some do not, fail if most do not."""
    if left is None:
        return ()
    passed, safe = left.below_zero_probability < _MOST, left.probable.smallest >= 0
    choice = "No clearance group keeps clearance. Specify looser tolerance classes."
    if left.group_to_choose:
        choice = f"Specify group {left.group_to_choose}: it keeps clearance (calculated)."
    return (coded(
        "ABU621", verdict(passed, safe), f"least probable radial clearance of group {left.group} after mounting; "
        f"{of_all(left.below_zero_probability, 'bearings')} have none left", _um(left.probable.smallest), 0.0, "µm",
        None if safe else choice, "least", of=bearing,
    ),)  # fmt: skip


def _grip(bearing: SeatedBearing, joint: Joint, recommended: str | None) -> Check:
    code = _CODES[joint.seat][0]
    smallest, required, short = _um(joint.interference.smallest), joint.required, joint.short
    if required is None or short is None:
        missing = "radial load" if joint.radial_load is None else "chamfer"
        key = "radial_load_kN" if joint.radial_load is None else "chamfer_mm"
        return coded(
            code, "not-done", f"no {missing} is given, so the interference that the ring needs is not "
            "known", smallest, None, "µm", f"Specify {key}.", of=bearing.name,
        )  # fmt: skip
    limit = f"the interference required under {ARTICLE[joint.ring.load]} load by {required.by}{_losses(joint)}"
    mean = f"The mean, {_um(joint.mean):.3g} µm, {'reaches' if joint.mean >= required.value else 'is below'} it"
    remark = "" if joint.grip == "pass" else f". {mean}; {of_all(short)} are below it"
    return coded(
        code, joint.grip, f"least interference of {joint.told} against {limit}{remark}{_makers(bearing, joint)}",
        smallest, _um(required.value), "µm", _tighter(joint, recommended),
        "least", of=bearing.name,
    )  # fmt: skip


def _loose(bearing: SeatedBearing, joint: Joint, recommended: str | None) -> Check:
    share = f"{of_all(joint.clearance_probability)} have clearance"
    if joint.clearance_probability >= LOOSE_ENOUGH:
        judgement = f"A load fixed in direction requires none; {share}, so the ring can creep and be moved"
    else:
        judgement = (
            f"A load fixed in direction requires none. Only {share}: the ring hardly creeps, so its wear is not "
            "spread, and it is hard to move along its seat"
        )
    return coded(
        _CODES[joint.seat][0], "pass",
        f"least interference of {joint.told}. {judgement}{_makers(bearing, joint)}", _um(joint.interference.smallest),
        None, "µm", None, "least", of=bearing.name,
    )  # fmt: skip


def _makers(bearing: SeatedBearing, joint: Joint) -> str:
    if joint.maker is None or bearing.load_ratio is None:
        return ""
    return f". For P/C = {bearing.load_ratio:.2g} the catalogue gives {joint.maker.classes[0]} ({SOURCE})"


def _stress(bearing: str, joint: Joint, recommended: str | None) -> Check:
    grade, limit = joint.stress, joint.stress_limit if joint.stress == "fail" else joint.permitted
    warm = " when warm" if joint.tightest > joint.interference.largest else ""
    remark = ". The halves of a split housing pinch a ring in a class tighter than J7" if joint.pinched else ""
    stresses = [f"{from_si(stress, 'MPa'):.0f} MPa" for stress in (joint.hoop_stress, joint.part_stress)]
    return coded(
        _CODES[joint.seat][1], "warn" if joint.pinched and grade == "pass" else grade,
        f"largest interference of {joint.told}{warm} against the limit by {limit.by}. Hoop stress of the "
        f"ring {stresses[0]}, of the {joint.seat} {stresses[1]}{remark}", _um(joint.tightest), _um(limit.value), "µm",
        _remedy(joint, recommended) if grade == "fail" else None, of=bearing,
    )  # fmt: skip


def _expansion(bearing: SeatedBearing, joint: Joint) -> tuple[Check, ...]:
    """Warning of a part that expands otherwise than its ring while no temperature is given."""
    shaft, service = joint.seat == "shaft", bearing.service
    part, known = (bearing.shaft, service.ring_over_shaft) if shaft else (bearing.housing, service.housing_over_ring)
    more = seat_material(part.material).expansion - seat_material("steel").expansion
    if abs(more) < _LIKE_STEEL or known is not None or service.over_mounting is not None:
        return ()
    change = _um(more * joint.diameter * 10)
    verb = "gains" if shaft else "loses"
    return (coded(
        _CODES[joint.seat][3], "warn", f"the seat in {part.material} {verb} {change:.3g} µm of interference for every "
        "10 K that it warms with its ring, and no temperature is given", change, None, "µm",
        "Specify temperature_rise_K.", of=bearing.name,
    ),)  # fmt: skip


def _losses(joint: Joint) -> str:
    return "".join(f" + {loss.name} {_um(loss.value):.1f} µm" for loss in joint.losses if loss.value > 0)


def _tighter(joint: Joint, recommended: str | None) -> str | None:
    """Nothing for a ring that holds, nor in place of one that may creep unless the field advised does better."""
    better = recommended is not None and joint.with_class(recommended).grip == "pass"
    return _remedy(joint, recommended) if joint.grip == "fail" or (joint.grip == "warn" and better) else None


def _remedy(joint: Joint, recommended: str | None) -> str:
    """Action: the advised tolerance class, as tried, and its result."""
    if recommended is None and joint.split:
        return "A split housing cannot hold a ring whose load turns round it. Specify a one-piece housing."
    if recommended is None:
        return "No tabulated class both holds the ring and is permitted. Specify a longer seat or a larger bearing."
    best = joint.with_class(recommended)
    moved = Moved("the least interference", _um(joint.interference.smallest), _um(best.interference.smallest), "µm")
    if joint.stress == "fail":
        moved = Moved("the largest interference", _um(joint.tightest), _um(best.tightest), "µm")
    if best.grip == "pass":
        verdict = f"{recommended} passes."
    elif best.required is None or best.mean >= best.required.value:
        verdict = f"{recommended} reaches the required interference in the mean."
    else:
        verdict = f"{recommended} is the catalogue's class for such a load."
    return f"Specify {recommended}: {moved.text} (calculated). {verdict}"


def _um(metres: float) -> float:
    # freed of the noise of the conversion
    return round(from_si(metres, "um"), 6)
