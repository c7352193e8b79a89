"""Corrections of a plane as they are made: mass removed or added at places, holes with their depth, stock weights.

A heavy spot of mass m at angle φ is balanced by shares with Σ m_k·e^{iψ_k} = m·e^{iφ}; added mass counts opposite. Each
mass is that at the correction radius.
"""

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Annotated, ClassVar, Final, Literal

from abu_calc.foundation.formula import formula
from abu_calc.foundation.frozen import dataclass
from abu_calc.foundation.quantity import Quantity, Record, record

Action = Literal["remove", "add"]

NOTHING: Final = 1e-9
"""Part of the whole below which a share is none."""
USUAL_PITCH: Final = math.tau / 20
"""Angle between neighbouring masses if neither spacing nor drill is given [rad]."""
MOST_PIECES: Final = 160
"""Most weights at places that are combined by threes."""
MOST_BESIDE: Final = 20
"""Most places on either side of an angle for stock weights."""
PER_WEIGHT: Final = 0.002
"""Part of the heavy spot that one weight less is worth."""


@record
class Share(Record):
    """A mass to remove or to add."""

    optional: ClassVar[frozenset[str]] = frozenset({"depth_mm", "weights_g"})

    action: Annotated[str, Quantity("to do", "", 4, "remove or add")]
    mass: Annotated[float, Quantity("mass", "", 4, "at the correction radius", unit="g")]
    angle: Annotated[float, Quantity("at", "", 5, "by the angle marks of the rotor", unit="deg")]
    depth: Annotated[float | None, Quantity("depth of the hole", "", 3, "to the tip of the drill", unit="mm")] = None
    weights: Annotated[tuple[float, ...] | None, Quantity("weights in stock", unit="g")] = None


@dataclass(frozen=True)
class Drill:
    """Drill and metal in SI; `most`: largest depth [m]."""

    diameter: float
    density: float
    radial: bool = False
    point: float = math.pi
    most: float | None = None

    @property
    def limited(self) -> bool:
        """Tell whether the depth of a hole ends somewhere: a radial one does at the axis."""
        return self.radial or self.most is not None

    @property
    def tip(self) -> float:
        """Length of the drill's point [m]."""
        return self.diameter / 2 / math.tan(self.point / 2)


@dataclass(frozen=True)
class Making:
    """Limits of a plane [kg], weights in stock [kg], the drill, and the spacing along the circle [m]."""

    removable: float | None = None
    addable: float | None = None
    per_place: float | None = None
    stock: tuple[float, ...] = ()
    drill: Drill | None = None
    spacing: float | None = None


@formula(
    "Mass that a hole removes, at the correction radius",
    "m_hole = ρ·A_d·(h_d − 2·h_t/3)",
    "kg",
    shown="g",
    where=(
        "h_d is the depth to the tip and h_t the length of the drill's point, zero for a flat bottom. A radial hole "
        "begins at the correction radius, so that its mass counts by the distance of its middle from the axis."
    ),
    source="geometry",
)
def hole_mass(drill: Drill, depth: float, radius: float) -> float:
    """
    >>> flat = Drill(0.010, 7850.0)
    >>> round(1e3 * hole_mass(flat, 0.010, 0.1), 3), round(1e3 * hole_mass(Drill(0.010, 7850.0, True), 0.010, 0.1), 3)
    (6.165, 5.857)
    """
    area, tip = math.pi * drill.diameter**2 / 4, drill.tip
    straight, cone = max(depth - tip, 0.0), min(depth, tip)
    parts = [(area * straight, straight / 2)]
    if cone > 0:
        parts.append((area * tip / 3 * (cone / tip) ** 3, straight + cone / 4))
    return drill.density * sum(volume * (1 - middle / radius if drill.radial else 1.0) for volume, middle in parts)


def hole_depth(drill: Drill, mass: float, radius: float) -> float | None:
    """Depth to the tip of a hole that removes a mass at the correction radius [m]; None if no hole does.

    >>> round(1e3 * hole_depth(Drill(0.010, 7850.0), 0.006165, 0.1), 2)
    10.0
    """
    low, high = (
        0.0,
        radius if drill.radial else 2 * mass / (drill.density * math.pi * drill.diameter**2 / 4) + drill.tip,
    )
    if hole_mass(drill, high, radius) < mass:
        return None
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if hole_mass(drill, middle, radius) < mass else (low, middle)
    return high


def correction(
    mass: float, angle: float, making: Making, places: Sequence[float] | None, radius: float
) -> tuple[Share, ...]:
    """The shares that balance a heavy spot of this mass at this angle, as far as limits and stock allow.

    Metal is removed where there is enough, else mass is added opposite. At given places the shares remove no more than
    may be removed, add as little as may be, and are the least in all.
    """
    if mass == 0:
        return ()
    if making.stock:
        if places is None and making.per_place is not None:
            places = _places_about(angle + math.pi, _pitch(making, radius))
        shares = _stock_at(mass, angle, making, places) if places else _stock_anywhere(mass, angle, making)
        return tuple(replace(share, angle=turned(share.angle)) for share in shares)
    cap = _largest(making, radius)
    if places is None:
        fits = making.removable is None or mass <= making.removable * (1 + NOTHING)
        action: Action = "remove" if fits else "add"
        own = cap if fits else making.per_place
        shares = _side_by_side(mass, angle if fits else angle + math.pi, action, own, _pitch(making, radius))
    else:
        shares = _at_places(mass, angle, making, places, cap)
    return tuple(_drilled(share, making.drill, radius) for share in shares)


def _largest(making: Making, radius: float) -> float | None:
    """Largest mass that may be removed at one place [kg]."""
    limits = [making.per_place] if making.per_place is not None else []
    if making.drill is not None and making.drill.limited:
        limits.append(hole_mass(making.drill, min(making.drill.most or radius, radius), radius))
    return min(limits, default=None)


def _places_about(angle: float, pitch: float) -> list[float]:
    """Places beside each other about an angle, over half of the circle at most."""
    count = min(int(math.pi / 2 / pitch), MOST_BESIDE)
    return [angle + k * pitch for k in range(-count, count + 1)]


def _pitch(making: Making, radius: float) -> float:
    """Angle between neighbouring masses [rad]."""
    spacing = making.spacing
    if spacing is None and making.drill is not None:
        spacing = 1.5 * making.drill.diameter
    return USUAL_PITCH if spacing is None else spacing / radius


def _drilled(share: Share, drill: Drill | None, radius: float) -> Share:
    if drill is None or share.action == "add":
        return share
    return replace(share, depth=hole_depth(drill, share.mass, radius))


def _side_by_side(mass: float, angle: float, action: Action, cap: float | None, pitch: float) -> list[Share]:
    """Equal masses beside each other about an angle, as few as the cap allows; on half of the circle at most."""
    if cap is None or mass <= cap * (1 + NOTHING):
        return [Share(action=action, mass=mass, angle=turned(angle))]
    count, sum_of = 1, 1.0
    while mass / sum_of > cap * (1 + NOTHING) and (count + 1) * pitch <= math.pi:
        count += 1
        sum_of = math.sin(count * pitch / 2) / math.sin(pitch / 2)
    each = min(mass / sum_of, cap)
    angles = (turned(angle + (k - (count - 1) / 2) * pitch) for k in range(count))
    return [Share(action=action, mass=each, angle=at) for at in angles]


def _at_places(mass: float, angle: float, making: Making, places: Sequence[float], cap: float | None) -> list[Share]:
    target = cmath.rect(mass, angle)
    if cap is None and making.per_place is None:
        options = [split for pair in combinations(places, 2) if (split := _split(mass, angle, *pair)) is not None]
    else:
        sets: tuple[tuple[Action, ...], ...] = (("remove",), ("add",), ("remove", "add"))
        options = [split for actions in sets if (split := _limited(target, places, actions, cap, making.per_place))]
    return min(options, key=_worth(making)) if options else _as_far_as_possible(
        target, places, cap, making.per_place
    )  # fmt: skip


def _worth(making: Making) -> Callable[[Sequence[Share]], tuple[bool, bool, float]]:
    def worth(shares: Sequence[Share]) -> tuple[bool, bool, float]:
        off, on = removed(shares), added(shares)
        beyond = (making.removable is not None and off > making.removable * (1 + NOTHING)) or (
            making.addable is not None and on > making.addable * (1 + NOTHING)
        )
        return beyond, on > 0, off + on

    return worth


def _limited(
    target: complex, places: Sequence[float], actions: Sequence[Action], off: float | None, on: float | None
) -> list[Share]:
    """The least masses in all, none above its cap, that make up the target; empty if there are none.

    Of a linear program with two equations at most two masses of the solution lie between zero and their caps. All pairs
    are tried: the others are then at their caps or zero by the sign of their reduced costs.
    """
    found = [(action, place) for action in actions for place in places]
    ways = [cmath.rect(1.0 if action == "remove" else -1.0, place) for action, place in found]
    caps = [
        math.inf if limit is None else limit for action, _ in found for limit in [off if action == "remove" else on]
    ]
    costs = [1 + 1e-6 * (k + 0.1 * k * k) for k in range(len(ways))]  # unlike, so that one solution is the least
    for i, j in combinations(range(len(ways)), 2):
        whole = _cross(ways[i], ways[j])
        if abs(whole) < NOTHING:
            continue
        price = 1j * (costs[j] * ways[i] - costs[i] * ways[j]) / whole  # price·way is the cost of both
        full = [k for k, way in enumerate(ways) if k not in (i, j) and _dot(price, way) > costs[k]]
        if any(math.isinf(caps[k]) for k in full):
            continue
        rest = target - sum((caps[k] * ways[k] for k in full), 0j)
        own = {i: _cross(rest, ways[j]) / whole, j: _cross(ways[i], rest) / whole}
        room = NOTHING * abs(target)
        if all(-room <= value <= caps[k] + room for k, value in own.items()):
            masses = own | {k: caps[k] for k in full}
            return [
                Share(action=found[k][0], mass=masses[k], angle=turned(found[k][1]))
                for k in sorted(masses) if masses[k] > room
            ]  # fmt: skip
    return []


def _dot(a: complex, b: complex) -> float:
    return (a * b.conjugate()).real


def _cross(a: complex, b: complex) -> float:
    return (a.conjugate() * b).imag


def _as_far_as_possible(target: complex, places: Sequence[float], off: float | None, on: float | None) -> list[Share]:
    """Masses up to their caps that leave the least, by steps along one mass after another."""
    ways = [cmath.rect(1.0, place) for place in places]
    most, least = math.inf if off is None else off, -math.inf if on is None else -on
    masses, rest = [0.0] * len(ways), target
    for _ in range(2000):
        before = list(masses)
        for k, way in enumerate(ways):
            mass = min(max(masses[k] + _dot(rest, way), least), most)
            rest, masses[k] = rest - (mass - masses[k]) * way, mass
        if max(abs(new - old) for new, old in zip(masses, before, strict=True)) <= NOTHING * abs(target):
            break
    return [
        Share(action="remove" if mass > 0 else "add", mass=abs(mass), angle=turned(place))
        for mass, place in zip(masses, places, strict=True)
        if abs(mass) > NOTHING * abs(target)
    ]


def _stock_anywhere(mass: float, angle: float, making: Making) -> list[Share]:
    """Stock weights at free angles: the largest ones in the middle, two that make up the rest beside them."""
    middle, largest = angle + math.pi, max(making.stock)
    count = max(int(mass / largest * (1 + NOTHING)) - 1, 0)
    rest = mass - count * largest
    shares = [_weights_at((largest,) * count, middle)] if count else []
    alike = next((weight for weight in making.stock if abs(weight - rest) <= NOTHING * mass), None)
    if rest <= NOTHING * mass:
        return shares
    if alike is not None:
        return [*shares, _weights_at((alike,), middle)]
    pairs = [
        (first, second)
        for k, first in enumerate(making.stock)
        for second in making.stock[k:]
        if abs(first - second) <= rest <= (first + second) * (1 + NOTHING)
    ]
    if not pairs:
        return shares
    first, second = min(pairs, key=sum)
    one = math.acos(min(1.0, (rest**2 + first**2 - second**2) / (2 * rest * first)))
    other = math.acos(max(-1.0, min(1.0, (rest**2 + second**2 - first**2) / (2 * rest * second))))
    return [*shares, _weights_at((first,), middle - one), _weights_at((second,), middle + other)]


def _weights_at(weights: Sequence[float], angle: float) -> Share:
    """Weights in stock at one place."""
    return Share(action="add", mass=sum(weights), angle=angle, weights=tuple(sorted(weights, reverse=True)))


def _stock_at(mass: float, angle: float, making: Making, places: Sequence[float]) -> list[Share]:
    """Stock weights at places: large ones first, then the three or fewer that leave least."""
    import numpy as np

    target, cap = cmath.rect(mass, angle + math.pi), making.per_place
    held = [list[float]() for _ in places]
    largest = max(making.stock)
    ways = [cmath.rect(1.0, place) for place in places]

    def room(k: int, weight: float) -> bool:
        return cap is None or sum(held[k]) + weight <= cap * (1 + NOTHING)

    rest = target
    while abs(rest) > 2 * largest:
        free = [k for k in range(len(places)) if room(k, largest) and abs(rest - largest * ways[k]) < abs(rest)]
        if not free:
            break
        best = max(free, key=lambda k: _dot(rest, ways[k]))
        held[best].append(largest)
        rest -= largest * ways[best]
    pieces = [(k, weight) for k in range(len(places)) for weight in making.stock if room(k, weight)]
    pieces = sorted(pieces, key=lambda piece: -_dot(rest, ways[piece[0]]))[:MOST_PIECES]
    vectors = np.array([0j, *(weight * ways[k] for k, weight in pieces)])
    own = [(-1, 0.0), *pieces]
    best_cost, chosen = abs(rest) * (1 + NOTHING), tuple[int, ...]()
    for first in range(len(own)):
        for second in range(first, len(own)):
            left = np.abs(rest - vectors[first] - vectors[second] - vectors[second:])
            used = (first > 0) + (second > 0) + (np.arange(second, len(own)) > 0)
            costs = left + PER_WEIGHT * mass * used
            for third in np.argsort(costs)[:3]:
                if costs[third] >= best_cost:
                    break
                trio = tuple(k for k in (first, second, second + int(third)) if k)
                if _within(trio, own, held, cap):
                    best_cost, chosen = float(costs[third]), trio
                    break
    for index in chosen:
        held[own[index][0]].append(own[index][1])
    return [_weights_at(weights, place) for place, weights in zip(places, held, strict=True) if weights]


def _within(
    trio: Sequence[int], own: Sequence[tuple[int, float]], held: Sequence[Sequence[float]], cap: float | None
) -> bool:
    """Tell whether no place holds more than its cap."""
    if cap is None:
        return True
    sums = {own[index][0]: sum(held[own[index][0]]) for index in trio}
    for index in trio:
        sums[own[index][0]] += own[index][1]
    return max(sums.values(), default=0.0) <= cap * (1 + NOTHING)


def turned(angle: float) -> float:
    """An angle from 0 to 2π, the latter not reached.

    >>> turned(-1e-70), turned(7.0) < 1
    (0.0, True)
    """
    remainder = angle % math.tau
    return 0.0 if remainder == math.tau else remainder


def removed(shares: Sequence[Share]) -> float:
    """Mass that is removed in all [kg]."""
    return sum(share.mass for share in shares if share.action == "remove")


def added(shares: Sequence[Share]) -> float:
    """Mass that is added in all [kg]."""
    return sum(share.mass for share in shares if share.action == "add")


def _split(mass: float, angle: float, first: float, second: float) -> list[Share] | None:
    """m1·e^{iψ1} + m2·e^{iψ2} = m·e^{iφ}; negative masses are added. None for places on one line."""
    across = math.sin(second - first)
    if abs(across) < NOTHING:
        return None
    parts = mass * math.sin(second - angle) / across, mass * math.sin(angle - first) / across
    return [
        Share(action="remove" if part > 0 else "add", mass=abs(part), angle=turned(place))
        for part, place in zip(parts, (first, second), strict=True)
        if abs(part) > NOTHING * mass
    ]


def total(shares: Sequence[Share]) -> complex:
    """Sum of the masses that the shares remove, as mass·e^{iψ} [kg].

    Removed metal counts where it was, added metal opposite.
    """
    return sum(((1 if share.action == "remove" else -1) * cmath.rect(share.mass, share.angle) for share in shares), 0j)
