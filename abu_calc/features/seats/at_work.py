"""A seat at work: its interference cold and hot, the clearance inside the bearing then, and how its ring is mounted."""

import math
from collections.abc import Mapping
from typing import Annotated, Final

from abu_calc.features.seats.bearing import SEAT_DIAMETER, SeatedBearing
from abu_calc.features.seats.clearance import states
from abu_calc.features.seats.interference import Pair, SeatRecord
from abu_calc.features.seats.joint import Joint
from abu_calc.features.seats.joints import ROOM, expansions
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, record
from abu_calc.foundation.validity import Range

HOTTEST_RING: Final = 120.0
"""Temperature [°C] that the steel of a ring keeps its size up to (bearing makers' mounting handbooks)."""
HOTTEST_CLOSED: Final = 80.0
"""The same of a bearing with seals or grease [°C]."""
LEAST_CLEARANCE: Final = 5e-6
CLEARANCE_SHARE: Final = 1 / 2000
"""Clearance [m] wanted of a heated ring, and its share of the diameter, where none is given; assumed."""
INTERFERENCE: Final = Range("interference", -1e-2, 1e-2, "m")


@record
class SeatMounting(SeatRecord):
    """How a ring gets onto its seat: by heat, or by a press. None: it needs none."""

    heat_ring_C: Annotated[
        float | None, Quantity("temperature of the heated ring", "", 3, "with the clearance wanted, tightest pair")
    ]
    heat_housing_C: Annotated[
        float | None, Quantity("temperature of the heated housing", "", 3, "with the clearance wanted, tightest pair")
    ]
    cool_part_C: Annotated[
        float | None,
        Quantity("temperature of the cooled shaft or ring", "", 3, "beside the hottest that is permitted, if needed"),
    ]
    hottest_C: Annotated[float, Quantity("hottest that the ring may be", "", 3)]
    mounting_clearance: Annotated[float, Quantity("clearance wanted when mounting", "", 3, unit="um")]
    press_force_N: Annotated[
        Pair | None, Quantity("mounting force", "F", 3, "cold, of the loosest and the tightest pair; μ as given")
    ]
    lets_go_at_C: Annotated[
        Pair | None,
        Quantity("temperature that lets the ring go", "", 3, "ring and part alike; the loosest, the tightest pair"),
    ]


@formula(
    "Temperature at which a heated part slides over the other",
    "T = T₀ + (δ + c)/(α·d)",
    "°C",
    where="c is the clearance wanted. The other part stays at T₀ = 20 °C.",
    checked=(INTERFERENCE, SEAT_DIAMETER),
    source="linear expansion",
    own_units=True,
)
def heated(interference: float, clearance: float, expansion: float, diameter: float) -> float:
    """
    >>> round(heated(45e-6, 40e-6, 12e-6, 0.080), 1)
    108.5
    """
    return ROOM + (INTERFERENCE.check(interference) + clearance) / (expansion * SEAT_DIAMETER.check(diameter))


@formula(
    "Force that presses a ring onto its seat",
    "F = μ·p·π·d·b_s",
    "N",
    where="p is the pressure of the joint (Lamé).",
    checked=(SEAT_DIAMETER,),
    assumed="cold, pressure even along the seat",
    source="DIN 7190-1:2017",
)
def mounting_force(pressure: float, diameter: float, length: float, friction: float) -> float:
    """
    >>> round(mounting_force(20e6, 0.080, 0.029, 0.12))
    17492
    """
    return friction * pressure * math.pi * SEAT_DIAMETER.check(diameter) * length


def seat_mounting(bearing: SeatedBearing, joint: Joint) -> SeatMounting:
    """Heat, force of the press, and the temperature that lets the ring go; without a chamfer its width is the length.

    A ring is heated for its shaft, a housing for its ring. A ring that would be hotter than it may be goes with a
    cooled shaft. The force is that of the apparent interference.
    """
    d, (around, inside) = joint.diameter, expansions(bearing, joint.seat)
    least, most = (max(end, 0.0) for end in joint.interference)
    wanted = bearing.service.mounting_clearance
    clearance = max(LEAST_CLEARANCE, CLEARANCE_SHARE * d) if wanted is None else wanted
    tight = most > 0
    hot = heated(most, clearance, around, d) if tight else None
    top, on_shaft = HOTTEST_CLOSED if bearing.closed else HOTTEST_RING, joint.seat == "shaft"
    cool = None
    if hot is not None and hot > top and on_shaft:
        kept = (top - ROOM) * around * d - most
        if wanted is None and kept >= LEAST_CLEARANCE:
            hot, clearance = top, kept  # as hot as it may be leaves enough
    if hot is not None and hot > top and on_shaft:
        cool = ROOM - ((hot - top) * around) / inside
    length = joint.length or joint.ring.width
    forces = tuple(
        mounting_force(joint.pressure_rate * end, d, length, bearing.service.seat_friction) for end in (least, most)
    )
    apart = (around - inside) * d
    return SeatMounting(
        heat_ring_C=hot if on_shaft else None,
        heat_housing_C=None if on_shaft else hot,
        cool_part_C=cool,
        hottest_C=top,
        mounting_clearance=clearance,
        press_force_N=(forces[0], forces[1]) if tight else None,
        lets_go_at_C=(ROOM + least / apart, ROOM + most / apart) if tight and apart > 1e-12 else None,
    )


def at_work(joint: Joint) -> Mapping[str, Pair]:
    """Interference [m] cold and hot, from the loosest to the tightest pair."""
    low, high = joint.interference
    cases = {"cold": joint.coldest, "hot": joint.hottest}
    return {name: (low - case.loss, high - case.loss) for name, case in cases.items()}


def clearance_at_work(
    bearing: SeatedBearing, shaft: Joint, housing: Joint, group: str, few: float
) -> Mapping[str, Pair]:
    """Clearance [m] inside the bearing cold, as mounted and hot, which all but a `few` at either end have.

    The inner ring is warmer than the outer one when hot alone.
    """
    return {
        name: (mounting.end(group, few), mounting.end(group, 1 - few))
        for name, mounting in zip(("cold", "mounted", "hot"), states(bearing, shaft, housing), strict=True)
    }
