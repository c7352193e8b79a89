"""Rating life of a machine's bearings under the loads of its simulation, without and with the autobalancer."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Annotated, ClassVar, Final, NamedTuple

from abu_calc.features.seats.bearing import SeatedBearing
from abu_calc.features.seats.checks import life_finding
from abu_calc.features.seats.rating_life import exponent, life_at
from abu_calc.foundation.checks import Check, coded
from abu_calc.foundation.formula import formula
from abu_calc.foundation.quantity import Quantity, Record, record
from abu_calc.foundation.units import in_file, shown

_STEPS: Final = 180
_SAME_PLACE: Final = 1e-6
_LEAST_LOAD: Final = 1e-3
"""Load [N] that stands in for none."""


class UseLoads(NamedTuple):
    """Forces at the wheel [N]: the rotating ones without and with the autobalancer, and the constant one at work.

    `rotating_with` is None if no start balances.
    """

    rotating_without: float
    rotating_with: float | None
    constant: float


@record
class SimulatedLife(Record):
    """Loads of a bearing from the simulation, and its basic rating life without and with the autobalancer."""

    decimals: ClassVar[Mapping[str, int]] = {"h": 1}

    load_without: Annotated[float, Quantity("equivalent load without the autobalancer", "", 3, unit="kN")]
    load_with: Annotated[float, Quantity("equivalent load with the autobalancer", "", 3, unit="kN")]
    life_without: Annotated[float, Quantity("basic rating life without the autobalancer", "", 3, unit="h")]
    life_with: Annotated[float, Quantity("basic rating life with the autobalancer", "", 3, unit="h")]


class LifeInUse(NamedTuple):
    """Lives of one bearing (None: data are missing), and their check."""

    lives: SimulatedLife | None
    checks: tuple[Check, ...]


@formula(
    "Equivalent load of a constant and a rotating force",
    "P = [mean of |F_c + F_Ω·e^{iθ}|^p_L over one revolution]^(1/p_L)",
    "N",
    where="A constant force F_c and a force F_Ω that rotates with the spindle act in one plane.",
    checked=("both forces at one bearing",),
    assumed="linear damage by the rating life",
    source="Palmgren-Miner rule with the life of ISO 281:2007",
)
def combined_load(constant: float, rotating: float, power: float) -> float:
    """
    >>> combined_load(0.0, 100.0, 3.0), round(combined_load(100.0, 100.0, 3.0), 1)
    (100.0, 150.3)
    """
    if not constant or not rotating:
        return max(constant, rotating)
    angles = (2 * math.pi * step / _STEPS for step in range(_STEPS))
    forces = (math.hypot(constant + rotating * math.cos(angle), rotating * math.sin(angle)) for angle in angles)
    return math.pow(sum([math.pow(force, power) for force in forces]) / _STEPS, 1 / power)


def lives_in_use(bearings: Sequence[SeatedBearing], loads: UseLoads, speed: float) -> tuple[LifeInUse, ...]:
    """Lives of all bearings of a spindle by the lever rule from the wheel's plane, at the spindle's speed [rad/s].

    Exactly two bearings with position_mm carry the wheel; others are not evaluated. A speed of the bearing's own goes
    before the spindle's.
    """
    if loads.rotating_with is None:
        why = "no start case balances, so the load with the autobalancer is not known"
        return tuple(_unknown(bearing, why, "See ABU701.") for bearing in bearings)
    placed = [bearing for bearing in bearings if bearing.position is not None]
    shares = _shares(placed)
    if shares is None:
        missing = "two bearings with different position_mm are needed, no more"
        return tuple(_unknown(bearing, missing, "Specify position_mm of both bearings.") for bearing in bearings)
    share_of = {id(bearing): share for bearing, share in zip(placed, shares, strict=True)}
    return tuple(
        _life(bearing, loads, loads.rotating_with, share_of[id(bearing)], speed)
        if id(bearing) in share_of
        else _unknown(bearing, "no place is given", "Specify position_mm of both bearings.")
        for bearing in bearings
    )


def _shares(placed: Sequence[SeatedBearing]) -> tuple[float, float] | None:
    """Shares of a force in the wheel's plane that two bearings take, in size."""
    if len(placed) != 2:
        return None
    first, second = (bearing.position or 0.0 for bearing in placed)
    if abs(second - first) < _SAME_PLACE:
        return None
    return abs(second / (second - first)), abs(first / (second - first))


def _life(bearing: SeatedBearing, loads: UseLoads, residual: float, share: float, speed: float) -> LifeInUse:
    if bearing.kind is None or bearing.ratings is None:
        return _unknown(bearing, "no type or load rating is known", "Specify designation or bearing_type.")
    power = exponent(bearing.kind)
    turning = (
        bearing
        if bearing.service.speed
        else replace(bearing, service=bearing.service.model_copy(update=dict([in_file("speed_rpm", speed)])))
    )
    without, with_it = (
        combined_load(share * loads.constant, share * rotating, power)
        for rotating in (loads.rotating_without, residual)
    )
    lives = [life_at(turning, max(load, _LEAST_LOAD)) for load in (without, with_it)]
    if lives[0] is None or lives[1] is None:
        return _unknown(bearing, "no life can be computed", "Specify designation and speed_rpm.")
    message = (
        f"without the autobalancer {shown(lives[0], 'h')} under {shown(without, 'kN')}, with it under "
        f"{shown(with_it, 'kN')}; the loads are imbalance, residual imbalance and the normal force at work"
    )
    both = SimulatedLife(load_without=without, load_with=with_it, life_without=lives[0], life_with=lives[1])
    return LifeInUse(both, (coded("ABU636", *life_finding(bearing, lives[1], message), of=bearing.name),))


def _unknown(bearing: SeatedBearing, why: str, action: str) -> LifeInUse:
    check = coded("ABU636", "not-done", why, None, remedy=action, of=bearing.name, requested=False)
    return LifeInUse(None, (check,))
