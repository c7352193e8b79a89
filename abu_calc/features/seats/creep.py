"""Creep of a ring on its seat: by the kind of load on it, and when the machine starts."""

import math
from typing import Annotated, Final, Literal

from abu_calc.features.seats.bearing import SEAT_FRICTION
from abu_calc.features.seats.interference import Pair, of_all, probable_interference
from abu_calc.features.seats.joint import Joint
from abu_calc.foundation.checks import Grade
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.standards.tolerance_classes import RingLoad

CreepVerdict = Literal["holds", "may creep", "creeps", "needs no grip", "not known"]


@record
class Creep(Record):
    """Creep of the ring on its seat under its load, and its hold when the machine starts."""

    ring_load: Annotated[RingLoad, Quantity("how the load meets the ring")]
    verdict: Annotated[CreepVerdict, Quantity("verdict", "", 4, "holds (smallest), may creep (mean), creeps, …")]
    why: Annotated[str, Quantity("why")]
    probability: Annotated[float | None, Quantity("share of pairs with less interference than the ring needs", "", 3)]
    friction_moment: Annotated[
        Pair | None, Quantity("slip torque", "", 3, "at the least and at the least probable interference", unit="N_m")
    ]
    holds_at_start: Annotated[bool | None, Quantity("holds the starting torque")]


@formula(
    "Torque at which a press-fitted ring slips on its seat",
    "μ_s·p·π·d·b_s·d/2",
    "N·m",
    where=("μ_s is 0.12 for steel on steel, dry or lightly oiled (assumed)."),
    checked=(SEAT_FRICTION,),
    assumed="uniform pressure",
    source="Coulomb friction on a cylinder",
)
def slip_torque(friction: float, pressure: float, diameter: float, length: float) -> float:
    """
    >>> round(slip_torque(0.12, 5e6, 0.080, 0.029), 1)
    174.9
    """
    return SEAT_FRICTION.check(friction) * pressure * math.pi * diameter * length * diameter / 2


_VERDICTS: Final[dict[Grade, CreepVerdict]] = {
    "pass": "holds", "warn": "may creep", "fail": "creeps", "not-done": "not known",
}  # fmt: skip


def creep(joint: Joint, friction: float, starting_torque: float | None) -> Creep:
    """Judge a ring: under a load fixed in direction it requires no interference.

    Any other ring holds if the least interference suffices, and may creep if only the mean does.
    """
    verdict: CreepVerdict = "needs no grip" if not joint.must_grip else _VERDICTS[joint.grip]
    if not joint.must_grip:
        why = f"load fixed in direction; {of_all(joint.clearance_probability)} have clearance"
    elif joint.short is None:
        verdict, why = "not known", "radial load or chamfer not given"
    else:
        why = f"{of_all(joint.short)} have less interference than required"
    return Creep(
        ring_load=joint.ring.load,
        verdict=verdict,
        why=why,
        probability=joint.short if joint.must_grip else None,
        friction_moment=_torques(joint, friction),
        holds_at_start=holds_at_start(joint, friction, starting_torque),
    )


def holds_at_start(joint: Joint, friction: float, starting_torque: float | None) -> bool | None:
    """True if the slip torque at the least interference exceeds the starting torque.

    None: not requested, or not known.
    """
    if starting_torque is None or not joint.must_grip:
        return None
    torques = _torques(joint, friction)
    return None if torques is None else torques[0] >= starting_torque


def _torques(joint: Joint, friction: float) -> tuple[float, float] | None:
    """Slip torques at the least and at the least probable interference."""
    if joint.length is None:
        return None
    length = joint.length
    probable = probable_interference(*joint.male_and_female).smallest
    pressures = (
        joint.pressure_rate * max(smallest - joint.lasting_losses, 0.0)
        for smallest in (joint.interference.smallest, probable)
    )
    least, likely = (slip_torque(friction, pressure, joint.diameter, length) for pressure in pressures)
    return least, likely
