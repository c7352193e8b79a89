"""Corrections in a plane: remove metal at the heavy spot, add it opposite, or split it over places."""

import cmath
import math
from collections.abc import Sequence
from itertools import combinations
from typing import Final, Literal

from abu_calc.frozen import dataclass

Action = Literal["remove", "add"]

NOTHING: Final = 1e-9
"""Part of the whole below which a share is none."""


@dataclass(frozen=True)
class Share:
    """A mass [kg] to take off or put on at an angle behind the mark [rad]."""

    action: Action
    mass: float
    angle: float


def correction(mass: float, angle: float, removable: float | None, places: Sequence[float] | None) -> tuple[Share, ...]:
    """The shares that balance a heavy spot of this mass at this angle.

    Metal is taken off where there is enough (`removable`, of the plane), else put on opposite. With places, two of them
    carry it: the pair that takes off no more than may be, puts on as little as may be, and takes the least in all.
    """
    if mass == 0:
        return ()
    if places is None:
        if removable is None or mass <= removable:
            return (Share("remove", mass, turned(angle)),)
        return (Share("add", mass, turned(angle + math.pi)),)
    options = [split for pair in combinations(places, 2) if (split := _split(mass, angle, *pair)) is not None]

    def worth(shares: tuple[Share, ...]) -> tuple[bool, bool, float]:
        off = removed(shares)
        return (
            removable is not None and off > removable,
            off < sum(share.mass for share in shares),
            sum(share.mass for share in shares),
        )

    return min(options, key=worth)


def turned(angle: float) -> float:
    """An angle from 0 to 2π, the latter not reached.

    >>> turned(-1e-70), turned(7.0) < 1
    (0.0, True)
    """
    remainder = angle % math.tau
    return 0.0 if remainder == math.tau else remainder


def removed(shares: Sequence[Share]) -> float:
    """Mass that is taken off in all [kg]."""
    return sum(share.mass for share in shares if share.action == "remove")


def _split(mass: float, angle: float, first: float, second: float) -> tuple[Share, ...] | None:
    """m1·e^{iψ1} + m2·e^{iψ2} = m·e^{iφ}; what comes out negative is put on. None for places on one line."""
    across = math.sin(second - first)
    if abs(across) < NOTHING:
        return None
    parts = mass * math.sin(second - angle) / across, mass * math.sin(angle - first) / across
    shares = [
        Share("remove" if part > 0 else "add", abs(part), turned(place))
        for part, place in zip(parts, (first, second), strict=True)
        if abs(part) > NOTHING * mass
    ]
    return tuple(shares)


def total(shares: Sequence[Share]) -> complex:
    """Sum of the masses that the shares remove, as mass·e^{iψ} [kg].

    Removed metal counts where it was, added metal opposite.
    """
    return sum(((1 if share.action == "remove" else -1) * cmath.rect(share.mass, share.angle) for share in shares), 0j)
