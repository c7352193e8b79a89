"""The checks of a seat, and of the clearance left in its bearing."""

from typing import TYPE_CHECKING

from abu_calc.checks import Check, coded, verdict
from abu_calc.fits.advice import LOOSE_ENOUGH
from abu_calc.fits.creep import Creep
from abu_calc.fits.joint import Joint
from abu_calc.units import from_si

if TYPE_CHECKING:
    from abu_calc.fits.clearance import ClearanceLeft

_CODES = {"shaft": ("ABU601", "ABU602", "ABU603"), "housing": ("ABU611", "ABU612", "ABU613")}


def seat_checks(bearing: str, joint: Joint, recommended: str | None) -> tuple[Check, Check]:
    """Whether the loosest pair grips where it must, and whether the tightest one is permitted."""
    if not joint.must_grip:
        return _loose(bearing, joint), _stress(bearing, joint, recommended)
    return _grip(bearing, joint, recommended), _stress(bearing, joint, recommended)


def start_checks(
    bearing: str, joint: Joint, creep: Creep, torque: float | None, recommended: str | None
) -> tuple[Check, ...]:
    """Whether the least interference carries the starting torque; no check without one, or where none is needed."""
    if torque is None or not joint.must_grip:
        return ()
    code = _CODES[joint.seat][2]
    if creep.least_torque is None:
        why = "no chamfer is given, so the length of the seat is not known"
        return (coded(code, "not-done", why, None, torque, "N·m", "Give chamfer_mm.", "least", of=bearing),)
    passed = bool(creep.holds_at_start)
    return (coded(
        code, verdict(passed), f"friction torque of {joint.tolerance_class} at its least "
        "interference, losses taken off, against the starting torque", creep.least_torque, torque, "N·m",
        None if passed else _remedy(recommended), "least", of=bearing,
    ),)  # fmt: skip


def clearance_checks(bearing: str, left: "ClearanceLeft | None") -> tuple[Check, ...]:
    """Whether the probable clearance left after mounting stays above zero; no check without a clearance group."""
    if left is None:
        return ()
    passed = left.probable.smallest >= 0
    choice = f"{left.group_to_choose} keeps it." if left.group_to_choose else "No group keeps it: looser fits."
    return (coded(
        "ABU621", verdict(passed), f"least probable radial clearance of "
        f"group {left.group} after mounting", _um(left.probable.smallest), 0.0, "µm",
        None if passed else choice, "least", of=bearing,
    ),)  # fmt: skip


def _grip(bearing: str, joint: Joint, recommended: str | None) -> Check:
    code = _CODES[joint.seat][0]
    smallest, required = _um(joint.interference.smallest), joint.required
    if required is None:
        missing = "radial load" if joint.radial_load is None else "chamfer"
        key = "radial_load_kN" if joint.radial_load is None else "chamfer_mm"
        return coded(
            code, "not-done", f"no {missing} is given, so the interference that the ring needs is not "
            "known", smallest, None, "µm", f"Give {key}.", of=bearing,
        )  # fmt: skip
    passed = bool(joint.grips)
    return coded(
        code, verdict(passed), f"least interference of {joint.tolerance_class} against what the ring "
        f"needs under a {joint.ring.load} load by {required.by}{_losses(joint)}", smallest, _um(required.value), "µm",
        None if passed else _remedy(recommended), "least", of=bearing,
    )  # fmt: skip


def _loose(bearing: str, joint: Joint) -> Check:
    share = f"{100 * joint.clearance_probability:.3g} % of pairs are loose"
    if joint.clearance_probability >= LOOSE_ENOUGH:
        judgement = f"none is needed under a load fixed in direction; {share}, so the ring can creep and be moved"
    else:
        judgement = (
            f"conservative for a load fixed in direction, which needs none: {share}, so the ring hardly creeps to "
            "spread its wear and is hard to move along its seat"
        )
    return coded(
        _CODES[joint.seat][0], "pass",
        f"least interference of {joint.tolerance_class}; {judgement}", _um(joint.interference.smallest),
        None, "µm", None, "least", of=bearing,
    )  # fmt: skip


def _stress(bearing: str, joint: Joint, recommended: str | None) -> Check:
    permitted, passed = joint.permitted, joint.bears
    return coded(
        _CODES[joint.seat][1], verdict(passed),
        f"largest interference of {joint.tolerance_class} against what is permitted by {permitted.by}; hoop "
        f"stress of the ring {from_si(joint.hoop_stress, 'MPa'):.0f} MPa", _um(joint.interference.largest),
        _um(permitted.value), "µm", None if passed else _remedy(recommended), of=bearing,
    )  # fmt: skip


def _losses(joint: Joint) -> str:
    return "".join(f" + {loss.name} {_um(loss.value):.1f} µm" for loss in joint.losses)


def _remedy(recommended: str | None) -> str:
    if recommended is None:
        return "No tabulated class both grips and is permitted: a longer seat, a smaller load or a larger bearing."
    return f"{recommended} passes."


def _um(metres: float) -> float:
    # freed of the noise of the conversion
    return round(from_si(metres, "um"), 6)
